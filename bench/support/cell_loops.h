// SPDX-License-Identifier: MIT
// The loops in which a surface meets the faces of a cell, by the signs at its corners alone. A face
// has a segment for two changes of sign round it, two segments for four.
//
// A cell's corner m has the coordinates m & 1, m >> 1 & 1, m >> 2. Its edge 4 a + b + 2 c runs
// along axis a, at b along the next axis and at c along the one after (x, y, z, x, ...). Its face
// 2 a + s lies across axis a, on side s.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace deliso {

// What a face has whose corners alternate: each segment cuts off one corner, of this kind. So the
// cells on both sides of the face have the same segments.
enum class AlternatingFaces : std::uint8_t { cut_off_inside, cut_off_outside };

// A crossing of a cell's edge, and the face on which a segment leads to the loop's next crossing.
struct LoopStep {
  int edge, face;
};

// Each loop is closed from its last step to the first.
using CellLoops = std::vector<std::vector<LoopStep>>;

// Returns the loops; bit m of `inside`: corner m is inside.
CellLoops loops_of_cell(unsigned inside, AlternatingFaces rule);

// True if the corners of a face are inside and outside in turn.
bool has_alternating_face(unsigned inside);

constexpr int axis_after(int axis) {
  return (axis + 1) % 3;
}

constexpr std::array<int, 2> faces_of_cell_edge(int edge) {
  const int second = axis_after(edge / 4), third = axis_after(second);
  return {2 * second + (edge & 1), 2 * third + (edge >> 1 & 1)};
}

}  // namespace deliso
