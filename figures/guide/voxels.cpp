// SPDX-License-Identifier: MIT
// Pictures of what is decided by cases: a voxel's pieces, and the triangles at a vertex.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "contour/contour.h"
#include "contour/split_voxels.h"
#include "contour/voxel_topology.h"
#include "guide/drawing.h"
#include "guide/figures.h"
#include "io/files/append_format.h"
#include "mesh/star.h"

namespace deliso::guide {
namespace {

// Cells to a side of a voxel, where its pieces are drawn smooth.
constexpr int kCells = 8;
// From the eye into the picture, and towards the light.
constexpr Vec3 kAway{-0.42, 1, -0.3}, kLight{-1, -1.5, 2};
// By how much a line is drawn over triangles of its depth, and a dot over lines.
constexpr double kLine = 0.15;

// Of a piece of Sigma: blue from outside, orange from inside, dark where it faces away from the
// light.
std::string shade(bool is_inner, double light) {
  const double share = 0.55 + 0.45 * std::max(0.0, light);
  const auto part = [share](double full) { return static_cast<int>(share * full); };
  std::string color;
  if (is_inner) {
    append_format(color, "#%02x%02x%02x", part(250), part(206), part(158));
  } else {
    append_format(color, "#%02x%02x%02x", part(170), part(203), part(246));
  }
  return color;
}

// The voxel of these values, seen from the front, a little from the right and above.
void draw_voxel(Drawing& out, const Vec2& corner, const Corners& values, const char* title,
                const char* subtitle) {
  constexpr double kSide = 106;
  const auto at = [&](const Vec3& p) {
    return Vec2{corner.x + kSide * (p.x + 0.42 * p.y), corner.y + kSide * (1.3 - p.z - 0.3 * p.y)};
  };
  const auto corner_at = [&](int m) {
    return at({double(m & 1), double(m >> 1 & 1), double(m >> 2)});
  };
  const auto edge = [&](int e) {
    const auto ends = corners_of_edge(e);
    const bool is_hidden = ends[0] == 2 || ends[1] == 2;
    out.line(corner_at(ends[0]), corner_at(ends[1]),
             {.stroke = ink::kGray, .width = 1, .dashed = is_hidden});
  };
  for (int e = 0; e < 12; ++e) edge(e);
  const Volume volume =
      Volume::from_samples<double>({2, 2, 2}, {1, 1, 1}, {values.begin(), values.end()});
  // T of many cells, which looks like Sigma, with its boundary and the crossings of grid edges: the
  // furthest first, lit from the upper left, the outside blue and the inside orange.
  const ContourMesh fine = build_contour(volume, 0, {{0}, {kCells, kCells, kCells}});
  const auto is_crossing = [&](VertexId v) {
    int on_faces = 0;
    for (int axis = 0; axis < 3; ++axis) {
      on_faces += fine.points[v][axis] == 0 || fine.points[v][axis] == 1;
    }
    return on_faces == 2;
  };
  std::vector<std::array<VertexId, 3>> pieces = fine.triangles;
  for (std::size_t c = 0; c < fine.boundary.size(); ++c) {
    const auto& chain = fine.boundary.vertices[c];
    for (std::size_t n = 0; n < chain.size(); ++n) {
      pieces.push_back({chain[n], chain[n], chain[(n + 1) % chain.size()]});
      if (is_crossing(chain[n])) pieces.push_back({chain[n], chain[n], chain[n]});
    }
  }
  const auto depth = [&](const std::array<VertexId, 3>& t) {
    double sum = t[0] == t[2] ? -2 * kLine : t[0] == t[1] ? -kLine : 0;
    for (const VertexId v : t) sum += dot(fine.points[v], kAway);
    return sum;
  };
  std::stable_sort(pieces.begin(), pieces.end(),
                   [&](const auto& a, const auto& b) { return depth(a) > depth(b); });
  for (const auto& t : pieces) {
    if (t[0] == t[2]) {
      out.dot(at(fine.points[t[0]]), ink::kSigma, 3);
      continue;
    }
    if (t[0] == t[1]) {
      out.line(at(fine.points[t[0]]), at(fine.points[t[2]]), {.stroke = ink::kSigma, .width = 1.8});
      continue;
    }
    const Vec3 center = (fine.points[t[0]] + fine.points[t[1]] + fine.points[t[2]]) / 3.0;
    const Vec3 normal = -1.0 * volume.gradient(center);
    const bool is_inner = dot(normal, kAway) > 0;
    const double light = dot(normal, kLight) / (length(normal) * length(kLight));
    const std::string color = shade(is_inner, is_inner ? -light : light);
    const Vec2 p[] = {at(fine.points[t[0]]), at(fine.points[t[1]]), at(fine.points[t[2]])};
    out.polygon(p, {.stroke = color.c_str(), .width = 0.5, .fill = color.c_str()});
  }
  for (int m = 0; m < 8; ++m) {
    out.dot(corner_at(m), values[static_cast<std::size_t>(m)] >= 0 ? ink::kOrange : ink::kBlue, 6);
  }
  out.text({corner.x, corner.y - 30}, title, Anchor::start, 13, ink::kText, true);
  out.text({corner.x, corner.y - 13}, subtitle);
}

Corners two_inside(int a, int b, double inside, double outside) {
  Corners values;
  values.fill(outside);
  values[static_cast<std::size_t>(a)] = values[static_cast<std::size_t>(b)] = inside;
  return values;
}

// Triangles around q = vertex 0, with the others on a circle, and the edges of its link in red.
void draw_star(Drawing& out, const Vec2& center, std::span<const double> degrees,
               std::span<const Triangle> triangles, const char* subtitle) {
  constexpr double kRadius = 74;
  std::vector<Vec2> places{center};
  for (const double d : degrees) {
    const double angle = d * std::numbers::pi / 180;
    places.push_back(center + Vec2{kRadius * std::cos(angle), -kRadius * std::sin(angle)});
  }
  for (const Triangle& t : triangles) {
    const Vec2 p[] = {places[t[0]], places[t[1]], places[t[2]]};
    out.polygon(p, {.stroke = ink::kBlue, .width = 1.2, .fill = ink::kBelow, .opacity = 0.9});
  }
  for (const Triangle& t : triangles) {
    out.line(places[t[1]], places[t[2]], {.stroke = ink::kRed, .width = 3});
  }
  for (std::size_t n = 1; n < places.size(); ++n) out.dot(places[n], ink::kSigma, 4);
  out.dot(center, ink::kOrange, 6);
  out.text(center + Vec2{0, 21}, "q", Anchor::middle, 14, ink::kText, true);
  const Star star = classify_star(0, triangles);
  out.text({center.x, 26}, name_of(star), Anchor::middle, 13,
           star == Star::singular || star == Star::empty ? ink::kRed : ink::kText, true);
  out.text({center.x, 232}, subtitle, Anchor::middle);
}

}  // namespace

void draw_contour(const std::string& folder) {
  Drawing out(760, 214);
  draw_voxel(out, {18, 56}, two_inside(0, 3, 2, -1), "a face decides", "saddle inside: joined");
  draw_voxel(out, {206, 56}, two_inside(0, 3, 1, -2), "", "saddle outside: apart");
  draw_voxel(out, {394, 56}, two_inside(0, 7, 1, -1), "the interior decides", "two disks");
  draw_voxel(out, {582, 56}, two_inside(0, 7, 6, -1), "", "one tube");
  out.write(folder, "contour");
}

void draw_stars(const std::string& folder) {
  Drawing out(760, 244);
  const double six[] = {10, 70, 130, 190, 250, 310}, fan[] = {10, 65, 120, 175},
               bow[] = {-40, 0, 40, 140, 180, 220}, book[] = {0, 70, 130, 230};
  const Triangle disk[] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 1}};
  const Triangle half[] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  const Triangle two_fans[] = {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 6}};
  const Triangle pages[] = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  draw_star(out, {98, 130}, six, disk, "one cycle");
  draw_star(out, {286, 152}, fan, half, "one path: on the box only");
  draw_star(out, {474, 130}, bow, two_fans, "two pieces");
  draw_star(out, {662, 130}, book, pages, "three edges at a vertex");
  out.write(folder, "stars");
}

}  // namespace deliso::guide
