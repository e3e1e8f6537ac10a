// SPDX-License-Identifier: MIT
#include "more/solids/improve.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "base/check.h"
#include "more/solids/moves.h"
#include "more/solids/quality.h"

namespace deliso {
namespace {

constexpr std::array<std::array<int, 2>, 6> kEdges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
constexpr double kGain = 1e-9;         // a change below it is none
constexpr double kGainOfPoint = 2e-2;  // of a change that adds a vertex

class Improvement {
 public:
  Improvement(CellMesh& mesh, VertexId first_inner) : mesh_(mesh), first_inner_(first_inner) {}

  // Vertices at cells below `wanted` are moved, and their cells changed.
  void pass(double wanted, bool may_merge, bool may_split) {
    std::vector<std::uint8_t> is_bad(mesh_.points.size(), 0);
    for (CellId c = 0; c < mesh_.cell_capacity(); ++c) {
      if (!is_below(c, wanted)) continue;
      for (VertexId v : mesh_.corners(c)) is_bad[v] = 1;
    }
    for (VertexId v = first_inner_; v < is_bad.size(); ++v) {
      if (is_bad[v]) smooth(v);
    }
    const CellId end(mesh_.cell_capacity());
    for (CellId c = 0; c < end; ++c) {
      throw_if_canceled();
      if (is_below(c, wanted)) change(c, may_merge, may_split);
    }
  }

 private:
  bool is_below(CellId c, double wanted) { return mesh_.is_live(c) && shape_of(c) < wanted; }

  // As last computed, unless the cell is new or a corner moved.
  double shape_of(CellId c) {
    shapes_.resize(mesh_.cell_capacity(), kUnknown);
    if (shapes_[c] == kUnknown) shapes_[c] = shape(mesh_, mesh_.corners(c));
    DELISO_ASSERT(shapes_[c] == shape(mesh_, mesh_.corners(c)));
    return shapes_[c];
  }
  double least_of(std::span<const CellId> cells) {
    double least = std::numeric_limits<double>::infinity();
    for (CellId c : cells) least = std::min(least, shape_of(c));
    return least;
  }
  void forget(std::span<const CellId> cells) {
    shapes_.resize(mesh_.cell_capacity(), kUnknown);
    is_settled_.resize(mesh_.points.size(), 0);
    for (CellId c : cells) {
      shapes_[c] = kUnknown;
      for (VertexId v : mesh_.corners(c)) is_settled_[v] = 0;
    }
  }
  // Returns whether the mesh was changed, of which it takes note.
  bool note(bool is_changed) {
    if (is_changed) forget(mesh_.last_created());
    return is_changed;
  }

  void change(CellId c, bool may_merge, bool may_split) {
    const Tetrahedron v = mesh_.corners(c);
    for (const auto& [i, k] : kEdges) {
      find_ring(mesh_, c, v[i], v[k], ring_);
      if (ring_.has_wall) continue;
      if (note(remove_edge(mesh_, ring_, least_of(ring_.cells) + kGain))) return;
    }
    for (int i = 0; i < 4; ++i) {
      const CellId n = mesh_.neighbor(c, i);
      if (n == kNoId) continue;
      const std::array<CellId, 2> both{c, n};
      if (note(remove_facet(mesh_, {c, i}, least_of(both) + kGain))) return;
    }
    for (const auto& [i, k] : kEdges) {
      if (may_merge && (merge(v[i], v[k]) || merge(v[k], v[i]))) return;
    }
    for (const auto& [i, k] : kEdges) {
      if (may_split && split(c, v[i], v[k])) return;
    }
  }

  // The least shape of star_ with its vertex at p; stops below `enough`. The cell that is then the
  // least comes first the next time, since it will be so again, more often than not.
  double shape_with(VertexId v, const Vec3& p, double enough) {
    const Vec3 old = std::exchange(mesh_.points[v], p);
    double least = std::numeric_limits<double>::infinity();
    for (CellId& c : star_) {
      least = std::min(least, shape(mesh_, mesh_.corners(c)));
      if (least > enough) continue;
      std::swap(c, star_.front());
      break;
    }
    mesh_.points[v] = old;
    return least;
  }

