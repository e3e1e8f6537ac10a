// SPDX-License-Identifier: MIT
// The coarsened contour, on random volumes: a manifold of T's topology, component by component,
// embedded by all pairs, with its vertices on Sigma and Sigma near; and far fewer vertices.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "blocks/grid.h"
#include "cases.h"
#include "check/check_mesh.h"
#include "check/self_intersections.h"
#include "coarsen/coarsen.h"
#include "coarsen/contour_as_mesh.h"
#include "contour/fine_contour.h"
#include "contour/plain_seams.h"
#include "fields.h"
#include "mesh/component_kinds.h"
#include "see.h"
#include "stress/tiny_volume.h"

using namespace deliso;
using stress::make_tiny_volume;

namespace {

struct Coarse {
  explicit Coarse(Scene& scene, const Options& options = {})
      : parameters(resolve(options, scene.volume)),
        loops(std::make_shared<BoundaryLoops>()),
        curves((embed(scene), *loops = scene.contour.boundary.loops,
                BoundaryCurves(scene.surface, loops))),
        mesh(contour_as_mesh(scene.contour)) {
    coarsen(mesh, {scene.surface, curves, parameters, report});
  }

  static void embed(Scene& scene) {
    scene.contour = fine_contour(std::move(scene.contour), scene.volume, scene.surface.kappa());
    make_seams_plain(scene.contour, scene.volume);
  }

  Parameters parameters;
  Report report;
  std::shared_ptr<BoundaryLoops> loops;
  BoundaryCurves curves;
  SurfaceMesh mesh;
};

// Edges within the mesh whose ends lie on one face of the box.
std::size_t edges_on_box(const SurfaceMesh& s, const Box3& box) {
  std::size_t edges = 0;
  for (const Face& face : s.mesh.faces) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 &a = s.mesh.points[face.v[(i + 1) % 3]], &b = s.mesh.points[face.v[(i + 2) % 3]];
      edges += face.n[i] != kNoId && on_one_face(a, b, box);
    }
  }
  return edges;
}

std::size_t crossings(const TriMesh& mesh) {
  const std::vector<Triangle> triangles = mesh.triangles();
  const TriangleTree tree(mesh.points, triangles);
  return find_crossings(mesh.points, triangles, tree).pairs.size();
}

// A ridge along z, flat across the seam at x = 5: the two points where it leaves the seam on the
// face z = 0 are far from each other, and the one between them is next to the seam.
stress::TinyVolume ridge_on_seam() {
  return {sampled<float>({11, 5, 8}, {1, 1, 1},
                         [](int i, int j, int) {
                           return i != 5 || j % 4 == 0 ? -91.0f : j == 2 ? 9.0f : -1.0f;
                         }),
          0};
}

}  // namespace

TEST_CASE("the coarsened contour is embedded, of T's topology, and its vertices lie on Sigma") {
  std::size_t before = 0, after = 0, again = 0;
  for (std::uint64_t seed = 1; seed <= test::cases(2100u); ++seed) {
    CAPTURE(seed);
    const auto tiny = make_tiny_volume(seed, 3, 11);
    Scene scene(tiny.volume, tiny.isovalue);
    if (scene.contour.points.empty()) continue;
    const Coarse coarse(scene);
    const TriMesh& mesh = coarse.mesh.mesh;
    INFO(test::see_mesh(test::case_name(), mesh, scene.contour));
    REQUIRE(check_mesh(mesh) == "");
    CHECK(kinds_of(mesh) == kinds_of(scene.contour.summary));
    CHECK(crossings(mesh) == 0);
    CHECK(edges_on_box(coarse.mesh, tiny.volume.box()) == 0);
    CHECK(ends_on_chain(coarse.mesh));
    CHECK(coarse.mesh.duals.size() == mesh.faces.size());
    before += scene.contour.points.size();
    after += mesh.points.size();
    again += coarse.report[Counter::coarsened_again];
    CHECK(coarse.report[Counter::coarsened_again] < 5);  // it comes to an end before all is kept
  }
  CHECK(after < before);
  CHECK(again > 0);  // some are in the draw
}

TEST_CASE("by a bound of a voxel the topology stays") {
  std::size_t before = 0, after = 0;
  for (std::uint64_t seed = 1; seed <= test::cases(700u); ++seed) {
    CAPTURE(seed);
    const auto tiny = make_tiny_volume(seed, 3, 9);
    Scene scene(tiny.volume, tiny.isovalue);
    if (scene.contour.points.empty()) continue;
    Options options;
    options.limits[Criterion::distance] = {1, Length::Unit::voxel};
    options.limits[Criterion::r_over_l].value = 20;
    const Coarse coarse(scene, options);
    INFO(test::see_mesh(test::case_name(), coarse.mesh.mesh, scene.contour));
    REQUIRE(check_mesh(coarse.mesh.mesh) == "");
    CHECK(kinds_of(coarse.mesh.mesh) == kinds_of(scene.contour.summary));
    CHECK(crossings(coarse.mesh.mesh) == 0);
    before += scene.contour.points.size();
    after += coarse.mesh.mesh.points.size();
  }
  CHECK(after < before);
}

