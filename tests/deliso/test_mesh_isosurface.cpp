// SPDX-License-Identifier: MIT
// Both stages on fields of known topology, by both ways through Recover.
#include <doctest/doctest.h>

#include <cstring>

#include "base/triangle.h"
#include "surface/criteria.h"
#include "deliso/deliso.h"
#include "deliso/fields.h"
#include "mesh/check_mesh.h"

using namespace deliso;

namespace {

struct Run {
  TriMesh mesh;
  Report report;
};

Run run(const Volume& volume, double isovalue, const Options& options) {
  Run out;
  out.mesh = mesh_isosurface(volume, isovalue, options, out.report);
  return out;
}

// What holds of every mesh, whatever the surface.
void check_sound(const Run& out, const Volume& volume) {
  const TriMesh& mesh = out.mesh;
  CHECK(check_mesh(mesh) == "");
  CHECK(check_boundary_on_box(mesh, volume.box()) == "");
  const ValueRange range = value_range(volume);
  for (const Vec3& p : mesh.points) {
    CHECK(volume.box().contains(p));
    CHECK(std::abs(volume.value(p) - out.report.kappa_effective) <= 1e-8 * (range.max - range.min));
  }
}

// Facets with r > r_min that break h/r or r/l; the run must have counted at least as many.
std::size_t violations(const Run& out, const Options& options) {
  std::size_t count = 0;
  for (std::size_t f = 0; f < out.mesh.faces.size(); ++f) {
    const auto& v = out.mesh.faces[f].v;
    const FacetShape s = measure(out.mesh.points[v[0]], out.mesh.points[v[1]],
                                 out.mesh.points[v[2]], out.mesh.surface_points[f]);
    if (s.r <= out.report.r_min) continue;
    count += s.h > options.epsilon1 * s.r || s.r > options.lambda * s.l;
  }
  return count;
}

void check_topology(const TriMesh& mesh, const ContourSummary& exact) {
  const MeshTopology topology = mesh_topology(mesh);
  CHECK(topology.components.size() == exact.components.size());
  CHECK(topology.euler() == exact.euler());
  CHECK(topology.boundary_loops == exact.boundary_loops());
  CHECK(topology.duplicate_faces == 0);
  CHECK(topology.isolated_vertices == 0);
}

}  // namespace

TEST_CASE("fields of known topology come out right, well shaped and on the surface") {
  for (const char* name : {"sphere", "torus", "linked_tori", "five_spheres", "gyroid", "fuel"}) {
    for (const RecoverWay way : {RecoverWay::certified, RecoverWay::paper}) {
      CAPTURE(name);
      CAPTURE(static_cast<int>(way));
      const Scene scene = builtin_scene(name, 32);
      Options options;
      options.recover = way;
      options.epsilon1 = 0.15;
      const Run out = run(scene.volume, scene.surface.kappa(), options);
      check_sound(out, scene.volume);
      check_topology(out.mesh, scene.contour.summary);
      const std::size_t bad = violations(out, options);
      CHECK(bad <= out.report[Counter::unrefined_facets]);
      CHECK(bad <= out.mesh.faces.size() / 1000);
      CHECK(out.report.points_refined > 0);
    }
  }
}

TEST_CASE("stopping after Recover, and the single stage, give sound meshes of the same topology") {
  const Scene scene = builtin_scene("linked_tori", 32);
  Options options;
  options.recover = RecoverWay::paper;
  options.stop_after_recover = true;
  Run out = run(scene.volume, scene.surface.kappa(), options);
  check_sound(out, scene.volume);
  check_topology(out.mesh, scene.contour.summary);
  CHECK(out.report.points_refined == 0);
  options.stop_after_recover = false;
  options.single_stage = true;
  out = run(scene.volume, scene.surface.kappa(), options);
  check_sound(out, scene.volume);
  check_topology(out.mesh, scene.contour.summary);
  CHECK(violations(out, options) <= out.mesh.faces.size() / 1000);
}

TEST_CASE("smooth noise cut by the box, also with anisotropic spacing") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    for (const RecoverWay way : {RecoverWay::certified, RecoverWay::paper}) {
      CAPTURE(seed);
      CAPTURE(static_cast<int>(way));
      const Scene scene = wave_scene(seed, 20, {1, 1, seed % 2 == 0 ? 3.0 : 1.0});
      Options options;
      options.recover = way;
      options.r_min = {0.1, true};
      const Run out = run(scene.volume, scene.surface.kappa(), options);
      check_sound(out, scene.volume);
      const MeshTopology topology = mesh_topology(out.mesh);
      CHECK(topology.components.size() == scene.contour.summary.components.size());
      CHECK(topology.boundary_loops == scene.contour.summary.boundary_loops());
      if (way == RecoverWay::certified) check_topology(out.mesh, scene.contour.summary);
    }
  }
}

// Everything that trilinear data can do in a small place: noise of few levels, half-way isovalues
// (saddles exactly at kappa, vertices of the contour that coincide), samples equal to the isovalue.
TEST_CASE("certified: tiny volumes of noise have exactly the contour's topology") {
  int components = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Index3 dims{2 + static_cast<int>(random.below(6)), 2 + static_cast<int>(random.below(6)),
                      2 + static_cast<int>(random.below(6))};
    const std::uint32_t levels = 2 + random.below(30);
    std::vector<std::uint8_t> samples;
    for (int n = 0; n < dims.i * dims.j * dims.k; ++n) {
      samples.push_back(static_cast<std::uint8_t>(random.below(levels)));
    }
    const double isovalue = 0.5 * levels - 0.5 * random.below(2) + (seed % 3 == 0 ? 0.1 : 0);
    const Volume volume = Volume::from_samples(dims, {1, 1, 1.0 + random.below(3)}, samples);
    const ContourSummary exact = summarize_contour(volume, settled_isovalue(volume, isovalue));
    Options options;
    options.recover = RecoverWay::certified;
    options.r_min = {0.35, true};
    options.seed = seed;
    const Run out = run(volume, isovalue, options);
    components += static_cast<int>(exact.components.size());
    CHECK(check_mesh(out.mesh) == "");
    CHECK(check_boundary_on_box(out.mesh, volume.box()) == "");
    CHECK(out.report[Counter::uncertified_sites] == 0);
    check_topology(out.mesh, exact);
  }
  CHECK(components > 1000);
}

