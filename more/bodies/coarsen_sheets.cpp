// SPDX-License-Identifier: MIT
#include "more/bodies/coarsen_sheets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/sorted_list.h"
#include "base/stopwatch.h"
#include "coarsen/waiting_vertices.h"
#include "embedding/pages.h"
#include "more/bodies/borders.h"
#include "more/bodies/sheet_faults.h"
#include "surface/hole.h"
#include "surface/ring.h"

namespace deliso {
namespace {

// As in coarsen/coarsener.cpp: rounds of moves and flips, the least move, and the sharpest star in
// which a vertex moves.
constexpr int kRounds = 2;
constexpr double kLeastMove = 0.1, kSharpCosine = 0.7;

// Furthest that a vertex on a curve, when it goes, lies from the chord between its neighbors, as a
// share of the chord. T_L has zigzags that the fields have not.
constexpr double kSharpestKink = 0.35;
// Steps in which vertices on curves move to where their fields are equal, before removals; the
// longest step, in the nearer neighbor's distance.
constexpr int kCurveSteps = 2;
constexpr double kLongestStep = 0.7;
constexpr int kNewtonSteps = 4;
// Corners whose place is further away, in voxels, stay: on the way they might pass a sample. (With
// 1 voxel two of 8,337 samples of noise came into another body.)
constexpr double kFarthestCorner = 0.3;

// Cosine of the least angle between facets at an edge after a change.
constexpr double kSharpestPages = 0.97;

// Attempts. Each keeps the vertices so many voxels around the faults of those before; after the
// last all stay.
constexpr std::array kMargins{0.5, 1.0, 2.0, 4.0, 8.0};

class SheetCoarsener {
 public:
  // `sheets`: uncut. Vertices of facets that are done wait until something near them changes.
  SheetCoarsener(const Sheets& sheets, CutSheets& cut, Borders& borders, const SheetScope& scope,
                 const IdArray<VertexId, std::uint8_t>& kept, SearchCounters& searches)
      : cut_(cut),
        mesh_(cut.mesh),
        borders_(borders),
        scope_(scope),
        kept_(kept),
        free_facets_(sheets.free_facets),
        searches_(searches),
        first_(kept.size(), kNoId),
        is_active_(kept.size(), 0),
        waiting_(kept.size()) {
    for (VertexId c = 0; c < cut_.vertex.size(); ++c) {
      if (first_[vertex(c)] == kNoId) first_[vertex(c)] = c;
    }
    for (const SheetFacet& f : sheets.facets) {
      for (const VertexId v : f.v) is_active_[v] |= f.is_done ? 0 : 1;
    }
    for (VertexId v = 0; v < kept_.size(); ++v) {
      if (is_active_[v] != 0) wake(v, v);
    }
  }

  void run() {
    for (int n = 0; n < kCurveSteps; ++n) straighten_curves();
    remove_vertices();
    for (int round = 0; round < kRounds; ++round) {
      straighten_curves();
      move_vertices();
      flip_edges();
      remove_vertices();
    }
  }

 private:
  // What a vertex has in one sheet: its neighbors there, and the filling of their hole.
  struct Page {
    VertexId copy;
    Ring ring;
    Hole hole;
  };
  static constexpr std::size_t kMostPages = 8;

  VertexId vertex(VertexId copy) const { return cut_.vertex[copy]; }

  // Calls visit(copy) for all copies of a vertex until it returns false. Returns whether none did.
  template <class Visit>
  bool for_each_copy(VertexId v, Visit&& visit) const {
    VertexId c = first_[v];
    do {
      if (!visit(c)) return false;
      c = cut_.next[c];
    } while (c != first_[v]);
    return true;
  }

