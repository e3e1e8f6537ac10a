// SPDX-License-Identifier: MIT
#include "paper/facet_cycles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.h"
#include "delaunay/voronoi.h"
#include "volume/sample_regions.h"

namespace deliso::paper {
namespace {

// A Voronoi facet: its corners in order around it, and how often its edges meet Sigma.
struct VoronoiFacet {
  std::vector<Vec3> corners;
  std::size_t hits = 0;
};

// Returns V_pq, by the cells around the edge pq; no corners if it is not bounded. pre: `start` has
// p and q.
VoronoiFacet voronoi_facet(const RestrictedDelaunay& del, CellId start, SiteId p, SiteId q) {
  const Triangulation& t = del.del();
  const auto find = [&](CellId c, auto&& is_it) {
    return static_cast<int>(std::ranges::find_if(t.vertices(c), is_it) - t.vertices(c).begin());
  };
  VoronoiFacet facet;
  CellId c = start;
  // Through the facet opposite to the vertex that is left, of the two beside p and q; then the
  // other one is left.
  SiteId left = t.vertex(c, find(c, [&](SiteId v) { return v != p && v != q; }));
  do {
    if (t.is_infinite(c)) return {};
    facet.corners.push_back(circumsphere(t, c).center);
    const Facet next{c, find(c, [&](SiteId v) { return v == left; })};
    left = t.vertex(c, find(c, [&](SiteId v) { return v != p && v != q && v != left; }));
    facet.hits += del.hits(next).size();
    c = t.neighbor(c, next.index);
  } while (c != start);
  return facet;
}

// Calls visit(a, b) for the segments in which the facet meets the planes of samples across an axis.
template <class Visit>
void for_each_cut(const std::vector<Vec3>& corners, const Volume& volume, int axis, Visit&& visit) {
  const auto [least, most] =
      std::ranges::minmax_element(corners, {}, [&](const Vec3& corner) { return corner[axis]; });
  const double last = volume.dims()[axis] - 1;
  const double begin = std::clamp(std::ceil(volume.in_samples(*least, axis)), 0., last);
  const double end = std::clamp(std::floor(volume.in_samples(*most, axis)), 0., last);
  for (double n = begin; n <= end; ++n) {
    const double at = volume.at_samples(n, axis);
    std::vector<Vec3> ends;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 &a = corners[k], &b = corners[(k + 1) % corners.size()];
      if ((a[axis] <= at) == (b[axis] <= at)) continue;
      ends.push_back(a + ((at - a[axis]) / (b[axis] - a[axis])) * (b - a));
    }
    if (ends.size() == 2) visit(ends[0], ends[1]);
  }
}

}  // namespace

std::vector<Vec3> points_below_regions(Sigma& sigma) {
  const Volume& f = sigma.volume();
  if (f.sample_count() >= kNoId) {  // unreachable: in 4 GB
    throw InputError("--facet-cycles is for less than 2^32 samples");
  }
  DisjointSets regions = regions_of_samples(f, sigma.kappa());
  std::vector<Vec3> points;
  SearchCounters not_counted;
  for_each_place({}, f.voxels(), [&](Index3 s) {
    if (regions.find(number_of(f, s)) != number_of(f, s)) return;
    const Vec3 at = f.position(s);
    Vec3 below = at, above = at;
    below.z = f.box().lo.z;
    above.z = f.box().hi.z;
    for (const Vec3& end : {below, above}) {
      if (end == at) continue;
      const auto hits = sigma.intersect({at, end}, not_counted);
      if (!hits.empty()) points.push_back(hits.front().point);
    }
  });
  return points;
}

std::optional<Vec3> facet_cycle(const RestrictedDelaunay& del, SiteId q, double least,
                                SearchCounters& counters) {
  const Triangulation& t = del.del();
  std::vector<std::pair<SiteId, CellId>> neighbors;  // each with a cell that has it
  for (const CellId c : del.cells_at(q)) {
    for (const SiteId p : t.vertices(c)) {
      if (p != q && p != Triangulation::kInfinite && !del.is_auxiliary(p)) {
        neighbors.emplace_back(p, c);
      }
    }
  }
  std::ranges::sort(neighbors);
  const auto end = std::unique(neighbors.begin(), neighbors.end(),
                               [](const auto& a, const auto& b) { return a.first == b.first; });
  const Vec3& at = t.point(q);
  const Volume& volume = del.sigma().volume();
  std::optional<Vec3> furthest;
  for (auto next = neighbors.begin(); next != end && !furthest; ++next) {
    const VoronoiFacet facet = voronoi_facet(del, next->second, next->first, q);
    if (facet.corners.empty() || facet.hits > 0) continue;
    double far2 = least * least;
    for (int axis = 0; axis < 3; ++axis) {
      for_each_cut(facet.corners, volume, axis, [&](const Vec3& a, const Vec3& b) {
        const Range inside = clip(a, b - a, {0, 1}, volume.box());
        if (!(inside.lo < inside.hi)) return;
        const Segment cut{a + inside.lo * (b - a), a + inside.hi * (b - a)};
        for (const Hit& hit : del.sigma().intersect(cut, counters)) {
          if (distance2(hit.point, at) <= far2) continue;
          far2 = distance2(hit.point, at);
          furthest = hit.point;
        }
      });
    }
  }
  return furthest;
}

}  // namespace deliso::paper
