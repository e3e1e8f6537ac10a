// SPDX-License-Identifier: MIT
// Labels against the nearest of all sites, and what the certificate promises.
#include "recover/labels.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "fields.h"
#include "mesh/tri_mesh.h"
#include "recover/certificate.h"

using namespace deliso;

namespace {

std::vector<SiteId> neighbors_of(const Triangulation& t, SiteId s) {
  std::vector<SiteId> neighbors;
  for (CellId c = 0; c < t.cell_capacity(); ++c) {
    if (!t.is_live(c)) continue;
    const auto& v = t.vertices(c);
    if (std::find(v.begin(), v.end(), s) == v.end()) continue;
    for (const SiteId n : v) {
      if (n != s && n != Triangulation::kInfinite) neighbors.push_back(n);
    }
  }
  std::sort(neighbors.begin(), neighbors.end());
  neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
  return neighbors;
}

void check_nearest(const ContourMesh& contour, const Labels& labels, const Triangulation& t) {
  std::size_t in_regions = 0;
  for (SiteId s = 1; s < t.vertex_capacity(); ++s) {
    in_regions += labels.region(s).size();
    for (const ContourId v : labels.region(s)) REQUIRE(labels.label(v) == s);
  }
  CHECK(in_regions == contour.points.size());
  for (ContourId v = 0; v < contour.points.size(); ++v) {
    double nearest2 = std::numeric_limits<double>::infinity();
    for (SiteId s = 1; s < t.vertex_capacity(); ++s) {
      nearest2 = std::min(nearest2, distance2(contour.points[v], t.point(s)));
    }
    REQUIRE(labels.distance2_to_site(v) == nearest2);
    REQUIRE(distance2(contour.points[v], t.point(labels.label(v))) == nearest2);
  }
}

}  // namespace

TEST_CASE("every vertex of T has its nearest site, at first and after every insertion") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    CAPTURE(seed);
    const Scene scene = wave_scene(seed, 14);
    Random random(seed);
    const auto anywhere = [&] {
      return scene.contour
          .points[ContourId(random.below(static_cast<std::uint32_t>(scene.contour.points.size())))];
    };
    std::vector<Vec3> sample;
    for (int n = 0; n < 80; ++n) sample.push_back(anywhere());
    append_auxiliary(scene.volume.box(), sample);
    Triangulation t;
    std::vector<SiteId> ids;
    REQUIRE(t.build(sample, ids));
    Labels labels(scene.contour, t);
    check_nearest(scene.contour, labels, t);
    ConflictZone zone;
    std::vector<CellId> created;
    for (int n = 0; n < 30; ++n) {
      const Vec3 p = anywhere();
      t.find_conflicts(p, kNoId, zone);
      if (zone.duplicate != kNoId) continue;
      const SiteId s = t.insert_in_zone(p, zone, created);
      labels.add_site(s, neighbors_of(t, s));
    }
    check_nearest(scene.contour, labels, t);
  }
}

TEST_CASE("rings hold every triangle of T once, and follow the chains") {
  const Scene scene = builtin_scene("gyroid", 64);
  const ContourMesh& contour = scene.contour;
  REQUIRE(contour.points.size() > 20000);
  const ContourGraph graph(contour);

  std::vector<ContourTriangle> round;
  for (ContourId v = 0; v < contour.points.size(); ++v) {
    const std::span<const ContourId> ring = graph.ring(v);
    const bool inner = !contour.on_boundary(v);
    for (std::size_t n = 0; n + !inner < ring.size(); ++n) {
      const ContourId u = ring[n], w = ring[(n + 1) % ring.size()];
      if (v < u && v < w) round.push_back({v, u, w});
    }
  }
  std::vector<ContourTriangle> triangles(contour.triangles.begin(), contour.triangles.end());
  std::size_t on_chains = 0;
  for (std::size_t c = 0; c < contour.boundary.size(); ++c) {
    const std::vector<ContourId>& chain = contour.boundary.vertices[c];
    for (std::size_t k = 0; k < chain.size(); ++k, ++on_chains) {
      REQUIRE(graph.ring(chain[k]).front() == chain[(k + 1) % chain.size()]);
      REQUIRE(graph.ring(chain[(k + 1) % chain.size()]).back() == chain[k]);
    }
  }
  CHECK(on_chains ==
        contour.points.size() - static_cast<std::size_t>(std::ranges::count(contour.box_faces, 0)));
  for (ContourTriangle& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  std::sort(round.begin(), round.end());
  CHECK(round == triangles);
}

// With every vertex of T a site, the dual is T itself: each triangle is a triple, each region one
// vertex; the certificate must hold, or its conditions were miscounted.
TEST_CASE("the certificate holds when every vertex of T is a site, and the dual is T") {
  for (const char* name : {"torus", "linked_tori", "gyroid"}) {
    CAPTURE(name);
    const Scene scene = builtin_scene(name, 16);
    const ContourMesh& contour = scene.contour;
    std::vector<Vec3> points = contour.points;
    for (const Vec3& corner : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}}) {
      points.push_back(1000 * corner);
    }
    Triangulation t;
    std::vector<SiteId> ids;
    REQUIRE(t.build(points, ids));
    const Labels labels(contour, t);
    Certificate certificate(labels);
    std::vector<DualFacet> facets;
    std::vector<SiteTriangle> dual;
    for (ContourId v = 0; v < contour.points.size(); ++v) {
      const Verdict verdict = certificate.check(ids[v], v, facets);
      REQUIRE_FALSE(verdict.violation);
      for (const DualFacet& f : facets) {
        if (f.sites[0] < f.sites[1] && f.sites[0] < f.sites[2]) dual.push_back(f.sites);
      }
    }
    CHECK(dual.size() == contour.triangles.size());
  }
}
