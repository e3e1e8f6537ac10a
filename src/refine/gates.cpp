// SPDX-License-Identifier: MIT
// The tests G1 to G5 of refine/refinement.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/check.h"
#include "base/triangle.h"
#include "embedding/pages.h"
#include "refine/refinement.h"

namespace deliso {
namespace {

// Most facets of a small component outside the cavity. One replacement cannot reverse a larger one.
constexpr std::size_t kMaxSmallComponent = 12;

// G4, in bounds on the distance: the largest distance from a removed vertex to the new facets. It
// keeps protrusions that Stage 1 left and the search for far samples found.
constexpr double kMaxRemovedDistances = 2;

}  // namespace

std::optional<Refusal> Refinement::test_shape(Replacement& c) {
  if (!keeps_manifold(c) || passes_sheet(c)) return Refusal::not_a_disk;
  normals_.clear();
  for (const Triangle& v : c.in().facets) normals_.push_back(normal(v));
  if ((c.proposal.gates.least_cosine > kAnyFold && folds(c)) || reverses(c)) return Refusal::turned;
  return std::nullopt;
}

// G1. A boundary edge of the cavity with a facet across must be on the new disk's boundary. Other
// boundary edges of either disk lie on the mesh's boundary. A new edge is inside the new disk or on
// the mesh's boundary. It must not join two vertices that an edge joins elsewhere, or that edge
// would have too many facets.
bool Refinement::keeps_manifold(Replacement& c) {
  if (c.moves()) return true;  // nothing else changes
  const Cavity& cavity = c.cavity;
  Disk& in = c.in_;
  if (c.has_new_vertex() && in.link_cone(cavity.disk.boundary, c.proposal.vertex)) {
    c.across_ = cavity.across;
    return true;
  }
  if (!in.link()) return false;
  c.across_.clear();
  for (const Disk::BoundaryEdge& e : in.boundary) {
    std::size_t old = 0;
    while (old < cavity.across.size() &&
           (cavity.disk.boundary[old].from != e.from || cavity.disk.boundary[old].to != e.to)) {
      ++old;
    }
    const bool is_new = old == cavity.across.size();
    if (is_new && is_joined_outside(e.from, e.to, c)) return false;
    c.across_.push_back(is_new ? kNoId : cavity.across[old]);
  }
  const auto has_facet = [](FaceId f) { return f != kNoId; };
  if (std::ranges::count_if(c.across_, has_facet) !=
      std::ranges::count_if(cavity.across, has_facet)) {
    return false;
  }
  // A single facet may be in the mesh already, with the opposite orientation.
  const std::vector<FaceId>& across = c.across();
  if (in.facets.size() == 1 && across[0] != kNoId && across[0] == across[1] &&
      across[0] == across[2]) {
    return false;
  }
  for (std::uint32_t f = 0; f < in.facets.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t g = in.across[f][i];
      if (g == Disk::kNone || g < f) continue;
      const VertexId a = in.facets[f][(i + 1) % 3], b = in.facets[f][(i + 2) % 3];
      if (s.joins_on_box(a, b, box_) || is_joined_outside(a, b, c) || is_joined_on_curves(a, b)) {
        return false;
      }
    }
  }
  return in.facets.size() > 1 || !s.lies_on_box(in.facets[0], box_);
}

bool Refinement::is_joined_outside(VertexId a, VertexId b, const Replacement& c) {
  if (c.has_new_vertex() && (a == c.proposal.vertex || b == c.proposal.vertex)) return false;
  const std::vector<FaceId>& removed = c.cavity.facets;
  const auto start =
      std::ranges::find_if(removed, [&](FaceId f) { return has_corner(mesh.faces[f].v, a); });
  DELISO_ASSERT(start != removed.end());
  facets_around(mesh, *start, a, star_);
  return std::ranges::any_of(
      star_, [&](FaceId f) { return !is_in_cavity(f) && has_corner(mesh.faces[f].v, b); });
}

// A vertex where several sheets end may have facets that no walk around it in one sheet meets.
bool Refinement::is_joined_on_curves(VertexId a, VertexId b) const {
  if (frozen_sides_.empty() || !s.chain.is_boundary(a) || !s.chain.is_boundary(b)) return false;
  return facets_.any(facets_.box_of(std::array{point(a), point(b)}),
                     [&](FaceId f, const BoxGrid::Box&) {
                       const Triangle& v = mesh.faces[f].v;
                       return !is_in_cavity(f) && has_corner(v, a) && has_corner(v, b);
                     });
}

