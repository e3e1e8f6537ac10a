// SPDX-License-Identifier: MIT
// The pictures of the lesson where its scripts do not run: the whole method on one slice.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/check.h"
#include "guide/drawing.h"
#include "guide/figures.h"
#include "guide/flat_mesh.h"
#include "guide/slice.h"
#include "io/files/append_format.h"
#include "lesson/field.h"

namespace deliso::guide {
namespace {

using Sites = std::vector<std::size_t>;

double sample(int i, int j) {
  return lesson::kSamples[static_cast<std::size_t>(j * lesson::kColumns + i)];
}
double excess(double x, double y) {
  return sample(static_cast<int>(x), static_cast<int>(y)) - lesson::kIsovalue;
}

template <class... Args>
std::string formatted(const char* format, Args... args) {
  std::string out;
  append_format(out, format, args...);
  return out;
}

// What all are of.
struct Scene {
  Slice slice{lesson::kColumns, lesson::kRows, excess};
  FlatContour contour{slice};

  Sites first_sites() const {
    Sites sites;
    for (const lesson::Place& p : lesson::kPlaces) {
      sites.push_back(contour.nearest_vertex({p.x, p.y}));
    }
    return sites;
  }
  // With all that the certificate asks for.
  Sites certified_sites() const {
    Sites sites = first_sites();
    for (auto found = contour.regions(sites); found.violation; found = contour.regions(sites)) {
      sites.push_back(found.violation->insert);
    }
    return sites;
  }
  // K, which is one loop there.
  std::vector<Vec2> dual_loop() const {
    std::vector<Vec2> loop;
    for (const auto& edge : contour.regions(certified_sites()).dual) {
      loop.push_back(contour.points()[edge[0]]);
    }
    return loop;
  }
};

// The voxels, and both sides of Sigma, in light colors.
void draw_ground(Drawing& out, const Panel& panel, const Slice& slice) {
  out.clip_to(panel);
  out.rectangle(panel.corner, panel.size, {.fill = ink::kBelow});
  out.region(panel.at(slice.loops()), {.fill = ink::kAbove});
}

void draw_grid(Drawing& out, const Panel& panel) {
  for (int i = 0; i < lesson::kColumns; ++i) {
    out.line(panel.at({double(i), 0}), panel.at({double(i), lesson::kRows - 1.0}),
             {.stroke = ink::kPaper, .width = 1});
  }
  for (int j = 0; j < lesson::kRows; ++j) {
    out.line(panel.at({0, double(j)}), panel.at({lesson::kColumns - 1.0, double(j)}),
             {.stroke = ink::kPaper, .width = 1});
  }
}

void draw_sigma(Drawing& out, const Panel& panel, const Slice& slice, const Style& style) {
  for (const auto& loop : slice.loops()) out.polygon(panel.at(loop), style);
}

void draw_contour_line(Drawing& out, const Panel& panel, const FlatContour& contour, double width) {
  for (const auto& loop : contour.loops()) {
    std::vector<Vec2> points;
    for (const std::size_t v : loop) points.push_back(panel.at(contour.points()[v]));
    out.polygon(points, {.stroke = ink::kSigma, .width = width});
  }
}

void draw_sample(Drawing& out, const Panel& panel, int i, int j, double radius, double size) {
  const double value = sample(i, j);
  const bool is_inside = value >= lesson::kIsovalue;
  const Vec2 at = panel.at({double(i), double(j)});
  out.circle(at, radius,
             {.stroke = is_inside ? ink::kOrange : ink::kBlue,
              .width = 1.2,
              .fill = is_inside ? ink::kAbove : ink::kPaper});
  out.text(at + Vec2{0, 0.36 * size}, formatted("%g", value), Anchor::middle, size);
}

// Lines of text, one below the other.
void draw_lines(Drawing& out, Vec2 at, std::initializer_list<std::string> lines,
                const char* color = ink::kText) {
  for (const std::string& line : lines) {
    out.text(at, line, Anchor::start, 13, color);
    at.y += 17;
  }
}

// The Voronoi edges: of two sites the points that are as far from one as from the other, and no
// nearer to a third.
void draw_voronoi(Drawing& out, const Panel& panel, const FlatContour& contour,
                  const Sites& sites) {
  std::vector<Vec2> points;
  for (const std::size_t s : sites) points.push_back(contour.points()[s]);
  for (std::size_t n = 0; n < points.size(); ++n) {
    for (std::size_t m = n + 1; m < points.size(); ++m) {
      const Vec2 middle = 0.5 * (points[n] + points[m]), d = points[m] - points[n];
      const Vec2 along{-d.y, d.x};
      double from = -99, to = 99;
      for (std::size_t k = 0; k < points.size(); ++k) {
        if (k == n || k == m) continue;
        // Nearer to sites[n] than to sites[k]: offset + t * slope >= 0.
        const Vec2 e = points[k] - points[n];
        const double offset = distance2(middle, points[k]) - distance2(middle, points[n]);
        const double slope = -2 * dot(along, e);
        if (slope > 0) from = std::max(from, -offset / slope);
        if (slope < 0) to = std::min(to, -offset / slope);
        if (slope == 0 && offset < 0) to = from;
      }
      if (from < to) {
        out.line(panel.at(middle + from * along), panel.at(middle + to * along),
                 {.stroke = ink::kGray, .width = 1, .dashed = true});
      }
    }
  }
}

// The edges and vertices of T in one color for each region: red for the first site's, of which the
// text speaks.
void draw_regions(Drawing& out, const Panel& panel, const FlatContour& contour,
                  const std::vector<std::size_t>& site_of, const Sites& sites) {
  constexpr std::array<const char*, 3> kColors = {ink::kBlue, ink::kOrange, "#6b7280"};
  const auto color = [&](std::size_t v) {
    const auto n = std::find(sites.begin(), sites.end(), site_of[v]) - sites.begin();
    return n == 0 ? ink::kRed : kColors[static_cast<std::size_t>(n) % 3];
  };
  draw_contour_line(out, panel, contour, 1);
  for (const auto& loop : contour.loops()) {
    for (std::size_t n = 0; n < loop.size(); ++n) {
      const std::size_t a = loop[n], b = loop[(n + 1) % loop.size()];
      if (site_of[a] == site_of[b]) {
        out.line(panel.at(contour.points()[a]), panel.at(contour.points()[b]),
                 {.stroke = color(a), .width = 5});
      }
    }
  }
  for (std::size_t v = 0; v < site_of.size(); ++v) {
    out.dot(panel.at(contour.points()[v]), color(v), 4.5);
  }
}

// Sites by letters that nothing else has; the one that the certificate asks for is v.
std::string letter(std::size_t n) {
  return n < lesson::kPlaces.size() ? std::string(1, "ABCDEFGHJL"[n]) : "v";
}
void draw_sites(Drawing& out, const Panel& panel, const Scene& scene, const Sites& sites) {
  for (std::size_t n = 0; n < sites.size(); ++n) {
    const Vec2 p = scene.contour.points()[sites[n]];
    const Vec3 g = scene.slice.surface().gradient(Slice::lifted(p));
    const double size = std::sqrt(g.x * g.x + g.y * g.y);
    out.circle(panel.at(p), 6.5, {.stroke = ink::kSigma, .width = 2, .fill = ink::kPaper});
    const bool is_v = n >= lesson::kPlaces.size();
    const Vec2 offset = is_v ? Vec2{3, 26} : Vec2{-17 * g.x / size, 17 * g.y / size + 5};
    out.text(panel.at(p) + offset, letter(n), Anchor::middle, 14, is_v ? ink::kRed : ink::kText,
             true);
  }
}

void draw_dual(Drawing& out, const Panel& panel, const FlatContour& contour,
               const FlatContour::Regions& regions) {
  for (const auto& edge : regions.dual) {
    out.line(panel.at(contour.points()[edge[0]]), panel.at(contour.points()[edge[1]]),
             {.stroke = ink::kBlue, .width = 2.5});
  }
}

// Two quick ways. Marching Cubes never joins the inside corners of a voxel where they alternate, so
// there it goes from each vertex of T to the one that T does not join it to. The mesh of a few
// points is K of the first sites.
void draw_need_picture(const Scene& scene, const std::string& folder) {
  Drawing out(700, 286);
  const Panel left{{-0.2, -0.2}, 26.6, {12, 32}, {331, 222}},
      right{{-0.2, -0.2}, 26.6, {357, 32}, {331, 222}};
  const int i = lesson::kSaddleColumn, j = lesson::kSaddleRow;
  draw_ground(out, left, scene.slice);
  std::vector<Vec2> at_neck;  // around the voxel, in order: left, lower, right, upper
  const auto is_in_voxel = [&](const Vec2& p) {
    return p.x >= i && p.x <= i + 1 && p.y >= j && p.y <= j + 1;
  };
  for (const auto& loop : scene.contour.loops()) {
    for (std::size_t n = 0; n < loop.size(); ++n) {
      const Vec2 p = scene.contour.points()[loop[n]],
                 q = scene.contour.points()[loop[(n + 1) % loop.size()]];
      if (is_in_voxel(p) && is_in_voxel(q)) {
        at_neck.push_back(p);
        at_neck.push_back(q);
      } else {
        out.line(left.at(p), left.at(q), {.stroke = ink::kSigma, .width = 1.8});
      }
    }
  }
  DELISO_CHECK(at_neck.size() == 4);
  out.line(left.at(at_neck[0]), left.at(at_neck[3]), {.stroke = ink::kRed, .width = 2.5});
  out.line(left.at(at_neck[2]), left.at(at_neck[1]), {.stroke = ink::kRed, .width = 2.5});
  for (const Vec2& p : scene.contour.points()) out.dot(left.at(p), ink::kSigma, 3);
  out.frame(left, "Marching Cubes: the neck is cut");

  const Sites sites = scene.first_sites();
  draw_ground(out, right, scene.slice);
  draw_dual(out, right, scene.contour, scene.contour.regions(sites));
  draw_sites(out, right, scene, sites);
  out.circle(right.at(scene.contour.points()[sites[0]]), 10, {.stroke = ink::kRed, .width = 2});
  out.frame(right, "ten points: four edges meet at A");
  out.write(folder, "six-need");
}

void draw_samples_picture(const std::string& folder) {
  Drawing out(700, 368);
  const Panel panel{{-0.5, -0.5}, 36, {12, 32}, {468, 324}};
  out.clip_to(panel);
  for (int i = 0; i < lesson::kColumns; ++i) {
    out.line(panel.at({double(i), 0}), panel.at({double(i), lesson::kRows - 1.0}),
             {.stroke = ink::kLight, .width = 1});
  }
  for (int j = 0; j < lesson::kRows; ++j) {
    out.line(panel.at({0, double(j)}), panel.at({lesson::kColumns - 1.0, double(j)}),
             {.stroke = ink::kLight, .width = 1});
  }
  const int i = lesson::kSaddleColumn, j = lesson::kSaddleRow;
  out.rectangle(panel.at({double(i), j + 1.0}), {panel.scale, panel.scale},
                {.stroke = ink::kRed, .width = 2.5, .fill = "#fbe0e0"});
  for (int y = 0; y < lesson::kRows; ++y) {
    for (int x = 0; x < lesson::kColumns; ++x) draw_sample(out, panel, x, y, 11, 11);
  }
  out.frame(panel, formatted("samples, and the isovalue \u03ba = %d", lesson::kIsovalue));
  const double left = 500;
  out.circle({left + 8, 70}, 11.5, {.stroke = ink::kOrange, .width = 1.2, .fill = ink::kAbove});
  draw_lines(out, {left + 28, 66}, {"a sample of at least \u03ba:", "inside"});
  out.circle({left + 8, 130}, 11.5, {.stroke = ink::kBlue, .width = 1.2, .fill = ink::kPaper});
  draw_lines(out, {left + 28, 126}, {"a sample below \u03ba:", "outside"});
  out.rectangle({left - 2, 180}, {21, 21}, {.stroke = ink::kRed, .width = 2.5, .fill = "#fbe0e0"});
  draw_lines(out, {left + 28, 186},
             {"a voxel: the square of", "four samples (in space", "the box of eight)"});
  draw_lines(out, {left - 3, 262},
             {"In this voxel the sides", "alternate. Picture 2", "shows it large."}, ink::kRed);
  out.write(folder, "six-samples");
}

void draw_contour_picture(const Scene& scene, const std::string& folder) {
  Drawing out(700, 316);
  const Panel whole{{-0.4, -0.4}, 31, {12, 32}, {397, 273}};
  const int i = lesson::kSaddleColumn, j = lesson::kSaddleRow;
  const Panel zoom{{i - 0.22, j - 0.27}, 178, {427, 32}, {261, 273}};
  draw_ground(out, whole, scene.slice);
  draw_grid(out, whole);
  draw_contour_line(out, whole, scene.contour, 1.8);
  for (const Vec2& p : scene.contour.points()) out.dot(whole.at(p), ink::kSigma, 3.4);
  out.rectangle(whole.at({double(i), j + 1.0}), {whole.scale, whole.scale},
                {.stroke = ink::kRed, .width = 2});
  out.text(whole.at({3.1, 3}), "inside", Anchor::middle);
  out.text(whole.at({8.9, 4.5}), "inside", Anchor::middle);
  out.text(whole.at({1.2, 6.6}), "outside", Anchor::middle);
  out.frame(whole, formatted("the exact contour T: %zu vertices, one loop",
                             scene.contour.points().size()));

  draw_ground(out, zoom, scene.slice);
  for (int k = 0; k < 2; ++k) {
    out.line(zoom.at({i + double(k), j - 1.0}), zoom.at({i + double(k), j + 2.0}),
             {.stroke = ink::kGray, .width = 0.8});
    out.line(zoom.at({i - 1.0, j + double(k)}), zoom.at({i + 2.0, j + double(k)}),
             {.stroke = ink::kGray, .width = 0.8});
  }
  draw_sigma(out, zoom, scene.slice, {.stroke = ink::kSigma, .width = 1.3, .dashed = true});
  draw_contour_line(out, zoom, scene.contour, 2.2);
  for (const Vec2& p : scene.contour.points()) out.dot(zoom.at(p), ink::kSigma, 5);
  for (int k = 0; k < 4; ++k) draw_sample(out, zoom, i + (k & 1), j + (k >> 1), 14, 13);
  const double f00 = excess(i, j), f10 = excess(i + 1, j), f01 = excess(i, j + 1),
               f11 = excess(i + 1, j + 1), bend = f00 - f10 - f01 + f11;
  const Vec2 saddle = zoom.at({i + (f00 - f01) / bend, j + (f00 - f10) / bend});
  out.line(saddle - Vec2{5, 5}, saddle + Vec2{5, 5}, {.stroke = ink::kRed, .width = 2});
  out.line(saddle - Vec2{5, -5}, saddle + Vec2{5, -5}, {.stroke = ink::kRed, .width = 2});
  out.text(saddle + Vec2{0, -24},
           formatted("saddle %.1f \u2265 %d", (f00 * f11 - f01 * f10) / bend + lesson::kIsovalue,
                     lesson::kIsovalue),
           Anchor::middle, 12, ink::kRed);
  out.text(saddle + Vec2{0, -10}, "inside: joined", Anchor::middle, 12, ink::kRed);
  const double t = f00 / (f00 - f10);
  out.text(zoom.corner + zoom.size - Vec2{8, 10},
           formatted("t = %g / %g = %.2f", f00, f00 - f10, t), Anchor::end, 13);
  out.text(zoom.at({i + 0.93, j + 0.16}), "T", Anchor::middle, 14, ink::kText, true);
  out.text(zoom.at({i + 0.645, j + 0.36}), "\u03a3", Anchor::middle, 14, ink::kText, true);
  out.frame(zoom, "the voxel in red, large");
  out.write(folder, "six-contour");
}

void draw_sites_picture(const Scene& scene, const std::string& folder) {
  Drawing out(700, 366);
  const Panel panel{{-0.4, -0.4}, 36.6, {12, 32}, {468, 322}};
  const Sites sites = scene.first_sites();
  const auto regions = scene.contour.regions(sites);
  draw_ground(out, panel, scene.slice);
  draw_voronoi(out, panel, scene.contour, sites);
  draw_regions(out, panel, scene.contour, regions.site_of, sites);
  draw_sites(out, panel, scene, sites);
  out.frame(panel, "sites, and the region of each");
  const double left = 498;
  out.circle({left + 8, 66}, 6.5, {.stroke = ink::kSigma, .width = 2, .fill = ink::kPaper});
  draw_lines(out, {left + 28, 70}, {"a site: a vertex of T", "that was chosen"});
  out.line({left, 116}, {left + 18, 116}, {.stroke = ink::kOrange, .width = 5});
  out.dot({left + 3, 116}, ink::kOrange, 4.5);
  out.dot({left + 15, 116}, ink::kOrange, 4.5);
  draw_lines(out, {left + 28, 114},
             {"a region: vertices of T", "with the same nearest", "site, in one color"});
  out.line({left - 2, 180}, {left + 20, 180}, {.stroke = ink::kGray, .width = 1.2, .dashed = true});
  draw_lines(out, {left + 28, 180}, {"as far from one site", "as from another", "(Voronoi edges)"});
  DELISO_CHECK(regions.violation.has_value());
  const auto bad = std::find(sites.begin(), sites.end(), regions.violation->site) - sites.begin();
  const std::string name = letter(static_cast<std::size_t>(bad));
  const Vec2 stray = panel.at(scene.contour.points()[regions.violation->insert]);
  const Vec2 at = panel.at({6.9, 1.3});
  out.arrow(at + Vec2{-4, -14}, stray + Vec2{5, 8}, {.stroke = ink::kRed, .width = 1.3});
  draw_lines(out, at,
             {"This vertex is nearest to " + name + " too,", "across the neck: the region",
              "of " + name + " is in two pieces."},
             ink::kRed);
  out.write(folder, "six-sites");
}

void draw_dual_picture(const Scene& scene, const std::string& folder) {
  Drawing out(700, 316);
  const Panel before{{1.85, 0.5}, 50, {12, 32}, {331, 272}},
      after{{1.85, 0.5}, 50, {357, 32}, {331, 272}};
  const Sites sites = scene.first_sites(), more = scene.certified_sites();
  const auto broken = scene.contour.regions(sites), whole = scene.contour.regions(more);
  DELISO_CHECK(broken.violation && !whole.violation);
  const auto draw = [&](const Panel& panel, const FlatContour::Regions& regions, const Sites& all) {
    draw_ground(out, panel, scene.slice);
    draw_voronoi(out, panel, scene.contour, all);
    draw_contour_line(out, panel, scene.contour, 1);
    for (const Vec2& p : scene.contour.points()) out.dot(panel.at(p), ink::kSigma, 3);
    draw_dual(out, panel, scene.contour, regions);
  };
  draw(before, broken, sites);
  draw_sites(out, before, scene, sites);
  const Vec2 v = before.at(scene.contour.points()[broken.violation->insert]);
  out.circle(v, 9, {.stroke = ink::kRed, .width = 2});
  out.text(v + Vec2{3, 26}, "v", Anchor::middle, 15, ink::kRed, true);
  const auto bad = std::find(sites.begin(), sites.end(), broken.violation->site) - sites.begin();
  out.frame(before, "K: " + letter(static_cast<std::size_t>(bad)) + " has four neighbors");
  draw(after, whole, more);
  draw_sites(out, after, scene, more);
  out.frame(after, "v is a site: K is one loop, as T is");
  out.write(folder, "six-dual");
}

// The edge of the mesh that picture 5 refines: its mid-point is nearest to this place.
constexpr Vec2 kEdgeOfPicture{10.2, 6.1};

void draw_insertion_picture(const Scene& scene, const std::string& folder) {
  Drawing out(700, 316);
  FlatMesh mesh(scene.slice, scene.dual_loop());
  std::size_t n = 0;
  for (std::size_t k = 1; k < mesh.loop().size(); ++k) {
    if (distance2(mesh.facet(k).center, kEdgeOfPicture) <
        distance2(mesh.facet(n).center, kEdgeOfPicture))
      n = k;
  }
  const FlatFacet f = mesh.facet(n);
  const Vec2 lo{f.center.x - 2.3, f.center.y - 2.4};
  const Panel before{lo, 57, {12, 32}, {331, 272}}, after{lo, 57, {357, 32}, {331, 272}};
  const auto draw = [&](const Panel& panel) {
    draw_ground(out, panel, scene.slice);
    draw_sigma(out, panel, scene.slice, {.stroke = ink::kSigma, .width = 1.5});
    out.polygon(panel.at(mesh.loop()), {.stroke = ink::kBlue, .width = 2.5});
    for (const Vec2& p : mesh.loop()) out.dot(panel.at(p), ink::kSigma, 4.5);
    out.text(panel.at(f.a) + Vec2{12, 6}, "a", Anchor::start, 15, ink::kText, true);
    out.text(panel.at(f.b) + Vec2{-4, -10}, "b", Anchor::middle, 15, ink::kText, true);
  };
  draw(before);
  const Vec2 along = f.x - f.center;
  out.line(before.at(f.center - 4.0 * along), before.at(f.x + 4.0 * along),
           {.stroke = ink::kRed, .width = 1, .dashed = true});
  out.circle(before.at(f.x), before.scale * f.radius,
             {.stroke = ink::kOrange, .width = 1.6, .dashed = true});
  out.line(before.at(f.center), before.at(f.x), {.stroke = ink::kRed, .width = 2.5});
  out.dot(before.at(f.center), ink::kText, 5);
  out.text(before.at(f.center) + Vec2{-10, 8}, "c", Anchor::end, 15, ink::kText, true);
  out.dot(before.at(f.x), ink::kRed, 5.5);
  out.text(before.at(f.x) + Vec2{14, 4}, "x", Anchor::start, 15, ink::kRed, true);
  out.text(before.at(0.5 * (f.center + f.x)) + Vec2{6, 16}, formatted("h = %.2f", f.h),
           Anchor::start, 13, ink::kRed);
  out.text(before.at(f.center - 2.3 * along) + Vec2{6, 14}, "\u2113", Anchor::start, 15, ink::kRed,
           true);
  out.text(before.at(f.x + f.radius * Vec2{0.1, -0.995}) + Vec2{0, 17}, "surface ball B",
           Anchor::start, 13, "#a85c10");
  out.text(before.at({f.b.x + 1, f.b.y}) + Vec2{0, -12}, "\u03a3", Anchor::middle, 15, ink::kText,
           true);
  out.frame(before, "the edge ab is too far from \u03a3");
  const Vec2 x = f.x;
  mesh.insert(n);
  draw(after);
  out.line(after.at(f.a), after.at(f.b), {.stroke = ink::kBlue, .width = 1.4, .dashed = true});
  out.text(after.at(f.center) + Vec2{-8, 14}, "ab: removed", Anchor::end, 13, ink::kBlue);
  out.dot(after.at(x), ink::kRed, 5.5);
  out.text(after.at(x) + Vec2{12, -4}, "x", Anchor::start, 15, ink::kRed, true);
  out.frame(after, "x is a vertex: ax and xb replace ab");
  out.write(folder, "six-insertion");
}

void draw_mesh_picture(const Scene& scene, const std::string& folder) {
  Drawing out(700, 366);
  const Panel panel{{-0.4, -0.4}, 36.6, {12, 32}, {468, 322}};
  FlatMesh mesh(scene.slice, scene.dual_loop());
  const std::size_t before = mesh.loop().size();
  constexpr double kDistance = 0.1;
  while (mesh.facet(mesh.worst()).h > kDistance) mesh.insert(mesh.worst());
  const FlatFacet worst = mesh.facet(mesh.worst());
  draw_ground(out, panel, scene.slice);
  draw_grid(out, panel);
  out.polygon(panel.at(mesh.loop()), {.stroke = ink::kBlue, .width = 2.5});
  for (std::size_t n = 0; n < mesh.loop().size(); ++n)
    out.dot(panel.at(mesh.loop()[n]), ink::kSigma, 4);
  const auto is_site = [&](const Vec2& p) {
    const std::vector<Vec2> sites = scene.dual_loop();
    return std::find(sites.begin(), sites.end(), p) != sites.end();
  };
  for (const Vec2& p : mesh.loop()) {
    if (is_site(p))
      out.circle(panel.at(p), 6, {.stroke = ink::kSigma, .width = 2, .fill = ink::kPaper});
  }
  out.frame(panel, "the finished mesh");
  const double left = 498;
  out.circle({left + 8, 66}, 6, {.stroke = ink::kSigma, .width = 2, .fill = ink::kPaper});
  draw_lines(out, {left + 28, 70}, {formatted("%zu sites of Stage 1", before)});
  out.dot({left + 8, 96}, ink::kSigma, 4);
  draw_lines(out, {left + 28, 100},
             {formatted("%zu surface points", mesh.loop().size() - before), "of Stage 2"});
  out.line({left, 142}, {left + 18, 142}, {.stroke = ink::kBlue, .width = 2.5});
  draw_lines(out, {left + 28, 146}, {formatted("%zu edges", mesh.loop().size())});
  draw_lines(
      out, {left - 2, 190},
      {"Limit: D = 0.1 voxel.", formatted("Largest h: %.2f voxel", worst.h), "(at the arrow)."});
  out.arrow({left - 6, 216}, panel.at(worst.x) + Vec2{9, -2}, {.stroke = ink::kRed, .width = 1.3});
  draw_lines(out, {left - 2, 268}, {"Dense where \u03a3 bends,", "sparse where it is flat."});
  out.write(folder, "six-mesh");
}

}  // namespace

void draw_six_pictures(const std::string& folder) {
  const Scene scene;
  draw_need_picture(scene, folder);
  draw_samples_picture(folder);
  draw_contour_picture(scene, folder);
  draw_sites_picture(scene, folder);
  draw_dual_picture(scene, folder);
  draw_insertion_picture(scene, folder);
  draw_mesh_picture(scene, folder);
}

}  // namespace deliso::guide
