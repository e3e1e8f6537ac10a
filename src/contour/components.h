// SPDX-License-Identifier: MIT
// Connected components during the walk: sets of labels, whose roots carry counts of the pieces
// seen. Labels are given in scan order, and a root is the smallest of its labels. So the roots in
// order are the components by first voxel.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"
#include "contour/contour.h"

namespace deliso {

class GrowingComponents {
 public:
  struct Counts : ContourComponent {  // without Euler number
    // Segments between crossings, counted once per voxel that they bound and twice on the box. So a
    // finished component has every segment counted twice.
    std::uint64_t half_sides = 0;
  };

  std::uint32_t add(Index3 voxel) {
    counts_.push_back({{.first = voxel, .lo = voxel, .hi = voxel}});
    return sets_.add();
  }

  std::uint32_t root(std::uint32_t label) { return sets_.find(label); }

  // Unites two components and returns their root. pre: a and b are roots.
  std::uint32_t unite(std::uint32_t a, std::uint32_t b) {
    if (a == b) return a;
    if (b < a) std::swap(a, b);
    sets_.unite(a, b);
    counts_[a].add(counts_[b]);
    counts_[a].half_sides += counts_[b].half_sides;
    return a;
  }

  Counts& counts(std::uint32_t root_label) { return counts_[root_label]; }

  // Appends the components in order and returns the number of each label's component.
  std::vector<std::uint32_t> finish(std::vector<ContourComponent>& components) {
    for (std::uint32_t label = 0; label < counts_.size(); ++label) {
      if (sets_.find(label) != label) continue;
      Counts& n = counts_[label];
      const std::uint64_t disks = n.pieces - n.tubes;
      n.euler = static_cast<std::int64_t>(n.crossings + disks) -
                static_cast<std::int64_t>(n.half_sides / 2);
      components.push_back(n);
    }
    return sets_.take_numbers();
  }

 private:
  DisjointSets sets_;
  std::vector<Counts> counts_;
};

}  // namespace deliso
