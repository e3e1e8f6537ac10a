// SPDX-License-Identifier: MIT
#include "recover/protrusions.h"

#include <algorithm>
#include <cmath>

#include "base/triangle.h"
#include "delaunay/predicates.h"

namespace deliso {
namespace {

// How far from the mesh a vertex of T may be that no facet faces: in voxels, and as Stage 2 allows
// it, in bounds on the distance. Points that the final mesh misses fall to a third or a tenth with
// it, and so does the furthest.
constexpr double kNearVoxels = 0.2, kNearDistances = 2;

// Cosine of the angle between normals up to which a facet faces a vertex: 45 degrees.
constexpr double kFacing = 0.7;

double near_limit(const Parameters& p) {
  const double allowed = kNearDistances * p.refinement[Criterion::distance];
  if (!std::isfinite(p.fingers)) return p.fingers;  // the search is off
  return std::min(p.fingers, std::max(kNearVoxels * p.voxel, std::isfinite(allowed) ? allowed : 0));
}

}  // namespace

ProtrusionSearch::ProtrusionSearch(const ContourMesh& contour, const Labels& labels,
                                   const Triangulation& triangulation, const Isosurface& surface,
                                   const Parameters& parameters)
    : contour_(contour),
      labels_(labels),
      triangulation_(triangulation),
      surface_(surface),
      limit2_(parameters.fingers * parameters.fingers),
      near2_(near_limit(parameters) * near_limit(parameters)) {}

VertexId ProtrusionSearch::find(SiteId s, std::span<const DualFacet> facets) {
  const Vec3 site = triangulation_.point(s);
  frames_.clear();
  for (const DualFacet& facet : facets) {
    const Vec3 &p = triangulation_.point(facet.sites[1]), &q = triangulation_.point(facet.sites[2]);
    // Beside the box, where the boundary of T runs straight on; T itself has no such triangle.
    if (collinear(site, p, q)) return labels_.furthest(labels_.region(s));
    const Vec3 b = p - site, c = q - site;
    const Vec3 normal = cross(b, c);
    const double scale = 1 / length2(normal);
    frames_.push_back(
        {b, c, scale * cross(c, normal), scale * cross(normal, b), std::sqrt(scale) * normal});
  }
  VertexId worst = kNoId;
  double worst2 = near2_;
  for (const VertexId v : labels_.region(s)) {
    if (labels_.distance2_to_site(v) <= worst2) continue;
    const Vec3 d = contour_.points[v] - site;
    const auto is_over = [&](const Frame& f) { return f.is_within(d, worst2); };
    if (std::any_of(frames_.begin(), frames_.end(), is_over)) continue;
    double nearest2 = labels_.distance2_to_site(v);
    for (const Frame& f : frames_) {
      nearest2 = std::min(nearest2, distance2_to_triangle(d, Vec3{}, f.b, f.c));
      if (nearest2 <= worst2) break;
    }
    if (nearest2 <= worst2 || (nearest2 <= limit2_ && is_faced(v, d, nearest2))) continue;
    worst = v;
    worst2 = nearest2;
  }
  return worst;
}

bool ProtrusionSearch::is_faced(VertexId v, const Vec3& d, double nearest2) const {
  const Vec3 gradient = surface_.gradient(contour_.points[v]);
  const double least = kFacing * length(gradient);
  return std::any_of(frames_.begin(), frames_.end(), [&](const Frame& f) {
    return -dot(gradient, f.normal) >= least &&
           (f.is_within(d, limit2_) || distance2_to_triangle(d, Vec3{}, f.b, f.c) <= nearest2);
  });
}

}  // namespace deliso
