// SPDX-License-Identifier: MIT
// The interfaces of bodies, as one mesh whose facets border on two bodies each. Bodies share the
// vertices and the facets of their interfaces.
//
// Points are sampled where two, three and four bodies meet. Each cell of their Delaunay
// triangulation gets the body of its circumcenter, and the facets between cells of different bodies
// are the mesh: the Delaunay triangulation restricted to the interfaces (Pons et al. 2007,
// "High-quality consistent meshing of multi-label datasets"; Oudot, Rineau and Yvinec 2005). So
//   1. no two facets cross: they are facets of one triangulation;
//   2. the facets of a body are the boundary of its cells: a closed mesh.
// Manifold bodies and distances are not implied: both are tested, and points are added where they
// fail. The topology of a body is counted, and left to the caller to judge.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/topology_counts.h"
#include "mesh/tri_mesh.h"
#include "more/bodies/partition.h"

namespace deliso {

// A point of an interface, and how far from it the next ones may be.
struct InterfaceSeed {
  Vec3 p;
  double spacing = 0;
};

struct InterfaceFacet {
  Triangle v;  // counter-clockwise seen from the body in front
  // In front and behind. Behind is the body with the smaller number, but never the background.
  std::array<BodyId, 2> bodies{};
};

struct InterfaceMesh {
  std::vector<Vec3> points;
  std::vector<InterfaceFacet> facets;
  std::vector<TopologyCounts> topology;  // of each body's mesh
  std::vector<std::uint8_t> is_manifold;
  double largest_distance = 0;  // of seven points of a facet from its interface, to first order

  // Returns the closed mesh of a body, with the vertices that it uses.
  TriMesh mesh_of(BodyId body) const;
};

// Returns the interfaces. Points are added while the distance of a facet exceeds `max_distance`, or
// a body is no manifold, but none within a hundredth of a voxel of another one. It has one thread.
InterfaceMesh mesh_interfaces(const Partition& partition, std::span<const InterfaceSeed> seeds,
                              double max_distance);

}  // namespace deliso
