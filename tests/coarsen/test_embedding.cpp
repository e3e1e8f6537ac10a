// SPDX-License-Identifier: MIT
// The faults that coarsening may leave, put in one by one.
#include "coarsen/embedding.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "coarsen/contour_as_mesh.h"
#include "fields.h"

using namespace deliso;

namespace {

// T of a ball inside another one, of which the inside is between the two.
struct Shells {
  Shells()
      : scene(Volume::from_function({{0, 0, 0}, {31, 31, 31}}, {32, 32, 32},
                                    [](const Vec3& p) {
                                      const double r = length(p - Vec3{15.5, 15.5, 15.5});
                                      return std::min(12 - r, r - 4);
                                    }),
              0.25),
        mesh(contour_as_mesh(scene.contour)),
        box(scene.volume.box()),
        components(mesh.mesh, mesh.chain, 0, box),
        all(mesh.mesh.faces.size(), 1) {
    small = scene.contour.summary.components[0].crossings <
                    scene.contour.summary.components[1].crossings
                ? 0
                : 1;
  }

  EmbeddingFaults faults(const FreeBox& free_box = {}) const {
    return embedding_faults(mesh, components, all, free_box, box);
  }
  template <class Change>
  void change_small(Change&& change) {
    for (VertexId v = 0; v < mesh.mesh.points.size(); ++v) {
      Vec3& p = mesh.mesh.points[v];
      if (scene.contour.component[ContourId(v.number())] == small) p = change(p);
    }
  }

  Scene scene;
  SurfaceMesh mesh;
  Box3 box;
  MeshComponents components;
  std::vector<std::uint8_t> all;
  std::uint32_t small = 0;
};

}  // namespace

TEST_CASE("T has no fault") {
  const Shells shells;
  REQUIRE(shells.components.count() == 2);
  CHECK(shells.faults().none());
}

TEST_CASE("facets that cross are told, if one of them changed") {
  Shells shells;
  shells.change_small([](const Vec3& p) { return p + Vec3{8, 0, 0}; });
  CHECK(shells.faults().facets.size() > 20);
  std::ranges::fill(shells.all, 0);
  CHECK(shells.faults().facets.empty());
}

TEST_CASE("a reversed component is told") {
  Shells shells;
  shells.change_small([](const Vec3& p) { return Vec3{31 - p.x, p.y, p.z}; });
  FreeBox nothing;  // without lines
  nothing.hi.x = -1;
  CHECK(shells.faults(nothing).components == std::vector{shells.small});
}

TEST_CASE("of a component with a frozen facet nobody knows what it bounds") {
  Shells shells;
  const TriMesh& mesh = shells.mesh.mesh;
  shells.components =
      MeshComponents(mesh, shells.mesh.chain, FaceId(mesh.faces.size()), shells.box);
  shells.change_small([](const Vec3& p) { return Vec3{31 - p.x, p.y, p.z}; });
  FreeBox nothing;
  nothing.hi.x = -1;
  CHECK(shells.faults(nothing).components.empty());
}

TEST_CASE("a component bounds a volume together with the faces of the box in which it ends") {
  constexpr double kRadius = 10, kSide = 31;
  for (const Vec3& center :
       {Vec3{15.5, 15.5, 15.5}, Vec3{15.5, 15.5, 0}, Vec3{kSide, 15.5, 0}, Vec3{kSide, 0, kSide}}) {
    const Scene scene(
        Volume::from_function({{0, 0, 0}, {kSide, kSide, kSide}}, {32, 32, 32},
                              [&](const Vec3& p) { return kRadius - distance(p, center); }),
        0);
    const SurfaceMesh s = contour_as_mesh(scene.contour);
    const MeshComponents components(s.mesh, s.chain, 0, scene.volume.box());
    REQUIRE(components.count() == 1);
    double ball = 4 * std::numbers::pi / 3 * kRadius * kRadius * kRadius;
    for (int axis = 0; axis < 3; ++axis) ball /= center[axis] == 15.5 ? 1 : 2;
    CHECK(components.bounded[0] / 6 == doctest::Approx(ball).epsilon(0.02));
  }
}

TEST_CASE("a facet without an area is told") {
  SurfaceMesh s;
  s.mesh = make_tri_mesh({{1, 1, 1}, {2, 2, 2}, {4, 4, 4}}, std::vector<Triangle>{{0, 1, 2}});
  const Box3 box{{0, 0, 0}, {9, 9, 9}};
  const std::vector<std::uint8_t> changed{1};
  CHECK(embedding_faults(s, {s.mesh, s.chain, 0, box}, changed, {}, box).facets.size() == 1);
}

TEST_CASE("a component on the wrong side of another is told, within the free box") {
  Shells shells;
  // Out of the large ball, where it bounds what is outside already.
  shells.change_small([](const Vec3& p) {
    return Vec3{29, 15.5, 15.5} + 0.2 * (p - Vec3{15.5, 15.5, 15.5});
  });
  const EmbeddingFaults faults = shells.faults();
  CHECK(faults.components.size() >= 1);
  FreeBox far;
  far.hi.x = 2;
  CHECK(shells.faults(far).components.empty());
}
