// SPDX-License-Identifier: MIT
// A disk of facets: Stage 2 replaces one disk by another.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tri_mesh.h"

namespace deliso {

// A disk of facets, each by its corners, with their adjacency. Linking takes a step for every two
// corners.
struct Disk {
  static constexpr std::uint32_t kNone = 0xffffffff;
  struct BoundaryEdge {
    VertexId from, to;    // in the direction of the facet
    std::uint32_t facet;  // its number in the disk
    int side;             // of that facet
  };
  std::vector<Triangle> facets;
  std::vector<std::array<std::uint32_t, 3>> across;  // facet across side i, or kNone
  std::vector<BoundaryEdge> boundary;

  // Links `facets`. Returns true if they are a disk: connected, with one simple boundary and V - E
  // + F = 1, which only a disk has.
  bool link();
  // Links a cone without a search: facet k is that of edge k of `rim`, the boundary of a disk, with
  // the apex as its last corner. Returns false if the facets are something else.
  bool link_cone(const std::vector<BoundaryEdge>& rim, VertexId apex);
  // Returns the vertices of the facets linked last.
  std::span<const VertexId> vertices() const { return corners_; }
  // Returns how many vertices are not on the boundary. pre: a disk.
  std::size_t inner_vertices() const { return corners_.size() - boundary.size(); }

 private:
  // The steps of link(): corners and ends of edges; then facets across edges, and the boundary.
  // False if an edge has two facets on one side, or the boundary meets itself.
  void number_corners();
  bool link_edges();
  bool is_one_piece();

  std::vector<VertexId> corners_;
  // Places in corners_. An edge is a side of a facet, numbered 3 * facet + side.
  struct Ends {
    std::size_t from, to;
  };
  std::vector<Ends> ends_;           // per edge
  std::vector<std::uint32_t> edge_;  // per two corners: the edge from one to the other
  std::vector<std::uint32_t> reached_;
  std::vector<std::uint8_t> is_reached_;
};

}  // namespace deliso
