// SPDX-License-Identifier: MIT
#include "coarsen/facet_cells.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <utility>

#include "base/box3.h"
#include "base/random.h"

namespace deliso {
namespace {

// Returns facets of sizes from 1 down to 1e-6, half of them near one corner of the unit cube.
TriMesh some_facets(Random& random) {
  TriMesh mesh;
  const auto point = [&] { return Vec3{random.uniform(), random.uniform(), random.uniform()}; };
  for (std::uint32_t n = 0; n < 150; ++n) {
    const double size = std::pow(10, -6 * random.uniform());
    const Vec3 at = (n % 2 == 0 ? 1 : size) * point();
    for (int corner = 0; corner < 3; ++corner) mesh.points.push_back(at + size * point());
    mesh.faces.push_back({triangle_of(3 * n, 3 * n + 1, 3 * n + 2), {kNoId, kNoId, kNoId}});
  }
  return mesh;
}

Box3 box_of(const TriMesh& mesh, FaceId f) {
  const auto& [a, b, c] = mesh.faces[f].v;
  return box_of(mesh.points[a], mesh.points[b], mesh.points[c]);
}

}  // namespace

TEST_CASE("no two facets with a common place, and none on a line, are missed by cells") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const TriMesh mesh = some_facets(random);
    const FacetCells cells(mesh);
    std::set<std::pair<FaceId, FaceId>> pairs;
    cells.for_each_pair([&](FaceId f, FaceId g) { pairs.insert(std::minmax(f, g)); });
    const Vec3 from = mesh.points[0], to{5, from.y, from.z};
    std::set<FaceId> on_line;
    cells.for_each_at(from, to, [&](FaceId f) { on_line.insert(f); });
    std::size_t missed = 0;
    for (FaceId f = 0; f < mesh.faces.size(); ++f) {
      for (FaceId g = 0; g < f; ++g) {
        missed += meet(box_of(mesh, f), box_of(mesh, g)) && !pairs.contains({g, f});
      }
      missed += meet(box_of(mesh, f), {from, to}) && !on_line.contains(f);
    }
    CHECK(missed == 0);
    CHECK(pairs.size() < 150 * 149 / 2);
  }
}

TEST_CASE("a line finds tiny facets that are far apart") {
  // Tiny facets in a row.
  TriMesh mesh;
  constexpr std::uint32_t kFacets = 5;
  for (std::uint32_t n = 0; n < kFacets; ++n) {
    const Vec3 at{static_cast<double>(n), 0, 0};
    for (const Vec3& side : {Vec3{0, -1, -1}, Vec3{0, 1, 0}, Vec3{1, 0, 1}}) {
      mesh.points.push_back(at + 1e-6 * side);
    }
    mesh.faces.push_back({triangle_of(3 * n, 3 * n + 1, 3 * n + 2), {kNoId, kNoId, kNoId}});
  }
  std::set<FaceId> met;
  FacetCells(mesh).for_each_at({1, 0, 0}, {3.5, 0, 0}, [&](FaceId f) { met.insert(f); });
  CHECK(met == std::set<FaceId>{FaceId(1), FaceId(2), FaceId(3)});
}

TEST_CASE("a line meets few cells, however tiny and far apart facets are") {
  TriMesh mesh;
  constexpr std::uint32_t kSide = 10, kFacets = kSide * kSide * kSide;
  for (std::uint32_t n = 0; n < kFacets; ++n) {
    const Vec3 at{static_cast<double>(n % kSide), static_cast<double>(n / kSide % kSide),
                  static_cast<double>(n / (kSide * kSide))};
    for (const Vec3& side : {Vec3{0, -1, -1}, Vec3{0, 1, 0}, Vec3{1, 0, 1}}) {
      mesh.points.push_back(at + 1e-6 * side);
    }
    mesh.faces.push_back({triangle_of(3 * n, 3 * n + 1, 3 * n + 2), {kNoId, kNoId, kNoId}});
  }
  CHECK((kSide - 1) / FacetCells(mesh).cell() < 8 * std::sqrt(kFacets));
}

TEST_CASE("facets all at one place have cells") {
  TriMesh mesh;
  mesh.points.assign(3, {1, 2, 3});
  mesh.faces.assign(2, {{0, 1, 2}, {kNoId, kNoId, kNoId}});
  int pairs = 0;
  FacetCells(mesh).for_each_pair([&](FaceId, FaceId) { ++pairs; });
  CHECK(pairs > 0);
}

}  // namespace deliso
