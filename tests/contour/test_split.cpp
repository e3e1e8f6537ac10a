// SPDX-License-Identifier: MIT
// T made finer in some voxels: still a manifold on Sigma, of the plain T's topology, for random
// volumes and random sets of voxels.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "base/random.h"
#include "cases.h"
#include "check/check_mesh.h"
#include "coarsen/contour_as_mesh.h"
#include "contour/split_voxels.h"
#include "mesh_checks.h"
#include "volume/sampled.h"
#include "volume/volume_source.h"

using namespace deliso;

namespace {

bool same_mesh(const ContourMesh& a, const ContourMesh& b) {
  return a.points == b.points && a.component == b.component && a.box_faces == b.box_faces &&
         a.triangles == b.triangles && a.boundary == b.boundary && a.summary == b.summary;
}

// The crossings of the plain T's grid edges are vertices of the finer one, in the same order.
bool keeps_crossings(const ContourMesh& plain, const ContourMesh& finer, const Volume& volume) {
  ContourId at = 0;
  for (const Vec3& p : plain.points) {
    int on_planes = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double s = volume.spacing()[axis];
      on_planes += p[axis] == std::round(p[axis] / s) * s;
    }
    if (on_planes < 2) continue;
    while (at < finer.points.size() && !(finer.points[at] == p)) ++at;
    if (at == finer.points.size()) return false;
    ++at;
  }
  return true;
}

// The volume within each component without boundary, positive if the triangles face outwards.
std::vector<double> enclosed_volumes(const ContourMesh& mesh) {
  std::vector<double> sum(mesh.summary.components.size());
  std::vector<std::optional<Vec3>> origin(sum.size());  // near by: some are tiny
  for (const auto& t : mesh.triangles) {
    auto& o = origin[mesh.component[t[0]]];
    if (!o) o = mesh.points[t[0]];
    sum[mesh.component[t[0]]] +=
        dot(mesh.points[t[0]] - *o, cross(mesh.points[t[1]] - *o, mesh.points[t[2]] - *o)) / 6;
  }
  for (std::size_t c = 0; c < sum.size(); ++c) {
    if (mesh.summary.components[c].boundary_loops > 0) sum[c] = 0;
  }
  return sum;
}

Volume random_volume(Random& random, Index3 dims, const std::function<double()>& value) {
  const Vec3 spacing{random.uniform(0.2, 3), random.uniform(0.2, 3), random.uniform(0.2, 3)};
  std::vector<double> samples;
  for (int n = 0; n < dims.i * dims.j * dims.k; ++n) samples.push_back(value());
  return Volume::from_samples(dims, spacing, samples);
}

Index3 random_dims(Random& random, int from, int to) {
  const auto pick = [&] {
    return from + static_cast<int>(random.below(static_cast<std::uint32_t>(to - from + 1)));
  };
  return {pick(), pick(), pick()};
}

bool is_active(const Volume& volume, double kappa, Index3 voxel) {
  const Corners c = volume.corners(voxel);
  const auto inside = std::count_if(c.begin(), c.end(), [&](double v) { return v >= kappa; });
  return inside > 0 && inside < 8;
}

// Splits each active voxel with the given probability, and in half of the cases the others, too.
ContourSplit random_split(Random& random, const Volume& volume, double kappa, double share) {
  ContourSplit split;
  split.factor = random_dims(random, 1, 4);
  if (random.below(2) == 0) split.usual = random_dims(random, 1, 4);
  const Index3 n = volume.voxels();
  const auto voxels = static_cast<std::uint64_t>(n.i) * static_cast<std::uint64_t>(n.j) *
                      static_cast<std::uint64_t>(n.k);
  for (std::uint64_t v = 0; v < voxels; ++v) {
    const bool is_chosen = random.uniform(0, 1) < share;
    if (is_chosen && is_active(volume, kappa, numbered_voxel(volume.dims(), v))) {
      split.voxels.push_back(v);
    }
  }
  return split;
}

