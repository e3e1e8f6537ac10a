// SPDX-License-Identifier: MIT
// What the first exercise is about: a picture, the curve in it, and sites in the plane.
#pragma once

#include <span>
#include <vector>

namespace deliso::course {

struct Point {
  double x = 0, y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

// The samples of g at the points (i, j), 0 <= i < columns, 0 <= j < rows.
struct Picture {
  int columns = 0, rows = 0;
  std::vector<double> samples;
  double at(int i, int j) const { return samples[static_cast<std::size_t>(i + columns * j)]; }
};

// A segment of the curve within one square of the picture.
struct Piece {
  Point a, b;
};

// The part of a piece in the Voronoi cell of a site.
struct Part {
  Point a, b;
  int site;
};

// A point where the curve passes from the cell of one site to that of another.
struct Crossing {
  Point x;
  int low, high;  // the two sites, low < high
};

struct RestrictedVoronoi {
  std::vector<Part> parts;          // piece by piece, each from its a to its b
  std::vector<Crossing> crossings;  // where two parts of a piece meet
};

// Returns the curve g = 0, by Marching Squares.
std::vector<Piece> curve_of(const Picture& g);

// Returns the Voronoi diagram of the sites, restricted to the curve. pre: there are sites.
RestrictedVoronoi restricted_voronoi(std::span<const Piece> curve, std::span<const Point> sites);

}  // namespace deliso::course
