// SPDX-License-Identifier: MIT
#include "support/examine.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "check/check_mesh.h"
#include "isosurface/isosurface.h"
#include "run/criteria.h"
#include "surface/surface_point.h"

namespace deliso {

Examined examine(const TriMesh& mesh, const OpenedDataset& opened, const ContourSummary& exact,
                 double kappa, double lambda, double epsilon1, double r_min) {
  const Isosurface surface(opened.volume, kappa);
  SurfacePointFinder finder(surface);
  SearchCounters counters;
  Examined out;
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    const Triangle& v = mesh.faces[f].v;
    const Vec3 &a = mesh.points[v[0]], &b = mesh.points[v[1]], &c = mesh.points[v[2]];
    const Dual dual = finder.dual(a, b, c, counters);
    FacetShape s = measure(a, b, c, dual.center);
    if (!dual.on_surface) s.h = s.r;
    if (!(s.r > r_min)) continue;
    out.over_lambda += s.r > lambda * s.l;
    out.over_h_over_r += s.h > epsilon1 * s.r;
  }

  using Kind = std::pair<std::int64_t, std::uint64_t>;  // Euler number, boundary loops
  const MeshTopology topology = mesh_topology(mesh);
  std::vector<Kind> kinds, exact_kinds;
  for (const ComponentTopology& c : topology.components) {
    kinds.emplace_back(c.euler(), c.boundary_loops);
  }
  for (const ContourComponent& c : exact.components) {
    exact_kinds.emplace_back(c.euler, c.boundary_loops);
  }
  std::sort(kinds.begin(), kinds.end());
  std::sort(exact_kinds.begin(), exact_kinds.end());
  out.components = kinds.size();
  out.euler = topology.euler();
  out.topology_exact = kinds == exact_kinds;
  return out;
}

ContourSummary exact_topology(const OpenedDataset& opened) {
  return summarize_contour(opened.volume,
                           geometric_isovalue(opened.volume.type(), opened.isovalue));
}

}  // namespace deliso
