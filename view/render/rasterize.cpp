// SPDX-License-Identifier: MIT
#include "view/render/rasterize.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

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

// Samples of rows and columns from `begin` to `end`.
struct Rectangle {
  std::int64_t row_begin, row_end, column_begin, column_end;
  bool empty() const { return row_begin >= row_end || column_begin >= column_end; }
  double samples() const {
    return static_cast<double>((row_end - row_begin) * (column_end - column_begin));
  }
};

Rectangle common(const Rectangle& a, const Rectangle& b) {
  return {std::max(a.row_begin, b.row_begin), std::min(a.row_end, b.row_end),
          std::max(a.column_begin, b.column_begin), std::min(a.column_end, b.column_end)};
}

// The samples of some rows of the picture.
class Band {
 public:
  Band(const TriMesh& mesh, const ProjectedMesh& projected, int row_begin, int row_end,
       const Layer* front = nullptr)
      : mesh_(mesh),
        projected_(projected),
        all_{row_begin, row_end, 0, projected.columns},
        seen_(static_cast<std::size_t>(projected.columns) *
                  static_cast<std::size_t>(row_end - row_begin),
              kNoId),
        nearest_(seen_.size(), -std::numeric_limits<double>::infinity()),
        front_(front) {}

  const Rectangle& all() const { return all_; }
  std::vector<FaceId>& seen() { return seen_; }
  std::vector<double>& nearest() { return nearest_; }
  const Point& corner(FaceId f, std::size_t i) const {
    return projected_.points[mesh_.faces[f].v[i]];
  }

  // Where the facet can be seen; nowhere when it is above the clipping plane.
  Rectangle box_of(FaceId f) const {
    const Point &a = corner(f, 0), &b = corner(f, 1), &c = corner(f, 2);
    if (std::min({a.height, b.height, c.height}) > 0) return {0, 0, 0, 0};
    return common(
        all_,
        {first_sample(std::min({a.y, b.y, c.y})), first_sample(std::max({a.y, b.y, c.y}) + 1),
         first_sample(std::min({a.x, b.x, c.x})), first_sample(std::max({a.x, b.x, c.x}) + 1)});
  }
  // About how many samples of its box the facet covers, at most.
  double samples(FaceId f, const Rectangle& box) const {
    const Point &a = corner(f, 0), &b = corner(f, 1), &c = corner(f, 2);
    const double area = std::fabs(static_cast<double>(twice_area(a, b, c.x, c.y)));
    return std::min(area / (2.0 * kUnit * kUnit), box.samples());
  }
  void draw(FaceId f, const Rectangle& within);
  // No sample of the facet in the rectangle is nearer to the eye.
  double nearest_possible(FaceId f, const Rectangle& within) const;
  // The furthest depth in the rectangle so far.
  double furthest_seen(const Rectangle& within) const;

 private:
  std::size_t index(std::int64_t row, std::int64_t column) const {
    return static_cast<std::size_t>(row - all_.row_begin) *
               static_cast<std::size_t>(projected_.columns) +
           static_cast<std::size_t>(column);
  }
  bool is_behind_front(FaceId f, double depth, std::size_t at) const {
    if (front_ == nullptr) return true;
    const double last = front_->depths[at];
    return depth < last || (depth == last && f > front_->faces[at]);
  }
  CornerWeights weights_at(FaceId f, std::int64_t row, std::int64_t column) const {
    return corners_at(projected_, mesh_.faces[f].v, static_cast<int>(column),
                      static_cast<int>(row));
  }

  const TriMesh& mesh_;
  const ProjectedMesh& projected_;
  Rectangle all_;
  std::vector<FaceId> seen_;
  std::vector<double> nearest_;  // depths
  const Layer* front_;           // only what is behind it is drawn; null: all
};

