// SPDX-License-Identifier: MIT
// Times each block of a run, and each box of the seams, in one thread; says how long 2, 4, 8 and 16
// threads would take; and measures two beside it. The model has one queue of tasks, in the order of
// the program, and no other limit: no shared cache, no shared memory bandwidth. What is done
// between two rounds of boxes, and before and after all, is counted for one thread.
//   bench_blocks [INPUT ISOVALUE ...]
// Inputs as for `deliso`; by default built-in fields, about a minute.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <queue>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "deliso/mesh_isosurface.h"
#include "io/volume/builtin_volume.h"
#include "io/volume/read_volume.h"
#include "run/observer.h"

using namespace deliso;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point a, Clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

// The times of tasks that may run side by side: one set for the blocks, one for each round of
// boxes.
class TaskTimes : public Observer {
 public:
  void stage_begins(const char* stage) override {
    is_divided_ = std::string_view(stage) == "blocks" || std::string_view(stage) == "seams";
    if (is_divided_) sets_.emplace_back();
    last_ = Clock::now();
  }
  void steps_done(std::size_t, std::size_t) override {
    if (!is_divided_) return;
    const Clock::time_point now = Clock::now();
    sets_.back().push_back(seconds_between(std::exchange(last_, now), now));
  }

  double sum() const {
    double all = 0;
    for (const std::vector<double>& set : sets_) {
      for (const double seconds : set) all += seconds;
    }
    return all;
  }
  std::size_t tasks() const {
    std::size_t all = 0;
    for (const std::vector<double>& set : sets_) all += set.size();
    return all;
  }
  std::size_t blocks() const { return sets_.empty() ? 0 : sets_.front().size(); }
  // Returns the seconds that the sets would take one after the other.
  double in_threads(int threads) const {
    double all = 0;
    for (const std::vector<double>& set : sets_) {
      std::priority_queue<double, std::vector<double>, std::greater<>> free_at;
      for (int t = 0; t < threads; ++t) free_at.push(0);
      double last = 0;
      for (const double seconds : set) {
        const double done = free_at.top() + seconds;
        free_at.pop();
        free_at.push(done);
        last = std::max(last, done);
      }
      all += last;
    }
    return all;
  }

 private:
  bool is_divided_ = false;
  Clock::time_point last_;
  std::vector<std::vector<double>> sets_;
};

struct Run {
  double seconds = 0;
  std::size_t vertices = 0;
};

Run run(const Volume& volume, double isovalue, int threads, Observer* observer) {
  Options options;
  options.threads = threads;
  options.observer = observer;
  Report report;
  const Clock::time_point start = Clock::now();
  const TriMesh mesh = mesh_isosurface(volume, isovalue, options, report);
  return {seconds_between(start, Clock::now()), mesh.points.size()};
}

void print_row(const std::string& input, double isovalue) {
  constexpr int kRuns = 3;
  const Volume volume = read_volume(input);
  Run best;
  TaskTimes times;
  double two = 0;
  for (int n = 0; n < kRuns; ++n) {
    TaskTimes of_run;
    const Run one = run(volume, isovalue, 1, &of_run);
    if (n == 0 || one.seconds < best.seconds) {
      best = one;
      times = of_run;
    }
    const double seconds = run(volume, isovalue, 2, nullptr).seconds;
    two = n == 0 ? seconds : std::min(two, seconds);
  }
  const double alone = best.seconds - times.sum();
  std::printf("%-22s %9zu %6zu %6zu %8.3f %6.1f %%", input.substr(input.rfind('/') + 1).c_str(),
              best.vertices, times.blocks(), times.tasks() - times.blocks(), best.seconds,
              100 * alone / best.seconds);
  for (const int threads : {2, 4, 8, 16}) {
    std::printf(" %6.2f", best.seconds / (alone + times.in_threads(threads)));
  }
  std::printf(" %9.2f\n", best.seconds / two);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::printf("%-22s %9s %6s %6s %8s %8s %6s %6s %6s %6s %9s\n", "input", "vertices", "blocks",
              "boxes", "seconds", "alone", "2", "4", "8", "16", "2 is");
  if (argc > 1) {
    for (int n = 1; n + 1 < argc; n += 2) print_row(argv[n], std::strtod(argv[n + 1], nullptr));
    return 0;
  }
  for (const char* input : {"builtin:noise:96", "builtin:gyroid:192", "builtin:orbital:256"}) {
    print_row(input, find_builtin_field(input)->isovalue);
  }
}
