// SPDX-License-Identifier: MIT
// The kept hits against a search of every facet from scratch.
#include "paper/restricted.h"

#include <doctest/doctest.h>

#include "deliso/fields.h"
#include "deliso/options.h"
#include "stage1/first_sample.h"
#include "stage1/poles.h"
#include "surface/boundary.h"

using namespace deliso;

namespace {

// Compares the record of every facet with a fresh search; returns how many facets meet Sigma.
int check_against_search(const RestrictedDelaunay& restricted) {
  const Triangulation& t = restricted.triangulation();
  const Isosurface& surface = restricted.surface();
  const Box3 box = surface.volume().box();
  SearchCounters counters;
  std::vector<Hit> hits;
  int meeting = 0;
  for (CellId c = 0; c < t.cell_capacity(); ++c) {
    if (!t.is_live(c)) continue;
    for (int i = 0; i < 4; ++i) {
      const Facet f{c, i};
      if (c > t.neighbor(c, i) || has_infinite_vertex(t, f)) continue;
      const RecordId r = restricted.record(f);
      CHECK(r == restricted.record(t.mirror(f)));
      const FacetDual dual = facet_dual(t, f);
      const Range range = clip(dual.center, dual.normal, {dual.t_lo, dual.t_hi}, box);
      hits.clear();
      if (!range.empty()) {
        surface.intersect({dual.at(range.lo), dual.at(range.hi)}, hits, counters);
      }
      meeting += !hits.empty();
      REQUIRE((r != kNoId) == !hits.empty());
      if (r == kNoId) continue;
      CHECK((restricted.facet(r) == f || restricted.facet(r) == t.mirror(f)));
      const std::span<const Vec3> kept = restricted.effective_hits(r);
      REQUIRE(kept.size() == hits.size());  // delta is 0: nothing cancels
      for (std::size_t k = 0; k < hits.size(); ++k) {
        // The facet may have been searched from its other side, along the same line.
        CHECK(distance(kept[k], hits[k].point) < 1e-6);
      }
    }
  }
  return meeting;
}

}  // namespace

TEST_CASE("hits kept under insertion are those of a fresh search") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    CAPTURE(seed);
    const Scene scene = wave_scene(seed, 16);
    const BoundaryCurves curves = BoundaryCurves(
        scene.surface, std::make_shared<const BoundaryLoops>(boundary_loops(scene.contour)));
    Report report;
    Options options;
    options.seed = seed;
    options.r_min = {0.05};
    FirstSample sample = init_triangulation(scene.contour, curves, scene.volume,
                                            resolve(options, scene.volume), report);
    RestrictedDelaunay restricted(scene.surface, std::move(sample.triangulation), 0, report);
    CHECK(check_against_search(restricted) > 50);
    Random random(seed);
    for (int n = 0; n < 60; ++n) {
      const Vec3& p =
          scene.contour
              .points[random.below(static_cast<std::uint32_t>(scene.contour.points.size()))];
      // A little off the lattice, so that no four points share a circle by construction.
      const Vec3 q = p + Vec3{random.uniform(0, 1e-3), random.uniform(0, 1e-3), 0};
      if (restricted.prepare(q, kNoId).duplicate != kNoId) continue;
      const SiteId v = restricted.insert_prepared(q);
      CHECK(restricted.touched()[0] == v);
      if (n % 10 == 9) check_against_search(restricted);
    }
  }
}

TEST_CASE("pole heights are those of a brute-force search over Voronoi vertices") {
  const Scene scene = builtin_scene("torus", 32);
  const BoundaryCurves curves = BoundaryCurves(
      scene.surface, std::make_shared<const BoundaryLoops>(boundary_loops(scene.contour)));
  Report report;
  const Parameters parameters = resolve(Options::paper(), scene.volume);
  const FirstSample sample =
      init_triangulation(scene.contour, curves, scene.volume, parameters, report);
  const Triangulation& t = sample.triangulation;
  const std::vector<double> poles = compute_poles(t, scene.surface, parameters, report);
  for (SiteId q = 1; q < t.vertex_capacity(); ++q) {
    const Vec3& p = t.point(q);
    if (is_auxiliary(p, scene.volume.box())) continue;
    const Vec3 gradient = scene.surface.gradient(p);
    double inside = 0, outside = 0;
    for (CellId c = 0; c < t.cell_capacity(); ++c) {
      if (!t.is_live(c) || t.is_infinite(c)) continue;
      const auto& v = t.vertices(c);
      if (std::find(v.begin(), v.end(), q) == v.end()) continue;
      const Vec3 center = circumsphere(t, c).center;
      double& side = dot(center - p, gradient) > 0 ? inside : outside;
      side = std::max(side, distance(center, p));
    }
    CHECK(poles[q] == doctest::Approx(std::min(inside, outside)).epsilon(1e-9));
    // The torus's tube is some 5 voxels thick: its axis is the inner pole's place.
    CHECK(poles[q] < 16);
  }
}
