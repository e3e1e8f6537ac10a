// SPDX-License-Identifier: MIT
#include "recover/protrusions.h"

#include <algorithm>
#include <cmath>

#include "base/triangle.h"
#include "delaunay/predicates.h"

namespace deliso {
namespace {

// Largest distance from the mesh to a vertex of T that no facet faces: in voxels, and in bounds on
// the distance, as Stage 2 allows. With it a third to a tenth as many points are far from the final
// mesh, and the furthest is as much nearer.
constexpr double kNearVoxels = 0.2, kNearDistances = 2;

// A facet faces a vertex if the cosine of the angle between their normals is at least this, about
// that of 45 degrees.
constexpr double kMinFacingCosine = 0.7;

// Returns the largest allowed distance to a vertex that no facet faces. pre: parameters.fingers is
// finite.
double near_limit(const Parameters& p) {
  const double allowed = kNearDistances * p.refinement[Criterion::distance];
  return std::min(p.fingers, std::max(kNearVoxels * p.voxel, std::isfinite(allowed) ? allowed : 0));
}

// A facet relative to the site; its other corners are b and c. A point is over the facet if its
// coordinates along b and c are at least 0 and their sum is at most 1.
struct SeenFacet {
  Vec3 b, c, along_b, along_c, normal;

  bool is_within(const Vec3& d, double limit2) const {
    const double u = dot(d, along_b), v = dot(d, along_c), height = dot(d, normal);
    return u >= 0 && v >= 0 && u + v <= 1 && height * height <= limit2;
  }
  double distance2_to(const Vec3& d) const { return distance2_to_triangle(d, Vec3{}, b, c); }
};

}  // namespace

VertexId find_protrusion(SiteId s, std::span<const DualFacet> facets, const Labels& labels,
                         const Isosurface& surface, const Parameters& parameters) {
  const Triangulation& t = labels.triangulation();
  const Vec3 site = t.point(s);
  std::vector<SeenFacet> seen;
  seen.reserve(facets.size());
  for (const DualFacet& facet : facets) {
    const Vec3 &p = t.point(facet.sites[1]), &q = t.point(facet.sites[2]);
    const Vec3 b = p - site, c = q - site;
    const Vec3 normal = cross(b, c);
    // T is straight in a voxel's face, so sites there may be collinear, exactly or by rounding.
    // Stage 2 cannot refine a facet without area.
    if (!(length2(normal) > 0) || collinear(site, p, q)) return labels.furthest(labels.region(s));
    const double scale = 1 / length2(normal);
    seen.push_back(
        {b, c, scale * cross(c, normal), scale * cross(normal, b), std::sqrt(scale) * normal});
  }
  if (!std::isfinite(parameters.fingers)) return kNoId;  // the search is off

  const double limit2 = parameters.fingers * parameters.fingers;
  // True if the facet nearest to v, or one that v is over, faces as Sigma does at v. Parameters:
  // d, the vector from the site to v; nearest2, the squared distance from v to the facets.
  const auto is_faced = [&](VertexId v, const Vec3& d, double nearest2) {
    const Vec3 gradient = surface.gradient(labels.contour().points[v]);
    const double least = kMinFacingCosine * length(gradient);
    return std::ranges::any_of(seen, [&](const SeenFacet& f) {
      return -dot(gradient, f.normal) >= least &&
             (f.is_within(d, limit2) || f.distance2_to(d) <= nearest2);
    });
  };
  VertexId worst = kNoId;
  double worst2 = near_limit(parameters) * near_limit(parameters);
  for (const VertexId v : labels.region(s)) {
    if (labels.distance2_to_site(v) <= worst2) continue;
    const Vec3 d = labels.contour().points[v] - site;
    const auto is_over = [&](const SeenFacet& f) { return f.is_within(d, worst2); };
    if (std::ranges::any_of(seen, is_over)) continue;
    double nearest2 = labels.distance2_to_site(v);
    for (const SeenFacet& f : seen) {
      nearest2 = std::min(nearest2, f.distance2_to(d));
      if (nearest2 <= worst2) break;
    }
    if (nearest2 <= worst2 || (nearest2 <= limit2 && is_faced(v, d, nearest2))) continue;
    worst = v;
    worst2 = nearest2;
  }
  return worst;
}

}  // namespace deliso
