// SPDX-License-Identifier: MIT
#include "base/parallel.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "base/cancel.h"

namespace deliso {

void for_each_task(int threads, std::size_t tasks, const std::function<void(std::size_t)>& task) {
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

}  // namespace deliso
