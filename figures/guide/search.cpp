// SPDX-License-Identifier: MIT
// Pictures of searches: the paper's Figure 13, and the point of Sigma nearest to a circumcenter.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/check.h"
#include "base/triangle.h"
#include "guide/drawing.h"
#include "guide/figures.h"
#include "guide/slice.h"
#include "io/files/append_format.h"
#include "isosurface/lattice_line.h"
#include "surface/surface_point.h"

namespace deliso::guide {
namespace {

void draw_voxel(Drawing& out, const Panel& panel, int i, int j, const Style& style) {
  const Vec2 corner = panel.at({double(i), j + 1.0});
  out.rectangle(corner, {panel.scale, panel.scale}, style);
}

void draw_background(Drawing& out, const Panel& panel, const Slice& slice) {
  out.clip_to(panel);
  out.rectangle(panel.corner, panel.size, {.fill = ink::kBelow});
  out.region(panel.at(slice.loops()), {.fill = ink::kAbove});
}

// The tree's nodes along a line, as VoxelTree has them (K1 of kdtree/voxel_tree.h).
struct Descent {
  const Slice& slice;
  LatticeLine line;
  std::vector<VoxelBox> pruned, leaves;

  void visit(const VoxelBox& box, std::array<int, 2> longest, int level) {
    if (!meets(box)) return;
    if (!is_active(box)) {
      pruned.push_back(box);
    } else if (level == slice.tree().depth()) {
      leaves.push_back(box);
    } else {
      const std::size_t axis = longest[1] >= longest[0] ? 1 : 0;
      longest[axis] = (longest[axis] + 1) / 2;
      VoxelBox low = box, high = box;
      low.hi[axis] = high.lo[axis] = box.lo[axis] + (box.hi[axis] - box.lo[axis]) / 2;
      visit(low, longest, level + 1);
      visit(high, longest, level + 1);
    }
  }
  bool meets(const VoxelBox& box) const {
    Range range{0, 1};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const int first = line.ahead(axis) ? box.lo[axis] : box.hi[axis];
      const int last = line.ahead(axis) ? box.hi[axis] : box.lo[axis];
      range.lo = std::max(range.lo, line.at_plane(axis, first));
      range.hi = std::min(range.hi, line.at_plane(axis, last));
    }
    return range.lo < range.hi;
  }
  bool is_active(const VoxelBox& box) const {
    bool above = false, below = false;
    for (int j = box.lo[1]; j <= box.hi[1]; ++j) {
      for (int i = box.lo[0]; i <= box.hi[0]; ++i) {
        (slice.volume().sample(i, j, 0) >= 0 ? above : below) = true;
      }
    }
    return above && below;
  }
};

void draw_box(Drawing& out, const Panel& panel, const VoxelBox& box, const Style& style) {
  const Vec2 corner = panel.at({double(box.lo[0]), double(box.hi[1])});
  out.rectangle(corner,
                {panel.scale * (box.hi[0] - box.lo[0]), panel.scale * (box.hi[1] - box.lo[1])},
                style);
}

bool is_mixed(const Corners& corners) {
  const auto is_inside = [](double value) { return value >= 0; };
  return std::any_of(corners.begin(), corners.end(), is_inside) &&
         !std::all_of(corners.begin(), corners.end(), is_inside);
}

std::string counted(const char* before, std::size_t count, const char* after) {
  std::string words;
  append_format(words, "%s%zu%s", before, count, after);
  return words;
}

void draw_ray(Drawing& out, const Panel& panel, const Slice& slice, const Vec2& a, const Vec2& b) {
  out.region(panel.at(slice.loops()), {.stroke = ink::kSigma, .width = 1.8});
  out.arrow(panel.at(a), panel.at(b), {.stroke = ink::kText, .width = 0.8});
}

}  // namespace

