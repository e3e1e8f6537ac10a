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
  const VertexId b = face.v[(i + 1) % 3], c = face.v[(i + 2) % 3];
  VertexId d = kNoId;
  for (const VertexId v : mesh.faces[g].v) {
    if (v != b && v != c) d = v;
  }
  return {f, g, face.v[i], b, c, d};
}

VertexId split_edge(TriMesh& mesh, FaceId f, int i, const Vec3& p) {
  const auto m = VertexId(mesh.points.size());
  mesh.points.push_back(p);
  // In facet g, if there is one, replaces the neighbor `was` by `now`.
  const auto replace_neighbor = [&](FaceId g, FaceId was, FaceId now) {
    if (g != kNoId) mesh.faces[g].n[neighbor_index(mesh.faces[g], was)] = now;
  };
  const Face near = mesh.faces[f];
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  const VertexId a = near.v[i], b = near.v[j], c = near.v[k];
  const FaceId g = near.n[i], f1 = FaceId(mesh.faces.size());
  const FaceId g1 = g == kNoId ? FaceId(kNoId) : FaceId(f1 + 1);
  mesh.faces[f] = {{a, b, m}, {g, f1, near.n[k]}};
  mesh.faces.push_back({{a, m, c}, {g1, near.n[j], f}});
  replace_neighbor(near.n[j], f, f1);
  if (g == kNoId) return m;
  const Face far = mesh.faces[g];
  const int d = neighbor_index(far, f);  // corners d, c, b from there on
  const FaceId beyond_c = far.n[(d + 1) % 3], beyond_b = far.n[(d + 2) % 3];
  mesh.faces[g] = {{far.v[d], m, b}, {f, beyond_c, g1}};
  mesh.faces.push_back({{far.v[d], c, m}, {f1, g, beyond_b}});
  replace_neighbor(beyond_b, g, g1);
  return m;
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

TriMesh make_tri_mesh(std::vector<Vec3> points, std::span<const Triangle> triangles) {
  TriMesh mesh;
  mesh.points = std::move(points);
  mesh.faces.reserve(triangles.size());
  for (const Triangle& t : triangles) mesh.faces.push_back({t, {kNoId, kNoId, kNoId}});
  link_faces(mesh);
  return mesh;
}

}  // namespace deliso
