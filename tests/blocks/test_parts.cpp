// SPDX-License-Identifier: MIT
// A volume meshed in parts has the mesh of one process. tests/stress/parts.cpp has storms.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "base/check.h"
#include "blocks/grid.h"
#include "blocks/mesh_in_blocks.h"
#include "cases.h"
#include "deliso/mesh_isosurface.h"
#include "io/volume/builtin_volume.h"
#include "mesh/meshes.h"
#include "stress/tiny_volume.h"

using namespace deliso;
using stress::make_tiny_volume;
using test::same_mesh;

namespace {

bool share_a_face(Index3 a, Index3 b) {
  return std::abs(a.i - b.i) + std::abs(a.j - b.j) + std::abs(a.k - b.k) == 1;
}

}  // namespace

TEST_CASE(
    "cells follow each other across faces, and those of a part that meet at an edge meet at "
    "a face") {
  for (const Index3 dims : {Index3{5, 4, 3}, Index3{2, 3, 4}, Index3{3, 3, 1}, Index3{1, 5, 2}}) {
    const Volume volume = Volume::from_function({{0, 0, 0}, {1, 1, 1}},
                                                {4 * dims.i + 1, 4 * dims.j + 1, 4 * dims.k + 1},
                                                [](const Vec3& p) { return p.x; });
    const BlockGrid grid(volume, 4);
    REQUIRE(grid.cells() == dims);
    std::vector<Index3> order;
    const std::vector<SampleBox> boxes = grid.boxes();
    for (std::size_t n = 0; n < boxes.size(); ++n) {
      order.push_back(grid.cell_of(boxes[n].begin));
      CHECK(grid.number_of(order[n]) == n);
      if (n > 0) CHECK(share_a_face(order[n - 1], order[n]));
    }
    for (std::size_t a = 0; a < order.size(); ++a) {
      for (std::size_t b = a + 1; b < order.size(); ++b) {
        const Index3 p = order[a], q = order[b];
        const int steps[] = {std::abs(p.i - q.i), std::abs(p.j - q.j), std::abs(p.k - q.k)};
        if (std::ranges::count(steps, 1) != 2 || std::ranges::count(steps, 0) != 1) continue;
        const auto is_between = [&](std::size_t n) {
          return share_a_face(order[n], p) && share_a_face(order[n], q);
        };
        // The smallest run that has both.
        bool any = false;
        for (std::size_t n = a + 1; n < b; ++n) any |= is_between(n);
        CHECK(any);
      }
    }
  }
}

TEST_CASE("parts are contiguous and hold every cell once") {
  for (const std::size_t cells : {1u, 7u, 64u}) {
    for (const int of : {1, 3, 64, 100}) {
      std::size_t next = 0;
      for (int number = 1; number <= of; ++number) {
        const CellRun run = cells_of({number, of}, cells);
        CHECK(run.begin == next);
        next = run.end;
      }
      CHECK(next == cells);
    }
  }
}

TEST_CASE("parts make the mesh and the counts of one process, and forged ones are refused") {
  const Volume volume = make_builtin_volume("builtin:noise:17");
  const VolumeSource source = source_of(volume);
  Options options;
  options.threads = 1;
  options.block_side = 8;
  options.components.largest = 3;
  std::vector<Block> parts;
  for (int n = 1; n <= 3; ++n) parts.push_back(mesh_part(source, 127, options, {n, 3}));
  Report one, joined;
  const TriMesh whole = mesh_isosurface(volume, 127, options, one);
  CHECK(same_mesh(mesh_of_parts(source, 127, options, parts, joined), whole));
  CHECK(joined.counters == one.counters);
  CHECK(joined.insertions_refine == one.insertions_refine);
  CHECK(one[Counter::components_skipped] > 0);
  Options few = options;
  few.max_vertices = whole.points.size() - 1;
  CHECK_THROWS_AS(mesh_of_parts(source, 127, few, parts, joined), InputError);
  few = options;
  few.target_vertices = 100;
  CHECK_THROWS_AS(mesh_part(source, 127, few, {1, 3}), InputError);

  options.stop_after_stage1 = true;  // no work at seams
  const auto refuses = [&](bool of_seam, auto&& forge) {
    std::vector<Block> forged = parts;
    for (Block& block : forged) {
      TriMesh& mesh = block.mesh.mesh;
      const BoundaryChain& chain = block.mesh.chain;
      for (VertexId v = 0; v < mesh.points.size(); ++v) {
        if (!chain.is_boundary(v) || is_on_seam(block, v) != of_seam) continue;
        if (!forge(mesh.points, v, chain)) continue;
        CHECK_THROWS_AS(mesh_of_parts(source, 127, options, forged, joined), InputError);
        return;
      }
    }
    FAIL("nothing was forged");
  };
  using Points = std::vector<Vec3>;
  refuses(true, [&](Points& points, VertexId v, const BoundaryChain&) {  // open there
    if (box_faces_at(points[v], volume.box()) != 0) return false;
    points[v].x += 1e-3;
    return true;
  });
  refuses(false, [](Points& points, VertexId v, const BoundaryChain&) {  // off the box
    points[v] = 0.9 * points[v] + 0.1 * Vec3{8, 8, 8};
    return true;
  });
  // At the place of another one of the same curve.
  refuses(false, [&](Points& points, VertexId v, const BoundaryChain& chain) {
    const VertexId before = chain.previous(v), place = chain.previous(before);
    const Box3 box = volume.box();
    if (place == v || !on_one_face(points[before], points[v], box) ||
        !on_one_face(points[place], points[chain.next(v)], box)) {
      return false;
    }
    points[v] = points[place];
    return true;
  });
}