TEST_CASE(
    "facets of the coarsened contour meet the bound and are well shaped, on smooth surfaces") {
  for (const char* name : {"sphere", "linked_tori", "gyroid", "fuel"}) {
    CAPTURE(name);
    Scene scene = builtin_scene(name, 32);
    const Coarse coarse(scene);
    const SurfaceMesh& s = coarse.mesh;
    std::size_t over = 0, needles = 0;
    for (FaceId f = 0; f < s.mesh.faces.size(); ++f) {
      const FacetShape shape = s.shape(s.mesh.faces[f].v, s.duals[f]);
      const Criteria& limits = coarse.parameters.refinement;
      over += shape.r > coarse.parameters.r_min && shape.h > limits[Criterion::distance];
      needles += shape.r > 2.0001 * shape.l;
    }
    CHECK(over <= s.mesh.faces.size() / 100);
    CHECK(needles <= s.mesh.faces.size() / 50);
    CHECK(2 * s.mesh.points.size() < scene.contour.points.size());
    for (const Vec3& p : s.mesh.points) {
      CHECK(std::abs(scene.volume.value(p) - scene.surface.kappa()) <= 1e-6);
    }
  }
}

TEST_CASE("chains stay near their curves with all kept points, and a seam stays as it is") {
  std::size_t on_seams = 0;
  Options options;
  options.limits[Criterion::distance] = {1, Length::Unit::voxel};
  options.limits[Criterion::r_over_l].value = 20;
  for (std::uint64_t seed = 1; seed <= test::cases(300u); ++seed) {
    CAPTURE(seed);
    const auto tiny = seed == 1 ? ridge_on_seam() : make_tiny_volume(seed, 4, 11);
    for (const SampleBox& box : BlockGrid(tiny.volume, 5).boxes()) {
      Scene scene(samples_of(tiny.volume, box), tiny.isovalue);
      if (scene.contour.points.empty()) continue;
      const Coarse coarse(scene, options);
      const auto& [mesh, duals, chain] = coarse.mesh;
      const auto faces_at = [&](const Vec3& p) {
        return box_faces_at(p, scene.volume.box()) & scene.volume.inner_faces();
      };
      std::set<std::pair<std::uint32_t, double>> places;
      for (VertexId v = 0; v < mesh.points.size(); ++v) {
        if (!chain.is_boundary(v)) continue;
        const CurvePlace place = chain.place(v);
        places.insert({place.loop, place.s});
        const VertexId next = chain.next(v);
        const Vec3 &p = mesh.points[v], &q = mesh.points[next];
        CHECK_FALSE(coarse.curves.strays({place, p}, {chain.place(next), q}, 0.1 * distance(p, q)));
        // The neighboring block may have an edge between two points of a seam, too.
        if ((faces_at(p) & faces_at(q)) == 0) continue;
        CHECK(coarse.curves.begins_fixed(place));
        ++on_seams;
      }
      for (std::uint32_t loop = 0; loop < coarse.loops->size(); ++loop) {
        for (std::size_t k = 0; k < coarse.curves.loop(loop).size(); ++k) {
          const CurvePlace place{loop, static_cast<double>(k)};
          if (!coarse.curves.is_kept(place) && !coarse.curves.is_on_fixed(place)) continue;
          CHECK(places.contains({loop, place.s}));
        }
      }
    }
  }
  CHECK(on_seams > 100);
}

TEST_CASE("what is not in the scope stays, and a change is told") {
  Scene scene = builtin_scene("sphere", 24);
  Coarse all(scene);
  Report report;
  SurfaceMesh some = contour_as_mesh(scene.contour);
  CoarsenScope scope;
  // Half of the space is free.
  const double middle = 0.5 * scene.volume.box().hi.x;
  std::stable_partition(some.mesh.faces.begin(), some.mesh.faces.end(), [&](const Face& face) {
    return std::ranges::any_of(face.v, [&](VertexId v) { return some.mesh.points[v].x < middle; });
  });
  link_faces(some.mesh);
  while (std::ranges::any_of(some.mesh.faces[scope.free_box.first_free].v,
                             [&](VertexId v) { return some.mesh.points[v].x < middle; })) {
    ++scope.free_box.first_free;
  }
  scope.free_box.lo.x = middle;
  for (VertexId v = 0; v < some.mesh.points.size(); ++v) scope.first.push_back(v);
  const SurfaceMesh before = some;
  const auto changed = coarsen(some, {scene.surface, all.curves, all.parameters, report},
                               coarsening_bound(all.parameters), scope);
  std::size_t live = 0;
  for (FaceId f = 0; f < some.mesh.faces.size(); ++f) {
    const Face &now = some.mesh.faces[f], &was = before.mesh.faces[f];
    live += !is_dead(now);
    if (f < scope.free_box.first_free) CHECK(now.v == was.v);
    if (changed[f.number()] != 0 || is_dead(now)) continue;
    CHECK(now.v == was.v);
    for (const VertexId v : now.v) CHECK(some.mesh.points[v] == before.mesh.points[v]);
  }
  CHECK(live < before.mesh.faces.size() * 3 / 4);
  CHECK(live > scope.free_box.first_free);
  some.duals.resize(some.mesh.faces.size());
  remove_dead(some);
  CHECK(check_mesh(some.mesh) == "");
}