std::span<const Refinement::FrozenSide> Refinement::frozen_at(VertexId a, VertexId b) const {
  if (!s.chain.is_boundary(a) || !s.chain.is_boundary(b)) return {};
  const std::pair edge{std::min(a, b), std::max(a, b)};
  const auto first = std::ranges::lower_bound(frozen_sides_, edge, {}, &FrozenSide::edge);
  const auto last = std::ranges::upper_bound(frozen_sides_, edge, {}, &FrozenSide::edge);
  return {first, last};
}

// G1 and G2, where several sheets end: the new facet lies between the same two as the old one, and
// on neither of them.
bool Refinement::passes_sheet(const Replacement& c) const {
  if (frozen_sides_.empty()) return false;
  for (std::size_t k = 0; k < c.in().boundary.size(); ++k) {
    if (c.across()[k] != kNoId) continue;
    const Disk::BoundaryEdge& edge = c.in().boundary[k];
    const VertexId a = edge.from, b = edge.to;
    const std::span<const FrozenSide> others = frozen_at(a, b);
    if (others.size() != 2) continue;
    const auto old = std::ranges::find_if(c.cavity.disk.boundary, [&](const auto& other) {
      return other.from == a && other.to == b;
    });
    if (old == c.cavity.disk.boundary.end()) continue;
    const Vec3 &x = point(others[0].apex), &y = point(others[1].apex);
    const Vec3& now = point(c.in().facets[edge.facet][edge.side]);
    const Vec3 before = point_before(c, c.cavity.disk.facets[old->facet][old->side]);
    const auto sharpest = [&](const Vec3& p) {
      return std::max(cosine_of_pages(point(a), point(b), x, p),
                      cosine_of_pages(point(a), point(b), y, p));
    };
    if (are_in_order(point(a), point(b), x, y, now) !=
            are_in_order(point(a), point(b), x, y, before) ||
        sharpest(now) > std::max(-kSharpestFold, sharpest(before))) {
      return true;
    }
  }
  return false;
}

// Returns the smallest cosine between the normals at an edge of the disk, boundary edges included;
// 0 if none is negative.
double Refinement::sharpest_edge(const Disk& disk, std::span<const Vec3> normals,
                                 std::span<const FaceId> across) const {
  double least = 0;
  const auto consider = [&](const Vec3& u, const Vec3& v) {
    if (dot(u, v) < 0) least = std::min(least, cosine_between(u, v));
  };
  for (std::uint32_t f = 0; f < disk.facets.size(); ++f) {
    for (const std::uint32_t g : disk.across[f]) {
      if (g != Disk::kNone && g > f) consider(normals[f], normals[g]);
    }
  }
  for (std::size_t k = 0; k < across.size(); ++k) {
    if (across[k] == kNoId) continue;
    consider(normals[disk.boundary[k].facet], normal(mesh.faces[across[k]].v));
  }
  return least;
}

// G2.
bool Refinement::folds(const Replacement& c) const {
  const double after = sharpest_edge(c.in(), normals_, c.across());
  if (after >= c.proposal.gates.least_cosine) return false;
  std::vector<Vec3> normals;
  for (const Triangle& v : c.cavity.disk.facets) {
    normals.push_back(
        area_normal(point_before(c, v[0]), point_before(c, v[1]), point_before(c, v[2])));
  }
  return !(after >= sharpest_edge(c.cavity.disk, normals, c.cavity.across));
}

// G2, for small components: true if the volume that the component bounds changes its sign.
bool Refinement::reverses(Replacement& c) {
  const std::size_t outside =
      component_size_[component_[c.cavity.facets[0]]] - c.cavity.facets.size();
  if (outside > kMaxSmallComponent) return false;
  unsigned met = 0;  // the faces of the box in which the component ends
  rest_.clear();
  const auto visit = [&](FaceId g, VertexId a, VertexId b) {
    if (g == kNoId) {
      met |= box_faces_at(point(a), box_) & box_faces_at(point(b), box_);
    } else if (!is_in_cavity(g) && std::ranges::find(rest_, g) == rest_.end()) {
      rest_.push_back(g);
    }
  };
  for (std::size_t k = 0; k < c.across().size(); ++k) {
    visit(c.across()[k], c.in().boundary[k].from, c.in().boundary[k].to);
  }
  for (std::size_t n = 0; n < rest_.size();) {
    const FaceId f = rest_[n++];
    // A component with a frozen facet may continue outside the free box.
    if (is_frozen(f)) return false;
    const Face& face = mesh.faces[f];
    for (int i = 0; i < 3; ++i) visit(face.n[i], face.v[(i + 1) % 3], face.v[(i + 2) % 3]);
  }
  const std::optional<Vec3> origin = moved_into_faces(point(c.in().facets[0][0]), met, box_);
  if (!origin) return false;
  const auto volume = [&](const Triangle& v, auto&& at) {
    return sixfold_volume(*origin, at(v[0]), at(v[1]), at(v[2]));
  };
  const auto now = [&](VertexId v) { return point(v); };
  const auto was = [&](VertexId v) { return point_before(c, v); };
  double rest = 0, before = 0, after = 0;
  for (const FaceId f : rest_) rest += volume(mesh.faces[f].v, now);
  for (const Triangle& v : c.cavity.disk.facets) before += volume(v, was);
  for (const Triangle& v : c.in().facets) after += volume(v, now);
  return (rest + before > 0) != (rest + after > 0);
}

