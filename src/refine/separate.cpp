// SPDX-License-Identifier: MIT
#include "refine/separate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/box3.h"
#include "base/sorted_list.h"
#include "base/triangle.h"
#include "mesh/tri_mesh.h"
#include "refine/operations.h"

namespace deliso {
namespace {

// Voxels. Shorter edges are collapsed.
constexpr double kShortestEdgeVoxels = 1e-3;

// Between the normals of two facets that are flat on each other, within one degree.
constexpr double kFlatFold = -0.99985;

// Length of a move, in gaps: where both sheets move, they end a little beyond the gap.
constexpr double kMoveGaps = 0.7;

// Shorter moves, in gaps, are not made: the vertex is as far off Sigma as it may be.
constexpr double kLeastMoveGaps = 0.01;

// A point of Sigma within this share of a move from its end is taken for the end.
constexpr double kBesideShare = 0.5;

// Between the normals of facets that count as one sheet. Where sheets touch at a point, both may
// bend there, and facets near it stand at right angles.
constexpr double kSameSheetCosine = 0.7;

// Rounds of moves. One is enough for two sheets; vertices around one point need two.
constexpr int kMaxRounds = 16;

// Returns p, or the point at the limit on the way from `home` to it.
Vec3 within(const Vec3& p, const Vec3& home, double limit) {
  const double d = distance(home, p);
  return d > limit ? home + limit / d * (p - home) : p;
}

class Separation {
 public:
  explicit Separation(Refinement& r) : r_(r), gap_(r.parameters.gap) {}

  std::vector<FaceId> run(const IdArray<VertexId, std::uint8_t>& is_crowded) {
    for (FaceId f = r_.free_box.first_free; f < r_.mesh.faces.size(); ++f) {
      if (!is_dead(r_.mesh.faces[f])) mend_edges(f);
    }
    mend_new();
    for (FaceId f = r_.free_box.first_free; f < r_.mesh.faces.size(); ++f) {
      if (is_dead(r_.mesh.faces[f])) continue;
      const auto is_asked = [&](VertexId v) { return v < is_crowded.size() && is_crowded[v]; };
      if (std::ranges::any_of(r_.mesh.faces[f].v, is_asked)) facets_.push_back(f);
    }
    // Moves may leave needles and folds, and mending those brings facets near.
    for (int round = 0; round < kMaxRounds && push_apart(); ++round) mend_new();
    std::erase_if(replaced_, [&](FaceId f) { return is_dead(r_.mesh.faces[f]); });
    sort_unique(replaced_);
    return std::move(replaced_);
  }

 private:
  bool accept(Operation operation, std::optional<Refusal> refusal) {
    if (r_.done(operation, refusal)) return false;
    for (const FaceId f : r_.created()) {
      facets_.push_back(f);
      replaced_.push_back(f);
    }
    return true;
  }
  void mend_new() {
    std::size_t next = 0;
    while (next < facets_.size()) {  // it grows
      const FaceId f = facets_[next++];
      if (!is_dead(r_.mesh.faces[f])) mend_edges(f);
    }
  }
  void mend_edges(FaceId f) {
    const Question question(r_, f, Reason::too_near);
    const Vec3 normal = r_.normal(r_.mesh.faces[f].v);
    for (int i = 0; i < 3; ++i) {
      if (unfold(f, i, normal) || collapse_if_short(f, i)) return;  // what came is looked at later
    }
    flip_needle(f);
  }
  bool unfold(FaceId f, int i, const Vec3& normal);
  bool flip_fold(FaceId f, int i, double fold);
  bool flip_needle(FaceId f);
  bool remove_tip(FaceId f, int i);
  bool collapse(FaceId f, int i, const Gates& gates);
  bool merge_across(FaceId f, int i);
  bool collapse_if_short(FaceId f, int i);

  bool push_apart();
  void find_pushes(VertexId v, FaceId f);
  void find_edge_pushes(FaceId f);
  void push(VertexId v, FaceId f, const Vec3& along) { pushes_.push_back({v, f, along}); }