  void remove_vertices() {
    waiting_.pass([&](VertexId v) { return remove(v); },
                  [&](VertexId v, auto&& visit) {
                    for_each_neighbor([&](VertexId w) {
                      visit(w);
                      is_active_[w] = 1;
                      wake(w, v);
                    });
                  });
  }
  void wake(VertexId v, VertexId changed) {
    waiting_.wake(v, changed, kept_[v] == 0 && first_[v] != kNoId);
  }
  // Calls visit(w) for the neighbors of the vertex walked around last, on curves more than once.
  template <class Visit>
  void for_each_neighbor(Visit&& visit) const {
    for (std::size_t n = 0; n < pages_; ++n) {
      for (int k = 0; k < page_[n].ring.size; ++k) visit(vertex(page_[n].ring.vertex[k]));
    }
  }

  // Walks around the copies of v. False if one has too many neighbors, or its facets are none.
  bool walk(VertexId v) {
    pages_ = 0;
    return for_each_copy(v, [&](VertexId c) {
      if (pages_ == kMostPages) return false;
      Page& page = page_[pages_++];
      page.copy = c;
      return page.ring.walk(mesh_, cut_.facet[c], c, cut_.is_open[c] != 0);
    });
  }

  // The ends of the curve's edges at v, where all pages have the same two: v is on one curve, and
  // no corner.
  bool find_ends() {
    for (std::size_t n = 0; n < pages_; ++n) {
      const Ring& ring = page_[n].ring;
      if (ring.is_closed) return false;
      std::array ends{vertex(ring.vertex[0]), vertex(ring.vertex[ring.size - 1])};
      if (ends[0] > ends[1]) std::swap(ends[0], ends[1]);
      if (n == 0) ends_ = ends;
      if (ends != ends_ || ends[0] == ends[1]) return false;
    }
    return true;
  }

  bool remove(VertexId v) {
    if (!walk(v)) return false;
    const bool is_on_curve = !page_[0].ring.is_closed;
    if (is_on_curve && (!find_ends() || !chord_holds(v))) return false;
    if (!is_on_curve && pages_ > 1) return false;
    added_.clear();
    if (is_on_curve && !add_edge(ends_[0], ends_[1])) return false;
    for (std::size_t n = 0; n < pages_; ++n) {
      Page& page = page_[n];
      if (page.ring.size < 3) return false;
      page.ring.project();
      if (!page.hole.fill(page.ring, test(page))) {
        if (is_on_curve) return false;
        const auto [r, s, t] = page.hole.tried();
        const auto& corner = page.ring.vertex;
        waiting_.refuse(v, {vertex(corner[r]), vertex(corner[s]), vertex(corner[t])});
        return false;
      }
    }
    for (std::size_t n = 0; n < pages_; ++n) {
      const Page& page = page_[n];
      for (int f = 1; f < page.hole.size(); ++f) {  // each facet after the first brings one edge
        const auto& corner = page.hole.facet(f).corner;
        if (!add_edge(vertex(page.ring.vertex[corner[0]]), vertex(page.ring.vertex[corner[2]]))) {
          return false;
        }
      }
    }
    if (!is_on_curve && page_[0].hole.size() == 1 && has_facet(v, page_[0].ring)) return false;
    for (std::size_t n = 0; n < pages_; ++n) {
      if (spoils_ring(page_[n], v)) return false;
    }
    if (is_on_curve && spoils_chord(v)) return false;
    for (std::size_t n = 0; n < pages_; ++n) {
      replace_star(mesh_, cut_.facet, page_[n].ring, page_[n].hole);
      cut_.facet[page_[n].copy] = kNoId;
    }
    first_[v] = kNoId;
    return true;
  }

  const FacetTest& test(const Page& page) {
    const Border& border = borders_[cut_.sheet[cut_.facet[page.copy]]];
    return page.ring.is_closed ? border.test : border.test_at_curve;
  }

  // False if an edge joins a and b already, or would lie in a given face.
  bool add_edge(VertexId a, VertexId b) {
    if (a > b) std::swap(a, b);
    if (joined(a, b) || std::ranges::find(added_, std::pair{a, b}) != added_.end()) return false;
    if (scope_.inner_faces != 0 && (box_faces_at(point(a), scope_.box) &
                                    box_faces_at(point(b), scope_.box) & scope_.inner_faces) != 0) {
      return false;
    }
    added_.emplace_back(a, b);
    return true;
  }
  const Vec3& point(VertexId v) const { return mesh_.points[first_[v]]; }

