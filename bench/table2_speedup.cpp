// SPDX-License-Identifier: MIT
// Table 2: all refinement on Del S against two stages, to the same criteria, both by the published
// program. Beside them stands the exact program by its own criteria. About a minute on the paper's
// volumes.
#include "support/runs.h"
#include "support/single_stage.h"

using namespace deliso;

namespace {

int work(const BenchArguments& arguments) {
  Table table(
      "Table 2: one stage against two, as published, seconds",
      {"data set", "data", "lines", "paper 3D", "3D", "spread", "paper two", "of it Table 3", "two",
       "spread", "paper speedup", "speedup", "to paper's", "exact", "spread"},
      2);
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset opened = open_dataset(dataset, arguments.data);
    const PaperFigures& paper = dataset.paper;
    const auto ratio = [&](double ours, double theirs) {
      return opened.is_analogue ? "-" : ratio_cell(ours, theirs);
    };
    const paper::Options options = published_options(opened);
    const PublishedRuns one = measure_runs(opened, options, arguments, single_stage_deliso);
    const PublishedRuns two = measure_runs(opened, options, arguments);
    const ExactRuns exact = measure_runs(opened, Options(), arguments);
    const Statistic t1 = one.total(), t2 = two.total(), t = exact.total();
    const double speedup = t1.median / t2.median;
    table.add({dataset.name, opened.data, count_of(opened.lines), fixed_cell(paper.seconds_3d, 2),
               fixed_cell(t1.median, 3), spread_cell(t1), fixed_cell(paper.seconds_deliso, 2),
               percent_cell((paper.n_recover * paper.t_recover + paper.n_refine * paper.t_refine) /
                            paper.seconds_deliso),
               fixed_cell(t2.median, 3), spread_cell(t2), fixed_cell(paper.speedup, 2),
               fixed_cell(speedup, 2), ratio(speedup, paper.speedup), fixed_cell(t.median, 3),
               spread_cell(t)});
    for (const std::string& remark : opened.remarks) table.remark(remark);
  }
  table.remark(
      "Seconds of the processor, of the whole program but reading. Medians; the spread is (largest "
      "- smallest) / "
      "median. Of it Table 3: what the paper's own times of insertions add up to. Exact: the exact "
      "program without options, by the distance.");
  print_table(table, arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv,
                   "Table 2, as published: refinement on Del S only, against two stages.", work);
}
