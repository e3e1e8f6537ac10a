// SPDX-License-Identifier: MIT
// Del S|Sigma after every insertion, against a search of all Voronoi edges.
#include "paper/restricted.h"

#include <doctest/doctest.h>

#include <set>

#include "paper/program.h"

using namespace deliso;
using namespace deliso::test;
using paper::RestrictedDelaunay;

namespace {

// The same facets with the same points, whichever search found them.
bool same_hits(const FacetHits& a, const FacetHits& b) {
  const auto same_point = [](const Vec3& p, const Vec3& q) { return distance(p, q) < 1e-6; };
  return std::ranges::equal(a, b, [&](const auto& f, const auto& g) {
    return f.first == g.first && std::ranges::equal(f.second, g.second, same_point);
  });
}

// What the last insertion, of v, should have told: the facets in the cells at v, and the corners of
// facets that came or went.
void check_told(const RestrictedDelaunay& del, SiteId v, const FacetHits& before,
                const FacetHits& after) {
  const Triangulation& t = del.del();
  std::set<SiteTriangle> around, created;
  for_each_finite_facet(t, [&](Facet f) {
    const auto has_v = [&](CellId c) { return std::ranges::count(t.vertices(c), v) > 0; };
    if ((has_v(f.cell) || has_v(t.mirror(f).cell)) && !del.hits(f).empty()) {
      around.insert(sorted_corners(t, f));
    }
  });
  for (const Facet f : del.created()) created.insert(sorted_corners(t, f));
  CHECK(created == around);
  CHECK(created.size() == del.created().size());
  const std::set<SiteId> touched(del.touched().begin(), del.touched().end());
  CHECK(touched.contains(v));
  for (const auto& [one, other] : {std::pair(&before, &after), std::pair(&after, &before)}) {
    for (const auto& [corners, hits] : *one) {
      if (other->contains(corners)) continue;
      for (const SiteId q : corners) CHECK(touched.contains(q));
    }
  }
}

// The facets at v, and those across from it in its cells, that have a Voronoi edge in the box.
struct FacetsAround {
  std::size_t at = 0, across = 0;
};
FacetsAround facets_around_site(const RestrictedDelaunay& del, SiteId v) {
  const Triangulation& t = del.del();
  FacetsAround count;
  for_each_finite_facet(t, [&](Facet f) {
    const auto has_v = [&](CellId c) { return std::ranges::count(t.vertices(c), v) > 0; };
    const FacetDual edge = facet_dual(t, f);
    const Range range =
        clip(edge.center, edge.normal, {edge.t_lo, edge.t_hi}, del.sigma().volume().box());
    if (!(range.lo < range.hi)) return;
    if (std::ranges::count(facet_vertices(t, f), v) > 0) {
      ++count.at;
    } else if (has_v(f.cell) || has_v(t.mirror(f).cell)) {
      ++count.across;
    }
  });
  return count;
}

}  // namespace

TEST_CASE("the hits of every facet are those of a search after each insertion") {
  // With the larger r_min pairs cancel each other.
  for (const double r_min : {0.001, 1.0}) {
    CAPTURE(r_min);
    std::size_t met = 0, changed = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      CAPTURE(seed);
      paper::Options options = few_vertices();
      options.lines = 10;
      options.seed = seed;
      options.r_min = r_min;
      Program program(noise(seed, 8), options);
      RestrictedDelaunay del = program.del();
      FacetHits before = stored_hits(del);
      CHECK(same_hits(before, searched_hits(del, program.report.r_min)));
      Random random(seed);
      for (int n = 0; n < 40; ++n) {
        // As Recover would: a hit of a facet.
        const auto facet =
            std::next(before.begin(), random.below(static_cast<std::uint32_t>(before.size())));
        const Vec3 p =
            facet->second[random.below(static_cast<std::uint32_t>(facet->second.size()))];
        if (del.find_conflicts(p, kNoId).duplicate != kNoId) continue;
        const std::uint64_t searches = program.report.searches_recover.searches;
        const SiteId v = del.insert(p);
        CHECK(del.del().point(v) == p);
        const FacetHits after = stored_hits(del);
        REQUIRE(same_hits(after, searched_hits(del, program.report.r_min)));
        check_told(del, v, before, after);
        if (r_min == 0.001) {
          // Every facet of the new cells.
          const FacetsAround facets = facets_around_site(del, v);
          CHECK(program.report.searches_recover.searches - searches == facets.at + facets.across);
        }
        met += after.size();
        changed += !std::ranges::equal(before, after);
        before = after;
      }
    }
    CHECK(met > 1000);
    CHECK(changed > 100);
  }
}

TEST_CASE("pairs of hits nearer than r_min / 10 cancel each other, and are counted") {
  paper::Options options = few_vertices();
  options.lines = 10;
  const Program all(noise(1, 8), options);
  options.r_min = 1;
  const Program fewer(noise(1, 8), options);
  CHECK(all.report.cancelled_pairs == 0);
  CHECK(fewer.report.cancelled_pairs > 0);
  std::size_t hits = 0, left = 0;
  for (const auto& [corners, x] : stored_hits(all.del())) hits += x.size();
  for (const auto& [corners, x] : stored_hits(fewer.del())) left += x.size();
  CHECK(left + 2 * fewer.report.cancelled_pairs == hits);
}

TEST_CASE("hits behind the second may cancel, too") {
  // Three sheets, the last two of which are near each other, and sites on the first.
  Random random(1);
  paper::Options options = few_vertices();
  options.r_min = 2;
  const auto level = [&](int, int, int k) {
    return (k < 3 || k == 5 ? 1 : -1) * random.uniform(1, 1.2);
  };
  Program program({sampled<float>({8, 8, 8}, {1, 1, 1}, level), 0}, options);
  std::vector<Vec3> points;
  for (int n = 0; n < 12; ++n) {
    points.push_back({random.uniform(0, 7), random.uniform(0, 7), random.uniform(2.4, 2.6)});
  }
  append_auxiliary(program.volume.box(), points);
  Triangulation t;
  std::vector<SiteId> ids;
  REQUIRE(t.build(points, ids));
  program.report.cancelled_pairs = 0;
  const RestrictedDelaunay del(std::move(t), program.sigma, program.options, program.report);
  CHECK(program.report.cancelled_pairs > 0);
  CHECK(same_hits(stored_hits(del), searched_hits(del, program.report.r_min)));
}

TEST_CASE("star() is D_q, and the measures are those of the triangle") {
  Program program(builtin("torus", 24), few_vertices());
  program.recovery.multi_intersect();
  program.recovery.extract_manifold();
  const Triangulation& t = program.del().del();
  std::map<SiteId, std::set<SiteTriangle>> expected;
  for (const auto& [corners, hits] : stored_hits(program.del())) {
    for (const SiteId q : corners) expected[q].insert(corners);
  }
  std::vector<Facet> d_q;
  for (SiteId q = 1; q < t.vertex_capacity(); ++q) {
    program.del().star(q, d_q);
    std::set<SiteTriangle> found;
    for (const Facet f : d_q) found.insert(sorted_corners(t, f));
    CHECK(found.size() == d_q.size());
    CHECK(found == expected[q]);
  }
  const auto [r, h, l] = measure({0, 0, 5}, {3, 0, 5}, {0, 4, 5}, {1.5, 2, 7});
  CHECK(r == doctest::Approx(2.5));
  CHECK(h == doctest::Approx(2));
  CHECK(l == doctest::Approx(3));
}
