// SPDX-License-Identifier: MIT
#include "io/volume/foreign_formats.h"

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/text.h"
#include "io/files/text_scan.h"

namespace deliso {
namespace {

using namespace std::string_view_literals;

constexpr const char* kByConvert =
    ": make one raw file of the slices with 'convert SLICES -depth 8 gray:volume.raw', and give "
    "--dims and --type";
constexpr const char* kUnpack = "is compressed: unpack it with '";
constexpr const char* kByNibabel =
    R"(: convert it with python3 -c "import nibabel; nibabel.save(nibabel.load('FILE'), )"
    "'volume.nii')\"";
constexpr const char* kZarrArray =
    R"(is Zarr: write the array with python3 -c "import numpy, zarr; numpy.save('volume.npy', )"
    "zarr.open('FOLDER', mode='r')[:])\"";
// OME-Zarr, for the most part.
constexpr const char* kZarrGroup =
    R"(is a group of Zarr arrays: write one, as here time 0 and channel 0 of OME-Zarr's largest, )"
    R"(with python3 -c "import numpy, zarr; numpy.save('volume.npy', )"
    "zarr.open('FOLDER', mode='r')['0'][0, 0])\"";

struct Signature {
  std::string_view bytes, message, rest = {};
};
constexpr Signature kSignatures[] = {
    {"\x89HDF\r\n\x1a\n"sv,
     R"(is HDF5: 'h5ls -r FILE' lists its arrays; write one with python3 -c "import h5py, numpy; )",
     "numpy.save('volume.npy', h5py.File('FILE')['ARRAY'])\""},
    {"\x89PNG\r\n\x1a\n"sv, "is a picture", kByConvert},
    {"\xff\xd8\xff"sv, "is a picture", kByConvert},
    {"\x1f\x8b"sv, "is compressed, but holds no header of NIfTI, MRC or INRIMAGE: unpack it with '",
     "gunzip FILE'"},
    {"BZh"sv, kUnpack, "bunzip2 FILE'"},
    {"\xfd\x37zXZ"sv, kUnpack, "unxz FILE'"},
    {"\x28\xb5\x2f\xfd"sv, kUnpack, "unzstd FILE'"},
    {"PK\3\4"sv, "is a zip archive, as NumPy's .npz is: unpack it with 'unzip FILE'"},
    // The size of the header, in either byte order; NIfTI has a magic number as well.
    {"\x5c\x01\0\0"sv, "is ANALYZE 7.5", kByNibabel},
    {"\0\0\x01\x5c"sv, "is ANALYZE 7.5", kByNibabel},
};

// Refuses formats whose first bytes are those of others: MINC is HDF5, too.
void refuse_name(const std::string& name) {
  constexpr std::pair<std::string_view, const char*> kEndings[] = {
      {".mgz", "MGH"},   {".mgh", "MGH"},     {".mnc", "MINC"},    {".head", "AFNI"},
      {".brik", "AFNI"}, {".par", "PAR/REC"}, {".rec", "PAR/REC"}, {".brik.gz", "AFNI"}};
  for (const auto& [ending, format] : kEndings) {
    if (lower(name).ends_with(ending)) fail(name, "is ", format, kByNibabel);
  }
}

}  // namespace

void refuse_file(const Bytes& bytes) {
  if (bytes.size() == 0) fail(bytes.name, "is empty");
  refuse_name(bytes.name);
  for (const Signature& known : kSignatures) {
    if (bytes.text().starts_with(known.bytes)) fail(bytes.name, known.message, known.rest);
  }
  if (lower(bytes.name).ends_with(".raw") || lower(bytes.name).ends_with(".img"))
    fail(bytes.name, "is read with its header, or as raw data with dimensions and type given");
  if (lower(bytes.name).ends_with(".hdr")) fail(bytes.name, "is no NIfTI header");
  fail(bytes.name,
       "is in no known format (NRRD, MetaImage, NIfTI, MRC, INRIMAGE, VTK, NumPy, DICOM, TIFF; raw "
       "data needs dimensions and type)");
}

std::string conversion_by_vtk(std::string_view reader, std::string_view filter) {
  const std::string f =
      filter.empty() ? "r" : text("vtk.", filter, "; f.SetInputConnection(r.GetOutputPort())");
  return text("convert it with python3 -c \"import vtk; r = vtk.", reader,
              "(); r.SetFileName('FILE'); f = ", f,
              "; w = vtk.vtkXMLImageDataWriter(); w.SetInputConnection(f.GetOutputPort()); "
              "w.SetFileName('volume.vti'); w.Write()\"");
}

void refuse_cells(const std::string& name, std::string_view reader) {
  fail(name,
       "has data of cells, not of points: ", conversion_by_vtk(reader, "vtkCellDataToPointData()"));
}

void refuse_zarr(const std::string& path) {
  std::error_code fault;
  const auto has = [&](const char* name) {
    return std::filesystem::exists(path + "/" + name, fault);
  };
  const bool is_new = has("zarr.json");
  const bool is_group =
      is_new && open_file(path + "/zarr.json").text().find("\"group\"") != std::string_view::npos;
  if (has(".zgroup") || is_group) fail(path, kZarrGroup);
  if (has(".zarray") || is_new) fail(path, kZarrArray);
}

void refuse_folder(const std::string& path, const std::string& also) {
  refuse_zarr(path);
  std::error_code fault;
  // One name does not justify a walk through a folder of many files.
  int looked_at = 0;
  for (auto entry = std::filesystem::directory_iterator(path, fault);
       !fault && entry != std::filesystem::directory_iterator() && looked_at < 1000;
       entry.increment(fault), ++looked_at) {
    const std::string name = entry->path().filename().string();
    if (lower(name).ends_with(".png") || lower(name).ends_with(".jpg"))
      fail(path, "is a folder of pictures", kByConvert);
  }
  fail(path,
       "is a folder without slices, of DICOM or TIFF: give the one that holds them, or a file",
       also);
}

}  // namespace deliso
