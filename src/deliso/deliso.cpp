// SPDX-License-Identifier: MIT
#include "deliso/deliso.h"

#include <algorithm>

#include "blocks/choose_seam.h"
#include "blocks/clear_seam.h"
#include "contour/contour.h"
#include "contour/keep_components.h"
#include "paper/recover.h"
#include "recover/recover.h"
#include "refine/refine.h"
#include "stage1/first_sample.h"
#include "surface/observer.h"

namespace deliso {

// Figure 4: InitTriangulation, Recover, Refine. Recover is certified on the fine contour, or it is
// the paper's (Figure 5). It ends with BuildTriMesh, so that Refine has no tetrahedra.
DelaunayMesh delaunay_mesh(const Isosurface& surface, ContourMesh&& contour, const Options& options,
                           const Parameters& parameters, Report& report) {
  const bool is_certified = options.recover == RecoverWay::certified;
  if (is_certified) make_fine(contour, surface, parameters, report);
  const std::vector<std::uint8_t> kept =
      parameters.kept.empty() ? chosen_components(contour.summary, parameters.components)
                              : parameters.kept;
  report[Counter::components_skipped] = static_cast<std::uint64_t>(std::ranges::count(kept, 0));
  keep_components(contour, kept);
  BoundaryCurves curves = boundary_curves(surface, contour, parameters);

  FirstSample first = init_triangulation(contour, curves, surface.volume(), parameters, report);
  SurfaceMesh mesh = is_certified ? recover(surface, contour, std::move(first), parameters, report)
                                  : recover_paper(surface, curves, std::move(first), parameters,
                                                  options.single_stage, report);
  clear_seam(mesh, surface, curves, parameters, report);  // leaves Refine fewer facets to avoid
  Observer* const observer = follower(parameters.observer);
  if (observer) observer->mesh_handed_over(mesh);
  if (!options.stop_after_recover && !options.single_stage) {
    refine(mesh, surface, curves, std::move(contour.points), parameters, report);
  }
  if (observer) observer->mesh_finished();
  return {std::move(mesh), std::move(curves), std::move(contour.points)};
}

}  // namespace deliso