  // Calls visit(facet) for the facets at v until it returns true. Returns whether one did.
  template <class Visit>
  bool any_facet(VertexId v, Visit&& visit) const {
    return !for_each_copy(
        v, [&](VertexId c) { return !any_facet_at(mesh_, cut_.facet[c], c, visit); });
  }
  bool has_vertex(const Face& face, VertexId v) const {
    return vertex(face.v[0]) == v || vertex(face.v[1]) == v || vertex(face.v[2]) == v;
  }
  bool joined(VertexId a, VertexId b) const {
    return any_facet(a, [&](const Face& face) { return has_vertex(face, b); });
  }
  // True if the facet of the ring of v, which has three vertices, is there already.
  bool has_facet(VertexId v, const Ring& ring) const {
    const VertexId a = vertex(ring.vertex[0]), b = vertex(ring.vertex[1]),
                   c = vertex(ring.vertex[2]);
    return any_facet(a, [&](const Face& face) {
      return !has_vertex(face, v) && has_vertex(face, b) && has_vertex(face, c);
    });
  }

  // True if a new facet of the page passes a facet of another sheet at an edge of its ring, or
  // folds onto the facet across.
  bool spoils_ring(const Page& page, VertexId v) const {
    const Ring& ring = page.ring;
    for (int f = 0; f < page.hole.size(); ++f) {
      const Hole::Facet& facet = page.hole.facet(f);
      for (std::size_t s = 0; s < 3; ++s) {
        const int k = ~facet.across[s];
        if (facet.across[s] < 0 && k < ring.facets &&
            spoils_edge(ring.vertex[k], ring.vertex[ring.after(k)], ring.outer[k], v, ring.center,
                        ring.point[facet.corner[s]])) {
          return true;
        }
      }
    }
    return false;
  }
  // The same for a facet at the edge between these copies, whose third corner was v, at `from`,
  // when that corner is at `to`. `across`: the facet across in the sheet; kNoId on a curve.
  bool spoils_edge(VertexId a, VertexId b, FaceId across, VertexId v, const Vec3& from,
                   const Vec3& to) const {
    const Vec3 &p = mesh_.points[a], &q = mesh_.points[b];
    std::array<Vec3, 2> apex;
    std::size_t found = 0;
    const auto take = [&](const Face& face) {
      if (!has_vertex(face, vertex(b)) || has_vertex(face, v)) return false;
      for (const VertexId c : face.v) {
        if (vertex(c) != vertex(a) && vertex(c) != vertex(b)) apex[found] = mesh_.points[c];
      }
      return ++found == apex.size();
    };
    across == kNoId ? any_facet(vertex(a), take) : take(mesh_.faces[across]);
    for (std::size_t n = 0; n < found; ++n) {
      if (cosine_of_pages(p, q, apex[n], to) > kSharpestPages) return true;
    }
    return found == 2 &&
           are_in_order(p, q, apex[0], apex[1], from) != are_in_order(p, q, apex[0], apex[1], to);
  }

  // The facets at the edges of curves that end at v: the other end of the edge, and the third
  // corner.
  struct Spoke {
    VertexId end;
    Vec3 apex;
  };
  std::vector<Spoke> spokes() const {
    std::vector<Spoke> found;
    for (std::size_t n = 0; n < pages_; ++n) {
      const Ring& ring = page_[n].ring;
      if (ring.is_closed) continue;
      found.push_back({vertex(ring.vertex[0]), ring.point[1]});
      found.push_back({vertex(ring.vertex[ring.size - 1]), ring.point[ring.size - 2]});
    }
    std::ranges::stable_sort(found, {}, &Spoke::end);
    return found;
  }
  // True if the facets at an edge follow each other in another order after a change, or one folds
  // onto another. `before` and `after`: their third corners.
  static bool spoils_order(const Vec3& a, const Vec3& b, std::span<const Vec3> before,
                           const Vec3& c, const Vec3& d, std::span<const Vec3> after) {
    for (std::size_t n = 0; n < after.size(); ++n) {
      for (std::size_t m = 0; m < n; ++m) {
        if (cosine_of_pages(c, d, after[n], after[m]) > kSharpestPages) return true;
      }
    }
    return before.size() == 3 && are_in_order(a, b, before[0], before[1], before[2]) !=
                                     are_in_order(c, d, after[0], after[1], after[2]);
  }

