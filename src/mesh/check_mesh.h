// SPDX-License-Identifier: MIT
// Says what a triangle mesh is and what is wrong with it. Slow (it sorts all edges and all corners)
// and independent of the fast path: it trusts no stored neighbor, and shares no code with
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

// A broken rule of tri_mesh.h as one line that opens with its number and names the ids and
// coordinates; empty when all of them hold. I1 comes first, then I2 to I4 edge by edge, I5, I6;
// each is only looked at while the ones before hold.
std::string check_mesh(const TriMesh& mesh);

// Paper §5: a surface may end only where the volume ends. Names the first facet without a neighbor
// across an edge whose ends do not lie on one common face of `box`, by exact equality of a
// coordinate; empty when there is none. pre: I1, linked. `box` is in the frame of the points.
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

// Counted on the corners alone. A component is a set of facets connected through shared vertices.
// An edge is a boundary edge when one facet holds it; boundary loops are the connected pieces of
// the boundary edges, which are loops wherever the mesh is a manifold.
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

// The component of every vertex by its number in MeshTopology::components; kNoId of isolated ones.
// pre: all corners are below the vertex count.
std::vector<std::uint32_t> vertex_components(std::size_t vertices,
                                             std::span<const Triangle> triangles);
std::vector<std::uint32_t> vertex_components(const TriMesh& mesh);

// pre: all corners are below the vertex count; `uses` are edge_uses() of these triangles, and
// `component` is vertex_components().
MeshTopology mesh_topology(std::span<const Vec3> points, std::span<const Triangle> triangles,
                           std::span<const EdgeUse> uses, std::span<const std::uint32_t> component);
MeshTopology mesh_topology(const TriMesh& mesh);

}  // namespace deliso
