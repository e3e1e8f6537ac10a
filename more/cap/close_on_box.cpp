// SPDX-License-Identifier: MIT
#include "more/cap/close_on_box.h"

#include "base/stopwatch.h"
#include "base/text.h"
#include "mesh/tri_mesh.h"
#include "more/cap/box_caps.h"

namespace deliso {

std::array<bool, 8> corners_inside(const Volume& volume, double kappa) {
  const Index3 last = volume.voxels();
  std::array<bool, 8> inside;
  for (int m = 0; m < 8; ++m) {
    const auto at = [&](int axis) { return (m >> axis & 1) != 0 ? last[axis] : 0; };
    inside[m] = volume.sample(at(0), at(1), at(2)) >= kappa;
  }
  return inside;
}

void close_on_box(SurfaceMesh& s, const std::array<bool, 8>& inside, const Given& given) {
  Report& report = given.report;
  const StepTimer timer(report.seconds_cap);
  TriMesh& mesh = s.mesh;
  CapReport& result = report.cap;
  result.surface_vertices = mesh.points.size();
  result.surface_triangles = mesh.faces.size();
  BoxCaps caps(mesh, given.surface.volume().box(), inside);
  result.failure = caps.failure();
  if (!result.failure.empty()) return;
  caps.refine(given.parameters.refinement[Criterion::r_over_l]);
  report[Counter::cap_refused] += caps.refused();
  const std::vector<Triangle> triangles = caps.triangles();
  mesh.points.insert(mesh.points.end(), caps.new_points().begin(), caps.new_points().end());
  for (const Triangle& t : triangles) mesh.faces.push_back({t, {kNoId, kNoId, kNoId}});
  const LinkResult links = link_faces(mesh);
  if (links.boundary_edges + links.non_manifold_edges > 0) {  // unreachable: by our own meshes
    result.failure = text(links.boundary_edges, " edges stay open, ", links.non_manifold_edges,
                          " are no manifold");
  }
}

}  // namespace deliso
