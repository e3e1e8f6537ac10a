// SPDX-License-Identifier: MIT
// Pictures in the plane, where what the text says of space can be seen: cells are triangles,
// spheres circles, Voronoi edges still edges. The triangulation is that of src/planar.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/random.h"
#include "guide/drawing.h"
#include "guide/figures.h"
#include "guide/slice.h"
#include "more/planar/constrained_triangulation.h"
#include "more/planar/plane_predicates.h"

namespace deliso::guide {
namespace {

using Plane = ConstrainedTriangulation;

Vec2 circumcenter_of(const Plane& t, FaceId f) {
  const auto& v = t.triangle(f).v;
  const Vec2 a = t.point(v[0]), b = t.point(v[1]) - a, c = t.point(v[2]) - a;
  const double d = 2 * (b.x * c.y - b.y * c.x), bb = dot(b, b), cc = dot(c, c);
  return a + Vec2{(c.y * bb - b.y * cc) / d, (b.x * cc - c.x * bb) / d};
}

std::vector<Vec2> corners_of(const Plane& t, FaceId f) {
  const auto& v = t.triangle(f).v;
  return {t.point(v[0]), t.point(v[1]), t.point(v[2])};
}

void draw_edges(Drawing& out, const Panel& panel, const Plane& t, const Style& style) {
  for (FaceId f = 0; f < t.triangles().size(); ++f) {
    out.polygon(panel.at(corners_of(t, f)), style);
  }
}

void draw_points(Drawing& out, const Panel& panel, const Plane& t, double radius = 3.5) {
  for (VertexId v = 4; v < t.points().size(); ++v) {
    out.dot(panel.at(t.point(v)), ink::kSigma, radius);
  }
}

// Calls edge(f, i, from, to) once for each Voronoi edge, dual to the edge of f opposite corner i.
template <class Edge>
void for_each_voronoi_edge(const Plane& t, Edge&& edge) {
  for (FaceId f = 0; f < t.triangles().size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const FaceId g = t.triangle(f).n[static_cast<std::size_t>(i)];
      if (g == kNoId || g < f) continue;
      edge(f, i, circumcenter_of(t, f), circumcenter_of(t, g));
    }
  }
}

// The ends of the edge of f opposite corner i.
std::array<Vec2, 2> ends_of(const Plane& t, FaceId f, int i) {
  const auto& v = t.triangle(f).v;
  return {t.point(v[static_cast<std::size_t>((i + 1) % 3)]),
          t.point(v[static_cast<std::size_t>((i + 2) % 3)])};
}

// Sites on an outline, the Voronoi diagram, and the Delaunay edges whose Voronoi edges meet it.
void draw_restricted(Drawing& out, const Panel& panel, const Slice& slice, const Plane& sites,
                     const char* title) {
  out.clip_to(panel);
  out.rectangle(panel.corner, panel.size, {.fill = ink::kBelow});
  out.region(panel.at(slice.loops()), {.stroke = ink::kSigma, .width = 1.5, .fill = ink::kAbove});
  std::vector<Vec2> marked;
  for_each_voronoi_edge(sites, [&](FaceId f, int i, const Vec2& from, const Vec2& to) {
    const auto hits = slice.hits(from, to);
    out.line(
        panel.at(from), panel.at(to),
        {.stroke = hits.size() > 1 ? ink::kRed : ink::kGray, .width = hits.size() > 1 ? 2.5 : 1});
    if (hits.empty()) return;
    const auto ends = ends_of(sites, f, i);
    out.line(panel.at(ends[0]), panel.at(ends[1]), {.stroke = ink::kBlue, .width = 3});
    if (hits.size() > 1) marked.insert(marked.end(), hits.begin(), hits.end());
  });
  for (const Vec2& p : marked) out.dot(panel.at(p), ink::kRed, 5);
  draw_points(out, panel, sites, 4);
  out.frame(panel, title);
}

}  // namespace

