// SPDX-License-Identifier: MIT
#include "refine/delaunay_patches.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "base/sorted_list.h"
#include "refine/crossing_guard.h"
#include "surface/surface_point.h"
#include "mesh/collapse.h"
#include "mesh/star.h"

namespace deliso {
namespace {

// A vertex is in a surface ball when it is nearer to its center by more than rounding.
constexpr double kInside = 1 - 2e-9;

// How often a patch takes in the facets around it, how many facets it may have, and how many
// facets are tried to fill it.
constexpr int kGrowths = 2, kMostTried = 300;
constexpr std::size_t kLargestPatch = 40;

using DirectedEdge = std::pair<VertexId, VertexId>;

bool has(std::span<const VertexId> list, VertexId v) {
  return std::find(list.begin(), list.end(), v) != list.end();
}

class PatchMender {
 public:
  PatchMender(Recovered& recovered, const Isosurface& surface, const Criteria& criteria,
              std::span<const std::uint64_t> guarded_voxels, Report& report)
      : mesh_(recovered.mesh),
        unhit_(recovered.unhit),
        finder_(surface),
        guard_(surface.volume(), recovered.mesh, guarded_voxels, 2 * criteria.r_min),
        report_(report) {}

  // Whether a patch with f in it was replaced.
  bool mend(FaceId f);
  // Whether f has a surface ball without any vertex of the facets that touch f.
  bool is_delaunay(FaceId f);

 private:
  bool in_patch(FaceId f) const {
    return std::find(patch_.begin(), patch_.end(), f) != patch_.end();
  }
  bool is_empty(const Vec3& x, const Triangle& v, std::span<const VertexId> others) const;
  // Appends the corners of all facets at the corners of f.
  void add_vertices_around(FaceId f, std::vector<VertexId>& vertices);
  void grow();
  // Finds rim_ and vertices_ of the patch; whether it is a disk.
  bool take_rim();
  bool fill();
  // Closes the edges of front_ from number `from` on.
  bool fill_from(std::size_t from);
  bool is_free(VertexId a, VertexId b) const {
    return !used_.contains({a, b}) && !rim_.contains({b, a});
  }
  // The center of the facet's surface ball when that is empty.
  const std::optional<Vec3>& empty_ball(const Triangle& v);
  bool stays_manifold();
  void replace();

  TriMesh& mesh_;
  std::vector<std::uint8_t>& unhit_;
  SurfacePointFinder finder_;
  CrossingGuard guard_;
  Report& report_;

  std::vector<FaceId> patch_;
  std::vector<VertexId> vertices_, near_;  // of the patch; of it and of the facets that touch it
  struct Beyond {
    FaceId facet = kNoId;  // kNoId on the mesh's boundary
    int side = 0;
  };
  std::map<DirectedEdge, Beyond> rim_;  // as the facets of the patch run

  // The filling so far, its directed edges, and those that facets are still wanted at.
  std::vector<Triangle> filling_;
  std::vector<Vec3> surface_points_;
  std::set<DirectedEdge> used_;
  std::vector<DirectedEdge> front_;
  std::map<Triangle, std::optional<Vec3>> balls_;
  int tried_ = 0;

