// SPDX-License-Identifier: MIT
// The note of a part, as words at the end of the comment in its file. It has the volume, the
// isovalue, the block, checksums of the samples at seams, and the size of the part. Parts of one
// mesh have all words in common but the last four. An example:
//
//   volume=256x256x128,uint8,1,1,1  frame=0,0,0,1,0,0,0,1,0,0,0,1,LPS  isovalue=40.1
//   block=0,1,0/2,2,2  samples=-,1c291ca3,-,-,-,9ab0c34d  holds=1204,2311,87  checksum=5e0f1a90
//
// `holds` has the numbers of vertices, triangles and vertices of the seam. `checksum` is the CRC-32
// of the comment before it, then of all of these as numbers. It is the same for text and binary. It
// sums the numbers that were read, not the file's bytes.
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

// Returns `comment` with the words of the note after it. pre: `volume` is that block, and its mesh
// will be written as `part`.
std::string part_comment(std::string comment, const Volume& volume, const BlockChoice& block,
                         double isovalue, const PartMesh& part);

struct PartNote {
  std::string comment;  // all of it
  BlockChoice block{};
  Index3 dims;                         // of the whole volume
  std::string space;                   // as the frame names it; empty if it is unknown
  std::vector<std::string> words;      // the words common to all parts
  std::array<std::string, 6> samples;  // a checksum for each inner face, else "-"
};

// Returns the note in the first comment that has one; nullopt if none has.
std::optional<PartNote> part_note(std::span<const std::string> comments);

// Throws an InputError with the path if the note has no `holds` and `checksum`, as in older
// versions, or the part differs from them.
void require_as_noted(const PartNote& note, const PartMesh& part, const std::string& path);

}  // namespace deliso
