// SPDX-License-Identifier: MIT
#include "refine/refine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "refine/refine_geom.h"
#include "refine/regions.h"
#include "surface/step_timer.h"

namespace deliso {
namespace {

// In surface balls: what lies so near to a cut is refined again once the regions are put together.
constexpr double kNearCut = 1;

// Whether the mesh may be cut: where the refinement may end before all is done, where it is the
// paper's, and where it is watched, the worst facet anywhere comes first.
bool may_be_cut(const Parameters& p) {
  return !p.as_published && !p.keep_partial && !(p.observer && p.observer->follows_insertions()) &&
         p.target_vertices == std::numeric_limits<std::size_t>::max();
}

// Refines the regions; returns the facets of the whole mesh that are still to be looked at. Of
// `far`, samples that concern one region alone are looked at there.
std::vector<FaceId> refine_regions(SurfaceMesh& mesh, const Isosurface& surface,
                                   const BoundaryCurves& curves, std::span<const Vec3> samples,
                                   const Parameters& parameters, const Cut& cut,
                                   std::vector<std::uint32_t>& far, Report& report) {
  std::vector<MeshRegion> regions(cut.size());
  std::vector<std::vector<std::uint32_t>> far_of(cut.size());
  std::vector<std::vector<FaceId>> waiting(cut.size());
  std::vector<Report> reports(cut.size());
  const double limit = kCoverage * parameters.refinement[Criterion::distance];
  std::erase_if(far, [&](std::uint32_t n) {
    const std::size_t box = cut.box_at(samples[n]);
    if (!cut.box(box).holds(samples[n], limit)) return false;
    far_of[box].push_back(n);
    return true;
  });
  Parameters unobserved = parameters;
  unobserved.observer = nullptr;
  std::mutex mutex;
  std::size_t done = 0;
  for_each_task(parameters.threads, cut.size(), [&](std::size_t n) {
    MeshRegion& region = regions[n] = cut.extract(mesh, n);
    Refinement refinement(region.surface, surface, curves, unobserved, reports[n],
                          region.vertices.size(), region.region);
    std::vector<FaceId> open(region.facets.size() - region.region.first_free);
    std::iota(open.begin(), open.end(), region.region.first_free);
    waiting[n] = refine_geom(refinement, std::move(open), samples, far_of[n]);
    const std::lock_guard lock(mutex);
    ++done;
    if (parameters.observer) parameters.observer->steps_done(done, cut.size() - done);
  });
  std::vector<std::uint8_t> is_done(mesh.mesh.faces.size(), 0);
  for (std::size_t n = 0; n < regions.size(); ++n) {
    const std::vector<FaceId> numbers = put_back(mesh, regions[n]);
    is_done.resize(mesh.mesh.faces.size());
    for (FaceId f = regions[n].region.first_free; f < numbers.size(); ++f) {
      const Dual& dual = regions[n].surface.duals[f];
      is_done[numbers[f]] =
          regions[n].region.holds(dual.center, kNearCut * std::sqrt(dual.radius2));
    }
    for (const FaceId f : waiting[n]) is_done[numbers[f]] = 0;
    far.insert(far.end(), far_of[n].begin(), far_of[n].end());
    report.add_refinement(reports[n]);
    regions[n] = {};
  }
  std::vector<FaceId> open;
  for (FaceId f = 0; f < is_done.size(); ++f) {
    if (!is_done[f] && !is_dead(mesh.mesh.faces[f])) open.push_back(f);
  }
  return open;
}

void count_left(const Refinement& r) {
  for (FaceId f = 0; f < r.mesh.faces.size(); ++f) {
    if (is_dead(r.mesh.faces[f])) continue;
    const FacetShape s = r.shape(f);
    if (s.r > r.parameters.r_min) r.report.largest_h = std::max(r.report.largest_h, s.h);
    r.report[Counter::unrefined_facets] += violation(s, r.parameters.refinement) > 1;
  }
  r.report.max_distance = r.parameters.refinement[Criterion::distance];
}

}  // namespace

void refine(SurfaceMesh& mesh, const Isosurface& surface, const BoundaryCurves& curves,
            std::span<const Vec3> samples, const Parameters& parameters, Report& report,
            std::size_t largest_region) {
  const StepTimer timer(report.seconds_refine);
  const std::size_t of_stage1 = mesh.mesh.points.size();
  std::vector<std::uint32_t> far(samples.size());
  std::iota(far.begin(), far.end(), 0);
  std::vector<FaceId> open(mesh.mesh.faces.size());
  std::iota(open.begin(), open.end(), FaceId(0));
  if (may_be_cut(parameters)) {
    begin_stage(parameters.observer, "regions");
    const Cut cut(mesh, largest_region);
    if (cut.size() >= 2) {
      open = refine_regions(mesh, surface, curves, samples, parameters, cut, far, report);
    }
  }
  begin_stage(parameters.observer, "refine");
  Refinement whole(mesh, surface, curves, parameters, report, of_stage1);
  refine_geom(whole, std::move(open), samples, far);
  count_left(whole);
  remove_dead(mesh);
}

}  // namespace deliso
