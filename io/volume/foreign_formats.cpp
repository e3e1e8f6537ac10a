// SPDX-License-Identifier: MIT
#include "io/volume/foreign_formats.h"

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "io/files/text_scan.h"

namespace deliso {
namespace {

using namespace std::string_view_literals;

constexpr const char* kPicture =
    "is a picture: make one raw file of the slices with 'convert SLICES -depth 8 "
    "gray:volume.raw', and give --dims and --type";
constexpr const char* kPictures =
    "is a folder of pictures: make one raw file of the slices with 'convert SLICES -depth 8 "
    "gray:volume.raw', and give --dims and --type";
constexpr const char* kZarr =
    "is Zarr: write the array with Python's zarr.open(PATH)[:].tofile('volume.raw'), and give "
    "--dims and --type";
constexpr const char* kAnalyze = "is ANALYZE 7.5: convert it with 'mri_convert FILE volume.nii'";

struct Signature {
  std::size_t offset;
  std::string_view bytes;
  const char* message;
};
constexpr Signature kSignatures[] = {
    {0, "\x89HDF\r\n\x1a\n"sv,
     "is HDF5: make it raw with 'h5dump -d DATASET -b LE -o volume.raw FILE', and give --dims and "
     "--type"},
    {208, "MAP "sv,
     "is MRC: read it as raw data, with --skip 1024 (and its extended header), --dims and --type"},
    {0, "\x89PNG\r\n\x1a\n"sv, kPicture},
    {0, "\xff\xd8\xff"sv, kPicture},
    // The size of the header, in either byte order; NIfTI has a magic number as well.
    {0, "\x5c\x01\0\0"sv, kAnalyze},
    {0, "\0\0\x01\x5c"sv, kAnalyze},
};

bool has_ending(std::string_view text, std::string_view end) {
  return text.size() >= end.size() &&
         starts_with_ignoring_case(text.substr(text.size() - end.size()), end);
}

}  // namespace

void refuse_file(const Bytes& bytes) {
  if (bytes.size() == 0) fail(bytes.name, "is empty");
  for (const Signature& known : kSignatures) {
    if (bytes.size() >= known.offset && bytes.text().substr(known.offset).starts_with(known.bytes))
      fail(bytes.name, known.message);
  }
  if (has_ending(bytes.name, ".raw") || has_ending(bytes.name, ".img"))
    fail(bytes.name, "is read with its header, or as raw data with dimensions and type given");
  if (has_ending(bytes.name, ".hdr")) fail(bytes.name, "is no NIfTI header");
  fail(bytes.name,
       "is in no known format (NRRD, MetaImage, NIfTI, VTK, NumPy, DICOM, TIFF; raw data needs "
       "dimensions and type)");
}

void refuse_zarr(const std::string& path) {
  std::error_code fault;
  for (const char* name : {".zarray", ".zgroup", "zarr.json"}) {
    if (std::filesystem::exists(path + "/" + name, fault)) fail(path, kZarr);
  }
}

void refuse_folder(const std::string& path) {
  refuse_zarr(path);
  std::error_code fault;
  // One name does not justify a walk through a folder of many files.
  int looked_at = 0;
  for (auto entry = std::filesystem::directory_iterator(path, fault);
       !fault && entry != std::filesystem::directory_iterator() && looked_at < 1000;
       entry.increment(fault), ++looked_at) {
    const std::string name = entry->path().filename().string();
    if (has_ending(name, ".png") || has_ending(name, ".jpg")) fail(path, kPictures);
  }
  fail(path,
       "is a folder without slices, of DICOM or TIFF: give the one that holds them, or a file");
}

}  // namespace deliso
