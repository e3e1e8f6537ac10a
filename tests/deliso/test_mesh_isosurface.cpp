// SPDX-License-Identifier: MIT
// Both stages on fields of known topology.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "base/elementary.h"
#include "base/random.h"
#include "base/triangle.h"
#include "cases.h"
#include "check/check_mesh.h"
#include "check/place_faults.h"
#include "deliso/mesh_isosurface.h"
#include "fields.h"
#include "mesh/component_kinds.h"
#include "mesh/meshes.h"
#include "run/criteria.h"
#include "run/observer.h"
#include "see.h"
#include "surface/surface_point.h"
#include "volume/sampled.h"

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

// Where facets nearly touch, vertices are moved apart (refine/separate.h): few, and by little.
constexpr double kMovedShare = 1e-3;   // of the vertices
constexpr double kMovedValues = 1e-3;  // of the range of samples

// Waves in a box of samples, and zeros up to `dims`. The last layers of the box are zeros, too:
// points beyond a volume are asked for as its nearest ones.
Volume padded_waves(Index3 waves, Index3 dims) {
  return sampled<std::uint8_t>(dims, {1, 1, 1}, [&](int i, int j, int k) {
    constexpr int kZeros = 5;
    const bool is_within = i < waves.i - kZeros && j < waves.j - kZeros && k < waves.k - kZeros;
    const double wave = sine(0.9 * i + 0.3 * k) + sine(0.8 * j + 0.2 * i) + sine(0.7 * k + 0.4 * j);
    return is_within ? 120 + 35 * wave : 0;
  });
}

// What holds of every mesh, whatever the surface.
void check_sound(const Run& out, const Volume& volume) {
  const TriMesh& mesh = out.mesh;
  INFO(test::see_mesh(test::case_name(), mesh, build_contour(volume, out.report.kappa_effective)));
  CHECK(check_mesh(mesh) == "");
  CHECK(check_boundary_on_box(mesh, volume.box()) == "");
  const ValueRange range = value_range(volume);
  std::size_t moved = 0;
  for (const Vec3& p : mesh.points) {
    CHECK(volume.box().contains(p));
    const double off = std::abs(volume.value(p) - out.report.kappa_effective);
    moved += off > 1e-8 * (range.max - range.min);
    CHECK(off <= kMovedValues * (range.max - range.min));
  }
  CHECK(static_cast<double>(moved) <= 1 + kMovedShare * static_cast<double>(mesh.points.size()));
}

// What a facet measures; without a surface point h is the most there is.
FacetShape shape_of(const TriMesh& mesh, const Face& face, SurfacePointFinder& finder) {
  const Vec3 &a = mesh.points[face.v[0]], &b = mesh.points[face.v[1]], &c = mesh.points[face.v[2]];
  SearchCounters counters;
  const Dual dual = finder.dual(a, b, c, counters);
  FacetShape s = measure(a, b, c, dual.center);
  if (!dual.on_surface) s.h = s.r;
  return s;
}

// Facets with r > r_min that break h/r or r/l; the run must have counted at least as many.
std::size_t violations(const Run& out, const Isosurface& surface, const Options& options) {
  std::size_t count = 0;
  SurfacePointFinder finder(surface);
  for (const Face& face : out.mesh.faces) {
    const FacetShape s = shape_of(out.mesh, face, finder);
    if (s.r <= out.report.r_min) continue;
    count += s.h > options.limits[Criterion::h_over_r].value * s.r ||
             s.r > options.limits[Criterion::r_over_l].value * s.l;
  }
  return count;
}

void check_topology(const TriMesh& mesh, const ContourSummary& exact) {
  CHECK(kinds_of(mesh) == kinds_of(exact));
  CHECK(mesh_topology(mesh).vertices_used == mesh.points.size());
}

bool same_bytes(const TriMesh& a, const TriMesh& b) {
  return a.points.size() == b.points.size() && a.faces.size() == b.faces.size() &&
         std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(Vec3)) == 0 &&
         std::memcmp(a.faces.data(), b.faces.data(), a.faces.size() * sizeof(Face)) == 0;
}

}  // namespace

