// SPDX-License-Identifier: MIT
#include "paper/deliso.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/random.h"
#include "paper/facet_cycles.h"
#include "paper/poles.h"

namespace deliso::paper {

Recovery init_triangulation(Sigma& sigma, const Options& options, Report& report) {
  const Box3 box = sigma.volume().box();
  const BoundaryCurves curves = marching_squares(sigma.volume(), sigma.kappa());
  std::vector<Vec3> sample = curves.points;
  Random random(options.seed);
  const auto somewhere = [&] {
    const double x = random.uniform(box.lo.x, box.hi.x), y = random.uniform(box.lo.y, box.hi.y);
    return Vec3{x, y, random.uniform(box.lo.z, box.hi.z)};
  };
  SearchCounters not_counted;
  for (std::size_t n = 0; n < options.lines; ++n) {
    const Vec3 a = somewhere(), b = somewhere();
    const Vec3 along = (length(box.size()) / distance(a, b)) * (b - a);
    for (const Hit& x : sigma.intersect({a - along, a + along}, not_counted)) {
      sample.push_back(x.point);
    }
  }
  if (options.facet_cycles)
    std::ranges::copy(points_below_regions(sigma), std::back_inserter(sample));
  report.points_on_curves = curves.points.size();
  report.points_on_lines = sample.size() - curves.points.size();
  append_auxiliary(box, sample);
  Triangulation del;
  std::vector<SiteId> ids;
  DELISO_CHECK(del.build(sample, ids));
  return Recovery({std::move(del), sigma, options, report}, curves, ids, options, report);
}

VoxelTree begin_run(const Volume& volume, double isovalue, const Options& options, Report& report) {
  if (!(volume.box().smallest_side() > 0)) {
    throw InputError("a volume needs two or more samples along each axis");
  }
  report.kappa = geometric_isovalue(volume.type(), isovalue);
  report.r_min = options.r_min * volume.box().smallest_side();
  return timed(report.seconds_tree, [&] { return VoxelTree(volume); });
}

TriMesh finish(SurfaceMesh t, const Sigma& sigma, const Options& options, Report& report) {
  if (options.observer) options.observer->mesh_ready(t);
  if (!t.poles.empty()) {
    stage("refine", report.seconds_refine, options,
          [&] { refine_geom(t, sigma, options, report); });
  }
  t.mesh.frame = sigma.volume().frame();
  return std::move(t.mesh);
}

namespace {

// Refine(Del S_1) of Figure 9 up to RefineGeom: returns T_S, with pole heights unless it is all
// that is asked for. Del S_1 ends here.
SurfaceMesh hand_over(Recovery s, const Sigma& sigma, const Options& options, Report& report) {
  std::vector<double> poles;
  if (!options.stop_after_recover) {
    stage("poles", report.seconds_poles, options,
          [&] { poles = compute_poles(s.del().del(), sigma); });
  }
  return build_tri_mesh(s.del(), poles);
}

}  // namespace

TriMesh deliso(const Volume& volume, double isovalue, const Options& options, Report& report) {
  const StepTimer total(report.seconds_total);
  const VoxelTree tree = begin_run(volume, isovalue, options, report);
  Sigma sigma(tree, report.kappa, options.solver);
  Recovery s = stage("initial", report.seconds_init, options,
                     [&] { return init_triangulation(sigma, options, report); });
  if (report.points_initial() == 0 && !sigma.is_empty()) {
    throw InputError("none of the ", options.lines,
                     " random lines meets the surface: --lines N draws more");
  }
  if (options.observer) options.observer->sample_ready(s.del(), report);
  stage("recover", report.seconds_recover, options, [&] { s.recover(); });
  s.count_left();
  if (options.observer) options.observer->recovered();
  SurfaceMesh t = hand_over(std::move(s), sigma, options, report);
  return finish(std::move(t), sigma, options, report);
}

}  // namespace deliso::paper
