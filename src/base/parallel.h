// SPDX-License-Identifier: MIT
// Runs work in several threads with the same result, to the byte, as in one. The tasks are the same
// for every number of threads. The result of a task depends on its number alone, not on its thread
// or time.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/cancel.h"

namespace deliso {

// Calls task(n) once for every n below `tasks`, in at most `threads` threads, this one included.
// Tasks begin in order. If tasks throw, rethrows the exception of the smallest n, whatever the
// number of threads; later tasks may not have run. Polls for cancellation before every task.
template <class Task>
void for_each_task(int threads, std::size_t tasks, Task&& task) {
  if (threads <= 1 || tasks <= 1) {
    for (std::size_t n = 0; n < tasks; ++n) {
      throw_if_canceled();
      task(n);
    }
    return;
  }
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::size_t failed = tasks;
  std::exception_ptr thrown;
  const auto work = [&, flag = CancelScope::flag()] {
    const CancelScope scope(flag);
    for (std::size_t n = next++; n < tasks; n = next++) {
      try {
        throw_if_canceled();
        task(n);
      } catch (...) {
        const std::lock_guard lock(mutex);
        next = tasks;
        if (n < failed) {
          failed = n;
          thrown = std::current_exception();
        }
      }
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (std::size_t n = 1; n < std::min(tasks, static_cast<std::size_t>(threads)); ++n) {
        others.emplace_back(work);
      }
    } catch (const std::system_error&) {
      // The system grants no more threads: the ones that started do all the tasks.
    }
    work();
  }
  if (thrown) std::rethrow_exception(thrown);
}

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
