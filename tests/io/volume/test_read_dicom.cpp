// SPDX-License-Identifier: MIT
// Series of DICOM slices. Files of several frames are among the forms of test_read_volume.
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "base/random.h"
#include "base/text.h"
#include "io/volume/read_volume.h"
#include "read_fault.h"
#include "volume_files.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr int kSlices = 5;
constexpr const char* kNames[kSlices] = {"d.dcm", "b.dcm", "e.dcm", "a", "c.IMA"};

Truth oblique_truth(SampleType type) {
  Truth truth = random_truth(type, {4, 3, kSlices}, 3);
  truth.spacing = {0.5, 1.25, 3};
  truth.origin = {10, -20.25, 30.5};
  truth.axes = {Vec3{0.6, 0.8, 0}, Vec3{0, 0, -1}, Vec3{-0.8, 0.6, 0}};
  return truth;
}

// A series in a folder of its own; `change` may edit the elements of each slice.
template <class Change>
std::string write_series(const TemporaryFolder& folder, const Truth& truth, const DicomForm& form,
                         Change change) {
  const std::string series = folder.path("series");
  std::filesystem::remove_all(series);
  std::filesystem::create_directories(series);
  for (int k = 0; k < kSlices; ++k) {
    DicomElements elements = dicom_image(truth, form, k, 1);
    change(k, elements);
    folder.write(std::string("series/") + kNames[k], dicom_file(form, elements));
  }
  return series;
}
std::string write_series(const TemporaryFolder& folder, const Truth& truth,
                         const DicomForm& form = {}) {
  return write_series(folder, truth, form, [](int, DicomElements&) {});
}

}  // namespace

TEST_CASE("a series is sorted by the places of its slices, in every encoding") {
  const TemporaryFolder folder;
  const DicomForm forms[] = {{},
                             {.is_explicit = false},
                             {.order = std::endian::big},
                             {.coding = DicomForm::Coding::rle},
                             {.coding = DicomForm::Coding::jpeg},
                             {.coding = DicomForm::Coding::jpeg_ls},
                             {.coding = DicomForm::Coding::deflated},
                             {.has_preamble = false},
                             {.is_explicit = false, .has_preamble = false, .has_lengths = false}};
  for (const SampleType type : {SampleType::u8, SampleType::i8, SampleType::u16, SampleType::i16,
                                SampleType::u32, SampleType::i32}) {
    const Truth truth = oblique_truth(type);
    for (const DicomForm& form : forms) {
      const bool is_jpeg = form.is_packed() && form.coding != DicomForm::Coding::rle;
      if (is_jpeg && size_of(type) > 2) continue;
      ReadLog log;
      const std::string series = write_series(folder, truth, form);
      const Volume volume = read_volume(series, {}, &log);
      REQUIRE(volume.dims() == truth.dims);
      REQUIRE(volume.type() == type);
      CHECK(bytes_of_samples(volume) == truth.bytes);
      CHECK(distance(volume.spacing(), truth.spacing) < 1e-12);
      CHECK(distance(volume.frame().origin, truth.origin) < 1e-12);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        CHECK(distance(volume.frame().axes[axis], truth.axes[axis]) < 1e-12);
      }
      CHECK(volume.frame().space == AnatomicalSpace::lps);
      CHECK(log.notes.empty());
      CHECK(log.files.size() == kSlices);
      CHECK(std::ranges::count(log.paths(), series + "/d.dcm") == 1);

      ReadOptions options;
      options.roi = Roi{{1, 0, 2}, {4, 3, 4}};
      const Volume part = read_volume(series, options);
      REQUIRE(part.dims() == Index3{3, 3, 2});
      for (int n = 0; n < 18; ++n) {
        CHECK(part.sample(n % 3, n / 3 % 3, n / 9) ==
              volume.sample(1 + n % 3, n / 3 % 3, 2 + n / 9));
      }
    }
  }
}

TEST_CASE("the bits of a sample are taken from its word") {
  const TemporaryFolder folder;
  // Twelve bits up to bit 13; the others are noise.
  const Truth noise = oblique_truth(SampleType::u16);
  for (const bool is_signed : {false, true}) {
    const std::string series = write_series(folder, noise, {}, [&](int, DicomElements& elements) {
      elements[0x00280101].value = little(12, 2);
      elements[0x00280102].value = little(13, 2);
      elements[0x00280103].value = little(is_signed, 2);
    });
    const Volume volume = read_volume(series);
    REQUIRE(volume.type() == (is_signed ? SampleType::i16 : SampleType::u16));
    for (int n = 0; n < 60; ++n) {
      std::uint16_t word;
      std::memcpy(&word, &noise.bytes[2 * static_cast<std::size_t>(n)], 2);
      int value = word >> 2 & 0xfff;
      if (is_signed && value >= 2048) value -= 4096;
      CHECK(volume.sample(n % 4, n / 4 % 3, n / 12) == value);
    }
  }
}

TEST_CASE("slope and intercept are applied, also if every slice has its own") {
  const TemporaryFolder folder;
  for (const SampleType type : {SampleType::u8, SampleType::i8, SampleType::u16, SampleType::i16,
                                SampleType::u32, SampleType::i32}) {
    const Truth truth = oblique_truth(type);
    const Volume plain = read_volume(write_series(folder, truth));
    for (const bool own : {false, true}) {
      const auto slope = [&](int k) { return own ? 0.5 + k : 0.5; };
      ReadLog log;
      const Volume scaled =
          read_volume(write_series(folder, truth, {},
                                   [&](int k, DicomElements& elements) {
                                     elements[0x00281052] = dicom_numbers({-1024});
                                     elements[0x00281053] = dicom_numbers({slope(k)});
                                   }),
                      {}, &log);
      const bool is_wide = size_of(type) == 4;
      REQUIRE(scaled.type() == (is_wide ? SampleType::f64 : SampleType::f32));
      for (int n = 0; n < 60; ++n) {
        const int k = n / 12;
        const double value = slope(k) * plain.sample(n % 4, n / 4 % 3, k) - 1024;
        CHECK(scaled.sample(n % 4, n / 4 % 3, k) ==
              (is_wide ? value : static_cast<double>(static_cast<float>(value))));
      }
      REQUIRE(log.notes.size() == 1);
      CHECK((log.notes[0].words.find("slice by slice") != std::string::npos) == own);
    }
  }
}

