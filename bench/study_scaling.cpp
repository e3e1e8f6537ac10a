// SPDX-License-Identifier: MIT
// Measures the cost against the size of the output: the published program in one stage and in two,
// on a built-in field at falling epsilons. Needs no data; about forty seconds.
#include <string>
#include <vector>

#include "support/line_chart.h"
#include "support/runs.h"
#include "support/single_stage.h"

using namespace deliso;

namespace {

constexpr const char* kField = "builtin:orbital:128";

int work(const BenchArguments& arguments) {
  const char* title = "Time against output: an orbital at falling epsilons, as published";
  Table table(title,
              {"epsilons x", "3D vertices", "3D s", "us/vertex", "two vertices", "two s",
               "us/vertex", "speedup"},
              0);
  LineChart chart{
      title, {"vertices", true}, {"seconds", true}, {{"3D only", {}}, {"two stages", {}}}};
  const OpenedDataset opened = open_builtin(kField);
  for (const double factor : {2., 1.4, 1., 0.7, 0.5, 0.35, 0.25}) {
    std::vector<std::string> row{fixed_cell(factor, 2)};
    std::vector<double> seconds;
    for (const bool single_stage : {true, false}) {
      paper::Options options = published_options(opened);
      for (double* epsilon : {&options.epsilon, &options.epsilon1, &options.epsilon2}) {
        *epsilon *= factor;
      }
      const PublishedRuns runs =
          measure_runs(opened, options, arguments,
                       single_stage ? single_stage_deliso : PublishedProgram(paper::deliso));
      seconds.push_back(runs.total().median);
      const auto vertices = static_cast<double>(runs.mesh.points.size());
      row.push_back(count_cell(vertices));
      row.push_back(fixed_cell(seconds.back(), 3));
      row.push_back(fixed_cell(1e6 * seconds.back() / vertices, 1));
      chart.series[single_stage ? 0 : 1].points.emplace_back(vertices, seconds.back());
    }
    row.push_back(fixed_cell(seconds[0] / seconds[1], 2));
    table.add(std::move(row));
  }
  print_table(table, arguments);
  write_chart(chart, arguments.figures, "scaling-epsilon");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv, "Time against the size of the output, as published.", work);
}
