// SPDX-License-Identifier: MIT
// Exercise 13, three hours: a point enters the mesh without tetrahedra.
//
// Figure 3, on the right (§2.2.2). Stage 2 has a mesh alone. A new point p of Sigma takes away E,
// the facets whose balls hold p (exercise 12). D comes in its place: p joined to each edge of E's
// boundary. The house has made sure that E is a disk without vertices inside. It is exercise 3
// once more, a dimension lower.
//
// You are in the class Refinement (paper/refine.cpp, above). The members:
//   mesh_   the mesh (mesh/tri_mesh.h): points, and faces, each with corners v, counter-clockwise,
//           and neighbors n: n[i] lies across the edge opposite v[i], kNoId where the surface
//           ends;
//   t_      what is stored beside: t_.duals[f] of each facet, t_.poles[v] of each vertex;
//   e_      E, the numbers of its facets;
//   disk_   E as a disk (mesh/disk.h). disk_.boundary are its edges, each `from`, `to` in the
//           direction of its facet, with that facet's place in e_, `facet`, and its `side`: the
//           neighbor across it is mesh_.faces[e_[facet]].n[side];
//   d_      D, the numbers of its facets: yours to set;
//   queue_  facets to be tested against the criteria.
// Corners, neighbors and duals are in vectors: a new entry moves the others.
//
//  1. p becomes the last vertex, v. Its pole height is the mean of those of the vertices of E's
//     boundary.
//  2. D has a facet for each boundary edge: from, to, v. The first facets of D take the numbers of
//     E, in the order of e_; the others are added to mesh_.faces and t_.duals. D is never smaller
//     than E: a disk without inner vertices has two edges on its boundary more than facets.
//  3. Neighbors: across from-to lies what lay outside of E there. Across the other two sides lie
//     facets of D. And what lies outside must name the facet of D: neighbor_at_edge_to(face, w) is
//     a face's neighbor across its edge that ends in w.
//  4. t_.duals[f] = dual(f) for the facets of D, once corners are in place, and they join the
//     queue.
//  5. ++report_.insertions_refine, and with options_.observer: ->cone_added(v, d_).
//
// Hint: the facet outside runs along the common edge the other way. Where does it end there? And
// read what lies outside of E before you write D over E's numbers.
void Refinement::put_cone(const Vec3& p) {
  throw std::logic_error("exercise 13: your work");
}
