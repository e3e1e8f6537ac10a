// SPDX-License-Identifier: MIT
// Where sheets of the surface touch, Stage 2 moves the mesh apart. tests/stress has storms.
#include <doctest/doctest.h>

#include "check/verify.h"
#include "deliso/mesh_isosurface.h"
#include "stress/tiny_volume.h"

using namespace deliso;

TEST_CASE("no fold, no needle, and no vertex next to a triangle of another sheet is left") {
  // Without separate.h six of these volumes have some.
  for (std::uint64_t seed = 1; seed <= 55; ++seed) {
    CAPTURE(seed);
    const stress::TinyVolume tiny = stress::make_tiny_volume(seed, 6, 8);
    Report report;
    const TriMesh mesh = mesh_isosurface(tiny.volume, tiny.isovalue, {}, report);
    const Faults faults = verify(mesh, tiny.volume, report.kappa_effective, {}).faults;
    for (const FaultKind kind :
         {FaultKind::folds, FaultKind::needle_triangles, FaultKind::near_vertices}) {
      CHECK(faults.count(kind) == 0);
    }
  }
}