TEST_CASE("files of the folder that are no images are passed over, and told") {
  const TemporaryFolder folder;
  const Truth truth = oblique_truth(SampleType::i16);
  const std::string series = write_series(folder, truth);
  folder.write("series/.note", "text");
  folder.write("series/DICOMDIR", dicom_file({}, {{0x00041130, {"CS", "DISK"}}}));
  folder.write("series/empty.dcm", "");
  std::filesystem::create_directories(folder.path("series/more.dcm"));
  ReadLog log;
  CHECK(bytes_of_samples(read_volume(series, {}, &log)) == truth.bytes);
  REQUIRE(log.notes.size() == 1);
  CHECK(log.notes[0].words.ends_with("passed over '.note' and 2 more: no DICOM images"));
  CHECK(log.files.size() == kSlices);
  for (const char* name : kNames) std::filesystem::remove(series + "/" + name);
  CHECK(read_message(series).find("is a folder without slices") != std::string::npos);
}

TEST_CASE(
    "a file that cannot be read stops a folder of slices, and is told of in a folder of folders") {
  const TemporaryFolder folder;
  const Truth truth = oblique_truth(SampleType::i16);
  const std::string series = write_series(folder, truth), top = folder.path("");
  const auto make_unreadable = [&](const std::string& name) {
    std::filesystem::permissions(folder.write(name, "text"), std::filesystem::perms::none);
  };
  make_unreadable("secret");
  std::filesystem::permissions(top, std::filesystem::perms(0755));
  // Root may read everything, so root becomes somebody else for these lines.
  const uid_t user = geteuid();
  const auto as_nobody = [&](auto read) {
    if (user == 0) REQUIRE(seteuid(65534) == 0);
    auto result = read();
    if (user == 0) REQUIRE(seteuid(user) == 0);
    return result;
  };
  ReadLog log;
  CHECK(as_nobody([&] { return bytes_of_samples(read_volume(top, {}, &log)); }) == truth.bytes);
  CHECK(has(log.notes, "files-unreadable"));
  make_unreadable("series/f.dcm");
  CHECK(as_nobody([&] { return read_message(series); }).starts_with("series/f.dcm: cannot open"));
  for (const char* name : kNames) std::filesystem::remove(series + "/" + name);
  CHECK(as_nobody([&] {
          return read_message(top);
        }).ends_with(", or a file; cannot read 'secret' and 1 more"));
}

TEST_CASE("a damaged file stops a folder of slices, and is told of in a folder of folders") {
  const TemporaryFolder folder;
  const Truth truth = oblique_truth(SampleType::i16);
  const std::string series = write_series(folder, truth), top = folder.path("");
  std::string bytes = file_bytes(series + "/" + kNames[0]);
  std::filesystem::create_directories(folder.path("other"));
  const auto is_damaged = [&] {
    return read_message(folder.write("other/damaged", bytes)).find("is damaged, or ends") !=
           std::string::npos;
  };
  while (!is_damaged() && !bytes.empty()) bytes.pop_back();  // up to within an element
  REQUIRE(!bytes.empty());
  ReadLog log;
  CHECK(bytes_of_samples(read_volume(top, {}, &log)) == truth.bytes);
  REQUIRE(has(log.notes, "files-unreadable"));
  CHECK(text_of(log.notes[0]).ends_with("cannot read 'damaged': passed over"));
  folder.write("series/damaged", bytes);
  CHECK(read_message(series).starts_with("series/damaged: is damaged, or ends too early"));
}

TEST_CASE("each fault of a series has its message, with the file") {
  const TemporaryFolder folder;
  const Truth truth = oblique_truth(SampleType::u16);
  // Slice 3 is the file 'a', the first that is read, and slice 2 is 'e.dcm', the last.
  const auto with = [&](std::uint32_t tag, const DicomElement& element) {
    return read_message(write_series(folder, truth, {}, [&](int k, DicomElements& elements) {
      if (k == 2) elements[tag] = element;
    }));
  };
  const auto number = [](std::uint64_t n) { return DicomElement{"US", little(n, 2)}; };
  const auto place = [&](double k) { return dicom_vector(truth.origin + k * truth.step(2)); };
  CHECK(with(0x00200013, {"IS", "7"}) == "");
  CHECK(with(0x00200032, place(2.05)) == "");
  CHECK(with(0x00200032, place(1)) ==
        "series/e.dcm: has the same place (ImagePositionPatient) as 'b.dcm'");
  CHECK(with(0x00200032, place(2.25)) == "");
  CHECK(with(0x00200032, dicom_vector(truth.origin + 2 * truth.step(2) + truth.step(0))) ==
        "series/e.dcm: lies 0.5 aside of the line through the first slice and the last");
  CHECK(with(0x00200032, {"DS", "  "}) == "series/e.dcm: has no ImagePositionPatient");
  CHECK(with(0x00200032, {"DS", "1\\2"}) ==
        "series/e.dcm: its ImagePositionPatient is '1\\2', not 3 numbers");
  CHECK(with(0x00200032, {"DS", "1\\nan\\2"}).find("not 3 numbers") != std::string::npos);
  CHECK(with(0x00200037, {"DS", ""}) == "series/e.dcm: has no ImageOrientationPatient");
  CHECK(with(0x00200037, {"DS", "0.6\\0.8\\0\\0.6\\0.8\\0"}).find("is no pair of directions") !=
        std::string::npos);
  for (const char* bad : {"", "0\\1", "1\\-1", "nan\\nan", "1", "one\\two"}) {
    CHECK(with(0x00280030, {"DS", bad}) ==
          "series/e.dcm: has no valid PixelSpacing: --spacing SX,SY,SZ gives it");
  }
  CHECK(with(0x00280011, number(5)).starts_with("series/e.dcm: has 24 bytes of samples: "));
  CHECK(with(0x00080008, {"CS", "ORIGINAL\\PRIMARY\\M\\MOSAIC"}).find("is a mosaic, as Siemens") !=
        std::string::npos);
  CHECK(with(0x00280010, number(0)) == "series/e.dcm: does not tell its Rows and Columns");
  CHECK(with(0x00280103, number(1)) == "series/e.dcm: has samples of type int16, unlike 'a'");
  CHECK(with(0x00280004, {"CS", "MONOCHROME1"}) == "series/e.dcm: is MONOCHROME1, unlike 'a'");
  CHECK(with(0x00280004, {"CS", "RGB"}) ==
        "series/e.dcm: is in color ('RGB'): only grayscale can be meshed");
  CHECK(with(0x00280100, number(1)).find("only those in 8, 16 and 32 are read") !=
        std::string::npos);
  CHECK(with(0x00280101, number(17)).find("only those in 8, 16 and 32 are read") !=
        std::string::npos);
  CHECK(with(0x00280102, number(16)).find("only those in 8, 16 and 32 are read") !=
        std::string::npos);
  CHECK(with(0x00280008, {"IS", "0"}) == "series/e.dcm: its NumberOfFrames is '0'");
  CHECK(with(0x00281053, {"DS", "0"}) == "series/e.dcm: its RescaleSlope is 0");
  CHECK(with(0x7fe00010, {"OW", "abc"}).starts_with("series/e.dcm: has 4 bytes of samples"));

  std::string series = write_series(folder, truth);
  CHECK(read_message(series + "/a") == "a: is one slice: give the folder that holds the series");
  ReadOptions options;
  options.spacing = Vec3{1, 1, 1};
  CHECK(read_volume(series, options).spacing() == Vec3{1, 1, 1});
  options = {};
  options.array = "x";
  CHECK(read_message(series, options).find("has no named arrays") != std::string::npos);
  options = {};
  options.roi = Roi{{0, 0, 0}, {4, 3, 6}};
  CHECK(read_message(series, options).starts_with("series: region 0:6 along z"));

  const std::string whole = dicom_file({}, dicom_image(truth, {}, 2, 1));
  for (std::size_t size = 140; size < whole.size(); size += 7) {
    folder.write("series/e.dcm", whole.substr(0, size));
    // Cut between two elements before the samples, it is a file without an image.
    ReadLog log;
    try {
      read_volume(series, {}, &log);
    } catch (const InputError& error) {
      CHECK(std::string(error.what()).find("e.dcm") != std::string::npos);
      continue;
    }
    REQUIRE(log.notes.size() == 3);
    CHECK(text_of(log.notes[0]).find("'e.dcm'") != std::string::npos);
    CHECK(log.notes[1].words.find("slices seem to be missing") != std::string::npos);
  }
}

