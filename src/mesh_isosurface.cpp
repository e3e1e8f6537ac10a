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
#include "cap/close_on_box.h"
#include "cap/dissolve.h"
#include "deliso/deliso.h"
#include "mesh_parts.h"
#include "refine/coarsen.h"
#include "refine/refine.h"
#include "surface/observer.h"

namespace deliso {
namespace {

Parameters begin(const Volume& shape, double isovalue, const Options& options, Report& report) {
  require_limits(options, shape);
  const Parameters parameters = resolve(options, shape);
  report.r_min = parameters.r_min;
  report.kappa_effective = geometric_isovalue(shape.type(), isovalue);
  return parameters;
}

// A solid whose components are chosen: which are kept, and the corners of the box inside it.
std::optional<Dissolved> dissolved(const VolumeSource& source, double kappa,
                                   const Options& options) {
  if (!options.cap || options.components.is_all()) return std::nullopt;
  return dissolve_others(all_of(source), kappa, options.components);
}

// Does what only the whole mesh can have done: topology, counts and caps.
TriMesh finish(Block whole, const VolumeSource& source, const std::optional<Dissolved>& solid,
               const Options& options, const Parameters& parameters, Report& report) {
  const double kappa = report.kappa_effective;
  std::optional<BoxSurface> at;
  if (options.cap || parameters.has_target()) at.emplace(all_of(source), kappa);
  report.exact = joined(whole.components, source.shape.dims()).topology;
  count_unrefined(whole.mesh, parameters, report);
  if (parameters.has_target() && !options.stop_after_stage1) {
    coarsen_to_target(whole.mesh, whole.samples,
                      {at->surface, {at->surface, whole.loops}, parameters, report});
  }
  report.vertices_refined = whole.mesh.mesh.points.size();
  report.triangles_refined = whole.mesh.mesh.faces.size();
  if (options.cap) {
    begin_stage(parameters.observer, "cap");
    const std::array<bool, 8> inside =
        solid ? solid->corner_inside : corners_inside(at->volume, kappa);
    close_on_box(whole.mesh, inside, {at->surface, {at->surface, whole.loops}, parameters, report});
  }
  whole.mesh.mesh.frame = source.shape.frame();
  return std::move(whole.mesh.mesh);
}

void require_no_whole(const Parameters& parameters) {
  if (!parameters.has_target()) return;
  throw InputError("not in parts: a number of vertices or triangles is that of all of the mesh");
}

}  // namespace

TriMesh mesh_isosurface(const Volume& volume, double isovalue, const Options& options,
                        Report& report) {
  const StepTimer total(report.seconds_total);
  const VolumeSource source = source_of(volume);
  const Parameters parameters = begin(volume, isovalue, options, report);
  const auto solid = dissolved(source, report.kappa_effective, options);
  Block whole = mesh_in_blocks(source, report.kappa_effective, options, parameters,
                               solid ? solid->kept : std::vector<std::uint8_t>(), {}, report);
  return finish(std::move(whole), source, solid, options, parameters, report);
}

SampleBox box_of_part(const Volume& shape, const Options& options, PartChoice part) {
  if (grid_follows_surface(shape, options)) return {{0, 0, 0}, shape.voxels()};
  const std::vector<SampleBox> boxes = block_grid(shape, options).boxes();
  const CellRun own = cells_of(part, boxes.size());
  SampleBox all = own.begin == own.end ? SampleBox{{0, 0, 0}, {1, 1, 1}} : boxes[own.begin];
  for (std::size_t cell = own.begin; cell < own.end; ++cell) all = united(all, boxes[cell]);
  return grown(all, {kSeamMarginSamples, kSeamMarginSamples, kSeamMarginSamples}, shape.voxels());
}

Block mesh_part(const VolumeSource& source, double isovalue, const Options& options,
                PartChoice part) {
  Report report;
  const Parameters parameters = begin(source.shape, isovalue, options, report);
  require_no_whole(parameters);
  const auto solid = dissolved(source, report.kappa_effective, options);
  Block block = mesh_in_blocks(source, report.kappa_effective, options, parameters,
                               solid ? solid->kept : std::vector<std::uint8_t>(), part, report);
  block.report = report;
  return block;
}

TriMesh mesh_of_parts(const VolumeSource& source, double isovalue, const Options& options,
                      std::vector<Block> parts, Report& report) {
  const StepTimer total(report.seconds_total);
  const Parameters parameters = begin(source.shape, isovalue, options, report);
  require_no_whole(parameters);
  Block whole =
      join_parts(source, report.kappa_effective, options, parameters, std::move(parts), report);
  return finish(std::move(whole), source, dissolved(source, report.kappa_effective, options),
                options, parameters, report);
}

TriMesh mesh_isosurface(const Volume& volume, double isovalue, const Options& options) {
  value_range(volume, "volume");
  Report report;
  return mesh_isosurface(volume, isovalue, options, report);
}

}  // namespace deliso
