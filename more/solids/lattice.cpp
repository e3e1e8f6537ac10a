// SPDX-License-Identifier: MIT
#include "more/solids/lattice.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

#include "base/box3.h"
#include "base/cancel.h"
#include "base/check.h"
#include "base/triangle.h"

namespace deliso {
namespace {

// A cube has at most this many times the wanted length as its side. The nearest points of the
// lattice are .87 sides apart, and sides halve: so edges have .7 to 1.4 of that length.
constexpr double kSide = 1.6;
constexpr double kLattice = .87;  // sides between the nearest points
// A point is at least this share of the edges there from the surface.
constexpr double kClearance = .55;
constexpr int kMostLevels = 30;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kHalfDiagonal = .8661;  // in sides

// A point of the surface, and the length of edges there.
struct SizedPoint {
  Vec3 p;
  double length;
};

// Returns the corners and middles of the walls, with the mean length of the edges there.
std::vector<SizedPoint> sized_points(const IdArray<VertexId, Vec3>& points,
                                     std::span<const Wall> walls) {
  IdArray<VertexId, double> sum(points.size(), 0), count(points.size(), 0);
  for (const Wall& wall : walls) {
    for (int i = 0; i < 3; ++i) {
      const VertexId a = wall.v[i], b = wall.v[(i + 1) % 3];
      for (VertexId v : {a, b}) {
        sum[v] += distance(points[a], points[b]);
        count[v] += 1;
      }
    }
  }
  std::vector<SizedPoint> sized;
  for (VertexId v = 0; v < points.size(); ++v) {
    if (count[v] > 0) sized.push_back({points[v], sum[v] / count[v]});
  }
  for (const Wall& wall : walls) {
    SizedPoint middle{{}, 0};
    for (VertexId v : wall.v) {
      middle.p = middle.p + points[v] / 3;
      middle.length += sum[v] / count[v] / 3;
    }
    sized.push_back(middle);
  }
  return sized;
}

class Octree {
 public:
  Octree(const IdArray<VertexId, Vec3>& points, std::span<const Wall> walls,
         const LatticeOptions& options, const IsOutside& is_outside)
      : skin_points_(points), walls_(walls), is_outside_(is_outside), options_(options) {}

  void divide() {
    const std::vector<SizedPoint> surface = sized_points(skin_points_, walls_);
    DELISO_CHECK(!surface.empty());
    Box3 box{surface.front().p, surface.front().p};
    for (const SizedPoint& s : surface) box = united(box, {s.p, s.p});
    const double longest = std::max({box.size().x, box.size().y, box.size().z});
    // So cubes that max_edge decides have it as their side, the longer edge of the lattice.
    for (side_ = std::min(longest, options_.max_edge); side_ < longest;) side_ *= 2;
    origin_ = box.middle() - .5 * Vec3{side_, side_, side_};
    // By the surface's lengths alone cubes outside are few for each of its points, since they grow
    // away from it. Only max_edge divides them all.
    std::vector<std::uint32_t> walls(options_.max_edge < kInfinity ? walls_.size() : 0);
    std::iota(walls.begin(), walls.end(), 0u);
    std::vector<double> lengths(surface.size());
    divide({0, 0, 0}, 0, lengths_at(place({0, 0, 0}, .5 * (1u << kMostLevels)), surface, lengths),
           surface, walls);
  }

  // Returns the middles, then the corners, each once: cubes have corners in common.
  std::vector<Vec3> points() {
    std::ranges::sort(corners_);
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    for (const auto& at : corners_) points_.push_back(place(at, 0));
    return std::move(points_);
  }

 private:
  // Of points for a place: the least distance and the least wanted length.
  struct Least {
    double distance = kInfinity;
    double length = kInfinity;
  };

