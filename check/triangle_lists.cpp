// SPDX-License-Identifier: MIT
#include "check/triangle_lists.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace deliso {

TrianglesAtVertices::TrianglesAtVertices(std::size_t vertices, std::span<const Triangle> triangles)
    : begin_(vertices + 2, 0), triangles_(3 * triangles.size()) {
  // begin_[v + 1] advances from the first triangle of v to the first of the next.
  for (const Triangle& t : triangles) {
    for (const VertexId v : t) ++begin_[v + 2];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  for (FaceId n = 0; n < triangles.size(); ++n) {
    for (const VertexId v : triangles[n]) triangles_[begin_[v + 1]++] = n;
  }
}

TrianglesByCorners::TrianglesByCorners(std::size_t vertices, std::span<const Triangle> triangles)
    : begin_(vertices + 2, 0), entries_(triangles.size()) {
  for (const Triangle& t : triangles) ++begin_[std::min({t[0], t[1], t[2]}) + 2];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  for (FaceId n = 0; n < triangles.size(); ++n) {
    Triangle t = triangles[n];
    std::sort(t.begin(), t.end());
    entries_[begin_[t[0] + 1]++] = {t, n};
  }
  for (VertexId v = 0; v < vertices; ++v) {
    std::sort(entries_.data() + begin_[v], entries_.data() + begin_[v + 1],
              [](const Entry& a, const Entry& b) {
                return std::tie(a.corners, a.triangle) < std::tie(b.corners, b.triangle);
              });
  }
}

std::uint32_t TrianglesByCorners::find(const Triangle& corners) const {
  const Entry* const begin = entries_.data() + begin_[corners[0]];
  const Entry* const end = entries_.data() + begin_[corners[0] + 1];
  const Entry* const found = std::lower_bound(
      begin, end, corners, [](const Entry& e, const Triangle& t) { return e.corners < t; });
  return found != end && found->corners == corners ? found->triangle : kNoId;
}

}  // namespace deliso
