// SPDX-License-Identifier: MIT
#include "app/round_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/box3.h"
#include "base/sorted_list.h"
#include "check/place_faults.h"
#include "io/mesh/to_float.h"

namespace deliso {
namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();

// Returns the float next to x that is on the other side of it than `rounded`; x itself if it is a
// float.
double other_float(double x, double rounded) {
  if (x == rounded) return x;
  return std::nextafter(static_cast<float>(rounded), rounded < x ? kEndless : -kEndless);
}

// The triangles whose boxes meet those of a vertex's own, as a mesh of their own.
struct Surroundings {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  VertexId vertex = kNoId;  // its number here
};

Surroundings surroundings_of(VertexId vertex, const std::vector<Vec3>& points,
                             std::span<const Triangle> triangles) {
  const Vec3& p = points[vertex];
  const double size = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  const auto box_at = [&](const Triangle& t) {
    return box_of(points[t[0]], points[t[1]], points[t[2]]);
  };
  std::vector<Box3> star;
  for (const Triangle& t : triangles) {
    if (!has_corner(t, vertex)) continue;
    star.push_back(box_at(t).grown(2 * size * std::numeric_limits<float>::epsilon()));
  }
  Surroundings near;
  std::vector<VertexId> ids;
  for (const Triangle& t : triangles) {
    const Box3 box = box_at(t);
    if (std::ranges::none_of(star, [&](const Box3& own) { return meet(own, box); })) continue;
    near.triangles.push_back(t);
    ids.insert(ids.end(), t.begin(), t.end());
  }
  sort_unique(ids);
  const auto number = [&](VertexId v) {
    return VertexId(std::lower_bound(ids.begin(), ids.end(), v) - ids.begin());
  };
  for (const VertexId v : ids) near.points.push_back(points[v]);
  for (Triangle& t : near.triangles) t = {number(t[0]), number(t[1]), number(t[2])};
  near.vertex = number(vertex);
  return near;
}

// Moves a vertex to the best of the floats around its exact place.
void mend(VertexId vertex, const Vec3& exact, std::vector<Vec3>& points,
          std::span<const Triangle> triangles) {
  constexpr std::size_t kMostTriangles = std::size_t{1} << 14;
  Surroundings near = surroundings_of(vertex, points, triangles);
  if (near.triangles.empty() || near.triangles.size() > kMostTriangles) return;
  Vec3& tried = near.points[near.vertex];
  std::size_t fewest = find_place_faults(near.points, near.triangles, 1).count();
  const Vec3 nearest = to_float(exact);
  for (int others = 0; others < 8 && fewest > 0; ++others) {
    for (int axis = 0; axis < 3; ++axis) {
      const bool other = (others >> axis & 1) != 0;
      tried[axis] = other ? other_float(exact[axis], nearest[axis]) : nearest[axis];
    }
    const std::size_t faults = find_place_faults(near.points, near.triangles, 1).count();
    if (faults >= fewest) continue;
    fewest = faults;
    points[vertex] = tried;
  }
}

}  // namespace

double float_rounding(std::span<const Vec3> points) {
  double largest = 0;
  for (const Vec3& p : points) {
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  }
  const double at = to_float(largest);
  return (std::nextafter(static_cast<float>(at), kEndless) - at) / 2;
}

std::vector<Vec3> round_without_faults(const std::vector<Vec3>& exact,
                                       std::span<const Triangle> triangles, int threads) {
  constexpr int kMaxRounds = 4;
  std::vector<Vec3> points;
  points.reserve(exact.size());
  for (const Vec3& p : exact) points.push_back(to_float(p));
  for (int round = 0; round < kMaxRounds; ++round) {
    std::vector<VertexId> where;
    find_place_faults(points, triangles, threads, &where);
    if (where.empty() || where.size() > kMostMended) break;
    for (const VertexId v : where) mend(v, exact[v], points, triangles);
  }
  return points;
}

}  // namespace deliso
