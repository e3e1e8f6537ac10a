// SPDX-License-Identifier: MIT
#include "support/runs.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <optional>
#include <string_view>
#include <utility>

#include "base/check.h"
#include "io/files/text_scan.h"

namespace deliso {
namespace {

// A warm-up of so many seconds is a measurement.
constexpr double kLongRun = 1;

constexpr const char* kOptions =
    "  --data FOLDER    where the volumes are (NAME.nhdr; default: $DELISO_DATA)\n"
    "  --only A,B       these data sets only, by name\n"
    "  --repeat N       measure N times after a warm-up (default 9)\n"
    "  --budget S       but no longer than S seconds per figure, once at least (default 8)\n"
    "  --figures FOLDER where plots go, as SVG (default: none)\n"
    "  --markdown, --csv  instead of aligned text\n"
    "  --manifest FILE  the list of data sets\n";

std::vector<Dataset> choose(std::vector<Dataset> all, const std::string& names) {
  if (names.empty()) return all;
  std::vector<Dataset> chosen;
  for (const std::string_view name : split(names, ',')) {
    const auto found = std::ranges::find(all, name, &Dataset::name);
    if (found == all.end()) throw InputError("--only ", name, ": no such data set");
    chosen.push_back(*found);
  }
  return chosen;
}

double positive(std::string_view option, const std::string& value) {
  const std::optional<double> number = number_in<double>(value);
  if (!number || !(*number > 0 && *number < 1e9)) {
    throw InputError(option, " ", value, ": not a positive number");
  }
  return *number;
}

template <class R, class Run>
Runs<R> run_in_time(Run&& run) {
  Runs<R> runs;
  runs.reports.emplace_back();
  const std::clock_t start = std::clock();
  runs.mesh = run(runs.reports.back());
  runs.seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  return runs;
}

// run() returns Runs<R> of one run.
template <class R, class Run>
Runs<R> measure(const BenchArguments& arguments, Run&& run) {
  Runs<R> runs = run();
  double spent = runs.seconds[0];
  const double first = spent;
  if (first < kLongRun) {
    runs.reports.clear();
    runs.seconds.clear();
  }
  while (runs.reports.size() < arguments.repeat &&
         (runs.reports.empty() || spent + first <= arguments.budget)) {
    Runs<R> next = run();
    spent += next.seconds[0];
    runs.reports.push_back(next.last());
    runs.seconds.push_back(next.seconds[0]);
    runs.mesh = std::move(next.mesh);
  }
  return runs;
}

}  // namespace

BenchArguments parse_bench_arguments(int argc, char** argv, const char* purpose) {
  BenchArguments arguments;
  if (const char* folder = std::getenv("DELISO_DATA")) arguments.data = folder;
  std::string manifest = DELISO_DATASETS, only;
  for (int n = 1; n < argc; ++n) {
    const std::string option = argv[n];
    if (option == "--help") {
      std::cout << purpose << "\n\n" << kOptions;
      std::exit(0);
    }
    if (option == "--markdown" || option == "--csv") {
      arguments.format = option == "--csv" ? TableFormat::csv : TableFormat::markdown;
      continue;
    }
    if (n + 1 == argc) throw InputError(option + ": unknown option, or its value is missing");
    const std::string value = argv[++n];
    if (option == "--data") {
      arguments.data = value;
    } else if (option == "--only") {
      only = value;
    } else if (option == "--repeat") {
      arguments.repeat = static_cast<std::size_t>(std::max(1., positive(option, value)));
    } else if (option == "--budget") {
      arguments.budget = positive(option, value);
    } else if (option == "--figures") {
      arguments.figures = value;
    } else if (option == "--manifest") {
      manifest = value;
    } else {
      throw InputError(option + " " + value + ": unknown");
    }
  }
  arguments.datasets = choose(read_datasets(manifest), only);
  return arguments;
}

int run_bench(int argc, char** argv, const char* purpose, int (*work)(const BenchArguments&)) {
  try {
    return work(parse_bench_arguments(argc, argv, purpose));
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 2;
  }
}

PublishedRuns run_once(const OpenedDataset& opened, const paper::Options& options,
                       PublishedProgram program) {
  return run_in_time<paper::Report>([&](paper::Report& report) {
    return program(opened.volume, opened.isovalue, options, report);
  });
}

ExactRuns run_once(const OpenedDataset& opened, const Options& options) {
  Options one_thread = options;
  one_thread.threads = 1;
  return run_in_time<Report>([&](Report& report) {
    return mesh_isosurface(opened.volume, opened.isovalue, one_thread, report);
  });
}

PublishedRuns measure_runs(const OpenedDataset& opened, const paper::Options& options,
                           const BenchArguments& arguments, PublishedProgram program) {
  return measure<paper::Report>(arguments, [&] { return run_once(opened, options, program); });
}

ExactRuns measure_runs(const OpenedDataset& opened, const Options& options,
                       const BenchArguments& arguments) {
  return measure<Report>(arguments, [&] { return run_once(opened, options); });
}

paper::Options published_options(const OpenedDataset& opened) {
  paper::Options options;
  options.lines = opened.lines;
  return options;
}

double seconds_per_recover_insertion(const paper::Report& report) {
  return report.seconds_recover / static_cast<double>(report.insertions_recover);
}

double seconds_per_refine_insertion(const paper::Report& report) {
  return report.seconds_refine / static_cast<double>(report.insertions_refine);
}

std::array<double, 4> computations_per_search(const paper::Report& report) {
  const auto quotient = [](std::uint64_t computations, std::uint64_t searches) {
    return static_cast<double>(computations) / static_cast<double>(searches);
  };
  const SearchCounters &rc = report.searches_recover, &rf = report.searches_refine;
  return {quotient(rc.computations, rc.searches),
          quotient(rc.computations_with_hit, rc.searches_with_hit),
          quotient(rf.computations, rf.searches),
          quotient(rf.computations_with_hit, rf.searches_with_hit)};
}

std::string spread_cell(const Statistic& statistic) {
  return statistic.count > 1 ? percent_cell(statistic.spread) : "one run";
}

void print_table(const Table& table, const BenchArguments& arguments) {
  static bool first = true;
  if (arguments.format == TableFormat::csv && !std::exchange(first, false)) std::cout << '\n';
  std::cout << table.print(arguments.format) << std::flush;
}

}  // namespace deliso
