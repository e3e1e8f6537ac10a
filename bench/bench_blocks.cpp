// SPDX-License-Identifier: MIT
// Times each block of a run, and each box of the seams, in one thread, by the processor's time; and
// says how much faster 2, 4, 8, 16 and 64 threads would be. The model has one queue of tasks, in
// the order of the program, and no other limit: no shared cache, no shared memory bandwidth. What
// is done between two rounds of boxes, and before and after all, is counted for one thread.
//   bench_blocks [INPUT ISOVALUE ...]
// Inputs as for `deliso`; by default built-in fields, about a minute.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <queue>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/memory.h"
#include "deliso/mesh_isosurface.h"
#include "io/volume/builtin_volume.h"
#include "io/volume/read_volume.h"
#include "run/observer.h"

using namespace deliso;

namespace {

constexpr int kThreads[] = {2, 4, 8, 16, 64};

// CPU seconds of the process, the system's for it included.
double now() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// The times of tasks that may run side by side: one set for the blocks, one for each round of
// boxes.
class TaskTimes : public Observer {
 public:
  void stage_begins(const char* stage) override {
    is_divided_ = std::string_view(stage) == "blocks" || std::string_view(stage) == "seams";
    if (is_divided_) sets_.emplace_back();
    last_ = now();
  }
  void steps_done(std::size_t, std::size_t) override {
    if (!is_divided_) return;
    const double at = now();
    sets_.back().push_back(at - std::exchange(last_, at));
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
  double last_ = 0;
  std::vector<std::vector<double>> sets_;
};

struct Run {
  double seconds = 0;
  std::size_t vertices = 0;
};

Run run(const Volume& volume, double isovalue, Observer& observer) {
  Options options;
  options.threads = 1;
  options.observer = &observer;
  Report report;
  const double start = now();
  const TriMesh mesh = mesh_isosurface(volume, isovalue, options, report);
  return {now() - start, mesh.points.size()};
}

void print_row(const std::string& input, double isovalue) {
  constexpr int kRuns = 3;
  const Volume volume = read_volume(input);
  Run best;
  TaskTimes times;
  for (int n = 0; n < kRuns; ++n) {
    TaskTimes of_run;
    const Run one = run(volume, isovalue, of_run);
    if (n == 0 || one.seconds < best.seconds) {
      best = one;
      times = of_run;
    }
  }
  const double alone = best.seconds - times.sum();
  std::printf("%-22s %9zu %6zu %6zu %8.3f %6.1f %%", input.substr(input.rfind('/') + 1).c_str(),
              best.vertices, times.blocks(), times.tasks() - times.blocks(), best.seconds,
              100 * alone / best.seconds);
  for (const int threads : kThreads) {
    std::printf(" %6.2f", best.seconds / (alone + times.in_threads(threads)));
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();  // as the program does
  std::printf("%-22s %9s %6s %6s %8s %8s", "input", "vertices", "blocks", "boxes", "seconds",
              "alone");
  for (const int threads : kThreads) std::printf(" %6d", threads);
  std::printf("\n");
  if (argc > 1) {
    for (int n = 1; n + 1 < argc; n += 2) print_row(argv[n], std::strtod(argv[n + 1], nullptr));
    return 0;
  }
  for (const char* input : {"builtin:noise:96", "builtin:gyroid:192", "builtin:orbital:256"}) {
    print_row(input, find_builtin_field(input)->isovalue);
  }
}