TEST_CASE("transfer syntaxes that are not read are named") {
  const TemporaryFolder folder;
  const std::pair<std::string, const char*> syntaxes[] = {
      {"1.2.840.10008.1.2.4.90", "is compressed (JPEG 2000): convert it with 'gdcmconv"},
      {"1.2.840.10008.1.2.4.51",
       "is compressed (JPEG that loses detail): convert it with 'gdcmconv"},
      {"1.2.3", "has transfer syntax '1.2.3': convert it with 'gdcmconv"}};
  for (const auto& [uid, message] : syntaxes) {
    for (const DicomForm& form : {DicomForm{.coding = DicomForm::Coding::jpeg}, DicomForm{}}) {
      const Truth truth = oblique_truth(SampleType::u16);
      const std::string data = dicom_elements(form, dicom_image(truth, form, 0, kSlices));
      const std::string file =
          std::string(128, '\0') + "DICM" + dicom_elements({}, {{0x00020010, {"UI", uid}}}) + data;
      CHECK(read_message(folder.write("v.dcm", file)).find(message) != std::string::npos);
    }
  }
}

TEST_CASE("a JPEG of fewer bits than are stored has its sign in the highest of them") {
  const TemporaryFolder folder;
  Truth truth = oblique_truth(SampleType::i16);
  const DicomForm form{.coding = DicomForm::Coding::jpeg};
  for (const int bits : {16, 12, 9}) {
    for (const int stored : {16, 12}) {
      const int used = std::min(bits, stored);
      const std::string series =
          write_series(folder, truth, form, [&](int k, DicomElements& elements) {
            JpegImage image{4, 3, bits};
            for (int n = 0; n < 12; ++n) {
              std::int16_t value;
              std::memcpy(&value, &truth.bytes[static_cast<std::size_t>(2 * (12 * k + n))], 2);
              image.samples.push_back(value & ((1 << bits) - 1));
            }
            std::string stream = jpeg_stream(image, {});
            if (stream.size() % 2 != 0) stream += '\0';
            elements[0x00280101].value = little(static_cast<std::uint64_t>(stored), 2);
            elements[0x00280102].value = little(static_cast<std::uint64_t>(stored - 1), 2);
            elements[0x7fe00010].value = little(0xe000fffe, 4) + little(0, 4) +
                                         little(0xe000fffe, 4) + little(stream.size(), 4) + stream;
          });
      const Volume volume = read_volume(series);
      for (int n = 0; n < 60; ++n) {
        std::int16_t value;
        std::memcpy(&value, &truth.bytes[static_cast<std::size_t>(2 * n)], 2);
        CHECK(volume.sample(n % 4, n / 4 % 3, n / 12) ==
              static_cast<std::int16_t>(value << (16 - used)) >> (16 - used));
      }
    }
  }
}

TEST_CASE("compressed samples that are damaged or missing have a message") {
  const TemporaryFolder folder;
  using Coding = DicomForm::Coding;
  const Truth truth = oblique_truth(SampleType::i16);
  for (const Coding coding : {Coding::rle, Coding::jpeg, Coding::jpeg_ls, Coding::deflated}) {
    const DicomForm form{.coding = coding};
    const std::string whole = dicom_file(form, dicom_image(truth, form, 0, kSlices));
    for (std::size_t size = 200; size + 9 < whole.size(); size += 13) {
      CHECK(read_message(folder.write("v.dcm", whole.substr(0, size))) != "");
    }
    if (!form.is_packed()) continue;
    DicomElements elements = dicom_image(truth, form, 0, kSlices);
    elements[0x00280011] = {"US", little(5, 2)};
    CHECK(read_message(folder.write("v.dcm", dicom_file(form, elements))) ==
          (coding == Coding::rle
               ? "v.dcm: its run lengths are damaged"
               : "v.dcm: its JPEG of frame 1 is damaged, or not lossless: another size"));
    elements[0x00280008] = {"IS", "4"};
    CHECK(read_message(folder.write("v.dcm", dicom_file(form, elements))) ==
          "v.dcm: has 5 compressed frames in place of 4");
    elements[0x00280010] = elements[0x00280011] = {"US", little(65535, 2)};
    CHECK(read_message(folder.write("v.dcm", dicom_file(form, elements)))
              .find("compressed frames in place") != std::string::npos);
  }
  // Memory is taken for samples that can be there only.
  const DicomForm form{.coding = Coding::rle};
  DicomElements elements = dicom_image(truth, form, 0, kSlices);
  elements[0x00280010] = elements[0x00280011] = {"US", little(65535, 2)};
  CHECK(read_message(folder.write("v.dcm", dicom_file(form, elements))).find("bytes of samples") !=
        std::string::npos);
}

