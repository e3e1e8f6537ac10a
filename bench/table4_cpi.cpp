// SPDX-License-Identifier: MIT
// Table 4: voxel-ray computations per intersection search (CPI), and per search that found a point
// (CPI*), in Recover and in Refine of the published program. These are counts, so one run each:
// a minute on the paper's volumes.
#include <array>

#include "support/insertion_cost.h"
#include "support/runs.h"

using namespace deliso;

namespace {

int work(const BenchArguments& arguments) {
  Table table(
      "Table 4: computations per search, as published",
      {"data set",      "data",    "lines", "paper CPI_RC",        "CPI_RC",    "ratio",
       "paper CPI*_RC", "CPI*_RC", "ratio", "paper CPI_RF",        "CPI_RF",    "ratio",
       "paper CPI*_RF", "CPI*_RF", "ratio", "searches of Recover", "of Refine", "pairs CPI_RC",
       "ratio",         "CPI*_RC", "ratio"},
      2);
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset opened = open_dataset(dataset, arguments.data);
    const PaperFigures& p = dataset.paper;
    const std::array theirs{p.cpi_recover, p.cpi_hit_recover, p.cpi_refine, p.cpi_hit_refine};
    const paper::Report r = run_once(opened, published_options(opened)).last();
    const auto ours = computations_per_search(r);
    std::vector<std::string> row{dataset.name, opened.data, count_of(opened.lines)};
    for (std::size_t n = 0; n < ours.size(); ++n) {
      row.push_back(fixed_cell(theirs[n], 2));
      row.push_back(fixed_cell(ours[n], 2));
      row.push_back(opened.is_analogue ? "-" : ratio_cell(ours[n], theirs[n]));
    }
    row.push_back(count_of(r.searches_recover.searches));
    row.push_back(count_of(r.searches_refine.searches));
    paper::Report by_pairs;
    by_pairs.searches_recover = measure_insertions(opened, published_options(opened)).by_pairs;
    for (const std::size_t n : {0u, 1u}) {
      const double cpi = computations_per_search(by_pairs)[n];
      row.push_back(fixed_cell(cpi, 2));
      row.push_back(opened.is_analogue ? "-" : ratio_cell(cpi, theirs[n]));
    }
    table.add(std::move(row));
    for (const std::string& remark : opened.remarks) table.remark(remark);
  }
  table.remark(
      "A computation is a cubic formed in a voxel with samples on both sides of the isovalue; what "
      "the ranges of the tree or of a voxel's samples rule out costs none. Pairs: the isovalue is "
      "asked on pairs of voxels, no longer on each.");
  print_table(table, arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv,
                   "Table 4, as published: voxel-ray computations per intersection search.", work);
}
