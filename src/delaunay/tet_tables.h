// SPDX-License-Identifier: MIT
// The combinatorics of one tetrahedron, the only such tables in the project. Vertices 0 1 2 3 are
// positively oriented (predicates.h); facet i is the one opposite to vertex i.
#pragma once

#include <array>

namespace deliso {

// The vertices of facet i, counter-clockwise seen from outside the cell.
inline constexpr std::array<std::array<int, 3>, 4> kFacetVertices = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

namespace tet_tables {

// Whether a permutation of 0 1 2 3 is even; false for anything else.
constexpr bool is_even_permutation(int a, int b, int c, int d) {
  const int v[4] = {a, b, c, d};
  int inversions = 0;
  for (int i = 0; i < 4; ++i) {
    if (v[i] < 0 || v[i] > 3) return false;
    for (int j = i + 1; j < 4; ++j) {
      if (v[i] == v[j]) return false;
      inversions += v[i] > v[j];
    }
  }
  return inversions % 2 == 0;
}

// Outside means: the apex put behind, the cell (apex, facet) is positive, (facet, apex) negative.
constexpr bool facets_point_outwards() {
  for (int i = 0; i < 4; ++i) {
    const auto& f = kFacetVertices[i];
    if (!is_even_permutation(i, f[0], f[1], f[2])) return false;
  }
  return true;
}
static_assert(facets_point_outwards());

}  // namespace tet_tables
}  // namespace deliso