// The place of its frames was 0 0 0, without a word.
TEST_CASE("nuclear medicine has the place of its frames in the detector's sequence") {
  const TemporaryFolder folder;
  const Truth truth = oblique_truth(SampleType::u16);
  for (const DicomForm& form :
       {DicomForm{.place = DicomForm::Place::stack},
        DicomForm{.is_explicit = false, .has_lengths = false, .place = DicomForm::Place::stack}}) {
    const DicomElements plain = dicom_image(truth, form, 0, kSlices);
    const DicomElement position = plain.at(0x00200032), directions = plain.at(0x00200037);
    const auto read = [&](const std::vector<DicomElements>& detectors, ReadLog& log) {
      DicomElements elements = plain;
      elements.erase(0x00200032);
      elements.erase(0x00200037);
      elements[0x00540022] = dicom_sequence(form, detectors);
      return read_volume(folder.write("v.dcm", dicom_file(form, elements)), {}, &log);
    };
    const auto is_in_place = [&](const Volume& volume) {
      return distance(volume.frame().origin, truth.origin) < 1e-12 &&
             distance(volume.frame().axes[0], truth.axes[0]) < 1e-12 &&
             distance(volume.frame().axes[2], truth.axes[2]) < 1e-12 &&
             volume.frame().space == AnatomicalSpace::lps;
    };
    const DicomElements detector{{0x00200032, position}, {0x00200037, directions}};
    ReadLog log;
    CHECK(is_in_place(read({detector}, log)));
    CHECK(is_in_place(read({detector, detector}, log)));
    CHECK(log.notes.empty());
    DicomElements other = detector;
    other[0x00200032] = dicom_vector({1, 2, 3});
    const Volume unknown = read({detector, other}, log);
    CHECK(unknown.frame().origin == Vec3{0, 0, 0});
    CHECK(unknown.frame().space == AnatomicalSpace::unknown);
    REQUIRE(log.notes.size() == 1);
    CHECK(text_of(log.notes[0])
              .ends_with("v.dcm: does not tell its position and orientation: world "
                         "coordinates are not the patient's"));
    read({{{0x00200037, directions}}}, log);
    CHECK(log.notes.back().words.find("does not tell its position: world") != std::string::npos);
    read({{{0x00200032, position}}}, log);
    CHECK(log.notes.back().words.find("does not tell its orientation: world") != std::string::npos);
    // What the file says of the whole goes before.
    DicomElements elements = plain;
    elements[0x00540022] = dicom_sequence(form, {other});
    CHECK(is_in_place(read_volume(folder.write("v.dcm", dicom_file(form, elements)))));
  }
}

// Two frames of one slice, as of two times, were a stack of twice the height.
TEST_CASE("frames of nuclear medicine are placed by the numbers of their slices") {
  const TemporaryFolder folder;
  const Truth truth = oblique_truth(SampleType::u8);
  const DicomForm form{.place = DicomForm::Place::stack};
  const auto with = [&](const std::vector<std::uint64_t>& numbers) {
    DicomElements elements = dicom_image(truth, form, 0, kSlices);
    std::string words;
    for (const std::uint64_t number : numbers) words += little(number, 2);
    elements[0x00540080] = {"US", words};
    return folder.write("v.dcm", dicom_file(form, elements));
  };
  CHECK(bytes_of_samples(read_volume(with({1, 2, 3, 4, 5}))) == truth.bytes);
  const Volume mixed = read_volume(with({3, 5, 4, 2, 1}));
  CHECK(distance(mixed.frame().origin, truth.origin - 2 * truth.step(2)) < 1e-12);
  const int frames[] = {4, 3, 0, 2, 1};
  for (int n = 0; n < 60; ++n) {
    CHECK(mixed.sample(n % 4, n / 4 % 3, n / 12) ==
          static_cast<std::uint8_t>(
              truth.bytes[static_cast<std::size_t>(n % 12 + 12 * frames[n / 12])]));
  }
  CHECK(read_message(with({1, 2, 3, 1, 2}))
            .ends_with("v.dcm, frame 3: has a place (ImagePositionPatient) with 1 slice, where "
                       "others have 2"));
  CHECK(read_message(with({1, 1, 2, 3, 4}))
            .ends_with("v.dcm, frame 2: has the same place (ImagePositionPatient) as frame 1"));
  CHECK(read_message(with({1, 1, 1, 1, 1}))
            .ends_with("v.dcm: all its slices have the same place (ImagePositionPatient)"));
  CHECK(read_message(with({1, 2, 3})) == "v.dcm: has the offsets of 3 frames, and 5 frames");
}

TEST_CASE("a folder of several series lists them, and one of them is taken") {
  const TemporaryFolder folder;
  const Truth head = oblique_truth(SampleType::i16);
  Truth chest = random_truth(SampleType::u8, {5, 3, 4}, 9);
  const auto add = [&](const std::string& path, const Truth& truth, int k, const char* number,
                       const char* name, const char* uid) {
    DicomElements elements = dicom_image(truth, {}, k, 1);
    elements[0x0008103e] = {"LO", name};
    elements[0x0020000e] = {"UI", uid};
    elements[0x00200011] = {"IS", number};
    std::filesystem::create_directories(folder.path(path.substr(0, path.rfind('/'))));
    folder.write(path, dicom_file({}, elements));
  };
  for (int k = 0; k < kSlices; ++k) add(text("disk/b/head/", k), head, k, "7", "Head", "1.2.3");
  for (int k = 0; k < 4; ++k) add(text("disk/a/", k), chest, k, "12", "Chest \x01 1.0", "1.2.4");
  // A scout of its own, and one in the series, are no volumes.
  add("disk/a/scout", random_truth(SampleType::u8, {9, 9, 2}, 1), 0, "1", "Scout", "1.2.5");
  Truth side = chest;
  std::swap(side.axes[1], side.axes[2]);
  add("disk/a/side", side, 1, "12", "Chest", "1.2.4");
  folder.write("disk/DICOMDIR", dicom_file({}, {{0x00041130, {"CS", "DISK"}}}));

  const std::string list =
      "holds 4 series, of which --series N takes one: 1 is 'Head', 5 images of 4 x 3 "
      "('b/head/0'); 2 is 'Chest ? 1.0', 4 images of 5 x 3 ('a/0'); 3 is 'Scout', 1 image of "
      "9 x 9 ('a/scout'); 4 is 'Chest', 1 image of 5 x 3 ('a/side')";
  CHECK(read_message(folder.path("disk")) == "disk: " + list);
  CHECK(read_message(folder.path("disk/DICOMDIR")).ends_with("disk: " + list));
  ReadOptions options;
  for (const std::uint64_t beyond : {0, 5}) {
    options.series = beyond;
    CHECK(read_message(folder.path("disk"), options) == "disk: " + list);
  }
  for (const char* input : {"disk", "disk/DICOMDIR"}) {
    options.series = 1;
    ReadLog log;
    CHECK(bytes_of_samples(read_volume(folder.path(input), options, &log)) == head.bytes);
    REQUIRE(log.notes.size() == 1);
    CHECK(text_of(log.notes[0]).ends_with("disk: passed over 'DICOMDIR': no DICOM images"));
    options.series = 2;
    CHECK(bytes_of_samples(read_volume(folder.path(input), options, &log)) == chest.bytes);
    REQUIRE(log.notes.size() == 2);  // the first is there once
    CHECK(
        text_of(log.notes[1])
            .ends_with("disk: left out 'a/side': of another series, size, spacing or orientation"));
  }
  // A folder with images of its own is no more than these.
  ReadLog log;
  CHECK(bytes_of_samples(read_volume(folder.path("disk/a"), {}, &log)) == chest.bytes);
  REQUIRE(log.notes.size() == 1);
  CHECK(text_of(log.notes[0])
            .ends_with("disk/a: left out 'scout' and 1 more: of another series, size, spacing or "
                       "orientation"));
  std::filesystem::create_directories(folder.path("disk/a/nested"));
  std::filesystem::copy(folder.path("disk/b/head"), folder.path("disk/a/nested"));
  CHECK(bytes_of_samples(read_volume(folder.path("disk/a"))) == chest.bytes);

  // Nobody else has series.
  options.series = 1;
  CHECK(read_message("builtin:sphere:8", options).find("has no series to choose from") !=
        std::string::npos);
  folder.write("v.npy", "\x93NUMPY");
  CHECK(read_message(folder.path("v.npy"), options).find("has no series to choose from") !=
        std::string::npos);
}

