// SPDX-License-Identifier: MIT
#include "refine/move_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "base/triangle.h"
#include "refine/crossing_guard.h"
#include "recover/poles.h"
#include "surface/surface_point.h"
#include "mesh/collapse.h"
#include "mesh/encroach.h"
#include "mesh/vertex_grid.h"

namespace deliso {
namespace {

// How far a vertex is moved, as shares of r_min, and in how many directions.
constexpr std::array kSteps{0.5, 0.25, 0.12, 0.06};
constexpr int kDirections = 16;

// A facet over a limit costs r / r_min, so that making it smaller counts for something; this is
// what one that is not Delaunay costs, and any crossing.
constexpr double kNotDelaunay = 0.3, kCrossing = 1;

// By such a share of itself the cost around a vertex must fall: there is an end to it.
constexpr double kFall = 0.05;

// How many facets are looked at, for each one wanting at first; and no more than a tenth of all.
constexpr std::size_t kMostLooks = 10;

// A ball that holds more vertices is not mended by moving them out.
constexpr std::size_t kMostHeld = 4;

// A vertex is in a surface ball when it is nearer to its center by more than rounding.
constexpr double kInside = 1 - 2e-9;

// The cosine of how far a normal may turn.
constexpr double kLeastCosine = 0.5;

bool is_corner(const Triangle& t, VertexId v) {
  return t[0] == v || t[1] == v || t[2] == v;
}

class VertexMover {
 public:
  VertexMover(Recovered& recovered, const Isosurface& surface, const Criteria& criteria,
              std::span<const std::uint64_t> guarded_voxels, Report& report);

  std::size_t run();

 private:
  bool is_wanting(FaceId f) const;
  double cost_of_shape(const Triangle& v, const Vec3& x, bool unhit) const;
  bool holds_vertex(const Triangle& v, const Vec3& x) const;
  // Whether these triangles in place of these facets cross any; false off the guarded voxels.
  bool crosses(std::span<const Triangle> triangles, std::span<const FaceId> facets) const {
    return guard_.is_on() && guard_.would_cross(triangles, facets);
  }
  // Whether a vertex was moved for f; then star_ and watched_ are the facets around it.
  bool mend(FaceId f);
  // Moves the corner v of f, with an eye on the surface ball of `held_by`, if any.
  bool move(FaceId f, VertexId v, FaceId held_by);
  // Finds star_ and watched_; whether v is an inner vertex.
  bool take_star(FaceId f, VertexId v, FaceId held_by);
  // What the star costs; where v was moved to, with new duals, if less than `limit` and no normal
  // turns.
  double cost_here(VertexId v) const;
  std::optional<double> cost_there(VertexId v, double limit);
  double cost_not_delaunay(VertexId v) const;

  TriMesh& mesh_;
  std::vector<std::uint8_t>& unhit_;
  std::vector<double>& poles_;
  SurfacePointFinder finder_;
  CrossingGuard guard_;
  const Criteria criteria_;
  Report& report_;
  VertexGrid grid_;
  std::vector<FaceId> facet_at_;  // one for each vertex

  // The facets at a vertex, with what changes when it moves.
  std::vector<FaceId> star_;
  std::vector<Triangle> triangles_;
  std::vector<Vec3> normals_;  // with the vertex where it was
  struct Duals {
    std::vector<Vec3> points;
    std::vector<std::uint8_t> unhit;
  };
  Duals duals_, best_;
  std::vector<FaceId> watched_;  // other facets whose surface balls the vertex is to stay out of
  std::vector<VertexId> held_;
};

VertexMover::VertexMover(Recovered& recovered, const Isosurface& surface, const Criteria& criteria,
                         std::span<const std::uint64_t> guarded_voxels, Report& report)
    : mesh_(recovered.mesh),
      unhit_(recovered.unhit),
      poles_(recovered.pole_heights),
      finder_(surface),
      guard_(surface.volume(), recovered.mesh, guarded_voxels, 2 * criteria.r_min),
      criteria_(criteria),
      report_(report),
      grid_(surface.volume().box(), recovered.mesh.points.size(), 2 * criteria.r_min),
      facet_at_(recovered.mesh.points.size(), kNoId) {
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    for (const VertexId v : mesh_.faces[f].v) {
      if (facet_at_[v] == kNoId) grid_.add(v, mesh_.points[v]);
      facet_at_[v] = f;
    }
  }
}

double VertexMover::cost_of_shape(const Triangle& v, const Vec3& x, bool unhit) const {
  FacetShape s = measure(mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]], x);
  if (unhit) s.h = s.r;
  return is_bad(s, facet_pole(poles_, v), criteria_) ? s.r / criteria_.r_min : 0;
}

