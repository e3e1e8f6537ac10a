// SPDX-License-Identifier: MIT
#include "deliso/deliso.h"

#include <memory>
#include <utility>

#include "contour/contour.h"
#include "recover/recover.h"
#include "refine/refine.h"
#include "stage1/first_sample.h"
#include "surface/observer.h"

namespace deliso {

// The order of paper Figure 4: InitTriangulation, Recover, Refine. Recover ends with BuildTriMesh,
// so that Refine has no tetrahedra.
SurfaceMesh delaunay_mesh(const Isosurface& surface, ContourMesh& contour,
                          const BoundaryCurves& curves, std::span<const Vec3> samples,
                          const Options& options, const Parameters& parameters, Report& report) {
  Observer* const observer = follower(parameters.observer);
  if (observer) observer->run_begins(parameters, report);
  FirstSample first = init_triangulation(contour, curves, surface.volume(), parameters, report);
  SurfaceMesh mesh = recover(surface, contour, std::move(first), parameters, report);
  if (observer) observer->mesh_handed_over(mesh);
  if (!options.stop_after_recover) {
    refine(mesh, surface, curves, samples, parameters, report);
  }
  if (observer) observer->mesh_finished();
  return mesh;
}

DelaunayMesh delaunay_mesh(const Isosurface& surface, ContourMesh contour, const Options& options,
                           const Parameters& parameters, Report& report) {
  make_fine(contour, surface, parameters, report);
  keep_components(contour, chosen_components(contour.summary, parameters.components));
  const BoundaryCurves curves(surface,
                              std::make_shared<const BoundaryLoops>(boundary_loops(contour)));
  SurfaceMesh mesh =
      delaunay_mesh(surface, contour, curves, contour.points, options, parameters, report);
  return {std::move(mesh), curves, std::move(contour.points)};
}

}  // namespace deliso
