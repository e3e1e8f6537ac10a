// SPDX-License-Identifier: MIT
// A volume in memory meshed block by block, as the program does it with a file.
#pragma once

#include <string>
#include <vector>

#include "blocks/seam.h"
#include "deliso/deliso.h"
#include "io/files/temporary_folder.h"
#include "io/mesh/read_mesh.h"
#include "io/mesh/write_mesh.h"
#include "io/parts/join.h"
#include "io/parts/part_note.h"

namespace deliso::test {

// The block's samples, copied.
inline Volume block_of(const Volume& whole, const BlockChoice& block) {
  const Roi region = region_of(block, whole.dims());
  Index3 dims;
  for (int axis = 0; axis < 3; ++axis) dims[axis] = region.end[axis] - region.begin[axis];
  return whole.visit([&](const auto* samples) {
    std::vector<std::remove_cvref_t<decltype(*samples)>> part;
    for (int k = region.begin.k; k < region.end.k; ++k) {
      for (int j = region.begin.j; j < region.end.j; ++j) {
        for (int i = region.begin.i; i < region.end.i; ++i) {
          part.push_back(samples[whole.index(i, j, k)]);
        }
      }
    }
    return Volume::from_samples(dims, whole.spacing(), part, whole.frame())
        .as_block(region.begin, whole.dims());
  });
}

inline std::vector<BlockChoice> all_blocks(Index3 of) {
  std::vector<BlockChoice> blocks;
  for (int k = 0; k < of.k; ++k) {
    for (int j = 0; j < of.j; ++j) {
      for (int i = 0; i < of.i; ++i) blocks.push_back({{i, j, k}, of});
    }
  }
  return blocks;
}

// Meshes a block and writes the part.
inline TriMesh write_part(const Volume& whole, const BlockChoice& block, double isovalue,
                          const Options& options, const std::string& path, Report& report,
                          MeshWriteOptions how = {}) {
  const Volume volume = block_of(whole, block);
  const TriMesh mesh = mesh_isosurface(volume, isovalue, options, report);
  how.seam = seam_of(mesh, volume);
  how.format = MeshFormat::ply;
  how.comment = part_comment("deliso test", volume, block, isovalue, written_part(mesh, how));
  write_mesh(mesh, path, how);
  return mesh;
}

// All parts, joined. Adds up what the reports count.
inline TriMesh mesh_in_blocks(const Volume& whole, Index3 of, double isovalue,
                              const Options& options, Report& sum) {
  const TemporaryFolder folder;
  std::vector<std::string> paths;
  for (const BlockChoice& block : all_blocks(of)) {
    paths.push_back(folder / ("part" + std::to_string(paths.size()) + ".ply"));
    Report report;
    write_part(whole, block, isovalue, options, paths.back(), report);
    for (std::size_t n = 0; n < kCounterCount; ++n) sum.counters[n] += report.counters[n];
  }
  const std::string joined = folder / "whole.ply";
  join_parts(paths, joined, false, false);
  return read_mesh(joined);
}

}  // namespace deliso::test