// A message is cut after 500 bytes, in the middle of a list.
TEST_CASE("of many series a message has the first, and all are listed") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("disk"));
  for (int series = 1; series <= 40; ++series) {
    for (int k = 0; k < 2; ++k) {
      DicomElements elements = dicom_image(oblique_truth(SampleType::u8), {}, k, 1);
      elements[0x0020000e] = {"UI", text("1.2.", series)};
      elements[0x00200011] = {"IS", text(series)};
      elements[0x0008103e] = {"LO", std::string(500, 'x')};
      folder.write(text("disk/", series, "-", k), dicom_file({}, elements));
    }
  }
  const std::string message = read_message(folder.path("disk"));
  CHECK(message.starts_with("disk: holds 40 series, of which --series N takes one: 1 is "));
  CHECK(message.ends_with(" more, which 'deliso info' lists"));
  CHECK(message.find("[...]") == std::string::npos);
  CHECK(message.size() > 300);
  std::vector<FoundSeries> found;
  try {
    read_volume(folder.path("disk"));
  } catch (const SeveralSeries& several) {
    found = several.series;
  }
  REQUIRE(found.size() == 40);
  CHECK(text_of(found[39]) == "'" + std::string(37, 'x') + "...', 2 images of 4 x 3 ('40-0')");
  ReadOptions options;
  options.series = 40;
  CHECK(read_volume(folder.path("disk"), options).dims().k == 2);
}

TEST_CASE("images in color or of a codec that is not read do not disturb a series beside them") {
  const TemporaryFolder folder;
  const Truth truth = oblique_truth(SampleType::u16);
  const std::string series = write_series(folder, truth);
  for (int k = 0; k < 2; ++k) {
    DicomElements elements = dicom_image(truth, {}, k, 1);
    elements[0x0020000e] = {"UI", "1.2.4"};
    elements[0x00280004] = {"CS", "RGB"};
    folder.write(text("series/color", k), dicom_file({}, elements));
  }
  ReadLog log;
  CHECK(bytes_of_samples(read_volume(series, {}, &log)) == truth.bytes);
  REQUIRE(log.notes.size() == 1);
  CHECK(log.notes[0].words.find("left out 'color0' and 1 more: ") != std::string::npos);
}

// It was refused, with --spacing too; then the mesh would lack what the slice shows.
TEST_CASE("a missing slice is a wider gap, with a note") {
  const TemporaryFolder folder;
  const Truth truth = oblique_truth(SampleType::u16);
  const auto with = [&](std::uint32_t tag, const DicomElement& element, ReadLog& log) {
    return read_volume(write_series(folder, truth, {},
                                    [&](int k, DicomElements& elements) {
                                      if (k == 2) elements[tag] = element;
                                    }),
                       {}, &log);
  };
  const std::pair<std::uint32_t, DicomElement> left_out[] = {
      {0x00200037, {"DS", "0.6\\0.8\\0\\0\\0\\1"}},
      {0x0020000e, {"UI", "1.2.4"}},
      {0x00280030, {"DS", "1.25\\0.6"}},
      {0x00280011, {"US", little(3, 2)}}};  // its samples are too long
  for (const auto& [tag, element] : left_out) {
    ReadLog log;
    const Volume volume = with(tag, element, log);
    CHECK(volume.all_places()[2] == std::vector<double>{0, 3, 9, 12});
    CHECK(volume.spacing().z == 3);
    REQUIRE(log.notes.size() == 3);
    CHECK(log.notes[0].words.ends_with(
        "left out 'e.dcm': of another series, size, spacing or orientation"));
    CHECK(log.notes[1].severity == Severity::warning);
    CHECK(log.notes[1].words.find(
              "slices seem to be missing between 'b.dcm' and 'a', which lie 6 apart, "
              "where others have 3: ") != std::string::npos);
  }
}

// Slices stay where their file has them: the topology of the mesh is that of the samples.
TEST_CASE("slices that are uneven or tilted stay where they are") {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Truth truth = oblique_truth(SampleType::i16);
    const bool is_uneven = seed % 2 == 0, is_tilted = seed % 3 == 0;
    const double shifts[] = {is_tilted ? random.uniform(0.05, 1) : 0,
                             is_tilted ? random.uniform(-1, 1) : 0};
    const Vec3 up = truth.step(2) + shifts[0] * truth.step(0) + shifts[1] * truth.step(1);
    std::vector<double> steps{0};
    while (steps.size() < kSlices) {
      steps.push_back(steps.back() + (is_uneven ? random.uniform(0.3, 1.4) : 1));
    }
    const std::string series = write_series(folder, truth, {}, [&](int k, DicomElements& elements) {
      elements[0x00200032] = dicom_vector(truth.origin + steps[static_cast<std::size_t>(k)] * up);
    });
    ReadLog log;
    const Volume volume = read_volume(series, {}, &log);
    CHECK(volume.dims() == truth.dims);
    CHECK(bytes_of_samples(volume) == truth.bytes);
    CHECK(volume.is_even() == !is_uneven);
    for (int n = 0; n < 60; ++n) {
      const Index3 at{n % 4, n / 4 % 3, n / 12};
      const Vec3 in_file = truth.origin + at.i * truth.step(0) + at.j * truth.step(1) +
                           steps[static_cast<std::size_t>(at.k)] * up;
      CHECK(distance(volume.frame().to_world(volume.position(at)), in_file) < 1e-9);
    }
    CHECK(has(log.notes, "slices-uneven") == is_uneven);
    CHECK(has(log.notes, "sheared-grid") == is_tilted);
    ReadOptions options;
    options.roi = Roi{{1, 0, 2}, {3, 2, 5}};
    const Volume part = read_volume(series, options);
    CHECK(distance(part.frame().to_world(part.position({1, 1, 2})),
                   volume.frame().to_world(volume.position({2, 1, 4}))) < 1e-9);
    // A spacing that is given stands.
    options = {};
    options.spacing = Vec3{1, 2, 3};
    CHECK(read_volume(series, options).is_even());
  }
}

