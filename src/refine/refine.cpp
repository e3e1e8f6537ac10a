// SPDX-License-Identifier: MIT
#include "refine/refine.h"

#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "refine/parts.h"
#include "refine/refine_geom.h"
#include "surface/stage_progress.h"

namespace deliso {
namespace {

// What refining the parts takes of the stage's time, by one thread or many.
constexpr double kPartsShare = 0.75;

// Whether the mesh may be cut: where the refinement may end before all is done, where it is the
// paper's, and where it is looked at, what is worst anywhere comes first.
bool in_parts(const Parameters& p) {
  return !p.as_published && !p.keep_partial && !p.trace &&
         p.target_vertices == std::numeric_limits<std::size_t>::max();
}

void refine_parts(SurfaceMesh& mesh, const Isosurface& surface, const BoundaryCurves& curves,
                  std::span<const Vec3> witnesses, const Parameters& parameters,
                  std::size_t largest_part, Work& work, StageProgress& progress, Report& report) {
  const Cut cut(mesh, largest_part);
  if (cut.size() < 2) return;
  std::vector<MeshPart> parts(cut.size());
  std::vector<Work> works(cut.size());
  std::vector<Report> reports(cut.size());
  // Points of Sigma go to a part when what is near enough to them lies in its box.
  const double reach = kReach * parameters.refinement[Criterion::distance];
  std::erase_if(work.far, [&](std::uint32_t n) {
    const std::size_t box = cut.box_at(witnesses[n]);
    if (!cut.box(box).holds(witnesses[n], reach)) return false;
    works[box].far.push_back(n);
    return true;
  });
  progress.begin_part(kPartsShare);
  const StageProgress::Callback nobody;
  std::mutex mutex;
  std::size_t done = 0;
  for_each_task(parameters.profile ? 1 : parameters.threads, cut.size(), [&](std::size_t n) {
    parts[n] = cut.take(mesh, n);
    works[n].part = parts[n].part;
    works[n].of_stage1 = parts[n].vertices.size();
    works[n].settled.assign(parts[n].facets.size(), 0);
    StageProgress silent(nobody, "refine");
    refine_geom(parts[n].surface, surface, curves, witnesses, parameters, works[n], silent,
                reports[n]);
    const std::lock_guard lock(mutex);
    progress.reach(static_cast<double>(++done) / static_cast<double>(cut.size()));
  });
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const std::size_t facets = mesh.mesh.faces.size();
    put_back(mesh, parts[n]);
    work.settled.resize(mesh.mesh.faces.size());
    for (FaceId f = parts[n].part.first; f < works[n].settled.size(); ++f) {
      work.settled[in_whole(parts[n], f, facets)] = works[n].settled[f];
    }
    work.far.insert(work.far.end(), works[n].far.begin(), works[n].far.end());
    report.add_refinement(reports[n]);
    parts[n] = {};
  }
}

}  // namespace

void refine(SurfaceMesh& mesh, const Isosurface& surface, const BoundaryCurves& curves,
            std::span<const Vec3> witnesses, const Parameters& parameters, Report& report,
            std::size_t largest_part) {
  const StepTimer timer(report.seconds_refine);
  StageProgress progress(parameters.progress, "refine");
  Work work;
  work.of_stage1 = mesh.mesh.points.size();
  work.settled.assign(mesh.mesh.faces.size(), 0);
  work.far.resize(witnesses.size());
  std::iota(work.far.begin(), work.far.end(), 0);
  if (in_parts(parameters)) {
    refine_parts(mesh, surface, curves, witnesses, parameters, largest_part, work, progress,
                 report);
  }
  refine_geom(mesh, surface, curves, witnesses, parameters, work, progress, report);
  remove_dead(mesh);
}

}  // namespace deliso
