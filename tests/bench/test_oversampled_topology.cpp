// SPDX-License-Identifier: MIT
// The oracle by signs, on surfaces whose topology is known from geometry, and then the contour
// against it: two programs for one number, with no line in common.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "contour/contour.h"
#include "io/volume/builtin_volume.h"
#include "stress/tiny_volume.h"
#include "support/cell_loops.h"
#include "support/oversampled_topology.h"

using namespace deliso;

namespace {

using Components = OversampledComponents;

// f at 13 x 11 x 9 points, the middle one at (0, 0, 0).
template <class F>
Volume sampled(F f) {
  return Volume::from_function(Box3{{-6, -5, -4}, {6, 5, 4}}, {13, 11, 9}, f);
}

Components exact_components(const Volume& volume, double kappa) {
  Components components;
  for (const ContourComponent& c : summarize_contour(volume, kappa).components) {
    components.push_back({c.euler, c.boundary_loops});
  }
  std::sort(components.begin(), components.end());
  return components;
}

void check_at_each_factor(const Volume& volume, double kappa, const Components& expected) {
  for (const int n : {1, 2, 3, 4, 7}) {
    CAPTURE(n);
    const OversampledTopology found = oversampled_topology(volume, kappa, n);
    CHECK(found.inside_apart == expected);
    CHECK(found.inside_joined == expected);
  }
}

}  // namespace

TEST_CASE("a cell's loops go through each changing edge once, and end where they began") {
  for (unsigned inside = 0; inside < 256; ++inside) {
    CAPTURE(inside);
    for (const AlternatingFaces rule :
         {AlternatingFaces::cut_off_inside, AlternatingFaces::cut_off_outside}) {
      std::array<int, 12> visits{};
      for (const auto& loop : loops_of_cell(inside, rule)) {
        CHECK(loop.size() >= 3);
        for (std::size_t s = 0; s < loop.size(); ++s) {
          ++visits[static_cast<std::size_t>(loop[s].edge)];
          // The segment's face has both of its ends.
          for (const int edge : {loop[s].edge, loop[(s + 1) % loop.size()].edge}) {
            const auto faces = faces_of_cell_edge(edge);
            CHECK(std::find(faces.begin(), faces.end(), loop[s].face) != faces.end());
          }
        }
      }
      // Each edge, by its two corners.
      for (int edge = 0; edge < 12; ++edge) {
        const int axis = edge / 4;
        const int low = (edge & 1) << (axis + 1) % 3 | (edge >> 1 & 1) << (axis + 2) % 3;
        const unsigned ends = (inside >> low ^ inside >> (low | 1 << axis)) & 1;
        CHECK(visits[static_cast<std::size_t>(edge)] == static_cast<int>(ends));
      }
    }
  }
}

TEST_CASE("surfaces whose topology is known have it at every factor") {
  const auto square = [](double a) { return a * a; };
  check_at_each_factor(sampled([](Vec3 p) { return p.x + 0.3 * p.y - 0.2; }), 0, {{1, 1}});
  check_at_each_factor(sampled([](Vec3 p) { return p.z * p.z - 2.2; }), 0, {{1, 1}, {1, 1}});
  check_at_each_factor(sampled([&](Vec3 p) { return 7 - square(p.x) - square(p.y); }), 0, {{0, 2}});
  check_at_each_factor(sampled([&](Vec3 p) { return 9.1 - dot(p, p); }), 0, {{2, 0}});
  // A ball at a corner of the box: its surface is a disk, its boundary on three faces.
  check_at_each_factor(sampled([&](Vec3 p) {
                         const Vec3 q = p - Vec3{6, 5, 4};
                         return 12.3 - dot(q, q);
                       }),
                       0, {{1, 1}});
  check_at_each_factor(make_builtin_volume("builtin:torus:24"), 0, {{0, 0}});
  check_at_each_factor(make_builtin_volume("builtin:linked_tori:32"), 0, {{0, 0}, {0, 0}});
}

TEST_CASE("finer signs see what a voxel's own corners do not: a tube, or a gap") {
  // Two opposite corners inside. The middle of the voxel decides: joined by a tube, or two disks.
  const auto voxel = [](double others) {
    return Volume::from_samples<double>({2, 2, 2}, {1, 1, 1},
                                        {1, others, others, others, others, others, others, 1});
  };
  const Components disks{{1, 1}, {1, 1}}, tube{{0, 2}};
  CHECK(oversampled_topology(voxel(-0.1), 0, 1).inside_apart == disks);
  CHECK(oversampled_topology(voxel(-0.1), 0, 7).inside_apart == tube);
  CHECK(oversampled_topology(voxel(-0.1), 0, 7).inside_joined == tube);
  CHECK(oversampled_topology(voxel(-0.6), 0, 7).inside_apart == disks);
}

TEST_CASE("the two rules take a face with alternating corners either way") {
  // On the lowest face g is inside at the saddle: finer signs say that the corners are joined.
  const Volume volume =
      Volume::from_samples<double>({2, 2, 2}, {1, 1, 1}, {2, -1, -1, 2, -3, -3, -3, -3});
  const OversampledTopology coarse = oversampled_topology(volume, 0, 1);
  CHECK(coarse.inside_apart == Components{{1, 1}, {1, 1}});
  CHECK(coarse.inside_joined == Components{{1, 1}});
  CHECK(oversampled_topology(volume, 0, 7).inside_apart == Components{{1, 1}});
  CHECK(oversampled_topology(volume, 0, 7).inside_joined == Components{{1, 1}});
}

TEST_CASE("a gyroid that the box cuts has the contour's topology") {
  const Volume volume = make_builtin_volume("builtin:gyroid:24");
  check_at_each_factor(volume, 0, exact_components(volume, 0));
}

// Where saddles lie at kappa to within 1e-9 of the range, as the kinds with few levels are made to
// have, no affordable factor separates the sheets. The two rules then differ.
TEST_CASE("where both rules agree on a random volume, the contour agrees with them") {
  constexpr std::uint64_t kVolumes = 210;
  constexpr int kFactor = 15;
  std::uint64_t agreed = 0;
  for (std::uint64_t seed = 1; seed <= kVolumes; ++seed) {
    const stress::TinyVolume tiny = stress::make_tiny_volume(seed, 2, 6);
    const double kappa = geometric_isovalue(tiny.volume.type(), tiny.isovalue);
    const Components exact = exact_components(tiny.volume, kappa);
    const OversampledTopology found = oversampled_topology(tiny.volume, kappa, kFactor);
    if (!found.rules_agree()) continue;
    CAPTURE(seed);
    CHECK(exact == found.inside_apart);
    ++agreed;
  }
  CHECK(agreed >= kVolumes * 95 / 100);
}
