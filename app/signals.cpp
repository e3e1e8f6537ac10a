// SPDX-License-Identifier: MIT
#include "app/signals.h"

#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "app/run.h"

namespace deliso {
namespace {

// A signal handler may neither allocate nor use the C library's files. So it reads the list of
// mappings byte by byte (proc(5), "address-address permissions offset device inode path").

// Reads one line of the list, without its end. Returns false if there is none.
bool read_line(int file, char* line, std::size_t room) {
  std::size_t size = 0;
  char c;
  ssize_t count;
  while ((count = read(file, &c, 1)) == 1 && c != '\n') {
    if (size + 1 < room) line[size++] = c;
  }
  line[size] = '\0';
  return count == 1 || size > 0;
}

std::uintptr_t take_hexadecimal(const char*& at) {
  std::uintptr_t value = 0;
  for (;; ++at) {
    const int digit = *at >= '0' && *at <= '9'   ? *at - '0'
                      : *at >= 'a' && *at <= 'f' ? *at - 'a' + 10
                                                 : -1;
    if (digit < 0) return value;
    value = value << 4 | static_cast<std::uintptr_t>(digit);
  }
}

void say(const char* text) {
  const ssize_t ignored = write(STDERR_FILENO, text, std::strlen(text));
  static_cast<void>(ignored);
}

void on_bus_error(int signal, siginfo_t* info, void*) {
  const auto where = reinterpret_cast<std::uintptr_t>(info->si_addr);
  const int list = open("/proc/self/maps", O_RDONLY | O_CLOEXEC);
  char line[4352];  // a path has 4096 bytes at most
  const bool of_memory = info->si_code == BUS_ADRERR;
  while (of_memory && list >= 0 && read_line(list, line, sizeof line)) {
    const char* at = line;
    const std::uintptr_t begin = take_hexadecimal(at);
    const std::uintptr_t end = take_hexadecimal(*at == '-' ? ++at : at);
    const char* const path = std::strchr(at, '/');
    if (where < begin || where >= end || path == nullptr) continue;
    // Several threads may reach the end of the file at once: only the first reports it.
    static std::atomic_flag is_said;
    while (is_said.test_and_set()) pause();
    if (isatty(STDERR_FILENO) != 0) say("\r\033[K");  // over a progress bar
    say("deliso: ");
    say(path);
    say(": was cut short while it was read\n");
    _exit(kBadUsage);
  }
  // Not in a mapped file: a fault of the program, which must stay visible as one.
  std::signal(signal, SIG_DFL);
}

}  // namespace

void handle_signals() {
  std::signal(SIGXFSZ, SIG_IGN);
  struct sigaction action {};
  action.sa_sigaction = on_bus_error;
  action.sa_flags = SA_SIGINFO;
  sigemptyset(&action.sa_mask);
  sigaction(SIGBUS, &action, nullptr);
}

DeferSignals::DeferSignals() {
  sigset_t deferred;
  sigemptyset(&deferred);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&deferred, signal);
  pthread_sigmask(SIG_BLOCK, &deferred, &before_);
}

DeferSignals::~DeferSignals() {
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace deliso
