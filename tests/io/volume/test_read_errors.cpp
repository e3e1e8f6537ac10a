// SPDX-License-Identifier: MIT
// What a user reads when a volume cannot be used: one line that names the file and the fault.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cmath>
#include <string>
#include <tuple>

#include "io/volume/read_volume.h"
#include "volume_files.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// Reads `name` in the folder and returns the message without the folder's name; "" if all is well.
std::string fault(const TemporaryFolder& folder, const std::string& name,
                  const ReadOptions& options = {}) {
  try {
    read_volume(folder.path(name), options);
  } catch (const InputError& error) {
    std::string message = error.what();
    CHECK(message.find('\n') == std::string::npos);
    const std::string path = folder.path("");
    for (std::size_t at; (at = message.find(path)) != std::string::npos;)
      message.erase(at, path.size());
    CHECK(message.find(": ") != std::string::npos);
    return message;
  }
  return "";
}
std::string fault_of(const TemporaryFolder& folder, const std::string& name,
                     const std::string& content, const ReadOptions& options = {}) {
  folder.write(name, content);
  return fault(folder, name, options);
}

// A NRRD file of 2 x 3 x 4 samples with one field replaced or added, or with `without` left out.
std::string nrrd_with(const std::string& field, const std::string& value, std::size_t bytes = 24) {
  std::vector<std::pair<std::string, std::string>> fields = {
      {"type", "uchar"}, {"dimension", "3"}, {"sizes", "2 3 4"}, {"encoding", "raw"}};
  bool found = false;
  for (auto& [name, old] : fields)
    if (name == field) {
      old = value;
      found = true;
    }
  if (!found) fields.emplace_back(field, value);
  std::string file = "NRRD0004\n";
  for (const auto& [name, content] : fields)
    if (!content.empty()) file += name + ": " + content + "\n";
  return file + "\n" + std::string(bytes, 'x');
}

void replace(std::string& text, const std::string& old, const std::string& now) {
  const std::size_t at = text.find(old);
  REQUIRE(at != std::string::npos);
  text.replace(at, old.size(), now);
}

Truth small_truth(SampleType type = SampleType::u8) {
  return random_truth(type, {2, 3, 4}, 1);
}

}  // namespace

// A header may name any path. /dev/zero was read until memory was out, a pipe waited for.
TEST_CASE("data files that are devices or pipes are refused") {
  const TemporaryFolder folder;
  REQUIRE(mkfifo(folder.path("pipe").c_str(), 0600) == 0);
  const std::pair<const char*, const char*> others[] = {{"/dev/zero", "is a device"},
                                                        {"pipe", "is no regular file"}};
  for (const auto& [other, fault] : others) {
    const std::string file = other;
    CAPTURE(file);
    CHECK(fault_of(folder, "v.nhdr", nrrd_with("data file", file, 0)).find(fault) !=
          std::string::npos);
    CHECK(fault_of(folder, "v.mhd",
                   "NDims = 3\nDimSize = 2 3 4\nElementType = MET_UCHAR\nElementDataFile = " +
                       file + "\n")
              .find(fault) != std::string::npos);
  }
}

// The image of a NIfTI header is found by its name, and once had a door of its own.
TEST_CASE("an image of NIfTI that is a device or a pipe is refused") {
  const TemporaryFolder folder;
  NiftiForm pair;
  pair.pair = true;
  const std::vector<NamedFile> files = nifti(small_truth(), pair);
  folder.write("v.hdr", files.front().content);
  CHECK(fault(folder, "v.hdr").find("v.img: cannot open") != std::string::npos);
  std::filesystem::create_symlink("/dev/zero", folder.path("v.img"));
  CHECK(fault(folder, "v.hdr").find("is a device") != std::string::npos);
  std::filesystem::remove(folder.path("v.img"));
  REQUIRE(mkfifo(folder.path("v.img").c_str(), 0600) == 0);
  CHECK(fault(folder, "v.hdr").find("is no regular file") != std::string::npos);
}

