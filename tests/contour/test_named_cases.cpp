// SPDX-License-Identifier: MIT
// The cases of a trilinear voxel that the literature names, each by eight values of our own, with
// its loops, pieces and Euler numbers.
//
// "1" to "14" are Chernyaev's (1995, "Marching Cubes 33"), numbered as in Lewiner et al. 2003. The
// decisions on faces are Nielson and Hamann's (1991). Tunnels: Nielson 2003, Lopes and Brodlie
// 2003. In brackets stand Grosso's names (2016, "Construction of topologically correct and manifold
// isosurfaces"), as CGAL's test of Isosurfacing_3 has them. Such a case has a loop of n vertices,
// or a tunnel.
//
// "Singular", "edge" and "plane" are from that test, too: saddles of faces at kappa; samples at
// kappa along an edge; or on a face. Sigma is no manifold there, and programs differ. Ours takes it
// as if kappa were a little lower. So a case and its complement may have different topologies.
//
// What is compared follows Etiene et al. 2012, "Topology verification for isosurface extraction".
// The voxel stands alone, and in a grid whose other samples are outside.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "contour/contour.h"
#include "contour/exact_voxel.h"
#include "contour/glued_topology.h"
#include "contour/mesh_checks.h"
#include "contour/voxel_topology.h"

using namespace deliso;

