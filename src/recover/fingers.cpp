// SPDX-License-Identifier: MIT
#include "recover/fingers.h"

#include <algorithm>
#include <cmath>

#include "base/triangle.h"

namespace deliso {

VertexId FingerSearch::find(VertexId s, std::span<const DualFacet> facets) {
  const Vec3 site = triangulation_.point(s);
  frames_.clear();
  for (const DualFacet& facet : facets) {
    const Vec3 b = triangulation_.point(facet.sites[1]) - site;
    const Vec3 c = triangulation_.point(facet.sites[2]) - site;
    const Vec3 normal = cross(b, c);
    const double scale = 1 / length2(normal);
    frames_.push_back(
        {b, c, scale * cross(c, normal), scale * cross(normal, b), std::sqrt(scale) * normal});
  }
  VertexId worst = kNoId;
  double worst2 = limit_ * limit_;
  std::size_t last = 0;  // what one vertex lies over the next often does as well
  for (const VertexId v : labels_.region(s)) {
    if (labels_.distance2_to_site(v) <= worst2) continue;
    const Vec3 d = contour_.points[v] - site;
    if (last < frames_.size() && frames_[last].is_within(d, worst2)) continue;
    const auto over = std::find_if(frames_.begin(), frames_.end(),
                                   [&](const Frame& f) { return f.is_within(d, worst2); });
    last = static_cast<std::size_t>(over - frames_.begin());
    if (over != frames_.end()) continue;
    double nearest2 = labels_.distance2_to_site(v);
    for (std::size_t n = 0; n < frames_.size() && nearest2 > worst2; ++n) {
      nearest2 = std::min(nearest2, distance2_to_triangle(d, Vec3{}, frames_[n].b, frames_[n].c));
    }
    if (nearest2 <= worst2) continue;
    worst = v;
    worst2 = nearest2;
  }
  return worst;
}

}  // namespace deliso
