// SPDX-License-Identifier: MIT
// Exercise 9, an hour: is the surface a surface at this vertex?
//
// Stage 1 ends only when the facets around every vertex form a disk: the test Disk() of the paper,
// §3.1. On the box they may form half a disk (§5). Each triangle at q has one edge opposite q;
// together these edges are the *link* of q. Tell which of four things it is:
//   empty      there is no triangle;
//   disk       the link is one cycle of three or more edges;
//   half_disk  the link is one path;
//   singular   all else: two pieces, a branch, an edge twice, a triangle that names a vertex twice.
//
// These are there to be called (mesh/star.cpp, above the place of your function, and mesh/star.h):
//   LinkEdge link_edge(VertexId q, const Triangle& t);      // the side of t opposite q, {a, b}
//   bool is_degenerate(VertexId q, const LinkEdge& e);      // t names a vertex twice
//   VertexLink link_of(VertexId q, std::span<const Triangle> triangles);
// A `VertexLink` has the numbers of the link's pieces (`fans`), vertices, and vertices of one edge
// alone (`loose_ends`). `link_of` must not be given a triangle that names a vertex twice.
//
// Hint: a connected graph with as many vertices as edges has one cycle. When is it nothing else?
Star classify_star(VertexId q, std::span<const Triangle> triangles) {
  throw std::logic_error("exercise 9: your work");
}
