// SPDX-License-Identifier: MIT
// What a part of a mesh says of itself, as words at the end of the comment in its file: of which
// volume it is, at which isovalue, which block, and what the samples at its seams are. Parts of one
// mesh have all words in common but the last two.
//
//   volume=256x256x128,uint8,1,1,1  frame=0,0,0,1,0,0,0,1,0,0,0,1,LPS  isovalue=40.1
//   lowered=40.09999904632568  block=0,1,0/2,2,2  samples=-,1c291ca3,-,-,-,9ab0c34d
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "volume/read_volume.h"
#include "volume/volume.h"

namespace deliso {

// pre: `volume` is that block.
std::string part_words(const Volume& volume, const BlockChoice& block, double isovalue,
                       double effective_isovalue);

struct PartNote {
  BlockChoice block{};
  Index3 dims;                         // of the whole volume
  std::vector<std::string> words;      // those in common
  std::array<std::string, 6> samples;  // a checksum for each inner face, else "-"
};

// What the first such comment says; nothing when there is none.
std::optional<PartNote> part_note(std::span<const std::string> comments);

// Whether the mesh was made in blocks, so that it is at isovalue_of_blocks(): a part, or the whole.
bool is_of_blocks(std::span<const std::string> comments);

}  // namespace deliso
