// SPDX-License-Identifier: MIT
// How early can one switch to Stage 2 (the open question of the paper's §6)? Compares the
// paper's way with ApproximateGeom's epsilon from 0.1 to none, and the certified way with and
// without its search for protrusions, all by the published criteria. Last comes the certified way
// with its own defaults, by distance. Prints points at the switch, time, violations, and whether
// the final topology is exact. One run each: two minutes on the paper's volumes.
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

struct Setting {
  std::string name;
  Options options;
};

std::vector<Setting> settings(const BenchArguments& arguments) {
  std::vector<Setting> all;
  for (const double epsilon : kEpsilons) {
    Options options = paper_options(arguments);
    options.epsilon = epsilon;
    all.push_back({epsilon == kInfinity ? "paper, no ApproximateGeom"
                                        : "paper, epsilon " + fixed_cell(epsilon, 1),
                   options});
  }
  const Options certified = certified_options(arguments);
  all.push_back({"certified", certified});
  all.push_back({"certified, no protrusions", certified});
  all.back().options.fingers = {kInfinity};
  all.push_back({"certified, by distance (default)", default_options(arguments)});
  return all;
}

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
  Table table("How early can one switch?",
              {"data set", "data", "Stage 1", "topology", "components", "exact", "Euler number",
               "exact", "no disk", "n_RC", "n_RF", "vertices", "seconds", "r/l over", "h/r over"},
              4);
  LineChart time_chart{"Total time by the bound of ApproximateGeom (paper's way)",
                       epsilon_axis(),
                       {"seconds over those at epsilon 0.2"},
                       {}};
  LineChart share_chart{"Points inserted before the switch (paper's way)",
                        epsilon_axis(),
                        {"n_RC, % of all vertices"},
                        {}};
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset opened = open_dataset(dataset, arguments.data);
    // Stand-ins are for those who have no data at all.
    if (opened.is_analogue && !arguments.data.empty()) continue;
    const ContourSummary exact = exact_topology(opened);
    Series times{dataset.name, {}}, shares = times;
    for (const Setting& setting : settings(arguments)) {
      const Options& options = setting.options;
      const Runs runs = run_once(opened, options);
      const Report& r = runs.last();
      const Examined e = examine(runs.mesh, opened, r.kappa_effective, exact,
                                 options.limits[Criterion::r_over_l].value,
                                 Options::paper().limits[Criterion::h_over_r].value, r.r_min);
      const auto count = [](auto n) { return count_cell(static_cast<double>(n)); };
      table.add({dataset.name, opened.data, setting.name, e.topology_exact ? "exact" : "wrong",
                 count(e.components), count(exact.components.size()),
                 fixed_cell(static_cast<double>(e.euler), 0),
                 fixed_cell(static_cast<double>(exact.euler()), 0),
                 count(r[Counter::unresolved_vertices]), count(r.points_recovered),
                 count(r.insertions_refine), count(runs.mesh.points.size()),
                 fixed_cell(r.seconds_total, 3), count(e.over_lambda), count(e.over_h_over_r)});
      if (options.recover != RecoverWay::paper) continue;
      times.points.emplace_back(chart_epsilon(options.epsilon), r.seconds_total);
      shares.points.emplace_back(chart_epsilon(options.epsilon),
                                 100 * static_cast<double>(r.points_recovered) /
                                     static_cast<double>(runs.mesh.points.size()));
    }
    const double at_default = times.points[1].second;
    for (auto& [epsilon, seconds] : times.points) seconds /= at_default;
    for (const std::string& remark : opened.remarks) table.remark(remark);
    if (time_chart.series.size() == LineChart::kMostSeries) continue;
    time_chart.series.push_back(std::move(times));
    share_chart.series.push_back(std::move(shares));
  }
  table.remark(
      "Exact: the components' Euler numbers and boundary loops are those of the surface. No disk: "
      "vertices whose facets are none when Stage 1 ends. Over: triangles above r_min beyond "
      "lambda = 2, and beyond epsilon1 = 0.1.");
  table.remark(
      "All but the last by the published criteria. Protrusions: vertices of the contour further "
      "than "
      "--fingers from the mesh at the switch. Over: of triangles above the run's "
      "own "
      "r_min, which by distance is half a voxel.");
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