TEST_CASE("files that are missing, unreadable, empty or no volumes are refused") {
  const TemporaryFolder folder;
  CHECK(fault(folder, "none.nrrd") == "none.nrrd: cannot open: No such file or directory");
  std::filesystem::create_directories(folder.path("folder"));
  CHECK(fault(folder, "folder") ==
        "folder: is a folder without slices, of DICOM or TIFF: give the one that holds them, or a "
        "file");
  CHECK(fault_of(folder, "v.nrrd", "") == "v.nrrd: is empty");
  const std::string unknown =
      ": is in no known format (NRRD, MetaImage, NIfTI, VTK, NumPy, DICOM, TIFF; raw data needs "
      "dimensions and "
      "type)";
  CHECK(fault_of(folder, "v.txt", "some text\n") == "v.txt" + unknown);
  CHECK(fault_of(folder, "v.nii", std::string(1000, '\0')) == "v.nii" + unknown);
  CHECK(fault_of(folder, "v.raw", "abc") ==
        "v.raw: is read with its header, or as raw data with dimensions and type given");
  CHECK(fault_of(folder, "v.hdr", std::string(348, 'x')) == "v.hdr: is no NIfTI header");
  CHECK(fault_of(folder, "a\nb.nrrd", "x").starts_with("a?b.nrrd: is in no known format"));
}

TEST_CASE("sizes that do not fit the data are refused") {
  const TemporaryFolder folder;
  CHECK(fault_of(folder, "v.nrrd", nrrd_with("", "", 23)) ==
        "v.nrrd: data is too short: 2 x 3 x 4 uint8 samples need 24 bytes, found 23");
  CHECK(fault_of(folder, "v.nrrd", nrrd_with("", "", 25)) ==
        "v.nrrd: data is too long: 2 x 3 x 4 uint8 samples need 24 bytes, found 25");
  CHECK(fault_of(folder, "v.nrrd", nrrd_with("sizes", "200 300 400")) ==
        "v.nrrd: data is too short: 200 x 300 x 400 uint8 samples need 24000000 bytes, found 24");
  CHECK(fault_of(folder, "v.nrrd", nrrd_with("sizes", "2 3 0")) ==
        "v.nrrd: 0 samples along z: dimensions must be positive");
  CHECK(fault_of(folder, "v.nrrd", nrrd_with("sizes", "2 -3 4")) ==
        "v.nrrd: -3 samples along y: dimensions must be positive");
  CHECK(fault_of(folder, "v.nrrd", nrrd_with("sizes", "1 6 4")) ==
        "v.nrrd: 1 samples along x: a volume needs two or more along each axis");
  CHECK(fault_of(folder, "v.nrrd", nrrd_with("sizes", "2147483647 2147483647 2147483647")) ==
        "v.nrrd: 2147483647 x 2147483647 x 2147483647 uint8 samples are too many");
  CHECK(fault_of(folder, "v.nrrd", nrrd_with("sizes", "4294967298 3 4")) ==
        "v.nrrd: 4294967298 samples along x are too many");
  CHECK(fault_of(folder, "v.nrrd", nrrd_with("sizes", "2 3 99999999999999999999")) ==
        "v.nrrd: field 'sizes' is '2 3 99999999999999999999': not a list of integers");
  CHECK(fault_of(folder, "v.nrrd", nrrd_with("encoding", "gzip")) ==
        "v.nrrd: compressed data is damaged: no gzip header after 0 of 24 bytes");
  // Sizes that the compressed data cannot possibly hold take no memory.
  const std::string header = "NRRD0004\ntype: uchar\ndimension: 3\nencoding: gzip\nsizes: ";
  CHECK(fault_of(folder, "v.nrrd", header + "100000 100000 100000\n\n" + gzipped("abc"))
            .find("need 1000000000000000 bytes, found") != std::string::npos);
  CHECK(fault_of(folder, "v.nrrd", header + "2 3 4\n\n" + gzipped(std::string(20, 'x'))) ==
        "v.nrrd: data is too short: 2 x 3 x 4 uint8 samples need 24 bytes, found 20");
  CHECK(
      fault_of(folder, "v.nrrd", header + "2 3 4\n\n" + gzipped(std::string(25, 'x'))) ==
      "v.nrrd: data is too long: 2 x 3 x 4 uint8 samples need 24 bytes, the compressed data holds "
      "more");
}

