// SPDX-License-Identifier: MIT
// What a storm does for whoever meets its failing seed.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "check/faults.h"
#include "contour/contour.h"
#include "see.h"
#include "stress/seeds.h"
#include "stress/tiny_volume.h"

namespace deliso::stress {

// The places of the first kind of fault. Not of those that a storm allows.
inline std::vector<Vec3> places_of(const Faults& faults) {
  using enum FaultKind;
  for (std::size_t n = 0; n < kFaultKinds; ++n) {
    const auto kind = static_cast<FaultKind>(n);
    if (kind == needle_triangles || kind == folds || kind == near_vertices || kind == over_limits) {
      continue;
    }
    std::vector<Vec3> places;
    for (const Fault& fault : faults.first(kind)) places.push_back(fault.at);
    if (!places.empty()) return places;
  }
  return {};
}

// Returns the name of a file of the seed's volume, for command lines. With DELISO_SEE (see.h) the
// file is there.
inline std::string file_of_seed(std::string_view program, std::uint64_t seed,
                                const Volume& volume) {
  const auto folder = test::folder_to_see();
  if (!folder) return "v.nrrd";
  const std::string file = (*folder / text(program, "-", seed, ".nrrd")).string();
  write_nrrd(volume, file);
  return file;
}

// With DELISO_SEE: writes the mesh of a seed, T, the facets at fault, and other meshes to be
// compared with, and prints the commands that show them.
inline void see_seed(std::string_view program, std::uint64_t seed, const Volume& volume,
                     double kappa, const TriMesh& mesh, const Faults& faults,
                     const std::vector<test::SeenMesh>& others = {}) {
  if (!test::folder_to_see()) return;
  const std::string name = text(program, "-", seed);
  const std::string commands =
      test::see_mesh(name, mesh, build_contour(volume, kappa), places_of(faults), others);
  say(name, " is seen by", commands);
}

// Tells what to do about a seed with a fault.
inline void tell_next_step(std::string_view program) {
  say("To see one: DELISO_SEE=folder ", program,
      " --first-seed SEED --count 1 --list (docs/guide/a-seed-failed.md)");
}

}  // namespace deliso::stress
