// SPDX-License-Identifier: MIT
// The crossings of triangles by a look at every pair whose boxes meet: an oracle for trees and
// grids.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "base/box3.h"
#include "embedding/triangle_pair.h"
#include "exact/predicates.h"
#include "mesh/tri_mesh.h"

namespace deliso::test {

// Returns the pairs that cross, sorted. Boxes are compared in the order of their least x.
inline std::vector<std::pair<FaceId, FaceId>> all_crossings(
    const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  std::vector<std::pair<Box3, FaceId>> boxes;
  for (FaceId f = 0; f < triangles.size(); ++f) {
    Box3 box{points[triangles[f][0]], points[triangles[f][0]]};
    for (const VertexId v : triangles[f]) {
      for (int axis = 0; axis < 3; ++axis) {
        box.lo[axis] = std::min(box.lo[axis], points[v][axis]);
        box.hi[axis] = std::max(box.hi[axis], points[v][axis]);
      }
    }
    boxes.emplace_back(box, f);
  }
  std::ranges::sort(boxes, {}, [](const auto& entry) { return entry.first.lo.x; });
  std::vector<std::pair<FaceId, FaceId>> pairs;
  for (auto a = boxes.begin(); a != boxes.end(); ++a) {
    const Box3& p = a->first;
    for (auto b = a + 1; b != boxes.end() && b->first.lo.x <= p.hi.x; ++b) {
      const Box3& q = b->first;
      if (p.lo.y > q.hi.y || q.lo.y > p.hi.y || p.lo.z > q.hi.z || q.lo.z > p.hi.z) continue;
      const auto [f, g] = std::minmax(a->second, b->second);
      if (triangles_intersect(points, triangles[f], triangles[g])) pairs.emplace_back(f, g);
    }
  }
  std::ranges::sort(pairs);
  return pairs;
}

// The same of the facets of a mesh, but those without area. pre: none is dead.
inline std::vector<std::pair<FaceId, FaceId>> all_crossings(const TriMesh& mesh) {
  std::vector<FaceId> facets;
  std::vector<Triangle> triangles;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& v = mesh.faces[f].v;
    if (collinear(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]])) continue;
    facets.push_back(f);
    triangles.push_back(v);
  }
  auto pairs = all_crossings(mesh.points, triangles);
  for (auto& [f, g] : pairs) f = facets[f.number()], g = facets[g.number()];
  return pairs;
}

}  // namespace deliso::test
