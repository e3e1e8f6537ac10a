// SPDX-License-Identifier: MIT
#include "embedding/self_intersections.h"

#include <algorithm>

#include "delaunay/predicates.h"
#include "embedding/triangle_pair.h"

namespace deliso {

std::vector<std::pair<FaceId, FaceId>> self_intersections(const std::vector<Vec3>& points,
                                                          std::span<const Triangle> triangles,
                                                          const TriangleTree& tree) {
  std::vector<bool> flat(triangles.size());
  for (FaceId f = 0; f < triangles.size(); ++f) {
    const Triangle& t = triangles[f];
    flat[f] = collinear(points[t[0]], points[t[1]], points[t[2]]);
  }
  std::vector<std::pair<FaceId, FaceId>> pairs;
  tree.for_each_pair([&](FaceId f, FaceId g) {
    if (!flat[f] && !flat[g] && triangles_intersect(points, triangles[f], triangles[g])) {
      pairs.emplace_back(std::min(f, g), std::max(f, g));
    }
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace deliso