// 256 rows became 257, of another type, and values in between: "tilted by 0 degrees".
TEST_CASE("positions that are rounded are no tilt") {
  const TemporaryFolder folder;
  Truth truth = oblique_truth(SampleType::i16);
  const double angle = 0.3;
  truth.axes = {Vec3{std::cos(angle), std::sin(angle), 0}, Vec3{0, 0, -1},
                Vec3{-std::sin(angle), std::cos(angle), 0}};
  truth.spacing = {0.05, 0.05, 3};  // half a sample is far below the rounding
  const auto rounded = [&](int k) {
    Vec3 place = truth.origin + k * truth.step(2);
    for (int axis = 0; axis < 3; ++axis) place[axis] = std::round(place[axis] * 10) / 10;
    return dicom_vector(place);
  };
  const std::string series = write_series(folder, truth, {}, [&](int k, DicomElements& elements) {
    elements[0x00200032] = rounded(k);
  });
  DicomElements frames = dicom_image(truth, {}, 0, kSlices);
  std::vector<DicomElements> groups;
  for (int k = 0; k < kSlices; ++k) {
    groups.push_back({{0x00209113, dicom_sequence({}, {{{0x00200032, rounded(k)}}})}});
  }
  frames[0x52009230] = dicom_sequence({}, groups);
  for (const std::string& path : {series, folder.write("v.dcm", dicom_file({}, frames))}) {
    ReadLog log;
    const Volume volume = read_volume(path, {}, &log);
    CHECK(volume.dims() == truth.dims);
    CHECK(bytes_of_samples(volume) == truth.bytes);
    CHECK(!has(log.notes, "sheared-grid"));
    CHECK(dot(volume.frame().axes[2], volume.frame().axes[0]) == doctest::Approx(0).epsilon(1e-9));
  }
}

TEST_CASE("a scan that is coarser from some place on lacks no slices") {
  const TemporaryFolder folder;
  const Truth truth = random_truth(SampleType::u8, {4, 3, 9}, 3);
  const DicomForm form{.place = DicomForm::Place::offsets};
  const auto with = [&](const std::vector<double>& offsets, ReadLog* log) {
    DicomElements elements = dicom_image(truth, form, 0, 9);
    elements[0x3004000c] = dicom_numbers(offsets);
    return read_volume(folder.write("v.dcm", dicom_file(form, elements)), {}, log);
  };
  ReadLog log;
  const Volume volume = with({0, 1, 2, 3, 4, 5, 7, 9, 11}, &log);
  CHECK(volume.dims() == truth.dims);
  REQUIRE(log.notes.size() == 1);
  CHECK(log.notes[0].words.find("uneven, from 1 to 2 apart") != std::string::npos);
  log = {};
  with({0, 1, 2, 3, 4, 5, 6, 8, 10}, &log);
  CHECK(log.notes[0].words.find("slices seem to be missing") != std::string::npos);
}

// All of these were refused, and --spacing was not looked at.
TEST_CASE("slices without places, directions or spacings are read, with a note or an option") {
  const TemporaryFolder folder;
  const Truth truth = oblique_truth(SampleType::i16);
  constexpr std::uint32_t kPosition = 0x00200032, kDirections = 0x00200037, kSpacing = 0x00280030,
                          kDistance = 0x00180088, kThickness = 0x00180050, kLocation = 0x00201041,
                          kNumber = 0x00200013;
  ReadOptions given;
  given.spacing = Vec3{2, 3, 4};
  ReadLog log;
  const auto series_without = [&](const std::vector<std::uint32_t>& tags,
                                  const DicomElements& more = {}) {
    return write_series(folder, truth, {}, [&](int k, DicomElements& elements) {
      for (const std::uint32_t tag : tags) elements.erase(tag);
      elements[kNumber] = {"IS", text(20 - k)};  // the other way round
      for (const auto& [tag, element] : more) elements[tag] = element;
    });
  };
  const auto has_note = [&](const char* note) {
    return std::ranges::any_of(
        log.notes, [&](const Diagnostic& d) { return d.words.find(note) != std::string::npos; });
  };
  const auto is_reversed = [&](const Volume& volume) {
    std::string slices;
    for (std::size_t k = 0; k < kSlices; ++k) slices += truth.bytes.substr(24 * (4 - k), 24);
    return bytes_of_samples(volume) == slices;
  };
  // PixelSpacing alone.
  std::string series = series_without({kSpacing});
  CHECK(read_message(series).ends_with("has no valid PixelSpacing: --spacing SX,SY,SZ gives it"));
  Volume volume = read_volume(series, given);
  CHECK(volume.spacing() == Vec3{2, 3, 4});
  CHECK(bytes_of_samples(volume) == truth.bytes);
  CHECK(distance(volume.frame().axes[2], truth.axes[2]) < 1e-12);
  CHECK(volume.frame().space == AnatomicalSpace::lps);
  // No places at all: the order of the instances.
  series = series_without({kPosition, kDirections});
  CHECK(read_message(series).ends_with(
      "does not tell the distance of its slices (SpacingBetweenSlices): --spacing SX,SY,SZ gives "
      "it"));
  volume = read_volume(series, given, &log);
  CHECK(is_reversed(volume));
  CHECK(volume.spacing() == Vec3{2, 3, 4});
  CHECK(volume.frame().space == AnatomicalSpace::unknown);
  CHECK(has_note("has no positions of its slices: they are read in the order of their Instance"));
  CHECK(has_note("does not tell its position and orientation"));
  // Numbers that not all have, or that are not different, order nothing.
  for (const char* number : {"", "19"}) {
    series = write_series(folder, truth, {}, [&](int k, DicomElements& elements) {
      for (const std::uint32_t tag : {kPosition, kDirections}) elements.erase(tag);
      elements[kNumber] = {"IS", k == 3 ? number : text(20 - k)};
    });
    log = {};
    read_volume(series, given, &log);
    CHECK(has_note("they are read in the order of their files' names"));
  }
  for (const std::uint32_t tag : {kDistance, kThickness}) {
    log = {};
    volume =
        read_volume(series_without({kPosition, kDirections}, {{tag, {"DS", "2.5"}}}), {}, &log);
    CHECK(is_reversed(volume));
    CHECK(distance(volume.spacing(), {0.5, 1.25, 2.5}) < 1e-12);
    CHECK(has_note("it is taken to be their thickness, 2.5") == (tag == kThickness));
  }
  // Directions, but no positions.
  log = {};
  volume = read_volume(series_without({kPosition}, {{kDistance, {"DS", "3"}}}), {}, &log);
  CHECK(is_reversed(volume));
  CHECK(distance(volume.frame().axes[2], truth.axes[2]) < 1e-12);
  CHECK(has_note("does not tell its position: "));
  // Locations along the normal.
  log = {};
  series = write_series(folder, truth, {}, [&](int k, DicomElements& elements) {
    elements.erase(kPosition);
    elements[kLocation] = {"DS", text(7 + 1.5 * k)};
  });
  volume = read_volume(series, {}, &log);
  CHECK(bytes_of_samples(volume) == truth.bytes);
  CHECK(volume.spacing().z == doctest::Approx(1.5));
  CHECK(has_note("they are placed by SliceLocation"));
  // Positions without directions are along z, as those of most scans; others are not looked at.
  Truth axial = truth;
  axial.axes = Frame().axes;
  series = write_series(folder, axial, {},
                        [&](int, DicomElements& elements) { elements.erase(kDirections); });
  volume = read_volume(series);
  CHECK(bytes_of_samples(volume) == truth.bytes);
  CHECK(distance(volume.frame().origin, truth.origin) < 1e-12);
  CHECK(volume.frame().space == AnatomicalSpace::unknown);
  // They stand upright, as far apart as their positions are.
  axial.axes[2] = {0, 0.6, 0.8};
  series = write_series(folder, axial, {},
                        [&](int, DicomElements& elements) { elements.erase(kDirections); });
  volume = read_volume(series);
  CHECK(bytes_of_samples(volume) == truth.bytes);
  CHECK(distance(volume.spacing(), truth.spacing) < 1e-9);
  CHECK(volume.frame().axes == Frame().axes);
  CHECK(is_reversed(read_volume(series_without({kDirections}, {{kThickness, {"DS", "3"}}}))));
  // Frames of one file.
  DicomElements frames = dicom_image(truth, {.place = DicomForm::Place::stack}, 0, kSlices);
  for (const std::uint32_t tag : {kPosition, kDirections, kSpacing, kDistance}) frames.erase(tag);
  const std::string file = folder.write("v.dcm", dicom_file({}, frames));
  CHECK(read_message(file) == "v.dcm: has no valid PixelSpacing: --spacing SX,SY,SZ gives it");
  volume = read_volume(file, given);
  CHECK(bytes_of_samples(volume) == truth.bytes);
  CHECK(volume.spacing() == Vec3{2, 3, 4});
}

