// SPDX-License-Identifier: MIT
#include "more/solids/fill.h"

#include <algorithm>
#include <utility>

#include "base/cancel.h"
#include "delaunay/hilbert.h"
#include "exact/predicates.h"
#include "more/solids/quality.h"

namespace deliso {
namespace {

constexpr RegionId kUnknown = 0xffffffffu;
// Of the cells that an insertion makes. With .02 zones around huge triangles are cut down so often
// that no good cells are left there.
constexpr double kLeastShape = .002;

class Insertion {
 public:
  explicit Insertion(CellMesh& mesh) : mesh_(mesh), locator_(mesh) {}

  // Returns the new vertex or kNoId.
  VertexId insert(const Vec3& p) {
    const CellId start = locator_.cell_at(p);
    if (start == kNoId || mesh_.region(start) == kOutside) return kNoId;
    find_zone(p, start);
    if (!cut_down(p, start)) return kNoId;
    created_.clear();
    const VertexId x = mesh_.add_point(p);
    for (const auto& [cell, corner] : border_) {
      created_.push_back(mesh_.corners(cell));
      created_.back()[corner] = x;
    }
    if (!mesh_.replace_ball(zone_, created_)) {
      mesh_.drop_point();
      return kNoId;
    }
    locator_.begin_at(mesh_.last_created().back());
    return x;
  }

 private:
  bool is_in_zone(CellId c) const { return state_[c] == round_ + 1; }

  // A cell's state is round_ when it is looked at, and round_ + 1 in the zone.
  void find_zone(const Vec3& p, CellId start) {
    round_ += 2;
    state_.resize(mesh_.cell_capacity(), 0);
    zone_.assign(1, start);
    state_[start] = round_ + 1;
    for (std::size_t k = 0; k < zone_.size(); ++k) {
      for (int i = 0; i < 4; ++i) {
        const CellId n = mesh_.neighbor(zone_[k], i);
        if (n == kNoId || mesh_.is_wall({zone_[k], i}) || state_[n] >= round_) continue;
        const Tetrahedron& v = mesh_.corners(n);
        const auto& at = mesh_.points;
        state_[n] = round_;
        if (insphere(at[v[0]], at[v[1]], at[v[2]], at[v[3]], p) <= 0) continue;
        state_[n] = round_ + 1;
        zone_.push_back(n);
      }
    }
  }

  // Takes cells out of the zone until each facet of its border makes a good cell, and what is then
  // not connected to the cell that holds p. Returns whether that cell is left, with the border.
  bool cut_down(const Vec3& p, CellId start) {
    border_.clear();
    for (std::size_t k = 0; k < zone_.size();) {
      if (add_border(p, zone_[k])) {
        ++k;
        continue;
      }
      if (zone_[k] == start) return false;
      state_[zone_[k]] = round_;
      keep_connected(start);
      border_.clear();
      k = 0;
    }
    return true;
  }

  // Returns whether the facets of c in the border make good cells.
  bool add_border(const Vec3& p, CellId c) {
    for (int i = 0; i < 4; ++i) {
      const CellId n = mesh_.neighbor(c, i);
      if (n != kNoId && !mesh_.is_wall({c, i}) && is_in_zone(n)) continue;
      const Tetrahedron& v = mesh_.corners(c);
      const auto& at = mesh_.points;
      std::array<Vec3, 4> q{at[v[0]], at[v[1]], at[v[2]], at[v[3]]};
      q[i] = p;
      if (shape(q[0], q[1], q[2], q[3]) <= kLeastShape) return false;
      border_.push_back({c, i});
    }
    return true;
  }

  // A cell of the zone before has the state of the round before.
  void keep_connected(CellId start) {
    round_ += 2;
    zone_.assign(1, start);
    state_[start] = round_ + 1;
    for (std::size_t k = 0; k < zone_.size(); ++k) {
      for (int i = 0; i < 4; ++i) {
        const CellId n = mesh_.neighbor(zone_[k], i);
        if (n == kNoId || mesh_.is_wall({zone_[k], i}) || state_[n] != round_ - 1) continue;
        state_[n] = round_ + 1;
        zone_.push_back(n);
      }
    }
  }

  CellMesh& mesh_;
  CellLocator locator_;
  std::vector<CellId> zone_;
  std::vector<Facet> border_;  // of the zone
  std::vector<Tetrahedron> created_;
  IdArray<CellId, std::uint32_t> state_;
  std::uint32_t round_ = 0;
};

}  // namespace

CellId CellLocator::cell_at(const Vec3& p) {
  constexpr int kMostSteps = 10000;
  if (hint_ == kNoId || !mesh_.is_live(hint_)) {
    hint_ = 0;
    while (!mesh_.is_live(hint_)) ++hint_;
  }
  CellId c = hint_;
  for (int step = 0; step < kMostSteps; ++step) {
    const Tetrahedron& v = mesh_.corners(c);
    CellId next = c;
    for (int k = 0; k < 4 && next == c; ++k) {
      const int i = (k + step * 7 / 3) % 4;
      const auto& f = kFacetVertices[i];
      const auto& at = mesh_.points;
      if (orient3d(at[v[f[0]]], at[v[f[1]]], at[v[f[2]]], p) > 0) next = mesh_.neighbor(c, i);
    }
    if (next == kNoId) return kNoId;
    if (next == c) return hint_ = c;
    c = next;
  }
  return kNoId;
}

const Wall* set_regions(CellMesh& mesh, std::span<const Wall> walls) {
  for (CellId c = 0; c < mesh.cell_capacity(); ++c) mesh.set_region(c, kUnknown);
  std::vector<CellId> queue;
  bool agree = true;  // the walls so far
  const auto reach = [&](CellId c, RegionId region) {
    if (c == kNoId) {
      agree &= region == kOutside;
    } else if (mesh.region(c) == kUnknown) {
      mesh.set_region(c, region);
      queue.push_back(c);
    } else {
      agree &= mesh.region(c) == region;
    }
  };
  for (const Wall& wall : walls) {
    const auto [c, i] = mesh.facet_with(wall.v[0], wall.v[1], wall.v[2]);
    if (c == kNoId) return &wall;
    const auto& at = mesh.points;
    // A wall is counter-clockwise seen from in front.
    const bool is_in_front =
        orient3d(at[wall.v[0]], at[wall.v[1]], at[wall.v[2]], at[mesh.corners(c)[i]]) > 0;
    reach(c, is_in_front ? wall.front : wall.behind);
    reach(mesh.neighbor(c, i), is_in_front ? wall.behind : wall.front);
    while (!queue.empty()) {
      const CellId from = queue.back();
      queue.pop_back();
      for (int k = 0; k < 4; ++k) {
        if (!mesh.is_wall({from, k})) reach(mesh.neighbor(from, k), mesh.region(from));
      }
    }
    if (!agree) return &wall;
  }
  return nullptr;
}

std::size_t insert_points(CellMesh& mesh, std::span<const Vec3> points) {
  Insertion insertion(mesh);
  std::size_t inserted = 0;
  for (std::uint32_t k : biased_hilbert_order(points)) {
    throw_if_canceled();
    if (insertion.insert(points[k]) != kNoId) ++inserted;
  }
  return inserted;
}

}  // namespace deliso
