// SPDX-License-Identifier: MIT
// Where the time of the stages goes, for the benchmarks: sums of a steady clock and histograms,
// kept only by a run that it observes. Without it the cost is a test of a pointer per
// insertion; with it, some clock readings per insertion. Nothing is decided by it.
#pragma once

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "surface/observer.h"
#include "surface/report.h"

namespace deliso {

// How long an insertion took and how many searches it made, over all insertions of a stage.
struct InsertionHistograms {
  static constexpr std::size_t kPerOctave = 4;
  // Bin n: nanoseconds from 2^(n / kPerOctave); the last also holds all above.
  std::array<std::uint64_t, 32 * kPerOctave> nanoseconds{};
  std::array<std::uint64_t, 256> searches{};  // bin n: n searches; the last also holds all above

  void add(double ns, std::uint64_t search_count) {
    const double bin = static_cast<double>(kPerOctave) * std::log2(ns < 1 ? 1 : ns);
    ++nanoseconds[bin < static_cast<double>(nanoseconds.size()) ? static_cast<std::size_t>(bin)
                                                                : nanoseconds.size() - 1];
    ++searches[search_count < searches.size() ? search_count : searches.size() - 1];
  }
};

class Profile : public Observer {
 public:
  bool follows_insertions() const override { return true; }
  void work_begins(Activity activity, const SearchCounters& searches) override {
    Measured& m = measured_[static_cast<std::size_t>(activity)];
    m.begin = Clock::now();
    m.searches = searches.searches;
  }
  void work_ends(Activity activity, const SearchCounters& searches) override {
    Measured& m = measured_[static_cast<std::size_t>(activity)];
    const std::chrono::duration<double> time = Clock::now() - m.begin;
    m.seconds += time.count();
    if (activity != Activity::insertion) return;
    (is_refining_ ? refine : recover).add(1e9 * time.count(), searches.searches - m.searches);
  }
  void recovery_finished() override { is_refining_ = true; }

  // Of Recover by the paper's way: searches of Voronoi edges for Sigma; conflict zones and the new
  // cells in them; Disk tests. What is left of Report::seconds_recover are records, criteria and
  // queues.
  double seconds(Activity activity) const {
    return measured_[static_cast<std::size_t>(activity)].seconds;
  }
  InsertionHistograms recover;  // paper's way
  InsertionHistograms refine;

 private:
  using Clock = std::chrono::steady_clock;
  struct Measured {
    double seconds = 0;
    Clock::time_point begin;
    std::uint64_t searches = 0;
  };
  std::array<Measured, static_cast<std::size_t>(Activity::count_)> measured_;
  bool is_refining_ = false;
};

}  // namespace deliso