  void smooth(VertexId v) {
    is_settled_.resize(mesh_.points.size(), 0);
    if (mesh_.incident_cell(v) == kNoId) return;
    if (is_settled_[v]) {
      DELISO_ASSERT(!move(v));
    } else {
      // If it does not move, nothing else comes of it before something changes there.
      is_settled_[v] = !move(v);
    }
  }

  // Moves an inner vertex to the middle of its neighbors, part of the way, or by small steps along
  // the axes. Returns whether it did.
  bool move(VertexId v) {
    mesh_.cells_at(v, star_);
    const Vec3 old = mesh_.points[v];
    Vec3 middle;
    double length = 0;
    for (CellId c : star_) {
      for (VertexId w : mesh_.corners(c)) {
        middle = middle + mesh_.points[w];
        length += distance(mesh_.points[w], old);
      }
    }
    const double count = 3. * static_cast<double>(star_.size());
    middle = (middle - static_cast<double>(star_.size()) * old) / count;
    length /= count;
    double best = least_of(star_);
    const auto attempt = [&](const Vec3& p) {
      const double least = shape_with(v, p, best + kGain);
      if (least <= best + kGain) return false;
      best = least;
      mesh_.points[v] = p;
      return true;
    };
    for (double part : {1., .5, .25}) attempt(old + part * (middle - old));
    for (double step : {.2, .07, .02}) {
      for (int axis = 0; axis < 3; ++axis) {
        for (double way : {-step, step}) {
          Vec3 p = mesh_.points[v];
          p[axis] += way * length;
          attempt(p);
        }
      }
    }
    const bool has_moved = mesh_.points[v] != old;
    if (has_moved) forget(star_);
    return has_moved;
  }

  // Puts w in the place of the inner vertex v.
  bool merge(VertexId v, VertexId w) {
    if (v < first_inner_) return false;
    mesh_.cells_at(v, star_);
    const double least = least_of(star_);
    created_.clear();
    for (CellId c : star_) {
      Tetrahedron corners = mesh_.corners(c);
      if (has_corner(corners, w)) continue;
      corners[corner_index(corners, v)] = w;
      if (shape(mesh_, corners) <= least + kGain) return false;
      created_.push_back(corners);
    }
    return note(mesh_.replace_ball(star_, created_));
  }

  // pre: c has both. Sets c to the cell with its corners. (Where the solid touches itself,
  // cell_with() may look on the other side.)
  bool split(CellId& c, VertexId a, VertexId b) {
    const Tetrahedron corners = mesh_.corners(c);
    find_ring(mesh_, c, a, b, ring_);
    if (!ring_.is_closed || ring_.has_wall) return false;
    const double least = least_of(ring_.cells);
    std::vector<Tetrahedron> before;
    for (CellId cell : ring_.cells) before.push_back(mesh_.corners(cell));
    const Vec3 middle = .5 * (mesh_.points[a] + mesh_.points[b]);
    const VertexId x = star_from(mesh_, middle, ring_.cells, 0);
    if (!note(x != kNoId)) return false;
    for (int k = 0; k < 4; ++k) smooth(x);
    mesh_.cells_at(x, star_);
    if (least_of(star_) > least + kGainOfPoint) return true;
    note(mesh_.replace_ball(star_, before));
    mesh_.drop_point();
    for (CellId cell : mesh_.last_created()) {
      if (mesh_.corners(cell) == corners) c = cell;
    }
    return false;
  }

  CellMesh& mesh_;
  VertexId first_inner_;
  std::vector<CellId> star_;
  std::vector<Tetrahedron> created_;
  Ring ring_;
  static constexpr double kUnknown = -2;
  IdArray<CellId, double> shapes_;
  // Of vertices: it was not moved the last time, and its cells are as then.
  IdArray<VertexId, std::uint8_t> is_settled_;
};

}  // namespace

void improve(CellMesh& mesh, VertexId first_inner, int passes) {
  constexpr double kSine30 = .5, kSine20 = .342;
  Improvement improvement(mesh, first_inner);
  for (int k = 0; k < passes; ++k) improvement.pass(k < 2 ? kSine30 : kSine20, k >= 1, k >= 2);
}

}  // namespace deliso