bool VertexMover::holds_vertex(const Triangle& v, const Vec3& x) const {
  const double radius2 = kInside * distance2(x, mesh_.points[v[0]]);
  return grid_.any_near(x, std::sqrt(radius2), [&](VertexId q) {
    return distance2(x, mesh_.points[q]) < radius2 && !is_corner(v, q);
  });
}

bool VertexMover::is_wanting(FaceId f) const {
  const Triangle& v = mesh_.faces[f].v;
  const Vec3& x = mesh_.surface_points[f];
  return unhit_[f] || cost_of_shape(v, x, false) > 0 || holds_vertex(v, x) ||
         crosses({&v, 1}, {&f, 1});
}

bool VertexMover::take_star(FaceId f, VertexId v, FaceId held_by) {
  facets_around(mesh_, f, v, star_);
  triangles_.clear();
  normals_.clear();
  duals_ = {};
  watched_.clear();
  if (held_by != kNoId) watched_.push_back(held_by);
  for (const FaceId g : star_) {
    const Face& face = mesh_.faces[g];
    const int i = face.v[0] == v ? 0 : face.v[1] == v ? 1 : 2;
    if (face.n[(i + 1) % 3] == kNoId || face.n[(i + 2) % 3] == kNoId) return false;
    if (face.n[i] != kNoId && face.n[i] != held_by) watched_.push_back(face.n[i]);
    triangles_.push_back(face.v);
    normals_.push_back(
        area_normal(mesh_.points[face.v[0]], mesh_.points[face.v[1]], mesh_.points[face.v[2]]));
    duals_.points.push_back(mesh_.surface_points[g]);
    duals_.unhit.push_back(unhit_[g]);
  }
  return true;
}

double VertexMover::cost_here(VertexId v) const {
  double sum = cost_not_delaunay(v);
  for (std::size_t k = 0; k < star_.size(); ++k) {
    sum += cost_of_shape(triangles_[k], duals_.points[k], duals_.unhit[k]);
  }
  return sum + (crosses(triangles_, star_) ? kCrossing : 0);
}

double VertexMover::cost_not_delaunay(VertexId v) const {
  double sum = 0;
  for (const FaceId g : watched_) {
    if (is_encroached(mesh_, g, mesh_.points[v])) sum += kNotDelaunay;
  }
  for (std::size_t k = 0; k < star_.size(); ++k) {
    if (duals_.unhit[k] || holds_vertex(triangles_[k], duals_.points[k])) sum += kNotDelaunay;
  }
  return sum;
}

std::optional<double> VertexMover::cost_there(VertexId v, double limit) {
  double sum = 0;
  for (std::size_t k = 0; k < star_.size(); ++k) {
    const Triangle& t = triangles_[k];
    const Vec3 &a = mesh_.points[t[0]], &b = mesh_.points[t[1]], &c = mesh_.points[t[2]];
    const Vec3 normal = area_normal(a, b, c);
    if (!(dot(normal, normals_[k]) > kLeastCosine * length(normal) * length(normals_[k]))) {
      return std::nullopt;
    }
    const auto x = finder_.find(a, b, c, report_.searches_refine);
    duals_.points[k] = x ? *x : circumcenter(a, b, c);
    duals_.unhit[k] = !x;
    sum += cost_of_shape(t, duals_.points[k], !x);
    if (!(sum < limit)) return std::nullopt;
  }
  sum += cost_not_delaunay(v);
  if (!(sum < limit) || crosses(triangles_, star_)) return std::nullopt;
  return sum;
}

