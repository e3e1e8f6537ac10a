// SPDX-License-Identifier: MIT
// Vertices moved along Sigma: a mesh whose vertices were pushed about comes back within its limits,
// counted by looking at every facet and every vertex.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/random.h"
#include "base/triangle.h"
#include "deliso/deliso.h"
#include "deliso/fields.h"
#include "refine/move_vertices.h"
#include "surface/surface_point.h"
#include "mesh/check_mesh.h"

using namespace deliso;

namespace {

struct Wanting {
  std::size_t over_limits = 0, not_delaunay = 0;
};

Wanting count_wanting(const Recovered& recovered, const Criteria& criteria) {
  const TriMesh& mesh = recovered.mesh;
  Wanting wanting;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& v = mesh.faces[f].v;
    const Vec3 &a = mesh.points[v[0]], &x = mesh.surface_points[f];
    FacetShape shape = measure(a, mesh.points[v[1]], mesh.points[v[2]], x);
    if (recovered.unhit[f]) shape.h = shape.r;
    wanting.over_limits += is_bad(shape, std::numeric_limits<double>::infinity(), criteria);
    const double radius2 = (1 - 1e-8) * distance2(x, a);
    bool holds = false;
    for (VertexId q = 0; q < mesh.points.size(); ++q) {
      holds |= distance2(x, mesh.points[q]) < radius2 && q != v[0] && q != v[1] && q != v[2];
    }
    wanting.not_delaunay += recovered.unhit[f] || holds;
  }
  return wanting;
}

// Puts the facets' surface points where the mesh's points say.
void find_surface_points(Recovered& recovered, SurfacePointFinder& finder,
                         SearchCounters& counters) {
  TriMesh& mesh = recovered.mesh;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& v = mesh.faces[f].v;
    const Vec3 &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
    const auto x = finder.find(a, b, c, counters);
    mesh.surface_points[f] = x ? *x : circumcenter(a, b, c);
    recovered.unhit[f] = !x;
  }
}

}  // namespace

TEST_CASE("vertices pushed along the surface are moved to where facets are good again") {
  for (const std::string name : {"linked_tori", "orbital"}) {
    for (const bool guarded : {false, true}) {
      CAPTURE(name);
      CAPTURE(guarded);
      const Scene scene = builtin_scene(name, 20);
      Options options;
      Report report;
      Recovered recovered;
      TriMesh& mesh = recovered.mesh;
      mesh = mesh_isosurface(scene.volume, scene.surface.kappa(), options, report);
      recovered.unhit.assign(mesh.faces.size(), 0);
      recovered.pole_heights.assign(mesh.points.size(), std::numeric_limits<double>::infinity());
      const Criteria criteria = refine_criteria(options, report.r_min);
      SurfacePointFinder finder(scene.surface);
      SearchCounters counters;

      std::vector<char> on_boundary(mesh.points.size(), 0);
      for (const Face& face : mesh.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
          if (face.n[i] != kNoId) continue;
          on_boundary[face.v[(i + 1) % 3]] = on_boundary[face.v[(i + 2) % 3]] = 1;
        }
      }
      Random random(3);
      for (VertexId v = 0; v < mesh.points.size(); v += 10) {
        if (on_boundary[v]) continue;
        Vec3 gradient = scene.surface.gradient(mesh.points[v]);
        const Vec3 any{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        const Vec3 along = cross(gradient, any);
        if (!(length(along) > 0)) continue;
        const double far = 0.5 * report.r_min;
        const Vec3 pushed = mesh.points[v] + (far / length(along)) * along;
        if (const auto p = finder.foot(pushed, -1 * gradient, far, counters)) mesh.points[v] = *p;
      }
      find_surface_points(recovered, finder, counters);

      const TriMesh pushed = mesh;
      const Wanting before = count_wanting(recovered, criteria);
      std::vector<std::uint64_t> voxels;
      if (guarded) {
        for (std::uint64_t n = 0; n < 19 * 19 * 19; ++n) voxels.push_back(n);
      }
      const std::size_t moves = move_vertices(recovered, scene.surface, criteria, voxels, report);
      const Wanting after = count_wanting(recovered, criteria);
      MESSAGE(name << ": " << before.over_limits << " + " << before.not_delaunay << " -> "
                   << after.over_limits << " + " << after.not_delaunay << ", " << moves);
      CHECK(before.over_limits + before.not_delaunay > 20);
      CHECK(moves > 5);
      CHECK(4 * after.over_limits <= before.over_limits);
      CHECK(4 * after.not_delaunay <= before.not_delaunay);

      CHECK(check_mesh(mesh) == "");
      for (FaceId f = 0; f < mesh.faces.size(); ++f) REQUIRE(mesh.faces[f].v == pushed.faces[f].v);
      for (VertexId v = 0; v < mesh.points.size(); ++v) {
        if (on_boundary[v]) REQUIRE(mesh.points[v] == pushed.points[v]);
        if (mesh.points[v] == pushed.points[v]) continue;
        const double g = scene.volume.value(mesh.points[v]) - scene.surface.kappa();
        REQUIRE(std::abs(g) <= 1e-6 * length(scene.surface.gradient(mesh.points[v])));
      }
      // What is said of the surface points is true.
      const std::vector<Vec3> said = mesh.surface_points;
      find_surface_points(recovered, finder, counters);
      CHECK(said == mesh.surface_points);
    }
  }
}

TEST_CASE("a mesh with nothing wanting stays as it is") {
  const Scene scene = builtin_scene("sphere", 16);
  Options options;
  Report report;
  Recovered recovered;
  recovered.mesh = mesh_isosurface(scene.volume, scene.surface.kappa(), options, report);
  recovered.unhit.assign(recovered.mesh.faces.size(), 0);
  recovered.pole_heights.assign(recovered.mesh.points.size(),
                                std::numeric_limits<double>::infinity());
  const std::vector<Vec3> before = recovered.mesh.points;
  const Criteria criteria = refine_criteria(options, report.r_min);
  CHECK(move_vertices(recovered, scene.surface, criteria, {}, report) == 0);
  CHECK(recovered.mesh.points == before);
}
