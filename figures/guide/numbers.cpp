// SPDX-License-Identifier: MIT
// Pictures of roots and of signs.
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "exact/predicates.h"
#include "guide/drawing.h"
#include "guide/figures.h"
#include "io/files/append_format.h"
#include "isosurface/voxel_ray.h"
#include "roots/bracket.h"

namespace deliso::guide {
namespace {

// g - kappa along a voxel's diagonal: the curve over its control polygon, what isolates its roots,
// and these.
void draw_cubic(Drawing& out, const Panel& panel, const Corners& corners, const char* title,
                bool with_names) {
  const Cubic b = patch_along(corners, {0, 0, 0}, {1, 1, 1});
  const Cubic power = {b[0], 3 * (b[1] - b[0]), 3 * (b[0] - 2 * b[1] + b[2]),
                       (b[3] - b[0]) + 3 * (b[1] - b[2])};
  const Roots roots = crossings(b, CubicMethod::isolation);
  const double top = panel.corner.y, bottom = top + panel.size.y;
  const Vec2 zero = panel.at({0, 0});
  out.rectangle(panel.corner, {panel.size.x, zero.y - top}, {.fill = ink::kAbove});
  out.rectangle({panel.corner.x, zero.y}, {panel.size.x, bottom - zero.y}, {.fill = ink::kBelow});
  out.line(zero, panel.at({1, 0}), {.stroke = ink::kSigma, .width = 1});
  const std::array<Vec2, 4> control = {panel.at({0, b[0]}), panel.at({1.0 / 3, b[1]}),
                                       panel.at({2.0 / 3, b[2]}), panel.at({1, b[3]})};
  out.polyline(control, {.stroke = ink::kGray, .width = 1.5, .dashed = true});
  std::vector<Vec2> curve;
  for (int n = 0; n <= 100; ++n) curve.push_back(panel.at({n / 100.0, value_at(power, n / 100.0)}));
  out.polyline(curve, {.stroke = ink::kBlue, .width = 2.5});
  for (const Vec2& p : control) out.dot(p, ink::kGray);
  if (roots.count > 1) {
    for (const double t : critical_points(power)) {
      out.line({panel.at({t, 0}).x, top}, {panel.at({t, 0}).x, bottom},
               {.stroke = ink::kGreen, .dashed = true});
      out.dot(panel.at({t, value_at(power, t)}), ink::kGreen);
    }
  }
  for (const double t : roots) out.dot(panel.at({t, 0}), ink::kRed, 5);
  out.text({panel.corner.x, top - 8}, title, Anchor::start, 13, ink::kText, true);
  if (!with_names) return;
  out.text(control[1] + Vec2{8, 4}, "b1", Anchor::start, 13, ink::kGray);
  out.text(control[2] + Vec2{8, 4}, "b2", Anchor::start, 13, ink::kGray);
  out.text(control[0] + Vec2{8, 12}, "b0", Anchor::start, 13, ink::kGray);
  out.text(control[3] + Vec2{-8, -6}, "b3", Anchor::end, 13, ink::kGray);
  out.text(zero + Vec2{-10, 4}, "0", Anchor::end);
  out.text({zero.x, bottom + 18}, "t = 0, enters the voxel");
  out.text({panel.at({1, 0}).x, bottom + 18}, "t = 1, leaves it", Anchor::end);
}

Corners corners_of(double b0, double b1, double b2, double b3) {
  return {b0, b1, b1, b2, b1, b2, b2, b3};
}

constexpr int kUnknown = 2;

// What a sign test says at 60 x 60 places: orange, blue, black for zero, gray where it cannot tell.
void draw_signs(Drawing& out, const Vec2& corner, const char* title, const char* subtitle,
                const std::function<int(int, int)>& sign) {
  constexpr int kSide = 60;
  constexpr double kPixel = 4;
  const auto color = [](int s) {
    return s == kUnknown ? ink::kLight : s > 0 ? ink::kOrange : s < 0 ? ink::kBlue : ink::kSigma;
  };
  for (int row = 0; row < kSide; ++row) {
    for (int from = 0, to = 0; from < kSide; from = to) {
      const int s = sign(from, row);
      while (to < kSide && sign(to, row) == s) ++to;
      out.rectangle({corner.x + kPixel * from, corner.y + kPixel * (kSide - 1 - row)},
                    {kPixel * (to - from), kPixel + 0.3}, {.fill = color(s)});
    }
  }
  out.text({corner.x, corner.y - 24}, title, Anchor::start, 13, ink::kText, true);
  out.text({corner.x, corner.y - 8}, subtitle);
}

}  // namespace

void draw_roots(const std::string& folder) {
  Drawing out(760, 330);
  draw_cubic(out, {{0, -3.6}, 400, {60, 46}, {400, 240}, 240 / 400.0 / 7.2},
             corners_of(-1, 3, -3.2, 1), "three changes of sign: split where the slope is 0", true);
  draw_cubic(out, {{0, -2.2}, 210, {510, 46}, {210, 90}, 90 / 210.0 / 4.4},
             corners_of(-1.4, -0.4, 1.6, 1.2), "one change: one root", false);
  draw_cubic(out, {{0, -2.2}, 210, {510, 196}, {210, 90}, 90 / 210.0 / 4.4},
             corners_of(0.8, 1.6, 0.5, 1.4), "none: no root, nothing solved", false);
  out.write(folder, "roots");
}

void draw_predicates(const std::string& folder) {
  // Three points of the plane x = y, and a fourth that walks over neighboring doubles there. The
  // step of doubles is 2^-53 just below 1.
  const Vec3 a{12, 12, 0}, b{24, 24, 0}, c{18, 18, 1};
  const auto place = [](int i, int j, double step) {
    return Vec3{0.5 + i * step, 0.5 + j * step, 0.25};
  };
  const auto determinant = [&](const Vec3& d) {
    return predicates::orient3d_determinant(b - a, c - a, d - a);
  };
  const auto sign_of = [](double x) { return (x > 0) - (x < 0); };
  constexpr double kStep = 0x1p-53, kWide = 0x1p-48;
  Drawing out(760, 304);
  draw_signs(out, {10, 52}, "doubles alone", "neighboring doubles, black is 0",
             [&](int i, int j) { return sign_of(determinant(place(i, j, kStep))); });
  draw_signs(out, {260, 52}, "orient3d", "the same places",
             [&](int i, int j) { return orient3d(a, b, c, place(i, j, kStep)); });
  draw_signs(out, {510, 52}, "the filter", "32 times as wide; gray: cannot tell",
             [&](int i, int j) {
               const Vec3 d = place(i - 30, j - 30, kWide);
               const double det = determinant(d);
               const double bound =
                   predicates::kOrient3dFilter * predicates::orient3d_scale(b - a, c - a, d - a);
               return std::fabs(det) > bound ? sign_of(det) : kUnknown;
             });
  out.write(folder, "predicates");
}

}  // namespace deliso::guide
