// SPDX-License-Identifier: MIT
// Plain samples; dimensions, type, spacing and byte order come from the user.
#include "io/volume/sample_grid.h"
#include "io/volume/volume_formats.h"

namespace deliso {

Volume read_raw(const VolumeInput& input) {
  const RawLayout& layout = *input.options.raw;
  SampleGrid grid = grid_of(input);
  for (int axis = 0; axis < 3; ++axis)
    grid.dims[static_cast<std::size_t>(axis)] = layout.dims[axis];
  grid.type = layout.type;
  grid.byte_order = layout.byte_order;
  if (layout.skip > input.bytes.size())
    fail(input.name(), "has ", input.bytes.size(), " bytes, fewer than the ", layout.skip,
         " to skip");
  return volume_from_raw(grid, input.bytes.from(static_cast<std::size_t>(layout.skip)));
}

}  // namespace deliso