TEST_CASE("no component is missing among specks of all sizes") {
  // Bright samples on a dark ground: octahedra far smaller than r_min beside larger ones.
  Random random(3);
  std::vector<std::uint8_t> samples(24 * 24 * 24, 0);
  for (int k = 2; k < 23; k += 4) {
    for (int j = 2; j < 23; j += 4) {
      for (int i = 2; i < 23; i += 4) {
        samples[static_cast<std::size_t>(i + 24 * (j + 24 * k))] =
            static_cast<std::uint8_t>(101 + random.below(155));
      }
    }
  }
  const Volume volume = Volume::from_samples({24, 24, 24}, {1, 1, 1}, samples);
  for (const RecoverWay way : {RecoverWay::certified, RecoverWay::paper}) {
    CAPTURE(static_cast<int>(way));
    Options options;
    options.recover = way;
    options.r_min = {0.25, true};
    const Run out = run(volume, 100.5, options);
    check_sound(out, volume);
    CHECK(mesh_topology(out.mesh).components.size() == 216);
    Options large_only = options;
    large_only.min_component = 3;
    const Run none = run(volume, 100.5, large_only);
    CHECK(none.report[Counter::components_skipped] == 216);
    CHECK(none.mesh.faces.empty());
  }
}

TEST_CASE("a flat surface: all points in one plane, the boundary round the box") {
  std::vector<float> samples;
  for (int k = 0; k < 8; ++k) samples.insert(samples.end(), 64, static_cast<float>(k));
  const Volume volume = Volume::from_samples({8, 8, 8}, {1, 1, 1}, samples);
  for (const RecoverWay way : {RecoverWay::certified, RecoverWay::paper}) {
    CAPTURE(static_cast<int>(way));
    Options options;
    options.recover = way;
    const Run out = run(volume, 3.25, options);
    check_sound(out, volume);
    const MeshTopology topology = mesh_topology(out.mesh);
    CHECK(topology.components.size() == 1);
    CHECK(topology.euler() == 1);
    CHECK(topology.boundary_loops == 1);
    double area = 0;
    for (const Face& face : out.mesh.faces) {
      const Vec3 n = area_normal(out.mesh.points[face.v[0]], out.mesh.points[face.v[1]],
                                 out.mesh.points[face.v[2]]);
      CHECK(n.z < 0);  // normals point to smaller values
      area += 0.5 * length(n);
    }
    CHECK(area == doctest::Approx(49));
  }
}

TEST_CASE("the same input gives the same bytes; another seed another mesh") {
  const Scene scene = builtin_scene("gyroid", 24);
  for (const RecoverWay way : {RecoverWay::certified, RecoverWay::paper}) {
    Options options;
    options.recover = way;
    const Run a = run(scene.volume, scene.surface.kappa(), options);
    const Run b = run(scene.volume, scene.surface.kappa(), options);
    REQUIRE(a.mesh.points.size() == b.mesh.points.size());
    CHECK(std::memcmp(a.mesh.points.data(), b.mesh.points.data(),
                      a.mesh.points.size() * sizeof(Vec3)) == 0);
    REQUIRE(a.mesh.faces.size() == b.mesh.faces.size());
    CHECK(std::memcmp(a.mesh.faces.data(), b.mesh.faces.data(),
                      a.mesh.faces.size() * sizeof(Face)) == 0);
    options.seed = 2;
    const Run c = run(scene.volume, scene.surface.kappa(), options);
    CHECK(c.mesh.points != a.mesh.points);
  }
}

TEST_CASE("max_vertices stops with a message, or with the mesh so far on request") {
  const Scene scene = builtin_scene("torus", 32);
  Options options;
  const std::size_t all = run(scene.volume, scene.surface.kappa(), options).mesh.points.size();
  options.max_vertices = all - 50;
  CHECK_THROWS_AS(run(scene.volume, scene.surface.kappa(), options), InputError);
  options.keep_partial = true;
  const Run out = run(scene.volume, scene.surface.kappa(), options);
  check_sound(out, scene.volume);
  CHECK(out.report.stopped_at_max_vertices);
  CHECK(out.mesh.points.size() <= all - 50);
}

TEST_CASE("max_distance and max_radius are kept") {
  const Scene scene = builtin_scene("sphere", 32);
  Options options;
  options.max_radius = 0.9;
  options.max_distance = 0.02;
  const Run out = run(scene.volume, scene.surface.kappa(), options);
  CHECK(out.report[Counter::unrefined_facets] == 0);
  for (std::size_t f = 0; f < out.mesh.faces.size(); ++f) {
    const auto& v = out.mesh.faces[f].v;
    const FacetShape s = measure(out.mesh.points[v[0]], out.mesh.points[v[1]],
                                 out.mesh.points[v[2]], out.mesh.surface_points[f]);
    CHECK(s.r <= 0.9);
    CHECK(s.h <= 0.02);
  }
}
