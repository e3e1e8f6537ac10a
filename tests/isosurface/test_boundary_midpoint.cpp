// SPDX-License-Identifier: MIT
// Points halfway along boundary curves, against a dense scan of the same line. Repeatedly within a
// pixel, down to far below voxel size, and between chain points several pixels apart.
#include <doctest/doctest.h>

#include <cmath>

#include "base/random.h"
#include "contour/contour.h"
#include "isosurface/boundary_midpoint.h"

using namespace deliso;

namespace {

Volume random_volume(Random& random, std::uint32_t levels) {
  const Index3 dims{2 + static_cast<int>(random.below(5)), 2 + static_cast<int>(random.below(5)),
                    2 + static_cast<int>(random.below(5))};
  const Vec3 spacing{random.uniform(0.3, 3), random.uniform(0.3, 3), random.uniform(0.3, 3)};
  std::vector<std::int32_t> samples;
  for (int n = 0; n < dims.i * dims.j * dims.k; ++n) {
    samples.push_back(static_cast<std::int32_t>(random.below(levels)));
  }
  const Volume even = Volume::from_samples(dims, spacing, samples);
  if (levels % 2 != 0) return even;
  // Along one axis the steps differ.
  const int axis = static_cast<int>(random.below(3));
  Coordinates places;
  for (int n = 0; n < dims[axis]; ++n) {
    const double before = n == 0 ? 0 : places[axis].back() + random.uniform(0.2, 2);
    places[axis].push_back(before);
  }
  return even.with_places(places, "test");
}

double face_coordinate(const Volume& volume, BoxFace face) {
  const Box3 box = volume.box();
  return (face & 1) != 0 ? box.hi[axis_of(face)] : box.lo[axis_of(face)];
}

// The in-face normal of the chord, as long as the chord.
Vec3 face_normal_of(BoxFace face, const Vec3& a, const Vec3& b) {
  Vec3 across;
  across[axis_of(face)] = 1;
  return cross(across, b - a);
}

}  // namespace

TEST_CASE("arcs within a pixel split down to a thousandth of a voxel") {
  Random random(21);
  std::size_t splits = 0;
  for (int trial = 0; trial < 400; ++trial) {
    CAPTURE(trial);
    const std::uint32_t levels = trial % 2 == 0 ? 1001 : 6;
    const Volume volume = random_volume(random, levels);
    const double kappa = geometric_isovalue(volume.type(), random.below(levels));
    const ContourMesh mesh = build_contour(volume, kappa);
    for (const BoundaryLoop& loop : mesh.boundary.loops) {
      for (std::size_t n = 0; n < loop.size(); ++n) {
        const BoxFace face = loop[n].face;
        Vec3 a = loop[n].point, b = loop[(n + 1) % loop.size()].point;
        for (int level = 0; level < 10 && distance(a, b) > 1e-6; ++level) {
          const auto p = boundary_midpoint(volume, kappa, face, a, b);
          REQUIRE(p);
          ++splits;
          CHECK((*p)[axis_of(face)] == face_coordinate(volume, face));
          CHECK(std::abs(volume.value(*p) - kappa) <= 1e-10 * levels);
          CHECK(std::abs(distance(*p, a) - distance(*p, b)) <= 1e-9);
          CHECK(distance(*p, a) <= distance(a, b));
          (random.below(2) != 0 ? a : b) = *p;
        }
      }
    }
  }
  CHECK(splits > 10000);
}

