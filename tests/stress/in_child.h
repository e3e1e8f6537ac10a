// SPDX-License-Identifier: MIT
// Runs numbered cases in child processes, so that a crash or a hang costs one case.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <type_traits>

namespace deliso::stress {

// Limits the processor time of this process to `seconds` from now on.
inline void limit_cpu(unsigned seconds) {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto spent = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec + 1);
  const rlimit cpu{spent + seconds, RLIM_INFINITY};
  setrlimit(RLIMIT_CPU, &cpu);
}

template <class Verdict>
bool read_verdict(int from, Verdict& verdict) {
  char* to = reinterpret_cast<char*>(&verdict);
  for (std::size_t done = 0; done < sizeof verdict;) {
    const ssize_t n = read(from, to + done, sizeof verdict - done);
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

// Calls run(seed), which returns a Verdict, for seeds from `first` to `end`, each with `seconds` of
// processor time. A child runs seeds until one ends it; the next child goes on behind that seed.
// Calls take(seed, verdict) here for each, or died(seed, hung) for the one that ended a child.
// Returns false if no child can be started.
template <class Verdict, class Run, class Take, class Died>
bool run_in_children(std::uint64_t first, std::uint64_t end, unsigned seconds, const Run& run,
                     const Take& take, const Died& died) {
  static_assert(std::is_trivially_copyable_v<Verdict>);
  for (std::uint64_t seed = first; seed < end;) {
    int ends[2];
    if (pipe(ends) != 0) return false;
    std::fflush(stdout);
    const pid_t child = fork();
    if (child < 0) return false;
    if (child == 0) {
      close(ends[0]);
      for (; seed < end; ++seed) {
        limit_cpu(seconds);
        const Verdict verdict = run(seed);
        if (write(ends[1], &verdict, sizeof verdict) != static_cast<ssize_t>(sizeof verdict)) {
          _exit(1);
        }
      }
      _exit(0);
    }
    close(ends[1]);
    for (Verdict verdict; seed < end && read_verdict(ends[0], verdict); ++seed) {
      take(seed, verdict);
    }
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    if (seed == end) break;
    died(seed, WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU);
    ++seed;
  }
  return true;
}

}  // namespace deliso::stress
