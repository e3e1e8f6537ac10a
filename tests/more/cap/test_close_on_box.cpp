// SPDX-License-Identifier: MIT
// --cap: the mesh and its caps are the closed boundary of {f >= kappa} within the box. Tested by
// the properties of every solid, by the samples on the box, and by volumes found by sampling.
#include "more/cap/close_on_box.h"

#include <doctest/doctest.h>

#include "cases.h"
#include "fields.h"
#include "more/cap/solids.h"
#include "stress/tiny_volume.h"
#include "volume/sampled.h"

using namespace deliso;

TEST_CASE("tiny volumes of noise become closed solids, also over edges and corners of the box") {
  int capped = 0;
  for (std::uint64_t seed = 1; seed <= test::cases(240u); ++seed) {
    CAPTURE(seed);
    const Volume volume = noise(seed, {1, 1, seed % 5 == 0 ? 4.0 : 1.0});
    const double kappa = seed % 4 == 0 ? 1 : seed % 2 == 0 ? 100 : 60.3;
    if (!(value_range(volume).min < kappa && kappa <= value_range(volume).max)) continue;
    Options options;
    options.r_min = {0.25, Length::Unit::voxel};
    const ClosedMesh solid = solid_of(volume, kappa, options);
    check_closed(solid, volume.box());
    capped += solid.mesh.faces.size() > solid.report.cap.surface_triangles;
  }
  CHECK(capped > test::cases(200));
}

// A component that was swept over lay on the other side of its neighbor, and its boundary loop no
// longer parted inside from outside.
TEST_CASE("the coarsest meshes of noise become closed solids") {
  for (std::uint64_t seed = 200; seed <= 200 + test::cases(100u); ++seed) {
    CAPTURE(seed);
    const stress::TinyVolume tiny = stress::make_tiny_volume(stress::kTinyKinds * seed);
    Options options;
    options.cap = true;
    options.target_triangles = 4;
    Report report;
    mesh_isosurface(tiny.volume, tiny.isovalue, options, report);
    CHECK(report.cap.failure == "");
  }
}

namespace {

// S3 of surface/surface_mesh.h. Caps met what else lay in the faces of the box.
void check_box(const TriMesh& mesh, const Grid& volume) {
  const Box3 box = volume.box();
  std::vector<std::uint8_t> is_boundary(mesh.points.size(), 0);
  for (const Face& face : mesh.faces) {
    unsigned common = 63;
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId a = face.v[(i + 1) % 3], b = face.v[(i + 2) % 3];
      common &= box_faces_at(mesh.points[a], box);
      if (face.n[i] != kNoId) CHECK_FALSE(on_one_face(mesh.points[a], mesh.points[b], box));
      if (face.n[i] == kNoId) is_boundary[a.number()] = is_boundary[b.number()] = 1;
    }
    CHECK(common == 0);
  }
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    const Vec3 p = mesh.points[v], back = volume.frame().from_world(volume.frame().to_world(p));
    CHECK((is_boundary[v.number()] != 0) == (box_faces_at(p, box) != 0));
    if (is_boundary[v.number()] == 0) CHECK(box_faces_at(back, box) == 0);
  }
}

}  // namespace

TEST_CASE("the surface touches the box along its boundary alone, also when it went to the world") {
  std::size_t facets = 0;
  for (std::uint64_t seed = 1; seed <= test::cases(240u); ++seed) {
    CAPTURE(seed);
    const Volume bytes = noise(seed, {1, 1, seed % 5 == 0 ? 3.0 : 1.0});
    const bool is_tied = seed % 4 == 0;  // many samples are equal to the isovalue
    const double kappa = is_tied ? 1 : 60.3 + 40 * static_cast<double>(seed % 3);
    if (!(value_range(bytes).min < kappa && kappa <= value_range(bytes).max)) continue;
    const Volume volume = sampled<double>(bytes.dims(), bytes.spacing(), [&](int i, int j, int k) {
                            return bytes.sample(i, j, k);
                          }).with_frame({.origin = {is_tied ? 3e6 : 0, 0, 0}});
    Options options;
    options.r_min = {0.1, Length::Unit::voxel};
    options.limits[Criterion::r_over_l].value = seed % 2 == 0 ? 1.2 : 2;
    if (seed % 7 == 0) options.target_triangles = 4;
    if (seed % 8 == 0) options.block_side = 4;
    Report report;
    const TriMesh mesh = mesh_isosurface(volume, kappa, options, report);
    check_box(mesh, volume);
    facets += mesh.faces.size();
  }
  CHECK(facets > test::cases(1000u));
}

