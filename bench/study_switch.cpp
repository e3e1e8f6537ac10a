// SPDX-License-Identifier: MIT
// How early can one switch to Stage 2 (the open question of the paper's §6)? The published program
// with ApproximateGeom's epsilon from 0.1 to none, and with the certificate in place of its tests
// (recover/certified.h), or with facet cycles beside them. Prints points at the switch, time,
// violations, and whether the final topology is exact. One run each, and for the exactness four
// more seeds of Stage 1: three minutes on the paper's volumes.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "check/triangle_tree.h"
#include "recover/certified.h"
#include "support/examine.h"
#include "support/line_chart.h"
#include "support/runs.h"

using namespace deliso;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kSeeds = 5;

constexpr std::array kEpsilons{0.1, 0.2, 0.4, kInfinity};

// Where an epsilon stands on the charts; none at all, at the right.
double chart_epsilon(double epsilon) {
  return epsilon == kInfinity ? 0.8 : epsilon;
}

Axis epsilon_axis() {
  Axis axis{"epsilon of ApproximateGeom", true};
  for (const double epsilon : kEpsilons) {
    axis.ticks.emplace_back(chart_epsilon(epsilon),
                            epsilon == kInfinity ? "none" : fixed_cell(epsilon, 1));
  }
  return axis;
}

constexpr PublishedProgram kPublished = paper::deliso, kCertified = certified_deliso;

struct Way {
  std::string name;
  PublishedProgram program;
  double epsilon;
  bool facet_cycles = false;
};

// A run, and what became of it.
struct Outcome {
  PublishedRuns runs;
  Examined examined;
  std::size_t points;  // at the switch
};

Outcome run(const Way& way, const OpenedDataset& opened, const ContourSummary& exact,
            paper::Options options) {
  options.epsilon = way.epsilon;
  options.facet_cycles = way.facet_cycles;
  Outcome out{run_once(opened, options, way.program), {}, 0};
  const paper::Report& r = out.runs.last();
  out.examined =
      examine(out.runs.mesh, opened, exact, r.kappa, options.lambda, options.epsilon1, r.r_min);
  out.points = r.points_initial() + r.insertions_recover;
  return out;
}

// The number of seeds with which the topology is exact; Stage 2 keeps that of Stage 1.
std::size_t count_exact(const Way& way, const Outcome& first, const OpenedDataset& opened,
                        const ContourSummary& exact) {
  std::size_t count = first.examined.topology_exact;
  for (std::uint64_t seed = 2; seed <= kSeeds; ++seed) {
    paper::Options options = published_options(opened);
    options.seed = seed;
    options.stop_after_recover = true;
    count += run(way, opened, exact, options).examined.topology_exact;
  }
  return count;
}

// The distance from the mesh, in voxels, that 99.9 % of the vertices of T keep to.
double distance_of_most(const ContourMesh& contour, const TriMesh& mesh, double voxel) {
  const std::vector<Triangle> triangles = mesh.triangles();
  const TriangleTree tree(mesh.points, triangles);
  std::vector<double> distances2;
  for (const Vec3& p : contour.points) distances2.push_back(tree.nearest(p).distance2);
  const auto most = distances2.begin() +
                    static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(distances2.size()));
  std::ranges::nth_element(distances2, most);
  return std::sqrt(*most) / voxel;
}