void draw_kdtree(const std::string& folder) {
  const auto blobs = [](double x, double y) {
    const auto blob = [&](double cx, double cy, double rx, double ry) {
      const double u = (0.5 * x - cx) / rx, v = (0.5 * y - cy) / ry;
      return 1 - std::sqrt(u * u + v * v);
    };
    return std::max({blob(19, 13, 9, 6.5), blob(24, 25, 5.5, 8), blob(52, 36, 6.5, 7),
                     blob(53, 8, 6, 4)}) +
           0.0013;
  };
  const Slice slice(129, 97, blobs, 2);
  const Vec2 a{6.6, 16.4}, b{124.8, 89.2};
  const Segment ray{Slice::lifted(a), Slice::lifted(b)};
  const LatticeLine line = slice.tree().lattice_line(ray.a, ray.direction());
  Drawing out(760, 316);
  const Panel left{{0, 0}, 2.75, {16, 36}, {352, 264}}, right{{0, 0}, 2.75, {392, 36}, {352, 264}};

  draw_background(out, left, slice);
  std::size_t on_ray = 0;
  for (VoxelWalk walk(line, line.voxel_after(0, slice.tree().box()), {0, 1}); !walk.done();
       walk.step(), ++on_ray) {
    draw_voxel(out, left, walk.voxel().i, walk.voxel().j, {.fill = "#c766b8"});
  }
  draw_ray(out, left, slice, a, b);
  out.frame(left, counted("by the ray alone: ", on_ray, " voxels"));

  draw_background(out, right, slice);
  Descent descent{slice, line, {}, {}};
  descent.visit(slice.tree().box(), {128, 96}, 0);
  for (const VoxelBox& box : descent.pruned) {
    draw_box(out, right, box, {.fill = ink::kPaper, .opacity = 0.75});
    draw_box(out, right, box, {.stroke = ink::kBlue, .width = 1.2});
  }
  for (const VoxelBox& box : descent.leaves) {
    draw_box(out, right, box, {.stroke = ink::kOrange, .width = 1.5});
  }
  std::vector<VoxelSpan> active;
  slice.tree().collect_voxels(ray, 0, active);
  std::size_t tested = 0;
  for (const VoxelBox& box : descent.leaves) {
    for (VoxelWalk walk(line, line.voxel_after(0, slice.tree().box()), {0, 1}); !walk.done();
         walk.step()) {
      const Index3 v = walk.voxel();
      if (v.i < box.lo[0] || v.i >= box.hi[0] || v.j < box.lo[1] || v.j >= box.hi[1]) continue;
      ++tested;
      const bool is_active = std::any_of(active.begin(), active.end(),
                                         [&](const VoxelSpan& s) { return s.voxel == v; });
      draw_voxel(out, right, v.i, v.j, {.fill = is_active ? ink::kGreen : "#c766b8"});
    }
  }
  draw_ray(out, right, slice, a, b);
  for (const VoxelSpan& span : active) {
    out.dot(right.at({span.voxel.i + 0.5, span.voxel.j + 0.5}), ink::kGreen, 4);
  }
  out.frame(right, counted("with min and max: ", tested, " looked at, ") +
                       counted("", active.size(), " solved"));
  out.write(folder, "kdtree");
}