TEST_CASE("far from the origin of the world a vertex next to a face of the box stays off it") {
  for (int axis = 0; axis < 3; ++axis) {
    // On a face of the box one sample is equal to the isovalue, and all others are below it.
    const Volume volume =
        sampled<double>({5, 5, 5}, {1, 1, 1}, [&](int i, int j, int k) {
          return Index3{i, j, k} == Index3{axis == 0 ? 4 : 2, axis == 1 ? 0 : 2, axis == 2 ? 4 : 2}
                     ? 0
                     : -1;
        }).with_frame({.origin = {3e6, 3e6, 3e6}});
    Options options;
    options.stop_after_stage1 = true;
    Report report;
    const TriMesh mesh = mesh_isosurface(volume, 0, options, report);
    CHECK(mesh.faces.size() == 4);
    check_box(mesh, volume);
  }
}

TEST_CASE("samples of all magnitudes become closed solids that do not cross themselves") {
  int sound = 0, solids = 0;
  for (std::uint64_t seed = 1; seed <= test::cases(80u); ++seed) {
    CAPTURE(seed);
    const Scattered scene = scattered(seed, seed % 2 == 0 ? 12 : 3);
    const ValueRange range = value_range(scene.volume);
    if (!(range.min < scene.kappa && scene.kappa <= range.max)) continue;
    Options options;
    options.r_min = {0.2, Length::Unit::voxel};
    const ClosedMesh solid = solid_of(scene.volume, scene.kappa, options);
    check_closed(solid, scene.volume.box());
    CHECK(solid.crossings == 0);
    sound += solid.report.cap.failure.empty() && solid.crossings == 0;
    ++solids;
  }
  CHECK(solids > test::cases(60));
  CHECK(sound >= solids - 1);
}

TEST_CASE(
    "components that --min-component or --largest leave out are dissolved into their "
    "surroundings") {
  // Samples at the corners of the box once decided, though their component had been left out.
  int whole = 0, nothing = 0, fewer = 0;
  for (std::uint64_t seed = 1; seed <= test::cases(80u); ++seed) {
    CAPTURE(seed);
    const Volume volume = noise(seed, {1, 1, 1});
    const double kappa = seed % 4 == 0 ? 1 : seed % 2 == 0 ? 170 : 30.3;
    if (!(value_range(volume).min < kappa && kappa <= value_range(volume).max)) continue;
    Options options;
    if (seed % 3 == 0) {
      options.components.largest = 1 + seed % 5;
    } else {
      options.components.min_voxels = static_cast<double>(2 + seed % 5);
    }
    const ClosedMesh solid = solid_of(volume, kappa, options);
    fewer += solid.report[Counter::components_skipped] > 0;
    if (solid.mesh.faces.empty()) {
      CHECK(solid.report.cap.failure == "");
      ++nothing;
      continue;
    }
    check_closed(solid, volume.box());
    CHECK(solid.crossings == 0);
    whole += solid.report.cap.surface_triangles == 0;
  }
  CHECK(fewer > test::cases(30));
  CHECK(whole > test::cases(3));
  CHECK((!test::all_cases() || nothing > 3));
}

TEST_CASE(
    "a small component is removed, a cavity filled, at the box and away from it, and a slab kept") {
  // A slab of inside from x = 10 to 20, in a box that is thinner than min_component.
  const Index3 dims{30, 4, 4};
  std::vector<float> samples;
  for (int n = 0; n < 30 * 4 * 4; ++n) samples.push_back(n % 30 >= 10 && n % 30 <= 20 ? 1 : 0);
  const auto at = [&](int i, int j, int k) -> float& {
    return samples[static_cast<std::size_t>(i + 30 * (j + 4 * k))];
  };
  const auto volume_of = [&](double min_component) {
    Options options;
    options.components.min_voxels = min_component;
    const Volume volume = Volume::from_samples(dims, {1, 1, 1}, samples);
    const ClosedMesh solid = solid_of(volume, 0.5, options);
    check_closed(solid, volume.box());
    return enclosed_volume(solid.mesh);
  };
  const double slab = 11 * 3 * 3;
  CHECK(volume_of(0) == doctest::Approx(slab).epsilon(1e-6));
  CHECK(volume_of(6) == doctest::Approx(slab).epsilon(1e-6));
  at(26, 1, 1) = 1;  // a ball in the box
  at(3, 0, 0) = 1;   // one at an edge of it
  at(29, 3, 3) = 1;  // in a corner
  CHECK(volume_of(0) > slab + 0.1);
  CHECK(volume_of(6) == doctest::Approx(slab).epsilon(1e-6));
  at(15, 1, 2) = 0;  // a bubble
  at(18, 0, 3) = 0;  // a dent
  CHECK(volume_of(6) == doctest::Approx(slab).epsilon(1e-6));
  // The outside on the right has the fewest samples, then that on the left.
  CHECK(volume_of(100) == doctest::Approx(29 * 3 * 3).epsilon(1e-9));
}

