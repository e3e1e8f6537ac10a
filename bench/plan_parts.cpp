// SPDX-License-Identifier: MIT
// A plan for volumes larger than this machine: how long 1 to 1024 machines take for a cube of SIDE
// samples, meshed in parts and joined. INPUT, a small volume of its kind, is meshed block by block
// and joined, three times, and the best run counts. A block of the large volume takes the seconds
// of the one at its place in the small volume, so both have the same surface in a block.
//   plan_parts SIDE INPUT ISOVALUE
// The model: a machine has two busy threads and reads or writes kBytesPerSecond, however many
// others do. It reads each of its blocks once. `join` runs on one, after the last part. A seam
// costs what it does in INPUT per vertex of its blocks. No queue and no failure is counted.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <utility>
#include <vector>

#include "blocks/grid.h"
#include "deliso/mesh_isosurface.h"
#include "io/volume/read_volume.h"
#include "run/observer.h"

using namespace deliso;

namespace {

constexpr int kBlockSide = 128;  // voxels: that of volumes of this size
constexpr int kThreads = 2, kRuns = 3;
constexpr double kBytesPerSecond = 1e9;
// Of files, and in memory: of a shell of 1024^3 in one piece, and of the join of its 64 parts.
constexpr double kPartBytesPerVertex = 212, kMeshBytesPerVertex = 50, kMemoryPerVertex = 540;
constexpr double kSeamSamples = 33;  // read across a seam: 12 on each side, a margin of 4

// Processor seconds, so that nothing else on the machine counts.
double seconds_since(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// The boxes at seams, and the seconds in them, of a join in one thread.
struct SeamTimes : Observer {
  double seconds = 0, boxes = 0;
  std::clock_t last = 0;

  void stage_begins(const char*) override { last = std::clock(); }
  void steps_done(std::size_t, std::size_t) override {
    seconds += seconds_since(last);
    last = std::clock();
    ++boxes;
  }
};

// What a block costs in one thread, or several blocks.
struct Cost {
  double seconds = 0, vertices = 0, bytes_read = 0;
};

// Calls visit(a, b) with the numbers of the cells on both sides of each face between blocks.
template <class Visit>
void for_each_face(const BlockGrid& grid, Visit&& visit) {
  const std::vector<SampleBox> boxes = grid.boxes();
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      Index3 next = grid.cell_of(boxes[n].begin);
      if (++next[axis] < grid.cells()[axis]) visit(n, grid.number_of(next));
    }
  }
}

// Returns the vertices that a seam's cost goes by: 0 where the seam has none.
double weight(const Cost& a, const Cost& b) {
  return a.vertices > 0 && b.vertices > 0 ? (a.vertices + b.vertices) / 2 : 0;
}

struct Measured {
  BlockGrid grid;
  std::vector<Cost> blocks{};
  double seconds_per_weight = 0, boxes_per_face = 0;  // at seams
  double weld_seconds_per_vertex = 0, seconds = 0;
};

Measured measure(const Volume& volume, double isovalue) {
  Measured m{BlockGrid(volume, kBlockSide)};
  Options options;
  options.threads = 1;
  options.block_side = kBlockSide;
  const VolumeSource source = source_of(volume);
  const int cells = static_cast<int>(m.grid.boxes().size());
  std::vector<Block> parts;
  Report report;
  const double bytes = std::pow(kBlockSide + 1, 3) * static_cast<double>(size_of(volume.type()));
  Cost sum;
  for (int n = 1; n <= cells; ++n) {
    const std::clock_t start = std::clock();
    parts.push_back(mesh_part(source, isovalue, options, {n, cells}));
    const auto vertices = static_cast<double>(parts.back().mesh.mesh.points.size());
    m.blocks.push_back({seconds_since(start), vertices, bytes});
    sum.seconds += m.blocks.back().seconds;
    sum.vertices += vertices;
  }
  SeamTimes seams;
  options.observer = &seams;
  const std::clock_t start = std::clock();
  const TriMesh mesh = mesh_of_parts(source, isovalue, options, std::move(parts), report);
  const double weld_seconds = seconds_since(start) - seams.seconds;
  const double vertices = std::max(1.0, static_cast<double>(mesh.points.size()));
  m.weld_seconds_per_vertex = weld_seconds / vertices;
  // Seams are thinned when blocks are joined, within a part too.
  for (Cost& block : m.blocks) block.vertices *= vertices / std::max(sum.vertices, 1.0);
  double all = 0, faces = 0;
  for_each_face(m.grid, [&](std::size_t a, std::size_t b) {
    all += weight(m.blocks[a], m.blocks[b]);
    faces += weight(m.blocks[a], m.blocks[b]) > 0 ? 1 : 0;
  });
  m.seconds_per_weight = seams.seconds / std::max(all, 1.0);
  m.boxes_per_face = seams.boxes / std::max(faces, 1.0);
  m.seconds = sum.seconds + seams.seconds + weld_seconds;
  std::printf("measured: %d blocks %.3f s, %.0f boxes %.3f s, weld %.3f s; %.0f vertices\n", cells,
              sum.seconds, seams.boxes, seams.seconds, weld_seconds, vertices);
  return m;
}

