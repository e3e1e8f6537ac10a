// SPDX-License-Identifier: MIT
#include "deliso/deliso.h"

#include <memory>
#include <utility>

#include "contour/contour.h"
#include "paper/recover.h"
#include "recover/recover.h"
#include "refine/refine.h"
#include "stage1/first_sample.h"
#include "surface/observer.h"

namespace deliso {

// Figure 4: InitTriangulation, Recover, Refine. Recover is certified on the contour, or it is the
// paper's (Figure 5). It ends with BuildTriMesh, so that Refine has no tetrahedra.
SurfaceMesh delaunay_mesh(const Isosurface& surface, ContourMesh& contour,
                          const BoundaryCurves& curves, std::span<const Vec3> samples,
                          const Options& options, const Parameters& parameters, Report& report) {
  Observer* const observer = follower(parameters.observer);
  if (observer) observer->run_begins(parameters, report);
  FirstSample first = init_triangulation(contour, curves, surface.volume(), parameters, report);
  SurfaceMesh mesh = options.recover == RecoverWay::certified
                         ? recover(surface, contour, std::move(first), parameters, report)
                         : recover_paper(surface, curves, std::move(first), parameters,
                                         options.single_stage, report);
  if (observer) observer->mesh_handed_over(mesh);
  if (!options.stop_after_recover && !options.single_stage) {
    refine(mesh, surface, curves, samples, parameters, report);
  }
  if (observer) observer->mesh_finished();
  return mesh;
}

DelaunayMesh delaunay_mesh(const Isosurface& surface, ContourMesh contour, const Options& options,
                           const Parameters& parameters, Report& report) {
  if (options.recover == RecoverWay::certified) make_fine(contour, surface, parameters, report);
  keep_components(contour, chosen_components(contour.summary, parameters.components));
  const BoundaryCurves curves(surface,
                              std::make_shared<const BoundaryLoops>(boundary_loops(contour)));
  SurfaceMesh mesh =
      delaunay_mesh(surface, contour, curves, contour.points, options, parameters, report);
  return {std::move(mesh), curves, std::move(contour.points)};
}

}  // namespace deliso
