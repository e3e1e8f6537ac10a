// SPDX-License-Identifier: MIT
// Insertions of Stage 2 that were refused, in noise, as the program tried them, cut by a plane.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/triangle.h"
#include "guide/drawing.h"
#include "guide/figures.h"
#include "guide/handed.h"
#include "refine/refine.h"
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

double length_of(const Piece& p) {
  return std::sqrt(distance2(p[0], p[1]));
}
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
// How far the ends of either piece are from the other, on both sides of it; 0: they do not cross.
double crossing_margin(const Piece& p, const Piece& q) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : {std::pair(p, q), std::pair(q, p)}) {
    const double from = turn(a[0], a[1], b[0]), to = turn(a[0], a[1], b[1]);
    if (from * to >= 0) return 0;
    least = std::min(least, std::min(std::fabs(from), std::fabs(to)) / length_of(a));
  }
  return least;
}

struct Found {
  Cut cut{};
  std::vector<Piece> old, kept, fresh;
  std::optional<Vec2> c;          // of the facet without a surface point; its dual line is upright
  std::optional<Vec2> swallowed;  // the vertex that would go
};

// Of a picture around p: this far to each side. Planes that are tried.
constexpr double kReach = 2;
constexpr int kDirections = 24;
// Least distance of p from the corners around it, in voxels.
constexpr double kMinApart = 0.4;

// Watches Stage 2. Of its insertions that a gate refuses it keeps, per gate, the one that is seen
// best in a plane.
class Search : public Observer {
 public:
  explicit Search(const Handed& handed) : h_(handed), mesh_(handed.coarsened.mesh.mesh) {}

  bool follows_insertions() const override { return true; }
  void operation_tried(const Question& question, Operation operation, const Replacement& change,
                       std::optional<Refusal> refusal) override {
    const bool is_insertion = operation == Operation::surface_point ||
                              operation == Operation::foot || operation == Operation::far_point;
    if (!is_insertion || !refusal) return;
    if (refusal == Refusal::swallows_vertex && operation == Operation::surface_point) {
      swallows.keep(look_at_swallowed(change, question.dual.center));
    } else if (refusal == Refusal::no_surface_point && is_apart(change)) {
      misses.keep(look_at_dual(change));
    } else if (refusal == Refusal::crossing) {
      for (int n = 0; n < kDirections; ++n) {
        crosses.keep(look_at_crossing(change, n * std::numbers::pi / kDirections));
      }
    }
  }

  struct Seen {
    double clarity = 0;  // 0: not seen
    Found found;
  };
  struct Best : Seen {
    void keep(Seen seen) {
      if (seen.clarity > clarity) Seen::operator=(std::move(seen));
    }
  };
  Best swallows, misses, crosses;

 private:
  bool is_apart(const Replacement& change) const {
    return std::ranges::none_of(change.cavity.disk.boundary, [&](const Disk::BoundaryEdge& edge) {
      return distance(mesh_.points[edge.from], change.proposal.place) < kMinApart;
    });
  }

  // Normal to Sigma at p, out of it.
  Vec3 up_at(const Vec3& p) const {
    const Vec3 gradient = h_.surface.gradient(p);
    return (-1 / length(gradient)) * gradient;
  }

  // In the plane of p and the vertex inside the cavity.
  Seen look_at_swallowed(const Replacement& change, const Vec3& p) const {
    const Disk& was = change.cavity.disk;
    const std::span<const VertexId> all = was.vertices();
    const auto inner = std::ranges::find_if(all, [&](VertexId v) {
      return std::ranges::none_of(was.boundary, [&](const auto& edge) { return edge.from == v; });
    });
    if (inner == all.end()) return {};
    const Vec3 up = up_at(p), to = mesh_.points[*inner] - p, along = to - dot(to, up) * up;
    const double away = length(along);
    if (away < kMinApart || away > 0.5 * kReach) return {};
    Seen seen{0, look(change, {p, along / away, up})};
    seen.found.swallowed = seen.found.cut.at(mesh_.points[*inner]);
    // Two pieces come to the vertex, and p is off them.
    if (seen.found.old.size() < 2 || seen.found.old.size() > 3) return {};
    for (const Piece& piece : seen.found.old) {
      if (length_of(piece) < kMinApart) return {};
    }
    seen.clarity = std::min(0.3, std::fabs(seen.found.swallowed->y)) * away;
    return seen;
  }

