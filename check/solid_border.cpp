// SPDX-License-Identifier: MIT
// The border of a solid: its facets do not cross, and its pieces do not face the inside of others.
#include <algorithm>
#include <optional>

#include "base/disjoint_sets.h"
#include "base/text.h"
#include "check/self_intersections.h"
#include "check/solid_facets.h"
#include "exact/predicates.h"
#include "mesh/incidence.h"

namespace deliso {
namespace {

// Directions of rays: near the x axis, so that few boxes lie along them, and along no plane of a
// lattice. If a ray meets an edge the next one is tried.
constexpr std::array kDirections{Vec3{1, .00317, .00713}, Vec3{1, -.00529, .00239},
                                 Vec3{1, .00871, -.00147}, Vec3{-1, .00193, .00433}};

class BorderPieces {
 public:
  BorderPieces(const std::vector<Vec3>& points, const std::vector<Triangle>& border,
               const TriangleTree& tree)
      : points_(points), border_(border), tree_(tree) {
    DisjointSets joined(border.size());
    for_each_edge(edge_uses(points.size(), border), [&](std::span<const EdgeUse> uses) {
      for (const EdgeUse& use : uses) joined.unite(uses[0].triangle, use.triangle);
      return true;
    });
    piece_ = joined.take_numbers();
  }

  void check(SolidFaults& faults) const {
    std::vector<std::vector<std::uint32_t>> facets(*std::ranges::max_element(piece_) + 1);
    for (std::uint32_t f = 0; f < border_.size(); ++f) facets[piece_[f]].push_back(f);
    if (facets.size() == 1) return;
    for (std::uint32_t piece = 0; piece < facets.size(); ++piece) {
      const Triangle& any = border_[facets[piece][0]];
      std::optional<int> around;
      for (const Vec3& direction : kDirections) {
        if (!around) around = times_around(facets[piece], piece, direction);
      }
      if (!around) {
        faults.add(SolidFaultKind::not_measured,
                   "what the piece of the border is in, at " + name_of_corners(any),
                   middle_of(points_, any));
      } else if (*around != (is_cavity(facets[piece]) ? 1 : 0)) {
        faults.add(
            SolidFaultKind::nested_pieces,
            [&] {
              return text("the piece of the border at ", name_of_corners(any), " lies in ", *around,
                          " others");
            },
            middle_of(points_, any));
      }
    }
  }

 private:
  // True if the facets face what they enclose.
  bool is_cavity(const std::vector<std::uint32_t>& facets) const {
    double sixfold = 0;
    const Vec3 origin = points_[border_[facets[0]][0]];
    for (const std::uint32_t f : facets) {
      const auto& [a, b, c] = border_[f];
      sixfold += sixfold_volume(origin, points_[a], points_[b], points_[c]);
    }
    return sixfold < 0;
  }

  // Returns how often the other pieces go around the last point of this one in the direction.
  // Nothing if the ray from there meets a vertex, an edge or a plane of a facet.
  std::optional<int> times_around(const std::vector<std::uint32_t>& facets, std::uint32_t piece,
                                  const Vec3& direction) const {
    VertexId last = border_[facets[0]][0];
    for (const std::uint32_t f : facets) {
      for (const VertexId v : border_[f]) {
        if (dot(points_[v] - points_[last], direction) > 0) last = v;
      }
    }
    const Vec3 p = points_[last];
    const Vec3 q = p + 2 * length(tree_.box().size()) * direction;
    const Box3 along{box_of(p, q, q)};
    int around = 0;
    bool is_clear = true;
    std::size_t boxes = 0;
    tree_.for_each_leaf_at(along, 0, boxes, [&](std::size_t leaf) {
      for (const FaceId f : tree_.leaf(leaf)) {
        if (piece_[f] == piece) continue;
        const auto side = crossing(p, q, border_[f]);
        is_clear &= side.has_value();
        around += side.value_or(0);
      }
      return is_clear;
    });
    return is_clear ? std::optional(around) : std::nullopt;
  }

  // Returns 1 if the segment leaves the facet's inside, -1 if it enters it, 0 if it misses it.
  std::optional<int> crossing(const Vec3& p, const Vec3& q, const Triangle& t) const {
    const Vec3 &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
    const int of_p = orient3d(a, b, c, p), of_q = orient3d(a, b, c, q);
    if (of_p * of_q > 0) return 0;
    const int ab = orient3d(p, q, a, b), bc = orient3d(p, q, b, c), ca = orient3d(p, q, c, a);
    if (std::min({ab, bc, ca}) < 0 && std::max({ab, bc, ca}) > 0) return 0;
    if (of_p * of_q * ab * bc * ca == 0) return std::nullopt;
    return of_q;
  }

  const std::vector<Vec3>& points_;
  const std::vector<Triangle>& border_;
  const TriangleTree& tree_;
  std::vector<std::uint32_t> piece_;  // of each facet
};

}  // namespace

void check_border(const std::vector<Vec3>& points, const std::vector<Triangle>& border, int threads,
                  SolidFaults& faults) {
  if (border.empty()) return;
  const TriangleTree tree(points, border, threads);
  const Crossings found = find_crossings(points, border, tree, threads);
  for (const auto& pair : found.pairs) {
    const Triangle &s = border[pair.first], &t = border[pair.second];
    faults.add(
        SolidFaultKind::border_crossings,
        [&] { return name_of_corners(s) + " meets " + name_of_corners(t); }, middle_of(points, s));
  }
  if (!found.given_up.empty()) {
    const Triangle& t = border[found.given_up[0]];
    faults.add(SolidFaultKind::not_measured,
               text("crossings of ", found.given_up.size(), " facets of the border, such as ",
                    name_of_corners(t), ": too many lie across each other"),
               middle_of(points, t));
  }
  BorderPieces(points, border, tree).check(faults);
}

}  // namespace deliso
