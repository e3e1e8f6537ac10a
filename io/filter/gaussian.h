// SPDX-License-Identifier: MIT
// A Gaussian filter of the samples. Its result is a volume like any other, so that all that holds
// of a mesh holds of the smoothed field.
#pragma once

#include "base/vec3.h"
#include "volume/volume.h"

namespace deliso {

// A Gaussian is cut off at this number of standard deviations, as in scipy.ndimage.
inline constexpr double kGaussianReach = 4;
inline constexpr double kLargestSigma = 100;  // samples; it bounds the time

// Returns the number of samples on either side that have a weight: 0 if `sigma` changes nothing.
int gaussian_radius(double sigma);

// Returns the volume under a Gaussian with `sigma` samples along x, y and z. Beyond the box samples
// are reflected (d c b a | a b c d | d c b a); beyond a block's too, so what lies within the radius
// of an inner face differs from the larger volume's. Sums are of doubles in a fixed order, so the
// result is the same with any number of threads. It is float32; float64 for samples that float32
// may round (32-bit integers, float64). Memory: the result, and two slices per thread. pre: each
// sigma is from 0 to kLargestSigma; no sample is NaN or infinite.
Volume gaussian(const Volume& volume, const Vec3& sigma, int threads = 1);

// Returns the type of the result.
SampleType gaussian_type(SampleType type);

}  // namespace deliso
