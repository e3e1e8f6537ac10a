// SPDX-License-Identifier: MIT
#include "lesson/cells.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "contour/contour.h"
#include "io/volume/builtin_volume.h"

namespace deliso::lesson {
namespace {

// A half space: dot(normal, p) <= offset.
struct HalfSpace {
  Vec3 normal;
  double offset;
  double excess(const Vec3& p) const { return dot(normal, p) - offset; }
};

// The part of a convex polygon in the half space.
Polygon clipped(const Polygon& polygon, const HalfSpace& half) {
  Polygon out;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Vec3 &p = polygon[n], &q = polygon[(n + 1) % polygon.size()];
    const double from = half.excess(p), to = half.excess(q);
    if (from <= 0) out.push_back(p);
    if ((from <= 0) != (to <= 0)) out.push_back(p + from / (from - to) * (q - p));
  }
  return out;
}

bool is_on(const HalfSpace& half, const Vec3& p) {
  return std::fabs(half.excess(p)) < 1e-9 * (1 + std::fabs(half.offset));
}

// Cuts a convex body, and closes it by a side in the plane.
void cut(std::vector<Polygon>& body, const HalfSpace& half) {
  std::vector<Polygon> kept;
  Polygon side;
  for (const Polygon& polygon : body) {
    Polygon rest = clipped(polygon, half);
    if (rest.size() < 3) continue;
    for (const Vec3& p : rest) {
      const auto is_there = [&p](const Vec3& q) { return distance2(p, q) < 1e-14; };
      if (is_on(half, p) && std::none_of(side.begin(), side.end(), is_there)) side.push_back(p);
    }
    kept.push_back(std::move(rest));
  }
  if (side.size() >= 3) {
    Vec3 middle;
    for (const Vec3& p : side) middle = middle + (1.0 / static_cast<double>(side.size())) * p;
    const Vec3 u = side[0] - middle, v = cross(half.normal, u);
    std::sort(side.begin(), side.end(), [&](const Vec3& p, const Vec3& q) {
      return std::atan2(dot(p - middle, v) / dot(v, v), dot(p - middle, u) / dot(u, u)) <
             std::atan2(dot(q - middle, v) / dot(v, v), dot(q - middle, u) / dot(u, u));
    });
    kept.push_back(std::move(side));
  }
  body = std::move(kept);
}

std::vector<Polygon> box_sides(const Box3& box) {
  const auto corner = [&](int m) {
    return Vec3{m & 1 ? box.hi.x : box.lo.x, m & 2 ? box.hi.y : box.lo.y,
                m & 4 ? box.hi.z : box.lo.z};
  };
  constexpr int kSides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  std::vector<Polygon> sides;
  for (const auto& side : kSides) {
    sides.push_back({corner(side[0]), corner(side[1]), corner(side[2]), corner(side[3])});
  }
  return sides;
}

// Every site is the vertex of T that is furthest from all before it.
std::vector<Vec3> spread_sites(const ContourMesh& contour, std::size_t count) {
  IdArray<ContourId, double> far(contour.points.size(), HUGE_VAL);
  std::vector<Vec3> sites{contour.points[0]};
  while (sites.size() < count) {
    for (ContourId v = 0; v < far.size(); ++v) {
      far[v] = std::min(far[v], distance2(contour.points[v], sites.back()));
    }
    const ContourId furthest(std::ranges::max_element(far) - far.begin());
    sites.push_back(contour.points[furthest]);
  }
  return sites;
}

// Cells that have no end are cut off near T.
Box3 box_around(const ContourMesh& contour) {
  Box3 box{contour.points[0], contour.points[0]};
  for (const Vec3& p : contour.points) {
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], p[axis] - 0.1);
      box.hi[axis] = std::max(box.hi[axis], p[axis] + 0.1);
    }
  }
  return box;
}

Cell cell_of(const ContourMesh& contour, const std::vector<Vec3>& sites, std::size_t own) {
  std::vector<HalfSpace> halves;
  for (std::size_t n = 0; n < sites.size(); ++n) {
    if (n == own) continue;
    const Vec3 normal = sites[n] - sites[own];
    halves.push_back({normal, dot(normal, 0.5 * (sites[n] + sites[own]))});
  }
  Cell cell{"", "", box_sides(box_around(contour)), {}, {}};
  for (const HalfSpace& half : halves) cut(cell.sides, half);
  for (const auto& t : contour.triangles) {
    Polygon piece{contour.points[t[0]], contour.points[t[1]], contour.points[t[2]]};
    for (const HalfSpace& half : halves) piece = clipped(piece, half);
    if (piece.size() < 3) continue;
    for (std::size_t n = 0; n < piece.size(); ++n) {
      const Vec3 &p = piece[n], &q = piece[(n + 1) % piece.size()];
      const auto has_both = [&](const HalfSpace& half) { return is_on(half, p) && is_on(half, q); };
      if (std::any_of(halves.begin(), halves.end(), has_both)) cell.ends.push_back({p, q});
    }
    cell.surface.push_back(std::move(piece));
  }
  return cell;
}

