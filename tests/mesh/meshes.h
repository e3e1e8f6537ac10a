// SPDX-License-Identifier: MIT
// Tiny named meshes and seeded random ones, for the tests of src/mesh.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "base/random.h"
#include "mesh/tri_mesh.h"

namespace deliso::test {

using Triangles = std::vector<Triangle>;

// Points in general position: all distinct, no three on a line.
inline std::vector<Vec3> some_points(std::size_t n) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i);
    points.push_back({t, t * t, t * t * t});
  }
  return points;
}

inline TriMesh mesh_of(const Triangles& triangles) {
  VertexId last = 0;
  for (const Triangle& t : triangles) last = std::max({last, t[0], t[1], t[2]});
  return make_tri_mesh(some_points(triangles.empty() ? 0 : last + 1), triangles);
}

inline Triangles triangles_of(const TriMesh& mesh) {
  Triangles triangles;
  for (const Face& face : mesh.faces) triangles.push_back(face.v);
  return triangles;
}

// The same points and facets, in the same order, and adjacent to the same facets.
inline bool same_mesh(const TriMesh& a, const TriMesh& b) {
  return a.points == b.points &&
         std::ranges::equal(a.faces, b.faces,
                            [](const Face& f, const Face& g) { return f.v == g.v && f.n == g.n; });
}