// Beyond 1e77 products of four overflowed, and other points were found on the surface.
TEST_CASE("samples times a power of two have the same mesh, as far as samples reach") {
  for (std::uint64_t seed = 1; seed <= test::cases(std::uint64_t{20}); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::vector<double> samples(7 * 8 * 9);
    for (double& v : samples) v = random.uniform(-1, 1);
    const auto mesh_of = [&](int exponent) {
      std::vector<double> scaled = samples;
      for (double& v : scaled) v = std::ldexp(v, exponent);
      const Volume volume = Volume::from_samples({7, 8, 9}, {1, 1, 1}, scaled);
      CHECK(value_range(volume).max <= kLargestSample);
      Options options;
      options.cap = seed % 2 == 0;
      return mesh_isosurface(volume, std::ldexp(0.125, exponent), options);
    };
    const int largest = std::ilogb(kLargestSample);
    CHECK(test::same_mesh(mesh_of(largest), mesh_of(0)));
  }
}

TEST_CASE("fields of known topology get meshes of it, well shaped and on the surface") {
  std::size_t inserted = 0;
  for (const char* name : {"sphere", "torus", "linked_tori", "five_spheres", "gyroid", "fuel"}) {
    CAPTURE(name);
    const Scene scene = builtin_scene(name, 32);
    Options options = paper_criteria();
    const Run out = run(scene.volume, scene.surface.kappa(), options);
    check_sound(out, scene.volume);
    check_topology(out.mesh, scene.contour.summary);
    const std::size_t bad = violations(out, scene.surface, options);
    CHECK(bad <= out.report[Counter::unrefined_facets]);
    CHECK(bad <= out.mesh.faces.size() / 1000);
    inserted += out.report.insertions_refine;
  }
  CHECK(inserted > 0);
}

TEST_CASE("stopping after Stage 1 gives a sound mesh of the same topology") {
  const Scene scene = builtin_scene("linked_tori", 32);
  Options options;
  options.stop_after_stage1 = true;
  const Run out = run(scene.volume, scene.surface.kappa(), options);
  check_sound(out, scene.volume);
  check_topology(out.mesh, scene.contour.summary);
  CHECK(out.report.insertions_refine == 0);
  CHECK(out.report.vertices_coarsened == out.mesh.points.size());
}

TEST_CASE("smooth noise cut by the box gives valid meshes, also with anisotropic spacing") {
  for (std::uint64_t seed = 1; seed <= (test::kSanitized ? 2 : 6); ++seed) {
    CAPTURE(seed);
    const Scene scene = wave_scene(seed, 20, {1, 1, seed % 2 == 0 ? 3.0 : 1.0});
    Options options = paper_criteria();
    options.r_min = {0.1, Length::Unit::voxel};
    const Run out = run(scene.volume, scene.surface.kappa(), options);
    check_sound(out, scene.volume);
    check_topology(out.mesh, scene.contour.summary);
  }
}

// All cases of trilinear data in a small volume. Noise of few levels with half-way isovalues has
// saddles exactly at kappa and vertices of T that coincide. Some samples equal the isovalue.
TEST_CASE("tiny volumes of noise have exactly the contour's topology") {
  int components = 0;
  for (std::uint64_t seed = 1; seed <= test::cases(400u); ++seed) {
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
    const ContourSummary exact =
        summarize_contour(volume, geometric_isovalue(volume.type(), isovalue));
    Options options;
    options.r_min = {0.35, Length::Unit::voxel};
    const Run out = run(volume, isovalue, options);
    components += static_cast<int>(exact.components.size());
    CHECK(check_mesh(out.mesh) == "");
    CHECK(check_boundary_on_box(out.mesh, volume.box()) == "");
    check_topology(out.mesh, exact);
  }
  CHECK(components > test::cases(1000));
}

TEST_CASE("no small component is lost, and each is left out that is not asked for") {
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
  Options options;
  const Run out = run(volume, 100.5, options);
  check_sound(out, volume);
  CHECK(mesh_topology(out.mesh).components.size() == 216);
  options.components.min_voxels = 3;
  const Run none = run(volume, 100.5, options);
  CHECK(none.report[Counter::components_skipped] == 216);
  CHECK(none.mesh.faces.empty());
}

