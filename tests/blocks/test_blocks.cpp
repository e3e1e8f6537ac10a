// SPDX-License-Identifier: MIT
// The division of a volume into blocks: the grid, the counts, the seams. tests/stress/division.cpp
// has storms.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "blocks/components.h"
#include "blocks/grid.h"
#include "cases.h"
#include "check/check_mesh.h"
#include "check/verify.h"
#include "contour/contour.h"
#include "deliso/mesh_isosurface.h"
#include "io/volume/builtin_volume.h"
#include "mesh/meshes.h"
#include "see.h"
#include "stress/tiny_volume.h"

using namespace deliso;
using stress::make_tiny_volume;
using test::same_mesh;

namespace {

Options in_blocks(int side) {
  Options options;
  options.block_side = side;
  options.threads = 1;
  return options;
}

std::uint64_t voxels_in(const SampleBox& box) {
  std::uint64_t voxels = 1;
  for (int axis = 0; axis < 3; ++axis) {
    voxels *= static_cast<std::uint64_t>(box.end[axis] - box.begin[axis]);
  }
  return voxels;
}

}  // namespace

TEST_CASE("every voxel is in one block, and a block's samples are the volume's") {
  std::mt19937 random(1);
  for (int n = 0; n < 60; ++n) {
    Index3 dims;
    for (int axis = 0; axis < 3; ++axis) dims[axis] = 2 + static_cast<int>(random() % 30);
    const Volume volume = Volume::from_function(
        {{0, 0, 0}, {1, 1, 1}}, dims, [](const Vec3& p) { return p.x + 3 * p.y + 5 * p.z; });
    const int side = 1 + static_cast<int>(random() % 12);
    CAPTURE(side);
    const std::vector<SampleBox> boxes = BlockGrid(volume, side).boxes();
    std::uint64_t voxels = 0;
    for (const SampleBox& box : boxes) {
      voxels += voxels_in(box);
      for (int axis = 0; axis < 3; ++axis) {
        const int length = box.end[axis] - box.begin[axis];
        CHECK(length >= 1);
        // Rounded to the nearest number of blocks.
        if (dims[axis] - 1 > side) CHECK(length <= 1.5 * side + 1);
      }
      const Volume block = samples_of(volume, box);
      const Index3 last{block.dims().i - 1, block.dims().j - 1, block.dims().k - 1};
      CHECK(block.sample(0, 0, 0) == volume.sample(box.begin.i, box.begin.j, box.begin.k));
      CHECK(block.sample(last.i, last.j, last.k) == volume.sample(box.end.i, box.end.j, box.end.k));
    }
    const Index3 all = volume.voxels();
    CHECK(voxels == static_cast<std::uint64_t>(all.i) * static_cast<std::uint64_t>(all.j) *
                        static_cast<std::uint64_t>(all.k));
  }
}

TEST_CASE("components counted in blocks are those of the whole, in the same order") {
  std::size_t components = 0;
  for (std::uint64_t seed = 1; seed <= test::cases(100u); ++seed) {
    CAPTURE(seed);
    const auto tiny = make_tiny_volume(seed, 5, 14);
    const double kappa = geometric_isovalue(tiny.volume.type(), tiny.isovalue);
    const ContourSummary whole = summarize_contour(tiny.volume, kappa);
    std::vector<BlockComponents> parts;
    for (const SampleBox& box : BlockGrid(tiny.volume, 2 + static_cast<int>(seed % 4)).boxes()) {
      const Volume block = samples_of(tiny.volume, box);
      parts.push_back(components_of(build_contour(block, kappa), block));
    }
    const AllComponents all = joined(parts, tiny.volume.whole_dims());
    CHECK(all.topology == whole.topology());
    REQUIRE(all.components.size() == whole.components.size());
    for (std::size_t c = 0; c < whole.components.size(); ++c) {
      CHECK(all.components[c].euler == whole.components[c].euler);
      CHECK(all.components[c].crossings == whole.components[c].crossings);
    }
    components += whole.components.size();
  }
  CHECK(components > test::cases(300u));
}

TEST_CASE("facets of two boxes at a seam never cross, and any number of threads makes one mesh") {
  for (const char* input : {"builtin:gyroid:24", "builtin:fuel:32", "builtin:noise:17"}) {
    CAPTURE(input);
    const Volume volume = make_builtin_volume(input);
    const double isovalue = find_builtin_field(input)->isovalue;
    Options options = in_blocks(8);
    Report report;
    const TriMesh mesh = mesh_isosurface(volume, isovalue, options, report);
    INFO(test::see_mesh(test::case_name(), mesh, build_contour(volume, report.kappa_effective)));
    CHECK(mesh_topology(mesh).counts() == report.exact);
    const Verification found = verify(mesh, volume, report.kappa_effective, {});
    CHECK(found.faults.count(FaultKind::self_intersections) == 0);
    CHECK(found.faults.count(FaultKind::holes) == 0);
    for (const int threads : {2, 5}) {
      options.threads = threads;
      CHECK(same_mesh(mesh_isosurface(volume, isovalue, options), mesh));
    }
  }
}

TEST_CASE("seams cost few vertices, and hardly a triangle over a limit") {
  const Volume volume = make_builtin_volume("builtin:gyroid:40");
  Report divided;
  const TriMesh one = mesh_isosurface(volume, 0, in_blocks(0));
  const TriMesh mesh = mesh_isosurface(volume, 0, in_blocks(16), divided);
  // Blocks of 16 voxels have four times the seams of usual ones, for the same surface.
  CHECK(static_cast<double>(mesh.points.size()) < 1.15 * static_cast<double>(one.points.size()));
  CHECK(static_cast<double>(divided[Counter::unrefined_facets]) <
        0.005 * static_cast<double>(mesh.faces.size()));
}
