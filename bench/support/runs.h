// SPDX-License-Identifier: MIT
// What the table and study programs share: their arguments, and meshing with the clock running, by
// the published program (paper::deliso) and by the exact one (mesh_isosurface).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "deliso/mesh_isosurface.h"
#include "paper/deliso.h"
#include "support/datasets.h"
#include "support/statistics.h"
#include "support/table.h"

namespace deliso {

struct BenchArguments {
  std::string data;               // folder of volumes; empty: none
  std::vector<Dataset> datasets;  // those asked for, all by default
  TableFormat format = TableFormat::text;
  std::size_t repeat = 9;
  double budget = 8;    // seconds, of all runs of one measurement
  std::string figures;  // folder for plots; empty: none are written
};

// Reads the arguments; --help prints `purpose` and ends the program. Throws InputError.
BenchArguments parse_bench_arguments(int argc, char** argv, const char* purpose);

// Runs the program's work; InputErrors become one line on standard error and exit status 2.
int run_bench(int argc, char** argv, const char* purpose, int (*work)(const BenchArguments&));

// Every run of one measurement, of the same bytes each. R: the report of the program that ran.
template <class R>
struct Runs {
  std::vector<R> reports;  // without the warm-up
  // Seconds that the processor spent on each run: other work on the machine does not count.
  std::vector<double> seconds;
  TriMesh mesh;  // of the last one

  const R& last() const { return reports.back(); }
  // Of a step by the wall clock, or of anything computed from a report.
  template <class F>
  Statistic of(F value) const {
    std::vector<double> values;
    for (const R& report : reports) values.push_back(value(report));
    return statistic(std::move(values));
  }
  Statistic total() const { return statistic(seconds); }
};
using PublishedRuns = Runs<paper::Report>;
using ExactRuns = Runs<Report>;

// Meshes once to warm up and then up to arguments.repeat times, while arguments.budget lasts. A
// first run of a second and more counts as well: what it warms up no longer shows.
using PublishedProgram = TriMesh (*)(const Volume&, double isovalue, const paper::Options&,
                                     paper::Report&);
PublishedRuns measure_runs(const OpenedDataset& opened, const paper::Options& options,
                           const BenchArguments& arguments,
                           PublishedProgram program = paper::deliso);
ExactRuns measure_runs(const OpenedDataset& opened, const Options& options,
                       const BenchArguments& arguments);

// One run, as every measurement in one thread.
PublishedRuns run_once(const OpenedDataset& opened, const paper::Options& options,
                       PublishedProgram program = paper::deliso);
ExactRuns run_once(const OpenedDataset& opened, const Options& options);

// Everything as published, with the data set's number of lines.
paper::Options published_options(const OpenedDataset& opened);

// Seconds per point inserted by Recover and by Refine (Table 3).
double seconds_per_recover_insertion(const paper::Report& report);
double seconds_per_refine_insertion(const paper::Report& report);

// CPI_RC, CPI*_RC, CPI_RF, CPI*_RF (Table 4).
std::array<double, 4> computations_per_search(const paper::Report& report);

// A count as a cell.
template <class Count>
std::string count_of(Count n) {
  return count_cell(static_cast<double>(n));
}

// 4%; "one run" where there is nothing to spread.
std::string spread_cell(const Statistic& statistic);

void print_table(const Table& table, const BenchArguments& arguments);

}  // namespace deliso