void Band::draw(FaceId f, const Rectangle& within) {
  if (within.empty()) return;
  const Point &a = corner(f, 0), &b = corner(f, 1), &c = corner(f, 2);
  const bool clipped = std::max({a.height, b.height, c.height}) > 0;
  CornerWeights at_row = weights_at(f, within.row_begin, within.column_begin);
  if (at_row.area == 0) return;
  const Linear depth(a.depth, b.depth, c.depth, at_row.area);
  const Linear height(a.height, b.height, c.height, at_row.area);
  // What one sample to the right, and one down, add to the weights.
  const std::int64_t right[3] = {kUnit * (b.y - c.y), kUnit * (c.y - a.y), kUnit * (a.y - b.y)};
  const std::int64_t down[3] = {kUnit * (c.x - b.x), kUnit * (a.x - c.x), kUnit * (b.x - a.x)};
  for (std::int64_t row = within.row_begin; row < within.row_end; ++row) {
    const auto [begin, end] = covered(at_row, right, within.column_end - within.column_begin);
    CornerWeights corners = at_row;
    for (std::size_t i = 0; i < 3; ++i) corners.weight[i] += begin * right[i];
    std::size_t at = index(row, within.column_begin + begin);
    for (std::int64_t step = begin; step < end; ++step, ++at) {
      if (!(clipped && height.at(corners) > 0)) {
        const double here = depth.at(corners);
        const bool is_nearest = here > nearest_[at] || (here == nearest_[at] && f < seen_[at]);
        if (is_nearest && is_behind_front(f, here, at)) {
          nearest_[at] = here;
          seen_[at] = f;
        }
      }
      for (std::size_t i = 0; i < 3; ++i) corners.weight[i] += right[i];
    }
    for (std::size_t i = 0; i < 3; ++i) at_row.weight[i] += down[i];
  }
}

double Band::nearest_possible(FaceId f, const Rectangle& within) const {
  constexpr double kRounding = 1e-12;
  const double depths[3] = {corner(f, 0).depth, corner(f, 1).depth, corner(f, 2).depth};
  double of_plane = -std::numeric_limits<double>::infinity();
  for (const std::int64_t row : {within.row_begin, within.row_end - 1}) {
    for (const std::int64_t column : {within.column_begin, within.column_end - 1}) {
      const CornerWeights at = weights_at(f, row, column);
      double depth = 0, size = 0;
      for (int i = 0; i < 3; ++i) {
        depth += at.share(i) * depths[i];
        size += std::fabs(at.share(i) * depths[i]);
      }
      of_plane = std::max(of_plane, depth + kRounding * size);
    }
  }
  const auto [least, most] = std::minmax({depths[0], depths[1], depths[2]});
  return std::min(of_plane, most + kRounding * std::max(std::fabs(least), std::fabs(most)));
}

double Band::furthest_seen(const Rectangle& within) const {
  double furthest = std::numeric_limits<double>::infinity();
  for (std::int64_t row = within.row_begin; row < within.row_end; ++row) {
    const auto begin =
        nearest_.begin() + static_cast<std::ptrdiff_t>(index(row, within.column_begin));
    furthest = std::min(
        furthest, *std::min_element(begin, begin + (within.column_end - within.column_begin)));
  }
  return furthest;
}

// Facets from the front to the back, without those that are copies of another: what a facet cannot
// change is passed over, tile by tile.
class FrontToBack {
 public:
  explicit FrontToBack(Band& band) : band_(band) {
    const Rectangle& all = band.all();
    for (std::int64_t row = all.row_begin; row < all.row_end; row += kTile) {
      for (std::int64_t column = 0; column < all.column_end; column += kTile) {
        tiles_.push_back({common(all, {row, row + kTile, column, column + kTile})});
      }
    }
  }

