// SPDX-License-Identifier: MIT
// Ids of different things do not mix: what is wrong does not compile.
#include "base/ids.h"

#include <doctest/doctest.h>

#include <concepts>
#include <type_traits>

#include "contour/contour.h"
#include "mesh/tri_mesh.h"

using namespace deliso;

namespace {

template <class To, class From>
concept CanBecome = std::constructible_from<To, From> || std::convertible_to<From, To> ||
    std::assignable_from<To&, From>;
template <class Array, class Index>
concept CanIndex = requires(Array array, Index index) {
  array[index];
};

// An id of each kind becomes none of the others.
template <class... Ids>
constexpr bool all_apart() {
  const auto apart_from_all = []<class One>(One) {
    return ((std::same_as<One, Ids> || !CanBecome<Ids, One>)&&...);
  };
  return (apart_from_all(Ids()) && ...);
}
static_assert(all_apart<VertexId, FaceId, ContourId, SiteId, CellId>());

// A number becomes an id where it is said. (That it does so nowhere else, no test can say: in an
// unevaluated operand every number passes as a literal.)
static_assert(std::constructible_from<ContourId, std::size_t>);
static_assert(std::convertible_to<NoId, ContourId>);
static_assert(std::convertible_to<ContourId, std::uint32_t>);

// A vertex of T names a place in T and no vertex of a mesh, and the other way round.
static_assert(CanIndex<decltype(ContourMesh::points), ContourId>);
static_assert(!CanIndex<decltype(ContourMesh::points), VertexId>);
static_assert(!CanIndex<decltype(ContourMesh::component), VertexId>);
static_assert(!CanIndex<decltype(ContourMesh::box_faces), VertexId>);
static_assert(CanIndex<decltype(TriMesh::points), VertexId>);
static_assert(!CanIndex<decltype(TriMesh::points), ContourId>);
static_assert(!CanBecome<Triangle, ContourTriangle>);
static_assert(!CanBecome<ContourTriangle, Triangle>);

}  // namespace

TEST_CASE("ids cost what their numbers cost, and count") {
  static_assert(sizeof(ContourId) == sizeof(std::uint32_t));
  static_assert(std::is_trivially_copyable_v<ContourId>);
  ContourId v = 0;
  CHECK(v++ == ContourId(0));
  CHECK(++v == ContourId(2));
  CHECK(v.number() == 2);
  CHECK(v != kNoId);
  CHECK(ContourId(kNoId) == kNoId);
  IdArray<ContourId, int> three{5, 6, 7};
  CHECK(three[v] == 7);
}
