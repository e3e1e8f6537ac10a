// SPDX-License-Identifier: MIT
#include "deliso/deliso.h"

#include "base/text.h"
#include "baseline/marching_cubes.h"
#include "cap/close_on_box.h"
#include "cap/leave_box.h"
#include "contour/contour.h"
#include "contour/dissolve.h"
#include "kdtree/voxel_tree.h"
#include "recover/recover_certified.h"
#include "recover/recover_paper.h"
#include "refine/clear_seam.h"
#include "refine/refine.h"
#include "surface/seam.h"
#include "surface/stage_progress.h"
#include "trace/trace.h"

namespace deliso {
namespace {

// How often: an edge within an inner face may be in the way of what is to go from the seam.
constexpr int kRounds = 3;

// Leaves nothing on the inner faces but the seam (surface/seam.h).
void make_seam(Recovered& s, const Isosurface& surface, const Parameters& parameters,
               Report& report) {
  std::size_t unknown = 1, flat = 0;
  for (int round = 0; round < kRounds && unknown > 0; ++round) {
    unknown = clear_seam(s.mesh, surface, s.curves, parameters, report);
    flat = leave_box(s.mesh, surface, surface.volume().inner_faces(), parameters, report);
  }
  report[Counter::cap_not_lifted] += flat;
  if (unknown > 0) refuse_seam(text("a vertex, one of ", unknown));
}

}  // namespace

// Figure 4. InitTriangulation and BuildTriMesh are the first and the last thing that Recover does.
TriMesh mesh_isosurface(const Volume& volume, double kappa, const Options& options,
                        Report& report) {
  const StepTimer total(report.seconds_total);
  require_limits(options, volume);
  Parameters parameters = resolve(options, volume);
  report.r_min = parameters.r_min;
  const auto begin = [&](const char* stage) { StageProgress(options.progress, stage); };
  if (options.method == Method::marching_cubes) {
    begin("cubes");
    report.kappa_effective = kappa;
    report.exact =
        summarize_settled_contour(volume, report.kappa_effective, parameters.threads).topology();
    TriMesh cubes = marching_cubes(volume, report.kappa_effective);
    if (options.cap) {
      begin("cap");
      const VoxelTree tree =
          timed(report.seconds_tree, [&] { return VoxelTree(volume, parameters.threads); });
      const Isosurface surface(volume, tree, report.kappa_effective, options.cubic);
      SurfaceMesh s{std::move(cubes), {}, {}, {}};
      s.duals.resize(s.mesh.faces.size());
      close_on_box(s, surface, {surface, {}}, corners_inside(volume, surface.kappa()), parameters,
                   report);
      cubes = std::move(s.mesh);
    }
    cubes.frame = volume.frame();
    return cubes;
  }
  report.kappa_effective = kappa;
  begin("contour");
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

  Recovered s =
      options.recover == RecoverWay::certified
          ? recover_certified(surface, std::move(contour), parameters, report)
          : recover_paper(surface, std::move(contour), parameters, options.single_stage, report);
  const unsigned inner_faces = volume.inner_faces();
  if (inner_faces != 0) clear_seam(s.mesh, surface, s.curves, parameters, report);
  if (options.trace) options.trace->switch_to(s.mesh.mesh);
  if (!options.stop_after_recover && !options.single_stage) {
    refine(s.mesh, surface, s.curves, s.witnesses, parameters, report);
  }
  if (options.trace) options.trace->end_mesh();
  if (inner_faces != 0) make_seam(s, surface, parameters, report);
  if (options.cap) {
    begin("cap");
    close_on_box(s.mesh, surface, s.curves, inside, parameters, report);
  }
  s.mesh.mesh.frame = volume.frame();
  return std::move(s.mesh.mesh);
}

}  // namespace deliso