  void draw(std::span<const FaceId> faces) {
    struct Item {
      double front;
      FaceId face;
    };
    std::vector<Item> items;
    items.reserve(faces.size());
    for (const FaceId f : faces) {
      items.push_back(
          {std::max({band_.corner(f, 0).depth, band_.corner(f, 1).depth, band_.corner(f, 2).depth}),
           f});
    }
    const auto key = [&](FaceId f, std::size_t i) {
      const Point& p = band_.corner(f, i);
      return std::tie(p.x, p.y, p.depth, p.height);
    };
    std::sort(items.begin(), items.end(), [&](const Item& a, const Item& b) {
      if (a.front != b.front) return a.front > b.front;
      for (std::size_t i = 0; i < 3; ++i) {
        if (key(a.face, i) != key(b.face, i)) return key(a.face, i) < key(b.face, i);
      }
      return a.face < b.face;
    });
    for (std::size_t n = 0; n < items.size(); ++n) {
      const FaceId f = items[n].face;
      if (n > 0 && key(f, 0) == key(items[n - 1].face, 0) &&
          key(f, 1) == key(items[n - 1].face, 1) && key(f, 2) == key(items[n - 1].face, 2)) {
        continue;
      }
      draw(f);
    }
  }

 private:
  static constexpr std::int64_t kTile = 64;
  struct Tile {
    Rectangle samples;
    double furthest = -std::numeric_limits<double>::infinity();
    std::int64_t drawn = 0;  // samples since that was looked up
  };

  void draw(FaceId f) {
    const Rectangle &all = band_.all(), box = band_.box_of(f);
    const double samples = band_.samples(f, box);
    if (box.empty() || samples == 0) return;
    const std::int64_t columns = (all.column_end + kTile - 1) / kTile;
    const std::int64_t first_row = (box.row_begin - all.row_begin) / kTile;
    const std::int64_t last_row = (box.row_end - 1 - all.row_begin) / kTile;
    // Of a sliver most tiles hold nothing.
    if (samples < box.samples() / kTile) return band_.draw(f, box);
    for (std::int64_t row = first_row; row <= last_row; ++row) {
      for (std::int64_t column = box.column_begin / kTile; column <= (box.column_end - 1) / kTile;
           ++column) {
        Tile& tile = tiles_[static_cast<std::size_t>(row * columns + column)];
        const Rectangle part = common(tile.samples, box);
        if (band_.nearest_possible(f, part) < tile.furthest) continue;
        band_.draw(f, part);
        tile.drawn += (part.row_end - part.row_begin) * (part.column_end - part.column_begin);
        if (tile.drawn < kTile * kTile) continue;
        tile.furthest = band_.furthest_seen(tile.samples);
        tile.drawn = 0;
      }
    }
  }

  Band& band_;
  std::vector<Tile> tiles_;
};

}  // namespace

ProjectedMesh project(const TriMesh& mesh, const Camera& camera, int samples_per_side,
                      const std::optional<ClipPlane>& clip) {
  // Vertices that are not drawn (of no facet, or clipped) can lie anywhere. The bound keeps the
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
    // Times the magnification the height is linear over the picture of a facet too.
    projected.points.push_back(
        {snap(q.x), snap(q.y), q.depth, clip ? q.magnified * clip->height(p) : 0});
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

Layer visible_layer(const TriMesh& mesh, const ProjectedMesh& projected, int row_begin, int row_end,
                    const Layer* front) {
  // So many facets over each sample, on the average, that sorting them is worth while.
  constexpr double kDeep = 16;
  Band band(mesh, projected, row_begin, row_end, front);
  double samples = 0;
  std::vector<FaceId> faces;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Rectangle box = band.box_of(f);
    if (box.empty()) continue;
    faces.push_back(f);
    samples += band.samples(f, box);
  }
  if (samples > kDeep * static_cast<double>(band.seen().size())) {
    FrontToBack(band).draw(faces);
  } else {
    for (const FaceId f : faces) band.draw(f, band.box_of(f));
  }
  return {std::move(band.seen()), std::move(band.nearest())};
}

std::vector<FaceId> visible_faces(const TriMesh& mesh, const ProjectedMesh& projected,
                                  int row_begin, int row_end) {
  return visible_layer(mesh, projected, row_begin, row_end).faces;
}

}  // namespace deliso