TEST_CASE("each fault of numbers in text has its message") {
  const TemporaryFolder folder;
  const std::string header =
      "NRRD0004\ntype: uchar\ndimension: 3\nencoding: ascii\nsizes: 2 2 2\n\n";
  CHECK(fault_of(folder, "v.nrrd", header + "1 2 3 4 5 6 7 +8\n") == "");
  CHECK(fault_of(folder, "v.nrrd", header + "1 2 3 4 5 6 7           ") ==
        "v.nrrd: data is too short: 2 x 2 x 2 uint8 samples need 8 numbers, found 7");
  CHECK(fault_of(folder, "v.nrrd", header + "1 2 3") ==
        "v.nrrd: data is too short: 2 x 2 x 2 uint8 samples do not fit in 5 characters");
  CHECK(fault_of(folder, "v.nrrd", header + "1 2 3 4 5 6 7 8 9") ==
        "v.nrrd: data is too long: more than the 8 numbers of 2 x 2 x 2 uint8 samples");
  CHECK(fault_of(folder, "v.nrrd", header + "1 2 3 4 5 6 7 256") ==
        "v.nrrd: sample 7 is '256', not a number of type uint8");
  CHECK(fault_of(folder, "v.nrrd", header + "1 2 x3 4 5 6 7 8") ==
        "v.nrrd: sample 2 is 'x3', not a number of type uint8");
}

