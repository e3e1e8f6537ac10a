// SPDX-License-Identifier: MIT
// Space divided among bodies. Each has a field, and a point belongs to the body with the largest
// one. Where two bodies alone are near, the fields are opposite in sign and the bodies border on
// one surface. Where three are, all fields may be negative; the largest decides all the same, so no
// point is without a body.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "volume/volume.h"

namespace deliso {

using BodyId = std::uint32_t;

// The field of a body, in a box whose first sample lies at `offset`. Beyond it the field is less
// than any other.
struct BodyField {
  Volume volume;
  Vec3 offset;

  double value(const Vec3& p) const { return volume.value(p - offset); }
  Vec3 gradient(const Vec3& p) const { return volume.gradient(p - offset); }
};

class Partition {
 public:
  // The first field is that of the background, and has all samples.
  explicit Partition(std::vector<BodyField> fields);

  // The bodies with the largest fields at a point, the largest first.
  struct Ranking {
    static constexpr std::size_t kMost = 4;
    std::array<BodyId, kMost> body;
    std::array<double, kMost> value;
    std::size_t count = 0;
  };
  Ranking rank(const Vec3& p) const;
  // Returns the body of p: the background outside the box.
  BodyId body_at(const Vec3& p) const;

  // Returns a point where the fields of these bodies are equal, found from p by Newton's method in
  // the space that their differences span. Nothing if there is none within `within`.
  std::optional<Vec3> tie(const Vec3& p, std::span<const BodyId> bodies, double within) const;
  // Returns the distance of p from where the fields of a and b are equal, to first order.
  double distance_to_tie(const Vec3& p, BodyId a, BodyId b) const;

  std::size_t size() const { return fields_.size(); }
  const Volume& volume() const { return fields_[0].volume; }

 private:
  double value(BodyId body, const Vec3& p) const;

  std::vector<BodyField> fields_;
  std::vector<Box3> boxes_;
};

}  // namespace deliso
