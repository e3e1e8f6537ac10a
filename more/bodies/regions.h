// SPDX-License-Identifier: MIT
// A division of the box into regions, and the sheets in them: what changes in one region touches no
// other. Facets that reach out of a region stay. In four divisions, shifted against each other by a
// quarter of a region, every place is well within a region of at least one: a place near planes of
// three divisions, one for each axis, is near none of the fourth.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "more/bodies/coarsen_sheets.h"

namespace deliso {

class Regions {
 public:
  static constexpr int kShifts = 4;
  // `side`: about how many voxels a region has along each axis; 0: there is one. Not shifted, the
  // planes between regions are planes of samples.
  Regions(const Grid& shape, int side, int shift);

  std::size_t size() const;
  // The samples of a region. pre: not shifted.
  SampleBox samples(std::size_t region) const;
  Box3 box(std::size_t region) const;
  // The faces of that box that are not faces of the volume's.
  unsigned inner_faces(std::size_t region) const;

  // Calls change(sheets, region) for the sheets in each region with a facet that is not done, in
  // several threads, and puts the changed ones in their place. Facets that reach out of the region
  // are not free.
  using Change = std::function<void(Sheets&, std::size_t)>;
  void for_each(Sheets& all, int threads, const Change& change) const;

 private:
  Index3 planes() const;  // along each axis. Regions are numbered as voxels between samples are.

  Grid shape_;
  std::array<std::vector<double>, 3> planes_;  // per axis; the faces of the volume's box, too
};

}  // namespace deliso
