// SPDX-License-Identifier: MIT
#include "mesh/encroach.h"

#include "base/check.h"

namespace deliso {
namespace {

// Every vertex of the rim starts just one of its edges.
bool is_simple(std::span<const RimEdge> rim) {
  for (std::size_t i = 0; i < rim.size(); ++i) {
    for (std::size_t j = i + 1; j < rim.size(); ++j) {
      if (rim[i].from == rim[j].from) return false;
    }
  }
  return true;
}

}  // namespace

bool find_encroached_disk(const TriMesh& mesh, FaceId start, const Vec3& p,
                          std::vector<std::uint32_t>& marks, std::uint32_t stamp,
                          EncroachedDisk& disk) {
  disk.faces.assign(1, start);
  disk.rim.clear();
  marks[start] = stamp;
  for (std::size_t next = 0; next < disk.faces.size(); ++next) {
    const FaceId f = disk.faces[next];
    for (const FaceId g : mesh.faces[f].n) {
      if (g == kNoId || marks[g] == stamp || !is_encroached(mesh, g, p)) continue;
      marks[g] = stamp;
      disk.faces.push_back(g);
    }
  }
  for (const FaceId f : disk.faces) {
    const Face& face = mesh.faces[f];
    for (int i = 0; i < 3; ++i) {
      const FaceId g = face.n[i];
      if (g != kNoId && marks[g] == stamp) continue;
      disk.rim.push_back({face.v[(i + 1) % 3], face.v[(i + 2) % 3], g, f});
    }
  }
  // |E| + 2 rim edges: the facets hang together like a tree, so no vertex lies inside E.
  return disk.rim.size() == disk.faces.size() + 2 && is_simple(disk.rim);
}

VertexId replace_disk(TriMesh& mesh, const EncroachedDisk& disk, const Vec3& p,
                      std::span<const Vec3> surface_points, std::optional<std::size_t> opened,
                      std::vector<FaceId>& created) {
  const VertexId v = static_cast<VertexId>(mesh.points.size());
  mesh.points.push_back(p);

  created.assign(disk.rim.size(), kNoId);
  std::size_t reused = 0;
  for (std::size_t k = 0; k < disk.rim.size(); ++k) {
    if (k == opened) continue;
    if (reused < disk.faces.size()) {
      created[k] = disk.faces[reused++];
    } else {
      created[k] = static_cast<FaceId>(mesh.faces.size());
      mesh.faces.emplace_back();
      mesh.surface_points.emplace_back();
    }
  }
  DELISO_ASSERT(reused == disk.faces.size());

  // New facet on rim edge (from, to) is (from, to, v); its neighbours across v share `to` or
  // `from`.
  for (std::size_t k = 0; k < disk.rim.size(); ++k) {
    if (created[k] == kNoId) continue;
    const RimEdge& edge = disk.rim[k];
    FaceId after = kNoId, before = kNoId;
    for (std::size_t m = 0; m < disk.rim.size(); ++m) {
      if (disk.rim[m].from == edge.to) after = created[m];
      if (disk.rim[m].to == edge.from) before = created[m];
    }
    mesh.faces[created[k]] = {{edge.from, edge.to, v}, {after, before, edge.outside}};
    mesh.surface_points[created[k]] = surface_points[k];
    if (edge.outside == kNoId) continue;
    Face& outside = mesh.faces[edge.outside];
    for (int i = 0; i < 3; ++i) {
      if (outside.v[(i + 1) % 3] == edge.to && outside.v[(i + 2) % 3] == edge.from) {
        outside.n[i] = created[k];
      }
    }
  }
  return v;
}

}  // namespace deliso