namespace {

struct NamedCase {
  std::string name;
  Corners value;            // minus kappa
  std::vector<int> disks;   // numbers of vertices of the loops that bound a disk each, ascending
  std::vector<int> tube;    // of the two that bound a tube
  std::vector<int> closed;  // Euler numbers of T where all around is outside, ascending
};

// Spheres have the Euler number 2, a torus has 0.
const std::vector<NamedCase>& named_cases() {
  static const std::vector<NamedCase> cases{
      {"1", {1, -1, -1, -1, -1, -1, -1, -1}, {3}, {}, {2}},
      {"2", {1, 1, -1, -1, -1, -1, -1, -1}, {4}, {}, {2}},
      {"3.1", {1, -2, -1, 1, -1, -1, -1, -1}, {3, 3}, {}, {2, 2}},
      {"3.2 (CONTOUR_6_VTS)", {2, -1, -1, 1, -1, -1, -1, -1}, {6}, {}, {2}},
      {"4.1.1", {1, -1, -1, -1, -1, -1, -1, 1}, {3, 3}, {}, {2, 2}},
      {"4.1.2 (MC_4_TUNNEL)", {3, -1, -1, -1, -1, -1, -1, 4}, {}, {3, 3}, {2}},
      {"4.1.2, complement", {-3, 1, 1, 1, 1, 1, 1, -4}, {}, {3, 3}, {0}},
      {"5", {1, 1, 1, -1, -1, -1, -1, -1}, {5}, {}, {2}},
      {"6.1.1", {1, 1, -1, -1, -1, -2, -1, 1}, {3, 4}, {}, {2, 2}},
      {"6.1.2", {4, 1, -1, -2, -1, -2, -1, 3}, {}, {3, 4}, {2}},
      {"6.2 (CONTOUR_7_VTS)", {1, 1, -1, -1, -1, -1, -1, 2}, {7}, {}, {2}},
      {"7.1", {-2, 1, 1, -1, 1, -1, -1, -1}, {3, 3, 3}, {}, {2, 2, 2}},
      {"7.2", {-2, 1, 2, -2, 2, -2, -1, -1}, {3, 6}, {}, {2, 2}},
      {"7.3 (CONTOUR_9_VTS)", {-1, 1, 2, -1, 1, -2, -1, -1}, {9}, {}, {2}},
      {"7.4.1", {-1, 2, 2, -1, 1, -1, -1, -1}, {3, 6}, {}, {2}},
      {"7.4.2 (MC_7_TUNNEL)", {-3, 2, 2, -1, 2, -1, -1, -1}, {}, {3, 6}, {0}},
      {"8", {1, 1, 1, 1, -1, -1, -1, -1}, {4}, {}, {2}},
      {"9", {1, 1, 1, -1, 1, -1, -1, -1}, {6}, {}, {2}},
      {"10.1.1", {1, -2, -1, 1, 1, -2, -1, 1}, {4, 4}, {}, {2, 2}},
      {"10.1.2 (MC_10_TUNNEL)", {1, -2, -2, 3, 4, -3, -2, 1}, {}, {4, 4}, {2}},
      {"10.1.2, joined on both faces", {2, -3, -1, 2, 2, -1, -4, 3}, {}, {4, 4}, {0}},
      {"10.2 (CONTOUR_8_VTS_CONFIG_B)", {1, -2, -1, 1, 2, -1, -1, 1}, {8}, {}, {2}},
      {"11", {1, 1, -1, 1, -1, -1, -1, 1}, {6}, {}, {2}},
      {"12.1.1", {1, 1, 1, -2, -1, -1, -1, 1}, {3, 5}, {}, {2, 2}},
      {"12.1.2 (MC_12_TUNNEL)", {3, 1, 1, -3, -1, -1, -1, 2}, {}, {3, 5}, {2}},
      {"12.1.2, joined on both faces", {1, 1, 1, -2, -3, -1, -1, 3}, {}, {3, 5}, {0}},
      {"12.2 (CONTOUR_8_VTS_CONFIG_A)", {1, 1, 2, -1, -1, -2, -1, 1}, {8}, {}, {2}},
      {"13.1", {1, -2, -2, 1, -2, 1, 1, -1}, {3, 3, 3, 3}, {}, {2, 2, 2, 2}},
      {"13.2 (MC_13_SIMPLE)", {1, -2, -3, 1, -1, 1, 2, -1}, {3, 3, 6}, {}, {2, 2, 2}},
      {"13.3", {1, -2, -1, 1, -2, 1, 3, -2}, {3, 9}, {}, {2, 2}},
      {"13.4 (MC_13_12_VTS)", {1, -1, -2, 1, -1, 2, 1, -1}, {12}, {}, {2}},
      {"13.5.1", {1, -2, -2, 2, -2, 2, 2, -1}, {3, 3, 6}, {}, {2, 2}},
      {"13.5.2 (MC_13_TUNNEL)", {2, -3, -3, 4, -3, 3, 4, -1}, {3}, {3, 6}, {2}},
      {"13.5.2, complement", {-2, 3, 3, -4, 3, -3, -4, 1}, {3}, {3, 6}, {0, 2}},
      {"14", {1, -1, 1, 1, -1, -1, -1, 1}, {6}, {}, {2}},
      {"singular, simple", {-1, -1, -1, -1, 1, -1, -1, 1}, {6}, {}, {2}},
      {"singular, simple, complement", {1, 1, 1, 1, -1, 1, 1, -1}, {3, 3}, {}, {2}},
      {"singular, double", {-1, -2, -1, 1, -1, 1, 1, -1}, {9}, {}, {2}},
      {"singular, double, complement", {1, 2, 1, -1, 1, -1, -1, 1}, {3, 3, 3}, {}, {2}},
      {"singular, triple", {-1, 1, -1, -1, 1, -1, -1, 1}, {}, {3, 6}, {0}},
      {"singular, triple, complement", {1, -1, 1, 1, -1, 1, 1, -1}, {3, 3, 3}, {}, {2}},
      {"singular, tunnel open", {-1, 1, -2, 1, 1, -1, 1, -1}, {8}, {}, {2}},
      {"singular, tunnel open, complement", {1, -1, 2, -1, -1, 1, -1, 1}, {4, 4}, {}, {2}},
      {"singular, tunnel", {-1, 1, -3, 2, 2, -2, 2, -1}, {}, {4, 4}, {0}},
      {"singular, tunnel, complement", {1, -1, 3, -2, -2, 2, -2, 1}, {8}, {}, {2}},
      {"singular, double tunnel", {-2, 1, 2, -1, -2, 2, 1, -1}, {4, 4}, {}, {2}},
      {"singular, double tunnel, complement", {2, -1, -2, 1, 2, -2, -1, 1}, {}, {4, 4}, {0}},
      {"edge, simple", {0, 1, -1, -1, 0, 1, -1, -1}, {4}, {}, {2}},
      {"edge, simple, complement", {0, -1, 1, 1, 0, -1, 1, 1}, {4}, {}, {2}},
      {"edge, separated", {0, 1, 1, -1, 0, 1, 1, -1}, {4}, {}, {2}},
      {"edge, separated, complement", {0, -1, -1, 1, 0, -1, -1, 1}, {4, 4}, {}, {2, 2}},
      {"edge, singular", {0, -1, 1, -1, 0, 1, 1, -1}, {5}, {}, {2}},
      {"edge, singular, complement", {0, 1, -1, 1, 0, -1, -1, 1}, {7}, {}, {2}},
      {"edge, double singular, simple", {0, -1, -1, -1, 0, 1, 1, 1}, {5}, {}, {2}},
      {"edge, double singular", {0, -1, -1, -1, 0, 1, 1, -1}, {6}, {}, {2}},
      {"edge, double singular, complement", {0, 1, 1, 1, 0, -1, -1, 1}, {6}, {}, {2}},
      {"edge, double singular, split", {0, -1, 1, -1, 0, 1, -1, -1}, {6}, {}, {2}},
      {"edge, split, complement", {0, 1, -1, 1, 0, -1, 1, 1}, {3, 3}, {}, {2}},
      {"edge, wedge", {0, 0, -1, -1, 0, 1, -1, -1}, {4}, {}, {2}},
      {"edge, wedge, complement", {0, 0, 1, 1, 0, -1, 1, 1}, {3}, {}, {2}},
      {"edge, wedge, singular", {0, 0, 1, -1, 0, 1, 1, -1}, {4}, {}, {2}},
      {"edge, wedge, singular, complement", {0, 0, -1, 1, 0, -1, -1, 1}, {7}, {}, {2}},
      {"edge, tunnel", {1, -1, 1, 1, 1, 0, -2, 0}, {}, {3, 3}, {0}},
      {"edge, tunnel, complement", {-1, 1, -1, -1, -1, 0, 2, 0}, {6}, {}, {2}},
      {"plane, simple", {0, 1, 0, 1, 0, 1, 0, 1}, {}, {}, {2}},
      {"plane, simple, complement", {0, -1, 0, -1, 0, -1, 0, -1}, {4}, {}, {2}},
      {"plane, two that cross", {-1, 1, 1, -1, -1, 1, 1, -1}, {4, 4}, {}, {2}},
      {"plane, tubes", {-1, 1, 1, -2, 0, 0, 0, 0}, {6}, {}, {2}},
      {"plane, tubes, complement", {1, -1, -1, 2, 0, 0, 0, 0}, {3, 3}, {}, {2}},
      {"plane, cross", {1, -1, -1, 1, -1, 1, 1, -1}, {3, 3, 3, 3}, {}, {2}},
  };
  return cases;
}

// The 48 ways in which a cube falls onto itself: corners with their axes in another order, and some
// axes reversed.
std::vector<std::array<int, 8>> symmetries() {
  std::vector<std::array<int, 8>> all;
  std::array<int, 3> axes{0, 1, 2};
  do {
    for (int reversed = 0; reversed < 8; ++reversed) {
      std::array<int, 8> to{};
      for (int m = 0; m < 8; ++m) {
        for (int axis = 0; axis < 3; ++axis) to[m] |= (m >> axes[axis] & 1) << axis;
        to[m] ^= reversed;
      }
      all.push_back(to);
    }
  } while (std::ranges::next_permutation(axes).found);
  return all;
}

// Returns the voxel alone.
Volume alone(const Corners& value) {
  return Volume::from_samples<double>({2, 2, 2}, {1, 1, 1}, {value.begin(), value.end()});
}

// Returns the voxel in the middle of samples that are outside.
Volume all_around_outside(const Corners& value) {
  std::vector<double> samples(64, -20);
  for (int m = 0; m < 8; ++m) {
    const Index3 at = corner_of({1, 1, 1}, m);
    samples[static_cast<std::size_t>(at.i + 4 * at.j + 16 * at.k)] = value[m];
  }
  return Volume::from_samples<double>({4, 4, 4}, {1, 1, 1}, samples);
}

// Returns the case with the loops that voxel_loops() and find_tube() find.
NamedCase as_found(const NamedCase& known, const Corners& value) {
  NamedCase found = known;
  found.disks.clear();
  found.tube.clear();
  const int mask = mask_of(value);
  const VoxelValues values(value, 0);
  const VoxelLoops loops = voxel_loops(mask, values);
  const Tube tube = find_tube(mask, values, loops);
  for (int l = 0; l < loops.count; ++l) {
    const bool is_tube = tube && (l == tube.a || l == tube.b);
    (is_tube ? found.tube : found.disks).push_back(static_cast<int>(loops.edges(l).size()));
  }
  std::ranges::sort(found.disks);
  std::ranges::sort(found.tube);
  return found;
}

// Returns the kinds of T's components, once T was checked.
ComponentKinds kinds_of_checked(const Volume& volume) {
  const ContourMesh t = build_contour(volume, 0);
  CHECK(check_contour(t, volume, 0) == "");
  return kinds_of(t.summary);
}

}  // namespace

TEST_CASE("the named cases of the literature have their loops, pieces and Euler numbers") {
  const std::vector<std::array<int, 8>> all = symmetries();
  REQUIRE(all.size() == 48);
  for (const NamedCase& known : named_cases()) {
    CAPTURE(known.name);
    ComponentKinds pieces, closed;
    for (std::size_t n = 0; n < known.disks.size(); ++n) pieces.emplace_back(1, 1);
    if (!known.tube.empty()) pieces.emplace_back(0, 2);
    std::ranges::sort(pieces);
    for (const int euler : known.closed) closed.emplace_back(euler, 0);
    for (std::size_t s = 0; s < all.size(); ++s) {
      CAPTURE(s);
      Corners value;
      for (int m = 0; m < 8; ++m) value[all[s][m]] = known.value[m];
      const NamedCase found = as_found(known, value);
      CHECK(found.disks == known.disks);
      CHECK(found.tube == known.tube);
      CHECK((kinds_of_checked(alone(value)) == pieces));
      CHECK((kinds_of_checked(all_around_outside(value)) == closed));
    }
    CHECK((glue_voxels(alone(known.value), 0) == pieces));
    CHECK((glue_voxels(all_around_outside(known.value), 0) == closed));
  }
}
