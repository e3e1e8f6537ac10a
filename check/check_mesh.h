// SPDX-License-Identifier: MIT
// Counts the topology of a triangle mesh and finds its faults. Slow (it sorts all edges and all
// corners) and independent of the fast path: it trusts no stored neighbor, and shares no code with
// link_faces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/box3.h"
#include "base/topology_counts.h"
#include "mesh/incidence.h"
#include "mesh/tri_mesh.h"

namespace deliso {

// Returns the first broken invariant of tri_mesh.h as one line with its number, the ids and
// coordinates; empty if all hold. I1 is tested first, then I2 to I4 edge by edge, I5, I6; each only
// if those before hold.
std::string check_mesh(const TriMesh& mesh);

// Returns the first facet without a neighbor across an edge whose ends do not lie on one common
// face of `box`; empty if there is none. A surface may end only where the volume ends (paper §5).
// Coordinates are compared for exact equality; `box` is in the frame of the points. pre: I1,
// linked.
std::string check_boundary_on_box(const TriMesh& mesh, const Box3& box);

struct ComponentTopology {
  std::size_t vertices = 0, edges = 0, faces = 0;
  std::size_t boundary_edges = 0, boundary_loops = 0;
  Box3 box;  // of its vertices

  std::ptrdiff_t euler() const {
    return static_cast<std::ptrdiff_t>(vertices + faces) - static_cast<std::ptrdiff_t>(edges);
  }
  bool closed() const { return boundary_edges == 0; }
};

// The topology of a mesh, counted from the corners alone. A component is a set of facets connected
// through shared vertices. A boundary edge has one facet. Boundary loops are the connected pieces
// of the boundary edges; they are loops if the mesh is a manifold.
struct MeshTopology {
  std::size_t vertices_used = 0;
  std::size_t edges = 0, faces = 0;
  std::size_t boundary_edges = 0, boundary_loops = 0;
  std::vector<ComponentTopology> components;  // in the order of their smallest vertex

  std::ptrdiff_t euler() const {
    return static_cast<std::ptrdiff_t>(vertices_used + faces) - static_cast<std::ptrdiff_t>(edges);
  }
  TopologyCounts counts() const { return {components.size(), euler(), boundary_loops}; }
};

// Returns the component of every vertex by its number in MeshTopology::components; kNoId for
// isolated vertices. pre: all corners are below the vertex count.
std::vector<std::uint32_t> vertex_components(std::size_t vertices,
                                             std::span<const Triangle> triangles);
std::vector<std::uint32_t> vertex_components(const TriMesh& mesh);

// Counts the topology. pre: all corners are below the vertex count; `uses` are edge_uses() of these
// triangles, and `component` is vertex_components().
MeshTopology mesh_topology(std::span<const Vec3> points, std::span<const Triangle> triangles,
                           std::span<const EdgeUse> uses, std::span<const std::uint32_t> component);
MeshTopology mesh_topology(const TriMesh& mesh);

}  // namespace deliso