void draw_delaunay(const std::string& folder) {
  Plane t({0, 0}, {10, 10});
  Random random(31);
  while (t.points().size() < 30) {
    const Vec2 p{random.uniform(0.4, 9.6), random.uniform(0.4, 9.6)};
    const bool is_apart = std::all_of(t.points().begin(), t.points().end(),
                                      [&](const Vec2& q) { return distance2(p, q) > 1.2; });
    if (is_apart) t.insert(p);
  }
  const Vec2 p{5.6, 4.5};
  Drawing out(760, 290);
  const Panel first{{0, 0}, 23, {16, 40}, {230, 230}}, second{{0, 0}, 23, {265, 40}, {230, 230}},
      third{{0, 0}, 23, {514, 40}, {230, 230}};

  // In conflict: the triangles whose circles hold p.
  out.clip_to(first);
  std::vector<FaceId> zone;
  for (FaceId f = 0; f < t.triangles().size(); ++f) {
    const auto c = corners_of(t, f);
    if (incircle(c[0], c[1], c[2], p) > 0) zone.push_back(f);
  }
  for (const FaceId f : zone) {
    out.polygon(first.at(corners_of(t, f)), {.fill = ink::kAbove});
  }
  draw_edges(out, first, t, {.stroke = ink::kBlue, .width = 1});
  for (const FaceId f : zone) {
    const Vec2 c = circumcenter_of(t, f);
    const double r = std::sqrt(distance2(c, corners_of(t, f)[0]));
    out.circle(first.at(c), first.scale * r, {.stroke = ink::kOrange, .width = 1, .dashed = true});
  }
  draw_points(out, first, t);
  const auto mark = [&](const Panel& panel, const Vec2& at, const Vec2& offset, const char* name) {
    out.text(panel.at(at) + offset, name, Anchor::middle, 15, ink::kRed, true);
  };
  out.dot(first.at(p), ink::kRed, 5);
  mark(first, p, {13, 5}, "p");
  out.frame(first, "circles that hold p");

  const VertexId v = t.insert(p);
  out.clip_to(second);
  t.circulate(v, [&](FaceId f, int) {
    out.polygon(second.at(corners_of(t, f)), {.fill = ink::kAbove});
    return true;
  });
  draw_edges(out, second, t, {.stroke = ink::kBlue, .width = 1});
  draw_points(out, second, t);
  out.dot(second.at(p), ink::kRed, 5);
  mark(second, p, {-13, 3}, "p");
  out.frame(second, "the star of p");

  // The dual: of one edge at p, its line, and its ends at two circumcenters.
  out.clip_to(third);
  draw_edges(out, third, t, {.stroke = ink::kLight, .width = 1});
  for_each_voronoi_edge(t, [&](FaceId, int, const Vec2& from, const Vec2& to) {
    out.line(third.at(from), third.at(to), {.stroke = ink::kGray, .width = 1.2});
  });
  bool shown = false;
  t.circulate(v, [&](FaceId f, int i) {
    const int side = (i + 1) % 3;
    const FaceId g = t.triangle(f).n[static_cast<std::size_t>(side)];
    if (shown || g == kNoId) return !shown;
    const Vec2 from = circumcenter_of(t, f), to = circumcenter_of(t, g);
    if (distance2(from, to) < 1) return true;
    shown = true;
    const auto ends = ends_of(t, f, side);
    out.line(third.at(ends[0]), third.at(ends[1]), {.stroke = ink::kBlue, .width = 3});
    const Vec2 d = to - from;
    out.line(third.at(from - 5.0 * d), third.at(to + 5.0 * d),
             {.stroke = ink::kRed, .width = 1, .dashed = true});
    out.line(third.at(from), third.at(to), {.stroke = ink::kRed, .width = 3});
    const Vec2 q = distance2(ends[0], p) > distance2(ends[1], p) ? ends[0] : ends[1];
    mark(third, q, {-10, -8}, "q");
    for (const FaceId c : {f, g}) {
      const Vec2 center = circumcenter_of(t, c);
      out.dot(third.at(center), ink::kRed, 4.5);
      out.circle(third.at(center), third.scale * std::sqrt(distance2(center, ends[0])),
                 {.stroke = ink::kOrange, .width = 1, .dashed = true});
    }
    return false;
  });
  draw_points(out, third, t);
  mark(third, p, {10, 14}, "p");
  out.text(third.at({1.3, 1.3}), "dual line", Anchor::start, 13, ink::kRed);
  out.frame(third, "the dual of the edge pq");
  out.write(folder, "delaunay");
}

void draw_recover_paper(const std::string& folder) {
  // A body with a bay that Voronoi edges run through, and a speck.
  const Slice slice(45, 33, [](double x, double y) {
    const double u = (x - 23) / 17, v = (y - 16) / 12.5;
    const double body = 13 * (1 - std::sqrt(u * u + v * v));
    const double along = std::max(0.0, 19 - x), across = y - 18.6 - 0.12 * (x - 19);
    const double bay = std::sqrt(along * along + across * across) - 1.9;
    const double speck = 1.5 - std::sqrt((x - 5.5) * (x - 5.5) + (y - 28) * (y - 28));
    return std::max(std::min(body, bay), speck) + 0.013;
  });
  Plane sites({-400, -400}, {444, 433});
  // As random rays find them: on the outside, at these angles.
  for (const double degrees : {58, 97, 150, 196, 247, 292, 338}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vec2 middle{23, 16}, way{30 * std::cos(angle), 30 * std::sin(angle)};
    sites.insert(slice.hits(middle + way, middle)[0]);
  }
  Drawing out(760, 312);
  const Panel before{{0, 0}, 8.0, {16, 40}, {352, 256}}, after{{0, 0}, 8.0, {392, 40}, {352, 256}};
  draw_restricted(out, before, slice, sites, "red: Voronoi edges that meet \u03a3 more than once");
  // MultiIntersect: the furthest hit of an edge that has several, until none has.
  for (bool any = true; any;) {
    any = false;
    Vec2 furthest;
    double most = 0;
    for_each_voronoi_edge(sites, [&](FaceId f, int i, const Vec2& from, const Vec2& to) {
      const auto hits = slice.hits(from, to);
      if (hits.size() < 2 || any) return;
      for (const Vec2& p : hits) {
        const double d = distance2(p, ends_of(sites, f, i)[0]);
        if (d > most) {
          most = d;
          furthest = p;
        }
      }
      any = true;
    });
    if (any) sites.insert(furthest);
  }
  draw_restricted(out, after, slice, sites, "after MultiIntersect: none does");
  out.text(after.at({7.5, 29.5}), "no edge meets it: lost", Anchor::start, 13, ink::kRed);
  out.write(folder, "recover-paper");
}

}  // namespace deliso::guide
