// SPDX-License-Identifier: MIT
// The whole way from a volume to a mesh: blocks, then what only the whole mesh can have.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "base/text.h"
#include "blocks/components.h"
#include "blocks/mesh_in_blocks.h"
#include "blocks/seams.h"
#include "deliso/mesh_isosurface.h"
#include "more/cap/close_on_box.h"
#include "more/cap/dissolve.h"
#include "more/counts/merge_vertices.h"
#include "more/counts/mesh_near_count.h"
#include "more/counts/unrefined.h"
#include "run/observer.h"

namespace deliso {
namespace {

// Returns the parameters, and reports what follows from the options alone. Throws InputError beyond
// their limits.
Parameters checked_parameters(const Grid& shape, double isovalue, const Options& options,
                              Report& report) {
  require_limits(options, shape);
  const Parameters parameters = resolve(options, shape);
  report.r_min = parameters.r_min;
  report.kappa_effective = geometric_isovalue(shape.type(), isovalue);
  return parameters;
}

// A solid whose components are chosen: which are kept, and the corners of the box inside it.
std::optional<Dissolved> dissolved(const RunInput& run) {
  if (!run.options.cap || run.options.components.is_all()) return std::nullopt;
  return dissolve_others(all_of(run.source), run.kappa, run.options.components);
}

// True if the mesh gets a number of vertices or triangles. The coarsened contour has its own.
bool meets_count(const Options& options) {
  return options.has_target() && !options.stop_after_stage1;
}

// Does what only the whole mesh can have done: topology, counts and caps.
TriMesh finish(Block whole, const RunInput& run, const std::optional<Dissolved>& solid,
               Report& report) {
  const Options& options = run.options;
  const Parameters& parameters = run.parameters;
  report.add(whole.report);
  std::optional<BoxSurface> at;
  if (options.cap || meets_count(options)) at.emplace(all_of(run.source), run.kappa);
  report.exact = joined(whole.components, run.source.shape.dims()).topology;
  if (meets_count(options)) {
    merge_to_count(whole.mesh, whole.samples, options,
                   {at->surface, {at->surface, whole.loops}, parameters, report});
  } else {
    count_unrefined(whole.mesh, parameters, report);
  }
  report.vertices_refined = whole.mesh.mesh.points.size();
  report.triangles_refined = whole.mesh.mesh.faces.size();
  if (options.cap) {
    begin_stage(parameters.observer, "cap");
    const std::array<bool, 8> inside =
        solid ? solid->corner_inside : corners_inside(at->volume, run.kappa);
    close_on_box(whole.mesh, inside, {at->surface, {at->surface, whole.loops}, parameters, report});
  }
  whole.mesh.mesh.frame = run.source.shape.frame();
  return std::move(whole.mesh.mesh);
}

std::vector<std::uint8_t> kept_by(const std::optional<Dissolved>& solid) {
  return solid ? solid->kept : std::vector<std::uint8_t>();
}

void require_no_whole(const Options& options) {
  if (!options.has_target()) return;
  throw InputError("not in parts: a number of vertices or triangles is that of all of the mesh");
}

}  // namespace

TriMesh mesh_isosurface(const Volume& volume, double isovalue, const Options& options,
                        Report& report) {
  const StepTimer total(report.seconds_total);
  const VolumeSource source = source_of(volume);
  const Parameters parameters = checked_parameters(volume, isovalue, options, report);
  const RunInput run{source, report.kappa_effective, options, parameters};
  const auto solid = dissolved(run);
  Block whole = meets_count(options) ? mesh_near_count(run, kept_by(solid))
                                     : mesh_in_blocks(run, {}, kept_by(solid));
  return finish(std::move(whole), run, solid, report);
}

SampleBox box_of_part(const Grid& shape, const Options& options, PartChoice part) {
  if (grid_follows_surface(shape, options)) return {{0, 0, 0}, shape.voxels()};
  const std::vector<SampleBox> boxes = block_grid(shape, options).boxes();
  const CellRun own = cells_of(part, boxes.size());
  SampleBox all = own.begin == own.end ? SampleBox{{0, 0, 0}, {1, 1, 1}} : boxes[own.begin];
  for (std::size_t cell = own.begin; cell < own.end; ++cell) all = united(all, boxes[cell]);
  return grown(all, {kSeamMarginSamples, kSeamMarginSamples, kSeamMarginSamples}, shape.voxels());
}

Block mesh_part(const VolumeSource& source, double isovalue, const Options& options,
                PartChoice part) {
  require_no_whole(options);
  Report report;
  const Parameters parameters = checked_parameters(source.shape, isovalue, options, report);
  const RunInput run{source, report.kappa_effective, options, parameters};
  Block block = mesh_in_blocks(run, part, kept_by(dissolved(run)));
  report.add(block.report);
  block.report = report;
  return block;
}

TriMesh mesh_of_parts(const VolumeSource& source, double isovalue, const Options& options,
                      std::vector<Block> parts, Report& report) {
  require_no_whole(options);
  const StepTimer total(report.seconds_total);
  const Parameters parameters = checked_parameters(source.shape, isovalue, options, report);
  const RunInput run{source, report.kappa_effective, options, parameters};
  return finish(join_parts(run, std::move(parts)), run, dissolved(run), report);
}

TriMesh mesh_isosurface(const Volume& volume, double isovalue, const Options& options) {
  value_range(volume, "volume");
  Report report;
  return mesh_isosurface(volume, isovalue, options, report);
}

}  // namespace deliso
