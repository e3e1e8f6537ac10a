// SPDX-License-Identifier: MIT
// The one division: a volume is cut into blocks, each is meshed by itself, and the meshes are
// welded. Only in this folder do the stages meet threads. What is global happens before the blocks
// or after them: chosen components, the report's sums. For a desired number of vertices
// more/counts/mesh_near_count.h has the stages of all blocks made several times.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "blocks/block.h"
#include "blocks/equal_shares.h"

namespace deliso {

// True if the grid's planes follow from the samples (blocks/equal_shares.h). A part then reads all
// of the volume. So it is where no side is asked for, in volumes that one process meshes in
// seconds. Larger ones have many blocks anyway.
bool grid_follows_surface(const Grid& shape, const Options& options);

// Returns the grid of blocks of a run by these options. (With an observer of insertions it is one
// block instead.) Reads the source if the grid follows from it.
BlockGrid block_grid(const VolumeSource& source, double isovalue, const Options& options);
// Returns the grid of equal sides, which follows from the shape alone.
BlockGrid block_grid(const Grid& shape, const Options& options);

// The blocks of a part of the volume's cells, side by side.
class PartInBlocks {
 public:
  // `kept`: per component of the whole contour, nonzero if it is kept; empty: options.components
  // decides. pre: the source can be read where the part is; everywhere, if components are chosen.
  PartInBlocks(const RunInput& run, PartChoice part, std::vector<std::uint8_t> kept);

  // Meshes all blocks (mesh_block). `run`, here and below: of the same source, isovalue and threads
  // as the constructor's; options and parameters may differ.
  void mesh(const RunInput& run);
  // One of the stages once more, by other criteria.
  void coarsen(const RunInput& run);
  void refine(const RunInput& run);
  std::span<const Block> blocks() const { return blocks_; }

  // Returns the blocks as one, refined at the seams within the part. Empties them. Throws
  // InputError beyond max_vertices.
  Block welded(const RunInput& run);

 private:
  template <class Work>
  void for_each_block(const RunInput& run, Work&& work);
  std::vector<std::vector<std::uint8_t>> choose_components(const RunInput& run);

  const std::optional<SurfaceWork> work_;
  const BlockGrid grid_;
  const std::vector<SampleBox> cells_;
  const CellRun own_;
  const std::vector<std::uint8_t> kept_;
  std::vector<Block> blocks_;
  std::uint64_t skipped_ = 0;  // components
};

// Returns the mesh of {g = kappa} in a part, as a welded block with its report. It is empty where
// there is no surface, and has no caps. `kept` and pre: as above.
Block mesh_in_blocks(const RunInput& run, PartChoice part, std::vector<std::uint8_t> kept);

// Returns the mesh of the whole from its parts, which are all there, in their order: welds them,
// and refines at the seams between them. It is the one that mesh_in_blocks() makes of the whole.
// Throws InputError if the parts do not fit together, or beyond max_vertices.
Block join_parts(const RunInput& run, std::vector<Block> parts);

}  // namespace deliso
