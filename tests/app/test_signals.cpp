// SPDX-License-Identifier: MIT
#include "app/signals.h"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string>
#include <thread>

#include "app/run.h"
#include "base/check.h"
#include "base/parallel.h"
#include "io/files/atomic_file.h"
#include "io/files/input_file.h"
#include "io/files/temporary_folder.h"

using namespace deliso;
using namespace deliso::test;

namespace {

volatile std::sig_atomic_t signals_seen = 0;

void count_signal(int) {
  signals_seen = signals_seen + 1;
}

struct Outcome {
  bool exited = false;
  int status = 0;  // or the signal
  std::string said;
};

// Runs `work` in a process. Returns how it ended and its standard error.
template <class Work>
Outcome of_process(Work work) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDERR_FILENO);
    work();
    _exit(0);
  }
  close(ends[1]);
  Outcome outcome;
  char byte;
  while (::read(ends[0], &byte, 1) == 1) outcome.said += byte;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  outcome.exited = WIFEXITED(status);
  outcome.status = outcome.exited ? WEXITSTATUS(status) : WTERMSIG(status);
  return outcome;
}

// What a new file of a mebibyte held when it was mapped, with all but ten bytes gone since.
Bytes mapped_and_cut_short(const std::string& path) {
  handle_signals();
  AtomicFile out(path);
  out.write(std::string(1 << 20, 'x'));
  out.commit();
  Bytes bytes = open_file(path);
  if (truncate(path.c_str(), 10) != 0) _exit(99);
  return bytes;
}

}  // namespace

TEST_CASE("signals wait until writing is done, and then arrive") {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const auto before = std::signal(signal, count_signal);
    signals_seen = 0;
    {
      const DeferSignals defer;
      std::raise(signal);
      CHECK(signals_seen == 0);
    }
    CHECK(signals_seen == 1);
    std::raise(signal);
    CHECK(signals_seen == 2);
    std::signal(signal, before);
  }
}

TEST_CASE("a mapped file that shrinks ends in one line that names it") {
  const TemporaryFolder folder;
  const std::string path = folder / "volume.raw";
  const Outcome outcome = of_process([&] {
    const Bytes bytes = mapped_and_cut_short(path);
    unsigned sum = 0;
    for (const std::byte b : bytes.data) sum += std::to_integer<unsigned>(b);
    _exit(sum > 0 ? 98 : 97);  // the sum is used, so it is made
  });
  CHECK(outcome.exited);
  CHECK(outcome.status == kBadUsage);
  CHECK(outcome.said == "deliso: " + path + ": was cut short while it was read\n");
}

TEST_CASE("a mapped file that shrinks under several threads ends in one line all the same") {
  const TemporaryFolder folder;
  const std::string path = folder / "volume.raw";
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Outcome outcome = of_process([&] {
      const Bytes bytes = mapped_and_cut_short(path);
      constexpr std::size_t kPage = 4096;
      std::atomic<int> begun = 0;
      std::atomic<unsigned> sum = 0;
      for_each_task(4, bytes.size() / kPage - 1, [&](std::size_t n) {
        for (++begun; begun < 4;) std::this_thread::yield();  // all of them fault at once
        sum += std::to_integer<unsigned>(bytes.data[(n + 1) * kPage]);
      });
      _exit(sum > 0 ? 98 : 97);
    });
    REQUIRE(outcome.exited);
    REQUIRE(outcome.status == kBadUsage);
    REQUIRE(outcome.said == "deliso: " + path + ": was cut short while it was read\n");
  }
}

TEST_CASE("a bus error outside mapped files stays a bus error") {
  const Outcome outcome = of_process([] {
    handle_signals();
    kill(getpid(), SIGBUS);
    for (int n = 0; n < 3; ++n) kill(getpid(), SIGBUS);
  });
  CHECK_FALSE(outcome.exited);
  CHECK(outcome.status == SIGBUS);
}

TEST_CASE("a file over the system's limit is an error of writing") {
  const TemporaryFolder folder;
  const Outcome outcome = of_process([&] {
    handle_signals();
    const rlimit limit{1000, 1000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      AtomicFile out(folder / "mesh.ply");
      out.write(std::string(1 << 20, 'x'));
      out.commit();
    } catch (const InputError&) {
      _exit(kBadUsage);
    }
  });
  CHECK(outcome.exited);
  CHECK(outcome.status == kBadUsage);
  CHECK(access((folder / "mesh.ply").c_str(), F_OK) != 0);
}
