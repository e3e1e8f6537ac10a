// SPDX-License-Identifier: MIT
#include "render/rasterize.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace deliso {
namespace {

constexpr std::int64_t kUnit = ProjectedMesh::kUnit;
using Point = ProjectedMesh::Point;

// Twice the signed area of (a, b, (x, y)).
std::int64_t twice_area(const Point& a, const Point& b, std::int64_t x, std::int64_t y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

// The middle of sample n, and the first sample whose middle is at `snapped` or beyond.
std::int64_t middle(std::int64_t n) {
  return n * kUnit + kUnit / 2;
}
std::int64_t first_sample(std::int64_t snapped) {
  const std::int64_t shifted = snapped - kUnit / 2 + kUnit - 1;
  return shifted >= 0 ? shifted / kUnit : -((-shifted + kUnit - 1) / kUnit);
}

// What varies linearly over a facet: its value from the corners' weights.
class Linear {
 public:
  Linear(double a, double b, double c, std::int64_t area)
      : values_{a, b, c}, inverse_(1 / static_cast<double>(area)) {}
  double at(const CornerWeights& corners) const {
    return (static_cast<double>(corners.weight[0]) * values_[0] +
            static_cast<double>(corners.weight[1]) * values_[1] +
            static_cast<double>(corners.weight[2]) * values_[2]) *
           inverse_;
  }

 private:
  double values_[3];
  double inverse_;
};

struct Steps {
  std::int64_t begin, end;
};

// The steps to the right, of `count`, at which the facet covers the sample: where no weight has
// another sign than the area. Slivers cost as much as they cover, not as much as their box.
Steps covered(const CornerWeights& first, const std::int64_t (&right)[3], std::int64_t count) {
  Steps steps{0, count};
  const std::int64_t sign = first.area > 0 ? 1 : -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t weight = sign * first.weight[i], change = sign * right[i];
    if (weight < 0 && change <= 0) return {0, 0};
    if (weight < 0) steps.begin = std::max(steps.begin, (-weight + change - 1) / change);
    if (weight >= 0 && change < 0) steps.end = std::min(steps.end, weight / -change + 1);
  }
  return steps;
}

}  // namespace

ProjectedMesh project(const TriMesh& mesh, const Camera& camera, int samples_per_side,
                      const std::optional<ClipPlane>& clip) {
  // What is not drawn (vertices of no facet, clipped ones) can lie anywhere. The bound keeps the
  // conversion defined and twice_area below 2^62.
  constexpr double kBound = 0x1p29;
  const double unit = static_cast<double>(kUnit * samples_per_side);
  const auto snap = [&](double pixels) {
    return static_cast<std::int64_t>(std::floor(std::clamp(unit * pixels, -kBound, kBound) + 0.5));
  };
  ProjectedMesh projected;
  projected.columns = samples_per_side * camera.size.width;
  projected.rows = samples_per_side * camera.size.height;
  projected.points.reserve(mesh.points.size());
  for (const Vec3& p : mesh.points) {
    const Camera::Projected q = camera.project(p);
    projected.points.push_back({snap(q.x), snap(q.y), q.depth, clip ? clip->height(p) : 0});
  }
  return projected;
}

CornerWeights corners_at(const ProjectedMesh& mesh, const Triangle& triangle, int column, int row) {
  const Point& a = mesh.points[triangle[0]];
  const Point& b = mesh.points[triangle[1]];
  const Point& c = mesh.points[triangle[2]];
  const std::int64_t x = middle(column), y = middle(row);
  return {{twice_area(b, c, x, y), twice_area(c, a, x, y), twice_area(a, b, x, y)},
          twice_area(a, b, c.x, c.y)};
}

std::vector<FaceId> visible_faces(const TriMesh& mesh, const ProjectedMesh& projected,
                                  int row_begin, int row_end) {
  const auto columns = static_cast<std::size_t>(projected.columns);
  const std::size_t count = columns * static_cast<std::size_t>(row_end - row_begin);
  std::vector<FaceId> seen(count, kNoId);
  std::vector<double> nearest(count, -std::numeric_limits<double>::infinity());

  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& triangle = mesh.faces[f].v;
    const Point& a = projected.points[triangle[0]];
    const Point& b = projected.points[triangle[1]];
    const Point& c = projected.points[triangle[2]];
    const auto row0 = std::max<std::int64_t>(first_sample(std::min({a.y, b.y, c.y})), row_begin);
    const auto row1 = std::min<std::int64_t>(first_sample(std::max({a.y, b.y, c.y}) + 1), row_end);
    const auto column0 = std::max<std::int64_t>(first_sample(std::min({a.x, b.x, c.x})), 0);
    const auto column1 =
        std::min<std::int64_t>(first_sample(std::max({a.x, b.x, c.x}) + 1), projected.columns);
    if (row0 >= row1 || column0 >= column1) continue;
    if (std::min({a.height, b.height, c.height}) > 0) continue;
    const bool clipped = std::max({a.height, b.height, c.height}) > 0;

    CornerWeights at_row =
        corners_at(projected, triangle, static_cast<int>(column0), static_cast<int>(row0));
    if (at_row.area == 0) continue;
    const Linear depth(a.depth, b.depth, c.depth, at_row.area);
    const Linear height(a.height, b.height, c.height, at_row.area);
    // What one sample to the right, and one down, add to the weights.
    const std::int64_t right[3] = {kUnit * (b.y - c.y), kUnit * (c.y - a.y), kUnit * (a.y - b.y)};
    const std::int64_t down[3] = {kUnit * (c.x - b.x), kUnit * (a.x - c.x), kUnit * (b.x - a.x)};
    for (std::int64_t row = row0; row < row1; ++row) {
      const auto [begin, end] = covered(at_row, right, column1 - column0);
      CornerWeights corners = at_row;
      for (std::size_t i = 0; i < 3; ++i) corners.weight[i] += begin * right[i];
      std::size_t at = static_cast<std::size_t>(row - row_begin) * columns +
                       static_cast<std::size_t>(column0 + begin);
      for (std::int64_t step = begin; step < end; ++step, ++at) {
        if (!(clipped && height.at(corners) > 0)) {
          const double here = depth.at(corners);
          if (here > nearest[at]) {
            nearest[at] = here;
            seen[at] = static_cast<FaceId>(f);
          }
        }
        for (std::size_t i = 0; i < 3; ++i) corners.weight[i] += right[i];
      }
      for (std::size_t i = 0; i < 3; ++i) at_row.weight[i] += down[i];
    }
  }
  return seen;
}

}  // namespace deliso
