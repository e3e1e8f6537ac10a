// SPDX-License-Identifier: MIT
// The topological ball property of the labels of T. Where it holds, the dual of the labels is
// homeomorphic to T, and so to Sigma (docs/proof.md, Theorem 2; Edelsbrunner and Shah 1997).
//
// The label of a vertex of T is its nearest site. L(a) is the set of vertices of T labeled a, R(a)
// these with the edges and triangles of T between them: V, E and F in number. E(ab) is the number
// of edges with labels a and b, F(ab) that of triangles with labels a, a, b or a, b, b. For every
// site a:
//   C1  R(a) is connected, and V - E + F = 1;
//   C2  for every neighbor b the interface is one arc: E(ab) - F(ab) = 1;
//   C3  three different labels meet on at most one triangle of T;
//   C4  on the box: if L(a) has boundary vertices, the site is one. They form one arc (vertices -
//       edges = 1). At most one boundary edge leads to any neighbor.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "paper/observer.h"
#include "recover/labels.h"

namespace deliso {

struct Verdict {
  std::optional<paper::Reason> violation;  // region, interface, triple or boundary
  // The vertex of T to insert: the furthest from its site in the stray piece, region, interface,
  // triple or boundary arc. kNoId: every vertex there is a site already.
  ContourId insert = kNoId;
};

// A facet of the dual, and the triangle of T on which the labels of its sites meet. Both have the
// same orientation. The site that was checked comes first.
struct DualFacet {
  SiteTriangle sites;
  ContourTriangle t_triangle;
};

// Tests sites against C1 to C4.
class Certificate {
 public:
  // Keeps a reference.
  explicit Certificate(const Labels& labels) : labels_(labels), visited_(labels.all().size(), 0) {}

  // Tests C1 to C4 at `site`, whose own vertex of T is `at`. Sets `facets` to the dual facets
  // there, each with that site first. Cost: linear in the triangles at L(a).
  Verdict check(SiteId site, ContourId at, std::vector<DualFacet>& facets);

 private:
  // What C1 and C4 count in R(a): the part that is connected to the site.
  struct Region {
    long V = 0, E = 0, F = 0, boundary_V = 0, boundary_E = 0;
  };
  // What C2 and C4 count between L(a) and L(b): E(ab), F(ab), boundary edges.
  struct Interface {
    SiteId site;  // b
    long E = 0, F = 0, boundary_E = 0;
  };
  // Counts the region, sets interfaces_ and `facets`.
  Region count_region(SiteId a, ContourId at, std::vector<DualFacet>& facets);
  // Counts the edges and triangles at v, a vertex of L(a), in the region and its interfaces.
  void count_at(SiteId a, ContourId v, Region& r, std::vector<DualFacet>& facets);
  Interface& interface_with(SiteId site) {
    for (Interface& known : interfaces_) {
      if (known.site == site) return known;
    }
    return interfaces_.emplace_back(Interface{site});
  }
  // Returns the vertex furthest from its site among the vertices of a and b where they meet.
  ContourId furthest_between(SiteId a, SiteId b) const;

  const Labels& labels_;
  IdArray<ContourId, std::uint32_t> visited_;  // the last check that reached it
  std::uint32_t checks_ = 0;
  std::vector<ContourId> reached_;  // never shrinks
  std::vector<Interface> interfaces_;
};

}  // namespace deliso
