// SPDX-License-Identifier: MIT
// Functions of the system that wasi-libc lacks. This file also stands in for app/signals.cpp and
// app/peak_memory.cpp: there are no signals here, and memory is measured otherwise.
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>

#include "app/peak_memory.h"
#include "app/signals.h"

namespace {

// Relative paths begin where the user is: in $PWD, a folder of the tree that the host grants.
[[gnu::constructor]] void enter_folder() {
  const char* const folder = std::getenv("PWD");
  if (folder) static_cast<void>(chdir(folder));
}

}  // namespace

extern "C" {

// Descriptors cannot be doubled. The standard ones stay open instead, see below.
int dup(int descriptor) {
  if (descriptor <= STDERR_FILENO) return descriptor;
  errno = EBADF;
  return -1;
}

// The linker puts this in place of close().
int __real_close(int descriptor);
int __wrap_close(int descriptor) {
  return descriptor <= STDERR_FILENO ? 0 : __real_close(descriptor);
}

// And this in place of fstat(): the program would take the size of a larger file modulo 2^32.
int __real_fstat(int descriptor, struct stat* status);
int __wrap_fstat(int descriptor, struct stat* status) {
  const int result = __real_fstat(descriptor, status);
  if (result != 0 || status->st_size <= static_cast<off_t>(SIZE_MAX)) return result;
  errno = EFBIG;
  return -1;
}

// Files have no modes.
int fchmod(int, mode_t) {
  return 0;
}

}  // extern "C"

namespace deliso {

void handle_signals() {}
DeferSignals::DeferSignals() : before_() {}
DeferSignals::~DeferSignals() {
  static_cast<void>(before_);
}

// Memory only grows.
std::uint64_t peak_memory_bytes() {
  constexpr std::uint64_t kPage = 65536;
  return kPage * __builtin_wasm_memory_size(0);
}

}  // namespace deliso
