// SPDX-License-Identifier: MIT
// Table 3: points inserted by Recover and by Refine, and the time of one insertion, by the
// published program; what such an insertion is made of; the same counts for built-in fields, which
// everybody has. About a minute on the paper's volumes.
#include <array>

#include "base/stopwatch.h"
#include "check/check_mesh.h"
#include "support/insertion_cost.h"
#include "support/runs.h"

using namespace deliso;

namespace {

constexpr std::array kBuiltinFields{"builtin:fuel:64", "builtin:orbital:64"};

std::string ratio_of_times(const Statistic& recover, const Statistic& refine) {
  return fixed_cell(recover.median / refine.median, 1);
}
std::string microseconds(double seconds) {
  return fixed_cell(1e6 * seconds, 2);
}

void add_costs(Table& table, const std::string& name, const OpenedDataset& opened,
               const BenchArguments& arguments) {
  const Stopwatch watch;
  std::vector<InsertionCosts> runs;
  do {
    runs.push_back(measure_insertions(opened, published_options(opened)));
  } while (runs.size() < arguments.repeat && watch.seconds() < arguments.budget);
  const auto median = [&](InsertionCost InsertionCosts::*stage, double InsertionCost::*seconds) {
    std::vector<double> values;
    for (const InsertionCosts& costs : runs) values.push_back(costs.*stage.*seconds);
    return statistic(std::move(values)).median;
  };
  const double rc_searches = runs[0].recover.searches, rf_searches = runs[0].refine.searches;
  const double rc_seconds = median(&InsertionCosts::recover, &InsertionCost::search_seconds);
  const double rc_other = median(&InsertionCosts::recover, &InsertionCost::other_seconds);
  const double rc_insertion = median(&InsertionCosts::recover, &InsertionCost::insertion_seconds);
  const double rf_seconds = median(&InsertionCosts::refine, &InsertionCost::search_seconds);
  const double rf_other = median(&InsertionCosts::refine, &InsertionCost::other_seconds);
  table.add({name, opened.data, fixed_cell(rc_searches, 1), microseconds(rc_seconds / rc_searches),
             microseconds(rc_insertion), percent_cell(rc_seconds / rc_insertion),
             microseconds(rc_seconds + rc_other - rc_insertion), fixed_cell(rf_searches, 1),
             microseconds(rf_seconds / rf_searches), microseconds(rf_other),
             fixed_cell(rc_insertion / (rf_seconds + rf_other), 1)});
}

void print_builtin_fields(const BenchArguments& arguments) {
  Table table("Built-in fields, as published",
              {"field", "isovalue", "S₀", "n_RC", "n_RF", "vertices", "components", "Euler number",
               "CPI_RC", "CPI*_RC", "CPI_RF", "CPI*_RF"},
              1);
  for (const char* field : kBuiltinFields) {
    const OpenedDataset opened = open_builtin(field);
    const PublishedRuns runs = run_once(opened, published_options(opened));
    const paper::Report& r = runs.last();
    const TopologyCounts found = mesh_topology(runs.mesh).counts();
    std::vector<std::string> row{field,
                                 fixed_cell(opened.isovalue, 1),
                                 count_of(r.points_initial()),
                                 count_of(r.insertions_recover),
                                 count_of(r.insertions_refine),
                                 count_of(runs.mesh.points.size()),
                                 count_of(found.components),
                                 fixed_cell(static_cast<double>(found.euler), 0)};
    for (const double cpi : computations_per_search(r)) row.push_back(fixed_cell(cpi, 2));
    table.add(std::move(row));
  }
  print_table(table, arguments);
}

int work(const BenchArguments& arguments) {
  Table counts("Table 3: insertions, as published",
               {"data set", "data", "lines", "S₀", "paper n_RC", "n_RC", "ratio", "paper n_RF",
                "n_RF", "ratio"},
               2);
  Table seconds("Table 3: seconds of an insertion, as published",
                {"data set", "data", "paper t_RC", "t_RC", "spread", "paper t_RF", "t_RF", "spread",
                 "paper t_RC/t_RF", "t_RC/t_RF", "poles"},
                2);
  Table costs("What an insertion is made of, microseconds",
              {"data set", "data", "searches in Recover", "each", "insertion", "share", "else",
               "searches in Refine", "each", "else", "insertions"},
              2);
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset opened = open_dataset(dataset, arguments.data);
    const PaperFigures& paper = dataset.paper;
    const auto ratio = [&](std::size_t ours, double theirs) {
      return opened.is_analogue ? "-" : ratio_cell(static_cast<double>(ours), theirs);
    };
    const PublishedRuns runs = measure_runs(opened, published_options(opened), arguments);
    const paper::Report& r = runs.last();
    counts.add({dataset.name, opened.data, count_of(opened.lines), count_of(r.points_initial()),
                count_cell(paper.n_recover), count_of(r.insertions_recover),
                ratio(r.insertions_recover, paper.n_recover), count_cell(paper.n_refine),
                count_of(r.insertions_refine), ratio(r.insertions_refine, paper.n_refine)});
    const Statistic rc = runs.of(seconds_per_recover_insertion);
    const Statistic rf = runs.of(seconds_per_refine_insertion);
    const Statistic poles = runs.of([](const paper::Report& one) { return one.seconds_poles; });
    seconds.add({dataset.name, opened.data, scientific_cell(paper.t_recover),
                 scientific_cell(rc.median), spread_cell(rc), scientific_cell(paper.t_refine),
                 scientific_cell(rf.median), spread_cell(rf),
                 fixed_cell(paper.t_recover / paper.t_refine, 0), ratio_of_times(rc, rf),
                 fixed_cell(poles.median, 3)});
    add_costs(costs, dataset.name, opened, arguments);
    for (const std::string& remark : opened.remarks) counts.remark(remark);
  }
  counts.remark("n_RC, n_RF: points that Recover and Refine insert, beside those of S₀.");
  seconds.remark(
      "The seconds of the stage over n_RC and n_RF: Refine with BuildTriMesh, without "
      "ComputePoles, "
      "which has its own column.");
  costs.remark(
      "From a run that makes every search twice. Insertion: the conflict zone, the cells, and the "
      "searches, as the paper's t_RC is defined; share: of the searches in it, by the paper 80 to "
      "85 %; else: the rest of Recover. In Refine, else is all but the searches. Insertions: "
      "Recover's insertion over Refine's.");
  for (const Table* table : {&counts, &seconds, &costs}) print_table(*table, arguments);
  print_builtin_fields(arguments);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(
      argc, argv, "Table 3, as published: points and insertion times of Recover and Refine.", work);
}