  std::vector<FaceId> star_;
  std::vector<VertexId> around_;
};

bool PatchMender::is_empty(const Vec3& x, const Triangle& v,
                           std::span<const VertexId> others) const {
  const double radius2 = kInside * distance2(x, mesh_.points[v[0]]);
  return std::none_of(others.begin(), others.end(), [&](VertexId q) {
    return distance2(x, mesh_.points[q]) < radius2 && !has(v, q);
  });
}

void PatchMender::add_vertices_around(FaceId f, std::vector<VertexId>& vertices) {
  for (const VertexId q : mesh_.faces[f].v) {
    facets_around(mesh_, f, q, star_);
    for (const FaceId g : star_) {
      vertices.insert(vertices.end(), mesh_.faces[g].v.begin(), mesh_.faces[g].v.end());
    }
  }
}

bool PatchMender::is_delaunay(FaceId f) {
  if (unhit_[f]) return false;
  around_.clear();
  add_vertices_around(f, around_);
  return is_empty(mesh_.surface_points[f], mesh_.faces[f].v, around_);
}

void PatchMender::grow() {
  for (std::size_t n = patch_.size(); n > 0; --n) {
    const FaceId f = patch_[n - 1];
    for (const VertexId q : mesh_.faces[f].v) {
      facets_around(mesh_, f, q, star_);
      for (const FaceId g : star_) {
        if (!in_patch(g)) patch_.push_back(g);
      }
    }
  }
}

bool PatchMender::take_rim() {
  rim_.clear();
  vertices_.clear();
  std::map<VertexId, VertexId> next;
  for (const FaceId f : patch_) {
    const Face& face = mesh_.faces[f];
    vertices_.insert(vertices_.end(), face.v.begin(), face.v.end());
    for (int i = 0; i < 3; ++i) {
      const FaceId g = face.n[i];
      if (g != kNoId && in_patch(g)) continue;
      const VertexId from = face.v[(i + 1) % 3], to = face.v[(i + 2) % 3];
      rim_[{from, to}] = {g, g == kNoId ? 0 : neighbor_index(mesh_.faces[g], f)};
      if (!next.emplace(from, to).second) return false;
    }
  }
  sort_out(vertices_);
  const std::size_t edges = (3 * patch_.size() + rim_.size()) / 2;
  if (next.empty() || vertices_.size() + patch_.size() != edges + 1) return false;
  std::size_t length = 1;
  for (VertexId v = next.begin()->second; v != next.begin()->first; v = next.at(v)) ++length;
  return length == rim_.size();
}

const std::optional<Vec3>& PatchMender::empty_ball(const Triangle& v) {
  Triangle key = v;
  std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
  const auto [ball, is_new] = balls_.try_emplace(key);
  if (is_new) {
    const auto x = finder_.find(mesh_.points[key[0]], mesh_.points[key[1]], mesh_.points[key[2]],
                                report_.searches_refine);
    if (x && is_empty(*x, key, near_)) ball->second = x;
  }
  return ball->second;
}

// Facet by facet from the rim inwards; where two would do at an edge, both are tried.
bool PatchMender::fill() {
  near_.clear();
  for (const FaceId f : patch_) add_vertices_around(f, near_);
  sort_out(near_);
  filling_.clear();
  surface_points_.clear();
  used_.clear();
  front_.clear();
  balls_.clear();
  tried_ = 0;
  for (const auto& [edge, beyond] : rim_) front_.push_back(edge);
  return fill_from(0);
}

bool PatchMender::fill_from(std::size_t from) {
  while (from < front_.size() && used_.contains(front_[from])) ++from;
  // As many facets over as many vertices: the Euler number is what it was.
  if (from == front_.size()) return filling_.size() == patch_.size() && stays_manifold();
  if (filling_.size() == patch_.size() || ++tried_ > kMostTried) return false;
  const auto [u, v] = front_[from];
  for (const VertexId w : vertices_) {
    if (w == u || w == v || !is_free(v, w) || !is_free(w, u)) continue;
    const std::optional<Vec3>& x = empty_ball({u, v, w});
    if (!x) continue;
    const std::size_t front_before = front_.size();
    const std::array<DirectedEdge, 3> edges{{{u, v}, {v, w}, {w, u}}};
    filling_.push_back({u, v, w});
    surface_points_.push_back(*x);
    for (const DirectedEdge& e : edges) {
      used_.insert(e);
      if (!rim_.contains(e)) front_.emplace_back(e.second, e.first);
    }
    if (fill_from(from + 1)) return true;
    for (const DirectedEdge& e : edges) used_.erase(e);
    front_.resize(front_before);
    filling_.pop_back();
    surface_points_.pop_back();
  }
  return false;
}

// Every vertex of the patch is used, and the facets at it form a disk or half disk as before, those
// that stay and the new ones together.
bool PatchMender::stays_manifold() {
  std::vector<Triangle> before, after;
  return std::all_of(vertices_.begin(), vertices_.end(), [&](VertexId v) {
    const FaceId start = *std::find_if(patch_.begin(), patch_.end(),
                                       [&](FaceId f) { return has(mesh_.faces[f].v, v); });
    facets_around(mesh_, start, v, star_);
    before.clear();
    after.clear();
    for (const FaceId f : star_) {
      before.push_back(mesh_.faces[f].v);
      if (!in_patch(f)) after.push_back(mesh_.faces[f].v);
    }
    for (const Triangle& t : filling_) {
      if (has(t, v)) after.push_back(t);
    }
    return !after.empty() && classify_star(v, after) == classify_star(v, before);
  });
}

void PatchMender::replace() {
  std::map<DirectedEdge, Beyond> side;
  for (std::size_t n = 0; n < patch_.size(); ++n) {
    const FaceId f = patch_[n];
    mesh_.faces[f].v = filling_[n];
    mesh_.surface_points[f] = surface_points_[n];
    unhit_[f] = 0;
    for (int i = 0; i < 3; ++i) {
      side[{filling_[n][(i + 1) % 3], filling_[n][(i + 2) % 3]}] = {f, i};
    }
  }
  for (const auto& [edge, at] : side) {
    const auto rim = rim_.find(edge);
    const Beyond beyond = rim != rim_.end() ? rim->second : side.at({edge.second, edge.first});
    mesh_.faces[at.facet].n[at.side] = beyond.facet;
    if (beyond.facet != kNoId) mesh_.faces[beyond.facet].n[beyond.side] = at.facet;
  }
  if (!guard_.is_on()) return;
  for (const FaceId f : patch_) guard_.add(f);
}

bool PatchMender::mend(FaceId f) {
  patch_.assign(1, f);
  for (std::size_t n = 0; n < patch_.size() && patch_.size() < kLargestPatch; ++n) {
    for (const FaceId g : mesh_.faces[patch_[n]].n) {
      if (g != kNoId && !in_patch(g) && !is_delaunay(g)) patch_.push_back(g);
    }
  }
  for (int growth = 0; patch_.size() <= kLargestPatch; ++growth) {
    if (take_rim() && fill() && !(guard_.is_on() && guard_.would_cross(filling_, patch_))) {
      replace();
      return true;
    }
    if (growth == kGrowths) break;
    grow();
  }
  return false;
}

}  // namespace

std::size_t make_patches_delaunay(Recovered& recovered, const Isosurface& surface,
                                  const Criteria& criteria,
                                  std::span<const std::uint64_t> guarded_voxels, Report& report) {
  PatchMender mender(recovered, surface, criteria, guarded_voxels, report);
  std::size_t replaced = 0;
  for (FaceId f = 0; f < recovered.mesh.faces.size(); ++f) {
    replaced += !mender.is_delaunay(f) && mender.mend(f);
  }
  return replaced;
}

}  // namespace deliso
