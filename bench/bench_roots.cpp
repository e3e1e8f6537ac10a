// SPDX-License-Identifier: MIT
// Which cubic solver is faster: Schwarze's closed form with polish, or interval isolation.
// Usage: bench_roots [COUNT]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "base/random.h"
#include "roots/cubic.h"

using namespace deliso;

namespace {

// Fastest of five rounds, in ns per polynomial; the sum keeps the work alive.
template <class Solve>
void report(const char* what, const std::vector<Cubic>& cubics, Solve&& solve) {
  double best = 1e300, sum = 0;
  std::size_t roots = 0;
  for (int round = 0; round < 5; ++round) {
    const auto start = std::chrono::steady_clock::now();
    roots = 0;
    for (const Cubic& c : cubics) {
      const Roots found = solve(c);
      roots += static_cast<std::size_t>(found.count);
      for (const double t : found) sum += t;
    }
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    best = std::min(best, time.count() / static_cast<double>(cubics.size()));
  }
  std::printf("%-42s %7.1f ns   %.3f roots each   (%.3g)\n", what, best,
              static_cast<double>(roots) / static_cast<double>(cubics.size()), sum);
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 1'000'000;
  Random random(1);
  std::vector<Cubic> any, one_change, more_changes;
  while (static_cast<int>(any.size()) < count) {
    Cubic b;
    for (double& a : b) a = random.uniform(-1, 1);
    // A ray through a voxel meets the patch at a slant: coefficients that mostly go one way.
    const double slope = random.uniform(-2, 2);
    for (std::size_t n = 0; n < 4; ++n)
      b[n] = 0.3 * b[n] + slope * (static_cast<double>(n) / 3 - 0.5);
    int changes = 0;
    for (std::size_t n = 0; n < 3; ++n) changes += (b[n] >= 0) != (b[n + 1] >= 0);
    any.push_back(b);
    if (changes == 1) one_change.push_back(b);
    if (changes > 1) more_changes.push_back(b);
  }
  for (const CubicMethod method : {CubicMethod::isolation, CubicMethod::schwarze}) {
    std::printf("%s\n", method == CubicMethod::isolation ? "isolation" : "schwarze");
    report("  crossings, any", any, [&](const Cubic& b) { return crossings(b, method); });
    report("  crossings, one change of sign", one_change,
           [&](const Cubic& b) { return crossings(b, method); });
    report("  crossings, two or three changes", more_changes,
           [&](const Cubic& b) { return crossings(b, method); });
  }
}
