// SPDX-License-Identifier: MIT
// Exercise 11, an hour: how far is the medial axis?
//
// Facets may be large where Sigma is flat, and no other sheet is near. The Voronoi cells know that:
// a cell V_q of a dense sample is long and thin, and reaches across to where other sites are as
// near. Its furthest Voronoi vertices, one on either side of Sigma, are the *poles* of q (Amenta
// and Bern 1999), and the distance to the nearer one is its pole height h_q (§3.2). Stage 2 asks r
// / h_sigma <= epsilon2.
//
// `both_poles`: of every site, in [0] the distance to the furthest Voronoi vertex outside Sigma, in
// [1] to the furthest inside; 0 where there is none. Inside is g >= kappa. `compute_poles`: of
// every site the lesser of the two. Both have an entry for each number below del.vertex_capacity(),
// that of the infinite vertex included, whose entry is 0.
//
// A Voronoi vertex is the center of the sphere through a cell's four corners: circumsphere(del, c)
// (delaunay/voronoi.h) has `center` and `radius`. Cells are numbered below del.cell_capacity().
// Some are free: !del.is_live(c). Those with is_infinite(c) have no sphere. sigma.volume().value(p)
// is g.
//
// Hint: a Voronoi vertex is equally far from four sites.
std::vector<std::array<double, 2>> both_poles(const Triangulation& del, const Sigma& sigma) {
  throw std::logic_error("exercise 11: your work");
}

std::vector<double> compute_poles(const Triangulation& del, const Sigma& sigma) {
  throw std::logic_error("exercise 11: your work");
}
