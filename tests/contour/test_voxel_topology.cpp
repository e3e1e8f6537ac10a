// SPDX-License-Identifier: MIT
// Topology against the exact oracle. For random voxels, each of the known
// cases of trilinear voxels (Chernyaev 1995, Lewiner et al. 2003), and small random volumes.
#include "contour/voxel_topology.h"

#include <doctest/doctest.h>

#include <string>

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

// Random values of given signs, over magnitudes: the wider these, the more tunnels.
Corners random_corners(Random& random, int mask) {
  Corners c;
  const double low = random.uniform(-10, -2);
  for (int m = 0; m < 8; ++m) {
    c[m] = ((mask >> m & 1) != 0 ? 1 : -1) * std::exp2(random.uniform(low, 0));
  }
  return c;
}

Volume volume_of(const Corners& c) {
  return Volume::from_samples<double>({2, 2, 2}, {1, 1, 1}, {c.begin(), c.end()});
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

// Checks that T of the voxel is valid and has the oracle's pieces, which are returned.
VoxelTruth checked_truth(const Corners& c) {
  const VoxelTruth truth = ExactVoxel::solve(c, 0);
  REQUIRE(truth.resolved);
  const Volume volume = volume_of(c);
  const ContourMesh mesh = build_contour(volume, 0);
  CHECK(check_contour(mesh, volume, 0) == "");
  CHECK((pieces_of(mesh) == truth.pieces));
  return truth;
}

// True if the oracle joins the inside corners of an ambiguous face: then an edge is joined to the
// edge with which it shares an outside corner.
bool joined_inside(const VoxelTruth& truth, int mask, int face) {
  for (int e = 0; e < 12; ++e) {
    const int mate = truth.mate[face][e];
    if (mate < 0) continue;
    for (const int corner : corners_of_edge(e)) {
      const auto other = corners_of_edge(mate);
      if (corner == other[0] || corner == other[1]) return (mask >> corner & 1) == 0;
    }
  }
  return false;
}

struct KnownCase {
  std::string name;
  int mask;
  int joined_faces;
  int loops;
  bool tube;
};

constexpr int corners(std::initializer_list<int> inside) {
  int mask = 0;
  for (const int m : inside) mask |= 1 << m;
  return mask;
}

// Names as in Lewiner et al.; 12.3 is 12.2 with the other of the two faces joined.
const std::vector<KnownCase>& known_cases() {
  static const std::vector<KnownCase> cases{
      {"1", corners({0}), 0, 1, false},
      {"2", corners({0, 1}), 0, 1, false},
      {"3.1", corners({0, 3}), 0, 2, false},
      {"3.2", corners({0, 3}), 1, 1, false},
      {"4.1.1", corners({0, 7}), 0, 2, false},
      {"4.1.2", corners({0, 7}), 0, 2, true},
      {"5", corners({0, 1, 2}), 0, 1, false},
      {"6.1.1", corners({0, 1, 7}), 0, 2, false},
      {"6.1.2", corners({0, 1, 7}), 0, 2, true},
      {"6.2", corners({0, 1, 7}), 1, 1, false},
      {"7.1", corners({1, 2, 4}), 0, 3, false},
      {"7.2", corners({1, 2, 4}), 1, 2, false},
      {"7.3", corners({1, 2, 4}), 2, 1, false},
      {"7.4.1", corners({1, 2, 4}), 3, 2, false},
      {"7.4.2", corners({1, 2, 4}), 3, 2, true},
      {"8", corners({0, 1, 2, 3}), 0, 1, false},
      {"9", corners({0, 1, 2, 4}), 0, 1, false},
      {"10.1.1", corners({0, 4, 3, 7}), 0, 2, false},
      {"10.1.2", corners({0, 4, 3, 7}), 0, 2, true},
      {"10.2", corners({0, 4, 3, 7}), 1, 1, false},
      {"11", corners({0, 1, 3, 7}), 0, 1, false},
      {"12.1.1", corners({0, 1, 2, 7}), 0, 2, false},
      {"12.1.2", corners({0, 1, 2, 7}), 0, 2, true},
      {"12.2 and 12.3", corners({0, 1, 2, 7}), 1, 1, false},
      {"13.1", corners({0, 3, 5, 6}), 0, 4, false},
      {"13.2", corners({0, 3, 5, 6}), 1, 3, false},
      {"13.3", corners({0, 3, 5, 6}), 2, 2, false},
      {"13.4", corners({0, 3, 5, 6}), 3, 1, false},
      {"13.5.1", corners({0, 3, 5, 6}), 3, 3, false},
      {"13.5.2", corners({0, 3, 5, 6}), 3, 3, true},
      {"14", corners({0, 2, 3, 7}), 0, 1, false},
  };
  return cases;
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
    for (const auto& piece : checked_truth(random_corners(random)).pieces) {
      tubes += piece.loops == 2;
    }
  }
  CHECK(tubes > 100);
}

TEST_CASE("every known case of a trilinear voxel, tunnels included, is met and right") {
  Random random(12);
  for (const KnownCase& known : known_cases()) {
    int met = 0;
    for (int trial = 0; trial < 20000 && met < 30; ++trial) {
      CAPTURE(known.name);
      CAPTURE(trial);
      const VoxelTruth truth = checked_truth(random_corners(random, known.mask));
      int joined = 0, loops = 0;
      bool tube = false;
      for (int f = 0; f < 6; ++f) {
        const bool ambiguous = (ambiguous_faces(known.mask) >> f & 1) != 0;
        joined += ambiguous && joined_inside(truth, known.mask, f);
      }
      for (const auto& piece : truth.pieces) {
        loops += piece.loops;
        tube = tube || piece.loops == 2;
        CHECK(piece.loops <= 2);
        CHECK(piece.euler == 2 - piece.loops);
      }
      met += joined == known.joined_faces && loops == known.loops && tube == known.tube;
    }
    CHECK_MESSAGE(met >= 30, "case " << known.name << " met " << met);
  }
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
