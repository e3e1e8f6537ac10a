// SPDX-License-Identifier: MIT
// Table 3: points inserted by Recover and by Refine, and the time of one insertion. It has three
// runs: as published (Options::paper()), certified by the same criteria, and certified by the
// distance (the default). The vertices of the meshes stand beside the paper's n_RC + n_RF. About a
// minute on the paper's volumes.
#include "support/runs.h"

using namespace deliso;

namespace {

double count(std::size_t n) {
  return static_cast<double>(n);
}

int work(const BenchArguments& arguments) {
  Table insertions("Table 3: insertions, everything as published, seconds each",
                   {"data set", "data", "paper t_RC", "t_RC", "spread", "ratio", "paper n_RC",
                    "n_RC", "ratio", "paper t_RF", "t_RF", "spread", "ratio", "paper n_RF", "n_RF",
                    "ratio", "paper t_RC/t_RF", "t_RC/t_RF"},
                   2);
  const std::vector<std::string> columns{"data set", "data",       "stage 1 s",  "spread",
                                         "n_RC",     "to paper's", "t_RC",       "stage 2 s",
                                         "spread",   "n_RF",       "to paper's", "t_RF"};
  Table certified_way("Table 3 by the certified way through Recover, published criteria", columns,
                      2);
  Table by_distance("Table 3 by the certified way and the distance: a run without options", columns,
                    2);
  Table vertices("Vertices of the mesh, published criteria; and by the distance",
                 {"data set", "data", "paper n_RC + n_RF", "paper's way", "ratio", "certified",
                  "ratio", "by distance", "ratio"},
                 2);
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset opened = open_dataset(dataset, arguments.data);
    const PaperFigures& paper = dataset.paper;
    const auto ratio = [&](double ours, double theirs) {
      return opened.is_analogue ? "-" : ratio_cell(ours, theirs);
    };
    const Runs runs = measure_runs(opened, paper_options(arguments), arguments);
    const Report& r = runs.last();
    const Statistic rc = runs.of(seconds_per_recover_insertion);
    const Statistic rf = runs.of(seconds_per_refine_insertion);
    const double n_rc = count(r.points_recovered), n_rf = count(r.insertions_refine);
    insertions.add(
        {dataset.name, opened.data, scientific_cell(paper.t_recover), scientific_cell(rc.median),
         spread_cell(rc), scientific_cell(rc.median / paper.t_recover), count_cell(paper.n_recover),
         count_cell(n_rc), ratio(n_rc, paper.n_recover), scientific_cell(paper.t_refine),
         scientific_cell(rf.median), spread_cell(rf), scientific_cell(rf.median / paper.t_refine),
         count_cell(paper.n_refine), count_cell(n_rf), ratio(n_rf, paper.n_refine),
         fixed_cell(paper.t_recover / paper.t_refine, 0), fixed_cell(rc.median / rf.median, 1)});

    // What a way with a certificate takes; the vertices of its mesh.
    const auto measure_into = [&](Table& table, const Options& options) {
      const Runs certified = measure_runs(opened, options, arguments);
      const Statistic stage1 = certified.of(
          [](const Report& s) { return s.seconds_total - s.seconds_tree - s.seconds_refine; });
      const Statistic stage2 = certified.of([](const Report& s) { return s.seconds_refine; });
      const double c_rc = count(certified.last().points_recovered);
      const double c_rf = count(certified.last().insertions_refine);
      table.add({dataset.name, opened.data, fixed_cell(stage1.median, 3), spread_cell(stage1),
                 count_cell(c_rc), ratio(c_rc, paper.n_recover),
                 scientific_cell(stage1.median / c_rc), fixed_cell(stage2.median, 3),
                 spread_cell(stage2), count_cell(c_rf), ratio(c_rf, paper.n_refine),
                 scientific_cell(stage2.median / c_rf)});
      return count(certified.mesh.points.size());
    };
    const double of_certified = measure_into(certified_way, certified_options(arguments));
    const double of_default = measure_into(by_distance, default_options(arguments));

    const double of_paper = paper.n_recover + paper.n_refine;
    const double of_runs = count(runs.mesh.points.size());
    vertices.add({dataset.name, opened.data, count_cell(of_paper), count_cell(of_runs),
                  ratio(of_runs, of_paper), count_cell(of_certified), ratio(of_certified, of_paper),
                  count_cell(of_default), ratio(of_default, of_paper)});
    for (const std::string& remark : opened.remarks) insertions.remark(remark);
  }
  insertions.remark(
      "n_RC: all points when Recover ends, with the initial sample. t_RC: the seconds of Recover "
      "over the points that it inserted into that sample; t_RF: those of Refine over n_RF.");
  for (Table* table : {&certified_way, &by_distance}) {
    table->remark(
        "Stage 1: all but the tree and Stage 2, the exact contour included; t_RC is that over "
        "n_RC.");
  }
  vertices.remark("Components that the paper's tests lose are not in these counts.");
  for (const Table* table : {&insertions, &certified_way, &by_distance, &vertices}) {
    print_table(*table, arguments);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv,
                   "Table 3, the paper's way: points and insertion times of Recover and Refine.",
                   work);
}
