// SPDX-License-Identifier: MIT
// The last exercise of the course. Stage 1 is held against every Voronoi edge of its vertices,
// Stage 2 against the exact contour, the balls of its facets, and the sizes of published meshes.
#include "course/figure4.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "check/check_mesh.h"
#include "check/delaunay_share.h"
#include "contour/contour.h"
#include "paper/boundary_curves.h"
#include "paper/program.h"

using namespace deliso;
using namespace deliso::test;

namespace {

struct Case {
  std::string name;
  Field field;
  std::size_t vertices = 0;  // of the published program's mesh; the mean of five seeds
};
std::vector<Case> closed_surfaces() {
  return {{"sphere", builtin("sphere", 24), 250},
          {"torus", builtin("torus", 24), 1905},
          {"linked tori", builtin("linked_tori", 24), 7344}};
}
// Balls that the faces of the box cut, and its edges at one corner.
std::vector<Case> open_surfaces() {
  const auto ball = [](const Vec3& center, double radius) {
    return Field{sampled<float>({17, 17, 17}, {1, 1, 1},
                                [&](int i, int j, int k) {
                                  return radius - distance({1.0 * i, 1.0 * j, 1.0 * k}, center);
                                }),
                 0};
  };
  return {{"faces", ball({7.7, 8.1, 8.2}, 9.2)}, {"corner", ball({0.3, 15.6, 0.2}, 9.3)}};
}

double kappa_of(const Field& field) {
  return geometric_isovalue(field.volume.type(), field.isovalue);
}

TriMesh run_of(const Field& field, std::uint64_t seed, bool stop_after_recover,
               paper::Options options = {}) {
  options.seed = seed;
  options.stop_after_recover = stop_after_recover;
  return course::figure4(field.volume, kappa_of(field), options);
}

void check_topology(const Field& field, const TriMesh& mesh) {
  REQUIRE(check_mesh(mesh) == "");
  const ContourMesh contour = build_contour(field.volume, kappa_of(field));
  CHECK(mesh_topology(mesh).counts() == contour.summary.topology());
  for (const Face& face : mesh.faces) {
    const auto at = [&](std::size_t i) { return mesh.points[face.v[i]]; };
    const Vec3 middle = (1.0 / 3) * (at(0) + at(1) + at(2));
    CHECK(dot(area_normal(at(0), at(1), at(2)), field.volume.gradient(middle)) < 0);
  }
  for (const Vec3& p : mesh.points) {
    REQUIRE(std::fabs(field.volume.value(p) - kappa_of(field)) < 1e-6);
  }
}

// How many times its limit the worst of h/r and r/l is; 0 up to r_min. Infinite if the dual line
// misses Sigma.
double worst_of(const Isosurface& surface, const Vec3& a, const Vec3& b, const Vec3& c,
                double epsilon) {
  const FacetLine line = facet_line(a, b, c);
  SearchCounters counters;
  const auto x = surface.nearest(line.center, line.normal, line.radius, counters);
  if (!x) return std::numeric_limits<double>::infinity();
  const double r_min = 0.001 * surface.volume().box().smallest_side();
  return violation(a, b, c, x->point, epsilon, 2, r_min);
}

// The number of points in which each facet's Voronoi edge meets Sigma, by a search of all of Del S.
std::map<Triangle, std::size_t> searched_facets(const Field& field, const TriMesh& mesh) {
  const Isosurface surface(field.volume, kappa_of(field));
  std::vector<Vec3> points(mesh.points.begin(), mesh.points.end());
  append_auxiliary(field.volume.box(), points);
  Triangulation t;
  std::vector<SiteId> ids;
  REQUIRE(t.build(points, ids));
  std::map<SiteId, VertexId> vertex_of;
  for (VertexId v = 0; v < points.size(); ++v) vertex_of[ids[v]] = v;
  std::map<Triangle, std::size_t> facets;
  SearchCounters counters;
  std::vector<Hit> hits;
  for_each_finite_facet(t, [&](Facet f) {
    const FacetDual edge = facet_dual(t, f);
    const Range range = clip(edge.center, edge.normal, {edge.t_lo, edge.t_hi}, field.volume.box());
    if (range.empty()) return;
    surface.intersect({edge.at(range.lo), edge.at(range.hi)}, hits, counters);
    if (hits.empty()) return;
    Triangle corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = vertex_of.at(facet_vertices(t, f)[i]);
    std::ranges::sort(corners);
    facets[corners] = hits.size();
  });
  return facets;
}

}  // namespace

