// SPDX-License-Identifier: MIT
#include "deliso/deliso.h"

#include "base/text.h"
#include "baseline/marching_cubes.h"
#include "blocks/clear_seam.h"
#include "blocks/seam.h"
#include "cap/close_on_box.h"
#include "cap/leave_box.h"
#include "contour/contour.h"
#include "contour/dissolve.h"
#include "kdtree/voxel_tree.h"
#include "paper/recover.h"
#include "recover/recover.h"
#include "refine/refine.h"
#include "surface/observer.h"

namespace deliso {
namespace {

// How often a seam is cleared: what is to go from it may be in the way of an edge within the face,
// which leaves in the same round.
constexpr int kRounds = 3;

// Leaves nothing on the inner faces but the seam (blocks/seam.h).
void make_seam(Recovered& s, const Isosurface& surface, const Parameters& parameters,
               Report& report) {
  std::size_t unknown = 1, flat = 0;
  for (int round = 0; round < kRounds && unknown > 0; ++round) {
    unknown = clear_seam(s.mesh, surface, s.curves, parameters, report);
    flat = leave_box(s.mesh, surface, s.curves, surface.volume().inner_faces(), parameters, report);
  }
  report[Counter::cap_not_lifted] += flat;
  if (unknown > 0) refuse_seam(text("a vertex, one of ", unknown));
}

TriMesh mesh_by_cubes(const Volume& volume, double kappa, const Options& options,
                      const Parameters& parameters, Report& report) {
  begin_stage(parameters.observer, "cubes");
  report.kappa_effective = kappa;
  report.exact =
      summarize_settled_contour(volume, report.kappa_effective, parameters.threads).topology();
  SurfaceMesh s{marching_cubes(volume, report.kappa_effective), {}, {}, {}};
  if (options.cap) {
    begin_stage(parameters.observer, "cap");
    const VoxelTree tree =
        timed(report.seconds_tree, [&] { return VoxelTree(volume, parameters.threads); });
    const Isosurface surface(volume, tree, report.kappa_effective, options.cubic);
    s.duals.resize(s.mesh.faces.size());
    close_on_box(s, surface, {surface, {}}, corners_inside(volume, surface.kappa()), parameters,
                 report);
  }
  s.mesh.frame = volume.frame();
  return std::move(s.mesh);
}

}  // namespace

// Figure 4, whose triangulation lives in Stage 1: recover_certified (ours, the default) or
// recover_paper (Figure 5), which begin with the first sample and end with BuildTriMesh. refine()
// is what is left of Figure 9. What is ours stands around them: the isovalue, seams, caps.
TriMesh mesh_isosurface(const Volume& volume, double kappa, const Options& options,
                        Report& report) {
  const StepTimer total(report.seconds_total);
  require_limits(options, volume);
  Parameters parameters = resolve(options, volume);
  report.r_min = parameters.r_min;
  if (options.method == Method::marching_cubes) {
    return mesh_by_cubes(volume, kappa, options, parameters, report);
  }
  report.kappa_effective = kappa;
  begin_stage(parameters.observer, "contour");
  ContourMesh contour = timed(report.seconds_contour, [&] {
    return build_settled_contour(volume, report.kappa_effective, parameters.threads);
  });
  report.exact = contour.summary.topology();
  const VoxelTree tree =
      timed(report.seconds_tree, [&] { return VoxelTree(volume, parameters.threads); });
  const Isosurface surface(volume, tree, report.kappa_effective, options.cubic);
  std::array<bool, 8> inside{};
  if (options.cap) inside = corners_inside(volume, surface.kappa());
  if (options.cap && options.min_component > 0) {
    Dissolved dissolved = dissolve_small(contour, volume, surface.kappa(), options.min_component);
    parameters.kept = std::move(dissolved.kept);
    inside = dissolved.corner_inside;
  }

  Observer* const follower = deliso::follower(options.observer);
  Recovered s =
      options.recover == RecoverWay::certified
          ? recover_certified(surface, std::move(contour), parameters, report)
          : recover_paper(surface, std::move(contour), parameters, options.single_stage, report);
  const unsigned inner_faces = volume.inner_faces();
  // Before Stage 2 too, which then has less to keep out of; what is left now, make_seam() clears.
  if (inner_faces != 0) clear_seam(s.mesh, surface, s.curves, parameters, report);
  if (follower) follower->mesh_handed_over(s.mesh);
  if (!options.stop_after_recover && !options.single_stage) {
    refine(s.mesh, surface, s.curves, s.witnesses, parameters, report);
  }
  if (follower) follower->mesh_finished();
  if (inner_faces != 0) make_seam(s, surface, parameters, report);
  if (options.cap) {
    begin_stage(parameters.observer, "cap");
    close_on_box(s.mesh, surface, s.curves, inside, parameters, report);
  }
  s.mesh.mesh.frame = volume.frame();
  return std::move(s.mesh.mesh);
}

}  // namespace deliso
