// SPDX-License-Identifier: MIT
// One fault put into a good mesh is the one fault that is reported.
#include "check/verify.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>

#include "deliso/deliso.h"
#include "deliso/fields.h"
#include "mesh/flip.h"

namespace deliso {
namespace {

struct Parts {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

Parts parts_of(const TriMesh& mesh) {
  Parts parts{mesh.points, {}};
  for (const Face& face : mesh.faces) parts.triangles.push_back(face.v);
  return parts;
}

struct Good {
  explicit Good(const std::string& name)
      : volume(make_builtin_volume("builtin:" + name)),
        kappa(effective_isovalue(volume, find_builtin_field("builtin:" + name)->isovalue)) {
    Report report;
    mesh = mesh_isosurface(volume, kappa, {}, report);
  }

  Verification verify_parts(const Parts& parts, double share = 0.5) const {
    VerifyOptions options;
    options.restricted_share = share;
    return verify(make_tri_mesh(parts.points, parts.triangles), volume, kappa, options);
  }

  Volume volume;
  double kappa;
  TriMesh mesh;
};

std::vector<FaultKind> kinds_of(const Faults& faults) {
  std::vector<FaultKind> kinds;
  for (std::size_t n = 0; n < kFaultKinds; ++n) {
    const auto kind = static_cast<FaultKind>(n);
    if (faults.count(kind) > 0) kinds.push_back(kind);
  }
  return kinds;
}

void check_only(const Verification& v, FaultKind kind, std::size_t count) {
  CHECK(v.faults.count(kind) == count);
  for (const FaultKind found : kinds_of(v.faults)) {
    INFO("reported: ", std::string(name_of(found)));
    CHECK(found == kind);
    for (const Fault& fault : v.faults.first(found)) CHECK(!fault.what.empty());
  }
}

void remove_unused(Parts& parts) {
  std::vector<VertexId> id(parts.points.size(), kNoId);
  std::vector<Vec3> kept;
  for (Triangle& t : parts.triangles) {
    for (VertexId& v : t) {
      if (id[v] == kNoId) {
        id[v] = static_cast<VertexId>(kept.size());
        kept.push_back(parts.points[v]);
      }
      v = id[v];
    }
  }
  parts.points = std::move(kept);
}

}  // namespace

TEST_CASE("each kind of fault in a sphere is reported, and no other") {
  const Good good("sphere");
  const Parts sphere = parts_of(good.mesh);
  REQUIRE(kinds_of(good.verify_parts(sphere).faults).empty());
  const std::size_t middle = sphere.triangles.size() / 2;

  SUBCASE("hole") {
    Parts p = sphere;
    p.triangles.erase(p.triangles.begin() + static_cast<std::ptrdiff_t>(middle));
    check_only(good.verify_parts(p), FaultKind::holes, 3);
  }
  SUBCASE("flipped triangle") {
    Parts p = sphere;
    std::swap(p.triangles[middle][0], p.triangles[middle][1]);
    check_only(good.verify_parts(p), FaultKind::orientation, 3);
  }
  SUBCASE("duplicated vertex, used by one triangle") {
    Parts p = sphere;
    VertexId& v = p.triangles[middle][0];
    p.points.push_back(p.points[v]);
    v = static_cast<VertexId>(p.points.size() - 1);
    check_only(good.verify_parts(p), FaultKind::duplicate_vertices, 1);
  }
  SUBCASE("unused vertex") {
    Parts p = sphere;
    p.points.push_back({0.5, 0.5, 0.5});
    check_only(good.verify_parts(p), FaultKind::unused_vertices, 1);
  }
  SUBCASE("duplicated triangle") {
    Parts p = sphere;
    p.triangles.push_back(p.triangles[middle]);
    check_only(good.verify_parts(p), FaultKind::duplicate_triangles, 1);
  }
  SUBCASE("extra sphere") {
    Parts p = sphere;
    const Box3 box = good.volume.box();
    const Vec3 center = 0.5 * (box.lo + box.hi);
    const auto first = static_cast<VertexId>(sphere.points.size());
    for (const Vec3& x : sphere.points) p.points.push_back(center + 0.1 * (x - center));
    for (const Triangle& t : sphere.triangles) {
      p.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    check_only(good.verify_parts(p), FaultKind::extra_components, 1);
  }
  SUBCASE("moved vertex") {
    Parts p = sphere;
    Vec3& moved = p.points[sphere.triangles[middle][0]];
    moved = moved + Vec3{1e-4, 2e-4, -1e-4};
    check_only(good.verify_parts(p), FaultKind::vertices_off_surface, 1);
  }
  SUBCASE("turned inside out") {
    Parts p = sphere;
    for (Triangle& t : p.triangles) std::swap(t[0], t[1]);
    check_only(good.verify_parts(p), FaultKind::turned_components, 1);
  }
  SUBCASE("non-Delaunay flip") {
    TriMesh mesh = good.mesh;
    const Verification before = good.verify_parts(parts_of(mesh));
    for (FaceId f = static_cast<FaceId>(middle);; ++f) {
      REQUIRE(f < mesh.faces.size());
      const Quad quad = quad_at(mesh, f, 0);
      if (has_diagonal(mesh, quad)) continue;
      TriMesh flipped = mesh;
      flip_edge(flipped, quad);
      const Verification after = good.verify_parts(parts_of(flipped), before.delaunay.share());
      if (after.delaunay.restricted + 2 != before.delaunay.restricted) continue;
      check_only(after, FaultKind::restricted_share,
                 after.faults.count(FaultKind::restricted_share));
      CHECK(after.faults.count(FaultKind::restricted_share) > 0);
      break;
    }
  }
}

TEST_CASE("a component left out is missing") {
  const Scene scene = wave_scene(3, 24);
  REQUIRE(scene.contour.summary.components.size() > 1);
  Parts p{scene.contour.points, scene.contour.triangles};
  VerifyOptions options;
  options.restricted_share = 0;
  const auto run = [&] {
    return verify(make_tri_mesh(p.points, p.triangles), scene.volume, scene.surface.kappa(),
                  options);
  };
  REQUIRE(kinds_of(run().faults).empty());
  std::erase_if(p.triangles, [&](const Triangle& t) { return scene.contour.component[t[0]] == 1; });
  remove_unused(p);
  check_only(run(), FaultKind::missing_components, 1);
}

}  // namespace deliso