TEST_CASE(
    "Stage 1: the mesh is Del S|Sigma, no Voronoi edge meets Sigma twice, shapes are limited") {
  for (const Case& of : closed_surfaces()) {
    CAPTURE(of.name);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      CAPTURE(seed);
      const TriMesh mesh = run_of(of.field, seed, true);
      check_topology(of.field, mesh);
      std::map<Triangle, std::size_t> facets = searched_facets(of.field, mesh);
      CHECK(facets.size() == mesh.faces.size());
      const Isosurface surface(of.field.volume, kappa_of(of.field));
      for (const Face& face : mesh.faces) {
        Triangle v = face.v;
        std::ranges::sort(v);
        REQUIRE(facets.contains(v));
        CHECK(facets[v] == 1);
        const auto at = [&](std::size_t i) { return mesh.points[face.v[i]]; };
        CHECK(worst_of(surface, at(0), at(1), at(2), 0.2) <= 1 + 1e-9);
      }
    }
  }
}

TEST_CASE("few points, and no criteria: ExtractManifold leaves disks") {
  paper::Options options;
  options.epsilon = options.lambda = 1e9;
  options.lines = 10;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    const Field field = builtin("linked_tori", 24);
    const TriMesh mesh = run_of(field, seed, true, options);
    REQUIRE(mesh.faces.size() > 0);
    CHECK(check_mesh(mesh) == "");
    CHECK(mesh_topology(mesh).boundary_edges == 0);
    CHECK(searched_facets(field, mesh).size() == mesh.faces.size());
  }
}

TEST_CASE("Stage 2: refined as the published program's, with facets whose balls are empty") {
  for (const Case& of : closed_surfaces()) {
    CAPTURE(of.name);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      CAPTURE(seed);
      const TriMesh mesh = run_of(of.field, seed, false);
      check_topology(of.field, mesh);
      CHECK(mesh.points.size() > 0.9 * static_cast<double>(of.vertices));
      CHECK(mesh.points.size() < 1.1 * static_cast<double>(of.vertices));
      const Isosurface surface(of.field.volume, kappa_of(of.field));
      Faults faults;
      const CleanMesh clean = check_validity(mesh, of.field.volume.box(), MayEnd::on_box, faults);
      std::vector<double> heights;
      const DelaunayShare share = measure_delaunay_share(
          clean, VertexGrids(clean.points, clean.triangles), surface, heights);
      CHECK(share.share() >= 0.999);
      std::size_t over = 0;
      for (FaceId f = 0; f < mesh.faces.size(); ++f) {
        const auto at = [&](std::size_t i) { return mesh.points[mesh.faces[f].v[i]]; };
        over += worst_of(surface, at(0), at(1), at(2), 0.1) > 1 + 1e-9;
      }
      // Few insertions are refused.
      CHECK(over <= mesh.faces.size() / 1000);
    }
  }
}

TEST_CASE("open surfaces: S has the points of the boundary curves, and half disks end the mesh") {
  for (const Case& of : open_surfaces()) {
    CAPTURE(of.name);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      CAPTURE(seed);
      const TriMesh mesh = run_of(of.field, seed, false);
      check_topology(of.field, mesh);
      for (const Vec3& p : paper::marching_squares(of.field.volume, kappa_of(of.field)).points) {
        CHECK(std::ranges::count(mesh.points, p) == 1);
      }
    }
  }
}
