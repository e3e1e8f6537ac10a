// SPDX-License-Identifier: MIT
#include "deliso/deliso.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contour/contour.h"
#include "deliso/certified_way.h"
#include "cap/close_on_box.h"
#include "recover/sample.h"
#include "recover/lost_components.h"
#include "baseline/marching_cubes.h"
#include "recover/poles.h"
#include "recover/recover_paper.h"
#include "surface/surface_mesh.h"
#include "refine/refine.h"
#include "surface/step_timer.h"
#include "kdtree/voxel_tree.h"

namespace deliso {
namespace {

double scaled_length(const RelativeLength& length, const Volume& volume) {
  const Vec3 s = volume.spacing();
  return length.value *
         (length.in_voxels ? std::min({s.x, s.y, s.z}) : volume.box().smallest_side());
}

// Stage 1 as Figure 5 has it; with --single-stage, everything else on the triangulation too.
Recovered paper_way(const Isosurface& surface, const ContourMesh& contour,
                    const BoundaryCurves& curves, const Options& options, Report& report) {
  InitialSample initial;
  {
    const StepTimer timer(report.seconds_init);
    initial = init_triangulation(surface, contour, curves, options, report.r_min, report);
  }
  std::optional<RestrictedDelaunay> restricted;
  {
    const StepTimer timer(report.seconds_recover);
    restricted.emplace(surface, std::move(initial.triangulation), report.r_min, report,
                       options.profile);
    Recovery recovery(*restricted, curves, initial.chain, options, report.r_min);
    recovery.protect_boundary();
    recovery.multi_intersect();
    recovery.extract_manifold();
    if (std::isfinite(options.epsilon)) {
      std::vector<double> no_poles;
      recovery.approximate_geom(recover_criteria(options, report.r_min), no_poles);
      recovery.extract_manifold();
    }
    report.points_recovered =
        restricted->triangulation().vertex_capacity() - 1 - kAuxiliaryVertices;
    report.insertions_recover =
        report.points_recovered - std::min(report.points_recovered, report.points_initial);
  }
  std::vector<double> poles;
  {
    const StepTimer timer(report.seconds_poles);
    poles = compute_poles(restricted->triangulation(), surface, options.pole_side);
  }
  const StepTimer timer(report.seconds_refine);
  if (options.single_stage) {
    Recovery refinement(*restricted, curves, initial.chain, options, report.r_min);
    refinement.approximate_geom(refine_criteria(options, report.r_min), poles);
    refinement.extract_manifold();
    poles.resize(restricted->triangulation().vertex_capacity(), 0);
  }
  Recovery(*restricted, curves, initial.chain, options, report.r_min).count_unresolved();
  Recovered recovered = build_tri_mesh(std::move(*restricted), initial.chain, poles);
  put_back_lost_components(recovered, contour, initial.contour_component,
                           kept_components(contour, options), surface, report);
  return recovered;
}

}  // namespace

// Figure 4, its lines in order, with Figure 5 and Figure 9 unrolled into it.
TriMesh mesh_isosurface(const Volume& volume, double kappa, const Options& options,
                        Report& report) {
  const StepTimer total(report.seconds_total);
  const auto progress = [&](const char* stage, double share) {
    if (options.progress) options.progress(stage, share);
  };
  report.r_min = scaled_length(options.r_min, volume);

  const auto cap = [&](TriMesh& mesh, const BoundaryAid* aid) {
    if (!options.cap) return;
    const StepTimer timer(report.seconds_cap);
    close_on_box(mesh, volume, report.kappa_effective, options.lambda, aid, report);
  };

  if (options.method == Method::marching_cubes) {
    report.kappa_effective = settled_isovalue(volume, kappa);
    TriMesh mesh;
    {
      const StepTimer timer(report.seconds_contour);
      mesh = marching_cubes(volume, report.kappa_effective);
    }
    cap(mesh, nullptr);
    return mesh;
  }

  std::optional<VoxelTree> tree;
  {
    const StepTimer timer(report.seconds_tree);
    tree.emplace(volume);
  }
  ContourMesh contour;
  {
    const StepTimer timer(report.seconds_contour);
    report.kappa_effective = effective_isovalue(volume, kappa);
    contour = build_contour(volume, report.kappa_effective);
    if (contour.summary.tied_saddles > 0) {  // as settled_isovalue() does
      report.kappa_effective = lowered_isovalue(volume, report.kappa_effective);
      contour = build_contour(volume, report.kappa_effective);
    }
  }
  const Isosurface surface(volume, *tree, report.kappa_effective, options.cubic);
  if (contour.points.empty()) {
    TriMesh nothing;
    cap(nothing, nullptr);
    return nothing;
  }
  const auto finish = [&](Recovered& made, const BoundaryCurves& curves) {
    const BoundaryAid aid{surface, curves, made.chain};
    cap(made.mesh, &aid);
    return std::move(made.mesh);
  };
  if (options.recover == RecoverWay::certified) {
    CertifiedMesh made = mesh_certified(surface, std::move(contour), options, report);
    return finish(made.refined, made.curves);
  }
  const BoundaryCurves curves(surface, contour);
  Recovered recovered = paper_way(surface, contour, curves, options, report);
  if (!options.stop_after_recover && !options.single_stage) {
    const StepTimer timer(report.seconds_refine);
    progress("refine", 0);
    refine_geom(recovered, surface, curves, refine_criteria(options, report.r_min), {}, options,
                report);
    report.points_refined = report.insertions_refine;
  }
  return finish(recovered, curves);
}

}  // namespace deliso