  // True if that holds for an edge from v to a neighbor on its curves, or one across from v, when v
  // moves.
  bool spoils(VertexId v, const Vec3& to) const {
    for (std::size_t n = 0; n < pages_; ++n) {
      const Ring& ring = page_[n].ring;
      for (int k = 0; k < ring.facets; ++k) {
        if (spoils_edge(ring.vertex[k], ring.vertex[ring.after(k)], ring.outer[k], v, ring.center,
                        to)) {
          return true;
        }
      }
    }
    const std::vector<Spoke> all = spokes();
    for (std::size_t n = 0, m; n < all.size(); n = m) {
      std::vector<Vec3> apex;
      for (m = n; m < all.size() && all[m].end == all[n].end; ++m) apex.push_back(all[m].apex);
      const Vec3& a = point(all[n].end);
      if (spoils_order(a, point(v), apex, a, to, apex)) return true;
    }
    return false;
  }
  // True if it holds for the curve's new edge, for which v goes.
  bool spoils_chord(VertexId v) const {
    const std::vector<Spoke> all = spokes();
    std::vector<Vec3> before, after;
    for (const Spoke& spoke : all) {
      if (spoke.end == ends_[0]) before.push_back(spoke.apex);
    }
    for (std::size_t n = 0; n < pages_; ++n) {
      after.push_back(page_[n].ring.point[page_[n].hole.facet(0).corner[1]]);
    }
    return spoils_order(point(ends_[0]), point(v), before, point(ends_[0]), point(ends_[1]), after);
  }

  // The bodies at the curve through the pages, without those beyond the box, and the faces of the
  // box that it lies in.
  struct Curve {
    std::vector<BodyId> bodies;
    unsigned faces = 0;
  };
  Curve curve() const {
    Curve at;
    for (std::size_t n = 0; n < pages_; ++n) {
      for (const BodyId body : cut_.sheets[cut_.sheet[cut_.facet[page_[n].copy]]]) {
        if (scope_.partition.is_beyond(body)) {
          at.faces |= 1u << (body - scope_.partition.size());
        } else {
          at.bodies.push_back(body);
        }
      }
    }
    sort_unique(at.bodies);
    return at;
  }
  // The distance of p from the curve, to first order; infinite if it is not known.
  double distance_to(const Curve& curve, const Vec3& p) const {
    if (curve.bodies.size() < 2) return 0;
    const auto step = scope_.partition.step_to_tie(p, curve.bodies, curve.faces);
    return step ? length(*step) : kNotAsked;
  }
  double distance_to(const Curve& curve, const Vec3& a, const Vec3& b) const {
    return std::max({distance_to(curve, 0.75 * a + 0.25 * b), distance_to(curve, 0.5 * (a + b)),
                     distance_to(curve, 0.25 * a + 0.75 * b)});
  }

  // True if v is near the chord between its neighbors on the curve, and the chord near the curve,
  // or no further than the two edges were.
  bool chord_holds(VertexId v) const {
    const Vec3 &a = point(ends_[0]), &b = point(ends_[1]), &p = point(v);
    const Vec3 chord = b - a;
    const Curve at = curve();
    const double after = distance_to(at, a, b);
    const double limit = kSharpestKink * length(chord);
    const double off2 = length2(cross(p - a, chord)) / length2(chord);
    if (!(off2 <= limit * limit) || dot(p - a, chord) <= 0 || dot(p - b, chord) >= 0) return false;
    return after <= scope_.distance ||
           after <= std::max(distance_to(at, a, p), distance_to(at, p, b));
  }

