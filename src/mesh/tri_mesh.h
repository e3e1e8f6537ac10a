// SPDX-License-Identifier: MIT
// A plain triangle mesh: vertices, facets, and for each facet its three neighbors. It knows neither
// tetrahedra nor voxels.
//
// Invariants (check_mesh tests them by these numbers):
//   I1  Every facet has three different vertices, all below the vertex count.
//   I2  n[i] is the other facet at the edge opposite v[i], kNoId if there is none.
//   I3  Orientation is consistent: f and g run along their common edge in opposite directions.
//   I4  An edge belongs to at most two facets.
//   I5  The facets at a vertex form one disk or one half disk (vertex-manifold).
//   I6  All points are finite.
// Facets are counter-clockwise seen from the side where f < kappa.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/frame.h"
#include "base/ids.h"
#include "base/vec3.h"

namespace deliso {

struct Face {
  std::array<VertexId, 3> v;  // corners, counter-clockwise
  std::array<FaceId, 3> n;    // n[i] shares the edge opposite v[i]; kNoId on the boundary
};

// True if Stage 2 removed the facet. It stays in place until remove_dead()
// (surface/surface_mesh.h).
inline bool is_dead(const Face& face) {
  return face.v[0] == kNoId;
}

using Triangle = std::array<VertexId, 3>;

// Returns the triangle of the vertices with these numbers.
constexpr Triangle triangle_of(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return {VertexId(a), VertexId(b), VertexId(c)};
}

struct TriMesh {
  IdArray<VertexId, Vec3> points;
  IdArray<FaceId, Face> faces;
  Frame frame;  // from the points to the world

  // Returns the points in the world, as mesh files have them.
  std::vector<Vec3> world_points() const;
  std::vector<Triangle> triangles() const;
  // Returns for each vertex whether it is a corner of a live facet.
  IdArray<VertexId, std::uint8_t> used_vertices() const;
};

inline constexpr std::array<int, 3> kNextCorner{1, 2, 0}, kPreviousCorner{2, 0, 1};

// Returns the index of the corner of f opposite its neighbor g: f.n[i] == g. pre: they are
// neighbors.
inline int neighbor_index(const Face& f, FaceId g) {
  return f.n[0] == g ? 0 : f.n[1] == g ? 1 : 2;
}

// Returns the index of the corner v of f. pre: v is a corner of f. Without branches: walks around
// vertices call this for each facet.
inline int corner_index(const Face& f, VertexId v) {
  return static_cast<int>(f.v[1] == v) | static_cast<int>(f.v[2] == v) << 1;
}

// Returns the neighbor of f across its edge that ends in its corner v.
inline FaceId& neighbor_at_edge_to(Face& f, VertexId v) {
  return f.n[(corner_index(f, v) + 1) % 3];
}

template <class Id>
bool has_corner(const std::array<Id, 3>& t, Id v) {
  return t[0] == v || t[1] == v || t[2] == v;
}

// Turns the facet so that its first corner is the one with the smallest id.
inline void turn(Face& face) {
  const auto shift = std::ranges::min_element(face.v) - face.v.begin();
  std::rotate(face.v.begin(), face.v.begin() + shift, face.v.end());
  std::rotate(face.n.begin(), face.n.begin() + shift, face.n.end());
}

// The two facets at the edge of f opposite its corner i. Corner a is that one, the edge runs from b
// to c in f, and d is the corner of the facet across it.
struct Quad {
  FaceId f, g;
  VertexId a, b, c, d;

  // Returns the two facets at the other diagonal, from a to d.
  std::array<Triangle, 2> flipped() const { return {{{a, b, d}, {d, c, a}}}; }
};

// Returns the quad at the edge of f opposite its corner i. pre: f has a neighbor there.
Quad quad_at(const TriMesh& mesh, FaceId f, int i);

// The facets across the sides of a quad; kNoId on the boundary.
struct QuadSides {
  FaceId ab, bd, dc, ca;
};
QuadSides sides_of(const TriMesh& mesh, const Quad& q);

// Puts the facets at the other diagonal in the place of the quad's. `facet`: one at each vertex.
void flip(TriMesh& mesh, IdArray<VertexId, FaceId>& facet, const Quad& q);

// Sets `star` to the facets at the corner v of facet f, f first, then by a walk over neighbors.
// pre: neighbors are mutual (I2).
void facets_around(const TriMesh& mesh, FaceId f, VertexId v, std::vector<FaceId>& star);

// Calls visit(facet) for the facets at the corner v of facet `first`, by a walk over neighbors,
// until it returns true. Returns whether one did.
template <class Visit>
bool any_facet_at(const TriMesh& mesh, FaceId first, VertexId v, Visit&& visit) {
  const auto& faces = mesh.faces;
  FaceId f = first;
  do {
    const Face& face = faces[f];
    if (visit(face)) return true;
    f = face.n[kNextCorner[corner_index(face, v)]];
  } while (f != first && f != kNoId);
  if (f == first) return false;
  // The other way, from the boundary.
  const auto before = [&](FaceId g) {
    return faces[g].n[kPreviousCorner[corner_index(faces[g], v)]];
  };
  for (f = before(first); f != kNoId; f = before(f)) {
    if (visit(faces[f])) return true;
  }
  return false;
}

// Sets the neighbors from the corners, in O(V + F) except for vertices of huge degree. An edge of
// more than two facets, or of two that run along it in the same direction, is counted as
// non-manifold. All its facets stay without neighbors there. Dead facets have none. pre: all
// corners of live facets are below the vertex count.
struct LinkResult {
  std::size_t non_manifold_edges = 0;
  std::size_t boundary_edges = 0;
};
LinkResult link_faces(TriMesh& mesh);

// Returns a linked mesh of `triangles` over `points`. Unused vertices are kept.
TriMesh make_tri_mesh(std::vector<Vec3> points, std::span<const Triangle> triangles);

}  // namespace deliso
