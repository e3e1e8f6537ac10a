// SPDX-License-Identifier: MIT
// Changes that gates refuse, found in Stage 2 of noise and cut by a plane.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/triangle.h"
#include "embedding/triangle_pair.h"
#include "guide/drawing.h"
#include "guide/figures.h"
#include "guide/handed.h"
#include "refine/refinement.h"

namespace deliso::guide {
namespace {

// A plane through a point, upright on Sigma there.
struct Cut {
  Vec3 origin, along, up;

  Vec3 normal() const { return cross(along, up); }
  Vec2 at(const Vec3& p) const { return {dot(p - origin, along), dot(p - origin, up)}; }
  // Where it cuts a triangle.
  std::optional<std::array<Vec2, 2>> of(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const std::array<Vec3, 3> p = {a, b, c};
    std::array<Vec2, 2> ends;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &from = p[i], &to = p[(i + 1) % 3];
      const double h0 = dot(from - origin, normal()), h1 = dot(to - origin, normal());
      if ((h0 >= 0) == (h1 >= 0) || count == 2) continue;
      ends[count++] = at(from + h0 / (h0 - h1) * (to - from));
    }
    return count == 2 ? std::optional(ends) : std::nullopt;
  }
};
using Piece = std::array<Vec2, 2>;

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
bool cross_well(const Piece& p, const Piece& q) {
  return turn(p[0], p[1], q[0]) * turn(p[0], p[1], q[1]) < -1e-3 &&
         turn(q[0], q[1], p[0]) * turn(q[0], q[1], p[1]) < -1e-3;
}

struct Found {
  Cut cut{};
  std::vector<Piece> old, kept, fresh;
  std::optional<Vec2> c;  // of the facet without a surface point; its dual line is upright
};

// Of p from the corners around it, in voxels; and planes that are tried.
constexpr double kApart = 0.4;
// Of a picture around p: this far to each side.
constexpr double kReach = 2;
constexpr int kDirections = 8;

class Search {
 public:
  explicit Search(Handed& handed)
      : h_(handed),
        mesh_(handed.recovered.mesh.mesh),
        refinement_(handed.recovered.mesh, handed.surface, handed.recovered.curves,
                    handed.parameters, handed.report) {}

  // Of all points of T put in wherever a ball holds them, the one that is refused so and is seen
  // best in a plane.
  Found find(Refusal wanted) {
    Found best;
    double most = 0;
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
      const Dual& ball = h_.recovered.mesh.duals[f];
      if (!ball.on_surface) continue;
      for (const Vec3& p : h_.recovered.samples) {
        if (ball.holds(p)) consider(f, p, wanted, best, most);
      }
    }
    return best;
  }

 private:
  void consider(FaceId f, const Vec3& p, Refusal wanted, Found& best, double& most) {
    Proposal* proposal = refinement_.propose(refinement_.encroached(f, p),
                                             wanted == Refusal::turned ? kSharpestFold : kAnyFold);
    if (!proposal || proposal->was.inner_vertices() > 0) return;
    Proposal& change = *proposal;
    const auto is_there = [&p](const Vec3& q) { return distance2(p, q) < 1e-6; };
    if (std::any_of(mesh_.points.begin(), mesh_.points.end(), is_there)) return;
    for (const Disk::BoundaryEdge& edge : change.was.boundary) {
      if (distance2(mesh_.points[edge.from], p) < kApart * kApart) return;
    }
    change.cone(p);
    if (wanted == Refusal::no_surface_point) {
      if (refuse(change) != wanted) return;
      Found found = look_at_dual(change, p);
      const double here = clarity(found, wanted);
      if (here <= most) return;
      most = here;
      best = std::move(found);
      return;
    }
    Found clearest;
    double score = most;
    for (int n = 0; n < kDirections; ++n) {
      Found found = look(change, p, n * std::numbers::pi / kDirections);
      const double here = clarity(found, wanted);
      if (here <= score) continue;
      score = here;
      clearest = std::move(found);
    }
    if (score <= most) return;
    const auto refusal = refuse(change);
    const bool is_wanted = wanted == Refusal::crossing
                               ? refusal == Refusal::no_gain && crosses(change, p)
                               : refusal == wanted;
    if (!is_wanted) return;
    most = score;
    best = std::move(clearest);
  }