TEST_CASE("a flat surface, with all points in one plane, ends on the box") {
  std::vector<float> samples;
  for (int k = 0; k < 8; ++k) samples.insert(samples.end(), 64, static_cast<float>(k));
  const Volume volume = Volume::from_samples({8, 8, 8}, {1, 1, 1}, samples);
  const Run out = run(volume, 3.25, paper_criteria());
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

TEST_CASE("a volume without a voxel is refused") {
  for (const Index3 dims : {Index3{1, 1, 1}, Index3{1, 1, 5}, Index3{3, 1, 2}}) {
    const std::vector<float> samples(static_cast<std::size_t>(dims.i * dims.j * dims.k), 1);
    const Volume volume = Volume::from_samples(dims, {1, 1, 1}, samples);
    CHECK_THROWS_WITH_AS(run(volume, 0.5, {}), "a volume needs two or more samples along each axis",
                         InputError);
  }
}

TEST_CASE("the same input gives the same bytes") {
  const Scene scene = builtin_scene("gyroid", 24);
  Options options = paper_criteria();
  const Run a = run(scene.volume, scene.surface.kappa(), options);
  struct : Observer {  // is told all, and does nothing
    bool follows_insertions() const override { return true; }
  } nobody;
  options.observer = &nobody;
  const Run b = run(scene.volume, scene.surface.kappa(), options);
  CHECK(same_bytes(a.mesh, b.mesh));
}

TEST_CASE("at max_vertices the run ends with a message") {
  const Scene scene = builtin_scene("torus", 32);
  Options options;
  const std::size_t all = run(scene.volume, scene.surface.kappa(), options).mesh.points.size();
  options.max_vertices = all - 50;
  CHECK_THROWS_AS(run(scene.volume, scene.surface.kappa(), options), InputError);
}

TEST_CASE("every facet meets max_distance and max_radius") {
  const Scene scene = builtin_scene("sphere", 32);
  Options options;
  options.limits[Criterion::radius] = {0.9};
  options.limits[Criterion::distance] = {0.02};
  options.r_min = {0.001, Length::Unit::box};
  const Run out = run(scene.volume, scene.surface.kappa(), options);
  CHECK(out.report[Counter::unrefined_facets] == 0);
  CHECK(out.report.max_distance == 0.02);
  SurfacePointFinder finder(scene.surface);
  double largest_h = 0;
  for (const Face& face : out.mesh.faces) {
    const FacetShape s = shape_of(out.mesh, face, finder);
    CHECK(s.r <= 0.9);
    CHECK(s.h <= 0.02);
    largest_h = std::max(largest_h, s.h);
  }
  CHECK(out.report.largest_h == doctest::Approx(largest_h));
}

TEST_CASE("lengths in world units, shares of the box and voxels resolve to the scaled frame") {
  const Volume volume = make_builtin_volume("builtin:sphere:17");
  CHECK(Length{0.5}.in(volume) == 0.5);
  CHECK(Length{0.5, Length::Unit::voxel}.in(volume) == 0.5);
  CHECK(Length{0.5, Length::Unit::box}.in(volume) == 8);
  const Volume flat = Volume::from_samples<float>({3, 3, 5}, {2, 3, 0.5}, std::vector<float>(45));
  CHECK(Length{4}.in(flat) == 4);
  CHECK(Length{4, Length::Unit::voxel}.in(flat) == 4 * flat.voxel());
  CHECK(Length{4, Length::Unit::box}.in(flat) == 8);
  const Parameters p = resolve({}, flat);
  CHECK(p.voxel == flat.voxel());
  CHECK(p.r_min == flat.voxel() / 4);
  CHECK(p.refinement[Criterion::distance] == doctest::Approx(flat.voxel() / 10));
  CHECK(p.refinement[Criterion::h_over_r] == Options::kNone);
}

// The promise of the defaults. threads.sh and stress/division.cpp have the same bytes.
TEST_CASE("defaults: every built-in field gets the exact topology, embedded, on the surface") {
  for (const BuiltinField& field : builtin_fields()) {
    CAPTURE(field.name);
    const Scene scene = builtin_scene(std::string(field.name), field.name == "noise" ? 16 : 32);
    const Run out = run(scene.volume, scene.surface.kappa(), {});
    check_sound(out, scene.volume);
    check_topology(out.mesh, summarize_contour(scene.volume, out.report.kappa_effective));
    CHECK(find_place_faults(out.mesh.points, out.mesh.triangles()).crossings == 0);
    CHECK(out.mesh.faces.size() > 100);
  }
}

// h of needles, 4e-9 or 5e6 voxels, was once said to be the distance that was reached.
TEST_CASE("target_vertices below what the topology needs: as few as can be, and how far they are") {
  for (std::uint64_t seed = 1; seed <= (test::kSanitized ? 2 : 9); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::vector<std::uint8_t> samples(11 * 11 * 11);
    for (std::uint8_t& s : samples) s = static_cast<std::uint8_t>(random.below(4));
    const Volume volume = Volume::from_samples({11, 11, 11}, {1, 1, 1}, samples);
    Options options;
    options.target_vertices = 10;
    const Run out = run(volume, 1.5, options);
    check_sound(out, volume);
    CHECK(find_place_faults(out.mesh.points, out.mesh.triangles()).crossings == 0);
    CHECK(out.mesh.points.size() < 500);
    CHECK(out.report.max_distance > 0.1);
    CHECK(out.report.max_distance < 8);
  }
}

// An open mesh has fewer than two triangles per vertex. A removal takes one or two triangles away.
TEST_CASE("target_triangles gives a mesh of that many, or of one fewer") {
  for (const auto& [field, size] : {std::pair{"linked_tori", 24}, {"gyroid", 16}, {"noise", 16}}) {
    const std::string name = field;
    CAPTURE(name);
    const Scene scene = builtin_scene(name, size);
    for (const std::size_t target : {900u, 1301u, 2000u}) {
      CAPTURE(target);
      Options options;
      options.target_triangles = target;
      const Run out = run(scene.volume, scene.surface.kappa(), options);
      check_sound(out, scene.volume);
      check_topology(out.mesh, scene.contour.summary);
      CHECK(out.mesh.faces.size() <= target);
      CHECK(out.mesh.faces.size() >= target - 1);
    }
  }
}

TEST_CASE("target_vertices gives a mesh of that many, nearer to the surface the more there are") {
  const Scene scene = builtin_scene("linked_tori", 32);
  double before = std::numeric_limits<double>::infinity();
  for (const std::size_t target : {50u, 300u, 1000u, 3000u}) {
    CAPTURE(target);
    Options options;
    options.target_vertices = target;
    const Run out = run(scene.volume, scene.surface.kappa(), options);
    check_sound(out, scene.volume);
    check_topology(out.mesh, scene.contour.summary);
    CHECK(find_place_faults(out.mesh.points, out.mesh.triangles()).crossings == 0);
    CHECK(out.mesh.points.size() == target);
    CHECK(out.report.max_distance < before);
    before = out.report.max_distance;
  }
}

// The gap between facets was a share of the longest side: in 50,000 samples vertices were voxels
// off Sigma. And blocks lay elsewhere.
TEST_CASE("a volume padded with zeros to any length has the same mesh") {
  struct Padding {
    Index3 waves, dims;
  };
  const Padding paddings[] = {{{16, 16, 60}, {16, 16, 61}},    {{16, 16, 60}, {16, 16, 5000}},
                              {{60, 16, 16}, {20000, 16, 16}}, {{16, 60, 16}, {17, 700, 30}},
                              {{42, 42, 42}, {43, 100, 42}},   {{42, 42, 42}, {90, 90, 90}}};
  for (const Padding& padding : paddings) {
    CAPTURE(padding.dims.k);
    const Run alone = run(padded_waves(padding.waves, padding.waves), 120.5, {});
    const Run padded = run(padded_waves(padding.waves, padding.dims), 120.5, {});
    CHECK(alone.mesh.points.size() > 500);
    CHECK(padded.mesh.points == alone.mesh.points);
    CHECK(padded.mesh.triangles() == alone.mesh.triangles());
  }
}
