// SPDX-License-Identifier: MIT
// Table 2: all refinement on the 3D triangulation (--single-stage) against two stages, to the same
// threshold, both as published (Options::paper()). Beside them stands the certified way, by the
// same criteria and by the distance (the default). About two minutes on the paper's volumes.
#include "support/runs.h"

using namespace deliso;

namespace {

std::string count_of(const Runs& runs) {
  return count_cell(static_cast<double>(runs.mesh.points.size()));
}

int work(const BenchArguments& arguments) {
  Table table("Table 2: one stage against two, everything as published, seconds",
              {"data set", "data", "paper 3D", "paper two", "paper speedup", "3D", "spread", "two",
               "spread", "speedup", "to paper's", "certified", "spread", "speedup", "vertices 3D",
               "two", "certified"},
              2);
  Table by_distance("What a run without options takes: the certified way, by the distance",
                    {"data set", "data", "paper two", "seconds", "spread", "paper two / seconds",
                     "paper vertices", "vertices", "ratio", "n_RC", "3D as published / seconds"},
                    2);
  Table bounds("What bounds the speedup: the share of the points that Recover inserts",
               {"data set", "data", "paper vertices / n_RC", "paper speedup", "vertices / n_RC",
                "speedup", "certified vertices / n_RC", "speedup"},
               2);
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset opened = open_dataset(dataset, arguments.data);
    const PaperFigures& paper = dataset.paper;
    const Options two_stages = paper_options(arguments);
    Options one_stage = two_stages;
    one_stage.single_stage = true;
    const Runs one = measure_runs(opened, one_stage, arguments);
    const Runs two = measure_runs(opened, two_stages, arguments);
    const Runs certified = measure_runs(opened, certified_options(arguments), arguments);
    const Statistic t1 = one.total(), t2 = two.total(), tc = certified.total();
    const double speedup = t1.median / t2.median;
    table.add({dataset.name, opened.data, fixed_cell(paper.seconds_3d, 2),
               fixed_cell(paper.seconds_deliso, 2), fixed_cell(paper.speedup, 2),
               fixed_cell(t1.median, 3), spread_cell(t1), fixed_cell(t2.median, 3), spread_cell(t2),
               fixed_cell(speedup, 2),
               opened.is_analogue ? "-" : ratio_cell(speedup, paper.speedup),
               fixed_cell(tc.median, 3), spread_cell(tc), ratio_cell(t1.median, tc.median),
               count_of(one), count_of(two), count_of(certified)});
    const Runs plain = measure_runs(opened, default_options(arguments), arguments);
    const Statistic td = plain.total();
    const double theirs = paper.n_recover + paper.n_refine;
    const auto vertices = static_cast<double>(plain.mesh.points.size());
    const auto ratio = [&](double a, double b) {
      return opened.is_analogue ? "-" : ratio_cell(a, b);
    };
    by_distance.add({dataset.name, opened.data, fixed_cell(paper.seconds_deliso, 2),
                     fixed_cell(td.median, 3), spread_cell(td),
                     ratio(paper.seconds_deliso, td.median), count_cell(theirs), count_of(plain),
                     ratio(vertices, theirs),
                     count_cell(static_cast<double>(plain.last().points_recovered)),
                     ratio_cell(t1.median, td.median)});
    const auto bound = [](const Runs& runs) {
      return ratio_cell(static_cast<double>(runs.mesh.points.size()),
                        static_cast<double>(runs.last().points_recovered));
    };
    bounds.add({dataset.name, opened.data,
                ratio_cell(paper.n_recover + paper.n_refine, paper.n_recover),
                fixed_cell(paper.speedup, 2), bound(two), fixed_cell(speedup, 2), bound(certified),
                ratio_cell(t1.median, tc.median)});
    for (const std::string& remark : opened.remarks) table.remark(remark);
  }
  table.remark(
      "3D, two: everything as published. Certified: the same criteria, by the certified way "
      "through "
      "Recover. Medians; the spread is (largest - smallest) / "
      "median. Certified: its speedup is over the same 3D.");
  table.remark("Times are of the whole program but reading: tree, contour, both stages.");
  bounds.remark(
      "Were the points of Stage 2 free, and those of Stage 1 as dear as in one stage, the speedup "
      "would be vertices / n_RC.");
  print_table(table, arguments);
  print_table(by_distance, arguments);
  print_table(bounds, arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(
      argc, argv,
      "Table 2, the paper's way: refinement on the 3D triangulation only, against two stages.",
      work);
}
