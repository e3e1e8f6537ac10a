// SPDX-License-Identifier: MIT
// Elements are indices into flat arrays, not pointers. Indices are half the size, survive growth of
// the array, and sort the same way in every run. Ids of different things have different types: a
// site is not a mesh vertex, and neither is a vertex of T.
#pragma once

#include <concepts>
#include <cstdint>
#include <utility>
#include <vector>

namespace deliso {

// The id of no element: equal to every id that is empty.
struct NoId {
  constexpr operator std::uint32_t() const { return 0xffffffffu; }
};
inline constexpr NoId kNoId;

// The number of an element of the kind that Tag names. It converts to a number anywhere. A number
// converts to it explicitly only (literals excepted), and an id of another kind never.
template <class Tag>
class Id {
 public:
  Id() = default;
  constexpr Id(NoId none) : number_(none) {}
  // VertexId(n). Overload resolution prefers this to the next, which is less constrained.
  template <class N>
  requires std::signed_integral<N> || std::unsigned_integral<N>
  explicit constexpr Id(N number) : number_(static_cast<std::uint32_t>(number)) {}
  // A literal: VertexId v = 0.
  template <std::integral N>
  consteval Id(N literal) : number_(static_cast<std::uint32_t>(literal)) {}
  template <class Other>
  Id(Id<Other>) = delete;

  constexpr std::uint32_t number() const { return number_; }
  constexpr operator std::uint32_t() const { return number_; }
  constexpr Id& operator++() {
    ++number_;
    return *this;
  }
  constexpr Id operator++(int) { return Id(number_++); }

 private:
  std::uint32_t number_;
};

template <class A, class B>
constexpr bool operator==(Id<A> a, Id<B> b) {
  static_assert(std::same_as<A, B>, "ids of different things");
  return a.number() == b.number();
}

// A vector indexed by the ids of one kind.
template <class Index, class T>
class IdArray : public std::vector<T> {
 public:
  using std::vector<T>::vector;
  IdArray(std::vector<T> values) : std::vector<T>(std::move(values)) {}

  decltype(auto) operator[](Index i) { return std::vector<T>::operator[](i.number()); }
  decltype(auto) operator[](Index i) const { return std::vector<T>::operator[](i.number()); }
};

using VertexId = Id<struct VertexTag>;    // of a triangle mesh
using FaceId = Id<struct FaceTag>;        // its facets
using ContourId = Id<struct ContourTag>;  // a vertex of the exact contour T
using SiteId = Id<struct SiteTag>;        // a vertex of the 3D Delaunay triangulation
using CellId = Id<struct CellTag>;        // its tetrahedra

}  // namespace deliso