// Returns the seconds until the mesh is there.
double print_row(const Measured& m, const BlockGrid& grid, const std::vector<Cost>& blocks,
                 int count, double seconds_of_one) {
  std::vector<std::size_t> part_of(blocks.size());
  std::vector<Cost> parts(static_cast<std::size_t>(count));
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const CellRun run = cells_of({static_cast<int>(p) + 1, count}, blocks.size());
    for (std::size_t n = run.begin; n < run.end; ++n) {
      part_of[n] = p;
      parts[p].seconds += blocks[n].seconds;
      parts[p].vertices += blocks[n].vertices;
      parts[p].bytes_read += blocks[n].bytes_read;
    }
  }
  Cost join;
  double boxes = 0;
  for_each_face(grid, [&](std::size_t a, std::size_t b) {
    const double here = weight(blocks[a], blocks[b]);
    const bool is_within = part_of[a] == part_of[b];
    (is_within ? parts[part_of[a]] : join).seconds += here * m.seconds_per_weight;
    if (is_within || here == 0) return;
    boxes += m.boxes_per_face;
    join.bytes_read += blocks[a].bytes_read / (kBlockSide + 1) * kSeamSamples;
  });
  const auto seconds = [&](const Cost& cost, double bytes_written) {
    return cost.seconds / kThreads + cost.vertices * m.weld_seconds_per_vertex +
           (cost.bytes_read + bytes_written) / kBytesPerSecond;
  };
  const double bytes_per_vertex = count > 1 ? kPartBytesPerVertex : kMeshBytesPerVertex;
  double slowest = 0, most_read = 0, most_vertices = 0;
  for (const Cost& part : parts) {
    slowest = std::max(slowest, seconds(part, part.vertices * bytes_per_vertex));
    most_read = std::max(most_read, part.bytes_read);
    most_vertices = std::max(most_vertices, part.vertices);
    join.vertices += part.vertices;
  }
  join.bytes_read += join.vertices * kPartBytesPerVertex;
  const double join_seconds = count > 1 ? seconds(join, join.vertices * kMeshBytesPerVertex) : 0;
  const double all = slowest + join_seconds;
  std::printf("%6d %9.2f GB %7.1f GB %9.1f s %9.0f %9.2f GB %9.1f s %9.1f s %8.2f\n", count,
              most_read / 1e9, most_vertices * kMemoryPerVertex / 1e9, slowest, boxes,
              (count > 1 ? join.bytes_read : 0) / 1e9, join_seconds, all,
              count > 1 ? seconds_of_one / all : 1);
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  const int side = argc == 4 ? std::atoi(argv[1]) : 0;
  if (side < kBlockSide) {
    std::fputs("usage: plan_parts SIDE INPUT ISOVALUE\n", stderr);
    return 2;
  }
  const Volume volume = read_volume(argv[2]);
  Measured m = measure(volume, std::strtod(argv[3], nullptr));
  for (int n = 1; n < kRuns; ++n) {
    Measured again = measure(volume, std::strtod(argv[3], nullptr));
    if (again.seconds < m.seconds) m = std::move(again);
  }
  const Volume shape({side, side, side}, {1, 1, 1}, volume.type(), nullptr, nullptr);
  const BlockGrid grid(shape, kBlockSide);
  std::vector<Cost> blocks;
  double vertices = 0;
  for (const SampleBox& box : grid.boxes()) {
    Index3 at = grid.cell_of(box.begin);
    for (int axis = 0; axis < 3; ++axis) {
      at[axis] = at[axis] * m.grid.cells()[axis] / grid.cells()[axis];
    }
    blocks.push_back(m.blocks[m.grid.number_of(at)]);
    vertices += blocks.back().vertices;
  }
  std::printf("%d^3: %zu blocks, %.3g vertices, in join %.0f GB of memory\n\n", side, blocks.size(),
              vertices, vertices * kMemoryPerVertex / 1e9);
  std::printf("%6s %12s %10s %11s %9s %12s %11s %11s %8s\n", "parts", "read by one", "memory",
              "slowest", "boxes", "join reads", "join", "in all", "speed-up");
  const double of_one = print_row(m, grid, blocks, 1, 0);
  for (const int parts : {4, 16, 64, 100, 256, 1024}) print_row(m, grid, blocks, parts, of_one);
}
