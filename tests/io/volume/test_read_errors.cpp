// SPDX-License-Identifier: MIT
// Faults of volumes that an edit of a sound file cannot show: test_faults.cpp has those.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cmath>
#include <string>
#include <tuple>

#include "io/volume/read_fault.h"
#include "io/volume/read_volume.h"
#include "io/volume/volume_files.h"

using namespace deliso;
using namespace deliso::test;

namespace {

std::string fault_of(const TemporaryFolder& folder, const std::string& name,
                     const std::string& content, const ReadOptions& options = {}) {
  return read_message(folder.write(name, content), options);
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
    CHECK(fault_of(folder, "v.nhdr",
                   "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 3 4\nencoding: raw\ndata file: " +
                       file + "\n\n")
              .find(fault) != std::string::npos);
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
  CHECK(read_message(folder.path("v.hdr")).find("v.img: cannot open") != std::string::npos);
  std::filesystem::create_symlink("/dev/zero", folder.path("v.img"));
  CHECK(read_message(folder.path("v.hdr")).find("is a device") != std::string::npos);
  std::filesystem::remove(folder.path("v.img"));
  REQUIRE(mkfifo(folder.path("v.img").c_str(), 0600) == 0);
  CHECK(read_message(folder.path("v.hdr")).find("is no regular file") != std::string::npos);
}

TEST_CASE("files that are missing, unreadable, empty or no volumes are refused") {
  const TemporaryFolder folder;
  CHECK(read_message(folder.path("none.nrrd")) ==
        "none.nrrd: cannot open: No such file or directory");
  std::filesystem::create_directories(folder.path("folder"));
  CHECK(read_message(folder.path("folder")) ==
        "folder: is a folder without slices, of DICOM or TIFF: give the one that holds them, or a "
        "file");
  const std::string unknown =
      ": is in no known format (NRRD, MetaImage, NIfTI, MRC, INRIMAGE, VTK, NumPy, DICOM, TIFF; "
      "raw data "
      "needs "
      "dimensions and "
      "type)";
  CHECK(fault_of(folder, "v.nii", std::string(1000, '\0')) == "v.nii" + unknown);
  CHECK(fault_of(folder, "v.raw", "abc") ==
        "v.raw: is read with its header, or as raw data with dimensions and type given");
  CHECK(fault_of(folder, "v.hdr", std::string(348, 'x')) == "v.hdr: is no NIfTI header");
  CHECK(fault_of(folder, "a\nb.nrrd", "x").starts_with("a?b.nrrd: is in no known format"));
}

TEST_CASE("each fault of compressed data has its message") {
  const TemporaryFolder folder;
  const std::string header = "NRRD0004\ntype: uchar\ndimension: 3\nencoding: gzip\nsizes: ";
  const auto with = [&](const std::string& sizes, const std::string& data) {
    return fault_of(folder, "v.nrrd", header + sizes + "\n\n" + gzipped(data));
  };
  // Sizes that the compressed data cannot possibly hold take no memory.
  CHECK(with("100000 100000 100000", "abc").find("need 1000000000000000 bytes, found") !=
        std::string::npos);
  CHECK(with("2 3 4", std::string(20, 'x')) ==
        "v.nrrd: data is too short: 2 x 3 x 4 uint8 samples need 24 bytes, found 20");
  CHECK(
      with("2 3 4", std::string(25, 'x')) ==
      "v.nrrd: data is too long: 2 x 3 x 4 uint8 samples need 24 bytes, the compressed data holds "
      "more");
  CHECK(fault_of(folder, "v.nii.gz", gzipped("no header at all")) ==
        "v.nii.gz: is compressed, but holds no header of NIfTI, MRC or INRIMAGE: unpack it with "
        "'gunzip "
        "FILE'");
  const std::string file = nifti(small_truth(), {})[0].content;
  CHECK(fault_of(folder, "v.nii.gz", gzipped(file.substr(0, 380))) ==
        "v.nii.gz: data is too short: 2 x 3 x 4 uint8 samples need 24 bytes, found 12");
  std::string damaged = gzipped(file);
  damaged[damaged.size() - 5] ^= 1;
  CHECK(fault_of(folder, "v.nii.gz", damaged) ==
        "v.nii.gz: compressed data is damaged: a wrong checksum");
}

TEST_CASE("foreign formats are named, with a way to convert them") {
  const TemporaryFolder folder;
  const std::string nothing(400, '\0');
  const auto at = [&](std::size_t offset, const std::string& magic) {
    std::string file = nothing;
    return file.replace(offset, magic.size(), magic);
  };
  const std::tuple<std::string, std::string, std::string> files[] = {
      {"slice", nothing.substr(0, 128) + "DICM",
       "is DICOM without an image; contours (RTSTRUCT) become a segmentation in 3D Slicer"},
      {"a.h5", at(0, "\x89HDF\r\n\x1a\n"), "is HDF5: 'h5ls -r FILE' lists"},
      {"a.mnc", at(0, "\x89HDF\r\n\x1a\n"), "is MINC: convert it with python3 -c"},
      {"a.mgh", at(3, "\x1"), "is MGH: convert it with python3 -c"},
      {"a.mgz", gzipped(at(3, "\x1")), "is MGH: convert it with python3 -c"},
      {"a.nii.bz2", at(0, "BZh91AY&SY"), "is compressed: unpack it with 'bunzip2 FILE'"},
      {"a.nii.xz", at(0, "\xfd\x37zXZ"), "is compressed: unpack it with 'unxz FILE'"},
      {"a.nii.zst", at(0, "\x28\xb5\x2f\xfd"), "is compressed: unpack it with 'unzstd FILE'"},
      {"a.npz", at(0, "PK\x3\x4"), "is a zip archive, as NumPy's .npz is: unpack it with 'unzip"},
      {"a.png", at(0, "\x89PNG\r\n\x1a\n"), "is a picture: "},
      {"a.jpg", at(0, "\xff\xd8\xff\xe0"), "is a picture: "},
      {"a.hdr", at(0, std::string("\x5c\x01\0\0", 4)), "is ANALYZE 7.5: "},
      {"a.hdr", at(0, std::string("\0\0\x01\x5c", 4)), "is ANALYZE 7.5: "}};
  for (const auto& [name, content, message] : files) {
    CHECK(fault_of(folder, name, content).find(message) != std::string::npos);
  }
  const std::tuple<std::string, std::string, std::string> folders[] = {
      {".zarray", "", "is Zarr: "},
      {".zgroup", "", "is a group of Zarr arrays: "},
      {"zarr.json", "{\"node_type\": \"array\"}", "is Zarr: "},
      {"zarr.json", "{\"node_type\": \"group\"}", "is a group of Zarr arrays: "},
      {"IM1.DCM", "", "is a folder without slices, "},
      {"0001.png", "", "is a folder of pictures: make one raw file"}};
  for (const auto& [file, content, message] : folders) {
    const TemporaryFolder slices;
    slices.write(file, content);
    CHECK(read_message(slices.path("")).find(message) != std::string::npos);
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
        CHECK(read_message(stored.write(folder)) != "");
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
    CHECK(read_message(stored.write(folder), options) == stored.files[0].name + message);
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
  options.spacing = Vec3{1, 1, -2};
  CHECK(read(25) == "v.raw: spacing along z is not positive");
  options.spacing.reset();
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
  CHECK(read_message(folder.path("pipe"), options).find("No such file") != std::string::npos);
  CHECK_THROWS_WITH_AS(read_volume("/dev/null", options), "/dev/null: is a device, not a file",
                       InputError);
}