  // Moves the vertices on curves to where their fields are equal.
  void straighten_curves() {
    for (VertexId v = 0; v < kept_.size(); ++v) {
      if (!may_move(v) || cut_.is_open[first_[v]] == 0 || !walk(v)) continue;
      if (const std::optional<Vec3> to = place_on_curve(point(v))) move(v, *to);
    }
  }

  void move_vertices() {
    for (VertexId v = 0; v < kept_.size(); ++v) {
      if (may_move(v)) move(v);
    }
  }
  bool may_move(VertexId v) const {
    return kept_[v] == 0 && is_active_[v] != 0 && first_[v] != kNoId;
  }

  bool move(VertexId v) {
    if (!walk(v)) return false;
    const std::optional<Vec3> to = page_[0].ring.is_closed ? place_in_sheet() : place_on_curve({});
    return to && move(v, *to);
  }
  bool move(VertexId v, const Vec3& to) {
    if (!scope_.holds(to)) return false;
    for (std::size_t n = 0; n < pages_; ++n) {
      Ring& ring = page_[n].ring;
      double worst2 = 0;
      for (int k = 0; k < ring.facets; ++k) {
        worst2 =
            std::max(worst2, radius_ratio2(ring.center, ring.point[k], ring.point[ring.after(k)]));
      }
      for (int k = 0; k < ring.facets; ++k) {
        if (!test(page_[n]).holds(to, ring.point[k], ring.point[ring.after(k)], ring.normal,
                                  worst2)) {
          return false;
        }
      }
    }
    if (spoils(v, to)) return false;
    for (std::size_t n = 0; n < pages_; ++n) mesh_.points[page_[n].copy] = to;
    waiting_.forget_refusal(v);
    wake(v, v);
    for_each_neighbor([&](VertexId w) { wake(w, v); });
    return true;
  }

  // The middle of the star, on the border; nothing if it is too near, or the star not flat.
  std::optional<Vec3> place_in_sheet() {
    const Ring& ring = page_[0].ring;
    Vec3 sum;
    double area = 0, nearest2 = kNotAsked;
    const double sharp2 = kSharpCosine * kSharpCosine * ring.normal2;
    for (int k = 0; k < ring.size; ++k) {
      const Vec3 a = ring.point[k] - ring.center, b = ring.point[ring.after(k)] - ring.center;
      const Vec3 normal = cross(a, b);
      const double weight2 = length2(normal), cosine = dot(normal, ring.normal);
      if (!(cosine > 0 && cosine * cosine >= sharp2 * weight2)) return std::nullopt;
      const double weight = std::sqrt(weight2);
      sum = sum + weight * (a + b);
      area += weight;
      nearest2 = std::min(nearest2, length2(a));
    }
    const Vec3 step = sum / (3 * area);
    if (length2(step) < kLeastMove * kLeastMove * nearest2) return std::nullopt;
    const std::uint32_t sheet = cut_.sheet[cut_.facet[page_[0].copy]];
    const BodyId in_front = cut_.sheets[sheet][0];
    if (scope_.partition.is_beyond(in_front)) {
      Vec3 to = ring.center + step;
      const int axis = static_cast<int>(in_front - scope_.partition.size()) / 2;
      to[axis] = ring.center[axis];
      return to;
    }
    return borders_[sheet].finder.foot(ring.center + step, ring.normal,
                                       0.5 * std::sqrt(nearest2) + 2 * scope_.distance, searches_);
  }

