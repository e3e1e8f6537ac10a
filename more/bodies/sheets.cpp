// SPDX-License-Identifier: MIT
#include "more/bodies/sheets.h"

#include <algorithm>
#include <span>

#include "base/disjoint_sets.h"
#include "base/sorted_list.h"
#include "mesh/incidence.h"

namespace deliso {

CutSheets::CutSheets(const Sheets& from) {
  const std::size_t facets = from.facets.size();
  std::vector<Triangle> triangles;
  triangles.reserve(facets);
  for (const SheetFacet& f : from.facets) {
    triangles.push_back(f.v);
    if (sheets.empty() || sheets.back() != f.bodies) sheets.push_back(f.bodies);
  }
  sort_unique(sheets);
  for (const SheetFacet& f : from.facets) {
    sheet.push_back(
        static_cast<std::uint32_t>(std::ranges::lower_bound(sheets, f.bodies) - sheets.begin()));
  }
  // Corners of facets side by side in a sheet are one copy.
  for (const Triangle& t : triangles) mesh.faces.push_back({t, {kNoId, kNoId, kNoId}});
  DisjointSets corners(3 * facets);
  const std::vector<EdgeUse> uses = edge_uses(from.points.size(), triangles);
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2) return true;
    const EdgeUse &a = edge[0], &b = edge[1];
    if (sheet[a.triangle] != sheet[b.triangle] || a.forward == b.forward) return true;
    mesh.faces[a.triangle].n[a.side] = b.triangle;
    mesh.faces[b.triangle].n[b.side] = a.triangle;
    for (const VertexId end : {a.lo, a.hi}) {
      const auto corner = [&](const EdgeUse& use) {
        return 3 * use.triangle.number() +
               static_cast<std::uint32_t>(corner_index(mesh.faces[use.triangle], end));
      };
      corners.unite(corner(a), corner(b));
    }
    return true;
  });
  const std::vector<std::uint32_t> copy = corners.take_numbers();
  IdArray<VertexId, VertexId> first(from.points.size(), kNoId);
  for (FaceId f = 0; f < facets; ++f) {
    Face& face = mesh.faces[f];
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId v = face.v[i], c(copy[3 * std::size_t{f.number()} + i]);
      face.v[i] = c;
      if (c < vertex.size()) continue;
      vertex.push_back(v);
      next.push_back(first[v] == kNoId ? c : next[first[v]]);
      if (first[v] == kNoId) first[v] = c;
      next[first[v]] = c;
      facet.push_back(f);
      is_open.push_back(0);
      mesh.points.push_back(from.points[v]);
    }
  }
  for (const Face& face : mesh.faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (face.n[i] == kNoId) is_open[face.v[(i + 1) % 3]] = is_open[face.v[(i + 2) % 3]] = 1;
    }
  }
}

}  // namespace deliso
