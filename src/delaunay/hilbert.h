// SPDX-License-Identifier: MIT
// An order of insertion in which each point lies near the one before, so that locating it is cheap.
// It still begins with random samples, so that no order of the input is bad. This is the biased
// randomized insertion order (Amenta, Choi and Rote 2003) along Hilbert's curve.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace deliso {

// Returns the indices of `points` in that order. It depends on the points alone. O(n log n).
std::vector<std::uint32_t> biased_hilbert_order(std::span<const Vec3> points);

// Returns the place of the cell (x, y, z) along Hilbert's curve, in a grid of 2^bits cells a side.
// Cells next to each other on the curve share a face. pre: 3 * bits <= 64, coordinates below
// 2^bits.
std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y, std::uint32_t z, int bits);

}  // namespace deliso
