// SPDX-License-Identifier: MIT
// Objects that a file places in the world, some more than once.
#pragma once

#include <array>
#include <string>

#include "io/mesh/mesh_parsers.h"

namespace deliso {

// Maps p to p.x columns[0] + p.y columns[1] + p.z columns[2] + columns[3].
struct AffineMap {
  std::array<Vec3, 4> columns{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, 0}};

  Vec3 operator()(const Vec3& p) const { return linear(p) + columns[3]; }
  AffineMap operator*(const AffineMap& first) const {
    const auto& c = first.columns;
    return {{linear(c[0]), linear(c[1]), linear(c[2]), (*this)(c[3])}};
  }
  bool mirrors() const { return dot(cross(columns[0], columns[1]), columns[2]) < 0; }

 private:
  Vec3 linear(const Vec3& p) const {
    return p.x * columns[0] + p.y * columns[1] + p.z * columns[2];
  }
};

// The mesh of all copies.
class PlacedObjects {
 public:
  explicit PlacedObjects(std::string name) : name_(std::move(name)) {}

  // Adds a copy, with reversed facets if the map mirrors. Throws InputError if copies are so many
  // that a small file would fill the memory.
  void add(const MeshParts& object, const AffineMap& to_world) {
    copied_ += object.points.size() + object.triangles.size() + 1;
    if (copied_ > kMostCopied && copied_ / kMostCopies > original_) {
      fail(name_, "places its objects more than ", kMostCopies, " times");
    }
    const std::size_t first = mesh.points.size();
    for (const Vec3& p : object.points) mesh.points.push_back(to_world(p));
    const bool mirrors = to_world.mirrors();
    for (const Triangle& t : object.triangles) {
      const auto corner = [&](int n) { return VertexId(first + std::size_t{t[n]}); };
      mesh.triangles.push_back({corner(0), corner(mirrors ? 2 : 1), corner(mirrors ? 1 : 2)});
    }
  }
  // Counts an object that was read.
  void count(const MeshParts& object) {
    original_ += object.points.size() + object.triangles.size();
  }

  MeshParts mesh;

 private:
  static constexpr std::size_t kMostCopies = 100, kMostCopied = 1'000'000;

  std::string name_;
  std::size_t original_ = 0, copied_ = 0;  // vertices and triangles
};

}  // namespace deliso