TEST_CASE("each fault of an NRRD header has its message") {
  const TemporaryFolder folder;
  const auto with = [&](const std::string& field, const std::string& value) {
    return fault_of(folder, "v.nrrd", nrrd_with(field, value));
  };
  CHECK(with("", "") == "");
  CHECK(with("type", "") == "v.nrrd: the header has no field 'type'");
  CHECK(with("sizes", "") == "v.nrrd: the header has no field 'sizes'");
  CHECK(with("encoding", "") == "v.nrrd: the header has no field 'encoding'");
  CHECK(with("dimension", "") == "v.nrrd: the header has no field 'dimension'");
  CHECK(with("type", "short") == "v.nrrd: the header has no field 'endian'");
  CHECK(with("type", "int64") ==
        "v.nrrd: sample type 'int64' is not supported (integers of up to 32 bits, float32, float64 "
        "are)");
  CHECK(with("type", "block").starts_with("v.nrrd: sample type 'block' is not supported"));
  CHECK(with("encoding", "bzip2") ==
        "v.nrrd: field 'encoding' is 'bzip2': only raw, gzip and ascii are supported");
  CHECK(with("encoding", "hex") ==
        "v.nrrd: field 'encoding' is 'hex': only raw, gzip and ascii are supported");
  CHECK(with("dimension", "4") ==
        "v.nrrd: field 'sizes' is '2 3 4': not 4 numbers as 'dimension' says");
  CHECK(with("sizes", "2 3 x") == "v.nrrd: field 'sizes' is '2 3 x': not a list of integers");
  CHECK(with("spacings", "1 1 0") == "v.nrrd: spacing along z is not positive");
  CHECK(with("spacings", "1 -1 1") == "v.nrrd: spacing along y is not positive");
  CHECK(with("spacings", "nan 1 1") == "v.nrrd: spacing along x is not positive");
  CHECK(with("spacings", "1 inf 1")
            .starts_with("v.nrrd: spacing inf along y is out of range (from 1e-20, "));
  CHECK(with("spacings", "1 1e40 1")
            .starts_with("v.nrrd: spacing 1e+40 along y is out of range (from 1e-20, "));
  CHECK(with("spacings", "1 1e-40 1")
            .starts_with("v.nrrd: spacing 1e-40 along y is out of range (from 1e-20, "));
  CHECK(with("spacings", "1 1") == "v.nrrd: field 'spacings' is '1 1': not 3 numbers");
  CHECK(with("space directions", "(1,0,0) (0,1,0)") ==
        "v.nrrd: field 'spacedirections' is '(1,0,0) (0,1,0)': not 3 vectors of three numbers");
  CHECK(with("space directions", "(1,0,0) (0,1,0) none") ==
        "v.nrrd: field 'spacedirections' is '(1,0,0) (0,1,0) none': an axis is not spatial");
  CHECK(with("space directions", "(1,0,0) (0,1,0) (0,0)").find("not 3 vectors") !=
        std::string::npos);
  CHECK(with("space directions", "(1,0,0) (0,1,0) (0,0,0)") ==
        "v.nrrd: spacing along z is not positive");
  CHECK(with("space directions", "(1,0,0) (1,1,0) (0,0,1)") ==
        "v.nrrd: sheared grid: its axes x and y enclose 45.000000 degrees; only rectangular grids "
        "can be "
        "meshed (resample it)");
  CHECK(with("space directions", "(1,0,0) (0,1,0) (0,0.00009,1)") == "");
  CHECK(with("space directions", "(1,0,0) (0,1,0) (0,0.00011,1)").find("y and z") !=
        std::string::npos);
  CHECK(with("data file", "none.raw") ==
        "v.nrrd: its data file none.raw: cannot open: No such file or directory");
  CHECK(with("data file", "slice%03d.raw 1 10 1").find("several files is not supported") !=
        std::string::npos);
  CHECK(fault_of(folder, "v.nhdr",
                 "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 3 4\nencoding: raw\n"
                 "data file: LIST\na.raw\nb.raw\n") ==
        "v.nhdr: field 'datafile' is 'LIST': data spread over several files is not supported");
  CHECK(with("line skip", "-1") == "v.nrrd: field 'lineskip' is '-1': negative");
  CHECK(with("line skip", "9") == "v.nrrd: has fewer than 9 lines to skip");
  CHECK(with("byte skip", "-2") == "v.nrrd: field 'byteskip' is '-2': cannot be followed");
  CHECK(with("byte skip", "25") == "v.nrrd: has 24 bytes, fewer than the 25 to skip");
  CHECK(with("byte skip", "x") == "v.nrrd: field 'byteskip' is 'x': not an integer");
  CHECK(fault_of(folder, "v.nrrd", "NRRD0004\nwhat is this\n\n") ==
        "v.nrrd: header line 'what is this' is no 'field: value'");
  std::string four = nrrd_with("dimension", "4");
  replace(four, "sizes: 2 3 4", "sizes: 3 2 2 2");
  CHECK(fault_of(folder, "v.nrrd", four) ==
        "v.nrrd: sizes '3 2 2 2' are 4-dimensional: only three-dimensional scalar volumes can be "
        "meshed");
}

TEST_CASE("each fault of a MetaImage header has its message") {
  const TemporaryFolder folder;
  const std::string good =
      metaimage(small_truth(SampleType::i16), std::endian::little, "raw", MetaForm::local)[0]
          .content;
  const auto with = [&](const std::string& old, const std::string& now) {
    std::string file = good;
    replace(file, old, now);
    return fault_of(folder, "v.mha", file);
  };
  CHECK(with("NDims", "NDims") == "");
  CHECK(with("NDims = 3\n", "") == "v.mha: the header has no key 'NDims'");
  CHECK(with("DimSize = 2 3 4\n", "") == "v.mha: the header has no key 'DimSize'");
  CHECK(with("MET_SHORT", "MET_LONG_LONG")
            .starts_with("v.mha: sample type 'MET_LONG_LONG' is not supported"));
  CHECK(with("NDims = 3", "NDims = 2") ==
        "v.mha: key 'DimSize' is '2 3 4': not 2 integers as NDims says");
  CHECK(with("DimSize = 2 3 4", "DimSize = 2 3 5") ==
        "v.mha: data is too short: 2 x 3 x 5 int16 samples need 60 bytes, found 48");
  CHECK(with("NDims = 3", "ElementNumberOfChannels = 3\nNDims = 3") ==
        "v.mha: key 'ElementNumberOfChannels' is '3': only scalar volumes can be meshed");
  CHECK(with("ElementSpacing = 1 1 1", "ElementSpacing = 1 0 1") ==
        "v.mha: spacing along y is not positive");
  CHECK(with("ElementSpacing = 1 1 1", "ElementSpacing = 1 1") ==
        "v.mha: key 'ElementSpacing' is '1 1': not 3 numbers");
  CHECK(with("1 0 0 0 1 0 0 0 1", "1 0 0 0.5 1 0 0 0 1").find("sheared grid: its axes x and y") !=
        std::string::npos);
  CHECK(with("CompressedData = False", "CompressedData = True") ==
        "v.mha: compressed data is damaged: no zlib header after 0 of 48 bytes");
  CHECK(with("LOCAL", "LIST").find("several files is not supported") != std::string::npos);
  CHECK(with("LOCAL", "gone.raw") ==
        "v.mha: its data file gone.raw: cannot open: No such file or directory");
  CHECK(with("NDims = 3", "HeaderSize = 9999\nNDims = 3") ==
        "v.mha: has 48 bytes, fewer than the 9999 of its header");
  CHECK(fault_of(folder, "v.mha", "ObjectType = Image\nnonsense\n") ==
        "v.mha: header line 'nonsense' is no 'Key = Value'");
  std::string four = good;
  replace(four, "NDims = 3", "NDims = 4");
  replace(four, "DimSize = 2 3 4", "DimSize = 2 3 2 2");
  CHECK(fault_of(folder, "v.mha", four).find("only three-dimensional volumes") !=
        std::string::npos);
}