int work(const BenchArguments& arguments) {
  Table table(
      "How early can one switch?",
      {"data set", "data", "Stage 1", "topology", "components", "exact", "Euler number", "exact",
       "no disk", "at the switch", "n_RF", "vertices", "seconds", "r/l over", "h/r over"},
      4);
  Table short_table("Points at the switch",
                    {"data set",   "data",  "lines", "exact",   "published",
                     "components", "right", "far",   "seconds", "facet cycles",
                     "components", "right", "far",   "seconds", "certified",
                     "components", "right", "far",   "seconds", "certified, eps",
                     "components", "right", "far",   "seconds"},
                    2);
  LineChart time_chart{"Total time by the bound of ApproximateGeom",
                       epsilon_axis(),
                       {"seconds over those at epsilon 0.2"},
                       {}};
  LineChart share_chart{"Points at the switch", epsilon_axis(), {"% of all vertices"}, {}};
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset opened = open_dataset(dataset, arguments.data);
    // Stand-ins are for those who have no data at all.
    if (opened.is_analogue && !arguments.data.empty()) continue;
    const ContourSummary exact = exact_topology(opened);
    const auto add = [&](const std::string& name, const Outcome& o) {
      const Examined& e = o.examined;
      const paper::Report& r = o.runs.last();
      table.add({dataset.name, opened.data, name, e.topology_exact ? "exact" : "wrong",
                 count_of(e.components), count_of(exact.components.size()),
                 fixed_cell(static_cast<double>(e.euler), 0),
                 fixed_cell(static_cast<double>(exact.euler()), 0), count_of(r.vertices_left),
                 count_of(o.points), count_of(r.insertions_refine),
                 count_of(o.runs.mesh.points.size()), fixed_cell(o.runs.total().median, 3),
                 count_of(e.over_lambda), count_of(e.over_h_over_r)});
    };
    Series times{dataset.name, {}}, shares = times;
    for (const double epsilon : kEpsilons) {
      const Outcome o = run({"", kPublished, epsilon}, opened, exact, published_options(opened));
      add(epsilon == kInfinity ? "no ApproximateGeom" : "epsilon " + fixed_cell(epsilon, 1), o);
      times.points.emplace_back(chart_epsilon(epsilon), o.runs.total().median);
      shares.points.emplace_back(
          chart_epsilon(epsilon),
          100 * static_cast<double>(o.points) / static_cast<double>(o.runs.mesh.points.size()));
    }
    const ContourMesh contour =
        build_contour(opened.volume, geometric_isovalue(opened.volume.type(), opened.isovalue));
    std::vector<std::string> row{dataset.name, opened.data, count_of(opened.lines),
                                 count_of(exact.components.size())};
    for (const Way& way :
         {Way{"epsilon 0.2", kPublished, 0.2}, Way{"facet cycles", kPublished, 0.2, true},
          Way{"certificate", kCertified, kInfinity},
          Way{"certificate, epsilon 0.2", kCertified, 0.2}}) {
      const Outcome o = run(way, opened, exact, published_options(opened));
      if (way.program == kCertified || way.facet_cycles) add(way.name, o);
      row.push_back(count_of(o.points));
      row.push_back(count_of(o.examined.components));
      row.push_back(count_of(count_exact(way, o, opened, exact)));
      row.push_back(fixed_cell(distance_of_most(contour, o.runs.mesh, opened.volume.voxel()), 2));
      row.push_back(fixed_cell(o.runs.total().median, 2));
    }
    short_table.add(std::move(row));
    const double at_default = times.points[1].second;
    for (auto& [epsilon, seconds] : times.points) seconds /= at_default;
    for (const std::string& remark : opened.remarks) table.remark(remark);
    if (time_chart.series.size() == LineChart::kMostSeries) continue;
    time_chart.series.push_back(std::move(times));
    share_chart.series.push_back(std::move(shares));
  }
  table.remark(
      "Exact: the components' Euler numbers and boundary loops are those of the surface. No disk: "
      "vertices whose facets are none when Stage 1 ends. Over: triangles above the run's own r_min "
      "beyond lambda = 2, and beyond epsilon1 = 0.1.");
  short_table.remark(
      "Published: epsilon 0.2. Right: seeds of five with which the topology is exact. Far: 99.9 % "
      "of the contour's vertices are this near to the mesh, in voxels. Seconds of the processor.");
  print_table(table, arguments);
  print_table(short_table, arguments);
  write_chart(time_chart, arguments.figures, "switch-time");
  write_chart(share_chart, arguments.figures, "switch-points");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv, "How early one can switch to Stage 2: the switch-point study.",
                   work);
}