bool VertexMover::move(FaceId f, VertexId v, FaceId held_by) {
  if (!take_star(f, v, held_by)) return false;
  Vec3 normal{0, 0, 0};
  for (const Vec3& n : normals_) normal = normal + n;
  if (!(length(normal) > 0)) return false;
  normal = normal / length(normal);
  const Vec3 across = cross(normal, std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
  const Vec3 u = across / length(across), w = cross(normal, u);

  const Vec3 here = mesh_.points[v];
  Vec3 best_place = here;
  double least = (1 - kFall) * cost_here(v);
  bool found = false;
  for (const double step : kSteps) {
    const double reach = step * criteria_.r_min;
    for (int d = 0; d < kDirections; ++d) {
      const double angle = 2 * std::numbers::pi * d / kDirections;
      const Vec3 from = here + (reach * std::cos(angle)) * u + (reach * std::sin(angle)) * w;
      const auto there = finder_.foot(from, normal, reach, report_.searches_refine);
      if (!there) continue;
      mesh_.points[v] = *there;
      const auto cost = cost_there(v, least);
      if (!cost || !finder_.on_one_sheet(here, *there, normal, report_.searches_refine)) continue;
      least = *cost;
      best_place = *there;
      best_ = duals_;
      found = true;
    }
  }
  mesh_.points[v] = best_place;
  if (!found) return false;
  grid_.remove(v, here);
  grid_.add(v, best_place);
  for (std::size_t k = 0; k < star_.size(); ++k) {
    mesh_.surface_points[star_[k]] = best_.points[k];
    unhit_[star_[k]] = best_.unhit[k];
    if (guard_.is_on()) guard_.add(star_[k]);
  }
  return true;
}

bool VertexMover::mend(FaceId f) {
  const Triangle corners = mesh_.faces[f].v;
  for (const VertexId v : corners) {
    if (move(f, v, kNoId)) return true;
  }
  if (unhit_[f]) return false;
  const Vec3 x = mesh_.surface_points[f];
  const double radius2 = kInside * distance2(x, mesh_.points[corners[0]]);
  held_.clear();
  const bool too_many = grid_.any_near(x, std::sqrt(radius2), [&](VertexId q) {
    if (distance2(x, mesh_.points[q]) < radius2 && !is_corner(corners, q)) held_.push_back(q);
    return held_.size() > kMostHeld;
  });
  if (too_many) return false;
  return std::any_of(held_.begin(), held_.end(),
                     [&](VertexId q) { return move(facet_at_[q], q, f); });
}

std::size_t VertexMover::run() {
  std::vector<FaceId> list;
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    if (is_wanting(f)) list.push_back(f);
  }
  const std::size_t most = std::min(kMostLooks * list.size(), mesh_.faces.size() / 10);
  std::size_t moves = 0;
  for (std::size_t n = 0; n < list.size(); ++n) {
    if (!is_wanting(list[n]) || !mend(list[n])) continue;
    ++moves;
    if (list.size() >= most) continue;
    list.push_back(list[n]);
    list.insert(list.end(), star_.begin(), star_.end());
    list.insert(list.end(), watched_.begin(), watched_.end());
  }
  return moves;
}

}  // namespace

std::size_t move_vertices(Recovered& recovered, const Isosurface& surface, const Criteria& criteria,
                          std::span<const std::uint64_t> guarded_voxels, Report& report) {
  return VertexMover(recovered, surface, criteria, guarded_voxels, report).run();
}

}  // namespace deliso