TEST_CASE("each fault of a NIfTI header has its message") {
  const TemporaryFolder folder;
  const auto with = [&](std::size_t at, std::uint64_t value, int bytes) {
    std::string file = nifti(small_truth(SampleType::i16), {})[0].content;
    const std::string field = little(value, bytes);
    std::copy(field.begin(), field.end(), file.begin() + static_cast<std::ptrdiff_t>(at));
    return fault_of(folder, "v.nii", file);
  };
  const auto real = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  CHECK(with(0, 348, 4) == "");
  CHECK(with(70, 1024, 2) ==
        "v.nii: NIfTI datatype 1024 is not supported (integers of up to 32 bits, float32, float64 "
        "are)");
  CHECK(with(40, 2, 2) == "v.nii: has 2 dimensions: only three-dimensional volumes can be meshed");
  CHECK(with(40, 0xffff, 2) ==
        "v.nii: has -1 dimensions: only three-dimensional volumes can be meshed");
  CHECK(with(48, 5, 2) ==
        "v.nii: dimension 4 has size 5: only one scalar volume without time steps can be meshed");
  CHECK(with(42, 0, 2) == "v.nii: 0 samples along x: dimensions must be positive");
  CHECK(with(46, 0x7fff, 2) ==
        "v.nii: data is too short: 2 x 3 x 32767 int16 samples need 393204 bytes, found 48");
  CHECK(with(108, real(100), 4) == "v.nii: vox_offset 100.000000 is not valid");
  CHECK(with(108, real(NAN), 4).starts_with("v.nii: vox_offset"));
  CHECK(with(108, real(1e6f), 4) == "v.nii: has 416 bytes, its samples begin at 1000000");
  CHECK(with(280, real(0), 4) == "v.nii: spacing along x is not positive");
  CHECK(with(284, real(1), 4).find("sheared grid") != std::string::npos);
  CHECK(with(292, real(NAN), 4) == "v.nii: its origin is further than 1e+30 away");
  CHECK(fault_of(folder, "v.nii.gz", gzipped("no header at all")) ==
        "v.nii.gz: is compressed, but holds no NIfTI header");
  std::string file = nifti(small_truth(), {})[0].content;
  CHECK(fault_of(folder, "v.nii.gz", gzipped(file.substr(0, 380))) ==
        "v.nii.gz: data is too short: 2 x 3 x 4 uint8 samples need 24 bytes, found 12");
  std::string damaged = gzipped(file);
  damaged[damaged.size() - 5] ^= 1;
  CHECK(fault_of(folder, "v.nii.gz", damaged) ==
        "v.nii.gz: compressed data is damaged: a wrong checksum");
  NiftiForm pair;
  pair.pair = true;
  CHECK(fault_of(folder, "v.hdr", nifti(small_truth(), pair)[0].content).find("its data file") !=
        std::string::npos);
}

