// SPDX-License-Identifier: MIT
// Volumes without a file: analytic fields sampled on a cube, for demonstrations, tests and
// benchmarks. With enough samples the trilinear surface has the topology of the analytic one. It is
// stated here, for tests.
//
// 1. Spacing is 1, the origin 0. A size of n gives n x n x n samples, and the box has edges of n-1.
//    A field is on [-1,1]^3 at any size, except noise, which has no scale.
// 2. The same field and size give the same bytes with every compiler and library. Sines and
//    exponentials may differ in the last bit, so samples are rounded: integers to integers, float32
//    to odd multiples of 2^-17. No isovalue with a short decimal is such a multiple.
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
  // At the default isovalue and size, and at most greater sizes; nullopt if unknown. At some sizes
  // a sample nearly touches the surface.
  std::optional<SurfaceTopology> topology;
};

std::span<const BuiltinField> builtin_fields();

// Returns the volume of a field, with `size` samples along each axis. pre: size is at least 2.
Volume sample_builtin_field(const BuiltinField& field, int size);

}  // namespace deliso