  // Does nothing: a change that passes the tests before G4 is refused as G4 would.
  std::optional<Refusal> refuse(Proposal& change) {
    return refinement_.replace([&] { return !change.has_duals(); });
  }

  bool crosses(const Proposal& change, const Vec3& p) const {
    std::vector<Vec3> points = mesh_.points;
    points.push_back(p);
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
      if (std::find(change.cavity.begin(), change.cavity.end(), f) != change.cavity.end()) continue;
      for (const Triangle& t : change.in.facets) {
        if (distance2(points[mesh_.faces[f].v[0]], p) < 100 &&
            triangles_intersect(points, mesh_.faces[f].v, t))
          return true;
      }
    }
    return false;
  }

  Found look(const Proposal& change, const Vec3& p, double angle) const {
    const Vec3 gradient = h_.surface.gradient(p), up = (-1 / length(gradient)) * gradient;
    const Vec3 helper = std::fabs(up.x) < 0.8 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 across = cross(up, helper), u = across / length(across), w = cross(up, u);
    return look(change, {p, std::cos(angle) * u + std::sin(angle) * w, up});
  }

  // In the plane of p and the dual line of the facet that was refused, if the line misses Sigma as
  // far as a surface point may lie; else nothing.
  Found look_at_dual(const Proposal& change, const Vec3& p) const {
    const Triangle& t = change.in.facets[change.duals.size() - 1];
    const auto at = [&](VertexId v) { return v < mesh_.points.size() ? mesh_.points[v] : p; };
    const Vec3 area = area_normal(at(t[0]), at(t[1]), at(t[2])), up = area / length(area);
    const Vec3 center = circumcenter(at(t[0]), at(t[1]), at(t[2]));
    const double radius = distance(center, p);
    if (radius > 0.7 * kReach) return {};
    SearchCounters counters;
    std::vector<Hit> hits;
    h_.surface.intersect({center - radius * up, center + radius * up}, hits, counters);
    if (!hits.empty()) return {};
    Found found = look(change, {p, (center - p) / radius, up});
    found.c = Vec2{radius, 0};
    return found;
  }

  Found look(const Proposal& change, const Cut& cut) const {
    Found found;
    found.cut = cut;
    const Vec3& p = cut.origin;
    // All of the picture lies in the volume.
    for (const double x : {-kReach, kReach}) {
      for (const double y : {-kReach, kReach}) {
        if (!h_.volume.box().contains(p + x * cut.along + y * cut.up)) return found;
      }
    }
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
      const Triangle& t = mesh_.faces[f].v;
      const auto piece = found.cut.of(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]);
      if (!piece) continue;
      const bool goes =
          std::find(change.cavity.begin(), change.cavity.end(), f) != change.cavity.end();
      (goes ? found.old : found.kept).push_back(*piece);
    }
    for (const Triangle& t : change.in.facets) {
      // p lies in the plane: a hair above it is as good.
      const Vec3 lifted = p + 1e-9 * found.cut.normal();
      const auto piece = found.cut.of(mesh_.points[t[0]], mesh_.points[t[1]], lifted);
      if (piece) found.fresh.push_back(*piece);
    }
    return found;
  }

  // How well the fault is seen; 0: not.
  static double clarity(const Found& found, Refusal wanted) {
    const auto length2_of = [](const Piece& p) { return distance2(p[0], p[1]); };
    double longest = 0;
    for (const Piece& p : found.fresh) longest = std::max(longest, length2_of(p));
    if (found.fresh.size() != 2 || found.old.empty() || longest > 3) return 0;
    const double shortest = std::min(length2_of(found.fresh[0]), length2_of(found.fresh[1]));
    // The angle at p, which both pieces come to.
    const auto away_from_p = [](const Piece& p) {
      return dot(p[0], p[0]) < dot(p[1], p[1]) ? p[1] : p[0];
    };
    const Vec2 d = away_from_p(found.fresh[0]), e = away_from_p(found.fresh[1]);
    const double cosine = dot(d, e) / std::sqrt(dot(d, d) * dot(e, e));
    if (wanted == Refusal::turned) return cosine > 0.85 && cosine < 0.97 ? shortest : 0;
    if (cosine > 0.8) return 0;
    if (wanted == Refusal::crossing) {
      for (const Piece& p : found.fresh) {
        for (const Piece& q : found.kept) {
          if (cross_well(p, q)) return shortest;
        }
      }
      return 0;
    }
    double sag = 0;  // how far p is from what goes
    for (const Piece& p : found.old) {
      sag = std::max(sag, std::fabs(turn(p[0], p[1], {0, 0})) / std::sqrt(length2_of(p)));
    }
    return shortest * sag;
  }

  Handed& h_;
  const TriMesh& mesh_;
  Refinement refinement_;
};

