// SPDX-License-Identifier: MIT
// Three slices of a volume in one picture, one across each axis, in gray with the isosurface's
// curves over them. All have one scale, and the volume's proportions.
//
//   S1  A pixel is the mean of 3 x 3 samples of the interpolant. The curve is where neighboring
//       samples lie on two sides of the isovalue, also within a voxel, widened to a line.
//   S2  x or y points to the right, y or z up. In a patient's space it is as in an atlas: the
//       patient's left and back are at the right, anterior and the head are up.
#pragma once

#include <optional>
#include <string>

#include "view/gray/gray.h"
#include "view/render/image.h"
#include "view/render/layout.h"

namespace deliso {

struct SliceOptions {
  PictureSize size;  // of the picture at most: slices fill its width or its height
  Vec3 through;      // the place where the slices meet, in the scaled frame; clamped to the box
  std::optional<double> kappa = {};  // geometric_isovalue(); absent: no curves
  GrayWindow window = {};
  std::string unit = {};  // of lengths, for the scale bar; drawable
  int threads = 1;
};

inline constexpr Rgb kCurve{255, 120, 0};

// Throws InputError if the volume has no voxel, or the picture is too small.
Image draw_slices(const Volume& volume, const SliceOptions& options);

}  // namespace deliso
