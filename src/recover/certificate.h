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
};

// A facet of the dual: three sites as the triangle of T runs on which their labels meet, beginning
// with the smallest, and that triangle.
struct DualFacet {
  std::array<VertexId, 3> sites;
  std::array<VertexId, 3> witness;
};

class Certificate {
 public:
  Certificate(const ContourMesh& contour, const ContourGraph& graph, const Labels& labels)
      : graph_(graph), labels_(labels), visited_(contour.points.size(), 0) {}

  // Tests C1-C4 at `site`, whose own vertex of T is `at`. Cost: the triangles at L.
  Verdict check(VertexId site, VertexId at);

  // The dual's facets at the site checked last: each starts with that site.
  std::span<const DualFacet> facets() const { return facets_; }

 private:
  // What the region shares with one neighbour.
  struct Interface {
    VertexId site;
    int edges = 0, twice_faces = 0, boundary_edges = 0;
    VertexId furthest = kNoId;
  };
  Interface& interface_with(VertexId site);

  const ContourGraph& graph_;
  const Labels& labels_;
  std::vector<std::uint32_t> visited_;
  std::uint32_t stamp_ = 0;
  std::vector<VertexId> reached_;
  std::vector<Interface> interfaces_;
  std::vector<DualFacet> facets_;
};

}  // namespace deliso