TEST_CASE("each fault of a VTK file has its message") {
  const TemporaryFolder folder;
  const auto legacy = [&](const std::string& old, const std::string& now) {
    std::string file = vtk(small_truth(), true, false)[0].content;
    replace(file, old, now);
    return fault_of(folder, "v.vtk", file);
  };
  CHECK(legacy("BINARY", "BINARY") == "");
  CHECK(legacy("BINARY", "BOTH") == "v.vtk: is neither ASCII nor BINARY but 'both'");
  CHECK(
      legacy("STRUCTURED_POINTS", "UNSTRUCTURED_GRID") ==
      "v.vtk: holds a data set of kind 'unstructured_grid': only STRUCTURED_POINTS can be meshed");
  CHECK(legacy("DIMENSIONS 2 3 4", "DIMENSIONS 2 3 5") ==
        "v.vtk: POINT_DATA is 24, but DIMENSIONS give 30 points");
  CHECK(legacy("DIMENSIONS 2 3 4", "DIMENSIONS 2 3 four") ==
        "v.vtk: DIMENSIONS is 'four', not an integer");
  CHECK(legacy("SPACING 1 1 1", "SPACING 1 -1 1") == "v.vtk: spacing along y is not positive");
  CHECK(legacy("POINT_DATA", "CELL_DATA") == "v.vtk: ends before the samples");
  CHECK(legacy("SCALARS", "SCALES") == "v.vtk: keyword 'scales' is not supported");
  CHECK(legacy("unsigned_char 1", "unsigned_char 3") ==
        "v.vtk: array 'values' has 3 components per point: only scalar volumes can be meshed");
  CHECK(legacy("unsigned_char", "bit").starts_with("v.vtk: sample type 'bit' is not supported"));
  CHECK(legacy("SCALARS", "VECTORS") ==
        "v.vtk: array 'values' has 3 components per point: only scalar volumes can be meshed");
  CHECK(legacy("LOOKUP_TABLE", "LOOKUP") == "v.vtk: has 'lookup' where 'lookup_table' is expected");
  CHECK(fault_of(folder, "v.vtk", vtk(small_truth(), true, false)[0].content.substr(0, 100)) ==
        "v.vtk: ends before the samples");

  const auto xml = [&](const VtkForm& form, const std::string& old, const std::string& now) {
    std::string file = vti(small_truth(SampleType::i16), form)[0].content;
    replace(file, old, now);
    return fault_of(folder, "v.vti", file);
  };
  const VtkForm raw, binary{"binary", "", std::endian::little, 4, 0},
      blocks{"appended", "raw", std::endian::little, 4, 20};
  CHECK(xml(raw, "VTKFile", "VTKFile") == "");
  CHECK(xml(raw, "\"ImageData\"", "\"PolyData\"") ==
        "v.vti: is a VTK file of type 'PolyData': only ImageData can be meshed");
  CHECK(xml(blocks, "vtkZLibDataCompressor", "vtkLZ4DataCompressor") ==
        "v.vti: compressor 'vtkLZ4DataCompressor' is not supported (vtkZLibDataCompressor is)");
  CHECK(xml(raw, "\"Int16\"", "\"Int64\"")
            .starts_with("v.vti: sample type 'Int64' is not supported"));
  CHECK(xml(raw, "\"values\"", "\"other\"") ==
        "v.vti: array 'other' has 3 components per point: only scalar volumes can be meshed");
  CHECK(xml(raw, "Extent=\"2 3 -1 1 0 3\"", "Extent=\"2 3 -1 1\"") ==
        "v.vti: WholeExtent is '2 3 -1 1', not six integers");
  CHECK(xml(raw, "</Piece>", "</Piece><Piece Extent=\"2 3 -1 1 4 6\">") ==
        "v.vti: has several pieces: only one is supported");
  CHECK(xml(raw, "offset=\"4\"", "offset=\"x\"") == "v.vti: attribute offset is 'x'");
  CHECK(xml(raw, "offset=\"4\"", "offset=\"4000\"") ==
        "v.vti: ends before its array at offset 4000");
  CHECK(xml(raw, "offset=\"4\"", "offset=\"5\"")
            .find("2 x 3 x 4 int16 samples need 48 bytes, the array holds") != std::string::npos);
  CHECK(xml(raw, "<AppendedData", "<Nothing") == "v.vti: has no AppendedData");
  CHECK(xml(raw, "   _", "   -") == "v.vti: has no '_' before its appended data");
  CHECK(xml(raw, "encoding=\"raw\"", "encoding=\"hex\"") ==
        "v.vti: encoding 'hex' is not supported");
  CHECK(xml(raw, "format=\"appended\"", "format=\"none\"") ==
        "v.vti: a DataArray has format 'none': only ascii, binary and appended are supported");
  CHECK(xml(raw, "PointData", "Points") == "v.vti: has no array of point data");
  CHECK(xml(binary, "MAAA", "MQAA") ==
        "v.vti: 2 x 3 x 4 int16 samples need 48 bytes, the array holds 49");
  CHECK(xml(raw, "Direction=\"1 0 0", "Direction=\"1 0 0.3").find("sheared grid") !=
        std::string::npos);
  CHECK(xml(blocks, std::string("\x03\0\0\0\x14\0\0\0\x08", 9),
            std::string("\x03\0\0\0\x14\0\0\0\x09", 9))
            .find("3 blocks of 20 bytes and a rest of 9 do not give that") != std::string::npos);
  CHECK(xml(blocks, std::string("\x03\0\0\0\x14", 5), std::string("\xff\xff\xff\xff\x14", 5)) ==
        "v.vti: ends before 2 x 3 x 4 int16 samples");
}

