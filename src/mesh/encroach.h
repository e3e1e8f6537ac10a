// SPDX-License-Identifier: MIT
// Stage 2's insertion (paper §2.2.2, Figure 3): the disk E of facets whose surface balls hold the
// new point p, found by walking from one of them, and its replacement by D, the cone from p over
// the boundary of E.
//
// E is good when its facets form a disk with every vertex on its rim, once each; coning over such a
// rim keeps I1..I5 of tri_mesh.h and changes neither Euler number nor components.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesh/tri_mesh.h"

namespace deliso {

// An edge of the rim of E, from -> to as the facet of E runs along it. `outside` is the facet
// beyond (kNoId on the mesh's boundary) and `inside` the facet of E.
struct RimEdge {
  VertexId from, to;
  FaceId outside, inside;
};

// Reused from insertion to insertion to save allocations.
struct EncroachedDisk {
  std::vector<FaceId> faces;
  std::vector<RimEdge> rim;  // in no particular order
};

// Is p strictly inside the surface ball of f, i.e. nearer to its surface point than its corners?
inline bool is_encroached(const TriMesh& mesh, FaceId f, const Vec3& p) {
  const Vec3& x = mesh.surface_points[f];
  return distance2(x, p) < distance2(x, mesh.points[mesh.faces[f].v[0]]);
}

// E, walking from `start` (counted as encroached) over encroached neighbours. `marks` is scratch:
// one stamp per facet, `stamp` different from all in use. Returns false when E is not good.
bool find_encroached_disk(const TriMesh& mesh, FaceId start, const Vec3& p,
                          std::vector<std::uint32_t>& marks, std::uint32_t stamp,
                          EncroachedDisk& disk);

// Takes E out and puts in the cone from p over its rim, less the rim edge numbered `opened` (a
// boundary edge on which p lies, split by it), if any. surface_points[k] belongs to the new facet
// on rim[k]. Facet ids of E are reused, the rest appended: `created[k]` is the facet on rim[k]
// (kNoId for `opened`). Returns p's id.
VertexId replace_disk(TriMesh& mesh, const EncroachedDisk& disk, const Vec3& p,
                      std::span<const Vec3> surface_points, std::optional<std::size_t> opened,
                      std::vector<FaceId>& created);

}  // namespace deliso
