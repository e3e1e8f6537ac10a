// SPDX-License-Identifier: MIT
// Measures the cost against the size of the output, by the published criteria (Options::paper()).
// It compares one stage, two stages, and two stages with the certified Recover. One series is a
// built-in field at rising resolution, with triangles as fine as the voxels. The other is a field
// at falling epsilons. Needs no data; about forty seconds.
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "io/volume/builtin_volume.h"
#include "io/volume/read_volume.h"
#include "support/line_chart.h"
#include "support/runs.h"

using namespace deliso;

namespace {

struct Way {
  const char* name;
  Options options;
};

std::vector<Way> ways(const BenchArguments& arguments) {
  std::vector<Way> all{{"3D only", paper_options(arguments)},
                       {"two stages", paper_options(arguments)},
                       {"certified", certified_options(arguments)}};
  all[0].options.single_stage = true;
  return all;
}

OpenedDataset open_builtin(const std::string& input) {
  return {read_volume(input), find_builtin_field(input)->isovalue, true, input, {}};
}

// One row per input and factor of the epsilons, one series per way.
class Scaling {
 public:
  Scaling(const char* title, const BenchArguments& arguments)
      : arguments_(arguments),
        table_(
            title,
            {"field", "epsilons x", "3D vertices", "3D s", "us/vertex", "two vertices", "two s",
             "us/vertex", "speedup", "certified vertices", "certified s", "us/vertex", "speedup"},
            1),
        chart_{title, {"vertices", true}, {"seconds", true}, {}} {
    for (const Way& way : ways(arguments)) chart_.series.push_back({way.name, {}});
  }

  void add(const std::string& input, double factor, double max_radius) {
    const OpenedDataset opened = open_builtin(input);
    std::vector<std::string> row{input, fixed_cell(factor, 2)};
    double first = 0;
    std::size_t n = 0;
    for (Way& way : ways(arguments_)) {
      for (double* epsilon : {&way.options.epsilon, &way.options.limits[Criterion::h_over_r].value,
                              &way.options.limits[Criterion::r_over_pole].value}) {
        *epsilon *= factor;
      }
      way.options.limits[Criterion::radius] = {max_radius};
      const Runs runs = measure_runs(opened, way.options, arguments_);
      const double seconds = runs.total().median;
      const auto vertices = static_cast<double>(runs.mesh.points.size());
      row.push_back(count_cell(vertices));
      row.push_back(fixed_cell(seconds, 3));
      row.push_back(fixed_cell(1e6 * seconds / vertices, 1));
      if (n == 0) {
        first = seconds;
      } else {
        row.push_back(fixed_cell(first / seconds, 2));
      }
      chart_.series[n++].points.emplace_back(vertices, seconds);
    }
    table_.add(std::move(row));
  }

  void finish(const char* name) {
    print_table(table_, arguments_);
    write_chart(chart_, arguments_.figures, name);
  }

 private:
  const BenchArguments& arguments_;
  Table table_;
  LineChart chart_;
};

int work(const BenchArguments& arguments) {
  // The criteria follow the shape, not the samples: only with a bound in voxels does a mesh grow
  // with the resolution.
  Scaling resolution("Time against output: a gyroid at rising resolution, radii up to a voxel",
                     arguments);
  for (const int size : {32, 48, 64, 96, 128}) {
    resolution.add(text("builtin:gyroid:", size), 1, 1);
  }
  resolution.finish("scaling-resolution");

  Scaling epsilon("Time against output: an orbital at falling epsilons", arguments);
  for (const double factor : {2., 1.4, 1., 0.7, 0.5, 0.35, 0.25}) {
    epsilon.add("builtin:orbital:128", factor, std::numeric_limits<double>::infinity());
  }
  epsilon.finish("scaling-epsilon");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv, "Time against the size of the output, by the paper's criteria.",
                   work);
}
