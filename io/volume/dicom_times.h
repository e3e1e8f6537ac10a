// SPDX-License-Identifier: MIT
// Several slices at each place: of times, of the phases of a heart, of echoes.
#pragma once

#include <vector>

#include "io/volume/dicom_slices.h"
#include "io/volume/volume_formats.h"

namespace deliso {

// Leaves one slice at each place: those of the time that the options choose. Throws InputError if
// they choose none of several, or if places have different numbers of slices. pre: `slices` are
// sorted by their heights.
void choose_time(const VolumeInput& input, std::vector<DicomSlice>& slices);

// Returns the distances from each slice to the next.
std::vector<double> gaps_between(const std::vector<DicomSlice>& slices);

// Returns the middle of the distances between the slices, without those at one place; 0 if there
// are none. pre: `slices` are sorted by their heights.
double usual_distance(const std::vector<DicomSlice>& slices);

}  // namespace deliso
