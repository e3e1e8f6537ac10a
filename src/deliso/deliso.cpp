// SPDX-License-Identifier: MIT
#include "deliso/deliso.h"

#include <memory>
#include <utility>

#include "base/stopwatch.h"
#include "coarsen/coarsen.h"
#include "coarsen/contour_as_mesh.h"
#include "contour/contour.h"
#include "contour/fine_contour.h"
#include "contour/plain_seams.h"
#include "refine/refine.h"
#include "surface/observer.h"

namespace deliso {

void make_fine(ContourMesh& contour, const Isosurface& surface, const Parameters& parameters,
               Report& report) {
  begin_stage(parameters.observer, "cutting");
  const StepTimer timer(report.seconds_contour);
  contour = fine_contour(std::move(contour), surface.volume(), surface.kappa());
  make_seams_plain(contour, surface.volume());
  report[Counter::voxels_cut] = contour.split_voxels;
  report[Counter::voxels_crossed] = contour.crossed_voxels;
}

SurfaceMesh delaunay_mesh(ContourMesh& contour, std::span<const Vec3> samples,
                          const Options& options, const Given& given) {
  Observer* const observer = follower(given.parameters.observer);
  if (observer) observer->run_begins(given.parameters, given.report);
  SurfaceMesh mesh = contour_as_mesh(contour);
  contour.triangles = std::vector<Triangle>();
  if (observer) observer->contour_ready(mesh);
  coarsen(mesh, given);
  if (observer) observer->mesh_handed_over(mesh);
  if (!options.stop_after_stage1) {
    refine(mesh, samples, given);
  }
  if (observer) observer->mesh_finished();
  return mesh;
}

DelaunayMesh delaunay_mesh(const Isosurface& surface, ContourMesh contour, const Options& options,
                           const Parameters& parameters, Report& report) {
  make_fine(contour, surface, parameters, report);
  keep_components(contour, chosen_components(contour.summary, parameters.components));
  const BoundaryCurves curves(
      surface, std::make_shared<const BoundaryLoops>(std::move(contour.boundary.loops)));
  SurfaceMesh mesh =
      delaunay_mesh(contour, contour.points, options, {surface, curves, parameters, report});
  return {std::move(mesh), curves, std::move(contour.points)};
}

}  // namespace deliso
