// SPDX-License-Identifier: MIT
// The types of numbers that files hold.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace deliso {

enum class SampleType : std::uint8_t { u8, i8, u16, i16, u32, i32, f32, f64 };

constexpr std::size_t size_of(SampleType type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}
constexpr std::string_view name_of(SampleType type) {
  constexpr std::array<std::string_view, 8> kNames{"uint8",  "int8",  "uint16",  "int16",
                                                   "uint32", "int32", "float32", "float64"};
  return kNames[static_cast<std::size_t>(type)];
}
constexpr bool is_integer(SampleType type) {
  return type != SampleType::f32 && type != SampleType::f64;
}

// Calls f with a number of that type.
template <class F>
decltype(auto) with_type(SampleType type, F&& f) {
  switch (type) {
    case SampleType::u8:
      return f(std::uint8_t{});
    case SampleType::i8:
      return f(std::int8_t{});
    case SampleType::u16:
      return f(std::uint16_t{});
    case SampleType::i16:
      return f(std::int16_t{});
    case SampleType::u32:
      return f(std::uint32_t{});
    case SampleType::i32:
      return f(std::int32_t{});
    case SampleType::f32:
      return f(float{});
    case SampleType::f64:
      break;
  }
  return f(double{});
}

template <class T>
constexpr SampleType sample_type_of() {
  if (std::is_floating_point_v<T>) return sizeof(T) == 4 ? SampleType::f32 : SampleType::f64;
  // In the order of SampleType: by size, unsigned first.
  return static_cast<SampleType>(2 * (std::bit_width(sizeof(T)) - 1) + std::is_signed_v<T>);
}

}  // namespace deliso
