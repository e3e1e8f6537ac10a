// SPDX-License-Identifier: MIT
// The whole way from a volume to a mesh: blocks, then what only the whole mesh can have.
#include <optional>
#include <utility>

#include "blocks/mesh_in_blocks.h"
#include "cap/close_on_box.h"
#include "cap/dissolve.h"
#include "contour/contour.h"
#include "deliso/deliso.h"
#include "refine/coarsen.h"
#include "refine/refine.h"
#include "surface/observer.h"
#include "surface/step_timer.h"

namespace deliso {

TriMesh mesh_isosurface(const Volume& volume, double isovalue, const Options& options,
                        Report& report) {
  const StepTimer total(report.seconds_total);
  require_limits(options, volume);
  const Parameters parameters = resolve(options, volume);
  report.r_min = parameters.r_min;
  const double kappa = geometric_isovalue(volume.type(), isovalue);
  report.kappa_effective = kappa;
  std::array<bool, 8> inside{};
  std::vector<std::uint8_t> kept;
  if (options.cap) inside = corners_inside(volume, kappa);
  if (options.cap && !options.components.is_all()) {
    Dissolved dissolved =
        dissolve_others(build_contour(volume, kappa), volume, kappa, options.components);
    kept = std::move(dissolved.kept);
    inside = dissolved.corner_inside;
  }

  WeldedMesh whole = mesh_in_blocks(volume, kappa, options, parameters, std::move(kept), report);
  std::optional<VoxelTree> tree;
  std::optional<Isosurface> surface;
  if (options.cap || parameters.has_target()) {
    tree.emplace(volume);
    surface.emplace(volume, *tree, kappa, options.cubic);
  }
  count_unrefined(whole.mesh, parameters, report);
  if (parameters.has_target() && !options.stop_after_recover) {
    coarsen_to_target(whole.mesh, *surface, {*surface, whole.loops}, whole.samples, parameters,
                      report);
  }
  report.vertices_refined = whole.mesh.mesh.points.size();
  report.triangles_refined = whole.mesh.mesh.faces.size();
  if (options.cap) {
    begin_stage(parameters.observer, "cap");
    close_on_box(whole.mesh, *surface, {*surface, whole.loops}, inside, parameters, report);
  }
  whole.mesh.mesh.frame = volume.frame();
  return std::move(whole.mesh.mesh);
}

TriMesh mesh_isosurface(const Volume& volume, double isovalue, const Options& options) {
  value_range(volume, "volume");
  Report report;
  return mesh_isosurface(volume, isovalue, options, report);
}

}  // namespace deliso