TEST_CASE("foreign formats are named, with a way to convert them") {
  const TemporaryFolder folder;
  const std::string nothing(400, '\0');
  const auto at = [&](std::size_t offset, const std::string& magic) {
    std::string file = nothing;
    return file.replace(offset, magic.size(), magic);
  };
  const std::tuple<std::string, std::string, std::string> files[] = {
      {"slice", nothing.substr(0, 128) + "DICM", "is DICOM without an image"},
      {"a.h5", at(0, "\x89HDF\r\n\x1a\n"), "is HDF5: make it raw with 'h5dump"},
      {"a.mrc", at(208, "MAP "), "is MRC: "},
      {"a.png", at(0, "\x89PNG\r\n\x1a\n"), "is a picture: "},
      {"a.jpg", at(0, "\xff\xd8\xff\xe0"), "is a picture: "},
      {"a.hdr", at(0, std::string("\x5c\x01\0\0", 4)), "is ANALYZE 7.5: "},
      {"a.hdr", at(0, std::string("\0\0\x01\x5c", 4)), "is ANALYZE 7.5: "}};
  for (const auto& [name, content, message] : files) {
    CHECK(fault_of(folder, name, content).find(message) != std::string::npos);
  }
  const std::pair<std::string, std::string> folders[] = {
      {".zarray", "is Zarr: "},
      {"zarr.json", "is Zarr: "},
      {"IM1.DCM", "is a folder without slices, "},
      {"0001.png", "is a folder of pictures: make one raw file"}};
  for (const auto& [file, message] : folders) {
    const TemporaryFolder slices;
    slices.write(file, "");
    CHECK(fault(slices, "").find(message) != std::string::npos);
  }
}