// In the unit ball.
Cell make_cell(const char* title, const char* text, const ContourMesh& contour,
               const std::vector<Vec3>& sites, std::size_t own) {
  Cell cell = cell_of(contour, sites, own);
  cell.title = title;
  cell.text = text;
  Vec3 middle;
  double corners = 0;
  for (const Polygon& side : cell.sides) {
    for (const Vec3& p : side) {
      middle = middle + p;
      ++corners;
    }
  }
  middle = middle / corners;
  double radius = 0;
  for (const Polygon& side : cell.sides) {
    for (const Vec3& p : side) radius = std::max(radius, std::sqrt(distance2(p, middle)));
  }
  for (auto* list : {&cell.sides, &cell.surface, &cell.ends}) {
    for (Polygon& polygon : *list) {
      for (Vec3& p : polygon) p = (1 / radius) * (p - middle);
    }
  }
  return cell;
}

}  // namespace

std::vector<Cell> torus_cells() {
  constexpr std::size_t kSites = 40;
  const Volume torus = Volume::from_function(
      {{-1.6, -1.6, -0.6}, {1.6, 1.6, 0.6}}, {9, 9, 4},
      [](const Vec3& p) { return 0.45 - std::hypot(std::hypot(p.x, p.y) - 1, p.z); });
  const ContourMesh t = build_contour(torus, geometric_isovalue(torus.type(), 0));
  const std::vector<Vec3> sites = spread_sites(t, kSites);
  std::vector<Cell> cells;
  for (std::size_t n = 0; n < kSites; ++n) {
    cells.push_back(cell_of(t, sites, n));
    cells.back().site = sites[n];
  }
  return cells;
}

std::vector<Cell> example_cells() {
  const Volume torus = make_builtin_volume("builtin:torus:16");
  const ContourMesh t = build_contour(torus, geometric_isovalue(torus.type(), 0));
  const auto of_torus = [&](const char* title, const char* text, std::size_t sites,
                            std::size_t own) {
    return make_cell(title, text, t, spread_sites(t, sites), own);
  };
  // Two balls with a narrow gap: one site in the gap, the others around it.
  const Box3 box{{0, 0, 0}, {2, 1.2, 1.2}};
  const Vec3 left{0.5, 0.6, 0.6}, right{1.5, 0.6, 0.6};
  const Volume balls = Volume::from_function(box, {21, 13, 13}, [&](const Vec3& p) {
    return 0.42 - std::sqrt(std::min(distance2(p, left), distance2(p, right)));
  });
  const ContourMesh b = build_contour(balls, geometric_isovalue(balls.type(), 0));
  std::vector<Vec3> around{left + Vec3{0.42, 0, 0}};
  const auto put_around = [](std::vector<Vec3>& sites, const Vec3& center) {
    for (const double r : {-0.42, 0.42}) {
      sites.push_back(center + Vec3{0, r, 0});
      sites.push_back(center + Vec3{0, 0, r});
    }
  };
  put_around(around, left);
  put_around(around, right);
  // A ball with a site on each side, and a small one, without a site, in front of the first of
  // these.
  const Vec3 front{1.25, 0.6, 0.6};
  const Volume pair = Volume::from_function(box, {21, 13, 13}, [&](const Vec3& p) {
    return std::max(0.42 - std::sqrt(distance2(p, left)), 0.17 - std::sqrt(distance2(p, front)));
  });
  const ContourMesh c = build_contour(pair, geometric_isovalue(pair.type(), 0));
  std::vector<Vec3> on_first{left + Vec3{0.42, 0, 0}, left - Vec3{0.42, 0, 0}};
  put_around(on_first, left);
  return {of_torus("A disk", "as it should be", 40, 1), of_torus("A ring", "around a tube", 7, 4),
          make_cell("Two pieces", "on both sides of a gap", b, around, 0),
          make_cell("A disk and a ball", "which no edge meets", c, on_first, 0)};
}

}  // namespace deliso::lesson
