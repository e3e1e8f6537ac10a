// SPDX-License-Identifier: MIT
#include "more/cap/box_caps.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/check.h"
#include "base/sorted_list.h"
#include "base/text.h"
#include "delaunay/hilbert.h"

namespace deliso {

BoxCaps::BoxCaps(const TriMesh& mesh, const Box3& box, const std::array<bool, 8>& corner_inside)
    : mesh_(mesh), box_(box), corner_inside_(corner_inside) {
  collect_boundary();
  if (!failure_.empty()) return;
  for (int f = 0; f < 6; ++f) {
    FaceCap& cap = caps_[f];
    cap.number = f;
    cap.across = f / 2;
    // Counter-clockwise in (u, v) is counter-clockwise seen from outside the box.
    cap.u = (cap.across + (f % 2 == 0 ? 2 : 1)) % 3;
    cap.v = 3 - cap.across - cap.u;
    triangulate(cap);
    if (!failure_.empty()) return;
  }
  number_corners();
  check_sides();
}

void BoxCaps::collect_boundary() {
  double shortest2 = std::numeric_limits<double>::infinity();
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      if (mesh_.faces[f].n[i] != kNoId) continue;
      const VertexId a = mesh_.faces[f].v[(i + 1) % 3], b = mesh_.faces[f].v[(i + 2) % 3];
      const Vec3 &p = mesh_.points[a], &q = mesh_.points[b];
      if (!on_one_face(p, q, box_)) {
        failure_ = text("the edge ", a, "-", b, " of the boundary does not lie on the box");
      }
      edges_.push_back({a, b});
      shortest2 = std::min(shortest2, distance2(p, q));
    }
  }
  if (!edges_.empty()) shortest_ = std::sqrt(shortest2);
}

void BoxCaps::triangulate(FaceCap& cap) {
  const auto drop = [&](const Vec3& p) { return Vec2{p[cap.u], p[cap.v]}; };
  cap.plane = std::make_unique<ConstrainedTriangulation>(drop(box_.lo), drop(box_.hi));
  cap.global.assign(4, kNoId);
  const auto is_here = [&](VertexId v) {
    return (box_faces_at(mesh_.points[v], box_) >> cap.number & 1) != 0;
  };
  std::vector<VertexId> vertices;
  for (const auto& edge : edges_) {
    std::ranges::copy_if(edge, std::back_inserter(vertices), is_here);
  }
  sort_unique(vertices);
  std::vector<Vec3> places;
  places.reserve(vertices.size());
  for (const VertexId v : vertices)
    places.push_back({drop(mesh_.points[v]).x, drop(mesh_.points[v]).y, 0});
  std::vector<VertexId> local(vertices.size());
  for (const std::uint32_t n : biased_hilbert_order(places)) {
    const VertexId v = vertices[n], at = cap.plane->insert({places[n].x, places[n].y});
    if (at == cap.global.size()) cap.global.emplace_back(kNoId);
    if (cap.global[at] != kNoId) {
      failure_ = text("vertices ", cap.global[at], " and ", v, " of the boundary coincide");
      return;
    }
    cap.global[at] = v;
    local[n] = at;
  }

  const auto local_of = [&](VertexId v) {
    return local[static_cast<std::size_t>(std::lower_bound(vertices.begin(), vertices.end(), v) -
                                          vertices.begin())];
  };
  for (const auto& [a, b] : edges_) {
    const unsigned common =
        box_faces_at(mesh_.points[a], box_) & box_faces_at(mesh_.points[b], box_);
    if ((common >> cap.number & 1) == 0) continue;
    // The cap runs along the edge in the opposite direction.
    if (!cap.plane->constrain(local_of(b), local_of(a), Side::inside, Side::outside)) {
      failure_ = text("the edge ", a, "-", b, " of the boundary meets another one");
      return;
    }
  }
  unsigned corner = 0;  // vertex 0 of the plane
  if (cap.number % 2 != 0) corner |= 1u << cap.across;
  if (!mark_inside(*cap.plane, corner_inside_[corner])) {  // unreachable: by our own meshes
    failure_ = text("the boundary of the mesh does not part inside from outside on face ",
                    cap.number, " of the box");
  }
}