TEST_CASE("axes and origins that are no numbers, or too large, are refused in every format") {
  const TemporaryFolder folder;
  int refused = 0;
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300, 1e31}) {
    for (const int part : {0, 1, 2}) {
      Truth truth = small_truth();
      if (part == 0) truth.axes[1].y = bad;
      if (part == 1) truth.axes[0].z = bad;
      if (part == 2) truth.origin.y = bad;
      for (const StoredVolume& stored : all_forms(truth)) {
        if (!stored.has_axes && (part != 2 || stored.options.raw || stored.options.spacing))
          continue;
        if (stored.label.ends_with("qform") && part != 2) continue;  // no rotation
        CAPTURE(stored.label);
        CAPTURE(bad);
        CAPTURE(part);
        for (const char* old : {"v.img", "v.img.gz"}) std::filesystem::remove(folder.path(old));
        for (const NamedFile& file : stored.files) folder.write(file.name, file.content);
        CHECK(fault(folder, stored.files[0].name) != "");
        ++refused;
      }
    }
  }
  CHECK(refused > 500);
  NiftiForm form;
  form.placement = NiftiForm::Placement::qform;
  for (const float bad : {std::nanf(""), HUGE_VALF, -HUGE_VALF, 1e38f}) {
    std::string file = nifti(small_truth(), form)[0].content;
    file.replace(256 + 4, 4, little(std::bit_cast<std::uint32_t>(bad), 4));
    // A quaternion that is too large is made a unit one, as NIfTI's own code does.
    CHECK((fault_of(folder, "v.nii", file) != "") == !std::isfinite(bad));
  }
}

// The fault was blamed on the data file, which the user had not named.
TEST_CASE("a region beyond the grid is a fault of the file that was named") {
  const TemporaryFolder folder;
  ReadOptions options;
  options.roi = Roi{{0, 0, 0}, {3, 3, 4}};
  const std::string message = ": region 0:3 along x is not two or more of the samples 0:2";
  for (const StoredVolume& stored : all_forms(small_truth())) {
    if (stored.label.starts_with("raw")) continue;
    for (const char* old : {"v.img", "v.img.gz"}) std::filesystem::remove(folder.path(old));
    for (const NamedFile& file : stored.files) folder.write(file.name, file.content);
    CHECK(fault(folder, stored.files[0].name, options) == stored.files[0].name + message);
  }
}

TEST_CASE("raw data and regions") {
  const TemporaryFolder folder;
  ReadOptions options;
  options.raw = RawLayout{{2, 3, 4}};
  const auto read = [&](std::size_t bytes) {
    return fault_of(folder, "v.raw", std::string(bytes, 'x'), options);
  };
  CHECK(read(24) == "");
  CHECK(read(23) == "v.raw: data is too short: 2 x 3 x 4 uint8 samples need 24 bytes, found 23");
  CHECK(read(25) == "v.raw: data is too long: 2 x 3 x 4 uint8 samples need 24 bytes, found 25");
  options.raw->type = SampleType::f64;
  CHECK(read(24) == "v.raw: data is too short: 2 x 3 x 4 float64 samples need 192 bytes, found 24");
  options.raw->type = SampleType::u8;
  options.raw->skip = 30;
  CHECK(read(24) == "v.raw: has 24 bytes, fewer than the 30 to skip");
  options.raw->skip = 1;
  CHECK(read(25) == "");
  options.raw->spacing = {1, 1, -2};
  CHECK(read(25) == "v.raw: spacing along z is not positive");
  options.raw->spacing = {1, 1, 1};
  options.raw->dims = {0, 3, 4};
  CHECK(read(25) == "v.raw: 0 samples along x: dimensions must be positive");
  options.raw->dims = {2, 3, 4};
  for (const Roi& roi : {Roi{{0, 0, 0}, {3, 3, 4}}, Roi{{-1, 0, 0}, {2, 3, 4}},
                         Roi{{0, 0, 0}, {1, 3, 4}}, Roi{{1, 0, 0}, {0, 3, 4}}}) {
    options.roi = roi;
    CHECK(read(25).find("along x is not two or more of the samples 0:2") != std::string::npos);
  }
  options.roi = Roi{{0, 0, 0}, {2, 3, 3}};
  CHECK(read(25) == "");
}

TEST_CASE("an input that is no regular file is read to its end") {
  const TemporaryFolder folder;
  ReadOptions options;
  options.raw = RawLayout{{2, 3, 4}};
  CHECK(fault(folder, "pipe", options).find("No such file") != std::string::npos);
  CHECK_THROWS_WITH_AS(read_volume("/dev/null", options), "/dev/null: is a device, not a file",
                       InputError);
}
