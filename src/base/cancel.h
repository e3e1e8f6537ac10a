// SPDX-License-Identifier: MIT
// Lets a host program stop the work that it asked for. The work polls a flag of the host's; every
// call has its own flag, so that calls in several threads are independent.
#pragma once

#include <atomic>
#include <exception>

namespace deliso {

// Thrown by work that its host stops.
struct Canceled : std::exception {
  const char* what() const noexcept override { return "canceled"; }
};

// During its lifetime the work of this thread, and of the threads that it starts (base/parallel.h),
// polls `flag`. The flag may be null, and is set by any thread or by a signal handler.
class CancelScope {
 public:
  explicit CancelScope(const volatile int* flag) : before_(current) { current = flag; }
  ~CancelScope() { current = before_; }
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;

  static const volatile int* flag() { return current; }

 private:
  static inline constinit thread_local const volatile int* current = nullptr;
  const volatile int* before_;
};

// Throws Canceled if the flag of this thread's scope is set.
inline void throw_if_canceled() {
  int* const flag = const_cast<int*>(CancelScope::flag());
  if (flag && std::atomic_ref(*flag).load(std::memory_order_relaxed) != 0) throw Canceled();
}

}  // namespace deliso
