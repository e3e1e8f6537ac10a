// SPDX-License-Identifier: MIT
#include "blocks/block.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/stopwatch.h"
#include "blocks/choose_seams.h"
#include "blocks/clear_seam.h"
#include "blocks/seam.h"
#include "contour/contour.h"
#include "deliso/deliso.h"
#include "recover/recover.h"
#include "refine/lift_off.h"
#include "refine/refine.h"
#include "stage1/first_sample.h"
#include "surface/observer.h"

namespace deliso {
namespace {

// Rounds in which a seam is cleared. An edge within the face can block the removal of a vertex.
// That edge leaves the face in the same round, so the next round can remove the vertex.
constexpr int kMaxSeamRounds = 3;

// Samples this near to an inner face are held against the welded mesh: the facet that is nearest
// may be the neighbor's.
constexpr double kNearSeamVoxels = 2;

bool is_near_seam(const Vec3& p, const Volume& block) {
  const Box3 box = block.box();
  const double near = kNearSeamVoxels * block.voxel();
  for (BoxFace face = 0; face < 6; ++face) {
    if ((block.inner_faces() >> face & 1) == 0) continue;
    const int axis = axis_of(face);
    if ((face & 1) != 0 ? p[axis] > box.hi[axis] - near : p[axis] < box.lo[axis] + near) {
      return true;
    }
  }
  return false;
}

// Returns the block's share of the random points, by its size.
std::size_t share_of_samples(std::size_t samples, const Volume& block, const Volume& whole) {
  const auto voxels = [](const Volume& v) {
    return static_cast<double>(v.voxels().i) * v.voxels().j * v.voxels().k;
  };
  const double share = voxels(block) / voxels(whole);
  return static_cast<std::size_t>(std::ceil(share * static_cast<double>(samples)));
}

void clear(Block& block, const BoxSurface& at, const BlockRun& run) {
  const unsigned inner = at.volume.inner_faces();
  if (inner == 0) return;
  const BoundaryCurves curves(at.surface, block.loops);
  std::size_t unknown = 1, flat = 0;
  for (int round = 0; round < kMaxSeamRounds && unknown + flat > 0; ++round) {
    unknown = clear_seam(block.mesh, at.surface, curves, run.parameters, block.report);
    flat = lift_off(block.mesh, at.surface, curves, inner, OffSurface::refused, run.parameters,
                    block.report);
  }
  block.refused = faulty_faces(block.mesh, curves, at.volume);
  // Blocks wait for each other.
  block.mesh.mesh.points.shrink_to_fit();
  block.mesh.mesh.faces.shrink_to_fit();
  block.mesh.duals.shrink_to_fit();
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

}  // namespace

VolumeSource source_of(const Volume& volume) {
  return {
      Volume::without_samples(volume.whole_dims(), volume.spacing(), volume.type(), volume.frame()),
      [volume](const SampleBox& box) { return samples_of(volume, box); }, volume};
}

Volume all_of(const VolumeSource& source) {
  return source.in_memory ? *source.in_memory : source.read({{}, source.shape.voxels()});
}

BoxSurface::BoxSurface(Volume of_box, double kappa)
    : volume(std::move(of_box)), surface(volume, kappa) {}

Block mesh_block(const BlockRun& run, const SampleBox& box, std::span<const std::uint8_t> kept) {
  Block block;
  block.box = box;
  Report& report = block.report;
  const Volume volume = run.source.read(box);
  begin_stage(run.parameters.observer, "contour");
  ContourMesh contour =
      timed(report.seconds_contour, [&] { return build_contour(volume, run.kappa); });
  if (contour.points.empty()) return block;
  block.components.push_back(components_of(contour, volume));
  const BoxSurface at(volume, run.kappa);
  Parameters parameters = run.parameters;
  parameters.samples = share_of_samples(parameters.samples, at.volume, run.source.shape);
  make_fine(contour, at.surface, parameters, report);
  if (!kept.empty()) keep_components(contour, kept);
  if (contour.points.empty()) return block;

  BoundaryLoops loops = boundary_loops(contour);
  choose_seams(at.volume, run.grid, loops);
  block.loops = std::make_shared<const BoundaryLoops>(std::move(loops));
  std::vector<Vec3> samples;
  for (const Vec3& p : contour.points) {
    (is_near_seam(p, at.volume) ? block.samples_near_seams : samples).push_back(p);
  }
  block.samples_near_seams.shrink_to_fit();
  const bool has_seams = at.volume.inner_faces() != 0;
  const BoundaryCurves curves(at.surface, block.loops);
  Options options = run.options;
  options.stop_after_recover |= run.parameters.has_target() || has_seams;
  block.mesh = delaunay_mesh(at.surface, contour, curves, samples, options, parameters, report);
  // Stage 1 knows most of what a seam will lack, so a larger block is known to be needed soon.
  if (has_seams) clear(block, at, run);
  if (block.refused != 0 || run.options.stop_after_recover) return block;
  if (run.parameters.has_target()) {
    block.samples = std::move(samples);
    return block;
  }
  if (!has_seams) return block;
  refine(block.mesh, at.surface, curves, samples, parameters, report);
  clear(block, at, run);
  return block;
}

void refine_block(const BlockRun& run, const Parameters& parameters, Block& block) {
  if (block.mesh.mesh.faces.empty()) return;
  const BoxSurface at(run.source.read(block.box), run.kappa);
  refine(block.mesh, at.surface, {at.surface, block.loops}, block.samples, parameters,
         block.report);
}

void make_seam(const BlockRun& run, Block& block) {
  if (block.mesh.mesh.faces.empty()) return;
  clear(block, BoxSurface(run.source.read(block.box), run.kappa), run);
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
