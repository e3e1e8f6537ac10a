// SPDX-License-Identifier: MIT
#include "recover/sample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/check.h"
#include "base/random.h"
#include "surface/choose_seam.h"

namespace deliso {
namespace {

// Sagitta of the coarse boundary chain, as a share of its chords.
constexpr double kChainSagitta = 0.1;
// Components that cross no more grid edges than this get them all as seeds; larger ones get
// kSeedsPerComponent at random, and one per block of kBlock^3 voxels.
constexpr std::uint64_t kSmallComponent = 64;
constexpr std::size_t kSeedsPerComponent = 32;
constexpr double kBlock = 8;

// The sample so far, and whether a point is near one of it: a grid of cells as wide as the distance
// asked for. Only looked up, never walked, so the order of the hash decides nothing.
class Sample {
 public:
  explicit Sample(double spacing) : spacing_(spacing) {}

  // component: that of the contour p is taken from, if it is.
  std::uint32_t add(const Vec3& p, std::uint32_t component = kNoId) {
    const auto id = static_cast<std::uint32_t>(points_.size());
    points_.push_back(p);
    component_.push_back(component);
    next_.push_back(kNoId);
    auto [head, fresh] = head_.try_emplace(key(cell(p)), id);
    if (!fresh) next_[id] = std::exchange(head->second, id);
    return id;
  }
  bool has_near(const Vec3& p) const {
    const Cell c = cell(p);
    for (std::int64_t dz = -1; dz <= 1; ++dz) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
          const auto head = head_.find(key({c[0] + dx, c[1] + dy, c[2] + dz}));
          if (head == head_.end()) continue;
          for (std::uint32_t q = head->second; q != kNoId; q = next_[q]) {
            if (distance2(points_[q], p) < spacing_ * spacing_) return true;
          }
        }
      }
    }
    return false;
  }
  const std::vector<Vec3>& points() const { return points_; }
  std::uint32_t component(std::size_t id) const { return component_[id]; }

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell(const Vec3& p) const {
    return {static_cast<std::int64_t>(std::floor(p.x / spacing_)),
            static_cast<std::int64_t>(std::floor(p.y / spacing_)),
            static_cast<std::int64_t>(std::floor(p.z / spacing_))};
  }
  static std::uint64_t key(const Cell& c) {
    std::uint64_t k = 0;
    for (const std::int64_t i : c) k = (k ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15u;
    return k ^ (k >> 29);
  }

  double spacing_;
  std::vector<Vec3> points_;
  std::vector<std::uint32_t> component_;
  std::vector<std::uint32_t> next_;
  std::unordered_map<std::uint64_t, std::uint32_t> head_;
};

void add_random_points(const Isosurface& surface, const Parameters& parameters, Random& random,
                       Sample& sample, Report& report) {
  const Box3 box = surface.volume().box();
  const auto random_point = [&] {
    const double x = random.uniform(box.lo.x, box.hi.x), y = random.uniform(box.lo.y, box.hi.y);
    return Vec3{x, y, random.uniform(box.lo.z, box.hi.z)};
  };
  std::vector<Hit> hits;
  std::size_t found = 0;
  // Segments that miss are many where the surface is small; the contour's seeds do not depend on
  // these points, so there is no harm in giving up.
  for (std::size_t tries = 0; found < parameters.samples && tries < 100 * parameters.samples;
       ++tries) {
    const Vec3 from = random_point();
    surface.intersect({from, random_point()}, hits, report.searches_recover);
    for (const Hit& hit : hits) {
      if (found == parameters.samples) break;
      if (sample.has_near(hit.point)) continue;
      sample.add(hit.point);
      ++found;
    }
  }
}

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

void add_seeds(const Isosurface& surface, const ContourMesh& contour, const Parameters& parameters,
               Random& random, Sample& sample, Report& report) {
  const std::vector<ContourComponent>& components = contour.summary.components;
  const std::vector<std::uint8_t> kept = kept_components(contour, parameters);
  std::vector<std::uint64_t> vertices(components.size(), 0);
  for (const std::uint32_t c : contour.component) ++vertices[c];

  std::vector<VertexId> seeds;
  for (VertexId v = 0; v < contour.points.size(); ++v) {
    const std::uint32_t c = contour.component[v];
    if (!kept[c]) continue;
    const double share = static_cast<double>(kSeedsPerComponent) / static_cast<double>(vertices[c]);
    if (components[c].crossings <= kSmallComponent || random.uniform() < share) seeds.push_back(v);
  }
  const auto in_large_component = [&](VertexId v) {
    const std::uint32_t c = contour.component[v];
    return kept[c] && components[c].crossings > kSmallComponent;
  };
  choose_block_seeds(contour, surface.volume(), in_large_component, seeds);
  for (const VertexId v : seeds) {
    // On the box only the chain's own points may lie.
    if (contour.on_boundary(v) || sample.has_near(contour.points[v])) {
      ++report[Counter::seeds_skipped];
    } else {
      sample.add(contour.points[v], contour.component[v]);
    }
  }
}

// How far the auxiliary vertices are from the box's center, in diagonals of the box.
constexpr double kAuxiliaryDistance = 16;