TEST_CASE("bytes behind the samples are noted, and not read") {
  const TemporaryFolder folder;
  const Truth truth = oblique_truth(SampleType::i16);
  for (const std::size_t padding : {2, 128}) {
    ReadLog log;
    const std::string series = write_series(folder, truth, {}, [&](int k, DicomElements& elements) {
      if (k >= 3) elements[0x7fe00010].value.append(padding, '\x7f');
    });
    CHECK(bytes_of_samples(read_volume(series, {}, &log)) == truth.bytes);
    REQUIRE(log.notes.size() == 1);
    CHECK(log.notes[0].words.ends_with(text("'a' and 1 more have up to ", padding,
                                            " bytes behind the samples, which are not read")));
  }
}

TEST_CASE("an image that is there twice is left out, and told") {
  const TemporaryFolder folder;
  const Truth truth = oblique_truth(SampleType::i16);
  const std::string series = write_series(folder, truth, {}, [](int k, DicomElements& elements) {
    elements[0x00080018] = {"UI", text("1.2.", k)};
  });
  std::filesystem::copy(series + "/a", series + "/copy of a");
  ReadLog log;
  CHECK(bytes_of_samples(read_volume(series, {}, &log)) == truth.bytes);
  REQUIRE(log.notes.size() == 1);
  CHECK(text_of(log.notes[0])
            .ends_with("series: left out 'copy of a', the same image (SOPInstanceUID) as 'a'"));
  std::filesystem::copy(series + "/b.dcm", series + "/copy of b");
  read_volume(series, {}, &log);
  CHECK(log.notes[1].words.ends_with("as 'a', and 1 more copies"));
  // Programs that give all images one name write others all the same.
  CHECK(bytes_of_samples(read_volume(write_series(folder, truth, {}, [](int, DicomElements& e) {
          e[0x00080018] = {"UI", "1.2"};
        }))) == truth.bytes);
}

// "has the same place as" was all that was said of phases, and --time was refused.
TEST_CASE("slices at one place are of several times, which --time chooses") {
  const TemporaryFolder folder;
  constexpr int kTimes = 3;
  struct Case {
    const char* name;
    std::uint32_t tag;
    const char* vr;
    // The value at a time and a slice.
    std::string (*value)(int time, int slice);
  };
  const auto by_time = [](int t, int) { return text(10 + t); };
  const Case cases[] = {
      {"TemporalPositionIdentifier", 0x00200100, "IS", by_time},
      {"EchoTime", 0x00180081, "DS", [](int t, int) { return text(2.5 * (t + 1)); }},
      {"DiffusionBValue", 0x00189087, "FD",
       [](int t, int) { return little(std::bit_cast<std::uint64_t>(500.0 * t), 8); }},
      {"AcquisitionNumber", 0x00200012, "IS", by_time},
      {"TriggerTime", 0x00181060, "DS", [](int t, int k) { return text(40.5 * t + 0.25 * k); }},
      {"AcquisitionTime", 0x00080032, "TM",
       [](int t, int k) { return text(120000 + 10 * t + k, ".25"); }},
      {"InstanceNumber", 0x00200013, "IS", [](int t, int k) { return text(k + kSlices * t); }}};
  for (const Case& each : cases) {
    CAPTURE(each.name);
    std::vector<Truth> truths;
    std::filesystem::remove_all(folder.path("phases"));
    std::filesystem::create_directories(folder.path("phases"));
    for (int t = 0; t < kTimes; ++t) {
      truths.push_back(oblique_truth(SampleType::i16));
      truths[static_cast<std::size_t>(t)].bytes =
          random_truth(SampleType::i16, truths[0].dims, 50 + static_cast<std::uint64_t>(t)).bytes;
      for (int k = 0; k < kSlices; ++k) {
        DicomElements elements = dicom_image(truths.back(), {}, k, 1);
        elements[each.tag] = {each.vr, each.value(t, k)};
        // The names are in another order.
        folder.write(text("phases/", (7 * t + 3 * k) % 5, "-", kTimes - t, "-", k),
                     dicom_file({}, elements));
      }
    }
    const std::string path = folder.path("phases");
    CHECK(read_message(path) ==
          text("phases: has 3 times: --time N chooses one, counted from 1, in the order of their ",
               each.name));
    CHECK_THROWS_AS(read_volume(path), SeveralVolumes);
    ReadOptions options;
    for (int t = 0; t < kTimes; ++t) {
      options.time = t + 1;
      ReadLog log;
      CHECK(bytes_of_samples(read_volume(path, options, &log)) ==
            truths[static_cast<std::size_t>(t)].bytes);
      CHECK(log.notes.empty());
    }
    options.time = 4;
    CHECK(read_message(path, options) == "phases: has 3 times, and no time 4");
    std::filesystem::remove(path + "/0-3-0");
    CHECK(read_message(path).find("has a place (ImagePositionPatient) with 2 slices, where others "
                                  "have 3") != std::string::npos);
  }
  // Frames of one file.
  Truth truth = oblique_truth(SampleType::u8);
  truth.bytes += random_truth(SampleType::u8, truth.dims, 8).bytes;
  DicomElements frames = dicom_image(truth, {}, 0, 2 * kSlices);
  std::vector<DicomElements> groups;
  for (int n = 0; n < 2 * kSlices; ++n) {
    const Vec3 place = truth.origin + n % kSlices * truth.step(2);
    groups.push_back(
        {{0x00209111, dicom_sequence({}, {{{0x00209128, {"UL", little(n < kSlices ? 2 : 1, 4)}}}})},
         {0x00209113, dicom_sequence({}, {{{0x00200032, dicom_vector(place)}}})}});
  }
  frames[0x52009230] = dicom_sequence({}, groups);
  const std::string file = folder.write("v.dcm", dicom_file({}, frames));
  CHECK(read_message(file) ==
        "v.dcm: has 2 times: --time N chooses one, counted from 1, in the order of their "
        "TemporalPositionIdentifier");
  ReadOptions options;
  for (const int time : {1, 2}) {
    options.time = time;
    CHECK(bytes_of_samples(read_volume(file, options)) ==
          truth.bytes.substr(time == 1 ? 60 : 0, 60));
  }
  // A volume of one time has no second one.
  options.time = 2;
  CHECK(read_message(write_series(folder, oblique_truth(SampleType::u8)), options) ==
        "series: has 1 time, and no time 2");
}

