// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <atomic>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/cancel.h"
#include "base/parallel.h"

using namespace deliso;

TEST_CASE("every task runs once, for any number of threads") {
  for (const int threads : {0, 1, 2, 3, 8, 100}) {
    for (const std::size_t tasks : {0u, 1u, 2u, 7u, 1000u}) {
      CAPTURE(threads);
      CAPTURE(tasks);
      std::vector<std::atomic<int>> runs(tasks);
      for_each_task(threads, tasks, [&](std::size_t n) { ++runs[n]; });
      for (const std::atomic<int>& n : runs) CHECK(n == 1);
    }
  }
}

TEST_CASE("runs cover every element once, each run at most the grain") {
  for (const int threads : {1, 3}) {
    for (const std::size_t size : {0u, 1u, 9u, 10u, 11u, 95u}) {
      CAPTURE(size);
      std::vector<std::size_t> run_of(size, 1000);
      for_each_run(threads, size, 10, [&](std::size_t n, std::size_t begin, std::size_t end) {
        CHECK(end - begin <= 10);
        for (std::size_t i = begin; i < end; ++i) run_of[i] = n;
      });
      for (std::size_t i = 0; i < size; ++i) CHECK(run_of[i] == i / 10);
      std::vector<std::size_t> sums(runs_of(size, 10));
      for_each_run(threads, size, 10, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) sums[begin / 10] += i;
      });
      CHECK(std::accumulate(sums.begin(), sums.end(), std::size_t{0}) ==
            size * (size - (size > 0)) / 2);
    }
  }
}

TEST_CASE(
    "of several exceptions the one of the first task is rethrown, for any number of threads") {
  for (const int threads : {1, 2, 8}) {
    for (int repeat = 0; repeat < 50; ++repeat) {
      std::string said;
      try {
        for_each_task(threads, 200, [](std::size_t n) {
          if (n % 7 == 5) throw std::runtime_error(std::to_string(n));
        });
      } catch (const std::runtime_error& error) {
        said = error.what();
      }
      CHECK(said == "5");
    }
  }
}

TEST_CASE("the flag of a scope stops the tasks of all its threads, and those of no other scope") {
  for (const int threads : {1, 2, 8}) {
    int flag = 0;
    std::atomic<std::size_t> begun{0};
    const auto work = [&] {
      for_each_task(threads, 1000, [&](std::size_t) {
        if (++begun == 10) std::atomic_ref(flag).store(1);
      });
    };
    {
      const CancelScope scope(&flag);
      CHECK_THROWS_AS(work(), Canceled);
      // Every thread may have begun one task more.
      CHECK(begun < 10 + static_cast<std::size_t>(threads));
      begun = 0;
      {
        const CancelScope inner(nullptr);
        CHECK_NOTHROW(work());
      }
      CHECK(begun == 1000);
      CHECK_THROWS_AS(work(), Canceled);
    }
    CHECK_NOTHROW(work());
  }
}
