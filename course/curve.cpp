// SPDX-License-Identifier: MIT
// Exercise 1, three hours, from an empty file: a curve in the plane, and what its sites see of it.
//
// DelIso in the plane. Sigma is a curve {g = 0}; points on it are sites; each owns the part of
// Sigma that is nearer to it than to any other site. Two sites whose parts meet are joined by an
// edge. If the sites are dense enough, these edges are a polygon that is like the curve. That is
// all that the program does, a dimension higher. Write both halves of it, in some 60 lines. The
// types are in course/curve.h. Include what you like; the rest of the house is not needed.
//
// 1. `curve_of`: Marching Squares (Lorensen and Cline 1987, in the plane). A sample is inside if g
//    >= 0. A side of a square with one end inside has one point of the curve, where g, linear
//    along it, is 0: from a to b, at t = g(a) / (g(a) - g(b)). Let a be the lower or the left end.
//    Then the two squares at a side compute the same doubles, and the pieces hang together. A
//    square with two such points has one piece, with four it has two. Four mean that the corners
//    alternate. Then each piece cuts off one corner. Which two? Number the corners 0 to 3 around
//    the square. The bilinear interpolant has a saddle, whose value is (g0 g2 - g1 g3) / (g0 + g2
//    - g1 - g3). If that is >= 0 the inside corners are joined, else the outside ones. The pieces
//    cut off the two corners that are not joined. Their order does not matter, nor which end of a
//    piece is a.
//
// 2. `restricted_voronoi`: for each piece, its parts from a to b. On p(t) = a + t (b - a) the
//    squared distances to two sites differ by a linear function of t. So it is told for which t
//    one of them is nearer. Begin at t = 0 with the site nearest to a. Of all other sites, which
//    overtakes first? Go there, and on from there, until none does before t = 1. Each part ends
//    where the next begins, at one and the same Point. A place where a part ends within the piece
//    is a Crossing: a point where Sigma meets a Voronoi edge. The dual of that is the edge between
//    the two sites.
//
// Sites are in general position: no point of interest is at equal distance from three.
//
// Hint: a site that overtakes grows nearer as t grows: the linear function has a sign. Test that
// before you divide, and a site once overtaken does not come back.
#include "course/curve.h"

#include <stdexcept>

namespace deliso::course {

std::vector<Piece> curve_of(const Picture& g) {
  throw std::logic_error("exercise 1: your work");
}

RestrictedVoronoi restricted_voronoi(std::span<const Piece> curve, std::span<const Point> sites) {
  throw std::logic_error("exercise 1: your work");
}

}  // namespace deliso::course
