// SPDX-License-Identifier: MIT
// Profiles Recover by the paper's way (Options::paper()). The paper's §3.2 gives 80 to 85 % for
// finding new restricted simplices. Also counts searches per insertion in both stages, and the
// distribution of the times of insertions. Half a minute on the paper's volumes.
#include <cmath>
#include <numeric>

#include "support/line_chart.h"
#include "support/runs.h"
#include "view/trace/profile.h"

using namespace deliso;

namespace {

using Nanoseconds = decltype(InsertionHistograms::nanoseconds);

double bin_begin(std::size_t n) {
  return std::exp2(static_cast<double>(n) / static_cast<double>(InsertionHistograms::kPerOctave));
}

std::uint64_t total(const Nanoseconds& bins) {
  return std::accumulate(bins.begin(), bins.end(), std::uint64_t{0});
}

// Microseconds that a share q of the insertions does not pass: the upper end of its bin.
double quantile(const Nanoseconds& bins, double q) {
  const double wanted = q * static_cast<double>(total(bins));
  double seen = 0;
  for (std::size_t n = 0; n < bins.size(); ++n) {
    seen += static_cast<double>(bins[n]);
    if (seen >= wanted && seen > 0) return 1e-3 * bin_begin(n + 1);
  }
  return NAN;
}

double microseconds_of_largest(const Nanoseconds& bins) {
  for (std::size_t n = bins.size(); n > 0; --n) {
    if (bins[n - 1] > 0) return 1e-3 * bin_begin(n);
  }
  return NAN;
}

// From the first to the last bin that would be seen, with the empty ones between: a line over them
// would show insertions where there are none.
Series time_series(const std::string& name, const Nanoseconds& bins) {
  Series series{name, {}};
  const double all = static_cast<double>(total(bins));
  std::size_t shown = 0;
  for (std::size_t n = 0; n < bins.size(); ++n) {
    const double center = std::sqrt(bin_begin(n) * bin_begin(n + 1));
    const double share = 100 * static_cast<double>(bins[n]) / all;
    if (share < 0.05 && shown == 0) continue;
    series.points.emplace_back(1e-3 * center, share);
    if (share >= 0.05) shown = series.points.size();
  }
  series.points.resize(shown);
  return series;
}

Series search_series(const std::string& name, const InsertionHistograms& histograms) {
  Series series{name, {}};
  const auto& bins = histograms.searches;
  const double all =
      static_cast<double>(std::accumulate(bins.begin(), bins.end(), std::uint64_t{0}));
  for (std::size_t n = 0; n < 81; ++n) {
    series.points.emplace_back(n, 100 * static_cast<double>(bins[n]) / all);
  }
  return series;
}

double mean_searches(const InsertionHistograms& histograms) {
  double sum = 0, all = 0;
  for (std::size_t n = 0; n < histograms.searches.size(); ++n) {
    sum += static_cast<double>(n) * static_cast<double>(histograms.searches[n]);
    all += static_cast<double>(histograms.searches[n]);
  }
  return sum / all;
}

int work(const BenchArguments& arguments) {
  Table parts("Where Recover's time goes, paper's way",
              {"data set", "data", "recover s", "search", "triangulation", "disk tests", "rest",
               "searches per insertion", "us per search", "with a hit", "clock's own"},
              2);
  Table times("Single insertions: searches, and microseconds that a share of them does not pass",
              {"data set", "data", "RC searches", "RC 50%", "90%", "99%", "99.9%", "longest",
               "RF searches", "RF 50%", "90%", "99%", "99.9%", "longest"},
              2);
  LineChart time_chart{
      "Times of single insertions", {"microseconds", true}, {"% of insertions"}, {}};
  LineChart search_chart{"Searches of single insertions", {"searches"}, {"% of insertions"}, {}};
  time_chart.markers = search_chart.markers = false;
  for (const Dataset& dataset : arguments.datasets) {
    const OpenedDataset opened = open_dataset(dataset, arguments.data);
    // Stand-ins are for those who have no data at all.
    if (opened.is_analogue && !arguments.data.empty()) continue;
    const Options plain = paper_options(arguments);
    const Runs without = measure_runs(opened, plain, arguments);
    // The quickest run has least of other programs in its histograms.
    Profile profile;
    Report report;
    for (std::size_t n = 0; n < without.reports.size(); ++n) {
      Profile next;
      Options profiled = plain;
      profiled.observer = &next;
      const Report r = run_once(opened, profiled).last();
      if (n > 0 && r.seconds_recover >= report.seconds_recover) continue;
      report = r;
      profile = next;
    }

    const double seconds = report.seconds_recover;
    const double rest = seconds - profile.seconds(Activity::search) -
                        profile.seconds(Activity::triangulation) -
                        profile.seconds(Activity::disk_test);
    const SearchCounters& searches = report.searches_recover;
    const double n = static_cast<double>(searches.searches);
    const Statistic recover = without.of([](const Report& r) { return r.seconds_recover; });
    parts.add({dataset.name, opened.data, fixed_cell(recover.median, 3),
               percent_cell(profile.seconds(Activity::search) / seconds),
               percent_cell(profile.seconds(Activity::triangulation) / seconds),
               percent_cell(profile.seconds(Activity::disk_test) / seconds),
               percent_cell(rest / seconds), fixed_cell(mean_searches(profile.recover), 1),
               fixed_cell(1e6 * profile.seconds(Activity::search) / n, 2),
               percent_cell(static_cast<double>(searches.searches_with_hit) / n),
               percent_cell(seconds / recover.median - 1)});
    std::vector<std::string> row{dataset.name, opened.data};
    for (const InsertionHistograms* h : {&profile.recover, &profile.refine}) {
      row.push_back(fixed_cell(mean_searches(*h), 1));
      for (const double q : {0.5, 0.9, 0.99, 0.999}) {
        row.push_back(fixed_cell(quantile(h->nanoseconds, q), 1));
      }
      row.push_back(fixed_cell(microseconds_of_largest(h->nanoseconds), 0));
    }
    times.add(std::move(row));
    for (const std::string& remark : opened.remarks) parts.remark(remark);

    // The plots show one large and one small data set.
    if (dataset.name != "ENGINE" && dataset.name != "FUEL") continue;
    for (const auto& [stage, histograms] :
         {std::pair{" Recover", &profile.recover}, std::pair{" Refine", &profile.refine}}) {
      time_chart.series.push_back(time_series(dataset.name + stage, histograms->nanoseconds));
      search_chart.series.push_back(search_series(dataset.name + stage, *histograms));
    }
  }
  parts.remark(
      "Search: Voronoi edges against the surface, those of the initial sample too. Triangulation: "
      "conflict zones and new cells. Rest: keeping hits with their facets, criteria, queues. The "
      "clock's own: how much longer Recover took with the clock readings.");
  times.remark("Bins are a quarter of an octave wide; a quantile is the upper end of its bin.");
  print_table(parts, arguments);
  print_table(times, arguments);
  write_chart(time_chart, arguments.figures, "insertion-times");
  write_chart(search_chart, arguments.figures, "insertion-searches");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_bench(argc, argv,
                   "Where Recover's time goes by the paper's way, and times of single insertions.",
                   work);
}