  struct Push {
    VertexId vertex;
    FaceId facet;  // one at the vertex
    Vec3 along;
  };
  bool move(const Push& push);
  // True if p is so near to Sigma that no move began there off it.
  bool is_on_sigma(const Vec3& p) const {
    const Volume& volume = r_.surface.volume();
    return std::abs(volume.value(p) - r_.surface.kappa()) <=
           kLeastMoveGaps * gap_ * length(volume.gradient(p));
  }

  Refinement& r_;
  std::vector<FaceId> facets_;  // to be looked at; grows
  std::vector<FaceId> replaced_;
  const double gap_;
  std::vector<Push> pushes_;  // of this round
  IdArray<VertexId, std::uint8_t> is_seen_;
  IdArray<VertexId, std::optional<Vec3>> left_from_;  // of vertices off Sigma, their place on it
  std::vector<FaceId> near_;
};

// Every success removes a vertex, or an edge in place of which none as sharp comes.
bool Separation::unfold(FaceId f, int i, const Vec3& normal) {
  const FaceId g = r_.mesh.faces[f].n[i];
  if (g == kNoId) return false;
  const Vec3 across = r_.normal(r_.mesh.faces[g].v);
  if (!(dot(normal, across) < 0)) return false;  // nearly all
  const double fold = cosine_between(normal, across);
  if (!(fold < kSharpestFold)) return false;
  return flip_fold(f, i, fold) || merge_across(f, i) ||
         merge_across(g, neighbor_index(r_.mesh.faces[g], f)) || collapse(f, i, Gates{}) ||
         (fold < kFlatFold && remove_tip(f, i));
}

bool Separation::flip_fold(FaceId f, int i, double fold) {
  const Quad q = quad_at(r_.mesh, f, i);
  const Cavity* cavity = r_.open(std::array{q.f, q.g});
  if (!cavity) return false;
  // Else they are nearly the same facets: their surface points do not matter.
  const Gates gates = fold > kFlatFold ? Gates{} : topology_gates(kSharpestFold);
  const auto is_folded_less = [&](const Replacement&) {
    const auto& [s, t] = q.flipped();
    return cosine_between(r_.normal(s), r_.normal(t)) > fold;
  };
  return accept(Operation::flip, r_.make(cavity->fill(q.flipped(), gates), is_folded_less));
}

// Removes an end of the fold whose three facets lie on each other: Sigma has no such tip.
bool Separation::remove_tip(FaceId f, int i) {
  const Triangle v = r_.mesh.faces[f].v;
  for (const VertexId tip : {v[(i + 1) % 3], v[(i + 2) % 3]}) {
    const std::span<const FaceId> star = r_.star(f, tip);
    if (star.size() != 3 || r_.s.chain.is_boundary(tip)) continue;
    const Cavity* cavity = r_.open(star);
    if (!cavity) continue;
    const auto& rim = cavity->disk.boundary;  // in any order
    const VertexId next = rim[0].to;
    const VertexId last = rim[1].from == next ? rim[1].to : rim[2].to;
    const Triangle left{rim[0].from, next, last};
    if (accept(Operation::collapse, r_.make(cavity->fill({&left, 1}, kTopologyGates)))) return true;
  }
  return false;
}

// Flips the longest edge of a facet that is nearly a line.
bool Separation::flip_needle(FaceId f) {
  const auto height2 = [&](const Triangle& v) {
    return height_ratio2(r_.point(v[0]), r_.point(v[1]), r_.point(v[2]));
  };
  const Face& face = r_.mesh.faces[f];
  const double before = height2(face.v);
  if (!(before < kNeedleHeight * kNeedleHeight)) return false;
  const auto length2 = [&](int i) {
    return distance2(r_.point(face.v[(i + 1) % 3]), r_.point(face.v[(i + 2) % 3]));
  };
  const int i = std::max({0, 1, 2}, [&](int a, int b) { return length2(a) < length2(b); });
  if (face.n[i] == kNoId) return false;
  const Quad q = quad_at(r_.mesh, f, i);
  const auto [s, t] = q.flipped();
  if (!(std::min(height2(s), height2(t)) > before)) return false;
  const Cavity* cavity = r_.open(std::array{q.f, q.g});
  return cavity && accept(Operation::flip, r_.make(cavity->fill(q.flipped(), kTopologyGates)));
}

// Merges the corner i of f into the corner of the facet across the opposite edge. The two facets at
// the edge go.
bool Separation::merge_across(FaceId f, int i) {
  const Quad q = quad_at(r_.mesh, f, i);
  if (r_.s.chain.is_boundary(q.a)) return false;
  const std::span<const FaceId> star = r_.star(f, q.a);
  std::vector<FaceId> removed(star.begin(), star.end());
  std::vector<Triangle> facets;
  for (const FaceId h : removed) {
    if (h == f) continue;
    Triangle v = r_.mesh.faces[h].v;
    if (has_corner(v, q.d)) return false;
    std::ranges::replace(v, q.a, q.d);
    facets.push_back(v);
  }
  removed.push_back(q.g);
  const Cavity* cavity = r_.open(removed);
  return cavity && accept(Operation::collapse, r_.make(cavity->fill(facets, Gates{})));
}

bool Separation::collapse_if_short(FaceId f, int i) {
  const Triangle& v = r_.mesh.faces[f].v;
  const double shortest = kShortestEdgeVoxels * r_.parameters.voxel;
  return distance2(r_.point(v[(i + 1) % 3]), r_.point(v[(i + 2) % 3])) < shortest * shortest &&
         collapse(f, i, kTopologyGates);
}

bool Separation::collapse(FaceId f, int i, const Gates& gates) {
  const Triangle v = r_.mesh.faces[f].v;
  const VertexId a = v[(i + 1) % 3], b = v[(i + 2) % 3];
  for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
    if (accept(Operation::collapse, merge_corner(r_, f, from, to, gates))) return true;
  }
  return false;
}

// Returns true if a vertex was moved.
bool Separation::push_apart() {
  std::erase_if(facets_, [&](FaceId f) { return is_dead(r_.mesh.faces[f]); });
  sort_unique(facets_);
  pushes_.clear();
  is_seen_.assign(r_.mesh.points.size(), 0);
  for (const FaceId f : facets_) {
    find_edge_pushes(f);
    for (const VertexId v : r_.mesh.faces[f].v) {
      if (!std::exchange(is_seen_[v], 1)) find_pushes(v, f);
    }
  }
  facets_.clear();
  bool any = false;
  // Pushes of one vertex are added up.
  std::ranges::stable_sort(pushes_, {}, &Push::vertex);
  for (auto push = pushes_.begin(); push != pushes_.end();) {
    Push sum = *push;
    while (++push != pushes_.end() && push->vertex == sum.vertex) {
      sum.along = sum.along + push->along;
    }
    any |= move(sum);
  }
  return any;
}

// Pushes v off facets of other sheets: a solid or a gap between them is thin.
void Separation::find_pushes(VertexId v, FaceId f) {
  const Vec3& p = r_.point(v);
  near_.clear();
  r_.facets().any(r_.facets().box_around(p, gap_), [&](FaceId g, const BoxGrid::Box&) {
    if (!has_corner(r_.mesh.faces[g].v, v)) near_.push_back(g);
    return false;
  });
  if (near_.empty()) return;
  sort_unique(near_);  // the hash may show a facet twice
  std::vector<Vec3> own;
  std::vector<VertexId> beside;
  for (const FaceId h : r_.star(f, v)) {
    own.push_back(r_.normal(r_.mesh.faces[h].v));
    for (const VertexId w : r_.mesh.faces[h].v) beside.push_back(w);
  }
  for (const FaceId g : near_) {
    const Triangle& t = r_.mesh.faces[g].v;
    const Vec3 &a = r_.point(t[0]), &b = r_.point(t[1]), &c = r_.point(t[2]);
    if (!(distance2_to_triangle(p, a, b, c) < gap_ * gap_)) continue;
    for (const VertexId w : t) {
      const Vec3 off = p - r_.point(w);
      const bool is_near = length2(off) < gap_ * gap_ && length2(off) > 0;
      if (is_near && std::ranges::find(beside, w) == beside.end()) push(v, f, off / length(off));
    }
    const Vec3 normal = area_normal(a, b, c);
    const auto is_same_sheet = [&](const Vec3& n) {
      return cosine_between(n, normal) > kSameSheetCosine;
    };
    const auto is_beside = [&](VertexId w) { return std::ranges::find(beside, w) != beside.end(); };
    if (std::ranges::any_of(t, is_beside) && std::ranges::any_of(own, is_same_sheet)) continue;
    push(v, f, (dot(p - a, normal) > 0 ? 1 : -1) / length(normal) * normal);
  }
}

// Pushes the ends of a short edge apart, which could not be collapsed.
void Separation::find_edge_pushes(FaceId f) {
  const Triangle& t = r_.mesh.faces[f].v;
  for (std::size_t i = 0; i < 3; ++i) {
    const VertexId v = t[i], w = t[(i + 1) % 3];
    const Vec3 edge = r_.point(w) - r_.point(v);
    const double size = length(edge);
    if (!(size < gap_)) continue;
    push(v, f, -edge / size);
    push(w, f, edge / size);
  }
}

// Moves v in the direction `along`, to a point of Sigma if one is beside the place; else it stays
// within the gap of where it left Sigma. A vertex on the box stays in its faces, one on a fixed arc
// where it is, and all stay in the box.
bool Separation::move(const Push& push) {
  const VertexId v = push.vertex;
  const FaceId f = push.facet;
  Vec3 along = push.along;
  const BoundaryChain& chain = r_.s.chain;
  const bool is_boundary = chain.is_boundary(v);
  if (is_boundary && r_.curves.is_on_fixed(chain.place(v))) return false;
  const Vec3 from = r_.point(v);
  const Box3 box = r_.surface.volume().box();
  const unsigned faces = is_boundary ? box_faces_at(from, box) : 0;
  for (int axis = 0; axis < 3; ++axis) {
    if ((faces >> (2 * axis) & 3) != 0) along[axis] = 0;
  }
  const double size = length(along), step = kMoveGaps * gap_;
  const Cavity* cavity = size > 0 ? r_.open(r_.star(f, v)) : nullptr;
  if (!cavity) return false;
  Vec3 to = from + step / size * along;
  Vec3 normal;
  for (const Triangle& t : cavity->disk.facets) normal = normal + r_.normal(t);
  const auto foot_of = [&](const Vec3& p, double limit) {
    return is_boundary ? std::nullopt : r_.finder.foot(p, normal, limit, r_.report.searches_refine);
  };
  const std::optional<Vec3> foot = foot_of(to, kBesideShare * step);
  left_from_.resize(r_.mesh.points.size());
  // A block may have moved v off Sigma before, and its place there may be found no more.
  const std::optional<Vec3> home = left_from_[v]       ? left_from_[v]
                                   : is_on_sigma(from) ? std::optional(from)
                                                       : foot_of(from, gap_);
  if (!home) return false;
  to = foot ? *foot : within(to, *home, gap_);
  if (distance(to, from) < kLeastMoveGaps * gap_) return false;
  const Question question(r_, v, Reason::too_near);
  if (!accept(Operation::move, r_.make(cavity->move(v, to, kTopologyGates)))) return false;
  left_from_[v] = foot ? std::nullopt : home;
  return true;
}

}  // namespace

std::vector<FaceId> separate(Refinement& r, const IdArray<VertexId, std::uint8_t>& is_crowded) {
  return Separation(r).run(is_crowded);
}

}  // namespace deliso
