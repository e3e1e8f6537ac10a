// SPDX-License-Identifier: MIT
// How a failing CHECK prints the values of types that have no operator<<: by their members. The
// build includes it before every test.
#pragma once

#include <doctest/doctest.h>

#include <ranges>

namespace doctest {

template <class T>
concept Unprinted = !detail::has_insertion_operator<T>::value;

template <Unprinted T>
requires requires(const T& v) {
  v.components, v.euler, v.boundary_loops;
}
struct StringMaker<T> {
  static String convert(const T& v) {
    return toString(v.components) + " components, Euler number " + toString(v.euler) + ", " +
           toString(v.boundary_loops) + " boundary loops";
  }
};

// Vec3, Vec2, Index3
template <Unprinted T>
requires requires(const T& v) {
  v.x, v.y;
}
struct StringMaker<T> {
  static String convert(const T& v) {
    String text = "(" + toString(v.x) + ", " + toString(v.y);
    if constexpr (requires { v.z; }) text += ", " + toString(v.z);
    return text + ")";
  }
};
template <Unprinted T>
requires requires(const T& v) {
  v.i, v.j, v.k;
}
struct StringMaker<T> {
  static String convert(const T& v) {
    return "(" + toString(v.i) + ", " + toString(v.j) + ", " + toString(v.k) + ")";
  }
};

template <Unprinted T>
requires requires(const T& v) {
  v.first, v.second;
}
struct StringMaker<T> {
  static String convert(const T& v) {
    return "{" + toString(v.first) + ", " + toString(v.second) + "}";
  }
};
template <Unprinted T>
requires requires(const T& v) {
  v.has_value(), *v;
}
struct StringMaker<T> {
  static String convert(const T& v) { return v ? toString(*v) : String("nothing"); }
};

// An array or a list: its first elements, and how many there are.
template <Unprinted T>
requires std::ranges::sized_range<const T>
struct StringMaker<T> {
  static String convert(const T& list) {
    constexpr std::size_t kShown = 12;
    String text = toString(std::ranges::size(list)) + " {";
    std::size_t n = 0;
    for (const auto& element : list) {
      if (n++ == kShown) return text + " ...}";
      text += (n > 1 ? ", " : "") + toString(element);
    }
    return text + "}";
  }
};

}  // namespace doctest
