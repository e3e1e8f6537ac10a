// SPDX-License-Identifier: MIT
// Where the time of the stages goes, for the benchmarks: sums of a steady clock and histograms,
// kept only when asked for (Options::profile). Without it the cost is a test of a pointer per
// insertion; with it, some clock readings per insertion. Nothing is decided by it.
#pragma once

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "isosurface/isosurface.h"

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

struct Profile {
  // Parts of Recover by the paper's way, in seconds: searches of Voronoi edges for Sigma; conflict
  // zones and the new cells in them; Disk tests. What is left of Report::seconds_recover are
  // records, criteria and queues.
  double seconds_search = 0, seconds_triangulation = 0, seconds_disk_tests = 0;
  InsertionHistograms recover;  // paper's way
  InsertionHistograms refine;
};

// Adds the time from its birth to its end to a sum, if there is one.
class ProfiledTime {
 public:
  explicit ProfiledTime(double* seconds) : seconds_(seconds) {
    if (seconds_) start_ = std::chrono::steady_clock::now();
  }
  ProfiledTime(const ProfiledTime&) = delete;
  ProfiledTime& operator=(const ProfiledTime&) = delete;
  ~ProfiledTime() {
    if (!seconds_) return;
    *seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  double* seconds_;
  std::chrono::steady_clock::time_point start_;
};

// Follows one insertion at a time.
class InsertionWatch {
 public:
  explicit InsertionWatch(InsertionHistograms* histograms) : histograms_(histograms) {}

  void start(const SearchCounters& counters) {
    if (!histograms_) return;
    searches_before_ = counters.searches;
    start_ = std::chrono::steady_clock::now();
  }
  // The insertion begun last was done.
  void done(const SearchCounters& counters) {
    if (!histograms_) return;
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start_;
    histograms_->add(time.count(), counters.searches - searches_before_);
  }

 private:
  InsertionHistograms* histograms_;
  std::uint64_t searches_before_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace deliso
