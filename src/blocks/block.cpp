// SPDX-License-Identifier: MIT
#include "blocks/block.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/stopwatch.h"
#include "coarsen/coarsen.h"
#include "coarsen/contour_as_mesh.h"
#include "contour/contour.h"
#include "contour/fine_contour.h"
#include "contour/plain_seams.h"
#include "contour/split_voxels.h"
#include "refine/refine.h"
#include "run/observer.h"

namespace deliso {
namespace {

// Samples this near to an inner face are held against the welded mesh: the facet that is nearest
// may be the neighbor's.
constexpr double kNearSeamVoxels = 2;

// Returns the box of the points that are not so near.
Box3 box_within_seams(const Volume& block) {
  Box3 box = block.box();
  const double near = kNearSeamVoxels * block.voxel();
  for (BoxFace face = 0; face < 6; ++face) {
    if ((block.inner_faces() >> face & 1) == 0) continue;
    ((face & 1) != 0 ? box.hi : box.lo)[axis_of(face)] -= (face & 1) != 0 ? near : -near;
  }
  return box;
}

// Returns the vertices, and those beside them.
IdArray<VertexId, std::uint8_t> with_neighbors(const IdArray<VertexId, std::uint8_t>& some,
                                               const TriMesh& mesh) {
  IdArray<VertexId, std::uint8_t> more = some;
  for (const Face& face : mesh.faces) {
    if (some[face.v[0]] + some[face.v[1]] + some[face.v[2]] == 0) continue;
    for (const VertexId v : face.v) more[v] = 1;
  }
  return more;
}

// Makes T embedded, and its seams plain.
void make_embedded(ContourMesh& contour, const Volume& volume, Index3 cells, const BlockRun& run,
                   Report& report) {
  begin_stage(run.parameters.observer, "cutting");
  const StepTimer timer(report.seconds_contour);
  contour = fine_contour(std::move(contour), volume, run.kappa, cells);
  make_seams_plain(contour, volume);
  report[Counter::voxels_cut] = contour.split_voxels;
  report[Counter::voxels_crossed] = contour.crossed_voxels.size();
}

}  // namespace

Block mesh_block(const BlockRun& run, const SampleBox& box, std::span<const std::uint8_t> kept) {
  Block block;
  block.box = box;
  Report& report = block.report;
  const Volume volume = run.source.read(box);
  begin_stage(run.parameters.observer, "contour");
  const Index3 cells = cells_of_long_voxels(volume.spacing());
  ContourMesh contour = timed(report.seconds_contour,
                              [&] { return build_contour(volume, run.kappa, {.usual = cells}); });
  if (contour.points.empty()) return block;
  block.components.push_back(components_of(contour, volume));
  make_embedded(contour, volume, cells, run, report);
  if (!kept.empty()) keep_components(contour, kept);
  if (contour.points.empty()) return block;

  const BoxSurface at(volume, run.kappa);
  block.loops = std::make_shared<const BoundaryLoops>(std::move(contour.boundary.loops));
  const BoundaryCurves curves(at.surface, block.loops);
  const Box3 within = box_within_seams(at.volume);
  for (const Vec3& p : contour.points) {
    (within.contains(p) ? block.samples : block.samples_near_seams).push_back(p);
  }
  const Given given{at.surface, curves, run.parameters, report};
  Observer* const observer = follower(run.parameters.observer);
  if (observer) observer->run_begins(run.parameters, report);
  block.mesh = contour_as_mesh(contour);
  contour = {};
  if (observer) observer->contour_ready(block.mesh);
  coarsen(block.mesh, given);
  if (observer) observer->mesh_handed_over(block.mesh);
  if (!run.options.stop_after_stage1) {
    refine(block.mesh, block.samples, given);
    block.samples = {};
  }
  if (observer) observer->mesh_finished();
  if (at.volume.inner_faces() == 0) return block;
  // Blocks wait for each other.
  block.samples_near_seams.shrink_to_fit();
  block.mesh.shrink_to_fit();
  return block;
}

void coarsen_block(const BlockRun& run, Block& block) {
  if (block.mesh.mesh.faces.empty()) return;
  const BoxSurface at(run.source.read(block.box), run.kappa);
  const BoundaryCurves curves(at.surface, block.loops);
  coarsen(block.mesh, {at.surface, curves, run.parameters, block.report});
}

void refine_block(const BlockRun& run, Block& block) {
  if (block.mesh.mesh.faces.empty()) return;
  const BoxSurface at(run.source.read(block.box), run.kappa);
  const BoundaryCurves curves(at.surface, block.loops);
  refine(block.mesh, block.samples, {at.surface, curves, run.parameters, block.report});
}

bool is_on_seam(const Block& block, VertexId v) {
  if (!block.mesh.chain.is_boundary(v)) return false;
  const CurvePlace place = block.mesh.chain.place(v);
  return is_on_fixed((*block.loops)[place.loop], place.s);
}

void mark_seam_work(Block& block) {
  const TriMesh& mesh = block.mesh.mesh;
  IdArray<VertexId, std::uint8_t> on_seam(mesh.points.size(), 0);
  for (VertexId v = 0; v < on_seam.size(); ++v) on_seam[v] = is_on_seam(block, v);
  block.is_open.assign(mesh.faces.size(), 0);
  for (FaceId f = 0; f < mesh.faces.size(); ++f) {
    for (const VertexId v : mesh.faces[f].v) block.is_open[f] |= on_seam[v];
  }
  block.may_thin = with_neighbors(with_neighbors(on_seam, mesh), mesh);
}

}  // namespace deliso
