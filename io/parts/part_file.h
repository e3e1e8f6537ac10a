// SPDX-License-Identifier: MIT
// The file of a part: the mesh of some blocks of a volume, with what its seams to other parts still
// need (blocks/seams.h), and what it was made of. It begins with a line of text; then numbers
// follow, little-endian, and a CRC-32 of all before it. Parts are read by the version that wrote
// them, and by no other.
//
// The checksum shows that a part is as it was made; it shows no intent. A forged part can make a
// wrong mesh, which a check finds. It cannot make a reader read beyond it, nor hold ids or links
// that lead nowhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "blocks/block.h"
#include "blocks/grid.h"
#include "volume/volume.h"

namespace deliso {

struct PartFile {
  std::string name;  // in messages
  PartChoice choice;
  // The options that it was made with, a word each, as the program takes them. Parts of one mesh
  // have the same.
  std::vector<std::string> words;
  // The field that is meshed, its isovalue, and a checksum of the part's samples on its faces to
  // other parts.
  Index3 dims;
  Vec3 spacing;
  Coordinates places{};  // where its steps are not even
  SampleType type = SampleType::u8;
  Frame frame;
  double isovalue = 0;
  std::uint32_t samples_at_seams = 0;
  Block block;

  // Returns the field without samples.
  Grid shape() const;
  // True if the part was made of this field at this isovalue, as far as its size and place tell.
  bool is_of(const Grid& field, double level) const;
};

std::string part_bytes(PartFile part);

// Returns the part in the bytes. Throws InputError, with the part's `name`, if they are no part, or
// not as they were written, or the mesh breaks an invariant.
PartFile part_in(std::span<const std::byte> bytes, std::string_view name);

// Puts the parts into their order. Throws InputError, with the name of a part, unless they are all
// parts of one mesh, once each.
void sort_parts(std::vector<PartFile>& parts);

// Returns the checksum of the field's samples on the planes between a part's cells and others, in
// the machine's byte order.
std::uint32_t checksum_at_seams(const VolumeSource& source, const BlockGrid& grid, PartChoice part);

}  // namespace deliso
