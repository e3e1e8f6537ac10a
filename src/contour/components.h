// SPDX-License-Identifier: MIT
// Connected components during the walk: a union-find whose roots carry counts of the pieces seen.
// Labels are given in scan order, and a root is the smallest of its labels. So the roots in order
// are the components by first voxel.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "contour/contour.h"

namespace deliso {

class GrowingComponents {
 public:
  struct Counts {
    std::uint64_t crossings = 0, pieces = 0, tubes = 0, disks = 0;
    // Segments between crossings, counted once per voxel that they bound and twice on the box. So a
    // finished component has every segment counted twice.
    std::uint64_t half_sides = 0;
    Index3 first, lo, hi;
  };

  std::uint32_t add(Index3 voxel) {
    const auto label = static_cast<std::uint32_t>(parent_.size());
    parent_.push_back(label);
    counts_.push_back({.first = voxel, .lo = voxel, .hi = voxel});
    return label;
  }

  std::uint32_t root(std::uint32_t label) {
    while (parent_[label] != label) {
      parent_[label] = parent_[parent_[label]];
      label = parent_[label];
    }
    return label;
  }

  // Unites two components and returns their root. pre: a and b are roots.
  std::uint32_t unite(std::uint32_t a, std::uint32_t b) {
    if (a == b) return a;
    if (b < a) std::swap(a, b);
    parent_[b] = a;
    Counts &into = counts_[a], &from = counts_[b];
    into.crossings += from.crossings;
    into.pieces += from.pieces;
    into.tubes += from.tubes;
    into.disks += from.disks;
    into.half_sides += from.half_sides;
    for (int axis = 0; axis < 3; ++axis) {
      into.lo[axis] = std::min(into.lo[axis], from.lo[axis]);
      into.hi[axis] = std::max(into.hi[axis], from.hi[axis]);
    }
    return a;
  }

  Counts& counts(std::uint32_t root_label) { return counts_[root_label]; }

  // Appends the components in order and returns the number of each label's component.
  std::vector<std::uint32_t> finish(std::vector<ContourComponent>& components) {
    std::vector<std::uint32_t> number_of(parent_.size());
    for (std::uint32_t label = 0; label < parent_.size(); ++label) {
      if (parent_[label] != label) {
        number_of[label] = number_of[parent_[label]];
        continue;
      }
      number_of[label] = static_cast<std::uint32_t>(components.size());
      const Counts& n = counts_[label];
      ContourComponent component;
      component.euler = static_cast<std::int64_t>(n.crossings) -
                        static_cast<std::int64_t>(n.half_sides / 2) +
                        static_cast<std::int64_t>(n.disks);
      component.crossings = n.crossings;
      component.pieces = n.pieces;
      component.tubes = n.tubes;
      component.first = n.first;
      component.lo = n.lo;
      component.hi = n.hi;
      components.push_back(component);
    }
    return number_of;
  }

 private:
  std::vector<std::uint32_t> parent_;  // never larger than the label itself
  std::vector<Counts> counts_;
};

}  // namespace deliso