struct Tally {
  std::uint64_t split = 0, expected = 0, tubes = 0, with_boundary = 0, closed = 0;
  std::uint64_t cut_everywhere = 0;  // some voxels into other cells than the others
};

void check_split(Random& random, const Volume& volume, double kappa, Tally& tally) {
  const ContourMesh plain = build_contour(volume, kappa);
  const double shares[] = {0, 0.1, 0.3, 0.6, 1};
  const ContourSplit split = random_split(random, volume, kappa, shares[random.below(5)]);
  const ContourMesh finer = build_contour(volume, kappa, split);
  CHECK(check_contour(finer, volume, kappa) == "");
  CHECK(finer.summary == plain.summary);
  CHECK(finer.boundary.size() == plain.boundary.size());
  CHECK(keeps_crossings(plain, finer, volume));
  const auto before = enclosed_volumes(plain), after = enclosed_volumes(finer);
  for (std::size_t c = 0; c < before.size(); ++c) {
    CAPTURE(before[c]);
    CAPTURE(after[c]);
    CHECK((before[c] >= 0) == (after[c] >= 0));
    tally.closed += before[c] != 0;
  }
  if ((split.factor == Index3{1, 1, 1} || split.voxels.empty()) && split.usual == Index3{1, 1, 1}) {
    CHECK(same_mesh(finer, plain));
  }
  tally.cut_everywhere += split.usual != Index3{1, 1, 1} && !split.voxels.empty();
  tally.expected += split.voxels.size();  // if none is degenerate
  tally.split += finer.split_voxels;
  tally.with_boundary += plain.boundary.size() > 0;
  for (const auto& component : plain.summary.components) tally.tubes += component.tubes;
}

}  // namespace

TEST_CASE("random volumes, split at random, keep their topology") {
  Random random(21);
  Tally tally;
  for (int trial = 0; trial < test::cases(3000); ++trial) {
    CAPTURE(trial);
    const Volume volume =
        random_volume(random, random_dims(random, 3, 6), [&] { return random.uniform(0, 1); });
    check_split(random, volume, random.uniform(0.2, 0.8), tally);
  }
  CHECK(tally.split == tally.expected);  // no random voxel is degenerate
  CHECK(tally.split > test::cases(40000));
  CHECK(tally.tubes > test::cases(200));
  CHECK(tally.cut_everywhere > test::cases(800));
  CHECK(tally.with_boundary > test::cases(2500));
  CHECK(tally.closed > test::cases(500));
}

TEST_CASE(
    "volumes of few integers, with tied saddles and samples equal to kappa, keep their topology") {
  Random random(22);
  Tally tally;
  for (int trial = 0; trial < test::cases(3000); ++trial) {
    CAPTURE(trial);
    const std::uint32_t levels = 2 + random.below(6);
    const Volume volume =
        random_volume(random, random_dims(random, 3, 5), [&] { return random.below(levels); });
    const double kappa = 0.5 * random.below(2 * levels);
    check_split(random, volume, trial % 4 == 0 ? kappa : geometric_isovalue(volume.type(), kappa),
                tally);
  }
  CHECK(tally.split > test::cases(15000));
  CHECK(tally.split < tally.expected);  // some saddles lie at kappa to the last bit
  CHECK(tally.expected - tally.split < tally.expected / 10);
}

TEST_CASE("single voxels, some with tubes, keep their topology when split") {
  Random random(23);
  Tally tally;
  for (int trial = 0; trial < test::cases(8000); ++trial) {
    CAPTURE(trial);
    const double spread = trial % 2 == 0 ? 1 : 0.1;  // near (+1, -1, ...): tubes are frequent
    int corner = 0;
    const Volume volume = random_volume(random, {2, 2, 2}, [&] {
      const int m = corner++;
      const bool diagonal = m == 0 || m == 7;
      return random.uniform(-1, 1) * spread + (spread < 1 ? (diagonal ? 1 : -0.2) : 0);
    });
    check_split(random, volume, 0, tally);
  }
  CHECK(tally.split == tally.expected);
  CHECK(tally.tubes > test::cases(500));
}