  // Divides the cube at `corner`, in cubes of the deepest level. `near` holds the points that may
  // decide a length in it, and `least` is of its middle. `walls` are those that may meet it; none:
  // it lies inside, or nobody asks.
  void divide(const std::array<std::uint32_t, 3>& corner, int level, const Least& least,
              std::span<const SizedPoint> near, std::span<const std::uint32_t> walls) {
    throw_if_canceled();
    const std::uint32_t cells = 1u << (kMostLevels - level);
    const double side = cells * (side_ / (1u << kMostLevels));
    if (level == kMostLevels || side <= std::min(options_.max_edge, kSide * least.length)) {
      const bool all = least.distance > (kClearance * kLattice + kHalfDiagonal) * side;
      const Vec3 middle = place(corner, .5 * cells);
      if (all || is_free(middle, side, near)) points_.push_back(middle);
      for (int k = 0; k < 8; ++k) {
        const std::array<std::uint32_t, 3> at = corner_of(corner, k, cells);
        if (all || is_free(place(at, 0), side, near)) corners_.push_back(at);
      }
      return;
    }
    std::vector<SizedPoint> kept;
    std::vector<double> lengths(near.size());
    std::vector<std::uint32_t> met;
    for (int k = 0; k < 8; ++k) {
      const std::uint32_t half = cells / 2;
      const std::array<std::uint32_t, 3> at = corner_of(corner, k, half);
      const Vec3 middle = place(at, .5 * half);
      const double radius = .5 * side * kHalfDiagonal;
      met.clear();
      for (std::uint32_t w : walls) {
        if (distance2_to(w, middle) <= radius * radius) met.push_back(w);
      }
      // A cube that no wall meets lies on one side of all.
      if (!walls.empty() && met.empty() && is_outside_(middle)) continue;
      const Least inner = lengths_at(middle, near, lengths);
      // Half a diagonal away, lengths differ by growth times that at most.
      const double change = options_.growth * side * kHalfDiagonal;
      const double clear = radius + 1.3 * kClearance * options_.max_edge;
      kept.clear();
      for (std::size_t n = 0; n < near.size(); ++n) {
        if (lengths[n] > inner.length + change) continue;
        // Where max_edge decides, only those count that a point of the lattice may be too near to.
        if (lengths[n] > options_.max_edge + change &&
            distance2(near[n].p, middle) > clear * clear) {
          continue;
        }
        kept.push_back(near[n]);
      }
      divide(at, level + 1, inner, kept, met);
    }
  }

  // Sets `lengths` to those wanted at x by each of the points.
  Least lengths_at(const Vec3& x, std::span<const SizedPoint> near, std::span<double> lengths) {
    Least least;
    for (std::size_t n = 0; n < near.size(); ++n) {
      const double apart = distance(near[n].p, x);
      lengths[n] = near[n].length + options_.growth * apart;
      least.distance = std::min(least.distance, apart);
      least.length = std::min(least.length, lengths[n]);
    }
    return least;
  }

  Vec3 place(const std::array<std::uint32_t, 3>& at, double beside) const {
    const double unit = side_ / (1u << kMostLevels);
    return origin_ + unit * Vec3{at[0] + beside, at[1] + beside, at[2] + beside};
  }
  static std::array<std::uint32_t, 3> corner_of(const std::array<std::uint32_t, 3>& cube, int k,
                                                std::uint32_t cells) {
    return {cube[0] + (k & 1) * cells, cube[1] + (k >> 1 & 1) * cells, cube[2] + (k >> 2) * cells};
  }
  double distance2_to(std::uint32_t w, const Vec3& x) const {
    const auto& [a, b, c] = walls_[w].v;
    return distance2_to_triangle(x, skin_points_[a], skin_points_[b], skin_points_[c]);
  }
  double length_from(const SizedPoint& s, const Vec3& x) const {
    return s.length + options_.growth * distance(s.p, x);
  }
  double wanted_length(const Vec3& x, std::span<const SizedPoint> near) const {
    double least = options_.max_edge;
    for (const SizedPoint& s : near) least = std::min(least, length_from(s, x));
    return least;
  }
  // True if x is not too near to the surface for the edges there.
  bool is_free(const Vec3& x, double side, std::span<const SizedPoint> near) const {
    double nearest2 = kInfinity;
    for (const SizedPoint& s : near) nearest2 = std::min(nearest2, distance2(s.p, x));
    const auto is_far = [&](double edge) {
      return nearest2 >= kClearance * kClearance * edge * edge;
    };
    // Nearly all are free of the longest edge already, and that needs no square roots.
    return is_far(kLattice * side) ||
           is_far(std::min(kLattice * side, 1.3 * wanted_length(x, near)));
  }

  const IdArray<VertexId, Vec3>& skin_points_;
  std::span<const Wall> walls_;
  const IsOutside& is_outside_;
  LatticeOptions options_;
  double side_ = 0;
  Vec3 origin_;
  std::vector<Vec3> points_;
  std::vector<std::array<std::uint32_t, 3>> corners_;  // in cubes of the deepest level
};

}  // namespace

std::vector<Vec3> lattice_points(const IdArray<VertexId, Vec3>& points, std::span<const Wall> walls,
                                 const LatticeOptions& options, const IsOutside& is_outside) {
  Octree tree(points, walls, options, is_outside);
  tree.divide();
  return tree.points();
}

}  // namespace deliso
