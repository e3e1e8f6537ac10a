// SPDX-License-Identifier: MIT
#include "embedding/self_intersections.h"

#include <algorithm>
#include <numeric>
#include <tuple>

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

std::size_t count_crossings(std::span<const Vec3> points, std::span<const Face> faces) {
  std::vector<VertexId> order(points.size()), merged(points.size());
  std::iota(order.begin(), order.end(), VertexId{0});
  const auto key = [&](VertexId v) { return std::tie(points[v].x, points[v].y, points[v].z); };
  std::sort(order.begin(), order.end(), [&](VertexId a, VertexId b) { return key(a) < key(b); });
  std::vector<Vec3> places;
  for (const VertexId v : order) {
    if (places.empty() || places.back() != points[v]) places.push_back(points[v]);
    merged[v] = static_cast<VertexId>(places.size() - 1);
  }
  std::vector<Triangle> triangles;
  triangles.reserve(faces.size());
  for (const Face& face : faces) {
    const Triangle t{merged[face.v[0]], merged[face.v[1]], merged[face.v[2]]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }
  return self_intersections(places, triangles, TriangleTree(places, triangles)).size();
}

}  // namespace deliso
