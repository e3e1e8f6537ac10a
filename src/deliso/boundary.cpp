// SPDX-License-Identifier: MIT
#include "deliso/boundary.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"

namespace deliso {
namespace {

double distance_to_chord2(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2_ab = length2(ab);
  const double t = length2_ab > 0 ? std::clamp(dot(p - a, ab) / length2_ab, 0.0, 1.0) : 0.0;
  return distance2(p, a + t * ab);
}

}  // namespace

BoundaryCurves::BoundaryCurves(const Isosurface& surface, const ContourMesh& contour)
    : surface_(surface), loops_(contour.boundary.size()) {
  for (std::size_t c = 0; c < loops_.size(); ++c) {
    for (std::uint32_t k = contour.boundary.first[c]; k < contour.boundary.first[c + 1]; ++k) {
      loops_[c].points.push_back(contour.points[contour.boundary.vertices[k]]);
      loops_[c].corners.push_back(contour.boundary.on_box_edge[k]);
      loops_[c].faces.push_back(contour.boundary.face[k]);
    }
  }
}

const Vec3& BoundaryCurves::point(CurvePlace place) const {
  return loops_[place.loop].points[static_cast<std::size_t>(place.s)];
}

std::vector<CurvePlace> BoundaryCurves::coarse_chain(std::uint32_t loop, double sagitta) const {
  const std::vector<Vec3>& points = loops_[loop].points;
  const std::size_t n = points.size();
  std::vector<std::size_t> keep;
  for (std::size_t i = 0; i < n; ++i) {
    if (loops_[loop].corners[i]) keep.push_back(i);
  }
  // Three ends at least, so that no two edges of the chain join the same two vertices.
  if (keep.size() < 3) {
    for (std::size_t third = 0; third < 3 && n >= 3; ++third) keep.push_back(third * n / 3);
    std::sort(keep.begin(), keep.end());
    keep.erase(std::unique(keep.begin(), keep.end()), keep.end());
  }

  std::vector<CurvePlace> chain;
  std::vector<std::size_t> ends;  // pending ends of arcs, nearest on top
  for (std::size_t k = 0; k < keep.size(); ++k) {
    std::size_t from = keep[k];
    ends.assign(1, k + 1 < keep.size() ? keep[k + 1] : keep[0] + n);
    while (!ends.empty()) {
      const std::size_t to = ends.back();
      const Vec3 &a = points[from % n], &b = points[to % n];
      double worst = 0;
      for (std::size_t i = from + 1; i < to; ++i) {
        worst = std::max(worst, distance_to_chord2(points[i % n], a, b));
      }
      if (worst > sagitta * sagitta * distance2(a, b)) {
        ends.push_back((from + to) / 2);
        continue;
      }
      chain.push_back({loop, static_cast<double>(from % n)});
      from = to;
      ends.pop_back();
    }
  }
  return chain;
}

std::optional<BoundaryCurves::Split> BoundaryCurves::split(CurvePlace a, const Vec3& pa,
                                                           CurvePlace b, const Vec3& pb) const {
  const BoundaryLoop& loop = loops_[a.loop];
  const std::size_t n = loop.points.size();
  const double end = b.s > a.s ? b.s : b.s + static_cast<double>(n);
  const std::size_t first = static_cast<std::size_t>(a.s) + 1;
  const std::size_t last = static_cast<std::size_t>(std::ceil(end)) - 1;

  if (first > last) {  // both ends in one pixel's arc
    const BoxFace face = loop.faces[(first - 1) % n];
    const auto middle = boundary_midpoint(surface_.volume(), surface_.kappa(), face, pa, pb);
    const double s = a.s + 0.5 * (end - a.s);
    if (!middle || !(a.s < s && s < end) || *middle == pa || *middle == pb) return std::nullopt;
    return Split{{a.loop, s}, *middle};
  }
  // The chain point nearest to half the arc's length.
  double total = 0, so_far = 0;
  const auto at = [&](std::size_t i) -> const Vec3& { return loop.points[i % n]; };
  for (std::size_t i = first; i <= last + 1; ++i) {
    total += distance(i == first ? pa : at(i - 1), i > last ? pb : at(i));
  }
  std::size_t best = first;
  double best_gap = total;
  for (std::size_t i = first; i <= last; ++i) {
    so_far += distance(i == first ? pa : at(i - 1), at(i));
    const double gap = std::abs(so_far - total / 2);
    if (gap < best_gap) {
      best_gap = gap;
      best = i;
    }
  }
  if (at(best) == pa || at(best) == pb) return std::nullopt;
  return Split{{a.loop, static_cast<double>(best % n)}, at(best)};
}

BoundaryChain::Link& BoundaryChain::link(VertexId v) {
  if (v >= links_.size()) links_.resize(v + 1);
  return links_[v];
}

void BoundaryChain::add_loop(std::span<const VertexId> vertices,
                             std::span<const CurvePlace> places) {
  const std::size_t n = vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    link(vertices[i]) = {vertices[(i + 1) % n], vertices[(i + n - 1) % n], places[i]};
  }
}

void BoundaryChain::insert_after(VertexId a, VertexId v, CurvePlace place) {
  const VertexId b = links_[a].next;
  link(v) = {b, a, place};
  links_[a].next = v;
  links_[b].previous = v;
}

BoundaryChain BoundaryChain::renumbered(std::span<const VertexId> new_id) const {
  BoundaryChain chain;
  for (VertexId v = 0; v < links_.size(); ++v) {
    if (!is_boundary(v) || new_id[v] == kNoId) continue;
    chain.link(new_id[v]) = {new_id[links_[v].next], new_id[links_[v].previous], links_[v].place};
  }
  return chain;
}

}  // namespace deliso
