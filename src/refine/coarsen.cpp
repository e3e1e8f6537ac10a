// SPDX-License-Identifier: MIT
#include "refine/coarsen.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <queue>
#include <tuple>
#include <vector>

#include "base/sorted_list.h"
#include "refine/coverage.h"
#include "refine/operations.h"
#include "refine/orientation.h"
#include "refine/refine.h"
#include "surface/step_timer.h"

namespace deliso {
namespace {

// The sum of weight * (dot(n, p) - d)^2 over planes, as a function of p.
struct Quadric {
  std::array<double, 10> sums{};  // of the products of n.x, n.y, n.z and -d

  void add_plane(const Vec3& n, double d, double weight) {
    const std::array<double, 4> plane{n.x, n.y, n.z, -d};
    std::size_t k = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i; j < 4; ++j) sums[k++] += weight * plane[i] * plane[j];
    }
  }
  void add(const Quadric& other) {
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += other.sums[k];
  }
  double at(const Vec3& p) const {
    const std::array<double, 4> q{p.x, p.y, p.z, 1};
    double sum = 0;
    std::size_t k = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i; j < 4; ++j) sum += (i == j ? 1 : 2) * sums[k++] * q[i] * q[j];
    }
    return sum;
  }
};

class Coarsening {
 public:
  explicit Coarsening(Refinement& refinement)
      : r_(refinement),
        orientation_(refinement),
        quadrics_(r_.mesh.points.size()),
        facet_(r_.mesh.points.size(), kNoId),
        version_(r_.mesh.points.size(), 0) {
    for (FaceId f = 0; f < r_.mesh.faces.size(); ++f) {
      const Face& face = r_.mesh.faces[f];
      if (is_dead(face)) continue;
      const Vec3 normal = r_.normal(face.v);
      const double area = 0.5 * length(normal);
      for (int i = 0; i < 3; ++i) {
        facet_[face.v[i]] = f;
        add_plane(face.v[i], normal, r_.point(face.v[i]), area / 3);
        if (face.n[i] != kNoId) continue;
        // The plane through a boundary edge that stands on its facet keeps the edge in place.
        const VertexId a = face.v[(i + 1) % 3], b = face.v[(i + 2) % 3];
        const Vec3 edge = r_.point(b) - r_.point(a);
        for (const VertexId v : {a, b}) {
          add_plane(v, cross(edge, normal), r_.point(v), 0.5 * dot(edge, edge));
        }
      }
    }
  }

  std::size_t run(std::size_t vertices, std::size_t triangles) {
    auto left = static_cast<std::size_t>(
        std::ranges::count_if(facet_, [](FaceId f) { return f != kNoId; }));
    auto triangles_left = static_cast<std::size_t>(
        std::ranges::count_if(r_.mesh.faces, [](const Face& face) { return !is_dead(face); }));
    const auto beyond = [&] {
      return std::max(left - std::min(left, vertices),
                      triangles_left - std::min(triangles_left, triangles));
    };
    Steps steps(r_.parameters.observer);
    for (const Ask ask : {Ask::shape, Ask::surface_points, Ask::topology}) {
      ask_ = ask;
      for (VertexId v = 0; v < facet_.size(); ++v) {
        if (facet_[v] != kNoId) queue(v, 0);
      }
      while (beyond() > 0 && !queue_.empty()) {
        const Entry e = queue_.top();
        queue_.pop();
        if (version_[e.from] != e.version || facet_[e.from] == kNoId) continue;
        steps.step(beyond());
        if (merge(e)) {
          --left;
          triangles_left -= r_.change.was.facets.size() - r_.change.in.facets.size();
        } else {
          queue(e.from, e.rank + 1);
        }
      }
      queue_ = {};
    }
    return left;
  }

 private:
  struct Entry {
    double cost;
    VertexId from, to;
    std::uint32_t rank, version;
    bool operator<(const Entry& other) const {
      return std::tie(other.cost, other.from) < std::tie(cost, from);
    }
  };

