// SPDX-License-Identifier: MIT
// Elements are integers into flat arrays, never pointers: half the size, stable when arrays grow,
// and every order taken from them is the same in every run.
#pragma once

#include <cstdint>

namespace deliso {

using VertexId = std::uint32_t;
using CellId = std::uint32_t;
using FaceId = std::uint32_t;

inline constexpr std::uint32_t kNoId = 0xffffffffu;

}  // namespace deliso
