// SPDX-License-Identifier: MIT
// Reads a volume from a file, from standard input or from a built-in field.
//
//   format          headers and files                 samples stored as
//   --------------  --------------------------------  --------------------------------------------
//   NRRD 1-5        .nrrd; .nhdr + one data file      raw, gzip, ascii
//   MetaImage       .mha; .mhd + one data file        raw, zlib or gzip (CompressedData), ascii
//   NIfTI-1, -2     .nii, .nii.gz; .hdr + .img[.gz]   raw, gzip
//   VTK legacy      .vtk, STRUCTURED_POINTS           BINARY, ASCII; one scalar array
//   VTK XML         .vti, one piece                   appended (raw, base64), binary, ascii;
//                                                     plain or vtkZLibDataCompressor
//   plain           any, dims and type from options   raw
//   built-in        builtin:NAME[:SIZE]               computed (builtin_volume.h)
//
// 1. Samples stay in their file type: uint8/16/32, int8/16/32, float32/64, either byte order. Only
//    a NIfTI file with a scaling (scl_slope, scl_inter) is converted, to float32 (from types of up
//    to 16 bits and float32) or float64, and the log says so.
// 2. The format is told by the content, not the name; the name decides only where the content
//    cannot (MetaImage, .raw). A .nhdr or .mhd finds its data beside itself.
// 3. Coordinates are those of the file, in its own unit and anatomical space, which is recorded in
//    Frame::space: NIfTI is RAS+, MetaImage LPS+, NRRD what its "space" says.
// 4. Refused with a message, never guessed: 64-bit integers and complex samples, several components
//    or time steps (trailing dimensions of 1 are fine), sheared grids (axes not at right angles
//    within 1e-4), data of another size than the header says, more than one data file or piece,
//    bzip2, hex, lz4 and lzma encodings. Of other formats that are told from their first bytes the
//    message says how to convert them (foreign_formats.h).
// 5. Of several arrays (VTK) the options name one; else it is the one that the file calls active,
//    else the first that can be meshed, and the log says so.
// 6. A hostile or damaged file gives an InputError or a valid volume, whatever it holds; memory is
//    taken only for data that is there. NaN and infinite samples are found by value_range().
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec3.h"
#include "volume/volume.h"

namespace deliso {

// Samples begin.i <= i < end.i, and likewise j and k: at least two along each axis.
struct Roi {
  Index3 begin, end;
};

// Block `at` of the `of` that a volume is cut into along each axis. Blocks share the samples at the
// faces between them, so that every voxel is in one block.
struct BlockChoice {
  Index3 at, of;
};
// The samples of the block: v voxels become parts n of N, each from n v / N on. Throws InputError
// where an axis has fewer voxels than blocks.
Roi region_of(const BlockChoice& block, Index3 dims);

// How to read a file without a header.
struct RawLayout {
  Index3 dims;
  SampleType type = SampleType::u8;
  Vec3 spacing{1, 1, 1};
  std::endian byte_order = std::endian::little;
  std::uint64_t skip = 0;  // bytes before the first sample
};

struct ReadOptions {
  std::optional<RawLayout> raw;  // given: the input is plain raw data, whatever its name
  std::optional<Roi> roi;        // given: only this part; the origin moves along
  // Given: only this block, which knows of the whole (Volume::as_block). Not with a roi.
  std::optional<BlockChoice> block{};
  std::optional<std::string> array{};  // which of a VTK file's arrays, by its name
};

// An array of a file that has several, with names: what it holds for every point.
struct NamedArray {
  std::string name;
  std::string type;  // as --type has it; what that does not know, as the file has it
  std::uint64_t components = 1;
  bool read = false;  // the volume is this one
};

// What reading has to say beyond the volume itself.
struct ReadLog {
  std::vector<std::string> notes;  // what a user should know, one line each
  std::vector<std::string> files;  // all that were opened, header and data
  std::vector<NamedArray> arrays;  // of formats that name theirs (VTK)
};

// `input` is a path, "-" (standard input) or "builtin:NAME[:SIZE]". Throws InputError: one line
// that names the file and the fault.
Volume read_volume(const std::string& input, const ReadOptions& options = {},
                   ReadLog* log = nullptr);

// Command-line spellings; InputError if they are none. "x0:x1,y0:y1,z0:z1" (x1, y1, z1 excluded),
// "i,j,k/nx,ny,nz", "256x256x128", "uint8" and the like (also NRRD's and VTK's names: "unsigned
// short", "float", ...).
Roi parse_roi(std::string_view text);
BlockChoice parse_block(std::string_view text);
Index3 parse_dims(std::string_view text);
SampleType parse_sample_type(std::string_view text);

// The type of that name, in any format's spelling; nothing if it is unknown or unsupported.
std::optional<SampleType> sample_type_named(std::string_view name);

}  // namespace deliso
