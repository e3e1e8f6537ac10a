// SPDX-License-Identifier: MIT
// The readers of read_volume(), one per format. Each gets a whole input of its format, fills in a
// SampleGrid and finds the data. All throw InputError.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "io/files/input_file.h"
#include "io/volume/read_volume.h"
#include "io/volume/sample_grid.h"
#include "volume/volume.h"

namespace deliso {

struct DicomFile;

struct VolumeInput {
  Bytes bytes;            // bytes.name is the path, or "standard input"
  std::string directory;  // where detached data files are: "" or ending with a slash
  const ReadOptions& options;
  ReadLog& log;

  const std::string& name() const { return bytes.name; }
  // Tell of the input. base/diagnostics.h has the codes.
  Diagnostic& note(Code code, const auto&... words) const {
    return add_note(log.notes, code, name(), words...);
  }
  Diagnostic& warn(Code code, const auto&... words) const {
    return add_warning(log.notes, code, name(), words...);
  }
};

// With its name and options filled in.
SampleGrid grid_of(const VolumeInput& input);

bool looks_like_nrrd(const Bytes& bytes);
Volume read_nrrd(const VolumeInput& input);
// pre: looks_like_nrrd().
std::vector<NamedSegment> segments_of_nrrd(const Bytes& bytes);

bool looks_like_metaimage(const Bytes& bytes);
Volume read_metaimage(const VolumeInput& input);

// Also of files that gzip compressed as a whole (start_of()). They throw if the start is damaged.
bool looks_like_nifti(const Bytes& bytes);
Volume read_nifti(const VolumeInput& input);
bool looks_like_mrc(const Bytes& bytes);
Volume read_mrc(const VolumeInput& input);
bool looks_like_inr(const Bytes& bytes);
Volume read_inr(const VolumeInput& input);

bool looks_like_vtk(const Bytes& bytes);
Volume read_vtk(const VolumeInput& input);

bool looks_like_vti(const Bytes& bytes);
Volume read_vti(const VolumeInput& input);

bool looks_like_npy(const Bytes& bytes);
Volume read_npy(const VolumeInput& input);

bool has_dicom_preamble(const Bytes& bytes);
// True for some files without a preamble too.
bool looks_like_dicom(const Bytes& bytes);
// A file of several frames; or a DICOMDIR, which stands for its folder.
Volume read_dicom(const VolumeInput& input);
// A segmentation; and its segments, none of other files.
Volume read_dicom_segmentation(const VolumeInput& input, const DicomFile& file);
std::vector<NamedSegment> segments_of_dicom(const Bytes& bytes);
// Returns the color of a triple of CIELab in 16 bits each (PS3.3, C.10.7.1.1).
std::array<std::uint8_t, 3> srgb_of_cielab(const std::array<std::uint16_t, 3>& scaled);
// One series of these files. `input` has their folder's name.
Volume read_dicom_series(const VolumeInput& input, std::vector<DicomFile> files);

bool looks_like_tiff(const Bytes& bytes);
Volume read_tiff(const VolumeInput& input);
// The files of a folder, of one page each, in the order of the numbers in their names. `input` has
// the folder's name.
Volume read_tiff_slices(const VolumeInput& input, std::vector<Bytes> files);

// A folder of DICOM or TIFF slices. `input` has its name and no bytes.
Volume read_folder(const VolumeInput& input);

// pre: input.options.raw.
Volume read_raw(const VolumeInput& input);

// Notes a spacing and an origin that are given, for formats that have their own.
void note_place(const VolumeInput& input);
// Throws InputError if a series is given, for formats that have none.
void refuse_series(const std::string& name, const ReadOptions& options);

// Opens the file that a header of `input` names, and logs it. Relative names begin at the header's
// folder.
Bytes open_data_file(const VolumeInput& input, std::string_view file_name);
// Returns the sample type of that name. Throws InputError if there is none.
StoredType supported_type(const VolumeInput& input, std::string_view name);

}  // namespace deliso
