// SPDX-License-Identifier: MIT
// Stage 1 of the exact program: a part of T, coarsened, and refined; and the coarsener's changes.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/triangle.h"
#include "coarsen/contour_as_mesh.h"
#include "guide/drawing.h"
#include "guide/figures.h"
#include "guide/handed.h"
#include "io/files/append_format.h"
#include "refine/refine.h"

namespace deliso::guide {
namespace {

// From where the meshes are seen.
constexpr double kYaw = 0.6, kPitch = 0.6;
// The part of the paper's plane that is shown, in voxels.
constexpr Vec2 kMiddle{-0.5, 4.5};
constexpr double kReach = 5;
// Of ink::kAbove, in the light last.
constexpr std::array kShades = {"#c9a27c", "#dab892", "#eacbaa", ink::kAbove};

// Draws the facets that face the eye, the nearest last.
void draw_mesh(Drawing& out, const Panel& panel, const TriMesh& mesh, const Vec3& origin) {
  struct Seen {
    double depth = 0;
    std::array<Vec2, 3> corners;  // on the paper
    std::size_t shade = 0;
  };
  std::vector<Seen> seen;
  for (const Face& face : mesh.faces) {
    if (is_dead(face)) continue;
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = turned(mesh.points[face.v[i]] - origin, kYaw, kPitch);
    }
    const Vec3 normal = area_normal(p[0], p[1], p[2]);
    if (!(normal.z > 0)) continue;
    const Box3 box = box_of(p[0], p[1], p[2]);
    if (box.lo.x > kMiddle.x + kReach || box.hi.x < kMiddle.x - kReach ||
        box.lo.y > kMiddle.y + kReach || box.hi.y < kMiddle.y - kReach) {
      continue;
    }
    Seen& facet = seen.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      facet.depth += p[i].z;
      facet.corners[i] = panel.at({p[i].x, p[i].y});
    }
    // The light comes from above.
    const double light = 0.5 + 0.5 * normal.y / length(normal);
    facet.shade =
        std::min(static_cast<std::size_t>(light * std::size(kShades)), std::size(kShades) - 1);
  }
  std::ranges::sort(seen, {}, &Seen::depth);
  for (const Seen& facet : seen) {
    out.polygon(facet.corners, {.stroke = ink::kBlue, .width = 0.8, .fill = kShades[facet.shade]});
  }
}

// A disk of facets and the disk in its place, side by side. The vertex `mark` is red.
struct Disk2 {
  std::vector<Vec2> points;
  std::vector<std::array<std::size_t, 3>> facets;
  std::size_t mark;
};

void draw_disk(Drawing& out, const Disk2& disk, const Vec2& middle) {
  constexpr double kScale = 46;
  const auto at = [&](std::size_t v) {
    return Vec2{middle.x + kScale * disk.points[v].x, middle.y - kScale * disk.points[v].y};
  };
  for (const auto& [a, b, c] : disk.facets) {
    out.polygon(std::array{at(a), at(b), at(c)},
                {.stroke = ink::kBlue, .width = 1.3, .fill = ink::kAbove});
  }
  for (std::size_t v = 0; v < disk.points.size(); ++v) {
    out.dot(at(v), v == disk.mark ? ink::kRed : ink::kSigma, v == disk.mark ? 4.5 : 3);
  }
}

void draw_change(Drawing& out, double x, std::string_view title, const Disk2& before,
                 const Disk2& after) {
  const Vec2 left{x + 53, 368}, right{x + 177, 368};
  out.text({x + 115, 304}, title, Anchor::middle, 13, ink::kText, true);
  draw_disk(out, before, left);
  draw_disk(out, after, right);
  out.arrow(left + Vec2{53, 0}, right - Vec2{53, 0}, {.stroke = ink::kGray, .width = 1.5});
}

// The star of the last of the points, whose ring the others are.
Disk2 star_of(std::vector<Vec2> points) {
  const std::size_t n = points.size() - 1;
  Disk2 disk{std::move(points), {}, n};
  for (std::size_t k = 0; k < n; ++k) disk.facets.push_back({k, (k + 1) % n, n});
  return disk;
}

}  // namespace

void draw_coarsen(const std::string& folder) {
  Handed h("builtin:machine:32", 127.5, {});
  Drawing out(760, 436);
  const Vec3 origin = h.volume.box().middle();
  const auto draw = [&](double x, const TriMesh& mesh, const char* what) {
    const Panel panel{kMiddle - Vec2{kReach, kReach}, 115 / kReach, {x, 40}, {230, 230}};
    out.clip_to(panel);
    draw_mesh(out, panel, mesh, origin);
    std::string title;
    append_format(title, "%s: %zu vertices", what, mesh.points.size());
    out.frame(panel, title);
  };
  draw(16, contour_as_mesh(h.contour).mesh, "T");
  SurfaceMesh& s = h.coarsened.mesh;
  draw(265, s.mesh, "coarsened");
  refine(s, h.coarsened.samples, h.given());
  draw(514, s.mesh, "refined");

  const std::vector<Vec2> ring{{0.95, 0.1}, {0.5, 0.85},  {-0.45, 0.9},
                               {-0.95, 0},  {-0.4, -0.8}, {0.55, -0.8}};
  constexpr std::size_t kNone = 99;
  std::vector<Vec2> star = ring;
  star.push_back({0.15, -0.1});
  draw_change(out, 16, "a vertex is removed", star_of(star),
              {ring, {{0, 1, 5}, {1, 2, 4}, {2, 3, 4}, {1, 4, 5}}, kNone});
  const std::vector<Vec2> quad{{0.95, -0.1}, {0, 0.45}, {-0.95, 0.1}, {0.1, -0.5}};
  draw_change(out, 265, "an edge is flipped", {quad, {{0, 1, 2}, {0, 2, 3}}, kNone},
              {quad, {{0, 1, 3}, {1, 2, 3}}, kNone});
  star.back() = {0.45, -0.4};
  std::vector<Vec2> moved = ring;
  moved.push_back({0.03, 0.04});
  draw_change(out, 514, "a vertex moves", star_of(star), star_of(moved));
  out.write(folder, "coarsen");
}

}  // namespace deliso::guide