  // In the plane of p and the dual line of the facet that was refused, if the line misses Sigma as
  // far as a surface point may lie.
  Seen look_at_dual(const Replacement& change) const {
    const Vec3& p = change.proposal.place;
    const Triangle& t = change.in().facets[change.duals.size() - 1];
    const auto at = [&](VertexId v) { return v == change.proposal.vertex ? p : mesh_.points[v]; };
    const Vec3 area = area_normal(at(t[0]), at(t[1]), at(t[2])), up = area / length(area);
    const Vec3 center = circumcenter(at(t[0]), at(t[1]), at(t[2]));
    const double radius = distance(center, p);
    if (radius > 0.7 * kReach) return {};
    SearchCounters counters;
    std::vector<Hit> hits;
    h_.surface.intersect({center - radius * up, center + radius * up}, hits, counters);
    if (!hits.empty()) return {};
    Seen seen{0, look(change, {p, (center - p) / radius, up})};
    seen.found.c = Vec2{radius, 0};
    if (!is_open_cone(seen.found) || shortest(seen.found.old) < kMinApart) return {};
    double sag = 0;  // how far p is from the cavity
    for (const Piece& q : seen.found.old) {
      sag = std::max(sag, std::fabs(turn(q[0], q[1], {0, 0})) / length_of(q));
    }
    seen.clarity = shortest(seen.found.fresh) * sag;
    return seen;
  }

  Seen look_at_crossing(const Replacement& change, double angle) const {
    const Vec3& p = change.proposal.place;
    const Vec3 up = up_at(p), helper = std::fabs(up.x) < 0.8 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 across = cross(up, helper), u = across / length(across), w = cross(up, u);
    Seen seen{0, look(change, {p, std::cos(angle) * u + std::sin(angle) * w, up})};
    if (seen.found.old.empty() || !are_short(seen.found.fresh)) return {};
    for (const Piece& fresh : seen.found.fresh) {
      for (const Piece& kept : seen.found.kept) {
        seen.clarity = std::max(seen.clarity, crossing_margin(fresh, kept));
      }
    }
    return seen;
  }

  Found look(const Replacement& change, const Cut& cut) const {
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
      if (is_dead(mesh_.faces[f]) || distance(mesh_.points[t[0]], p) > 4 * kReach) continue;
      const auto piece = found.cut.of(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]);
      if (!piece) continue;
      const bool goes = std::ranges::find(change.cavity.facets, f) != change.cavity.facets.end();
      (goes ? found.old : found.kept).push_back(*piece);
    }
    // p lies in the plane: a hair above it is as good.
    const Vec3 lifted = p + 1e-9 * found.cut.normal();
    const auto at = [&](VertexId v) {
      return v == change.proposal.vertex ? lifted : mesh_.points[v];
    };
    for (const Triangle& t : change.in().facets) {
      const auto piece = found.cut.of(at(t[0]), at(t[1]), at(t[2]));
      if (piece) found.fresh.push_back(*piece);
    }
    return found;
  }

  static double shortest(const std::vector<Piece>& pieces) {
    return length_of(std::ranges::min(pieces, {}, length_of));
  }
  static bool are_short(const std::vector<Piece>& pieces) {
    return std::ranges::all_of(pieces, [](const Piece& p) { return length_of(p) < 1.7; });
  }
  // True if two new pieces come to p, neither long, at no sharp angle.
  static bool is_open_cone(const Found& found) {
    if (found.fresh.size() != 2 || found.old.empty()) return false;
    if (!are_short(found.fresh)) return false;
    const auto away_from_p = [](const Piece& p) {
      return dot(p[0], p[0]) < dot(p[1], p[1]) ? p[1] : p[0];
    };
    const Vec2 d = away_from_p(found.fresh[0]), e = away_from_p(found.fresh[1]);
    return dot(d, e) <= 0.8 * std::sqrt(dot(d, d) * dot(e, e));
  }

  const Handed& h_;
  const TriMesh& mesh_;
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
    out.text(panel.at(c - end) + Vec2{0, 15}, "dual line", Anchor::middle, 13, ink::kRed);
  }
  if (found.swallowed) {
    out.dot(panel.at(*found.swallowed), ink::kText, 5);
    out.text(panel.at(*found.swallowed) + Vec2{0, -9}, "v", Anchor::middle, 15, ink::kText, true);
  }
  out.dot(panel.at({0, 0}), ink::kRed, 5);
  // On the side of p that the new disk leaves free.
  Vec2 away{};
  for (const Piece& p : found.fresh) {
    const Vec2 d = p[0] + p[1];
    away = away - (1 / std::sqrt(dot(d, d))) * d;
  }
  if (found.fresh.empty()) away = {0, 1};
  away = (17 / std::sqrt(dot(away, away))) * away;
  out.text(panel.at({0, 0}) + Vec2{away.x, 5 - away.y}, "p", Anchor::middle, 15, ink::kRed, true);
  out.frame(panel, title);
}

}  // namespace

void draw_gates(const std::string& folder) {
  Handed h("builtin:noise:32", 127.5, {});
  Search search(h);
  h.parameters.observer = &search;
  refine(h.coarsened.mesh, h.coarsened.samples, h.given());
  Drawing out(760, 290);
  const auto panel = [](double x) {
    return Panel{{-kReach, -kReach}, 115 / kReach, {x, 40}, {230, 230}};
  };
  draw(out, h, panel(16), search.swallows.found, "a vertex would go");
  draw(out, h, panel(265), search.misses.found, "G3: no surface point");
  draw(out, h, panel(514), search.crosses.found, "G5: a facet is crossed");
  out.write(folder, "gates");
}

}  // namespace deliso::guide
