// SPDX-License-Identifier: MIT
// Decides whether samples are the labels of a segmentation or those of a gray image.
//
//   L1  All samples are whole numbers of 64 bits. They have at least two values, and at most
//       4096.
//   L2  Half of the values or more are flat: half of their samples' neighbors along the axes, or
//       more, have the same value. A ball of labels is flat from a radius of 1.5 samples on. Of 16
//       values or fewer it suffices that half of all samples' neighbors have.
//   L3  If there are more than 16 values: no more than three quarters of the neighbors that differ
//       do so by 1, or 5 % and more by over a quarter of the number of values. A smooth image that
//       was rounded to whole numbers is flat too, but has no edges. Labels that are numbered in
//       order of place differ from their neighbors by 1, but not from the background.
//
// Measured on eight gray images of 8 and 16 bits, as they are, cropped, and after up to three
// medians: at most 9 % of their values are flat. Of random balls (radius 1.5 and more, up to 100
// labels), random Voronoi cells (5 to 3,000), and thresholded fields, at least 64 % are.
//
// Limits: a gray image of 16 values or fewer passes where it is smooth, and one whose samples were
// repeated does where it was enlarged two or three times. Labels of single samples on no
// background do not pass, and none that are numbered in order of place without a background.
#pragma once

#include "volume/volume.h"

namespace deliso {

// Of a large volume some rows are looked at, with about four million samples in all.
bool looks_like_labels(const Volume& volume);

}  // namespace deliso
