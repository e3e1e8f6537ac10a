// SPDX-License-Identifier: MIT
#include "support/quality_table.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "base/text.h"
#include "support/statistics.h"

namespace deliso {
namespace {

// The same volume with the same options.
struct Subject {
  std::string volume, options;
  bool operator==(const Subject&) const = default;

  std::string name() const { return options.empty() ? volume : volume + " " + options; }
};

template <class T>
void add_once(std::vector<T>& all, const T& item) {
  if (std::find(all.begin(), all.end(), item) == all.end()) all.push_back(item);
}

// The runs of one build on one subject, per metric.
class Group {
 public:
  Group(const std::vector<QualityRun>& runs, const std::string& build, const Subject& subject) {
    for (const QualityRun& run : runs) {
      if (run.build != build || Subject{run.volume, run.options} != subject) continue;
      ++count_;
      for (std::size_t n = 0; n < kMetrics; ++n) {
        const double value = run.measured.values[n];
        if (!std::isnan(value)) values_[n].push_back(value);
      }
    }
  }

  std::size_t count() const { return count_; }
  const std::vector<double>& values(std::size_t n) const { return values_[n]; }

 private:
  std::size_t count_ = 0;
  std::array<std::vector<double>, kMetrics> values_;
};

std::string number_cell(double value, int decimals) {
  return decimals == 0 ? count_cell(value) : fixed_cell(value, decimals);
}

// "31,105 (30,990-31,200)".
std::string range_cell(const std::vector<double>& values, int decimals) {
  if (values.empty()) return "-";
  const Statistic s = statistic(values);
  const std::string smallest = number_cell(s.smallest, decimals);
  const std::string largest = number_cell(s.largest, decimals);
  const std::string median = number_cell(s.median, decimals);
  return smallest == largest ? median : median + " (" + smallest + "-" + largest + ")";
}

std::string cell(const Group& group, std::size_t n) {
  const std::vector<double>& values = group.values(n);
  if (static_cast<Metric>(n) != Metric::exact || values.empty()) {
    return range_cell(values, kMetricTable[n].decimals);
  }
  const auto exact = static_cast<std::size_t>(std::count(values.begin(), values.end(), 1.));
  if (exact == values.size()) return "yes";
  return exact == 0 ? "no" : text(exact, " of ", values.size());
}

constexpr std::array kFirst{
    Metric::vertices,  Metric::cpu_seconds, Metric::needles,     Metric::needles_above_r_min,
    Metric::min_angle, Metric::facets_left, Metric::facets_over, Metric::failed};
constexpr std::array kSecond{Metric::points_left, Metric::points_far,  Metric::mesh_mean,
                             Metric::mesh_999,    Metric::mesh_max,    Metric::surface_mean,
                             Metric::surface_999, Metric::surface_max, Metric::restricted,
                             Metric::crossings,   Metric::exact,       Metric::other_faults};

Table make_table(const std::string& title, std::span<const Metric> metrics,
                 const std::vector<std::string>& builds, const std::vector<Subject>& subjects,
                 const std::vector<QualityRun>& runs) {
  std::vector<std::string> header{"volume", "build", "runs"};
  for (const Metric m : metrics) {
    header.emplace_back(kMetricTable[static_cast<std::size_t>(m)].heading);
  }
  Table table(title, header, 2);
  for (const Subject& subject : subjects) {
    std::vector<Group> groups;
    for (const std::string& build : builds) groups.emplace_back(runs, build, subject);
    for (std::size_t b = 0; b < builds.size(); ++b) {
      if (groups[b].count() == 0) continue;
      std::vector<std::string> row{subject.name(), builds[b],
                                   count_cell(static_cast<double>(groups[b].count()))};
      for (const Metric m : metrics) {
        const auto n = static_cast<std::size_t>(m);
        row.push_back(cell(groups[b], n));
        if (b > 0 || builds.size() == 1) continue;
        const Verdict verdict =
            compare(groups[0].values(n), groups[1].values(n), kMetricTable[n].better);
        if (verdict != Verdict::alike) row.back() += verdict == Verdict::better ? " +" : " !";
      }
      table.add(std::move(row));
    }
  }
  std::string legend;
  for (const Metric m : metrics) {
    const MetricRow& row = kMetricTable[static_cast<std::size_t>(m)];
    legend += text(legend.empty() ? "" : "; ", row.heading, ": ", row.meaning);
  }
  table.remark(legend + ".");
  return table;
}

// On how many subjects the first build is better or worse, and the ratio of its medians to the
// second's: their geometric mean over the subjects where neither is 0.
Table make_summary(const std::vector<std::string>& builds, const std::vector<Subject>& subjects,
                   const std::vector<QualityRun>& runs) {
  Table table(builds[0] + " against " + builds[1],
              {"metric", "better on", "worse on", "of", "ratio of medians"}, 1);
  for (std::size_t n = 0; n < kMetrics; ++n) {
    const MetricRow& metric = kMetricTable[n];
    std::array<std::size_t, 3> verdicts{};
    double logarithms = 0, ratios = 0;
    for (const Subject& subject : subjects) {
      const Group ours(runs, builds[0], subject), theirs(runs, builds[1], subject);
      if (ours.values(n).empty() || theirs.values(n).empty()) continue;
      ++verdicts[static_cast<std::size_t>(
          compare(ours.values(n), theirs.values(n), metric.better))];
      const double a = statistic(ours.values(n)).median, b = statistic(theirs.values(n)).median;
      if (!(a > 0 && b > 0)) continue;
      logarithms += std::log(a / b);
      ++ratios;
    }
    const auto [alike, better, worse] = verdicts;
    if (alike + better + worse == 0) continue;
    table.add({std::string(metric.heading), count_cell(static_cast<double>(better)),
               count_cell(static_cast<double>(worse)),
               count_cell(static_cast<double>(alike + better + worse)),
               fixed_cell(ratios > 0 ? std::exp(logarithms / ratios) : NAN, 3)});
  }
  table.remark(
      "Better, worse: volumes on which the ranges over the turns do not overlap; + and ! above. "
      "With one turn that is any difference.");
  return table;
}

// A column of switch_table(): what is told of a run, and how the runs become one number. `ratio`:
// the medians of the volumes over the base's, their geometric mean; `runs`: the sum of all runs.
enum class Over : std::uint8_t { ratio, mean, most, sum, runs };
struct SwitchMeasure {
  const char* heading;
  Over over;
  int decimals;
  Better better;
  double (*of)(const Measured& run);
};
constexpr std::array<SwitchMeasure, 9> kSwitchMeasures{{
    {"vertices", Over::ratio, 3, Better::less,
     [](const Measured& m) { return m[Metric::vertices]; }},
    {"time", Over::mean, 2, Better::less, [](const Measured& m) { return m[Metric::time_ratio]; }},
    {"99.9 %", Over::mean, 3, Better::less,
     [](const Measured& m) { return std::fmax(m[Metric::mesh_999], m[Metric::surface_999]); }},
    {"largest", Over::most, 2, Better::less,
     [](const Measured& m) { return std::fmax(m[Metric::mesh_max], m[Metric::surface_max]); }},
    {"far", Over::sum, 0, Better::less, [](const Measured& m) { return m[Metric::points_far]; }},
    {"over", Over::sum, 0, Better::less, [](const Measured& m) { return m[Metric::facets_over]; }},
    {"r/l > 2", Over::sum, 0, Better::less, [](const Measured& m) { return m[Metric::needles]; }},
    {"restricted %", Over::mean, 3, Better::more,
     [](const Measured& m) { return m[Metric::restricted]; }},
    {"faulty", Over::runs, 0, Better::less,
     [](const Measured& m) {
       const bool is_sound = m[Metric::failed] == 0 && m[Metric::exact] == 1 &&
                             m[Metric::crossings] == 0 && m[Metric::other_faults] == 0;
       return is_sound ? 0. : 1.;
     }},
}};
constexpr std::size_t kPaysOn = 3;  // volumes

// One build with some options, beside the base.
class SwitchRow {
 public:
  SwitchRow(const std::vector<QualityRun>& runs, std::string base, std::string build,
            std::string options)
      : runs_(runs),
        base_(std::move(base)),
        build_(std::move(build)),
        options_(std::move(options)) {
    for (const QualityRun& run : runs) {
      if (run.build == build_ && run.options == options_) add_once(volumes_, run.volume);
    }
  }

