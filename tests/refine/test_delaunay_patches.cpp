// SPDX-License-Identifier: MIT
// Patches made Delaunay again: a mesh that was, with edges flipped at random, comes back.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "base/random.h"
#include "base/triangle.h"
#include "refine/delaunay_patches.h"
#include "deliso/deliso.h"
#include "deliso/fields.h"
#include "surface/surface_point.h"
#include "mesh/check_mesh.h"
#include "mesh/flip.h"

using namespace deliso;

namespace {

std::set<Triangle> facets_of(const TriMesh& mesh) {
  std::set<Triangle> facets;
  for (const Face& face : mesh.faces) {
    Triangle v = face.v;
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    facets.insert(v);
  }
  return facets;
}

// Flips an edge of f and one of what that makes, and so on: a patch no single flip mends.
void spoil(Recovered& recovered, const Isosurface& surface, FaceId f, int flips, Random& random,
           SearchCounters& counters) {
  TriMesh& mesh = recovered.mesh;
  SurfacePointFinder finder(surface);
  for (int n = 0; n < flips; ++n) {
    const Quad quad = quad_at(mesh, f, static_cast<int>(random.below(3)));
    if (has_diagonal(mesh, quad)) continue;
    flip_edge(mesh, quad);
    for (const FaceId g : {quad.f, quad.g}) {
      const Triangle& v = mesh.faces[g].v;
      const Vec3 &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
      const auto x = finder.find(a, b, c, counters);
      mesh.surface_points[g] = x ? *x : circumcenter(a, b, c);
      recovered.unhit[g] = !x;
    }
    if (random.below(2) == 0) f = quad.g;
  }
}

struct Scrambled {
  std::size_t lost = 0, left = 0, replaced = 0;  // facets before and after; patches
};

Scrambled scramble(const char* field, int flips, std::span<const std::uint64_t> guarded) {
  const Volume volume = make_builtin_volume(field);
  const double isovalue = find_builtin_field(field)->isovalue;
  Options options;
  options.r_min = {0.25, true};
  Report report;
  const Scene scene(make_builtin_volume(field), isovalue);
  Recovered recovered;
  recovered.mesh = mesh_isosurface(volume, isovalue, options, report);
  recovered.unhit.assign(recovered.mesh.faces.size(), 0);
  const std::set<Triangle> before = facets_of(recovered.mesh);
  Random random(7);
  const std::size_t faces = recovered.mesh.faces.size();
  for (FaceId f = 0; f < faces; f += 50) {
    spoil(recovered, scene.surface, f, flips, random, report.searches_refine);
  }
  const auto missing = [&] {
    const std::set<Triangle> now = facets_of(recovered.mesh);
    return static_cast<std::size_t>(std::count_if(
        before.begin(), before.end(), [&](const Triangle& t) { return !now.contains(t); }));
  };
  Scrambled result;
  result.lost = missing();
  result.replaced = make_patches_delaunay(recovered, scene.surface,
                                          refine_criteria(options, report.r_min), guarded, report);
  result.left = missing();
  CHECK(check_mesh(recovered.mesh) == "");
  CHECK(recovered.mesh.faces.size() == faces);
  return result;
}

}  // namespace

TEST_CASE("patches spoilt by flips are restricted Delaunay again") {
  for (const char* field : {"builtin:torus:24", "builtin:sphere:24", "builtin:linked_tori:32"}) {
    for (const int flips : {1, 2, 4}) {
      CAPTURE(field);
      CAPTURE(flips);
      const Scrambled result = scramble(field, flips, {});
      CHECK(result.lost > 15);
      CHECK(result.replaced > 5);
      // Four flips in a row can fold a patch beyond what is taken for one.
      CHECK(result.left <= (flips < 4 ? 0 : result.lost / 4));
    }
  }
}

TEST_CASE("so they are where they are guarded against crossings") {
  std::vector<std::uint64_t> all;
  for (std::uint64_t n = 0; n < 23 * 23 * 23; ++n) all.push_back(n);
  const Scrambled result = scramble("builtin:torus:24", 2, all);
  CHECK(result.lost > 20);
  CHECK(result.left == 0);
}
