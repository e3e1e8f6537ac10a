// SPDX-License-Identifier: MIT
// Exercise 7, two hours: where does the surface leave the box?
//
// On the six faces of its box a volume is a picture, and the surface ends there in curves (§5).
// Find them by Marching Squares. Let g be the sample less kappa; a sample is inside if g >= 0. An
// edge of the grid with one end inside has one point of a curve, where g, linear along it, is 0:
//   x = a + (b - a) g(a) / (g(a) - g(b)).
// A square with two such edges has one piece of a curve, with four it has two. These cut off two
// opposite corners, those whose side is not that of the bilinear saddle. Corners 0 to 3 run around
// the square, and corner 0 is inside:
//   the saddle is inside exactly when g0 g2 >= g1 g3.
//
// Two squares that share an edge share its point, also across an edge of the box: every point ends
// two pieces. The data are in paper/boundary_curves.h. Of a face f the axis is `axis_of(f)`, and f
// is odd on the far side. See `Volume::sample` (volume/volume.h), and what a volume has of its
// grid: `Grid::dims`, `index` and `position` (volume/grid.h).
//
// Hint: number the points in a std::map, by the two samples of their edge.
BoundaryCurves marching_squares(const Volume& volume, double kappa) {
  throw std::logic_error("exercise 7: your work");
}
