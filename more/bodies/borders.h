// SPDX-License-Identifier: MIT
// The oracle of each sheet: where the fields of its two bodies are equal.
#pragma once

#include <array>
#include <deque>
#include <span>
#include <vector>

#include "isosurface/isosurface.h"
#include "more/bodies/sheets.h"
#include "run/parameters.h"
#include "surface/facet_test.h"
#include "surface/surface_point.h"

namespace deliso {

// The border of two bodies in a box, the zero surface of the difference of their fields.
struct Border {
  Border(Volume fields, double kappa, const Parameters& parameters, double distance)
      : difference(std::move(fields)),
        surface(difference, kappa),
        test(difference, kappa, parameters, distance),
        test_at_curve(test),
        finder(surface) {
    // Near curves T_L is far from the fields: only that way its vertices come nearer. Insertions in
    // the sheets mend shapes.
    constexpr double kRatio = 4, kBoundVoxels = 0.4;
    test_at_curve.ratio2 = kRatio * kRatio;
    test_at_curve.bound = std::max(distance, kBoundVoxels * parameters.voxel);
    test_at_curve.r_min2 = kNotAsked;
  }
  Border(const Border&) = delete;

  Volume difference;
  Isosurface surface;
  FacetTest test, test_at_curve;  // of facets at a vertex within the sheet, or on a curve
  SurfacePointFinder finder;
};

// The borders of some sheets, each in a box around the points of its facets.
class Borders {
 public:
  Borders(const Partition& partition, const Parameters& parameters, double distance,
          const Sheets& sheets, const CutSheets& cut);

  Border& operator[](std::uint32_t sheet) { return borders_[sheet]; }

 private:
  std::deque<Border> borders_;
};

}  // namespace deliso
