// SPDX-License-Identifier: MIT
#include "refine/collapse.h"

#include <algorithm>
#include <cmath>

#include "base/sorted_list.h"

namespace deliso {
namespace {

// How much worse the worst facet there may become: where three vertices are close to each other,
// the first of two collapses leaves a needle as bad as the one it takes.
constexpr double kWorse = 2;

}  // namespace

Collapser::Collapser(SurfaceMesh& surface_mesh, DiskReplacer& replacer, const Judge& judge,
                     const Isosurface& surface, const BoundaryCurves& curves,
                     const Parameters& parameters, std::size_t of_stage1)
    : s_(surface_mesh),
      mesh_(surface_mesh.mesh),
      replacer_(replacer),
      judge_(judge),
      box_(surface.volume().box()),
      curves_(curves),
      parameters_(parameters),
      of_stage1_(of_stage1) {}

// Whether the mesh, and the chain, can do without v.
bool Collapser::may_go(VertexId v) const {
  if (v >= of_stage1_) return false;
  if (!s_.chain.is_boundary(v)) return true;
  const VertexId next = s_.chain.next(v), before = s_.chain.previous(v);
  return !curves_.is_kept(s_.chain.place(v)) &&
         s_.chain.next(s_.chain.next(next)) != v &&  // a loop of three
         !curves_.runs_beside_seam(s_.chain.place(before), mesh_.points[before],
                                   s_.chain.place(next), mesh_.points[next]);
}

bool Collapser::take_out(FaceId f, VertexId v, bool at_any_cost) {
  least_cosine_ = at_any_cost ? -1 : kSharpest;
  change_.leaves_box = at_any_cost;
  const auto merge_into = [&](VertexId to) {
    return !replacer_.count(Rung::collapse, change_, merge(f, v, to, [] { return true; }));
  };
  const VertexId next = s_.chain.next(v), before = s_.chain.previous(v);
  return merge_into(before) || merge_into(next);
}

// Whether v and w would be joined within a face of the box by an edge that is not of its boundary.
bool Collapser::joins_on_box(VertexId v, VertexId w) const {
  if (!s_.chain.is_boundary(v) || !s_.chain.is_boundary(w) || s_.chain.is_edge(v, w)) return false;
  const Vec3 &p = mesh_.points[v], &q = mesh_.points[w];
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] == q[axis] && (p[axis] == box_.lo[axis] || p[axis] == box_.hi[axis])) return true;
  }
  return false;
}

double Collapser::worst_ratio(std::span<const Triangle> facets) const {
  double worst = 0;
  for (const Triangle& v : facets) {
    const Vec3 &a = mesh_.points[v[0]], &b = mesh_.points[v[1]], &c = mesh_.points[v[2]];
    worst =
        std::max(worst, distance(circumcenter(a, b, c), a) / std::sqrt(shortest_edge2(a, b, c)));
  }
  return worst;
}

bool Collapser::collapse(FaceId f) {
  const Triangle v = mesh_.faces[f].v;
  const double limit = parameters_.r_min;
  if (worst_ratio({&v, 1}) <= parameters_.refinement[Criterion::r_over_l]) return false;
  VertexId a = kNoId, b = kNoId;
  double shortest2 = limit * limit;
  for (std::size_t i = 0; i < 3; ++i) {
    const double l2 = distance2(mesh_.points[v[i]], mesh_.points[v[(i + 1) % 3]]);
    if (l2 >= shortest2) continue;
    shortest2 = l2;
    a = v[i];
    b = v[(i + 1) % 3];
  }
  if (a == kNoId) return false;
  // Of a boundary edge either end, of others the inner end.
  if (s_.chain.is_boundary(a)) std::swap(a, b);
  for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
    const auto gains = [&] {
      const double before = worst_ratio(change_.was.facets);
      return before > parameters_.refinement[Criterion::r_over_l] &&
             worst_ratio(change_.in.facets) <= kWorse * before;
    };
    if (!replacer_.count(Rung::collapse, change_, merge(f, from, to, gains))) return true;
  }
  return false;
}

bool Collapser::take_out_corner(FaceId f) {
  const Triangle corners = mesh_.faces[f].v;
  const auto cost = [&](const Triangle& v, const Dual& dual) {
    return judge_.cost_of_shape(v, dual) + judge_.cost_of_ball(v, dual);
  };
  std::vector<FaceId> star;
  for (const VertexId from : corners) {
    if (!may_go(from)) continue;
    facets_around(mesh_, f, from, star);
    double before = 0;
    for (const FaceId g : star) before += cost(mesh_.faces[g].v, s_.duals[g]);
    if (before == 0) continue;
    std::vector<VertexId> around;
    for (const FaceId g : star) {
      for (const VertexId q : mesh_.faces[g].v) {
        if (q != from) around.push_back(q);
      }
    }
    sort_out(around);
    for (const VertexId to : around) {
      const auto gains = [&] {
        double after = 0;
        for (std::size_t k = 0; k < change_.duals.size() && after < before; ++k) {
          after += cost(change_.in.facets[k], change_.duals[k]);
        }
        return after < before;
      };
      if (!replacer_.count(Rung::collapse, change_, merge(f, from, to, gains))) return true;
    }
  }
  return false;
}

template <class Gains>
std::optional<Refusal> Collapser::merge(FaceId f, VertexId from, VertexId to, Gains&& gains) {
  if (!may_go(from)) return Refusal::boundary;
  const bool on_boundary = s_.chain.is_boundary(from);
  if (on_boundary && !s_.chain.is_edge(from, to)) return Refusal::boundary;
  facets_around(mesh_, f, from, change_.out);
  if (!replacer_.mark_old(change_)) return Refusal::not_a_disk;
  change_.in.facets.clear();
  for (const Triangle& t : change_.was.facets) {
    if (has_corner(t, to)) continue;
    Triangle changed = t;
    for (VertexId& q : changed) {
      if (q == from) {
        q = to;
      } else if (!on_boundary && joins_on_box(to, q)) {
        return Refusal::boundary;
      }
    }
    change_.in.facets.push_back(changed);
  }
  if (change_.in.facets.empty()) return Refusal::not_a_disk;
  change_.least_cosine = least_cosine_;
  const auto refusal = replacer_.replace(change_, gains);
  if (!refusal && on_boundary) s_.chain.remove(from);
  return refusal;
}

}  // namespace deliso
