// SPDX-License-Identifier: MIT
#include "more/solids/lattice.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_set>

#include "base/box3.h"
#include "base/check.h"

namespace deliso {
namespace {

// A cube has at most this many times the wanted length as its side. The nearest points of the
// lattice are .87 sides apart, and sides halve: so edges have .7 to 1.4 of that length.
constexpr double kSide = 1.6;
constexpr double kLattice = .87;  // sides between the nearest points
// A point is at least this share of the edges there from the surface.
constexpr double kClearance = .55;
constexpr int kMostLevels = 20;

class Octree {
 public:
  Octree(const Box3& box, const LatticeOptions& options)
      : options_(options),
        side_(std::max({box.size().x, box.size().y, box.size().z})),
        origin_(box.middle() - .5 * Vec3{side_, side_, side_}) {}

  void divide(std::span<const SizedPoint> surface) {
    std::vector<double> lengths(surface.size());
    divide({0, 0, 0}, 0, lengths_at(place({0, 0, 0}, .5 * (1u << kMostLevels)), surface, lengths),
           surface);
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
    double distance = std::numeric_limits<double>::infinity();
    double length = std::numeric_limits<double>::infinity();
  };

  // Divides the cube at `corner`, in cubes of the deepest level. `near` holds the points that may
  // decide a length in it, and `least` is of its middle.
  void divide(const std::array<std::uint32_t, 3>& corner, int level, const Least& least,
              std::span<const SizedPoint> near) {
    const std::uint32_t cells = 1u << (kMostLevels - level);
    const double side = cells * (side_ / (1u << kMostLevels));
    if (level == kMostLevels || side <= kSide * std::min(options_.max_edge, least.length)) {
      // Half a diagonal is .8661 sides.
      const bool all = least.distance > (kClearance * kLattice + .8661) * side;
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
    for (int k = 0; k < 8; ++k) {
      const std::uint32_t half = cells / 2;
      const std::array<std::uint32_t, 3> at = corner_of(corner, k, half);
      const Least inner = lengths_at(place(at, .5 * half), near, lengths);
      // Half a diagonal away, lengths differ by growth times that at most.
      const double most = inner.length + options_.growth * side * .8661;
      kept.clear();
      for (std::size_t n = 0; n < near.size(); ++n) {
        if (lengths[n] <= most) kept.push_back(near[n]);
      }
      divide(at, level + 1, inner, kept);
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
    double nearest2 = std::numeric_limits<double>::infinity();
    for (const SizedPoint& s : near) nearest2 = std::min(nearest2, distance2(s.p, x));
    const auto is_far = [&](double edge) {
      return nearest2 >= kClearance * kClearance * edge * edge;
    };
    // Nearly all are free of the longest edge already, and that needs no square roots.
    return is_far(kLattice * side) ||
           is_far(std::min(kLattice * side, 1.3 * wanted_length(x, near)));
  }

  LatticeOptions options_;
  double side_;
  Vec3 origin_;
  std::vector<Vec3> points_;
  std::vector<std::array<std::uint32_t, 3>> corners_;  // in cubes of the deepest level
};

}  // namespace

std::vector<Vec3> lattice_points(std::span<const SizedPoint> surface,
                                 const LatticeOptions& options) {
  DELISO_CHECK(!surface.empty());
  Box3 box{surface.front().p, surface.front().p};
  for (const SizedPoint& s : surface) box = united(box, {s.p, s.p});
  Octree tree(box, options);
  tree.divide(surface);
  return tree.points();
}

}  // namespace deliso
