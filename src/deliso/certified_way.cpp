// SPDX-License-Identifier: MIT
#include "deliso/certified_way.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/sorted_list.h"
#include "contour/block_order.h"
#include "recover/cell_sizes.h"
#include "refine/delaunay_patches.h"
#include "recover/embedded_contour.h"
#include "refine/move_vertices.h"
#include "recover/recover_certified.h"
#include "refine/refine.h"
#include "surface/step_timer.h"
#include "refine/trouble.h"

namespace deliso {
namespace {

// How often Stage 2 is run again to part facets that cross.
constexpr int kGuardedPasses = 4;

constexpr int kMendingAttempts = 2;

// What Stage 1 hands over.
struct Handover {
  Recovered recovered;
  BoundaryCurves curves;
  decltype(Report::counters) counters;
};

Handover take_stage1(const Isosurface& surface, ContourMesh& contour, const ContourSplit& split,
                     std::vector<Vec3>& sites, const Options& options, Report& report) {
  report.counters = {};
  std::optional<BoundaryCurves> curves;
  {
    const StepTimer timer(report.seconds_contour);
    order_by_blocks(contour, surface.volume());
    curves.emplace(surface, contour);
  }
  Recovered recovered =
      recover_certified(surface, contour, *curves, split, std::move(sites), options, report);
  sites = recovered.mesh.points;
  report.points_recovered = sites.size();
  report.insertions_recover += sites.size() - std::min(sites.size(), report.points_initial);
  return {std::move(recovered), std::move(*curves), report.counters};
}

// What Stage 2 makes of it, and what is said of that in the report.
struct Refined {
  Recovered recovered;
  std::vector<std::uint64_t> guarded;  // voxels
  Trouble trouble;
  Report report;
};

Refined judged(Recovered&& refined, std::vector<std::uint64_t>&& guarded, const Criteria& criteria,
               const Volume& volume, Report& report) {
  const StepTimer timer(report.seconds_trouble);
  Trouble trouble = find_trouble(refined, criteria, volume);
  report.troubled_facets = trouble.bad_facets;
  report.crossing_pairs = trouble.crossing_pairs;
  return {std::move(refined), std::move(guarded), std::move(trouble), report};
}

Refined take_stage2(const Isosurface& surface, const Handover& handover,
                    std::vector<std::uint64_t> guarded, const Options& options, Report& report) {
  const Criteria criteria = refine_criteria(options, report.r_min);
  report.counters = handover.counters;
  report.points_recovered = handover.recovered.mesh.points.size();
  Recovered refined = handover.recovered;
  {
    const StepTimer timer(report.seconds_refine);
    const std::size_t before = report.insertions_refine;
    refine_geom(refined, surface, handover.curves, criteria, guarded, options, report);
    report.points_refined = report.insertions_refine - before;
  }
  return judged(std::move(refined), std::move(guarded), criteria, surface.volume(), report);
}

// Stage 2 again, guarded also where facets crossed, and where they do then, while there is more to
// guard.
void part_crossings(const Isosurface& surface, const Handover& handover, const Options& options,
                    Refined& best, Report& report) {
  std::vector<std::uint64_t> guarded = best.guarded, crossing = best.trouble.crossing_voxels;
  for (int pass = 0; pass < kGuardedPasses && !crossing.empty(); ++pass) {
    std::vector<std::uint64_t> more = united(guarded, crossing);
    if (more.size() == guarded.size()) return;
    guarded = std::move(more);
    Refined again = take_stage2(surface, handover, guarded, options, report);
    crossing = again.trouble.crossing_voxels;
    if (again.trouble.crossing_pairs < best.trouble.crossing_pairs) best = std::move(again);
  }
}

// The turns after the one whose mesh was kept left their seconds and searches in `report`.
void report_of(const Refined& kept, Report& report) {
  report.points_initial = kept.report.points_initial;
  report.points_recovered = kept.report.points_recovered;
  report.points_refined = kept.report.points_refined;
  report.troubled_facets = kept.report.troubled_facets;
  report.crossing_pairs = kept.report.crossing_pairs;
  report.stopped_at_max_vertices = kept.report.stopped_at_max_vertices;
  report.counters = kept.report.counters;
}

// What refinement cannot better, other facets and other places for vertices can; once more where
// facets come to cross by it, guarded. The mesh stays as it was when more cross even so.
void mend(const Isosurface& surface, const Options& options, Refined& best, Report& report) {
  const Criteria criteria = refine_criteria(options, report.r_min);
  std::vector<std::uint64_t> guarded = united(best.guarded, best.trouble.crossing_voxels);
  for (int attempt = 0; attempt < kMendingAttempts; ++attempt) {
    report_of(best, report);
    Recovered mended = best.recovered;
    {
      const StepTimer timer(report.seconds_refine);
      make_patches_delaunay(mended, surface, criteria, guarded, report);
      move_vertices(mended, surface, criteria, guarded, report);
      report[Counter::unrefined_facets] = count_unrefined(mended, criteria);
    }
    Refined again =
        judged(std::move(mended), std::move(guarded), criteria, surface.volume(), report);
    if (again.trouble.crossing_pairs <= best.trouble.crossing_pairs) {
      best = std::move(again);
      return;
    }
    guarded = united(again.guarded, again.trouble.crossing_voxels);
  }
}

}  // namespace

CertifiedMesh mesh_certified(const Isosurface& surface, ContourMesh&& contour,
                             const Options& options, Report& report) {
  const Volume& volume = surface.volume();
  const std::size_t plain_vertices = contour.points.size();
  ContourSplit split;
  {
    const StepTimer timer(report.seconds_contour);
    split.elsewhere =
        cells_elsewhere(volume.spacing(), contour.summary.active_voxels, plain_vertices);
    if (split.elsewhere != Index3{1, 1, 1}) {
      contour = build_embedded_contour(volume, surface.kappa(), split);
    }
  }
  std::vector<Vec3> sites;
  std::vector<std::uint64_t> crossed;  // voxels, in any turn: facets may well cross there again
  std::optional<Handover> handover;
  std::optional<Refined> best;
  for (int number = 1;; ++number) {
    std::optional<Handover> next;
    std::optional<Refined> refined;
    try {
      next.emplace(take_stage1(surface, contour, split, sites, options, report));
      refined.emplace(take_stage2(surface, *next, crossed, options, report));
    } catch (const InputError&) {
      // A better mesh than the one there is would take more than --max-vertices.
      if (number == 1) throw;
      break;
    }
    report.turns = static_cast<std::size_t>(number);
    if (report.stopped_at_max_vertices && number > 1) break;

    crossed = united(crossed, refined->trouble.crossing_voxels);
    std::vector<std::uint64_t> voxels = united(split.voxels, refined->trouble.voxels);
    const bool enough = number == options.turns || refined->trouble.is_slight() ||
                        report.stopped_at_max_vertices || voxels.size() == split.voxels.size();
    if (!best || refined->trouble.weight() < best->trouble.weight()) {
      handover.emplace(std::move(*next));
      best.emplace(std::move(*refined));
    }
    if (enough) break;
    const StepTimer timer(report.seconds_contour);
    split.voxels = std::move(voxels);
    split.factor =
        cells_at_trouble(volume.spacing(), report.r_min, split.voxels.size(), plain_vertices);
    contour = build_embedded_contour(volume, surface.kappa(), split);
  }
  if (!best->report.stopped_at_max_vertices && !options.stop_after_recover) {
    try {
      part_crossings(surface, *handover, options, *best, report);
    } catch (const InputError&) {
      // What it would make better takes more than --max-vertices: it stays as it is.
    }
    mend(surface, options, *best, report);
  }
  report_of(*best, report);
  return {std::move(options.stop_after_recover ? handover->recovered : best->recovered),
          std::move(handover->curves)};
}

}  // namespace deliso