TEST_CASE("between points several pixels apart it is the nearest hit of the chord's normal") {
  Random random(22);
  int hits = 0, misses = 0;
  for (int trial = 0; trial < 300; ++trial) {
    CAPTURE(trial);
    const Volume volume = random_volume(random, 1000 + trial % 2);
    const double kappa = random.uniform(200, 800);
    const ContourMesh mesh = build_contour(volume, kappa);
    for (const BoundaryLoop& loop : mesh.boundary.loops) {
      const BoxFace face = loop[0].face;
      std::size_t n = 1;
      while (n + 1 < loop.size() && n < 6 && loop[n].face == face) ++n;
      const Vec3 a = loop[0].point, b = loop[n].point;
      if (distance(a, b) < 1e-3) continue;
      const auto p = boundary_midpoint(volume, kappa, face, a, b);
      const Vec3 normal = face_normal_of(face, a, b), middle = 0.5 * (a + b);
      // The first sign change from the middle outwards, in both directions, on a fine scan.
      constexpr int kSteps = 2000;
      double found = 1;
      for (const double side : {-1.0, 1.0}) {
        bool inside = volume.value(middle) >= kappa;
        for (int s = 1; s <= kSteps; ++s) {
          const double t = 0.5 * s / kSteps;
          const Vec3 at = middle + side * t * normal;
          if (!volume.box().contains(at)) break;
          const bool now = volume.value(at) >= kappa;
          if (now != inside) {
            found = std::min(found, t);
            break;
          }
          inside = now;
        }
      }
      if (!p) {
        ++misses;
        CHECK(found == 1);
        continue;
      }
      ++hits;
      CHECK((*p)[axis_of(face)] == face_coordinate(volume, face));
      CHECK(std::abs(volume.value(*p) - kappa) <= 1e-7);
      const double t = distance(*p, middle) / length(normal);
      CHECK(t <= 0.5 + 1e-12);
      CHECK(t <= found + 1e-9);  // the scan may step over a pair of roots, never the other way
      CHECK(std::abs(dot(*p - middle, b - a)) <= 1e-9 * length2(b - a));
    }
  }
  CHECK(hits > 500);
  CHECK(misses > 20);
}

// An edge of a mesh from a file, 1e29 long in the plane of a face: every grid line on the way was
// visited, without end where a double has no room for the next one.
TEST_CASE("the search along an edge far off the box ends") {
  Random random(23);
  int hits = 0, misses = 0;
  for (int trial = 0; trial < 400; ++trial) {
    CAPTURE(trial);
    const Volume volume = random_volume(random, 1000);
    const double kappa = random.uniform(200, 800);
    const auto face = static_cast<BoxFace>(random.below(6));
    const double far = std::pow(10, random.uniform(1, 29));
    Vec3 a, b;
    for (int axis = 0; axis < 3; ++axis) {
      a[axis] = random.uniform(-far, far);
      b[axis] = random.below(3) == 0 ? a[axis] : random.uniform(-far, far);
    }
    a[axis_of(face)] = b[axis_of(face)] = face_coordinate(volume, face);
    const auto p = boundary_midpoint(volume, kappa, face, a, b);
    (p ? hits : misses)++;
    if (p) CHECK(volume.box().contains(*p));
  }
  CHECK(misses > 200);

  // The line enters the box from outside, and its first hit inside is found.
  hits = 0;
  for (int trial = 0; trial < 400; ++trial) {
    CAPTURE(trial);
    const Volume volume = random_volume(random, 1000);
    const double kappa = random.uniform(200, 800);
    const Box3 box = volume.box();
    const auto face = static_cast<BoxFace>(random.below(6));
    const int u = (axis_of(face) + 1) % 3, v = (axis_of(face) + 2) % 3;
    const double far = random.uniform(1, 1000);
    Vec3 a, b;
    a[axis_of(face)] = b[axis_of(face)] = face_coordinate(volume, face);
    a[u] = b[u] = box.lo[u] - far;
    a[v] = random.uniform(box.lo[v], box.hi[v]) + far + 100;
    b[v] = 2 * random.uniform(box.lo[v], box.hi[v]) - a[v];
    const auto p = boundary_midpoint(volume, kappa, face, a, b);
    Vec3 at = 0.5 * (a + b);
    std::optional<double> found;
    bool inside = false;
    constexpr int kSteps = 5000;
    for (int s = 0; s <= kSteps && !found; ++s) {
      at[u] = box.lo[u] + (box.hi[u] - box.lo[u]) * s / kSteps;
      const bool now = volume.value(at) >= kappa;
      if (s > 0 && now != inside) found = at[u];
      inside = now;
    }
    if (found) {
      REQUIRE(p);
      ++hits;
      CHECK(std::abs(volume.value(*p) - kappa) <= 1e-6);
      CHECK((*p)[u] <= *found + 1e-9);
      CHECK(std::abs((*p)[v] - at[v]) <= 1e-9);
    }
  }
  CHECK(hits > 200);
}
