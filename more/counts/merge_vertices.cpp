// SPDX-License-Identifier: MIT
#include "more/counts/merge_vertices.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "base/triangle.h"
#include "more/counts/free_vertices.h"
#include "more/counts/orientation.h"
#include "more/counts/unrefined.h"
#include "refine/coverage.h"
#include "refine/operations.h"
#include "refine/separate.h"

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

// What a merge of `from` into `to` makes of the star of `from`, before it is proposed: the largest
// (r/l)^2 of the new facets, infinite if one turns over, and the squared distance of `from` from
// them.
struct MergeShape {
  double ratio2, distance2;
};
MergeShape shape_after_merge(const Refinement& r, std::span<const FaceId> star, VertexId from,
                             VertexId to) {
  MergeShape after{0, kNotAsked};
  for (const FaceId f : star) {
    const Face& face = r.mesh.faces[f];
    if (has_corner(face.v, to)) continue;
    Triangle v = face.v;
    v[corner_index(face, from)] = to;
    const Vec3 &a = r.point(v[0]), &b = r.point(v[1]), &c = r.point(v[2]);
    const bool turns = !(dot(r.normal(face.v), area_normal(a, b, c)) > 0);
    after.ratio2 = std::max(after.ratio2, turns ? kNotAsked : radius_ratio2(a, b, c));
    after.distance2 = std::min(after.distance2, distance2_to_triangle(r.point(from), a, b, c));
  }
  return after;
}

// A pass performs the cheapest of the merges that it picks: all, divided by this. With 1, mean
// distances are up to 1 % larger; with 10, up to 1 % less, in more passes.
constexpr std::size_t kShare = 3;
// It picks no fewer than all divided by this, and stops at the number: of the last ones that are
// picked few may be possible.
constexpr std::size_t kLeastShare = 32;

// Free vertices are moved in rounds, the first at this many times the number, and each later one at
// so many times fewer.
constexpr double kFirstShare = 2.14, kShareStep = 1.1;

