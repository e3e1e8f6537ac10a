// SPDX-License-Identifier: MIT
#include "mesh/tri_mesh.h"

#include <algorithm>
#include <utility>

#include "base/check.h"

namespace deliso {
namespace {

// Side i of facet f, the one opposite corner i, is the half-edge 3 f + i.
struct Side {
  VertexId from, to;
};

Side side_of(const Face& face, std::uint32_t i) {
  return {face.v[(i + 1) % 3], face.v[(i + 2) % 3]};
}

// Links the half-edges of one undirected edge, given as the keys of link_faces.
void link_edge(TriMesh& mesh, std::span<const std::uint64_t> edge, LinkResult& result) {
  const auto half_edge = [](std::uint64_t key) { return static_cast<std::uint32_t>(key); };
  if (edge.size() == 1) {
    ++result.boundary_edges;
    return;
  }
  const std::uint32_t a = half_edge(edge[0]), b = half_edge(edge[1]);
  Face& f = mesh.faces[FaceId(a / 3)];
  Face& g = mesh.faces[FaceId(b / 3)];
  const Side fs = side_of(f, a % 3), gs = side_of(g, b % 3);
  if (edge.size() > 2 || fs.from != gs.to || fs.from == fs.to || a / 3 == b / 3) {
    ++result.non_manifold_edges;
    return;
  }
  f.n[a % 3] = FaceId(b / 3);
  g.n[b % 3] = FaceId(a / 3);
}

}  // namespace

Quad quad_at(const TriMesh& mesh, FaceId f, int i) {
  const Face& face = mesh.faces[f];
  const FaceId g = face.n[i];
  DELISO_ASSERT(g != kNoId);
  const VertexId d = mesh.faces[g].v[neighbor_index(mesh.faces[g], f)];
  return {f, g, face.v[i], face.v[(i + 1) % 3], face.v[(i + 2) % 3], d};
}

QuadSides sides_of(const TriMesh& mesh, const Quad& q) {
  const Face &f = mesh.faces[q.f], &g = mesh.faces[q.g];
  return {f.n[corner_index(f, q.c)], g.n[corner_index(g, q.c)], g.n[corner_index(g, q.b)],
          f.n[corner_index(f, q.b)]};
}

void flip(TriMesh& mesh, IdArray<VertexId, FaceId>& facet, const Quad& q) {
  IdArray<FaceId, Face>& faces = mesh.faces;
  const QuadSides side = sides_of(mesh, q);
  const auto link = [&](FaceId out, VertexId from, FaceId to) {
    if (out != kNoId) faces[out].n[kNextCorner[corner_index(faces[out], from)]] = to;
  };
  faces[q.f] = {{q.a, q.b, q.d}, {side.bd, q.g, side.ab}};
  faces[q.g] = {{q.d, q.c, q.a}, {side.ca, q.f, side.dc}};
  link(side.bd, q.b, q.f);
  link(side.ca, q.c, q.g);
  facet[q.a] = facet[q.b] = facet[q.d] = q.f;
  facet[q.c] = q.g;
}

void facets_around(const TriMesh& mesh, FaceId f, VertexId v, std::vector<FaceId>& star) {
  star.assign(1, f);
  for (std::size_t n = 0; n < star.size(); ++n) {
    const Face& face = mesh.faces[star[n]];
    const int i = corner_index(face, v);
    // A neighbor found before is the facet that the walk came from, or the end of the walk in the
    // other direction: one of the last few.
    const auto recent = static_cast<std::ptrdiff_t>(n - std::min<std::size_t>(n, 2));
    for (const FaceId g : {face.n[(i + 1) % 3], face.n[(i + 2) % 3]}) {
      if (g != kNoId && std::find(star.begin() + recent, star.end(), g) == star.end()) {
        star.push_back(g);
      }
    }
  }
}

LinkResult link_faces(TriMesh& mesh) {
  DELISO_CHECK(mesh.faces.size() <= kNoId / 3);
  // Bucket the half-edges by the smaller end: a counting sort, linear in the mesh.
  std::vector<std::uint32_t> begin(mesh.points.size() + 1, 0);
  for (const Face& face : mesh.faces) {
    if (is_dead(face)) continue;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const Side side = side_of(face, i);
      DELISO_ASSERT(std::max(side.from, side.to) < mesh.points.size());
      ++begin[std::min(side.from, side.to) + 1];
    }
  }
  for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];

  // A key holds the larger end above the half-edge. So a sorted bucket has the half-edges of an
  // edge together, in the order of their ids.
  std::vector<std::uint64_t> keys(begin.back());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    mesh.faces[f].n = {kNoId, kNoId, kNoId};
    if (is_dead(mesh.faces[f])) continue;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const Side side = side_of(mesh.faces[f], i);
      const std::uint64_t larger = std::max(side.from, side.to);
      keys[next[std::min(side.from, side.to)]++] = larger << 32 | (3 * f + i);
    }
  }

  LinkResult result;
  for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
    const std::span bucket(keys.data() + begin[v], keys.data() + begin[v + 1]);
    std::sort(bucket.begin(), bucket.end());
    for (std::size_t i = 0, j; i < bucket.size(); i = j) {
      for (j = i + 1; j < bucket.size() && bucket[j] >> 32 == bucket[i] >> 32;) ++j;
      link_edge(mesh, bucket.subspan(i, j - i), result);
    }
  }
  return result;
}

std::vector<Vec3> TriMesh::world_points() const {
  std::vector<Vec3> world;
  world.reserve(points.size());
  for (const Vec3& p : points) world.push_back(frame.to_world(p));
  return world;
}

std::vector<Triangle> TriMesh::triangles() const {
  std::vector<Triangle> triangles;
  triangles.reserve(faces.size());
  for (const Face& face : faces) triangles.push_back(face.v);
  return triangles;
}

IdArray<VertexId, std::uint8_t> TriMesh::used_vertices() const {
  IdArray<VertexId, std::uint8_t> is_used(points.size(), 0);
  for (const Face& face : faces) {
    if (is_dead(face)) continue;
    for (const VertexId v : face.v) is_used[v] = 1;
  }
  return is_used;
}

TriMesh make_tri_mesh(std::vector<Vec3> points, std::span<const Triangle> triangles) {
  TriMesh mesh;
  mesh.points = std::move(points);
  mesh.faces.reserve(triangles.size());
  for (const Triangle& t : triangles) mesh.faces.push_back({t, {kNoId, kNoId, kNoId}});
  link_faces(mesh);
  return mesh;
}

}  // namespace deliso
