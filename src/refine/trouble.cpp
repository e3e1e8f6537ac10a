// SPDX-License-Identifier: MIT
#include "refine/trouble.h"

#include "base/sorted_list.h"
#include "recover/poles.h"
#include "embedding/self_intersections.h"

namespace deliso {

std::size_t count_unrefined(const Recovered& refined, const Criteria& criteria) {
  const TriMesh& mesh = refined.mesh;
  std::size_t count = 0;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& v = mesh.faces[f].v;
    FacetShape s =
        measure(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.surface_points[f]);
    if (refined.unhit[f]) s.h = s.r;
    count += is_bad(s, facet_pole(refined.pole_heights, v), criteria);
  }
  return count;
}

Trouble find_trouble(const Recovered& refined, const Criteria& criteria, const Volume& volume) {
  const TriMesh& mesh = refined.mesh;
  Trouble trouble;
  const auto voxel_of = [&](const Vec3& p) {
    return voxel_number(volume.dims(), volume.voxel_at(p));
  };

  std::vector<Triangle> triangles;
  triangles.reserve(mesh.faces.size());
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& v = mesh.faces[f].v;
    triangles.push_back(v);
    const Vec3& x = mesh.surface_points[f];
    const FacetShape s = measure(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], x);
    if (!(s.r > criteria.r_min)) continue;
    ++trouble.facets_above_r_min;
    if (!refined.unhit[f] && s.r <= criteria.lambda * s.l && s.h <= criteria.h_over_r * s.r) {
      continue;
    }
    ++trouble.bad_facets;
    for (const VertexId q : v) trouble.voxels.push_back(voxel_of(mesh.points[q]));
    trouble.voxels.push_back(voxel_of(x));
  }

  const TriangleTree tree(mesh.points, triangles);
  for (const auto& [f, g] : self_intersections(mesh.points, triangles, tree)) {
    ++trouble.crossing_pairs;
    for (const FaceId crossing : {f, g}) {
      for (const VertexId q : triangles[crossing]) {
        trouble.crossing_voxels.push_back(voxel_of(mesh.points[q]));
      }
    }
  }
  trouble.voxels.insert(trouble.voxels.end(), trouble.crossing_voxels.begin(),
                        trouble.crossing_voxels.end());
  sort_out(trouble.voxels);
  sort_out(trouble.crossing_voxels);
  return trouble;
}

}  // namespace deliso