class Merging {
 public:
  explicit Merging(Refinement& refinement)
      : r_(refinement),
        orientation_(refinement),
        quadrics_(r_.mesh.points.size()),
        error_(r_.mesh.points.size(), 0),
        facet_(r_.mesh.points.size(), kNoId),
        picks_(r_.mesh.points.size()) {
    for (FaceId f = 0; f < r_.mesh.faces.size(); ++f) {
      const Face& face = r_.mesh.faces[f];
      if (is_dead(face)) continue;
      const Vec3 normal = r_.normal(face.v);
      const double area = 0.5 * length(normal);
      area_ += area;
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
    vertices_ = static_cast<std::size_t>(
        std::ranges::count_if(facet_, [](FaceId f) { return f != kNoId; }));
    triangles_ = static_cast<std::size_t>(
        std::ranges::count_if(r_.mesh.faces, [](const Face& face) { return !is_dead(face); }));
    const auto beyond = [&] {
      return std::max(vertices_ - std::min(vertices_, vertices),
                      triangles_ - std::min(triangles_, triangles));
    };
    Steps steps(r_.parameters.observer);
    for (const Ask ask : {Ask::shape, Ask::surface_points, Ask::topology}) {
      ask_ = ask;
      for (Pick& p : picks_) {
        p.is_due |= ask == Ask::surface_points ? p.lacks_shape : p.lacks_surface_point;
      }
      for (pick(); beyond() > 0 && !merges_.empty(); pick()) {
        sort(beyond());
        for (const auto& [cost, from] : merges_) {
          if (beyond() == 0) break;
          steps.step(beyond());
          perform(from);
        }
      }
    }
    return vertices_;
  }

 private:
  using Cost = std::pair<double, VertexId>;

  // The cheapest merge of a vertex that was not refused.
  struct Pick {
    Cost error;                // by quadrics, and the vertex into which it goes; kNoId: none
    double cost = 0;           // the error, or more once the distance is known
    std::uint32_t locked = 0;  // the pass in which a merge changed the facets of the vertex
    bool is_due = true;        // to be picked again
    // Why merges were refused that a later `ask` allows.
    bool lacks_shape = false, lacks_surface_point = false;
  };

  // The plane through p, normal to a vector of any length but 0.
  void add_plane(VertexId v, const Vec3& normal, const Vec3& p, double weight) {
    const double size = length(normal);
    if (size > 0) quadrics_[v].add_plane(normal / size, dot(normal, p) / size, weight);
  }

  // Lists the merges of all vertices.
  void pick() {
    merges_.clear();
    for (VertexId v = 0; v < picks_.size(); ++v) {
      if (facet_[v] == kNoId) continue;
      if (std::exchange(picks_[v].is_due, false)) {
        facets_around(r_.mesh, facet_[v], v, star_);
        pick_after(v, {-1, kNoId});
      }
      if (picks_[v].error.second != kNoId) merges_.emplace_back(picks_[v].cost, v);
    }
  }

  // Picks the cheapest merge of v after `last`. pre: star_ is that of v.
  void pick_after(VertexId v, const Cost& last) {
    Cost& best = picks_[v].error;
    best = {kNotAsked, kNoId};
    for (const FaceId f : star_) {
      const Face& face = r_.mesh.faces[f];
      const int i = corner_index(face, v);
      const auto consider = [&](VertexId u) {
        const Cost cost{quadrics_[v].at(r_.point(u)) + error_[u], u};
        if (last < cost && cost < best) best = cost;
      };
      consider(face.v[(i + 1) % 3]);
      if (face.n[(i + 1) % 3] == kNoId) consider(face.v[(i + 2) % 3]);
    }
    picks_[v].cost = best.first;
  }

  // Leaves the cheapest merges, in order. pre: there are some.
  void sort(std::size_t beyond) {
    const std::size_t some =
        std::clamp(beyond, 1 + merges_.size() / kLeastShare, 1 + merges_.size() / kShare);
    const auto end = merges_.begin() + static_cast<std::ptrdiff_t>(some);
    std::nth_element(merges_.begin(), end, merges_.end());
    merges_.erase(end, merges_.end());
    std::ranges::sort(merges_);
    ++pass_;
    mean_area_ = area_ / static_cast<double>(triangles_);
  }

  // Merges v, unless something near it changed in this pass.
  void perform(VertexId v) {
    Pick& p = picks_[v];
    if (p.locked == pass_) return;
    facets_around(r_.mesh, facet_[v], v, star_);
    const Question question(r_, v, Reason::unneeded);
    while (p.error.second != kNoId && p.cost <= merges_.back().first) {
      const VertexId to = p.error.second;
      if (picks_[to].locked == pass_) {
        p.is_due = true;
        return;
      }
      const MergeShape after = shape_after_merge(r_, star_, v, to);
      std::optional<Refusal> refusal;
      if (orientation_.reverses(star_, v, r_.point(to))) {
        refusal = Refusal::turned;
      } else if (ask_ == Ask::shape && !is_good(after.ratio2)) {
        refusal = Refusal::no_gain;
      } else if (raises_cost(p, after)) {
        continue;
      } else {
        refusal = merge(v, to);
      }
      if (!r_.done(Operation::collapse, refusal)) return;
      p.lacks_shape |= refusal == Refusal::no_gain;
      p.lacks_surface_point |= refusal == Refusal::no_surface_point;
      pick_after(v, Cost(p.error));
    }
  }

  // True if r/l keeps its limit, or is no worse than in the star.
  bool is_good(double ratio2) const {
    const double limit = r_.parameters.refinement[Criterion::r_over_l];
    return ratio2 <= limit * limit || std::ranges::any_of(star_, [&](FaceId f) {
             const Triangle& v = r_.mesh.faces[f].v;
             return ratio2 <= radius_ratio2(r_.point(v[0]), r_.point(v[1]), r_.point(v[2]));
           });
  }

  // Raises the cost by what is known of the distance now. True if it was less.
  bool raises_cost(Pick& p, const MergeShape& after) const {
    const double cost = after.distance2 * mean_area_;
    return cost > std::exchange(p.cost, std::max(p.cost, cost));
  }

  // pre: star_.
  std::optional<Refusal> merge(VertexId from, VertexId to) {
    Gates gates;
    gates.surface_points = ask_ != Ask::topology;
    const auto stays = [&](const Replacement& c) -> std::optional<Refusal> {
      // Asked before the first dual.
      if (!c.duals.empty() || !orientation_.passes_component(c.cavity.disk, from, r_.point(to)))
        return {};
      return Refusal::passes_component;
    };
    if (const auto refusal = merge_corner(r_, facet_[from], from, to, gates, stays)) return refusal;
    orientation_.merged(from, to);
    quadrics_[to].add(quadrics_[from]);
    error_[to] = quadrics_[to].at(r_.point(to));
    facet_[from] = kNoId;
    --vertices_;
    triangles_ -= star_.size() - r_.created().size();
    for (const FaceId f : r_.created()) {
      for (const VertexId v : r_.mesh.faces[f].v) {
        facet_[v] = f;
        picks_[v].locked = pass_;
        picks_[v].is_due = true;
        picks_[v].lacks_shape = picks_[v].lacks_surface_point = false;
      }
    }
    return std::nullopt;
  }

  // What is asked of a removal beside topology: shapes, and surface points of the new facets; these
  // alone; neither.
  enum class Ask : std::uint8_t { shape, surface_points, topology };

  Refinement& r_;
  Orientation orientation_;
  Ask ask_ = Ask::shape;
  double area_ = 0;
  // Of a facet when the pass began: taken anew for each merge, it raised the costs of all others,
  // and where these were equal no pass had a second merge.
  double mean_area_ = 0;
  std::size_t vertices_ = 0, triangles_ = 0;  // that are left
  std::uint32_t pass_ = 0;
  IdArray<VertexId, Quadric> quadrics_;
  IdArray<VertexId, double> error_;  // of the quadric at the vertex
  IdArray<VertexId, FaceId> facet_;  // one at the vertex; kNoId once it is gone
  IdArray<VertexId, Pick> picks_;
  std::vector<Cost> merges_;  // of this pass, by the vertex that goes
  std::vector<FaceId> star_;
};

}  // namespace