TEST_CASE("a picture in color, or one slice that is a mosaic, is told before what it lacks") {
  const TemporaryFolder folder;
  const Truth truth = oblique_truth(SampleType::u8);
  DicomElements frames = dicom_image(truth, {.place = DicomForm::Place::stack}, 0, kSlices);
  frames.erase(0x00180088);
  frames[0x00280004] = {"CS", "RGB"};
  CHECK(read_message(folder.write("v.dcm", dicom_file({}, frames))) ==
        "v.dcm: is in color ('RGB'): only grayscale can be meshed");
  DicomElements mosaic = dicom_image(truth, {}, 0, 1);
  mosaic[0x00080008] = {"CS", "ORIGINAL\\PRIMARY\\MOSAIC"};
  CHECK(read_message(folder.write("v.dcm", dicom_file({}, mosaic)))
            .starts_with("v.dcm: is a mosaic, as Siemens writes it"));
  // It was read as a volume of mosaics, one for each time.
  DicomElements grid = dicom_image(truth, {}, 0, 1);
  const auto message = [&](const char* owner, const char* slices) {
    grid[0x00650010] = {"LO", owner};
    grid[0x00651050] = {"DS", slices};
    return read_message(folder.write("v.dcm", dicom_file({}, grid)));
  };
  CHECK(message("Image Private Header", "20") ==
        "v.dcm: is a mosaic, as United Imaging writes it: all slices in one picture. Convert the "
        "series with 'dcm2niix -o . FOLDER'");
  for (const auto& [owner, slices] :
       {std::pair{"Image Private Header", "1"}, {"Image Private Header", ""}, {"Another", "20"}}) {
    CHECK(message(owner, slices).find("mosaic") == std::string::npos);
  }
}

TEST_CASE("a file of several frames says where they are") {
  const TemporaryFolder folder;
  const Truth truth = oblique_truth(SampleType::u8);
  using Place = DicomForm::Place;
  const auto with = [&](Place place, std::uint32_t tag, const DicomElement& element) {
    const DicomForm form{.place = place};
    DicomElements elements = dicom_image(truth, form, 0, kSlices);
    elements[tag] = element;
    return read_message(folder.write("v.dcm", dicom_file(form, elements)));
  };
  CHECK(with(Place::stack, 0x00180088, {"DS", "3"}) == "");
  CHECK(with(Place::stack, 0x00180088, {"DS", ""}) ==
        "v.dcm: does not tell the distance of its frames (SpacingBetweenSlices): --spacing "
        "SX,SY,SZ gives it");
  CHECK(with(Place::offsets, 0x3004000c, {"DS", "0\\3\\6\\9"}) ==
        "v.dcm: has the offsets of 4 frames, and 5 frames");
  CHECK(with(Place::offsets, 0x3004000c, {"DS", "0\\3\\6\\9\\9"}) ==
        "v.dcm, frame 5: has the same place (ImagePositionPatient) as frame 4");
  CHECK(with(Place::shared, 0x52009230, dicom_sequence({}, {{}, {}})) ==
        "v.dcm: has the places of 2 frames, and 5 frames");
  CHECK(with(Place::shared, 0x52009229, dicom_sequence({}, {})) ==
        "v.dcm: has no valid PixelSpacing: --spacing SX,SY,SZ gives it");
  CHECK(with(Place::shared, 0x00280008, {"IS", "2147483647"}).find("bytes of samples") !=
        std::string::npos);
  // Frames run along the negative normal.
  DicomForm form{.place = Place::stack};
  DicomElements elements = dicom_image(truth, form, 0, kSlices);
  elements[0x00280004] = {"CS", "MONOCHROME1"};
  elements[0x3004000e] = {"DS", "0.5"};  // the unit of a dose
  ReadLog log;
  const Volume half = read_volume(folder.write("v.dcm", dicom_file(form, elements)), {}, &log);
  CHECK(half.sample(1, 0, 0) == 0.5 * static_cast<std::uint8_t>(truth.bytes[1]));
  REQUIRE(log.notes.size() == 2);
  CHECK(log.notes[0].words.find("they are kept as stored") != std::string::npos);
  elements = dicom_image(truth, form, 0, kSlices);
  elements[0x00180088] = {"DS", "-3"};
  const Volume back = read_volume(folder.write("v.dcm", dicom_file(form, elements)));
  CHECK(distance(back.frame().origin, truth.origin - 4 * truth.step(2)) < 1e-12);
  CHECK(distance(back.frame().axes[2], truth.axes[2]) < 1e-12);
  CHECK(back.sample(1, 2, 0) ==
        static_cast<std::uint8_t>(truth.bytes[static_cast<std::size_t>(1 + 4 * (2 + 3 * 4))]));
  // Sequences within sequences end somewhere.
  form.has_lengths = false;
  DicomElement nested = dicom_sequence(form, {{}});
  for (int n = 0; n < 100; ++n) nested = dicom_sequence(form, {{{0x00081140, nested}}});
  elements = dicom_image(truth, form, 0, kSlices);
  elements[0x00081140] = nested;
  CHECK(read_message(folder.write("v.dcm", dicom_file(form, elements))).find("is damaged") !=
        std::string::npos);
}