  bool is_empty() const { return volumes_.empty(); }

  std::vector<std::string> cells() const {
    const std::string name = build_ == base_ ? "(none)" : build_.substr(0, build_.rfind('.'));
    std::vector<std::string> row{options_.empty() ? name : name + " " + options_};
    bool pays = false;
    for (const SwitchMeasure& measure : kSwitchMeasures) {
      const std::size_t worse = volumes_with(Verdict::worse, measure);
      const std::size_t better = volumes_with(Verdict::better, measure);
      row.push_back(number_cell(total(measure), measure.decimals) +
                    (better > 0 ? text(" +", better) : "") + (worse > 0 ? text(" !", worse) : ""));
      pays |= worse >= kPaysOn;
    }
    row.push_back(build_ == base_ ? "" : pays ? "yes" : "no");
    return row;
  }

 private:
  std::vector<double> values(const SwitchMeasure& measure, const std::string& build,
                             const std::string& volume) const {
    std::vector<double> all;
    for (const QualityRun& run : runs_) {
      if (run.build != build || run.volume != volume || run.options != options_) continue;
      const double value = measure.of(run.measured);
      if (!std::isnan(value)) all.push_back(value);
    }
    return all;
  }

  std::size_t volumes_with(Verdict verdict, const SwitchMeasure& measure) const {
    return static_cast<std::size_t>(
        std::count_if(volumes_.begin(), volumes_.end(), [&](const std::string& volume) {
          return compare(values(measure, build_, volume), values(measure, base_, volume),
                         measure.better) == verdict;
        }));
  }

