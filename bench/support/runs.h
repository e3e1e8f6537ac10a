// SPDX-License-Identifier: MIT
// What the table and study programs share: their arguments, and meshing with the clock running.
#pragma once

#include <string>
#include <vector>

#include "deliso/deliso.h"
#include "support/datasets.h"
#include "support/statistics.h"
#include "support/table.h"

namespace deliso {

struct BenchArguments {
  std::string data;               // folder of volumes; empty: none
  std::vector<Dataset> datasets;  // those asked for, all by default
  TableFormat format = TableFormat::text;
  std::size_t repeat = 3;
  double budget = 8;  // seconds, of all runs of one measurement
  CubicMethod cubic = CubicMethod::isolation;
  std::string figures;  // folder for plots; empty: none are written
};

// Reads the arguments; --help prints `purpose` and ends the program. Throws InputError.
BenchArguments parse_bench_arguments(int argc, char** argv, const char* purpose);

// Runs the program's work; InputErrors become one line on standard error and exit status 2.
int run_bench(int argc, char** argv, const char* purpose, int (*work)(const BenchArguments&));

// Every run of one measurement, of the same bytes each.
struct Runs {
  std::vector<Report> reports;  // without the warm-up
  TriMesh mesh;                 // of the last one

  const Report& last() const { return reports.back(); }
  // Of a step, or of anything computed from a report.
  template <class F>
  Statistic of(F seconds) const {
    std::vector<double> values;
    for (const Report& report : reports) values.push_back(seconds(report));
    return statistic(std::move(values));
  }
  Statistic total() const {
    return of([](const Report& r) { return r.seconds_total; });
  }
};

// Meshes once to warm up and then up to arguments.repeat times, while arguments.budget lasts. A
// first run of a second and more counts as well: what it warms up no longer shows.
Runs measure_runs(const OpenedDataset& opened, const Options& options,
                  const BenchArguments& arguments);

// One run, as every measurement in one thread.
Runs run_once(const OpenedDataset& opened, const Options& options);

// Everything as published; the same criteria with the certified way through Recover; and what a run
// without options does.
Options paper_options(const BenchArguments& arguments);
Options certified_options(const BenchArguments& arguments);
Options default_options(const BenchArguments& arguments);

// Seconds per point inserted by Recover and by Refine (Table 3).
double seconds_per_recover_insertion(const Report& report);
double seconds_per_refine_insertion(const Report& report);

// 4%; "one run" where there is nothing to spread.
std::string spread_cell(const Statistic& statistic);

void print_table(const Table& table, const BenchArguments& arguments);

}  // namespace deliso