// The triangulation of the points, which come first in `ids`, and the auxiliary vertices.
Triangulation triangulate(std::vector<Vec3> points, const Box3& box, std::vector<VertexId>& ids) {
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

struct Chain {
  std::vector<std::uint32_t> points;  // numbers in the sample
  std::vector<CurvePlace> places;
};

void link_chains(const std::vector<Chain>& chains, std::span<const VertexId> ids,
                 BoundaryChain& out) {
  for (const Chain& chain : chains) {
    std::vector<VertexId> vertices;
    for (const std::uint32_t p : chain.points) vertices.push_back(ids[p]);
    out.add_loop(vertices, chain.places);
  }
}

}  // namespace

bool is_auxiliary(const Vec3& p, const Box3& box) {
  const Vec3 center = 0.5 * (box.lo + box.hi);
  return distance2(p, center) > length2(box.size());
}

InitialSample init_triangulation(const Isosurface& surface, const ContourMesh& contour,
                                 const BoundaryCurves& curves, const Parameters& parameters,
                                 Report& report) {
  Random random(parameters.seed);
  Sample sample(parameters.r_min);
  const std::vector<std::uint8_t> kept = kept_components(contour, parameters);
  report[Counter::components_skipped] =
      static_cast<std::uint64_t>(std::count(kept.begin(), kept.end(), 0));

  std::vector<Chain> chains;
  for (std::uint32_t loop = 0; loop < curves.loop_count(); ++loop) {
    if (!kept[contour.boundary.component[loop]]) continue;
    Chain chain;
    chain.places = curves.coarse_chain(loop, kChainSagitta);
    for (const CurvePlace place : chain.places) {
      chain.points.push_back(sample.add(curves.point(place), contour.boundary.component[loop]));
    }
    chains.push_back(std::move(chain));
  }
  // A random point may fall on a component that is to be left out; the seeds do not need them.
  if (parameters.min_component == 0) add_random_points(surface, parameters, random, sample, report);
  add_seeds(surface, contour, parameters, random, sample, report);

  InitialSample out;
  std::vector<VertexId> ids;
  out.triangulation = triangulate(sample.points(), surface.volume().box(), ids);
  out.contour_component.assign(out.triangulation.vertex_capacity(), kNoId);
  for (std::size_t i = 0; i < sample.points().size(); ++i) {
    out.contour_component[ids[i]] = sample.component(i);
  }
  link_chains(chains, ids, out.chain);
  report.points_initial = out.triangulation.vertex_capacity() - 1 - kAuxiliaryVertices;
  return out;
}

InitialSites init_sites(const ContourMesh& contour, const BoundaryCurves& curves,
                        const Volume& volume, const Parameters& parameters, Report& report) {
  const std::vector<std::uint8_t> kept = kept_components(contour, parameters);
  report[Counter::components_skipped] =
      static_cast<std::uint64_t>(std::count(kept.begin(), kept.end(), 0));

  std::vector<VertexId> seeds;
  std::vector<Chain> chains;
  for (std::uint32_t loop = 0; loop < curves.loop_count(); ++loop) {
    if (!kept[contour.boundary.component[loop]]) continue;
    Chain chain;
    chain.places = curves.coarse_chain(loop, kChainSagitta);
    for (const CurvePlace place : chain.places) {
      chain.points.push_back(static_cast<std::uint32_t>(seeds.size()));
      seeds.push_back(contour.boundary.chain(loop)[static_cast<std::size_t>(place.s)]);
    }
    chains.push_back(std::move(chain));
  }
  // Inner vertices only: what lies on the box is the chain's business.
  const auto wanted = [&](VertexId v) {
    return kept[contour.component[v]] && !contour.on_boundary(v);
  };
  choose_block_seeds(contour, volume, wanted, seeds);
  Random random(parameters.seed);
  for (std::size_t i = 0; i < parameters.samples && !contour.points.empty(); ++i) {
    const VertexId v = random.below(static_cast<std::uint32_t>(contour.points.size()));
    if (wanted(v)) seeds.push_back(v);
  }

  std::vector<Vec3> points;
  points.reserve(seeds.size());
  for (const VertexId v : seeds) points.push_back(contour.points[v]);
  InitialSites out;
  std::vector<VertexId> ids;
  out.triangulation = triangulate(std::move(points), volume.box(), ids);
  out.contour_vertex.assign(out.triangulation.vertex_capacity(), kNoId);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (out.contour_vertex[ids[i]] == kNoId) out.contour_vertex[ids[i]] = seeds[i];
  }
  link_chains(chains, ids, out.chain);
  report.points_initial = out.triangulation.vertex_capacity() - 1 - kAuxiliaryVertices;
  return out;
}

BoundaryCurves boundary_curves(const Isosurface& surface, const ContourMesh& contour,
                               const Parameters& parameters) {
  const BoundaryChains& chains = contour.boundary;
  std::vector<BoundaryLoop> loops(chains.size());
  for (std::size_t c = 0; c < loops.size(); ++c) {
    for (std::uint32_t k = chains.first[c]; k < chains.first[c + 1]; ++k) {
      loops[c].points.push_back(contour.points[chains.vertices[k]]);
      loops[c].kept.push_back(chains.on_box_edge[k]);
      loops[c].faces.push_back(chains.face[k]);
    }
  }
  choose_seams(surface.volume(), parameters, loops);
  return {surface, std::move(loops)};
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
