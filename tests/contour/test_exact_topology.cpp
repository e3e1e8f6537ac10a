// SPDX-License-Identifier: MIT
// T's topology is Sigma's for every finite sample, against an oracle in exact arithmetic. Where
// doubles decide nothing: values over 24 magnitudes, saddles at kappa to the last bit.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "base/random.h"
#include "contour/contour.h"
#include "contour/exact_voxel.h"
#include "contour/glued_topology.h"
#include "contour/wide_values.h"

using namespace deliso;

namespace {

Corners corners_of(const std::vector<double>& samples) {
  Corners c;
  std::copy_n(samples.begin(), 8, c.begin());
  return c;
}

ComponentKinds kinds_of(const VoxelTruth& truth) {
  ComponentKinds kinds;
  for (const VoxelPiece& piece : truth.pieces) kinds.emplace_back(piece.euler, piece.loops);
  std::ranges::sort(kinds);
  return kinds;
}

ComponentKinds contour_of(Index3 dims, const WideValues& wide) {
  const Volume volume = Volume::from_samples(dims, {1, 1, 1}, wide.samples);
  return deliso::kinds_of(summarize_contour(volume, wide.kappa));
}

}  // namespace

TEST_CASE("single voxels over magnitudes and with tied saddles have the exact topology") {
  Random random(22);
  int tubes = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    CAPTURE(trial);
    const WideValues wide = make_wide_values(random, static_cast<WideKind>(trial % kWideKinds), 8);
    const VoxelTruth truth = ExactVoxel::solve(corners_of(wide.samples), wide.kappa);
    REQUIRE(truth.resolved);
    CHECK((contour_of({2, 2, 2}, wide) == kinds_of(truth)));
    for (const VoxelPiece& piece : truth.pieces) tubes += piece.loops == 2;
  }
  CHECK(tubes > 50);
}

TEST_CASE("small volumes over magnitudes and with tied saddles have the exact topology") {
  Random random(23);
  for (int trial = 0; trial < 2000; ++trial) {
    CAPTURE(trial);
    Index3 dims;
    for (int axis = 0; axis < 3; ++axis) dims[axis] = 2 + static_cast<int>(random.below(3));
    const WideValues wide = make_wide_values(random, static_cast<WideKind>(trial % kWideKinds),
                                             static_cast<std::size_t>(dims.i * dims.j * dims.k));
    const Volume volume = Volume::from_samples(dims, {1, 1, 1}, wide.samples);
    const auto expected = glue_voxels(volume, wide.kappa);
    REQUIRE(expected);
    CHECK((deliso::kinds_of(summarize_contour(volume, wide.kappa)) == *expected));
  }
}

// Found by random search. They were wrong by a tunnel when doubles decided the sign of a
// discriminant, or the order of two heights that both round to 1.
TEST_CASE("voxels whose tunnels depend on the last bits have the exact topology") {
  const std::vector<WideValues> voxels{
      {{0x1.c4c9b1d2e16dfp+29, -0x1.a125513378edap+25, -0x1.2ac48ff4bf3f0p+13,
        -0x1.ba22b00f0aff8p-18, -0x1.ea81d04424e05p-3, -0x1.d985bdf5289dbp-1, 0x1.f54b6a1dd3451p-24,
        0x1.65b4633b7317dp-15},
       2.1945369745675477e-05},
      {{0x1.6fb02c4c50d8dp-8, 0x1.f5b72dcd8cf7fp-10, -0x1.bf352c8800a61p+32, 0x1.ec0753998e907p+30,
        -0x1.eaeca44e61d9ep+38, 0x1.0f09131a0ee92p+22, 0x1.85a1c2f91d2e1p-36,
        -0x1.4f2ceaab64a08p-26},
       3.33906464026924e-12},
      {{-0x1.0433c8198a18dp+30, 0x1.258d948f2ff5dp-32, 0x1.4649b1f624472p-8, 0x1.ad31f70905cf4p+17,
        0x1.08e9a12ed1696p-27, 0x1.21bd2aa3cfdd1p-3, 0x1.3b874f44a38afp-11, -0x1.918a35eccd0c6p-22},
       4.697436115867145e-08},
      {{-0x1.5b932969f8c47p+37, -0x1.2a0c4e11cbc80p+20, 0x1.1e42de6cda9b8p+27,
        0x1.37001032759afp+27, 0x1.4c6f69acf6a29p+8, -0x1.999c6a8df8662p+3, -0x1.0da31a17933eap+1,
        0x1.17134c18cd92cp-28},
       -5.595596093619054e-09},
      {{0x1.5dd49d7af1061p-35, -0x1.1585180ff99c2p+34, 0x1.cf4467782938bp+37,
        -0x1.9e4e6862c4589p-26, 0x1.22a904283ad10p+3, -0x1.6cde65212a9e4p-1, -0x1.028645150cd5fp+11,
        0x1.4cd528f6ee7f2p+14},
       -6.388104424472411e-12},
      {{-0x1.38919877fbf68p-13, -0x1.7e9840633b514p+19, -0x1.636206762c194p+14,
        0x1.ccb7b22fe5b3fp+12, 0x1.e7800d8a75a51p-5, -0x1.3f7f1e71d9a44p-39, 0x1.74e747dbcf267p-34,
        -0x1.2207ddb21c283p-30},
       3.747606501663868e-10},
  };
  for (const WideValues& wide : voxels) {
    CAPTURE(wide.kappa);
    const VoxelTruth truth = ExactVoxel::solve(corners_of(wide.samples), wide.kappa);
    REQUIRE(truth.resolved);
    CHECK((contour_of({2, 2, 2}, wide) == kinds_of(truth)));
  }
}

// Products of four would overflow, or vanish, if they were not scaled.
TEST_CASE("voxels at both ends of the exponents have the exact topology") {
  Random random(24);
  for (int trial = 0; trial < 3000; ++trial) {
    CAPTURE(trial);
    WideValues wide = make_wide_values(random, static_cast<WideKind>(trial % kWideKinds), 8);
    const double scale = std::ldexp(1.0, trial % 2 != 0 ? 970 : -890);
    for (double& v : wide.samples) v *= scale;
    wide.kappa *= scale;
    const VoxelTruth truth = ExactVoxel::solve(corners_of(wide.samples), wide.kappa);
    REQUIRE(truth.resolved);
    CHECK((contour_of({2, 2, 2}, wide) == kinds_of(truth)));
  }
}
