// SPDX-License-Identifier: MIT
// Table 4: voxel-ray computations per intersection search (CPI), and per search that found a point
// (CPI*), in Recover and in Refine. It has two runs: as published (Options::paper()), and certified
// by the same criteria. These are counts, so one run each: half a minute on the paper's volumes.
#include <array>

#include "support/runs.h"

using namespace deliso;

namespace {

double per_search(const SearchCounters& c) {
  return static_cast<double>(c.computations) / static_cast<double>(c.searches);
}
double per_hit(const SearchCounters& c) {
  return static_cast<double>(c.computations_with_hit) / static_cast<double>(c.searches_with_hit);
}

int work(const BenchArguments& arguments) {
  Table table("Table 4: computations per search, everything as published",
              {"data set",
               "data",
               "paper CPI_RC",
               "CPI_RC",
               "ratio",
               "paper CPI*_RC",
               "CPI*_RC",
               "ratio",
               "paper CPI_RF",
               "CPI_RF",
               "ratio",
               "paper CPI*_RF",
               "CPI*_RF",
               "ratio",
               "certified CPI_RC",
               "CPI*_RC",
               "CPI_RF",
               "CPI*_RF",
               "by distance CPI_RC",
               "CPI*_RC",
               "CPI_RF",
               "CPI*_RF"},
              2);
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset opened = open_dataset(dataset, arguments.data);
    const PaperFigures& p = dataset.paper;
    const std::array theirs{p.cpi_recover, p.cpi_hit_recover, p.cpi_refine, p.cpi_hit_refine};
    const auto figures = [](const Report& r) {
      return std::array{per_search(r.searches_recover), per_hit(r.searches_recover),
                        per_search(r.searches_refine), per_hit(r.searches_refine)};
    };
    const auto ours = figures(run_once(opened, paper_options(arguments)).last());
    std::vector<std::string> row{dataset.name, opened.data};
    for (std::size_t n = 0; n < ours.size(); ++n) {
      row.push_back(fixed_cell(theirs[n], 2));
      row.push_back(fixed_cell(ours[n], 2));
      row.push_back(opened.is_analogue ? "-" : ratio_cell(ours[n], theirs[n]));
    }
    for (const Options& options : {certified_options(arguments), default_options(arguments)}) {
      for (const double x : figures(run_once(opened, options).last())) {
        row.push_back(fixed_cell(x, 2));
      }
    }
    table.add(std::move(row));
    for (const std::string& remark : opened.remarks) table.remark(remark);
  }
  table.remark(
      "Certified: the same criteria, by the certified way through Recover. By distance: a run "
      "without options.");
  table.remark(
      "A computation is a cubic formed in a voxel with samples on both sides of the isovalue; what "
      "the ranges of the tree or of a voxel's samples rule out costs none.");
  print_table(table, arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv,
                   "Table 4, the paper's way: voxel-ray computations per intersection search.",
                   work);
}
