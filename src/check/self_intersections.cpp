// SPDX-License-Identifier: MIT
#include "check/self_intersections.h"

#include <algorithm>

#include "check/triangle_pair.h"
#include "delaunay/predicates.h"

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
  for (FaceId f = 0; f < triangles.size(); ++f) {
    if (flat[f]) continue;
    tree.for_each_meeting(tree.box_of(f), [&](FaceId g) {
      if (g > f && !flat[g] && triangles_intersect(points, triangles[f], triangles[g])) {
        pairs.emplace_back(f, g);
      }
    });
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace deliso