// Numbers the inside corners of the box, with one id on all their faces.
void BoxCaps::number_corners() {
  std::array<VertexId, 8> id;
  id.fill(kNoId);
  for (FaceCap& cap : caps_) {
    std::array<bool, 4> used{};
    for (const PlaneTriangle& t : cap.plane->triangles()) {
      for (const VertexId v : t.v) {
        if (t.inside && v < 4) used[v] = true;
      }
    }
    for (VertexId v = 0; v < 4; ++v) {
      if (!used[v] || cap.global[v] != kNoId) continue;
      unsigned corner = 0;
      if (cap.number % 2 != 0) corner |= 1u << cap.across;
      if (v == 1 || v == 2) corner |= 1u << cap.u;
      if (v == 2 || v == 3) corner |= 1u << cap.v;
      if (id[corner] == kNoId) {
        id[corner] = VertexId(mesh_.points.size() + new_points_.size());
        Vec3 p = box_.lo;
        for (int axis = 0; axis < 3; ++axis) {
          if ((corner >> axis & 1) != 0) p[axis] = box_.hi[axis];
        }
        new_points_.push_back(p);
      }
      cap.global[v] = id[corner];
    }
    for (VertexId v = 0; v < cap.global.size(); ++v) {
      if (cap.global[v] == kNoId) continue;
      const unsigned faces = box_faces_at(point(cap.global[v]), box_) & ~(1u << cap.number);
      if (faces != 0) cap.on_sides[cap.global[v]] = v;
    }
  }
}

// Checks that two faces agree about the edge of the box between them: where the inside of one ends
// there, without a boundary edge of the mesh, so does that of the other, in the other direction.
void BoxCaps::check_sides() {
  std::vector<std::array<VertexId, 2>> sides;
  for (const FaceCap& cap : caps_) {
    for (const PlaneTriangle& t : cap.plane->triangles()) {
      for (int i = 0; t.inside && i < 3; ++i) {
        if (t.n[i] != kNoId || t.side[i] != Side::none) continue;
        sides.push_back({cap.global[t.v[(i + 1) % 3]], cap.global[t.v[(i + 2) % 3]]});
      }
    }
  }
  std::ranges::sort(sides);
  for (const auto& [a, b] : sides) {
    if (std::ranges::binary_search(sides, std::array{b, a})) continue;
    failure_ =
        text("faces of the box do not agree what is inside between vertices ", a, " and ", b);
    return;
  }
}

void BoxCaps::split_side(FaceCap& cap, VertexId a, VertexId b) {
  const Vec3 p = point(a), q = point(b);
  const Vec3 middle = 0.5 * (p + q);
  const unsigned others = box_faces_at(p, box_) & box_faces_at(q, box_) & ~(1u << cap.number);
  DELISO_CHECK(std::has_single_bit(others));
  FaceCap* const other = &caps_[static_cast<std::size_t>(std::countr_zero(others))];
  const VertexId a1 = cap.on_sides.at(a), b1 = cap.on_sides.at(b);
  const VertexId a2 = other->on_sides.at(a), b2 = other->on_sides.at(b);
  if (distance2(p, q) < shortest_ * shortest_ || middle == p || middle == q) {
    cap.refiner->keep_side(a1, b1);
    other->refiner->keep_side(b2, a2);
    return;
  }
  const auto v = VertexId(mesh_.points.size() + new_points_.size());
  new_points_.push_back(middle);
  for (const auto& [at, from, to] : {std::tuple{&cap, a1, b1}, std::tuple{other, b2, a2}}) {
    const PlaneEdge e = at->plane->find_edge(from, to);
    const VertexId m = at->plane->split_edge(e, {middle[at->u], middle[at->v]});
    at->global.resize(m + 1, kNoId);
    at->global[m] = v;
    at->on_sides[v] = m;
    at->refiner->add_split(m);
  }
}

void BoxCaps::refine(double lambda) {
  for (FaceCap& cap : caps_) cap.refiner = std::make_unique<RegionRefiner>(*cap.plane, lambda);
  bool again = true;
  while (again) {
    again = false;
    for (FaceCap& cap : caps_) {
      std::vector<std::pair<VertexId, VertexId>> sides;
      cap.refiner->run(sides);
      for (auto v = VertexId(cap.global.size()); v < cap.plane->points().size(); ++v) {
        const Vec2& p = cap.plane->point(v);
        Vec3 q;
        q[cap.across] = cap.number % 2 == 0 ? box_.lo[cap.across] : box_.hi[cap.across];
        q[cap.u] = p.x;
        q[cap.v] = p.y;
        cap.global.emplace_back(mesh_.points.size() + new_points_.size());
        new_points_.push_back(q);
      }
      for (const auto& [a, b] : sides) split_side(cap, cap.global[a], cap.global[b]);
      again |= !sides.empty();
    }
  }
}

std::size_t BoxCaps::refused() const {
  std::size_t sum = 0;
  for (const FaceCap& cap : caps_) sum += cap.refiner ? cap.refiner->refused() : 0;
  return sum;
}

std::vector<Triangle> BoxCaps::triangles() const {
  std::vector<Triangle> triangles;
  for (const FaceCap& cap : caps_) {
    for (const PlaneTriangle& t : cap.plane->triangles()) {
      if (t.inside)
        triangles.push_back({cap.global[t.v[0]], cap.global[t.v[1]], cap.global[t.v[2]]});
    }
  }
  return triangles;
}

}  // namespace deliso
