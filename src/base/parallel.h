// SPDX-License-Identifier: MIT
// Runs work in several threads with the same result, to the byte, as in one. The tasks are the same
// for every number of threads. The result of a task depends on its number alone, not on its thread
// or time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace deliso {

// Calls task(n) once for every n below `tasks`, in at most `threads` threads, this one included.
// Tasks begin in order. If tasks throw, rethrows the exception of the smallest n, whatever the
// number of threads; later tasks may not have run. Polls for cancellation before every task.
void for_each_task(int threads, std::size_t tasks, const std::function<void(std::size_t)>& task);

// Returns how many runs of at most `grain` elements cover `size` elements.
inline std::size_t runs_of(std::size_t size, std::size_t grain) {
  return (size + grain - 1) / grain;
}
// As for_each_task, for runs of at most `grain` of `size` elements. Calls task(begin, end), or with
// the number of the run task(n, begin, end).
template <class Task>
void for_each_run(int threads, std::size_t size, std::size_t grain, Task&& task) {
  for_each_task(threads, runs_of(size, grain), [&](std::size_t n) {
    const std::size_t begin = n * grain, end = std::min(size, begin + grain);
    if constexpr (requires { task(n, begin, end); }) {
      task(n, begin, end);
    } else {
      task(begin, end);
    }
  });
}

}  // namespace deliso