void draw_oracle(const std::string& folder) {
  Drawing out(760, 316);
  {
    // From the circumcenter both ways, voxel by voxel.
    const Slice slice(17, 13, [](double x, double y) {
      const double u = x - 7.6, v = y + 3.5;
      const double body = 11.4 - std::sqrt(u * u + 0.8 * v * v) + 0.9 * std::sin(0.8 * x);
      return std::min({body, x - 0.6, 15.4 - x, y - 0.6}) + 0.0013;
    });
    const Panel panel{{0, 0}, 22, {16, 36}, {352, 264}};
    draw_background(out, panel, slice);
    for (int i = 0; i <= 16; ++i) {
      out.line(panel.at({double(i), 0}), panel.at({double(i), 12}),
               {.stroke = ink::kGray, .width = 0.4});
    }
    for (int j = 0; j <= 12; ++j) {
      out.line(panel.at({0, double(j)}), panel.at({16, double(j)}),
               {.stroke = ink::kGray, .width = 0.4});
    }
    const Vec2 center{7.4, 6.4};
    Vec2 along{0.38, 1};
    along = (1 / std::sqrt(dot(along, along))) * along;
    SearchCounters counters;
    const auto hit =
        slice.surface().nearest(Slice::lifted(center), {along.x, along.y, 0}, 9, counters);
    DELISO_CHECK(hit.has_value());
    const LatticeLine line =
        slice.tree().lattice_line(Slice::lifted(center), {along.x, along.y, 0});
    const LatticeLine back = line.reversed();
    const Index3 start = line.voxel_after_origin();
    const VoxelSpan first = line.span(start, {-9, 9});
    VoxelWalk ahead(line, start, {first.t0, line.clip({-9, 9}).hi});
    VoxelWalk behind(back, start, {-first.t1, back.clip({-9, 9}).hi});
    // The order of find_nearest in isosurface/isosurface.cpp.
    int number = 1;
    std::size_t solved = 0;
    const auto look = [&](Index3 v) {
      const bool active = is_mixed(slice.volume().corners(v));
      solved += active;
      draw_voxel(out, panel, v.i, v.j,
                 {.stroke = ink::kGray, .width = 0.7, .fill = active ? "#8fd0a8" : "#e3b7dd"});
      std::string digits;
      append_format(digits, "%d", number++);
      out.text(panel.at({v.i + 0.96, v.j + 0.08}), digits, Anchor::end, 10);
    };
    look(start);
    ahead.step();
    behind.step();
    const double reach = std::fabs(hit->t);
    while (true) {
      const bool ahead_done = ahead.done() || ahead.t() > reach;
      const bool behind_done = behind.done() || behind.t() > reach;
      if (ahead_done && behind_done) break;
      VoxelWalk& walk = behind_done || (!ahead_done && ahead.t() <= behind.t()) ? ahead : behind;
      look(walk.voxel());
      walk.step();
    }
    DELISO_CHECK(solved == counters.computations);
    out.region(panel.at(slice.loops()), {.stroke = ink::kSigma, .width = 1.8});
    out.line(panel.at(center - 8.0 * along), panel.at(center + 8.0 * along),
             {.stroke = ink::kRed, .width = 1, .dashed = true});
    out.dot(panel.at(center), ink::kText, 4.5);
    out.text(panel.at(center) + Vec2{-9, 2}, "c", Anchor::end);
    out.dot(panel.at({hit->point.x, hit->point.y}), ink::kRed, 5);
    out.text(panel.at({hit->point.x, hit->point.y}) + Vec2{9, -7}, "x", Anchor::start, 13,
             ink::kRed);
    out.frame(panel, "outwards from c, both ways, in this order");
  }
  {
    // A shell thinner than a facet's sag.
    constexpr double kOuter = 28, kThickness = 2.6;
    const Slice slice(67, 67, [](double x, double y) {
      const double r = std::sqrt((x - 33) * (x - 33) + (y - 33) * (y - 33));
      return std::min(kOuter - r, r - (kOuter - kThickness)) + 0.0013;
    });
    const Panel panel{{19, 52.4}, 352.0 / 28, {392, 36}, {352, 264}};
    draw_background(out, panel, slice);
    out.region(panel.at(slice.loops()), {.stroke = ink::kSigma, .width = 1.8});
    const auto on_outside = [&](double degrees) {
      const double angle = degrees * std::numbers::pi / 180;
      return slice.hits({33 + 32 * std::cos(angle), 33 + 32 * std::sin(angle)}, {33, 33})[0];
    };
    const Vec2 a = on_outside(111), b = on_outside(69);
    // Counter-clockwise from outside: an upright triangle over the chord.
    const Vec3 p{b.x, b.y, 0}, q{a.x, a.y, 0},
        top{0.5 * (a.x + b.x), 0.5 * (a.y + b.y), Slice::kLayers};
    const Vec3 outwards = area_normal(p, q, top).y > 0 ? p : q;
    const Vec3 other = outwards == p ? q : p;
    const Vec3 center = circumcenter(outwards, other, top);
    SurfacePointFinder finder(slice.surface());
    SearchCounters counters;
    const auto x = finder.find(outwards, other, top, counters);
    const auto nearest = slice.surface().nearest(center, {0, 1, 0}, 9, counters);
    DELISO_CHECK(x && nearest);
    const Vec2 c{center.x, center.y};
    out.line(panel.at(a), panel.at(b), {.stroke = ink::kBlue, .width = 3});
    out.line(panel.at(c - Vec2{0, 3.6}), panel.at(c + Vec2{0, 7}),
             {.stroke = ink::kRed, .width = 1, .dashed = true});
    out.arrow(panel.at(c), panel.at(c + Vec2{0, 5.2}), {.stroke = ink::kBlue, .width = 1.5});
    out.text(panel.at(c + Vec2{0.4, 5}), "the facet's normal", Anchor::start, 13, ink::kBlue);
    const auto gradient_at = [&](const Vec3& at, const char* words, double to_the_right) {
      Vec3 g = slice.surface().gradient(at);
      g = (2.6 / length(g)) * g;
      const Vec2 foot{at.x + to_the_right, at.y};
      out.arrow(panel.at(foot), panel.at({foot.x + g.x, foot.y + g.y}),
                {.stroke = ink::kOrange, .width = 2});
      // Off the wall, at the arrow's tail.
      out.text(panel.at(foot) + Vec2{0, g.y > 0 ? 20.0 : -10.0}, words,
               to_the_right > 0 ? Anchor::start : Anchor::middle, 13, "#a85f12");
    };
    gradient_at(*x, "gradient", 3);
    gradient_at(nearest->point, "gradient", -3);
    out.dot(panel.at({nearest->point.x, nearest->point.y}), ink::kGray, 5);
    const Vec2 below = panel.at({nearest->point.x, nearest->point.y});
    out.text(below + Vec2{8, 22}, "nearest hit:");
    out.text(below + Vec2{8, 38}, "faces away");
    out.dot(panel.at({x->x, x->y}), ink::kRed, 5);
    out.text(panel.at({x->x, x->y}) + Vec2{10, -8}, "x", Anchor::start, 13, ink::kRed);
    out.dot(panel.at(c), ink::kText, 4.5);
    out.text(panel.at(c) + Vec2{-10, -6}, "c", Anchor::end);
    out.dot(panel.at(a), ink::kSigma, 4);
    out.dot(panel.at(b), ink::kSigma, 4);
    out.frame(panel, "a wall thinner than the facet's sag");
  }
  out.write(folder, "oracle");
}

}  // namespace deliso::guide
