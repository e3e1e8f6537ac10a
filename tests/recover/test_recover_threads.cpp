// SPDX-License-Identifier: MIT
// Stage 1 in threads: T, its graph, labels and K are the same with any number of them.
#include <doctest/doctest.h>

#include <algorithm>

#include "contour/block_order.h"
#include "deliso/deliso.h"
#include "deliso/fields.h"
#include "deliso/options.h"
#include "recover/labels.h"
#include "stage1/boundary_loops.h"
#include "stage1/first_sample.h"

using namespace deliso;

namespace {

struct Outcome {
  DelaunayMesh recovered;
  Report report;
};

Outcome stage_1(const Scene& scene, int threads) {
  Options options;
  options.threads = threads;
  Report report;
  ContourMesh contour = build_contour(scene.volume, scene.surface.kappa(), threads);
  DelaunayMesh recovered = delaunay_mesh(scene.surface, std::move(contour), stage1_only(),
                                         resolve(options, scene.volume), report);
  return {std::move(recovered), std::move(report)};
}

void check_same(const Outcome& a, const Outcome& b) {
  const SurfaceMesh &m = a.recovered.mesh, &n = b.recovered.mesh;
  CHECK(m.mesh.points == n.mesh.points);
  CHECK(std::equal(m.mesh.faces.begin(), m.mesh.faces.end(), n.mesh.faces.begin(),
                   n.mesh.faces.end(), [](const Face& f, const Face& g) { return f.v == g.v; }));
  CHECK(std::equal(m.duals.begin(), m.duals.end(), n.duals.begin(), n.duals.end(),
                   [](const Dual& d, const Dual& e) {
                     return d.center == e.center && d.radius2 == e.radius2 &&
                            d.on_surface == e.on_surface;
                   }));
  for (VertexId v = 0; v < m.mesh.points.size(); ++v) {
    REQUIRE(m.chain.is_boundary(v) == n.chain.is_boundary(v));
    if (m.chain.is_boundary(v)) REQUIRE(m.chain.next(v) == n.chain.next(v));
  }
  CHECK(a.recovered.samples == b.recovered.samples);
  CHECK(a.report.counters == b.report.counters);
  CHECK(a.report.searches_recover.searches == b.report.searches_recover.searches);
  CHECK(a.report.searches_recover.computations == b.report.searches_recover.computations);
}

}  // namespace

TEST_CASE("Stage 1 gives the same mesh with any number of threads") {
  const auto check = [](const Scene& scene) {
    const Outcome one = stage_1(scene, 1);
    CHECK(one.recovered.mesh.mesh.points.size() > 100);
    for (const int threads : {2, 3, 8}) {
      CAPTURE(threads);
      check_same(stage_1(scene, threads), one);
    }
  };
  for (const char* name : {"gyroid", "noise", "machine"}) {
    CAPTURE(name);
    check(builtin_scene(name, 48));
  }
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CAPTURE(seed);
    check(wave_scene(seed, 20));
  }
}

TEST_CASE("labels and rings are the same with any number of threads, and rings are in order") {
  Scene scene = builtin_scene("gyroid", 64);
  ContourMesh& contour = scene.contour;
  order_by_blocks(contour, scene.volume);
  REQUIRE(contour.points.size() > 20000);
  const BoundaryCurves curves =
      BoundaryCurves(scene.surface, std::make_shared<const BoundaryLoops>(boundary_loops(contour)));
  Report report;
  const FirstSample sites =
      init_triangulation(contour, curves, scene.volume, resolve(Options{}, scene.volume), report);
  const Labels one(contour, sites.triangulation, 1);
  const ContourGraph graph(contour, 1);

  std::vector<Triangle> round;
  for (VertexId v = 0; v < contour.points.size(); ++v) {
    const std::span<const VertexId> ring = graph.ring(v);
    const bool inner = !contour.on_boundary(v);
    for (std::size_t n = 0; n + !inner < ring.size(); ++n) {
      const VertexId u = ring[n], w = ring[(n + 1) % ring.size()];
      if (v < u && v < w) round.push_back({v, u, w});
    }
  }
  std::vector<Triangle> triangles(contour.triangles.begin(), contour.triangles.end());
  std::size_t on_chains = 0;
  for (std::size_t c = 0; c < contour.boundary.size(); ++c) {
    const std::span<const VertexId> chain = contour.boundary.chain(c);
    for (std::size_t k = 0; k < chain.size(); ++k, ++on_chains) {
      REQUIRE(graph.ring(chain[k]).front() == chain[(k + 1) % chain.size()]);
      REQUIRE(graph.ring(chain[(k + 1) % chain.size()]).back() == chain[k]);
    }
  }
  CHECK(on_chains ==
        contour.points.size() - static_cast<std::size_t>(std::ranges::count(contour.box_faces, 0)));
  for (Triangle& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  std::sort(round.begin(), round.end());
  CHECK(round == triangles);

  for (const int threads : {2, 3, 8}) {
    CAPTURE(threads);
    const Labels several(contour, sites.triangulation, threads);
    CHECK(std::ranges::equal(several.all(), one.all()));
    const ContourGraph rings(contour, threads);
    for (VertexId v = 0; v < contour.points.size(); ++v) {
      REQUIRE(std::ranges::equal(rings.ring(v), graph.ring(v)));
    }
  }
}