  // The plane through p, normal to a vector of any length but 0.
  void add_plane(VertexId v, const Vec3& normal, const Vec3& p, double weight) {
    const double size = length(normal);
    if (size > 0) quadrics_[v].add_plane(normal / size, dot(normal, p) / size, weight);
  }

  // Queues the merge of v into the neighbor that is the `rank`-th by cost.
  void queue(VertexId v, std::uint32_t rank) {
    facets_around(r_.mesh, facet_[v], v, star_);
    std::vector<std::pair<double, VertexId>> costs;
    for (const FaceId f : star_) {
      for (const VertexId u : r_.mesh.faces[f].v) {
        if (u == v) continue;
        costs.emplace_back(quadrics_[v].at(r_.point(u)) + quadrics_[u].at(r_.point(u)), u);
      }
    }
    sort_unique(costs);
    if (rank < costs.size()) {
      queue_.push({costs[rank].first, v, costs[rank].second, rank, version_[v]});
    }
  }

  // False if a test refused it.
  bool merge(const Entry& e) {
    if (propose_merge(r_, facet_[e.from], e.from, e.to)) return false;
    Change& c = r_.change;
    c.topology_only = ask_ == Ask::topology;
    const auto is_accepted = [&] {
      if (!c.duals.empty()) return true;  // tested before
      return (ask_ != Ask::shape ||
              worst_ratio(c.in.facets) <= std::max(r_.parameters.refinement[Criterion::r_over_l],
                                                   worst_ratio(c.was.facets))) &&
             !orientation_.passes_component(e.from, e.to);
    };
    const std::optional<Refusal> refusal = orientation_.reverses(e.from)
                                               ? std::optional(Refusal::turned)
                                               : merge_vertex(r_, e.from, is_accepted);
    if (r_.done(Operation::collapse, refusal)) return false;
    orientation_.merged();
    quadrics_[e.to].add(quadrics_[e.from]);
    facet_[e.from] = kNoId;
    std::vector<VertexId> changed;
    for (const FaceId f : r_.created()) {
      for (const VertexId v : r_.mesh.faces[f].v) {
        facet_[v] = f;
        changed.push_back(v);
      }
    }
    sort_unique(changed);
    for (const VertexId v : changed) {
      ++version_[v];
      queue(v, 0);
    }
    return true;
  }

  double worst_ratio(std::span<const Triangle> facets) const {
    double worst = 0;
    for (const Triangle& v : facets) {
      const FacetShape s = measure(r_.point(v[0]), r_.point(v[1]), r_.point(v[2]), {});
      worst = std::max(worst, s.r / s.l);
    }
    return worst;
  }

  // What is asked of a removal beside topology: r/l within its limit, or no worse than before, and
  // surface points of the new facets; these alone; neither.
  enum class Ask : std::uint8_t { shape, surface_points, topology };

  Refinement& r_;
  Orientation orientation_;
  Ask ask_ = Ask::shape;
  IdArray<VertexId, Quadric> quadrics_;
  IdArray<VertexId, FaceId> facet_;  // one at the vertex; kNoId once it is gone
  IdArray<VertexId, std::uint32_t> version_;
  std::priority_queue<Entry> queue_;
  std::vector<FaceId> star_;
};

}  // namespace

std::size_t coarsen(Refinement& r, std::size_t vertices, std::size_t triangles) {
  return Coarsening(r).run(vertices, triangles);
}

void coarsen_to_target(SurfaceMesh& mesh, const Isosurface& surface, const BoundaryCurves& curves,
                       std::span<const Vec3> samples, const Parameters& given, Report& report) {
  const StepTimer timer(report.seconds_refine);
  begin_stage(given.observer, "coarsen");
  Parameters parameters = given;
  parameters.refinement[Criterion::distance] = kNotAsked;
  Refinement r(mesh, surface, curves, parameters, report);
  coarsen(r, given.target_vertices, given.target_triangles);
  count_unrefined(mesh, parameters, report);
  report.max_distance = furthest_distance(mesh.mesh, r.facets(), samples, parameters.voxel);
  remove_dead(mesh);
}

}  // namespace deliso
