// SPDX-License-Identifier: MIT
#include "support/cell_loops.h"

#include <bit>
#include <cstddef>
#include <utility>

namespace deliso {
namespace {

int edge_between(int corner, int other) {
  const int axis = std::countr_zero(static_cast<unsigned>(corner ^ other));
  const int second = axis_after(axis), third = axis_after(second);
  return 4 * axis + (corner >> second & 1) + 2 * (corner >> third & 1);
}

// Corner s of a face, counted round it.
int corner_round_face(int face, int s) {
  constexpr std::array<int, 4> kB{0, 1, 1, 0}, kC{0, 0, 1, 1};
  const int axis = face / 2, second = axis_after(axis), third = axis_after(second);
  const auto at = static_cast<std::size_t>(s % 4);
  return (face % 2) << axis | kB[at] << second | kC[at] << third;
}

// The edge at the other end of a segment, by face and edge; -1 without one.
using Mates = std::array<std::array<int, 12>, 6>;

// Sets the mates on a face.
void add_segments(unsigned inside, AlternatingFaces rule, int face, Mates& mates) {
  const auto is_cut_off = [&](int s) {
    const bool is_inside = (inside >> corner_round_face(face, s) & 1) != 0;
    return is_inside == (rule == AlternatingFaces::cut_off_inside);
  };
  const auto edge = [&](int s) {
    return edge_between(corner_round_face(face, s), corner_round_face(face, s + 1));
  };
  auto& mate = mates[static_cast<std::size_t>(face)];
  for (int s = 0; s < 4; ++s) {
    if (is_cut_off(s) || !is_cut_off(s + 1)) continue;
    // A run of corners to be cut off begins after side s. A segment joins s to the side after it.
    int end = s + 1;
    while (is_cut_off(end + 1)) ++end;
    mate[static_cast<std::size_t>(edge(s))] = edge(end);
    mate[static_cast<std::size_t>(edge(end))] = edge(s);
  }
}

}  // namespace

CellLoops loops_of_cell(unsigned inside, AlternatingFaces rule) {
  CellLoops loops;
  Mates mates;
  for (auto& mate : mates) mate.fill(-1);
  for (int face = 0; face < 6; ++face) add_segments(inside, rule, face, mates);
  std::array<bool, 12> seen{};
  for (int first = 0; first < 12; ++first) {
    int edge = first, face = faces_of_cell_edge(first)[0];
    const auto mate = [&] {
      return mates[static_cast<std::size_t>(face)][static_cast<std::size_t>(edge)];
    };
    if (seen[static_cast<std::size_t>(first)] || mate() < 0) continue;
    std::vector<LoopStep> loop;
    do {
      seen[static_cast<std::size_t>(edge)] = true;
      loop.push_back({edge, face});
      edge = mate();
      const auto faces = faces_of_cell_edge(edge);
      face = faces[0] == face ? faces[1] : faces[0];
    } while (edge != first);
    loops.push_back(std::move(loop));
  }
  return loops;
}

bool has_alternating_face(unsigned inside) {
  for (int face = 0; face < 6; ++face) {
    std::array<unsigned, 4> sign;
    for (int s = 0; s < 4; ++s) {
      sign[static_cast<std::size_t>(s)] = inside >> corner_round_face(face, s) & 1;
    }
    if (sign[0] == sign[2] && sign[1] == sign[3] && sign[0] != sign[1]) return true;
  }
  return false;
}

}  // namespace deliso