std::size_t merge_vertices(Refinement& r, std::size_t vertices, std::size_t triangles) {
  return Merging(r).run(vertices, triangles);
}

void merge_and_free(Refinement& r, std::size_t vertices, std::size_t triangles, double within) {
  for (double share = kFirstShare; share > 1; share /= kShareStep) {
    const auto more = [share](std::size_t count) {
      const double wanted = share * static_cast<double>(count);
      return wanted < 1e15 ? static_cast<std::size_t>(wanted) : count;
    };
    merge_vertices(r, more(vertices), more(triangles));
    free_vertices(r, within, 1);
  }
  merge_vertices(r, vertices, triangles);
  free_vertices(r, within);
}

double furthest_distance(const TriMesh& mesh, const BoxGrid& grid, std::span<const Vec3> samples,
                         double resolution) {
  double furthest = 0;
  FaceId last = kNoId;  // the facet near a sample is often near the next one, too
  for (const Vec3& p : samples) {
    if (last != kNoId && distance2_to_facet(mesh, last, p) <= furthest * furthest) continue;
    const FarSample at = nearest_facet(mesh, grid, 0, p, std::max(furthest, resolution));
    furthest = std::max(furthest, std::sqrt(at.distance2));
    last = at.facet;
  }
  return furthest;
}

void merge_to_count(SurfaceMesh& mesh, std::span<const Vec3> samples, const Options& options,
                    const Given& given) {
  const StepTimer timer(given.report.seconds_refine);
  begin_stage(given.parameters.observer, "thin");
  Parameters parameters = given.parameters;
  parameters.refinement[Criterion::distance] = kNotAsked;
  Refinement r(mesh, {given.surface, given.curves, parameters, given.report});
  const double free = options.free_vertices.in(given.surface.volume());
  if (free > 0) {
    merge_and_free(r, options.target_vertices, options.target_triangles, free);
  } else {
    merge_vertices(r, options.target_vertices, options.target_triangles);
  }
  separate(r, IdArray<VertexId, std::uint8_t>(mesh.mesh.points.size(), 1));
  count_unrefined(mesh, parameters, given.report);
  given.report.max_distance = furthest_distance(mesh.mesh, r.facets(), samples, parameters.voxel);
  remove_dead(mesh);
}

}  // namespace deliso