  // Where all fields at the curve are equal, near its vertex, or half the way to the middle between
  // the neighbors.
  std::optional<Vec3> place_on_curve(std::optional<Vec3> start) {
    const bool is_corner = !find_ends();
    const Curve at = curve();
    if (at.bodies.size() < 2 || at.bodies.size() > 4 || (is_corner && !start)) return std::nullopt;
    const Vec3 from = page_[0].ring.center;
    double nearest2 = kNotAsked;
    for (const Spoke& spoke : spokes()) {
      nearest2 = std::min(nearest2, distance2(point(spoke.end), from));
    }
    const double reach = kLongestStep * std::sqrt(nearest2);
    Vec3 to = from;
    if (!start) to = 0.5 * (from + 0.5 * (point(ends_[0]) + point(ends_[1])));
    for (int axis = 0; axis < 3; ++axis) {
      if ((at.faces >> (2 * axis) & 3) != 0) to[axis] = from[axis];
    }
    double left = kNotAsked;
    for (int n = 0; n < kNewtonSteps && left > kLeastMove * scope_.distance; ++n) {
      const auto step = scope_.partition.step_to_tie(to, at.bodies, at.faces);
      if (!step) return std::nullopt;
      to = to + *step;
      left = length(*step);
      if (left > scope_.parameters.voxel) return std::nullopt;
    }
    if (left > kLeastMove * scope_.distance) return std::nullopt;
    const double size = distance(to, from);
    if (size < kLeastMove * scope_.distance) return std::nullopt;
    if (size > reach) to = from + reach / size * (to - from);
    if (is_corner) {
      return size <= kFarthestCorner * scope_.parameters.voxel ? std::optional(to) : std::nullopt;
    }
    const Vec3 &a = point(ends_[0]), &b = point(ends_[1]);
    const auto off = [&](const Vec3& p) {
      return std::max(distance_to(at, 0.5 * (a + p)), distance_to(at, 0.5 * (p + b)));
    };
    const double after = off(to);
    return after <= scope_.distance || after <= off(from) ? std::optional(to) : std::nullopt;
  }

  // Of two angles that sum to more than pi one is obtuse, and no facet has two obtuse angles.
  void flip_edges() {
    constexpr int kSweeps = 2;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
        const Face& face = mesh_.faces[f];
        if (is_dead(face)) continue;
        const auto& [a, b, c] = face.v;
        const int i = obtuse_corner(mesh_.points[a], mesh_.points[b], mesh_.points[c]);
        if (i < 3 && face.n[i] != kNoId && is_free(f) && is_free(face.n[i])) flip(f, i);
      }
    }
  }
  bool is_free(FaceId f) const { return f < free_facets_; }

  void flip(FaceId f, int i) {
    const Quad q = quad_at(mesh_, f, i);
    const VertexId a = q.a, b = q.b, c = q.c, d = q.d;
    const Vec3 &pa = mesh_.points[a], &pb = mesh_.points[b], &pc = mesh_.points[c],
               &pd = mesh_.points[d];
    added_.clear();
    if (!borders_[cut_.sheet[f]].test.asks_flip(pa, pb, pc, pd) ||
        kept_[vertex(a)] + kept_[vertex(d)] == 2 || !add_edge(vertex(a), vertex(d))) {
      return;
    }
    const auto [ab, bd, dc, ca] = sides_of(mesh_, q);
    if (spoils_edge(a, b, ab, vertex(c), pc, pd) || spoils_edge(c, a, ca, vertex(b), pb, pd) ||
        spoils_edge(d, b, bd, vertex(c), pc, pa) || spoils_edge(c, d, dc, vertex(b), pb, pa)) {
      return;
    }
    deliso::flip(mesh_, cut_.facet, q);
    wake(vertex(b), vertex(c));
    wake(vertex(c), vertex(b));
  }

  CutSheets& cut_;
  TriMesh& mesh_;
  Borders& borders_;
  const SheetScope& scope_;
  const IdArray<VertexId, std::uint8_t>& kept_;
  const std::size_t free_facets_;
  SearchCounters& searches_;
  IdArray<VertexId, VertexId> first_;  // copy of each vertex; kNoId: none
  // The vertex has a facet that is not done, or is near a change.
  IdArray<VertexId, std::uint8_t> is_active_;
  WaitingVertices waiting_;  // for a try
  std::array<Page, kMostPages> page_;
  std::size_t pages_ = 0;
  std::array<VertexId, 2> ends_;
  std::vector<std::pair<VertexId, VertexId>> added_;  // edges, by the present change
};

