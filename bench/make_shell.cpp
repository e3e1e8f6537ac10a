// SPDX-License-Identifier: MIT
// Writes a large volume to measure with: a bumpy ball with a cavity, in 8 bits, with noise of one
// gray value, N samples along each axis. One slice is in memory at a time.
//   make_shell N OUT.raw
//   deliso OUT.raw --dims NxNxN --type uint8 --iso 128.5
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <vector>

#include "base/random.h"

using namespace deliso;

namespace {

// The outer radius, the inner one and the height of the bumps, in halves of the volume's side.
constexpr double kOuter = 0.8, kInner = 0.55, kBumps = 0.03;
constexpr double kWaves = 9;
constexpr double kGrayPerSample = 16;  // the slope at the surface

double shell(double x, double y, double z) {
  const double r = std::sqrt(x * x + y * y + z * z);
  const double waves = kWaves * std::numbers::pi;
  const double bump = kBumps * std::sin(waves * x) * std::sin(waves * y) * std::sin(waves * z);
  return std::min(kOuter + bump - r, r - kInner - bump);
}

}  // namespace

int main(int argc, char** argv) {
  const int n = argc == 3 ? std::atoi(argv[1]) : 0;
  if (n < 2) {
    std::fputs("usage: make_shell N OUT.raw\n", stderr);
    return 2;
  }
  std::ofstream out(argv[2], std::ios::binary);
  Random random(1);
  std::vector<std::uint8_t> slice(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
  const double half = 0.5 * (n - 1);
  for (int k = 0; k < n; ++k) {
    std::size_t at = 0;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const double inside = half * shell(i / half - 1, j / half - 1, k / half - 1);
        const double noise = static_cast<double>(random.below(3)) - 1;
        slice[at++] = static_cast<std::uint8_t>(
            std::lround(std::clamp(128 + kGrayPerSample * inside + noise, 0.0, 255.0)));
      }
    }
    out.write(reinterpret_cast<const char*>(slice.data()),
              static_cast<std::streamsize>(slice.size()));
  }
  out.flush();
  if (!out) {
    std::fprintf(stderr, "make_shell: %s cannot be written\n", argv[2]);
    return 2;
  }
}