  double total(const SwitchMeasure& measure) const {
    double sum = 0, most = 0, logarithms = 0, all = 0, count = 0;
    for (const std::string& volume : volumes_) {
      const std::vector<double> runs = values(measure, build_, volume);
      if (runs.empty()) continue;
      const double median = statistic(runs).median;
      sum += median;
      most = std::max(most, median);
      logarithms += std::log(median / statistic(values(measure, base_, volume)).median);
      all += std::accumulate(runs.begin(), runs.end(), 0.);
      ++count;
    }
    if (count == 0) return NAN;
    switch (measure.over) {
      case Over::ratio:
        return std::exp(logarithms / count);
      case Over::mean:
        return sum / count;
      case Over::most:
        return most;
      case Over::sum:
        return sum;
      case Over::runs:
        break;
    }
    return all;
  }

  const std::vector<QualityRun>& runs_;
  const std::string base_, build_, options_;
  std::vector<std::string> volumes_;
};

}  // namespace

Verdict compare(const std::vector<double>& ours, const std::vector<double>& theirs, Better better) {
  const auto known = [](const std::vector<double>& values) {
    std::vector<double> left;
    std::copy_if(values.begin(), values.end(), std::back_inserter(left),
                 [](double value) { return !std::isnan(value); });
    return left;
  };
  const Statistic a = statistic(known(ours)), b = statistic(known(theirs));
  if (a.count == 0 || b.count == 0) return Verdict::alike;
  if (a.largest < b.smallest) return better == Better::less ? Verdict::better : Verdict::worse;
  if (b.largest < a.smallest) return better == Better::less ? Verdict::worse : Verdict::better;
  return Verdict::alike;
}

std::vector<Table> quality_tables(const std::vector<QualityRun>& runs) {
  std::vector<std::string> builds;
  std::vector<Subject> subjects;
  for (const QualityRun& run : runs) {
    add_once(builds, run.build);
    if (run.build == builds[0]) add_once(subjects, Subject{run.volume, run.options});
  }
  if (builds.size() > 2) builds.resize(2);
  std::vector<Table> tables{
      make_table("Size, time and shape", kFirst, builds, subjects, runs),
      make_table("Distances in voxels, and what must hold", kSecond, builds, subjects, runs)};
  if (builds.size() == 2) tables.push_back(make_summary(builds, subjects, runs));
  return tables;
}

Table switch_table(const std::vector<QualityRun>& runs) {
  std::vector<std::string> builds, options, header{"switch"};
  for (const QualityRun& run : runs) {
    add_once(builds, run.build);
    add_once(options, run.options);
  }
  for (const SwitchMeasure& measure : kSwitchMeasures) header.emplace_back(measure.heading);
  header.emplace_back("pays");
  Table table("Switches", header, 1);
  for (const std::string& build : builds) {
    for (const std::string& some : options) {
      const SwitchRow row(runs, builds[0], build, some);
      if (!row.is_empty()) table.add(row.cells());
    }
  }
  return table;
}

}  // namespace deliso