// Marks the vertices that are given: of frozen facets, and in inner faces.
IdArray<VertexId, std::uint8_t> given_in(const Sheets& sheets, const SheetScope& scope) {
  IdArray<VertexId, std::uint8_t> given(sheets.points.size(), 0);
  for (std::size_t f = sheets.free_facets; f < sheets.facets.size(); ++f) {
    for (const VertexId v : sheets.facets[f].v) given[v] = 1;
  }
  for (VertexId v = 0; v < given.size(); ++v) {
    if ((box_faces_at(sheets.points[v], scope.box) & scope.inner_faces) != 0) given[v] = 1;
  }
  return given;
}

// Marks the vertices in the voxels of facets of `changed` at fault.
void keep_near(std::span<const FaceId> faults, const Sheets& changed, const Sheets& before,
               double voxels_around, const Grid& shape, IdArray<VertexId, std::uint8_t>& kept) {
  const Vec3 margin = voxels_around * shape.least_spacing();
  std::vector<std::uint64_t> voxels;
  for (const FaceId f : faults) {
    const auto& [a, b, c] = changed.facets[f.number()].v;
    const Box3 box = box_of(changed.points[a], changed.points[b], changed.points[c]);
    const Index3 lo = shape.voxel_at(box.lo - margin), hi = shape.voxel_at(box.hi + margin);
    for_each_place(lo, hi, [&](Index3 at) { voxels.push_back(voxel_number(shape.dims(), at)); });
  }
  sort_unique(voxels);
  for (VertexId v = 0; v < kept.size(); ++v) {
    const std::uint64_t voxel = voxel_number(shape.dims(), shape.voxel_at(before.points[v]));
    if (std::ranges::binary_search(voxels, voxel)) kept[v] = 1;
  }
}

// The facets that are left, with the vertices of `before` in their new places. Those at a given
// vertex are not done.
Sheets uncut(const CutSheets& cut, const Sheets& before,
             const IdArray<VertexId, std::uint8_t>& given) {
  Sheets sheets{before.points, {}, 0};
  for (FaceId f = 0; f < cut.mesh.faces.size(); ++f) {
    const Face& face = cut.mesh.faces[f];
    if (is_dead(face)) continue;
    SheetFacet facet{{}, cut.sheets[cut.sheet[f]], true};
    for (std::size_t i = 0; i < 3; ++i) {
      facet.v[i] = cut.vertex[face.v[i]];
      facet.is_done &= given[facet.v[i]] == 0;
      sheets.points[facet.v[i]] = cut.mesh.points[face.v[i]];
    }
    sheets.facets.push_back(facet);
    if (f < before.free_facets) ++sheets.free_facets;
  }
  return sheets;
}

}  // namespace

void coarsen_sheets(Sheets& sheets, const SheetScope& scope, Report& report) {
  const StepTimer timer(report.seconds_coarsen);
  const CutSheets before(sheets);
  Borders borders(scope.partition, scope.parameters, scope.distance, sheets, before);
  const IdArray<VertexId, std::uint8_t> given = given_in(sheets, scope);
  IdArray<VertexId, std::uint8_t> kept = given;
  for (const double margin : kMargins) {
    CutSheets cut = before;
    SheetCoarsener(sheets, cut, borders, scope, kept, report.searches_coarsen).run();
    Sheets after = uncut(cut, sheets, given);
    const std::vector<FaceId> faults = sheet_faults(after, CutSheets(after), scope.box);
    if (faults.empty()) {
      sheets = std::move(after);
      return;
    }
    ++report[Counter::coarsened_again];
    keep_near(faults, after, sheets, margin, scope.partition.shape(), kept);
  }
}

}  // namespace deliso
