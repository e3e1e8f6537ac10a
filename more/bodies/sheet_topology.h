// SPDX-License-Identifier: MIT
// The topology of each body's surface, counted from its facets. Of sheets in several pieces that
// share vertices, each piece is counted by itself.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/topology_counts.h"
#include "more/bodies/sheets.h"

namespace deliso {

// The surfaces of bodies in one piece of the sheets.
struct SurfaceCounts {
  static constexpr std::uint64_t kOwn = ~std::uint64_t{0};  // of a vertex that no other piece has
  // A vertex of a body's surface that other pieces have, too: by a key that they share, with the
  // numbers of its component and of its boundary loop here; kNoId: none.
  struct Shared {
    std::uint64_t key;
    BodyId body;
    std::uint32_t component, loop;
  };
  std::vector<std::int64_t> twice_euler;  // per body: of all but shared vertices
  std::vector<BodyId> components, loops;  // the body of each
  std::vector<Shared> shared;
};

// `is_closed`: facets on the box are part of the surfaces; otherwise these end there. `key`: per
// vertex.
SurfaceCounts count_surfaces(const Sheets& sheets, const Partition& partition, bool is_closed,
                             std::span<const std::uint64_t> key);

// Returns the counts of all pieces as one, per body.
std::vector<TopologyCounts> total(std::span<const SurfaceCounts> pieces, std::size_t bodies);

}  // namespace deliso
