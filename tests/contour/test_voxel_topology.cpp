// SPDX-License-Identifier: MIT
// Topology against the exact oracle, for random voxels and small random volumes.
#include "contour/voxel_topology.h"

#include <doctest/doctest.h>

#include "base/random.h"
#include "contour/contour.h"
#include "glued_topology.h"
#include "mesh_checks.h"

using namespace deliso;

namespace {

// Random voxels of many kinds: even values, values over magnitudes, small integers, near-tunnels.
Corners random_corners(Random& random) {
  Corners c;
  const std::uint32_t kind = random.below(4);
  for (double& v : c) {
    const double sign = random.below(2) != 0 ? 1 : -1;
    if (kind == 0) v = random.uniform(-1, 1);
    if (kind == 1) v = sign * std::exp2(random.uniform(-5, 0));
    if (kind == 2) v = static_cast<double>(random.below(16)) - 7.5;
    if (kind == 3) v = random.below(4) == 0 ? sign : sign * random.uniform(0.02, 0.2);
  }
  return c;
}

// Returns the edge of a single voxel on which a vertex of T lies, where two faces of the box meet;
// -1 for inner points.
int edge_of(std::uint8_t box_faces) {
  for (int e = 0; e < 12; ++e) {
    const auto [low, high] = corners_of_edge(e);
    int faces = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis != e / 4) faces |= 1 << (2 * axis + (low >> axis & 1));
    }
    if (faces == box_faces) return e;
  }
  return -1;
}

std::vector<VoxelPiece> pieces_of(const ContourMesh& mesh) {
  std::vector<VoxelPiece> pieces(mesh.summary.components.size());
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    pieces[n].euler = static_cast<int>(mesh.summary.components[n].euler);
    pieces[n].loops = static_cast<int>(mesh.summary.components[n].boundary_loops);
  }
  for (ContourId v = 0; v < mesh.points.size(); ++v) {
    const int e = edge_of(mesh.box_faces[v]);
    if (e >= 0) pieces[mesh.component[v]].edges |= 1 << e;
  }
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

}  // namespace

TEST_CASE("loops of all masks and face decisions use each crossed edge once") {
  for (int mask = 0; mask < 256; ++mask) {
    const int ambiguous = ambiguous_faces(mask);
    for (int joined = 0; joined < 64; ++joined) {
      if ((joined & ~ambiguous) != 0) continue;
      const VoxelLoops loops = trace_loops(mask, static_cast<std::uint8_t>(joined));
      int crossed = 0, used = 0, triangles = 0;
      for (int e = 0; e < 12; ++e) {
        const auto [low, high] = corners_of_edge(e);
        crossed |= ((mask >> low & 1) != (mask >> high & 1)) << e;
      }
      for (int l = 0; l < loops.count; ++l) {
        CHECK(loops.edges(l).size() >= 3);
        triangles += loops.edges(l).size() == 3;
        for (const int e : loops.edges(l)) {
          CHECK((used >> e & 1) == 0);
          used |= 1 << e;
        }
      }
      CHECK(used == crossed);
      // The lemma by which no piece has more than two loops (voxel_topology.h).
      if (loops.count >= 3) CHECK(triangles >= 2);
    }
  }
}

TEST_CASE("random voxels have the oracle's pieces") {
  Random random(11);
  int tubes = 0;
  for (int trial = 0; trial < 30000; ++trial) {
    CAPTURE(trial);
    const Corners c = random_corners(random);
    const VoxelTruth truth = ExactVoxel::solve(c, 0);
    REQUIRE(truth.resolved);
    const auto volume = Volume::from_samples<double>({2, 2, 2}, {1, 1, 1}, {c.begin(), c.end()});
    const ContourMesh mesh = build_contour(volume, 0);
    CHECK(check_contour(mesh, volume, 0) == "");
    CHECK((pieces_of(mesh) == truth.pieces));
    for (const VoxelPiece& piece : truth.pieces) {
      CHECK(piece.loops <= 2);
      CHECK(piece.euler == 2 - piece.loops);
      tubes += piece.loops == 2;
    }
  }
  CHECK(tubes > 100);
}

TEST_CASE("small random volumes have the topology glued from the oracle's voxels") {
  Random random(13);
  for (int trial = 0; trial < 2000; ++trial) {
    CAPTURE(trial);
    const Index3 dims{2 + static_cast<int>(random.below(4)), 2 + static_cast<int>(random.below(4)),
                      2 + static_cast<int>(random.below(4))};
    std::vector<std::int32_t> samples;
    const std::uint32_t levels = trial % 3 == 0 ? 8 : 1000;
    for (int n = 0; n < dims.i * dims.j * dims.k; ++n) {
      samples.push_back(static_cast<std::int32_t>(random.below(levels)));
    }
    const Volume volume = Volume::from_samples(dims, {1, 1, 1}, samples);
    const double kappa =
        geometric_isovalue(volume.type(), random.below(levels) + (trial % 3 == 1 ? 0.5 : 0));
    const auto expected = glue_voxels(volume, kappa);
    REQUIRE(expected);
    const ContourMesh mesh = build_contour(volume, kappa);
    CHECK(check_contour(mesh, volume, kappa) == "");
    CHECK((*expected == kinds_of(mesh.summary)));
  }
}
