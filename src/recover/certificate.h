// SPDX-License-Identifier: MIT
// The closed-ball conditions on the labels of T: what makes the dual of the labels homeomorphic to
// T, and so to Sigma (docs/proof.md, Theorem 2; after Edelsbrunner and Shah 1997).
//
// The label of a vertex of T is its nearest site. E_ab is the number of edges of T with labels a
// and b, F_aab that of its triangles with labels a, a and b. For every site a, with L the vertices
// of T labeled a:
//   C1  the region (edges and facets of T with all labels a) is connected and V - E + F = 1;
//   C2  for every neighbor b the interface is one arc: E_ab - F_aab - F_abb = 1;
//   C3  three different labels meet on at most one triangle of T;
//   C4  on the box: when L holds boundary vertices the site is one, they form one arc (vertices -
//       edges = 1), and with every neighbor there is at most one boundary edge.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "recover/labels.h"
#include "surface/observer.h"

namespace deliso {

struct Verdict {
  std::optional<Reason> violation;  // region, interface, triple or boundary
  // The vertex of T whose insertion as a site helps: the furthest from its site in the stray piece,
  // region, interface, triple or boundary arc. kNoId: every vertex there is a site already.
  VertexId insert = kNoId;
  bool is_fine() const { return !violation && insert == kNoId; }
};

// A facet of the dual: three sites as the triangle of T runs on which their labels meet, beginning
// with the smallest, and that triangle.
struct DualFacet {
  SiteTriangle sites;
  std::array<VertexId, 3> witness;
};

// Sites may be checked from several threads: a check writes only what belongs to its own region.
class Certificate {
 public:
  // Keeps a reference.
  explicit Certificate(const Labels& labels) : labels_(labels), visited_(labels.all().size(), 0) {}

  // What checks work with: one for each thread.
  struct Scratch {
    // What the region shares with one neighbor.
    struct Interface {
      SiteId site;
      long edges = 0, twice_faces = 0, boundary_edges = 0;
    };
    Interface& interface_with(SiteId site) {
      for (Interface& known : interfaces) {
        if (known.site == site) return known;
      }
      return interfaces.emplace_back(Interface{site});
    }

    std::vector<VertexId> reached;  // as long as it ever had to be
    std::vector<Interface> interfaces;
  };

  // Tests C1-C4 at `site`, whose own vertex of T is `at`. `facets` become those of the dual there:
  // each starts with that site. Cost: the triangles at L.
  Verdict check(SiteId site, VertexId at, Scratch& scratch, std::vector<DualFacet>& facets);

 private:
  // Of the vertices of T on both sides where two regions meet.
  VertexId furthest_between(SiteId a, SiteId b) const;

  const Labels& labels_;
  IdArray<VertexId, std::uint32_t> visited_;  // the last check that reached it
  std::atomic<std::uint32_t> checks_ = 0;
};

}  // namespace deliso