// G3.
std::ptrdiff_t Refinement::facets_without_point(const Replacement& c) const {
  return std::ranges::count_if(
      c.cavity.facets, [&](FaceId f) { return !s.duals[f].on_surface && !is_small(s.duals[f]); });
}

bool Refinement::find_dual(Replacement& c, std::ptrdiff_t& allowed) {
  const std::size_t f = c.duals.size();
  const Triangle& v = c.in().facets[f];
  c.duals.push_back(finder.dual(point(v[0]), point(v[1]), point(v[2]), report.searches_refine));
  const Dual& dual = c.duals.back();
  if (dual.on_surface || !c.proposal.gates.surface_points) return true;
  return (is_small(dual) && faces_out(v, normals_[f])) || allowed-- > 0;
}

bool Refinement::faces_out(const Triangle& v, const Vec3& normal) const {
  Vec3 sum;
  for (const VertexId q : v) {
    const Vec3 gradient = surface.gradient(point(q));
    const double steepness = length(gradient);
    if (steepness > 0) sum = sum + gradient / steepness;
  }
  return dot(sum, normal) < 0;
}

bool Refinement::leaves_sheet(const Replacement& c) {
  if (!c.proposal.gates.surface_points || c.proposal.what == Proposal::Vertex::none) return false;
  const Vec3& place = c.proposal.place;
  if (c.moves()) return !finder.leads_to(moved_from_, place);
  const auto from_place = [&](VertexId v) { return distance2(point(v), place); };
  const VertexId nearest = *std::ranges::min_element(c.cavity.disk.vertices(), {}, from_place);
  return !finder.leads_to(point(nearest), place);
}

// G4, for the removed vertices.
bool Refinement::uncovers(const Replacement& c) const {
  const double limit = kMaxRemovedDistances * parameters.refinement[Criterion::distance];
  if (!c.proposal.gates.coverage || c.proposal.what != Proposal::Vertex::none) return false;
  return std::ranges::any_of(c.cavity.disk.vertices(), [&](VertexId v) {
    if (std::ranges::find(c.in().vertices(), v) != c.in().vertices().end()) return false;
    return std::ranges::all_of(c.in().facets, [&](const Triangle& t) {
      return distance2_to_triangle(point(v), point(t[0]), point(t[1]), point(t[2])) > limit * limit;
    });
  });
}

// G5: true if a new facet is too thin, and none was as thin before. Where vertices near one point
// are moved apart one by one, facets are needles in between.
bool Refinement::is_needle(const Replacement& c) const {
  if (c.moves()) return false;
  double after = 1, before = 1;
  for (const auto& [a, b, d] : c.in().facets) {
    after = std::min(after, height_ratio2(point(a), point(b), point(d)));
  }
  if (after >= kNeedleHeight * kNeedleHeight) return false;
  for (const auto& [a, b, d] : c.cavity.disk.facets) {
    before =
        std::min(before, height_ratio2(point_before(c, a), point_before(c, b), point_before(c, d)));
  }
  return after < before;
}

// G5.
bool Refinement::crosses(const Replacement& c) {
  if (is_needle(c) || !crossing_.begin(mesh.points, c.in(), normals_, facets_)) return true;
  const bool is_cone = c.has_new_vertex() && c.in().inner_vertices() == 1;
  return crossing_.crosses_itself(is_cone ? c.proposal.vertex : kNoId) ||
         facets_.any(crossing_.box(), [&](FaceId f, const BoxGrid::Box& box) {
           return !is_in_cavity(f) && crossing_.crosses(mesh.faces[f].v, box);
         });
}

}  // namespace deliso
