// SPDX-License-Identifier: MIT
// --cap with --method marching-cubes: a mesh that no stage has made is closed on the box as well.
#include <doctest/doctest.h>

#include "app/marching_cubes.h"
#include "cap/solids.h"
#include "deliso/fields.h"

using namespace deliso;

TEST_CASE("Marching Cubes of tiny volumes of noise become closed solids") {
  int capped = 0;
  for (std::uint64_t seed = 7; seed <= 240; seed += 8) {
    CAPTURE(seed);
    const Volume volume = noise(seed, {1, 1, seed % 5 == 0 ? 4.0 : 1.0});
    const double kappa = 60.3;
    if (!(value_range(volume).min < kappa && kappa <= value_range(volume).max)) continue;
    const Solid solid = solid_of(volume, kappa, {}, mesh_by_cubes);
    check_solid(solid, volume.box());
    capped += solid.mesh.faces.size() > solid.report.cap.surface_triangles;
  }
  CHECK(capped > 20);
}

// Marching Cubes may well cross itself there. Its vertices lie a few roundings apart, and caps were
// refined between them for ever.
TEST_CASE("caps of Marching Cubes on samples of all sizes need little time") {
  std::size_t triangles = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    const Scattered scene = scattered(seed, 12);
    const Solid solid = solid_of(scene.volume, scene.kappa, {}, mesh_by_cubes);
    CHECK(solid.crossings <= crossing_pairs(solid.mesh));
    triangles += solid.mesh.faces.size();
  }
  CHECK(triangles > 0);
}

TEST_CASE("Marching Cubes close the gyroid, which fills one half") {
  const Scene scene = builtin_scene("gyroid", 32);
  const Vec3 size = scene.volume.box().size();
  const Solid solid = solid_of(scene.volume, 0, {}, mesh_by_cubes);
  check_solid(solid, scene.volume.box());
  CHECK(misplaced_samples(solid, scene.volume, scene.surface.kappa()) == 0);
  CHECK(enclosed_volume(solid.mesh) ==
        doctest::Approx(0.5 * size.x * size.y * size.z).epsilon(0.005));
}