TEST_CASE("triangles face outwards and come closer to the surface as cells get smaller") {
  const double radius = 6.3;
  const Vec3 center{9.1, 8.9, 9.2};
  const Volume volume = sampled<double>({19, 19, 19}, {1, 1, 1}, [&](double x, double y, double z) {
    const Vec3 d = Vec3{x, y, z} - center;
    return radius - length(d);
  });
  const double kappa = 0;
  Random random(24);
  double worst_before = 1e9;
  for (const int factor : {1, 2, 4}) {
    CAPTURE(factor);
    ContourSplit split;
    split.factor = {factor, factor, factor};
    for (std::uint64_t v = 0; v < 18 * 18 * 18; ++v) split.voxels.push_back(v);
    const ContourMesh mesh = build_contour(volume, kappa, split);
    CHECK(check_contour(mesh, volume, kappa) == "");
    double worst = 0;
    for (const auto& t : mesh.triangles) {
      const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
      const Vec3 n = cross(b - a, c - a);
      const Vec3 middle = (a + b + c) / 3;
      CHECK(dot(n, middle - center) > 0);
      worst = std::max(worst, std::abs(volume.value(middle) - kappa));
    }
    CHECK(worst < 0.4 * worst_before);
    worst_before = worst;
    split.voxels.clear();
    for (std::uint64_t v = 0; v < 18 * 18 * 18; ++v) {
      if (random.below(3) == 0) split.voxels.push_back(v);
    }
    const ContourMesh mixed = build_contour(volume, kappa, split);
    for (const auto& t : mixed.triangles) {
      const Vec3 &a = mixed.points[t[0]], &b = mixed.points[t[1]], &c = mixed.points[t[2]];
      CHECK(dot(cross(b - a, c - a), (a + b + c) / 3 - center) > 0);
    }
  }
}

// Cells that would cut a face between two blocks stop a voxel before it.
TEST_CASE("blocks cut into cells end at crossings of grid edges, unless the cells keep the face") {
  Random random(26);
  const Volume whole = random_volume(random, {9, 8, 7}, [&] { return random.uniform(0, 1); });
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    Index3 end = whole.voxels();
    end[axis] = 4;
    const Volume block = samples_of(whole, {{0, 0, 0}, end});
    REQUIRE(block.inner_faces() == 2u << (2 * axis));
    const auto on_seam = [&](const ContourMesh& mesh) {
      return std::ranges::count_if(
          mesh.box_faces, [&](std::uint8_t faces) { return (faces & block.inner_faces()) != 0; });
    };
    const ContourMesh plain = build_contour(block, 0.5);
    for (int along = 0; along < 3; ++along) {
      CAPTURE(along);
      ContourSplit split;
      split.usual[along] = 3;
      const ContourMesh cut = build_contour(block, 0.5, split);
      CHECK(cut.summary == plain.summary);
      const SurfaceMesh mesh = contour_as_mesh(cut);
      CHECK(check_mesh(mesh.mesh) == "");
      CHECK(ends_on_chain(mesh));
      CHECK(cut.points.size() > plain.points.size() + 100);
      CHECK(on_seam(cut) == on_seam(plain));
    }
  }
}

TEST_CASE("the same input gives the same mesh") {
  Random random(25);
  const Volume volume = random_volume(random, {12, 12, 12}, [&] { return random.uniform(0, 1); });
  const ContourSplit split = random_split(random, volume, 0.5, 0.3);
  const ContourMesh a = build_contour(volume, 0.5, split), b = build_contour(volume, 0.5, split);
  CHECK(a.split_voxels > 100);
  CHECK(same_mesh(a, b));
}

TEST_CASE("a volume without voxels has nothing to split") {
  const Volume flat = Volume::from_samples<std::uint8_t>({3, 2, 1}, {1, 1, 1}, {0, 9, 0, 9, 0, 9});
  ContourSplit split;
  CHECK(build_contour(flat, 4.5, split).points.empty());
}
