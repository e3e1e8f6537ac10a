// SPDX-License-Identifier: MIT
// Volumes that need no file: analytic fields sampled on a cube, for demonstrations, tests and
// benchmarks. Where the shape is resolved, the topology of the trilinear surface is that of the
// analytic one and stated here, for tests to hold against.
//
// 1. Spacing is 1, the origin 0: a size of n gives n x n x n samples, and the box has edges of n-1.
//    A field lives on [-1,1]^3 whatever the size (noise excepted: it has no scale).
// 2. The same field and size give the same bytes with every compiler and library: sin and exp may
//    differ in the last bit, so every sample is rounded to a coarser grid (float32 to odd multiples
//    of 2^-17, which no isovalue with a short decimal hits; integers as they are).
// 3. No sample equals the default isovalue.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "volume/volume.h"

namespace deliso {

// Of the whole isosurface: components, Euler number V - E + F, closed curves on the box.
struct SurfaceTopology {
  int components, euler, boundary_loops;
  friend bool operator==(const SurfaceTopology&, const SurfaceTopology&) = default;
};

struct BuiltinField {
  std::string_view name;
  std::string_view description;
  double isovalue;   // the default
  int default_size;  // samples along each axis
  // At the default isovalue and size, and at greater sizes unless one grazes the surface; nothing:
  // known to nobody.
  std::optional<SurfaceTopology> topology;
};

std::span<const BuiltinField> builtin_fields();

// The volume of one of these, of `size` samples along each axis. pre: two or more.
Volume sample_builtin_field(const BuiltinField& field, int size);

}  // namespace deliso
