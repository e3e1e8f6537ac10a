// SPDX-License-Identifier: MIT
// Reads a volume from a file, from standard input or from a built-in field.
//
//   format          headers and files                 samples stored as
//   --------------  --------------------------------  --------------------------------------------
//   NRRD 1-5        .nrrd; .nhdr + one data file      raw, gzip, ascii
//   MetaImage       .mha; .mhd + one data file        raw, zlib or gzip (CompressedData), ascii
//   NIfTI-1, -2     .nii, .nii.gz; .hdr + .img[.gz]   raw, gzip
//   MRC, CCP4       .mrc, .map, .ccp4; [.gz]          raw, gzip
//   INRIMAGE-4      .inr, .inr.gz                     raw, gzip
//   VTK legacy      .vtk, STRUCTURED_POINTS           BINARY, ASCII; one scalar array
//   VTK XML         .vti, .vtr, one piece             appended (raw, base64), binary, ascii;
//                                                     plain or vtkZLibDataCompressor
//   NumPy           .npy, an array [z][y][x]          raw, C or Fortran order
//   DICOM           a folder of slices; one file of   raw (either VR, either byte order), deflated,
//                   several frames                    RLE, lossless JPEG, JPEG-LS
//   TIFF, BigTIFF   a folder of slices; one file of   raw, LZW, Deflate, PackBits; strips, tiles
//                   several pages
//   plain           any, dims and type from options   raw
//   built-in        builtin:NAME[:SIZE]               computed (builtin_volume.h)
//
// 1. Samples stay in their file type: uint8/16/32, int8/16/32, float32/64, either byte order. Three
//    are converted, and the log says so of the first two. Scaled samples (of NIfTI, DICOM, ImageJ)
//    become float32 from types of up to 16 bits and float32, else float64. Integers of 64 bits
//    become float64, or numbers of ids (io/volume/wide_integers.h). TIFF's integers of other sizes
//    up to 16 bits become uint8 or uint16.
// 2. The content decides the format; the name decides only where the content cannot (MetaImage,
//    .raw). A .nhdr or .mhd has its data beside it.
// 3. Coordinates are those of the file, in its own unit and, unless the options turn them, its own
//    anatomical space. Frame::space has the space: RAS+ for NIfTI, LPS+ for MetaImage and DICOM,
//    the field "space" for NRRD. Samples are never resampled: slices at uneven distances, with one
//    missing, or shifted by a tilted gantry, make a grid that has them where the file says. NIfTI's
//    meters and micrometers become millimeters, which the unit is in these spaces.
// 4. Refused with a message, never guessed:
//    - 64-bit integers that float64 does not hold, if they are no labels; complex samples, several
//      components;
//    - several channels or times, if no option chooses one (SeveralVolumes);
//    - axes near one plane. Others that are not at right angles are kept: the mesh is of the grid
//      of samples, and its vertices are mapped to the world;
//    - data of another size than in the header, more than one data file or piece;
//    - several series of DICOM, if the options name none (SeveralSeries);
//    - TIFF slices of different sizes or types;
//    - pictures in color, JPEG that loses detail, JPEG 2000 and other codecs of pictures;
//    - bzip2, hex, lz4 and lzma encodings.
//    For other formats with known first bytes the message has a way to convert them
//    (foreign_formats.h).
// 5. Of several arrays (VTK) the options name one. Else it is the one that the file calls active,
//    if it can be meshed, else the first that can, and the log says so. Of several channels or
//    times the options choose one (several_volumes.h).
// 6. A hostile or damaged file gives an InputError or a valid volume. Memory is allocated only for
//    data that exists. value_range() finds samples that are NaN or out of range.
#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/diagnostics.h"
#include "base/vec3.h"
#include "io/files/expansion_budget.h"
#include "io/files/input_file.h"
#include "volume/volume.h"

namespace deliso {

// Samples begin.i <= i < end.i, and likewise j and k: at least two along each axis.
struct Roi {
  Index3 begin, end;
};

// How a file stores samples: as a volume has them, or as integers of 64 bits, which no volume has.
struct StoredType {
  enum class Wide : std::uint8_t { no, i64, u64 };
  constexpr StoredType(SampleType known) : type(known) {}
  constexpr StoredType(Wide integers) : type(SampleType::f64), wide(integers) {}
  constexpr operator SampleType() const { return type; }

