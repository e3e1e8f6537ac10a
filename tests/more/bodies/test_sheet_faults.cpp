// SPDX-License-Identifier: MIT
#include "more/bodies/sheet_faults.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "mesh/meshes.h"

using namespace deliso;

namespace {

const Box3 kBox{{0, 0, 0}, {10, 10, 10}};

std::vector<FaceId> faults(Sheets sheets) {
  sheets.free_facets = sheets.facets.size();
  return sheet_faults(sheets, CutSheets(sheets), kBox);
}

// Three facets at an edge. Body n is between facet n and the next one, counter-clockwise; the
// corners of the facets are at these angles, in thirds of a turn.
Sheets pages(const std::array<int, 3>& angles) {
  Sheets sheets{{{5, 5, 2}, {5, 5, 4}}, {}, 0};
  for (std::uint32_t n = 0; n < 3; ++n) {
    const double angle = 2 * std::numbers::pi / 3 * angles[n];
    const double size = n == 0 ? 2 : 1;
    sheets.points.push_back({5 + size * std::cos(angle), 5 + size * std::sin(angle), 3});
    sheets.facets.push_back({{VertexId(0), VertexId(1), VertexId(2 + n)}, {n, (n + 2) % 3}});
  }
  return sheets;
}

// Adds a tetrahedron with its corner next to the origin at (at, at, at).
void add_tetrahedron(Sheets& sheets, double at, double size, const std::array<BodyId, 2>& bodies) {
  const auto first = static_cast<std::uint32_t>(sheets.points.size());
  const Vec3 p{at, at, at};
  for (const Vec3& step : {Vec3{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}}) {
    sheets.points.push_back(p + step);
  }
  for (Triangle v : test::tetrahedron()) {
    for (VertexId& corner : v) corner = VertexId(corner.number() + first);
    const Vec3 &a = sheets.points[v[0]], &b = sheets.points[v[1]], &c = sheets.points[v[2]];
    const Vec3 inside = p + Vec3{size, size, size} / 5;
    if (dot(area_normal(a, b, c), inside - a) > 0) std::swap(v[1], v[2]);
    sheets.facets.push_back({v, bodies});
  }
}

}  // namespace

TEST_CASE("sheets follow each other around a curve as their bodies say") {
  CHECK(faults(pages({0, 1, 2})).empty());
  CHECK(faults(pages({0, 2, 1})).size() == 3);
}

TEST_CASE("a component lies in the body that its facets say") {
  for (const BodyId around : {0, 2}) {
    CAPTURE(around);
    Sheets sheets;
    add_tetrahedron(sheets, 1, 8, {0, 2});
    add_tetrahedron(sheets, 2, 1, {around, 1});
    CHECK(faults(sheets).empty() == (around == 2));
  }
}

TEST_CASE("facets that cross, and one without an area, are at fault") {
  Sheets sheets;
  add_tetrahedron(sheets, 1, 4, {0, 1});
  CHECK(faults(sheets).empty());
  add_tetrahedron(sheets, 2, 4, {0, 1});
  CHECK_FALSE(faults(sheets).empty());
  Sheets flat = pages({0, 1, 2});
  flat.points[2] = {5, 5, 3};
  CHECK_FALSE(faults(flat).empty());
}
