// SPDX-License-Identifier: MIT
// How early can one switch to Stage 2 (the open question of the paper's §6)? The published program
// with ApproximateGeom's epsilon from 0.1 to none; the last row is the exact program without
// options. Prints points at the switch, time, violations, and whether the final topology is exact.
// One run each: two minutes on the paper's volumes.
#include <array>
#include <limits>
#include <utility>

#include "support/examine.h"
#include "support/line_chart.h"
#include "support/runs.h"

using namespace deliso;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr std::array kEpsilons{0.1, 0.2, 0.4, kInfinity};

// A run, and what it had when it switched.
struct Switch {
  double kappa, r_min, seconds;
  std::size_t points, insertions;  // points at the switch, insertions after it
  std::string no_disk;
};

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

int work(const BenchArguments& arguments) {
  Table table(
      "How early can one switch?",
      {"data set", "data", "Stage 1", "topology", "components", "exact", "Euler number", "exact",
       "no disk", "at the switch", "n_RF", "vertices", "seconds", "r/l over", "h/r over"},
      4);
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
    const auto add = [&](const std::string& name, const TriMesh& mesh, const Switch& at) {
      const Examined e = examine(mesh, opened, exact, at.kappa, paper::Options().lambda,
                                 paper::Options().epsilon1, at.r_min);
      table.add({dataset.name, opened.data, name, e.topology_exact ? "exact" : "wrong",
                 count_of(e.components), count_of(exact.components.size()),
                 fixed_cell(static_cast<double>(e.euler), 0),
                 fixed_cell(static_cast<double>(exact.euler()), 0), at.no_disk, count_of(at.points),
                 count_of(at.insertions), count_of(mesh.points.size()), fixed_cell(at.seconds, 3),
                 count_of(e.over_lambda), count_of(e.over_h_over_r)});
    };
    Series times{dataset.name, {}}, shares = times;
    for (const double epsilon : kEpsilons) {
      paper::Options options = published_options(opened);
      options.epsilon = epsilon;
      const PublishedRuns runs = run_once(opened, options);
      const paper::Report& r = runs.last();
      const std::size_t points = r.points_initial() + r.insertions_recover;
      add(epsilon == kInfinity ? "no ApproximateGeom" : "epsilon " + fixed_cell(epsilon, 1),
          runs.mesh,
          {r.kappa, r.r_min, runs.total().median, points, r.insertions_refine,
           count_of(r.vertices_left)});
      times.points.emplace_back(chart_epsilon(epsilon), runs.total().median);
      shares.points.emplace_back(
          chart_epsilon(epsilon),
          100 * static_cast<double>(points) / static_cast<double>(runs.mesh.points.size()));
    }
    const ExactRuns runs = run_once(opened, Options());
    const Report& r = runs.last();
    add("exact program", runs.mesh,
        {r.kappa_effective, r.r_min, runs.total().median, r.vertices_coarsened, r.insertions_refine,
         "-"});
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
      "beyond lambda = 2, and beyond epsilon1 = 0.1; the exact program does not ask for the "
      "latter.");
  print_table(table, arguments);
  write_chart(time_chart, arguments.figures, "switch-time");
  write_chart(share_chart, arguments.figures, "switch-points");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv, "How early one can switch to Stage 2: the switch-point study.",
                   work);
}
