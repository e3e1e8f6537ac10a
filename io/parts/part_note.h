// SPDX-License-Identifier: MIT
// What a part of a mesh says of itself, as words at the end of the comment in its file: of which
// volume it is, at which isovalue, which block, what the samples at its seams are, and what the
// part holds. Parts of one mesh have all words in common but the last four.
//
//   volume=256x256x128,uint8,1,1,1  frame=0,0,0,1,0,0,0,1,0,0,0,1,LPS  isovalue=40.1
//   lowered=40.09999904632568  block=0,1,0/2,2,2  samples=-,1c291ca3,-,-,-,9ab0c34d
//   holds=1204,2311,87  checksum=5e0f1a90
//
// The last two count vertices, triangles and vertices of the seam, and sum up (CRC-32) the comment
// before them and then all of these as numbers. So the sum stands in the header of what it sums up,
// is the same for text and binary, and is taken of what was read, not of what was there before.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/write_mesh.h"
#include "io/volume/read_volume.h"
#include "volume/volume.h"

namespace deliso {

// `comment` with these words behind it. pre: `volume` is that block, and its mesh will be written
// as `part`.
std::string part_comment(std::string comment, const Volume& volume, const BlockChoice& block,
                         double isovalue, double effective_isovalue, const PartMesh& part);

struct PartNote {
  std::string comment;  // all of it
  BlockChoice block{};
  Index3 dims;                         // of the whole volume
  std::string space;                   // as the frame names it; empty where it is not known
  std::vector<std::string> words;      // those in common
  std::array<std::string, 6> samples;  // a checksum for each inner face, else "-"
};

// What the first such comment says; nothing when there is none.
std::optional<PartNote> part_note(std::span<const std::string> comments);

// Throws InputError with the path where the note does not say what the part holds, as one of an
// older version, or says something else.
void require_as_noted(const PartNote& note, const PartMesh& part, const std::string& path);

// Whether the mesh was made in blocks, so that it is at isovalue_of_blocks(): a part, or the whole.
bool is_of_blocks(std::span<const std::string> comments);

}  // namespace deliso
