// SPDX-License-Identifier: MIT
// Elements are integers into flat arrays, never pointers: half the size, stable when arrays grow,
// and every order taken from them is the same in every run. Ids of different things are different
// types: a site is no vertex of a mesh, though both are numbers.
#pragma once

#include <concepts>
#include <cstdint>
#include <utility>
#include <vector>

namespace deliso {

// No element: equal to an id that names none.
struct NoId {
  constexpr operator std::uint32_t() const { return 0xffffffffu; }
};
inline constexpr NoId kNoId;

// The number of an element of the kind that Tag names: read as a number anywhere, but made of one
// on purpose only (literals aside), and never of an id of another kind.
template <class Tag>
class Id {
 public:
  Id() = default;
  constexpr Id(NoId none) : number_(none) {}
  // VertexId(n). The compiler prefers it to the next, as the more constrained one.
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

// What every element of a kind has, by its id. All else is std::vector's.
template <class Index, class T>
class IdArray : public std::vector<T> {
 public:
  using std::vector<T>::vector;
  IdArray(std::vector<T> values) : std::vector<T>(std::move(values)) {}

  decltype(auto) operator[](Index i) { return std::vector<T>::operator[](i.number()); }
  decltype(auto) operator[](Index i) const { return std::vector<T>::operator[](i.number()); }
};

using VertexId = Id<struct VertexTag>;  // of a triangle mesh
using FaceId = Id<struct FaceTag>;      // its facets
using SiteId = Id<struct SiteTag>;      // a vertex of the 3D Delaunay triangulation
using CellId = Id<struct CellTag>;      // its tetrahedra

}  // namespace deliso
