// SPDX-License-Identifier: MIT
// The images of one volume among those that a folder holds: hospitals send several series together,
// and a series with its scout.
#pragma once

#include <string>
#include <vector>

#include "io/volume/dicom_file.h"
#include "io/volume/volume_formats.h"

namespace deliso {

// Images differ in their planes if these differ more. Places are written with about three decimals.
constexpr double kDirectionError = 1e-3;  // of a unit vector
constexpr double kSpacingError = 1e-4;    // of the spacing

struct ChosenSeries {
  std::vector<DicomFile> files;
  std::string left_out;  // the others, for a message; or empty
};

// Returns the images of one series, size, orientation and spacing: those that the options ask for,
// or the only ones that may be a volume. Throws InputError with a list if there are several.
ChosenSeries choose_series(const VolumeInput& input, std::vector<DicomFile> files);

}  // namespace deliso
