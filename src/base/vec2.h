// SPDX-License-Identifier: MIT
// Points and vectors of a plane: those of a box face, without the coordinate across it.
#pragma once

namespace deliso {

struct Vec2 {
  double x = 0, y = 0;
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

constexpr Vec2 operator+(const Vec2& a, const Vec2& b) {
  return {a.x + b.x, a.y + b.y};
}
constexpr Vec2 operator-(const Vec2& a, const Vec2& b) {
  return {a.x - b.x, a.y - b.y};
}
constexpr Vec2 operator*(double s, const Vec2& a) {
  return {s * a.x, s * a.y};
}
constexpr double dot(const Vec2& a, const Vec2& b) {
  return a.x * b.x + a.y * b.y;
}
constexpr double distance2(const Vec2& a, const Vec2& b) {
  return dot(b - a, b - a);
}

}  // namespace deliso
