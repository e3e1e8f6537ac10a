// SPDX-License-Identifier: MIT
// The closed-ball conditions on the labels of T: what makes the dual of the labels homeomorphic to
// T, and so to Sigma (Edelsbrunner and Shah 1997, on a discrete diagram).
//
// For every site a, with L the vertices of T labelled a:
//   C1  the region (edges and facets of T with all labels a) is connected and V - E + F = 1;
//   C2  for every neighbour b the interface is one arc: E_ab - F_aab - F_abb = 1;
//   C3  every triple of labels is on exactly one triangle of T;
//   C4  on the box: when L holds boundary vertices the site is one, they form one arc (vertices -
//       edges = 1), and with every neighbour there is at most one boundary edge.
#pragma once

#include <cstdint>
#include <vector>

#include "recover/labels.h"

namespace deliso {

enum class Violation : std::uint8_t { none, region, interface, triple, boundary };

struct Verdict {
  Violation violation = Violation::none;
  // The vertex of T whose insertion as a site helps: the furthest from its site in the stray piece,
  // region, interface, triple or boundary arc. kNoId: every vertex there is a site already.
  VertexId insert = kNoId;
  bool is_fine() const { return violation == Violation::none && insert == kNoId; }
};

// A facet of the dual: three sites as the triangle of T runs on which their labels meet, beginning
// with the smallest, and that triangle.
struct DualFacet {
  SiteTriangle sites;
  std::array<VertexId, 3> witness;
};

// Sites are looked at in rounds: between two calls of begin_round() each at most once, in any order
// and from any thread, since a check writes only what belongs to its own region.
class Certificate {
 public:
  Certificate(const ContourMesh& contour, const ContourGraph& graph, const Labels& labels)
      : graph_(graph), labels_(labels), visited_(contour.points.size(), 0) {}

  void begin_round() { ++round_; }

  // What checks work with: one for each thread.
  class Scratch {
    friend class Certificate;
    // What the region shares with one neighbour.
    struct Interface {
      SiteId site;
      long edges = 0, twice_faces = 0, boundary_edges = 0;
    };
    Interface& interface_with(SiteId site) {
      for (Interface& known : interfaces_) {
        if (known.site == site) return known;
      }
      return interfaces_.emplace_back(Interface{site});
    }

    std::vector<VertexId> reached_;  // as long as it ever had to be
    std::vector<Interface> interfaces_;
  };

  // Tests C1-C4 at `site`, whose own vertex of T is `at`. `facets` become those of the dual there:
  // each starts with that site. Cost: the triangles at L.
  Verdict check(SiteId site, VertexId at, Scratch& scratch, std::vector<DualFacet>& facets);

 private:
  // Of the vertices of T on both sides where two regions meet.
  VertexId furthest_between(SiteId a, SiteId b) const;

  const ContourGraph& graph_;
  const Labels& labels_;
  IdArray<VertexId, std::uint32_t> visited_;  // the round in which a check reached it
  std::uint32_t round_ = 1;
};

}  // namespace deliso
