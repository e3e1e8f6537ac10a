// SPDX-License-Identifier: MIT
#include "more/planar/constrained_triangulation.h"

#include <deque>

#include "base/check.h"
#include "more/planar/plane_predicates.h"

namespace deliso {

ConstrainedTriangulation::ConstrainedTriangulation(const Vec2& lo, const Vec2& hi)
    : points_{lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}, around_{0, 0, 0, 1}, triangles_(2) {
  triangles_[0].v = {0, 1, 2};
  triangles_[1].v = {0, 2, 3};
  triangles_[0].n = {kNoId, 1, kNoId};
  triangles_[1].n = {kNoId, kNoId, 0};
}

int ConstrainedTriangulation::turn(VertexId a, VertexId b, VertexId c) const {
  return orient2d(points_[a], points_[b], points_[c]);
}

VertexId ConstrainedTriangulation::opposite_corner(FaceId t, int i) const {
  const PlaneTriangle& g = triangles_[triangles_[t].n[i]];
  return g.v[g.n[0] == t ? 0 : g.n[1] == t ? 1 : 2];
}

bool ConstrainedTriangulation::is_delaunay(FaceId t, int i) const {
  const auto& v = triangles_[t].v;
  return incircle(points_[v[0]], points_[v[1]], points_[v[2]], points_[opposite_corner(t, i)]) <= 0;
}

ConstrainedTriangulation::Place ConstrainedTriangulation::locate(const Vec2& p, FaceId from) const {
  FaceId t = from;
  // Among Delaunay triangles such a walk terminates. Beside segments that is not proven, hence the
  // limit.
  for (std::size_t step = 0; step <= triangles_.size(); ++step) {
    const PlaneTriangle& at = triangles_[t];
    std::optional<PlaneEdge> blocked;
    FaceId next = kNoId;
    for (int i = 0; i < 3 && next == kNoId; ++i) {
      if (orient2d(points_[at.v[(i + 1) % 3]], points_[at.v[(i + 2) % 3]], p) >= 0) continue;
      if (may_flip(t, i)) {
        next = at.n[i];
      } else {
        blocked = PlaneEdge{t, i};
      }
    }
    if (next == kNoId) return blocked ? Place{kNoId, blocked} : Place{t, std::nullopt};
    t = next;
  }
  return {};  // unreachable: the walk ends
}

VertexId ConstrainedTriangulation::insert(const Vec2& p) {
  const Place place = locate(p, last_);
  DELISO_CHECK(place.t != kNoId);
  last_ = place.t;
  for (const VertexId v : triangles_[place.t].v) {
    if (points_[v] == p) return v;
  }
  return insert_in(place.t, p);
}

VertexId ConstrainedTriangulation::insert_in(FaceId t, const Vec2& p) {
  for (int i = 0; i < 3; ++i) {
    const auto& v = triangles_[t].v;
    if (orient2d(points_[v[(i + 1) % 3]], points_[v[(i + 2) % 3]], p) == 0) {
      return split_edge({t, i}, p);
    }
  }
  const auto v = VertexId(points_.size());
  points_.push_back(p);
  around_.push_back(t);
  split_triangle(t, v);
  legalize_around(v);
  return v;
}

VertexId ConstrainedTriangulation::split_edge(PlaneEdge edge, const Vec2& p) {
  const auto v = VertexId(points_.size());
  points_.push_back(p);
  around_.push_back(edge.t);
  split_at(edge, v);
  legalize_around(v);
  return v;
}

// Makes g the neighbor of t across the edge opposite i; g had g_was there.
void ConstrainedTriangulation::link(FaceId t, int i, FaceId g, FaceId g_was) {
  triangles_[t].n[i] = g;
  if (g == kNoId) return;
  for (FaceId& n : triangles_[g].n) {
    if (n != g_was) continue;
    n = t;
    return;
  }
}

void ConstrainedTriangulation::split_triangle(FaceId t, VertexId v) {
  const PlaneTriangle old = triangles_[t];
  const auto t1 = FaceId(triangles_.size()), t2 = FaceId(t1 + 1);
  const auto [a, b, c] = old.v;
  triangles_.resize(triangles_.size() + 2);
  triangles_[t] = {{v, b, c}, {kNoId, t1, t2}, {old.side[0], Side::none, Side::none}, old.inside};
  triangles_[t1] = {{v, c, a}, {kNoId, t2, t}, {old.side[1], Side::none, Side::none}, old.inside};
  triangles_[t2] = {{v, a, b}, {kNoId, t, t1}, {old.side[2], Side::none, Side::none}, old.inside};
  link(t, 0, old.n[0], t);
  link(t1, 0, old.n[1], t);
  link(t2, 0, old.n[2], t);
  around_[v] = around_[b] = around_[c] = t;
  around_[a] = t1;
}

void ConstrainedTriangulation::split_at(PlaneEdge edge, VertexId v) {
  const FaceId t = edge.t;
  const int i = edge.i, j = (i + 1) % 3, k = (i + 2) % 3;
  const PlaneTriangle old = triangles_[t];
  const VertexId a = old.v[i], b = old.v[j], c = old.v[k];
  const FaceId g = old.n[i];
  const auto t1 = FaceId(triangles_.size());
  const FaceId g1 = g == kNoId ? FaceId(kNoId) : FaceId(t1 + 1);
  triangles_.resize(triangles_.size() + (g == kNoId ? 1 : 2));
  triangles_[t] = {{v, a, b}, {kNoId, g, t1}, {old.side[k], old.side[i], Side::none}, old.inside};
  triangles_[t1] = {{v, c, a}, {kNoId, t, g1}, {old.side[j], Side::none, old.side[i]}, old.inside};
  link(t, 0, old.n[k], t);
  link(t1, 0, old.n[j], t);
  around_[v] = around_[a] = around_[b] = t;
  around_[c] = t1;
  if (g == kNoId) return;
  const PlaneTriangle far = triangles_[g];
  const int m = far.n[0] == t ? 0 : far.n[1] == t ? 1 : 2;  // corners d, c, b from m on
  const VertexId d = far.v[m];
  const Side side = far.side[m], side_c = far.side[(m + 1) % 3], side_b = far.side[(m + 2) % 3];
  const FaceId beyond_c = far.n[(m + 1) % 3], beyond_b = far.n[(m + 2) % 3];
  triangles_[g] = {{v, b, d}, {kNoId, g1, t}, {side_c, Side::none, side}, far.inside};
  triangles_[g1] = {{v, d, c}, {kNoId, t1, g}, {side_b, side, Side::none}, far.inside};
  link(g, 0, beyond_c, g);
  link(g1, 0, beyond_b, g);
  around_[d] = g;
}

void ConstrainedTriangulation::flip(FaceId t, int i) {
  const FaceId g = triangles_[t].n[i];
  const PlaneTriangle f = triangles_[t], far = triangles_[g];
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  const int m = far.n[0] == t ? 0 : far.n[1] == t ? 1 : 2;
  const VertexId a = f.v[i], b = f.v[j], c = f.v[k], d = far.v[m];
  const int at_c = (m + 1) % 3, at_b = (m + 2) % 3;
  triangles_[t] = {{a, b, d}, {kNoId, g, kNoId}, {far.side[at_c], Side::none, f.side[k]}, f.inside};
  triangles_[g] = {{d, c, a}, {kNoId, t, kNoId}, {f.side[j], Side::none, far.side[at_b]}, f.inside};
  link(t, 0, far.n[at_c], g);
  link(t, 2, f.n[k], t);
  link(g, 0, f.n[j], t);
  link(g, 2, far.n[at_b], g);
  around_[a] = around_[b] = around_[d] = t;
  around_[c] = g;
}

void ConstrainedTriangulation::legalize_around(VertexId v) {
  std::vector<FaceId> stack;
  circulate(v, [&](FaceId t, int) {
    stack.push_back(t);
    return true;
  });
  while (!stack.empty()) {
    const FaceId t = stack.back();
    stack.pop_back();
    const int i = corner(t, v);
    if (!may_flip(t, i) || is_delaunay(t, i)) continue;
    const FaceId g = triangles_[t].n[i];
    flip(t, i);
    stack.push_back(t);
    stack.push_back(g);
  }
}

PlaneEdge ConstrainedTriangulation::find_edge(VertexId a, VertexId b) const {
  PlaneEdge found;
  circulate(a, [&](FaceId t, int i) {
    if (triangles_[t].v[(i + 1) % 3] != b) return true;
    found = {t, (i + 2) % 3};
    return false;
  });
  return found;
}

void ConstrainedTriangulation::legalize(std::vector<std::pair<VertexId, VertexId>> edges) {
  while (!edges.empty()) {
    const auto [a, b] = edges.back();
    edges.pop_back();
    const PlaneEdge e = find_edge(a, b);
    if (e.t == kNoId || !may_flip(e.t, e.i) || is_delaunay(e.t, e.i)) continue;
    const VertexId p = triangles_[e.t].v[e.i], q = opposite_corner(e.t, e.i);
    flip(e.t, e.i);
    edges.insert(edges.end(), {{p, a}, {a, q}, {q, b}, {b, p}});
  }
}

bool ConstrainedTriangulation::constrain(VertexId a, VertexId b, Side left, Side right) {
  const auto mark = [&] {
    const PlaneEdge e = find_edge(a, b), f = find_edge(b, a);
    if (e.t != kNoId) triangles_[e.t].side[e.i] = left;
    if (f.t != kNoId) triangles_[f.t].side[f.i] = right;
    return e.t != kNoId || f.t != kNoId;
  };
  if (mark()) return true;

  // The first edge that a-b crosses; none if there is a vertex on it before.
  PlaneEdge at;
  circulate(a, [&](FaceId t, int i) {
    if (turn(a, b, triangles_[t].v[(i + 1) % 3]) >= 0 ||
        turn(a, b, triangles_[t].v[(i + 2) % 3]) <= 0) {
      return true;
    }
    at = {t, i};
    return false;
  });
  if (at.t == kNoId) return false;
  std::deque<std::pair<VertexId, VertexId>> crossed;
  while (true) {
    const VertexId c = triangles_[at.t].v[(at.i + 1) % 3], d = triangles_[at.t].v[(at.i + 2) % 3];
    if (triangles_[at.t].side[at.i] != Side::none) return false;
    crossed.emplace_back(c, d);
    const VertexId e = opposite_corner(at.t, at.i);
    if (e == b) break;
    const int side = turn(a, b, e);
    if (side == 0) return false;
    // Leave through the edge whose ends lie on different sides.
    const FaceId g = triangles_[at.t].n[at.i];
    at = {g, corner(g, side > 0 ? d : c)};
  }

  std::vector<std::pair<VertexId, VertexId>> new_edges;
  while (!crossed.empty()) {
    const auto [c, d] = crossed.front();
    crossed.pop_front();
    const PlaneEdge e = find_edge(c, d);
    const VertexId p = triangles_[e.t].v[e.i], q = opposite_corner(e.t, e.i);
    if (turn(p, c, q) <= 0 || turn(q, d, p) <= 0) {
      crossed.emplace_back(c, d);
      continue;
    }
    flip(e.t, e.i);
    const bool crosses = p != a && p != b && q != a && q != b && turn(a, b, p) != turn(a, b, q);
    if (crosses) {
      crossed.emplace_back(p, q);
    } else if (!(p == a && q == b) && !(p == b && q == a)) {
      new_edges.emplace_back(p, q);
    }
  }
  DELISO_CHECK(mark());
  legalize(std::move(new_edges));
  return true;
}

}  // namespace deliso
