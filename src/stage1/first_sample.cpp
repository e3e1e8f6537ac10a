// SPDX-License-Identifier: MIT
#include "stage1/first_sample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/check.h"
#include "base/random.h"
#include "surface/observer.h"
#include "surface/step_timer.h"

namespace deliso {
namespace {

// Sagitta of the coarse boundary chain, as a share of its chords.
constexpr double kChainSagitta = 0.1;
// The side of a block, in voxels.
constexpr double kBlock = 8;

double largest_side(const ContourComponent& c) {
  return 1 + std::max({c.hi.i - c.lo.i, c.hi.j - c.lo.j, c.hi.k - c.lo.k});
}

// The first vertex of T of every (component, block of kBlock^3 voxels), of those that `wanted` asks
// for, in the order of T's vertices.
template <class Wanted>
void choose_block_seeds(const ContourMesh& contour, const Volume& volume, const Wanted& wanted,
                        std::vector<VertexId>& seeds) {
  using Place = std::array<std::uint32_t, 4>;  // component and block
  struct Hash {
    std::size_t operator()(const Place& place) const {
      std::uint64_t h = 0;
      for (const std::uint32_t n : place) h = (h ^ n) * 0x9e3779b97f4a7c15u;
      return h ^ (h >> 29);
    }
  };
  std::unordered_set<Place, Hash> seen;  // only asked, never walked
  Place last{};
  for (VertexId v = 0; v < contour.points.size(); ++v) {
    if (!wanted(v)) continue;
    Place place{contour.component[v]};
    for (int axis = 0; axis < 3; ++axis) {
      place[static_cast<std::size_t>(axis) + 1] =
          static_cast<std::uint32_t>(contour.points[v][axis] / (kBlock * volume.spacing()[axis]));
    }
    // Neighbours in T mostly share a block.
    if (place == last && !seen.empty()) continue;
    last = place;
    if (seen.insert(place).second) seeds.push_back(v);
  }
}

// How far the auxiliary vertices are from the box's center, in diagonals of the box.
constexpr double kAuxiliaryDistance = 16;

// The triangulation of the points, which come first in `ids`, and the auxiliary vertices.
Triangulation triangulate(std::vector<Vec3> points, const Box3& box, std::vector<SiteId>& ids) {
  const Vec3 center = 0.5 * (box.lo + box.hi);
  const double d = kAuxiliaryDistance * length(box.size());
  for (const Vec3& corner : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}}) {
    points.push_back(center + d * corner);
  }
  Triangulation triangulation;
  const bool built = triangulation.build(points, ids);
  DELISO_CHECK(built);
  return triangulation;
}

}  // namespace

bool is_auxiliary(const Vec3& p, const Box3& box) {
  const Vec3 center = 0.5 * (box.lo + box.hi);
  return distance2(p, center) > length2(box.size());
}

FirstSample init_triangulation(const ContourMesh& contour, const BoundaryCurves& curves,
                               const Volume& volume, const Parameters& parameters, Report& report) {
  const StepTimer timer(report.seconds_init);
  begin_stage(parameters.observer, "initial");
  const std::vector<std::uint8_t> kept = kept_components(contour, parameters);
  report[Counter::components_skipped] =
      static_cast<std::uint64_t>(std::count(kept.begin(), kept.end(), 0));

  std::vector<VertexId> seeds;  // the chains' first, loop by loop
  std::vector<std::vector<CurvePlace>> chains;
  for (std::uint32_t loop = 0; loop < curves.loop_count(); ++loop) {
    if (!kept[contour.boundary.component[loop]]) continue;
    chains.push_back(curves.coarse_chain(loop, kChainSagitta));
    for (const CurvePlace place : chains.back()) {
      seeds.push_back(contour.boundary.chain(loop)[static_cast<std::size_t>(place.s)]);
    }
  }
  // Inner vertices only: what lies on the box is the chain's business.
  const auto wanted = [&](VertexId v) {
    return kept[contour.component[v]] && !contour.on_boundary(v);
  };
  choose_block_seeds(contour, volume, wanted, seeds);
  Random random(parameters.seed);
  for (std::size_t i = 0; i < parameters.samples && !contour.points.empty(); ++i) {
    const VertexId v(random.below(static_cast<std::uint32_t>(contour.points.size())));
    if (wanted(v)) seeds.push_back(v);
  }

  std::vector<Vec3> points;
  points.reserve(seeds.size());
  for (const VertexId v : seeds) points.push_back(contour.points[v]);
  FirstSample out;
  std::vector<SiteId> ids;
  out.triangulation = triangulate(std::move(points), volume.box(), ids);
  out.contour_vertex.assign(out.triangulation.vertex_capacity(), kNoId);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (out.contour_vertex[ids[i]] == kNoId) out.contour_vertex[ids[i]] = seeds[i];
  }
  std::size_t first = 0;
  for (const std::vector<CurvePlace>& chain : chains) {
    out.chain.add_loop(std::span(ids).subspan(first, chain.size()), chain);
    first += chain.size();
  }
  report.points_initial = out.triangulation.vertex_capacity() - 1 - kAuxiliaryVertices;
  return out;
}

std::vector<std::uint8_t> kept_components(const ContourMesh& contour,
                                          const Parameters& parameters) {
  if (!parameters.kept.empty()) return parameters.kept;
  std::vector<std::uint8_t> kept;
  for (const ContourComponent& c : contour.summary.components) {
    kept.push_back(!(largest_side(c) < parameters.min_component));
  }
  return kept;
}

}  // namespace deliso
