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

// The mesh of all copies. Throws InputError if a small file would fill the memory with them.
class PlacedObjects {
 public:
  PlacedObjects(std::string name, std::uint64_t file_bytes, const ExpansionBudget& budget)
      : name_(std::move(name)), file_bytes_(file_bytes), budget_(budget) {}

  // Adds a copy, with reversed facets if the map mirrors.
  void add(const MeshParts& object, const AffineMap& to_world) {
    // An object without vertices takes time all the same.
    grow(sizeof to_world + memory_of(object.points.size(), object.triangles.size()));
    const std::size_t first = mesh.points.size();
    for (const Vec3& p : object.points) mesh.points.push_back(to_world(p));
    if (!object.colors.empty() || !mesh.colors.empty()) {
      mesh.colors.resize(mesh.triangles.size(), kNoColor);
      mesh.colors.insert(mesh.colors.end(), object.colors.begin(), object.colors.end());
      mesh.colors.resize(mesh.triangles.size() + object.triangles.size(), kNoColor);
    }
    const bool mirrors = to_world.mirrors();
    for (const Triangle& t : object.triangles) {
      const auto corner = [&](int n) { return VertexId(first + std::size_t{t[n]}); };
      mesh.triangles.push_back({corner(0), corner(mirrors ? 2 : 1), corner(mirrors ? 1 : 2)});
    }
  }
  // Counts what is about to be made of the file for an object, and for the copy that it will have.
  void count(std::uint64_t points, std::uint64_t triangles) {
    grow(2 * memory_of(points, triangles));
  }

  MeshParts mesh;

 private:
  static std::uint64_t memory_of(std::uint64_t points, std::uint64_t triangles) {
    return points * sizeof(Vec3) + triangles * sizeof(Triangle);
  }
  void grow(std::uint64_t bytes) {
    made_bytes_ += bytes;
    budget_.require(name_, file_bytes_, made_bytes_);
  }

  std::string name_;
  std::uint64_t file_bytes_, made_bytes_ = 0;
  ExpansionBudget budget_;
};

}  // namespace deliso
