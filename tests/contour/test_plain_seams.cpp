// SPDX-License-Identifier: MIT
// Seams of T between blocks, on random volumes: both blocks have the same points there, which are
// crossings of grid edges; nothing else of T lies on the face, and T is embedded.
#include "contour/plain_seams.h"

#include <doctest/doctest.h>

#include <array>
#include <map>
#include <set>
#include <tuple>

#include "base/random.h"
#include "blocks/grid.h"
#include "cases.h"
#include "check/check_mesh.h"
#include "check/self_intersections.h"
#include "coarsen/contour_as_mesh.h"
#include "contour/fine_contour.h"
#include "stress/tiny_volume.h"

using namespace deliso;

namespace {

using EndPoints = std::set<std::tuple<double, double, double>>;

std::size_t crossings_of(const ContourMesh& t) {
  const std::vector<Triangle> triangles = contour_as_mesh(t).mesh.triangles();
  return find_crossings(t.points, triangles, TriangleTree(t.points, triangles)).pairs.size();
}

// Noise of doubles, of which many are equal to kappa or next to it.
struct Tied {
  Volume volume;
  double kappa;
};
Tied tied_noise(std::uint64_t seed) {
  Random random(seed);
  Index3 dims;
  for (int axis = 0; axis < 3; ++axis) dims[axis] = 3 + static_cast<int>(random.below(4));
  const std::uint32_t levels = 3 + random.below(4);
  std::vector<double> samples(static_cast<std::size_t>(dims.i * dims.j * dims.k));
  for (double& sample : samples) sample = random.below(levels);
  const double below = std::array{0.0, 1e-12, 1e-10, 1e-8}[seed % 4];
  return {Volume::from_samples(dims, {1, 1, 1}, samples), 1 + random.below(levels - 1) - below};
}

}  // namespace

TEST_CASE("blocks end on their common face alike, at crossings of grid edges") {
  std::size_t lifted = 0, segments = 0;
  for (std::uint64_t seed = 1; seed <= test::cases(280u); ++seed) {
    CAPTURE(seed);
    const auto tiny = stress::make_tiny_volume(seed, 4, 9);
    const double kappa = geometric_isovalue(tiny.volume.type(), tiny.isovalue);
    std::map<EndPoints, int> ends;  // of all blocks on inner faces
    for (const SampleBox& box : BlockGrid(tiny.volume, 2 + static_cast<int>(seed % 3)).boxes()) {
      const Volume block = samples_of(tiny.volume, box);
      ContourMesh t = fine_contour(build_contour(block, kappa), block, kappa);
      if (t.points.empty()) continue;
      const std::size_t before = t.triangles.size();
      make_seams_plain(t, block);
      lifted += t.triangles.size() - before;
      const unsigned inner = block.inner_faces();
      const SurfaceMesh mesh = contour_as_mesh(t);
      CHECK(check_mesh(mesh.mesh) == "");
      CHECK(ends_on_chain(mesh));
      for (VertexId v = 0; v < mesh.mesh.points.size(); ++v) {
        const unsigned faces = box_faces_at(mesh.mesh.points[v], block.box()) & inner;
        CHECK((faces == 0 || mesh.chain.is_boundary(v)));
        CHECK((t.box_faces[ContourId(v.number())] & inner) == faces);
      }
      for (std::size_t c = 0; c < t.boundary.size(); ++c) {
        const BoundaryLoop& loop = t.boundary.loops[c];
        for (std::size_t k = 0; k < loop.size(); ++k) {
          CHECK(loop[k].point == t.points[t.boundary.vertices[c][k]]);
          CHECK(loop[k].is_fixed == ((inner >> loop[k].face & 1) != 0));
          if (is_on_fixed(loop, static_cast<double>(k))) CHECK(loop[k].is_kept);
          if (!loop[k].is_fixed) continue;
          EndPoints segment;
          for (const Vec3& p : {loop[k].point, loop[(k + 1) % loop.size()].point}) {
            segment.insert({p.x, p.y, p.z});
          }
          ++ends[segment];
        }
      }
      if (t.triangles.size() == before) continue;
      const std::vector<Triangle> triangles = mesh.mesh.triangles();
      const TriangleTree tree(t.points, triangles);
      CHECK(find_crossings(t.points, triangles, tree).pairs.empty());
    }
    segments += ends.size();
    for (const auto& [segment, blocks] : ends) CHECK(blocks == 2);
  }
  CHECK(lifted > 0);
  CHECK(segments > 0);
}

// The lifted vertices are 1e-7 voxel off the face. Beside a sample that is 1e-8 above kappa, or
// equal to it, T's other vertices were nearer, and its triangles stood in the way.
TEST_CASE("nothing crosses at a seam where T is nearer to the face than 1e-7 voxel") {
  const std::vector<double> equal{2, 2, 3, 0, 0, 2, 2, 2, 1, 1, 2, 2};
  const std::vector<double> above{4, 2, 1, 0, 2, 0, 1, 0, 4, 4, 2, 0};
  for (const auto& [samples, level] : {std::pair(equal, 2.0), std::pair(above, 2 - 1e-8)}) {
    const double kappa = level;
    CAPTURE(kappa);
    const Volume volume = Volume::from_samples<double>({3, 2, 2}, {1, 1, 1}, samples);
    std::size_t lifted = 0;
    for (const SampleBox& box : BlockGrid(volume, 1).boxes()) {
      const Volume block = samples_of(volume, box);
      ContourMesh t = fine_contour(build_contour(block, kappa), block, kappa);
      REQUIRE(crossings_of(t) == 0);
      const std::size_t before = t.triangles.size();
      make_seams_plain(t, block);
      lifted += t.triangles.size() - before;
      CHECK(crossings_of(t) == 0);
      CHECK(t.crossed_voxels.empty());
    }
    CHECK(lifted > 0);
  }
}

TEST_CASE("plain seams make no triangles cross, and crossed_voxels tells where some did before") {
  std::size_t lifted = 0, crossed = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    CAPTURE(seed);
    const Tied tied = tied_noise(seed);
    for (const SampleBox& box : BlockGrid(tied.volume, 1 + static_cast<int>(seed % 3)).boxes()) {
      const Volume block = samples_of(tied.volume, box);
      ContourMesh t = fine_contour(build_contour(block, tied.kappa), block, tied.kappa);
      const std::size_t before = t.triangles.size();
      const bool was_embedded = t.crossed_voxels.empty();
      CHECK((crossings_of(t) == 0) == was_embedded);
      make_seams_plain(t, block);
      lifted += t.triangles.size() - before;
      CHECK((crossings_of(t) == 0) == t.crossed_voxels.empty());
      CHECK(t.crossed_voxels.empty() == was_embedded);
      crossed += !was_embedded;
    }
  }
  CHECK(lifted > 0);
  CHECK(crossed > 0);
}
