// SPDX-License-Identifier: MIT
#include "deliso/deliso.h"

#include "base/text.h"
#include "blocks/clear_seam.h"
#include "blocks/seam.h"
#include "cap/close_on_box.h"
#include "cap/leave_box.h"
#include "contour/contour.h"
#include "contour/dissolve.h"
#include "kdtree/voxel_tree.h"
#include "surface/observer.h"
#include "surface/step_timer.h"

namespace deliso {
namespace {

// Rounds in which a seam is cleared. An edge within the face can block the removal of a vertex.
// That edge leaves the face in the same round, so the next round can remove the vertex.
constexpr int kMaxSeamRounds = 3;

// Removes everything but the seam from the inner faces (blocks/seam.h).
void make_seam(DelaunayMesh& s, const Isosurface& surface, const Parameters& parameters,
               Report& report) {
  std::size_t unknown = 1, flat = 0;
  for (int round = 0; round < kMaxSeamRounds && unknown > 0; ++round) {
    unknown = clear_seam(s.mesh, surface, s.curves, parameters, report);
    flat = leave_box(s.mesh, surface, s.curves, surface.volume().inner_faces(), parameters, report);
  }
  report[Counter::cap_not_lifted] += flat;
  if (unknown > 0) refuse_seam(text("a vertex, one of ", unknown));
}

}  // namespace

TriMesh mesh_isosurface(const Volume& volume, double isovalue, const Options& options,
                        Report& report) {
  const StepTimer total(report.seconds_total);
  require_limits(options, volume);
  Parameters parameters = resolve(options, volume);
  report.r_min = parameters.r_min;
  begin_stage(parameters.observer, "contour");
  const double kappa = geometric_isovalue(volume.type(), isovalue);
  ContourMesh contour = timed(report.seconds_contour, [&] {
    return build_contour(volume, kappa, parameters.threads);
  });
  report.kappa_effective = kappa;
  report.exact = contour.summary.topology();
  const VoxelTree tree =
      timed(report.seconds_tree, [&] { return VoxelTree(volume, parameters.threads); });
  const Isosurface surface(volume, tree, kappa, options.cubic);
  std::array<bool, 8> inside{};
  if (options.cap) inside = corners_inside(volume, kappa);
  if (options.cap && !options.components.is_all()) {
    Dissolved dissolved = dissolve_others(contour, volume, kappa, options.components);
    parameters.kept = std::move(dissolved.kept);
    inside = dissolved.corner_inside;
  }

  DelaunayMesh s = delaunay_mesh(surface, std::move(contour), options, parameters, report);
  if (volume.inner_faces() != 0) make_seam(s, surface, parameters, report);
  if (options.cap) {
    begin_stage(parameters.observer, "cap");
    close_on_box(s.mesh, surface, s.curves, inside, parameters, report);
  }
  s.mesh.mesh.frame = volume.frame();
  return std::move(s.mesh.mesh);
}

TriMesh mesh_isosurface(const Volume& volume, double isovalue, const Options& options) {
  value_range(volume);
  Report report;
  return mesh_isosurface(volume, isovalue, options, report);
}

}  // namespace deliso