void draw(Drawing& out, const Handed& h, const Panel& panel, const Found& found,
          const char* title) {
  out.clip_to(panel);
  out.rectangle(panel.corner, panel.size, {.fill = ink::kBelow});
  constexpr int kCells = 92;
  const double reach = 0.5 * panel.size.x / panel.scale, step = 2 * reach / kCells;
  for (int j = 0; j < kCells; ++j) {
    const auto is_inside = [&](int i) {
      const Vec3 q = found.cut.origin + (-reach + (i + 0.5) * step) * found.cut.along +
                     (-reach + (j + 0.5) * step) * found.cut.up;
      return h.volume.box().contains(q) && h.volume.value(q) >= h.kappa;
    };
    for (int from = 0, to = 0; from < kCells; from = to) {
      while (to < kCells && is_inside(to) == is_inside(from)) ++to;
      if (!is_inside(from)) continue;
      out.rectangle(panel.at({-reach + from * step, -reach + (j + 1) * step}),
                    {panel.scale * step * (to - from), panel.scale * step + 0.3},
                    {.fill = ink::kAbove});
    }
  }
  for (const Piece& p : found.kept) {
    out.line(panel.at(p[0]), panel.at(p[1]), {.stroke = ink::kBlue, .width = 2});
  }
  for (const Piece& p : found.old) {
    out.line(panel.at(p[0]), panel.at(p[1]), {.stroke = ink::kBlue, .width = 2, .dashed = true});
  }
  for (const Piece& p : found.fresh) {
    out.line(panel.at(p[0]), panel.at(p[1]), {.stroke = ink::kRed, .width = 2.5});
  }
  if (found.c) {
    const Vec2 c = *found.c, end{0, c.x};
    out.line(panel.at(c - end), panel.at(c + end), {.stroke = ink::kRed, .dashed = true});
    out.dot(panel.at(c), ink::kText, 4);
    out.text(panel.at(c) + Vec2{8, -6}, "c", Anchor::start, 14, ink::kText, true);
    out.text(panel.at(c - end) + Vec2{-7, -12}, "dual line", Anchor::end, 13, ink::kRed);
  }
  out.dot(panel.at({0, 0}), ink::kRed, 5);
  // On the side of p that the new disk leaves free.
  Vec2 away{};
  for (const Piece& p : found.fresh) {
    const Vec2 d = p[0] + p[1];
    away = away - (1 / std::sqrt(dot(d, d))) * d;
  }
  away = (17 / std::sqrt(dot(away, away))) * away;
  out.text(panel.at({0, 0}) + Vec2{away.x, 5 - away.y}, "p", Anchor::middle, 15, ink::kRed, true);
  out.frame(panel, title);
}

}  // namespace

void draw_gates(const std::string& folder) {
  Handed h("builtin:noise:20", 127.5, {});
  Search search(h);
  Drawing out(760, 290);
  const auto panel = [](double x) {
    return Panel{{-kReach, -kReach}, 115 / kReach, {x, 40}, {230, 230}};
  };
  draw(out, h, panel(16), search.find(Refusal::turned), "G2: an edge turns too sharply");
  draw(out, h, panel(265), search.find(Refusal::no_surface_point), "G3: no surface point");
  draw(out, h, panel(514), search.find(Refusal::crossing), "G5: another sheet is crossed");
  out.write(folder, "gates");
}

}  // namespace deliso::guide
