// SPDX-License-Identifier: MIT
// Space divided among bodies. Each has a field, and a point belongs to the body with the largest
// one: of equal ones to that with the smaller number. A body may be given for each sample: where
// its field is not the largest there by a margin, it is raised to that. Beyond the box of samples
// lie six more bodies, one behind each face, so that every body is bounded.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/box3.h"
#include "base/ids.h"
#include "base/vec3.h"
#include "volume/volume.h"
#include "volume/volume_source.h"

namespace deliso {

using BodyId = std::uint32_t;

class Partition {
 public:
  // `shape`: of the whole; its samples are not read. The field of a body is a block of it, in
  // float32. It is not negative, and 0 beyond the block. `background`: a body that has no caps, and
  // is in front of all others; kNoId: none. `kept`: the body of each sample, in whose field's block
  // it is; empty: the fields say it.
  Partition(const Grid& shape, std::vector<Volume> fields, BodyId background, int threads,
            std::vector<BodyId> kept = {});

  std::size_t size() const { return fields_.size(); }  // bodies
  const Grid& shape() const { return shape_; }
  BodyId background() const { return background_; }
  // The body behind face f of the box (base/box3.h).
  BodyId beyond(int f) const { return static_cast<BodyId>(size()) + static_cast<BodyId>(f); }
  bool is_beyond(BodyId body) const { return body >= size(); }
  // Returns the two in the order {in front, behind} of a facet between them: beyond the box is in
  // front, then the background, then the larger number.
  std::array<BodyId, 2> in_order(BodyId a, BodyId b) const;

  BodyId body_at(Index3 sample) const { return body_[shape_.index(sample.i, sample.j, sample.k)]; }
  double value(BodyId body, Index3 sample) const;
  double value(BodyId body, const Vec3& p) const;
  Vec3 gradient(BodyId body, const Vec3& p) const;
  // Returns how many samples belong to each body.
  std::vector<std::uint64_t> samples() const;
  // Returns the Euler number of the surface around the samples of each body, each a closed cube: so
  // they are neighbors by faces, edges and corners.
  std::vector<std::int64_t> euler_numbers() const;

  // Returns the field of `behind` less that of `in_front` at the samples of a box, as a block of
  // the whole: their border is where it is 0. Of a body beyond the box, the distance from its face,
  // in samples, less a little: the border lies there.
  Volume difference(std::array<BodyId, 2> bodies, const SampleBox& box) const;

  // The step from p towards where the fields of two or three bodies are equal, within the faces of
  // the box named in `faces`: Newton's, in the space that the gradients of their differences span.
  // Nothing where these are nearly dependent.
  std::optional<Vec3> step_to_tie(const Vec3& p, std::span<const BodyId> bodies,
                                  unsigned faces) const;

 private:
  template <class Visit>
  void for_each_value(int k, Visit&& visit) const;
  void raise_fields(int threads);

  Grid shape_;
  std::vector<Volume> fields_;
  BodyId background_;
  std::vector<BodyId> body_;  // per sample
};

}  // namespace deliso
