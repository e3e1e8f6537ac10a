// SPDX-License-Identifier: MIT
// Pictures of Stage 2, of the boundary, and of what a check looks at.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/check.h"
#include "base/triangle.h"
#include "coarsen/contour_as_mesh.h"
#include "deliso/mesh_isosurface.h"
#include "guide/drawing.h"
#include "guide/figures.h"
#include "guide/handed.h"
#include "guide/slice.h"
#include "io/files/append_format.h"
#include "io/volume/builtin_volume.h"
#include "refine/operations.h"
#include "refine/refine.h"
#include "run/options.h"

namespace deliso::guide {
namespace {

// Looking at a facet along its normal.
struct Plan {
  Vec3 origin, right, up, normal;
  Panel panel;

  Vec2 at(const Vec3& p) const {
    const Vec3 d = p - origin;
    return panel.at({dot(d, right), dot(d, up)});
  }
};

void draw_facets(Drawing& out, const Plan& plan, const SurfaceMesh& s,
                 const std::vector<FaceId>& shaded, const char* fill) {
  const auto corners = [&](FaceId f) {
    const Triangle& v = s.mesh.faces[f].v;
    return std::array{plan.at(s.mesh.points[v[0]]), plan.at(s.mesh.points[v[1]]),
                      plan.at(s.mesh.points[v[2]])};
  };
  for (FaceId f = 0; f < s.mesh.faces.size(); ++f) {
    if (is_dead(s.mesh.faces[f])) continue;
    const Triangle& v = s.mesh.faces[f].v;
    const Vec3 normal = area_normal(s.mesh.points[v[0]], s.mesh.points[v[1]], s.mesh.points[v[2]]);
    // Those that are turned away are behind.
    if (!(dot(normal, plan.normal) > 0) || dot(s.mesh.points[v[0]] - plan.origin, plan.normal) < -6)
      continue;
    const bool is_shaded = std::find(shaded.begin(), shaded.end(), f) != shaded.end();
    out.polygon(corners(f),
                {.stroke = ink::kBlue, .width = 1.1, .fill = is_shaded ? fill : ink::kPaper});
  }
}

}  // namespace

void draw_insert(const std::string& folder) {
  Handed h("builtin:sphere:32", 0, {});
  SurfaceMesh& s = h.coarsened.mesh;
  // A facet whose point encroaches upon many.
  FaceId start = 0;
  std::size_t most = 0;
  std::vector<FaceId> disk;
  for (FaceId f = 0; f < s.mesh.faces.size(); ++f) {
    facets_encroached(s, f, s.duals[f].center, disk);
    if (s.duals[f].on_surface && disk.size() > most && disk.size() <= 7) {
      most = disk.size();
      start = f;
    }
  }
  const Triangle corners = s.mesh.faces[start].v;
  const Vec3 a = s.mesh.points[corners[0]], b = s.mesh.points[corners[1]],
             c = s.mesh.points[corners[2]];
  const Vec3 normal = area_normal(a, b, c), unit = normal / length(normal);
  const Vec3 right = (b - a) / length(b - a);
  Plan plan{circumcenter(a, b, c), right, cross(unit, right), unit, {}};
  const Dual ball = s.duals[start];
  facets_encroached(s, start, s.duals[start].center, disk);
  Drawing out(760, 290);
  const double reach = 2.6 * std::sqrt(ball.radius2);
  const auto panel = [&](double x) {
    return Panel{{-reach, -reach}, 115 / reach, {x, 40}, {230, 230}};
  };
  const Vec3 p = ball.center;

  plan.panel = panel(16);
  out.clip_to(plan.panel);
  draw_facets(out, plan, s, {start}, ink::kAbove);
  out.circle(plan.at(p), plan.panel.scale * std::sqrt(ball.radius2),
             {.stroke = ink::kOrange, .width = 1.3, .dashed = true});
  const auto mark_p = [&] {
    out.dot(plan.at(p), ink::kRed, 5);
    out.text(plan.at(p) + Vec2{13, 5}, "p", Anchor::middle, 15, ink::kRed, true);
  };
  mark_p();
  out.frame(plan.panel, "a facet, its ball, p");

  plan.panel = panel(265);
  out.clip_to(plan.panel);
  draw_facets(out, plan, s, disk, ink::kAbove);
  for (const FaceId f : disk) {
    out.circle(plan.at(s.duals[f].center), plan.panel.scale * std::sqrt(s.duals[f].radius2),
               {.stroke = ink::kOrange, .width = 1, .dashed = true, .opacity = 0.8});
  }
  mark_p();
  out.frame(plan.panel, "E: whose balls hold p");

  Refinement r(s, h.given());
  DELISO_CHECK(!insert_point(r, Operation::surface_point, start, p));
  plan.panel = panel(514);
  out.clip_to(plan.panel);
  draw_facets(out, plan, s, {r.created().begin(), r.created().end()}, ink::kAbove);
  mark_p();
  out.frame(plan.panel, "D: the cone over E's boundary");
  out.write(folder, "insert");
}

void draw_operations(const std::string& folder) {
  const Volume volume = make_builtin_volume("builtin:noise");
  Report report;
  Options options;
  options.threads = 1;
  mesh_isosurface(volume, find_builtin_field("builtin:noise")->isovalue, options, report);
  constexpr Operation kShown[] = {Operation::collapse,  Operation::surface_point,
                                  Operation::foot,      Operation::boundary_split,
                                  Operation::flip,      Operation::removal,
                                  Operation::far_point, Operation::move};
  constexpr std::array<const char*, kRefusals> kColors = {
      "#0072b2", "#004b75", "#e69f00", "#cc79a7", "#8c8c00", "#56b4e9",
      "#999999", "#6a3d9a", "#c62828", "#cfd3d9", "#009e73", "#d55e00"};
  static_assert(kColors.back() != nullptr);
  Drawing out(760, 356);
  constexpr double kLeft = 128, kWidth = 470, kTop = 44, kRow = 31;
  out.text({kLeft, 26}, "builtin:noise: what was tried, by operation, as shares", Anchor::start, 13,
           ink::kText, true);
  for (std::size_t row = 0; row < std::size(kShown); ++row) {
    const OperationCounts& n = report[kShown[row]];
    std::uint64_t all = n.done;
    for (const std::uint64_t refused : n.refused) all += refused;
    const double y = kTop + kRow * static_cast<double>(row);
    double x = kLeft;
    const auto bar = [&](std::uint64_t count, const char* color) {
      const double width =
          all == 0 ? 0 : kWidth * static_cast<double>(count) / static_cast<double>(all);
      if (width > 0.2) out.rectangle({x, y}, {width, kRow - 9}, {.fill = color});
      x += width;
    };
    bar(n.done, ink::kGreen);
    for (std::size_t r = 0; r < kRefusals; ++r) bar(n.refused[r], kColors[r]);
    out.text({kLeft - 8, y + 16}, name_of(kShown[row]), Anchor::end);
    std::string counts;
    append_format(counts, "%llu of %llu", static_cast<unsigned long long>(n.done),
                  static_cast<unsigned long long>(all));
    out.text({kLeft + kWidth + 8, y + 16}, counts);
  }
  double x = 16;
  double y = kTop + kRow * static_cast<double>(std::size(kShown)) + 18;
  const auto key = [&](std::string_view name, const char* color) {
    if (x > 640) {
      x = 16;
      y += 22;
    }
    out.rectangle({x, y - 10}, {12, 12}, {.fill = color});
    out.text({x + 17, y}, name);
    x += 42 + 7.4 * static_cast<double>(name.size());
  };
  key("done", ink::kGreen);
  for (std::size_t r = 0; r < kRefusals; ++r) key(name_of(static_cast<Refusal>(r)), kColors[r]);
  out.write(folder, "operations");
}

void draw_boundary(const std::string& folder) {
  Handed h("builtin:gyroid:32", 0, {});
  const double end = h.volume.box().hi.x;
  Drawing out(760, 292);
  const double scale = 230 / end;
  const auto panel_at = [&](double x) { return Panel{{0, 0}, scale, {x, 46}, {230, 230}}; };
  const Panel contour = panel_at(16), handed = panel_at(265), refined = panel_at(514);
  const auto background = [&](const Panel& panel) {
    // Samples of g on the face z = 0, a quarter of a voxel apart.
    constexpr int kParts = 4;
    const int cells = kParts * h.volume.voxels().i;
    out.clip_to(panel);
    out.rectangle(panel.corner, panel.size, {.fill = ink::kBelow});
    for (int j = 0; j < cells; ++j) {
      const auto is_inside = [&](int i) {
        return h.volume.value({(i + 0.5) / kParts, (j + 0.5) / kParts, 0}) >= h.kappa;
      };
      for (int from = 0, to = 0; from < cells; from = to) {
        while (to < cells && is_inside(to) == is_inside(from)) ++to;
        if (!is_inside(from)) continue;
        const Vec2 corner = panel.at({double(from) / kParts, double(j + 1) / kParts});
        out.rectangle(corner, {scale * (to - from) / kParts, scale / kParts + 0.3},
                      {.fill = ink::kAbove});
      }
    }
  };
  const auto draw_chain = [&](const Panel& panel, const SurfaceMesh& s, bool with_balls) {
    const BoundaryChain& chain = s.chain;
    const auto& points = s.mesh.points;
    for (VertexId v = 0; v < chain.vertex_capacity(); ++v) {
      if (!chain.is_boundary(v)) continue;
      const Vec3 &a = points[v], &b = points[chain.next(v)];
      if (a.z != 0 || b.z != 0) continue;
      const Vec2 pa = panel.at({a.x, a.y}), pb = panel.at({b.x, b.y});
      if (with_balls) {
        out.circle(0.5 * (pa + pb), 0.5 * std::sqrt(distance2(pa, pb)),
                   {.stroke = ink::kOrange, .width = 1, .dashed = true});
      }
      out.line(pa, pb, {.stroke = ink::kBlue, .width = 2});
      out.dot(pa, ink::kSigma, 2.8);
      out.dot(pb, ink::kSigma, 2.8);
    }
  };
  background(contour);
  draw_chain(contour, contour_as_mesh(h.contour), false);
  out.frame(contour, "T: all its vertices");
  background(handed);
  draw_chain(handed, h.coarsened.mesh, true);
  out.frame(handed, "coarsened, each with its ball");
  background(refined);
  refine(h.coarsened.mesh, h.coarsened.samples, h.given());
  draw_chain(refined, h.coarsened.mesh, false);
  out.frame(refined, "at the end");
  out.write(folder, "boundary");
}

void draw_checking(const std::string& folder) {
  // A body with a finger, and a mesh of the body alone.
  const Slice slice(65, 41, [](double x, double y) {
    const double u = (x - 22) / 17, v = (y - 17) / 13;
    const double body = 13 * (1 - std::sqrt(u * u + v * v));
    const double along = std::clamp((x - 30) / 26, 0.0, 1.0);
    const double fx = x - (30 + 26 * along), fy = y - (21 + 11 * along);
    return std::max(body, 1.3 - std::sqrt(fx * fx + fy * fy)) + 0.0013;
  });
  Drawing out(760, 290);
  const Panel left{{0, 0}, 5.5, {16, 40}, {352, 230}}, right{{0, 0}, 5.5, {392, 40}, {352, 230}};
  std::vector<Vec2> mesh;
  for (int n = 0; n < 11; ++n) {
    // The root of the finger is left out.
    const double angle = 0.78 + n * 0.572;
    const Vec2 way{60 * std::cos(angle), 60 * std::sin(angle)}, middle{22, 17};
    const std::vector<Vec2> hits = slice.hits(middle, middle + way);
    mesh.push_back(hits[0]);
  }
  const auto nearest_on = [](const std::vector<Vec2>& closed, const Vec2& p) {
    Vec2 best = closed[0];
    for (std::size_t n = 0; n < closed.size(); ++n) {
      const Vec2 a = closed[n], d = closed[(n + 1) % closed.size()] - a;
      const double t = std::clamp(dot(p - a, d) / std::max(dot(d, d), 1e-30), 0.0, 1.0);
      const Vec2 q = a + t * d;
      if (distance2(q, p) < distance2(best, p)) best = q;
    }
    return best;
  };
  const std::vector<Vec2>& outline =
      *std::max_element(slice.loops().begin(), slice.loops().end(),
                        [](const auto& a, const auto& b) { return a.size() < b.size(); });
  const auto begin = [&](const Panel& panel) {
    out.clip_to(panel);
    out.rectangle(panel.corner, panel.size, {.fill = ink::kBelow});
    const std::vector<std::vector<Vec2>> loops{panel.at(outline)};
    out.region(loops, {.stroke = ink::kSigma, .width = 1.5, .fill = ink::kAbove});
    out.polygon(panel.at(mesh), {.stroke = ink::kBlue, .width = 2.5});
  };
  const auto title = [](const char* words, double worst) {
    std::string text;
    append_format(text, "%s %.1f voxels at most", words, worst);
    return text;
  };
  begin(left);
  double worst = 0;
  for (std::size_t n = 0; n < mesh.size(); ++n) {
    const Vec2 a = mesh[n], b = mesh[(n + 1) % mesh.size()];
    for (const double t : {0.25, 0.5, 0.75}) {
      const Vec2 p = (1 - t) * a + t * b, q = nearest_on(outline, p);
      out.line(left.at(p), left.at(q), {.stroke = ink::kRed, .width = 1.5});
      out.dot(left.at(p), ink::kRed, 2.5);
      worst = std::max(worst, std::sqrt(distance2(p, q)));
    }
  }
  for (const Vec2& p : mesh) out.dot(left.at(p), ink::kSigma, 3.5);
  out.frame(left, title("mesh to surface:", worst));
  begin(right);
  worst = 0;
  for (std::size_t n = 0; n < outline.size(); n += 42) {
    const Vec2 p = outline[n], q = nearest_on(mesh, p);
    out.line(right.at(p), right.at(q), {.stroke = ink::kRed, .width = 1.5});
    out.dot(right.at(p), ink::kRed, 2.5);
    worst = std::max(worst, std::sqrt(distance2(p, q)));
  }
  for (const Vec2& p : mesh) out.dot(right.at(p), ink::kSigma, 3.5);
  out.frame(right, title("surface to mesh:", worst));
  out.write(folder, "checking");
}

}  // namespace deliso::guide
