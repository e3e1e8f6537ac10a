// SPDX-License-Identifier: MIT
// Slow, independent checks of a triangulation against the invariants of triangulation.h. Each
// returns the first broken rule as a sentence with its number, ids and coordinates, or the empty
// string.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>

#include "base/text.h"
#include "delaunay/triangulation.h"
#include "exact/predicates.h"

namespace deliso {
// A cell by its vertices, and where they are.
inline std::string describe(const Triangulation& t, CellId c) {
  const auto vertex = [&](SiteId v) {
    if (v == Triangulation::kInfinite || v >= t.vertex_capacity()) return text(v);
    const Vec3& p = t.point(v);
    return text(v, " at ", p.x, " ", p.y, " ", p.z);
  };
  return text("cell ", c, " (", joined(t.vertices(c), ", ", vertex), ")");
}

// Returns the sign of orient3d with p in place of vertex i of c. pre: the three others are finite.
inline int side(const Triangulation& t, CellId c, int i, const Vec3& p) {
  std::array<Vec3, 4> corner;
  for (int k = 0; k < 4; ++k) corner[k] = k == i ? p : t.point(t.vertex(c, k));
  return orient3d(corner[0], corner[1], corner[2], corner[3]);
}

// True if p is strictly inside the circumcircle of the finite facet (c, i) in whose plane it lies.
// Then it is strictly inside the sphere through the facet and any vertex off that plane.
inline bool in_circumcircle(const Triangulation& t, CellId c, int i, const Vec3& p) {
  for (SiteId v = 1; v < t.vertex_capacity(); ++v) {
    const int s = side(t, c, i, t.point(v));
    if (s == 0) continue;
    std::array<Vec3, 4> corner;
    for (int k = 0; k < 4; ++k) corner[k] = k == i ? t.point(v) : t.point(t.vertex(c, k));
    return s * insphere(corner[0], corner[1], corner[2], corner[3], p) > 0;
  }
  return false;
}

// I1, I2, I4, and two consequences for the whole: no facet is in three cells, and Euler's relation
// holds (vertices - edges + facets - cells = 0 with the infinite vertex). O(cells log cells).
inline std::string check_triangulation(const Triangulation& t) {
  std::map<std::array<SiteId, 3>, std::vector<Facet>> facets;
  std::set<std::array<SiteId, 2>> edges;
  std::vector<bool> used(t.vertex_capacity(), false);
  std::ptrdiff_t cell_count = 0;

  for (CellId c = 0; c < t.cell_capacity(); ++c) {
    if (!t.is_live(c)) continue;
    ++cell_count;
    std::array<SiteId, 4> v = t.vertices(c);
    std::sort(v.begin(), v.end());
    if (v[3] >= t.vertex_capacity() || std::adjacent_find(v.begin(), v.end()) != v.end())
      return text("I1: ", describe(t, c), " has a repeated or unknown vertex");
    if (v[0] == Triangulation::kInfinite && !t.is_infinite(c))
      return text("I5: in ", describe(t, c), " the infinite vertex is not the first");
    for (SiteId w : v) used[w] = true;
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) edges.insert({v[i], v[j]});
      std::array<SiteId, 3> key;
      std::copy_if(v.begin(), v.end(), key.begin(), [&](SiteId w) { return w != t.vertex(c, i); });
      facets[key].push_back({c, i});
    }
  }

  for (const auto& [key, cells] : facets) {
    if (cells.size() != 2)
      return text("I1: the facet ", key[0], " ", key[1], " ", key[2], " is in ", cells.size(),
                  " cells, ", describe(t, cells[0].cell), " among them");
    for (int k = 0; k < 2; ++k) {
      if (t.mirror(cells[k]) != cells[1 - k] ||
          t.neighbor(cells[k].cell, cells[k].index) != cells[1 - k].cell)
        return text("I1: facet ", cells[k].index, " of ", describe(t, cells[k].cell),
                    " does not lead to ", describe(t, cells[1 - k].cell));
    }
  }

  for (CellId c = 0; c < t.cell_capacity(); ++c) {
    if (!t.is_live(c)) continue;
    const int i = t.infinite_index(c);
    if (i < 0) {
      if (side(t, c, 0, t.point(t.vertex(c, 0))) <= 0)
        return text("I2: ", describe(t, c), " is not positively oriented");
    } else {
      // Every vertex lies on the inner side of a hull facet or in its plane.
      const Facet inner = t.mirror({c, i});
      if (t.is_infinite(inner.cell))
        return text("I2: the hull facet of ", describe(t, c), " has no finite cell");
      if (side(t, c, i, t.point(t.vertex(inner.cell, inner.index))) >= 0)
        return text("I2: ", describe(t, c), " has its infinite vertex on the inner side");
    }
  }

  std::ptrdiff_t vertex_count = 0;
  for (SiteId v = 0; v < t.vertex_capacity(); ++v) {
    if (!used[v]) return text("I4: vertex ", v, " is in no cell");
    ++vertex_count;
    const CellId c = t.incident_cell(v);
    if (c >= t.cell_capacity() || !t.is_live(c))
      return text("I4: the incident cell ", c, " of vertex ", v, " does not exist");
    const auto& w = t.vertices(c);
    if (std::find(w.begin(), w.end(), v) == w.end())
      return text("I4: the incident cell of vertex ", v, ", ", describe(t, c),
                  ", does not hold it");
  }

  const std::ptrdiff_t euler = vertex_count - static_cast<std::ptrdiff_t>(edges.size()) +
                               static_cast<std::ptrdiff_t>(facets.size()) - cell_count;
  if (euler != 0)
    return text("I1: vertices - edges + facets - cells is ", euler, ", not 0 as on a 3-sphere");
  return {};
}

// I3 by brute force: every cell against every vertex. O(cells * vertices).
inline std::string check_delaunay(const Triangulation& t) {
  for (CellId c = 0; c < t.cell_capacity(); ++c) {
    if (!t.is_live(c)) continue;
    const auto& w = t.vertices(c);
    const int i = t.infinite_index(c);
    for (SiteId v = 1; v < t.vertex_capacity(); ++v) {
      if (std::find(w.begin(), w.end(), v) != w.end()) continue;
      const Vec3& p = t.point(v);
      bool conflict;
      if (i < 0) {
        conflict = insphere(t.point(w[0]), t.point(w[1]), t.point(w[2]), t.point(w[3]), p) > 0;
      } else {
        const int s = side(t, c, i, p);
        conflict = s > 0 || (s == 0 && in_circumcircle(t, c, i, p));
      }
      if (conflict)
        return text("I3: vertex ", v, " (", p.x, " ", p.y, " ", p.z, ") is in conflict with ",
                    describe(t, c));
    }
  }
  return {};
}

}  // namespace deliso