// Returns how often the triangles go around p: the sum of their solid angles (Van Oosterom and
// Strackee 1983) over that of the sphere.
inline double winding_number(std::span<const Vec3> points, const Triangles& triangles,
                             const Vec3& p) {
  double angles = 0;
  for (const Triangle& t : triangles) {
    const Vec3 a = points[t[0].number()] - p, b = points[t[1].number()] - p,
               c = points[t[2].number()] - p;
    const double la = length(a), lb = length(b), lc = length(c);
    angles += 2 * std::atan2(dot(a, cross(b, c)),
                             la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angles / (4 * std::numbers::pi);
}

inline Triangles tetrahedron() {
  return {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
}

inline Triangles octahedron() {
  return {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
}

// n x m squares of two triangles, both directions closed: a torus for n, m >= 3.
inline Triangles torus_grid(std::uint32_t n, std::uint32_t m) {
  Triangles triangles;
  const auto id = [=](std::uint32_t i, std::uint32_t j) { return (i % n) + n * (j % m); };
  for (std::uint32_t j = 0; j < m; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      triangles.push_back(triangle_of(id(i, j), id(i + 1, j), id(i + 1, j + 1)));
      triangles.push_back(triangle_of(id(i, j), id(i + 1, j + 1), id(i, j + 1)));
    }
  }
  return triangles;
}

// n triangles around vertex 0, closed (n >= 3).
inline Triangles one_ring(std::uint32_t n) {
  Triangles triangles;
  for (std::uint32_t i = 0; i < n; ++i) triangles.push_back(triangle_of(0, 1 + i, 1 + (i + 1) % n));
  return triangles;
}

// The triangles of one_ring(n) but the last: vertex 0 is on the boundary.
inline Triangles fan(std::uint32_t n) {
  Triangles triangles = one_ring(n + 1);
  triangles.pop_back();
  return triangles;
}

// Three squares: 3 4 5
//                0 1 2 -> the square over 1 2 is missing.
inline Triangles l_shape() {
  return {{0, 1, 4}, {0, 4, 3}, {3, 4, 7}, {3, 7, 6}, {1, 2, 5}, {1, 5, 4}};
}

// A ring of triangles between two triangles' corners, open at both ends: an annulus.
inline Triangles annulus() {
  return {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
}

// Two tetrahedra that share vertex 0 alone.
inline Triangles hourglass() {
  Triangles triangles = tetrahedron();
  for (Triangle t : tetrahedron()) {
    for (VertexId& v : t) v = VertexId(v == 0 ? 0 : v + 3);
    triangles.push_back(t);
  }
  return triangles;
}

// Two triangles that share vertex 0 alone.
inline Triangles bow_tie() {
  return {{0, 1, 2}, {0, 3, 4}};
}

// Five triangles in a strip closed with a half turn; no orientation of it is consistent.
inline Triangles moebius_strip() {
  return {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 0, 4}, {4, 0, 1}};
}

inline Triangles fan_of_three_on_an_edge() {
  return {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
}

inline Triangles duplicated_facet() {
  Triangles triangles = octahedron();
  triangles.push_back(triangles[3]);
  return triangles;
}

inline Triangles flipped_facet() {
  Triangles triangles = octahedron();
  std::swap(triangles[3][0], triangles[3][1]);
  return triangles;
}

// One triangle and its back: every edge is right, no vertex has a disk.
inline Triangles pillow() {
  return {{0, 1, 2}, {0, 2, 1}};
}

// Two octahedra.
inline Triangles two_spheres() {
  Triangles triangles = octahedron();
  for (Triangle t : octahedron()) {
    for (VertexId& v : t) v = VertexId(v + 6);
    triangles.push_back(t);
  }
  return triangles;
}

// A mesh that starts as `triangles` and is changed by moves that keep its topology.
class RandomMesh {
 public:
  RandomMesh(const Triangles& triangles, std::uint64_t seed)
      : mesh_(mesh_of(triangles)), random_(seed) {}

  // Makes one random move: a facet split in three, an edge with its two facets split in four, or an
  // edge flipped (unless the new edge exists). Boundary edges are left alone.
  void change() {
    Triangles t = triangles();
    const FaceId f(random_.below(static_cast<std::uint32_t>(t.size())));
    const int i = static_cast<int>(random_.below(3));
    const FaceId g = mesh_.faces[f].n[i];
    const VertexId a = t[f][i], b = t[f][(i + 1) % 3], c = t[f][(i + 2) % 3];
    const VertexId p = VertexId(mesh_.points.size());
    switch (random_.below(3)) {
      case 0:
        t[f] = {p, a, b};
        t.push_back({p, b, c});
        t.push_back({p, c, a});
        break;
      case 1: {
        if (g == kNoId) return;
        const VertexId d = mesh_.faces[g].v[neighbor_index(mesh_.faces[g], f)];
        t[f] = {p, c, a};
        t[g] = {p, a, b};
        t.push_back({p, b, d});
        t.push_back({p, d, c});
        break;
      }
      default: {
        if (g == kNoId) return;
        const Quad q = quad_at(mesh_, f, i);
        if (q.a == q.d || has_edge(q.a, q.d)) return;
        IdArray<VertexId, FaceId> facet(mesh_.points.size(), kNoId);
        for (FaceId h = 0; h < t.size(); ++h) facet[t[h][0]] = facet[t[h][1]] = facet[t[h][2]] = h;
        flip(mesh_, facet, q);
        for (const VertexId v : {q.a, q.b, q.c, q.d}) {
          facets_are_right_ &= has_corner(mesh_.faces[facet[v]].v, v);
        }
        return;
      }
    }
    std::size_t vertices = mesh_.points.size();
    for (const Triangle& u : t)
      vertices = std::max<std::size_t>(vertices, *std::max_element(u.begin(), u.end()) + 1);
    mesh_ = make_tri_mesh(some_points(vertices), t);
  }

  const TriMesh& mesh() const { return mesh_; }
  // True if every flip left each vertex a facet that has it.
  bool facets_are_right() const { return facets_are_right_; }
  Random& random() { return random_; }
  Triangles triangles() const { return triangles_of(mesh_); }
  bool has_edge(VertexId a, VertexId b) const {
    for (const Face& face : mesh_.faces) {
      const auto has = [&](VertexId v) {
        return std::find(face.v.begin(), face.v.end(), v) != face.v.end();
      };
      if (has(a) && has(b)) return true;
    }
    return false;
  }

 private:
  TriMesh mesh_;
  Random random_;
  bool facets_are_right_ = true;
};

// Replaces facet f by three facets around a new vertex at p.
inline void split_facet(TriMesh& mesh, FaceId f, const Vec3& p) {
  Triangles triangles = triangles_of(mesh);
  const auto [a, b, c] = triangles[f];
  const auto v = VertexId(mesh.points.size());
  triangles[f] = {a, b, v};
  triangles.insert(triangles.end(), {{b, c, v}, {c, a, v}});
  mesh.points.push_back(p);
  mesh = make_tri_mesh(std::move(mesh.points), triangles);
}

// Splits the edge of f opposite its corner i at p.
inline void split_edge(TriMesh& mesh, FaceId f, int i, const Vec3& p) {
  const VertexId b = mesh.faces[f].v[(i + 1) % 3], c = mesh.faces[f].v[(i + 2) % 3];
  const auto v = VertexId(mesh.points.size());
  Triangles triangles;
  for (const Face& face : mesh.faces) {
    if (!has_corner(face.v, b) || !has_corner(face.v, c)) {
      triangles.push_back(face.v);
      continue;
    }
    for (const VertexId end : {b, c}) {
      triangles.push_back(face.v);
      std::ranges::replace(triangles.back(), end, v);
    }
  }
  mesh.points.push_back(p);
  mesh = make_tri_mesh(std::move(mesh.points), triangles);
}

}  // namespace deliso::test