TEST_CASE("both sides of a seam have the same vertices in the same places") {
  std::size_t compared = 0;
  for (std::uint64_t seed = 30; seed < 30 + test::cases(14u); ++seed) {
    CAPTURE(seed);
    const auto tiny = make_tiny_volume(seed, 8, 12);
    const Index3 voxels = tiny.volume.voxels();
    const int axis = static_cast<int>(seed % 3);
    Options options;
    options.block_side = 4;
    const BlockGrid grid = block_grid(source_of(tiny.volume), tiny.isovalue, options);
    const std::vector<SampleBox> boxes = grid.boxes();
    const int of = static_cast<int>(boxes.size());
    std::vector<Block> parts;
    try {
      for (int n = 1; n <= of; ++n) {
        parts.push_back(mesh_part(source_of(tiny.volume), tiny.isovalue, options, {n, of}));
      }
    } catch (const InputError&) {
      continue;  // a seam that is refused
    }
    for (std::size_t a = 0; a < boxes.size(); ++a) {
      Index3 beyond = boxes[a].begin;
      beyond[axis] = boxes[a].end[axis];
      if (beyond[axis] == voxels[axis]) continue;
      const std::size_t b = grid.number_of(grid.cell_of(beyond));
      const double plane = beyond[axis] * tiny.volume.spacing()[axis];
      const auto seam = [&](const Block& block) {
        std::vector<Vec3> points;
        for (const Vec3& p : block.mesh.mesh.points) {
          if (p[axis] == plane) points.push_back(p);
        }
        std::ranges::sort(points, {}, [](const Vec3& p) { return by_place(p); });
        return points;
      };
      CHECK(seam(parts[a]) == seam(parts[b]));
      compared += seam(parts[a]).size();
    }
  }
  CHECK(compared > test::cases(500u));
}

TEST_CASE(
    "a part reads no sample outside of its box: narrow blocks have wider seams than half a block") {
  int read = 0, beyond_blocks = 0;
  for (std::uint64_t seed = 1; seed <= test::cases(12u); ++seed) {
    const auto tiny = make_tiny_volume(seed, 16, 28);
    Options options;
    options.block_side = 4 + static_cast<int>(seed);
    const VolumeSource all = source_of(tiny.volume);
    const BlockGrid grid = block_grid(all, tiny.isovalue, options);
    const PartChoice part{2, 3};
    const SampleBox own = box_of_part(all.shape, options, part);
    const std::vector<SampleBox> cells = grid.boxes();
    const VolumeSource watched{
        all.shape, [&](const SampleBox& box) {
          CAPTURE(seed);
          CHECK(is_in(box, own));
          ++read;
          beyond_blocks +=
              std::ranges::none_of(cells, [&](const SampleBox& cell) { return is_in(box, cell); });
          return all.read(box);
        }};
    try {
      mesh_part(watched, tiny.isovalue, options, part);
    } catch (const InputError&) {
      // A seam to another part may be refused.
    }
  }
  CHECK(read > test::cases(50));
  CHECK(beyond_blocks > test::cases(10));
}
