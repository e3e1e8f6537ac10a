// SPDX-License-Identifier: MIT
#include "stage1/first_sample.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include "base/check.h"
#include "base/random.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "surface/observer.h"

namespace deliso {
namespace {

// Largest sagitta of the coarse boundary chain, as a share of the chord.
constexpr double kChainSagitta = 0.1;
// The side of a block with a point of its own.
constexpr double kBlockVoxels = 8;

// Returns the component of a vertex and the block of kBlockVoxels^3 voxels that holds it.
using Block = std::array<std::uint32_t, 4>;
Block block_of(VertexId v, const ContourMesh& contour, const Volume& volume) {
  Block block{contour.component[v]};
  for (int axis = 0; axis < 3; ++axis) {
    block[static_cast<std::size_t>(axis) + 1] = static_cast<std::uint32_t>(
        contour.points[v][axis] / (kBlockVoxels * volume.spacing()[axis]));
  }
  return block;
}

}  // namespace

void require_room(const Triangulation& triangulation, const Parameters& parameters) {
  if (triangulation.vertex_capacity() <= parameters.max_vertices) return;
  throw InputError("more than --max-vertices ", parameters.max_vertices,
                   " vertices needed before the surface is recovered");
}

FirstSample init_triangulation(const ContourMesh& contour, const BoundaryCurves& curves,
                               const Volume& volume, const Parameters& parameters, Report& report) {
  const StepTimer timer(report.seconds_init);
  begin_stage(parameters.observer, "initial");
  FirstSample out;
  std::vector<VertexId> seeds;  // vertices of the chains first, loop by loop
  std::vector<std::vector<CurvePlace>> chains;
  for (std::uint32_t loop = 0; loop < curves.loop_count(); ++loop) {
    chains.push_back(curves.coarse_chain(loop, kChainSagitta));
    for (const CurvePlace place : chains.back()) {
      seeds.push_back(contour.boundary.chain(loop)[static_cast<std::size_t>(place.s)]);
    }
  }
  std::set<Block> seen;
  Block last{kNoId};
  for (VertexId v = 0; v < contour.points.size(); ++v) {
    if (contour.on_boundary(v)) continue;  // there the chain has its own
    const Block block = block_of(v, contour, volume);
    // Neighbors in T mostly share a block.
    if (block != last && seen.insert(block).second) seeds.push_back(v);
    last = block;
  }
  Random random(parameters.seed);
  for (std::size_t i = 0; i < parameters.samples && !contour.points.empty(); ++i) {
    const VertexId v(random.below(static_cast<std::uint32_t>(contour.points.size())));
    if (!contour.on_boundary(v)) seeds.push_back(v);
  }

  std::vector<Vec3> points;
  points.reserve(seeds.size());
  for (const VertexId v : seeds) points.push_back(contour.points[v]);
  append_auxiliary(volume.box(), points);
  std::vector<SiteId> ids;
  DELISO_CHECK(out.triangulation.build(points, ids));
  std::size_t first = 0;
  for (const std::vector<CurvePlace>& chain : chains) {
    out.chain.add_loop(std::span(ids).subspan(first, chain.size()), chain);
    first += chain.size();
  }
  report.points_initial = out.triangulation.vertex_capacity() - 1 - kAuxiliaryVertices;
  return out;
}

}  // namespace deliso