TEST_CASE("smooth fields: the caps cover the inside samples of the box, and the volume is right") {
  for (std::uint64_t seed = 1; seed <= test::cases(30u); ++seed) {
    CAPTURE(seed);
    const Scene scene = wave_scene(seed, 12, {1, 1, seed % 3 == 0 ? 2.5 : 1.0});
    Options options;
    options.r_min = {0.1, Length::Unit::voxel};
    const ClosedMesh solid = solid_of(scene.volume, 0.3, options);
    check_closed(solid, scene.volume.box());
    CHECK(misplaced_samples(solid, scene.volume, scene.surface.kappa()) == 0);
    const double expected = sampled_volume(scene.volume, scene.surface.kappa(), 4);
    CHECK(enclosed_volume(solid.mesh) == doctest::Approx(expected).epsilon(0.02));
  }
}

TEST_CASE("the gyroid, which fills half of the box, becomes a closed solid") {
  const Scene scene = builtin_scene("gyroid", 32);
  const Vec3 size = scene.volume.box().size();
  const ClosedMesh solid = solid_of(scene.volume, 0);
  check_closed(solid, scene.volume.box());
  CHECK(misplaced_samples(solid, scene.volume, scene.surface.kappa()) == 0);
  CHECK(enclosed_volume(solid.mesh) ==
        doctest::Approx(0.5 * size.x * size.y * size.z).epsilon(0.005));
}

TEST_CASE(
    "solids without a boundary: a ball alone, a bubble in a full box, a full box, an empty one") {
  const Scene ball = builtin_scene("sphere", 20);
  ClosedMesh solid = solid_of(ball.volume, 0);
  check_closed(solid, ball.volume.box());
  CHECK(solid.mesh.faces.size() == solid.report.cap.surface_triangles);

  const Vec3 size = ball.volume.box().size();
  const double full = size.x * size.y * size.z, of_ball = enclosed_volume(solid.mesh);
  std::vector<float> turned;
  for_each_index({20, 20, 20}, [&](int i, int j, int k) {
    turned.push_back(static_cast<float>(-ball.volume.sample(i, j, k)));
  });
  const Volume bubble = Volume::from_samples({20, 20, 20}, ball.volume.spacing(), turned);
  solid = solid_of(bubble, 0);
  check_closed(solid, bubble.box());
  CHECK(mesh_topology(solid.mesh).components.size() == 2);
  CHECK(enclosed_volume(solid.mesh) == doctest::Approx(full - of_ball).epsilon(0.01));

  const ClosedMesh box = solid_of(bubble, -10);
  check_closed(box, bubble.box());
  CHECK(box.mesh.points.size() == 8);
  CHECK(box.mesh.faces.size() == 12);
  CHECK(enclosed_volume(box.mesh) == doctest::Approx(full).epsilon(1e-12));

  const ClosedMesh nothing = solid_of(bubble, 10);
  CHECK(nothing.mesh.faces.empty());
  CHECK(nothing.report.cap.failure == "");
}

TEST_CASE(
    "boundary edges that cross are reported, and so are meshes that do not separate the box") {
  const Box3 box{{0, 0, 0}, {8, 8, 8}};
  const std::array<bool, 8> outside{};
  // Two tents on the face z = 0 whose feet overlap, oriented for an inside below.
  const auto tent = [](double x, VertexId first, std::vector<Vec3>& points,
                       std::vector<Triangle>& triangles) {
    points.insert(points.end(), {{x, 2, 0}, {x + 3, 2, 0}, {x + 1.5, 5, 0}, {x + 1.5, 3, 2}});
    for (VertexId n = 0; n < 3; ++n) {
      triangles.push_back(triangle_of(first + n, first + (n + 1) % 3, first + 3));
    }
  };
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  tent(1, 0, points, triangles);
  {
    const TriMesh mesh = make_tri_mesh(points, triangles);
    BoxCaps caps(mesh, box, outside);
    REQUIRE(caps.failure() == "");
    caps.refine(2);
    CHECK(caps.new_points().empty());
    CHECK(caps.triangles().size() == 1);
    const BoxCaps wrong(make_tri_mesh(points, triangles), box, {true, true, true, true});
    CHECK_FALSE(wrong.failure().empty());
  }
  tent(2, 4, points, triangles);
  const TriMesh crossing = make_tri_mesh(points, triangles);
  const BoxCaps caps(crossing, box, outside);
  CHECK(caps.failure().ends_with("of the boundary meets another one"));
  points[4] = points[1];
  const TriMesh touching = make_tri_mesh(points, triangles);
  CHECK(BoxCaps(touching, box, outside).failure().ends_with("of the boundary coincide"));

  std::vector<Triangle> open{triangles[0], triangles[1]};
  const BoxCaps hole(make_tri_mesh(points, open), box, outside);
  CHECK(hole.failure().ends_with("does not lie on the box"));
}