  SampleType type;  // f64 of wide ones, and so of their size
  Wide wide = Wide::no;
};
constexpr std::string_view name_of(StoredType type) {
  return type.wide == StoredType::Wide::no    ? name_of(type.type)
         : type.wide == StoredType::Wide::i64 ? "int64"
                                              : "uint64";
}

// The layout of a file without a header.
struct RawLayout {
  Index3 dims;
  StoredType type = SampleType::u8;
  std::endian byte_order = std::endian::little;
  std::uint64_t skip = 0;  // bytes before the first sample
};

using RegionOf = std::function<Roi(const Grid& whole)>;

struct ReadOptions {
  std::optional<RawLayout> raw;  // if given, the input is plain raw data, with any name
  std::optional<Roi> roi;        // if given, only these samples are read; the origin moves along
  // If given, only the region that it returns for the whole volume is read, as a part of it
  // (Grid::part). Not with a roi.
  RegionOf region{};
  std::optional<std::string> array{};     // which of a VTK file's arrays, by its name
  std::optional<std::uint64_t> series{};  // which of a DICOM folder's series, from 1 on
  // Along the file's axes, and of its first sample; else the file's own, or 1,1,1 and 0,0,0.
  std::optional<Vec3> spacing{}, origin{};
  // Of the samples along an axis, where they are given: in place of the file's spacing and, along
  // this axis, of its origin. They increase, as many as there are samples (read_coordinates).
  Coordinates coordinates{};
  // The patient's space that the world is turned to; unknown: the file's own.
  AnatomicalSpace space = AnatomicalSpace::unknown;
  // Which of several volumes in a file, counted from 1.
  std::optional<std::int64_t> channel{}, time{};
  bool as_labels = false;  // integers of 64 bits that float64 does not hold become ReadLog::ids
  ExpansionBudget budget{};
};

// A named array of a file.
struct NamedArray {
  std::string name;
  std::string type;  // in the spelling of --type, or of the file if --type has none
  std::uint64_t components = 1;
  bool read = false;  // the volume is this one
};

// A segment that a file names, as Slicer's .seg.nrrd does.
struct NamedSegment {
  std::string name;
  std::int64_t label = 1;                              // of its samples
  std::int64_t channel = 1;                            // that has them
  std::optional<std::array<std::uint8_t, 3>> color{};  // sRGB
};

// Facts about the reading, beside the volume.
struct ReadLog {
  Diagnostics notes;                   // and warnings, for the user
  std::vector<FileState> files;        // all that the volume is made of, header and data
  std::vector<NamedArray> arrays;      // of formats that name theirs (VTK)
  std::vector<NamedSegment> segments;  // of the channel that was read
  // If not empty, sample n stands for ids[n], in ascending order (io/volume/wide_integers.h).
  std::vector<std::int64_t> ids;
  StoredType type_of_ids = StoredType::Wide::i64;  // in the file

  std::vector<std::string> paths() const {
    std::vector<std::string> paths;
    for (const FileState& file : files) paths.push_back(file.path);
    return paths;
  }
};

struct VolumeCounts {
  std::int64_t channels = 1, times = 1;
};

// Thrown for a file of several channels or times, if the options choose none.
struct SeveralVolumes : InputError {
  SeveralVolumes(const VolumeCounts& several, const std::string& name, const std::string& message)
      : InputError(name, ": ", message), counts(several), words(message) {}
  VolumeCounts counts;
  std::string words;  // without the file's name
};

// A series of a folder, or what of it may be one volume.
struct FoundSeries {
  std::string description{}, file{};  // of the series; its first file, within the folder
  std::int64_t images = 0, columns = 0, rows = 0;
  std::string doubt{};  // why the images may be no volume, as "no positions"; or empty
};
// Returns "'CT head', 30 images of 512 x 512 ('a/001')" or the like.
std::string text_of(const FoundSeries& series);

// Thrown for a folder of several series, if the options name none of them. --series counts them
// from 1.
struct SeveralSeries : InputError {
  SeveralSeries(std::vector<FoundSeries> found, const auto&... message)
      : InputError(message...), series(std::move(found)) {}
  std::vector<FoundSeries> series;
  std::vector<std::string> paths{};  // of all files of the folder
  Diagnostics notes{};               // of reading them
};

// Returns the volume of `input`: a path of a file or of a folder of slices (DICOM, TIFF), "-"
// (standard input) or "builtin:NAME[:SIZE]". Throws an InputError of one line that names the file
// and the fault.
Volume read_volume(const std::string& input, const ReadOptions& options = {},
                   ReadLog* log = nullptr);

// Returns the segments that the file names: none in most. Throws InputError if it cannot be read.
std::vector<NamedSegment> read_segments(const std::string& path);

// Command-line spellings; InputError if they are none. "x0:x1,y0:y1,z0:z1" (x1, y1, z1 excluded),
// "256x256x128", "uint8" and the like (also NRRD's and VTK's names: "unsigned
// short", "float", ...).
Roi parse_roi(std::string_view text);
Index3 parse_dims(std::string_view text);
// Returns the coordinates in a text file: a line "x", "y" or "z" and the numbers along it, for each
// axis that has them. Throws InputError with the file's name.
Coordinates read_coordinates(const std::string& path);
StoredType parse_sample_type(std::string_view text);

// Returns the type of that name, in any format's spelling; nullopt if it is unknown or unsupported.
std::optional<StoredType> sample_type_named(std::string_view name);

}  // namespace deliso
