// SPDX-License-Identifier: MIT
// DICOM segmentations: random ones, written frame by frame, against what was drawn.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "base/text.h"
#include "io/files/temporary_folder.h"
#include "io/volume/read_fault.h"
#include "io/volume/read_volume.h"
#include "io/volume/volume_files.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr Index3 kSegDims{5, 3, 6};
constexpr std::size_t kSegFrame = 15;

// What dcmqi wrote for colors of 3D Slicer, in its public files and in its issue 563; and black.
struct KnownColor {
  std::array<std::uint16_t, 3> cielab;
  std::array<std::uint8_t, 3> srgb;
};
constexpr std::array<KnownColor, 12> kKnownColors{{{{43803, 26565, 37722}, {128, 174, 128}},
                                                   {{41661, 41167, 40792}, {221, 130, 101}},
                                                   {{37064, 44082, 41620}, {216, 101, 79}},
                                                   {{45062, 38660, 25486}, {183, 156, 220}},
                                                   {{55193, 26619, 30325}, {140, 224, 228}},
                                                   {{38399, 29410, 23264}, {0, 151, 206}},
                                                   {{34886, 53484, 50172}, {255, 0, 0}},
                                                   {{16732, 45246, 42677}, {128, 0, 0}},
                                                   {{4987, 33336, 32853}, {25, 22, 23}},
                                                   {{1797, 32896, 32896}, {10, 10, 10}},
                                                   {{65535, 32896, 32896}, {255, 255, 255}},
                                                   {{0, 32768, 32768}, {0, 0, 1}}}};

// Segments 1 to 3, or 298 to 300, with a byte for each sample. Those of "BINARY" that may not
// overlap have a sample of the first alone, so each is somewhere.
struct RandomSegments {
  RandomSegments(std::uint64_t seed, std::string of_kind, bool overlap) : kind(std::move(of_kind)) {
    Random random(seed);
    first = seed % 2 == 0 ? 1 : 298;
    if (kind != "BINARY") first = 1;
    colors = {kKnownColors[seed % 12], kKnownColors[(seed + 1) % 12]};
    for (std::string& segment : segments) segment.assign(kSegFrame * kSegDims.k, '\0');
    for (std::size_t at = 0; at < segments[0].size(); ++at) {
      const std::size_t slice = at / kSegFrame;
      if (slice == 2) continue;  // it has no frame
      for (std::size_t n = 0; n < segments.size(); ++n) {
        const bool is_free = overlap || (segments[0][at] == 0 && segments[1][at] == 0);
        if (!is_free || random.below(3) > 0) continue;
        segments[n][at] = static_cast<char>(kind == "FRACTIONAL" ? 1 + random.below(200) : 1);
      }
    }
  }

  std::string file(const DicomForm& form) const {
    const auto number = [&](std::uint64_t n) {
      return DicomElement{"US", ordered(n, 2, form.order)};
    };
    std::vector<DicomElements> named, groups;
    std::string frames;
    for (std::size_t n = 0; n < segments.size(); ++n) {
      named.push_back({{0x00620004, number(first + n)}, {0x00620005, {"LO", text("part ", n)}}});
      if (n == 2) continue;  // it has no color
      std::string triple;
      for (const std::uint16_t value : colors[n].cielab) triple += ordered(value, 2, form.order);
      named.back()[0x0062000d] = {"US", triple};
    }
    const auto add = [&](int slice, const std::string& frame,
                         std::optional<std::uint64_t> segment) {
      if (frame.find_first_not_of('\0') == frame.npos) return;
      DicomElements group{
          {0x00209113,
           dicom_sequence(form, {{{0x00200032, dicom_vector(origin + slice * step)}}})}};
      if (segment) group[0x0062000a] = dicom_sequence(form, {{{0x0062000b, number(*segment)}}});
      groups.push_back(group);
      frames += frame;
    };
    // In an order of their own.
    for (int slice = kSegDims.k; slice-- > 0;) {
      std::string labels(kSegFrame, '\0');
      for (std::size_t n = 0; n < segments.size(); ++n) {
        const std::string frame =
            segments[n].substr(kSegFrame * static_cast<std::size_t>(slice), kSegFrame);
        if (kind != "LABELMAP") add(slice, frame, first + n);
        for (std::size_t at = 0; at < kSegFrame; ++at) {
          if (frame[at] != 0) labels[at] = static_cast<char>(first + n);
        }
      }
      if (kind == "LABELMAP") add(slice, labels, std::nullopt);
    }
    std::string data = frames;
    const bool is_binary = kind == "BINARY";
    if (is_binary) {
      data.assign(frames.size() / 8 + 1, '\0');
      for (std::size_t at = 0; at < frames.size(); ++at) {
        data[at / 8] = static_cast<char>(data[at / 8] | frames[at] << at % 8);
      }
    }
    return dicom_file(
        form,
        {{0x00080008, {"CS", "DERIVED"}},
         {0x0020000e, {"UI", "1.2.3"}},
         {0x00280002, number(1)},
         {0x00280004, {"CS", "MONOCHROME2"}},
         {0x00280008, {"IS", text(groups.size())}},
         {0x00280010, number(kSegDims.j)},
         {0x00280011, number(kSegDims.i)},
         {0x00280100, number(is_binary ? 1 : 8)},
         {0x00280101, number(is_binary ? 1 : 8)},
         {0x00280102, number(is_binary ? 0 : 7)},
         {0x00280103, number(0)},
         {0x00620001, {"CS", kind}},
         {0x00620002, dicom_sequence(form, named)},
         {0x52009229,
          dicom_sequence(
              form,
              {{{0x00209116,
                 dicom_sequence(form, {{{0x00200037, dicom_numbers({0.6, 0.8, 0, 0, 0, -1})}}})},
                {0x00289110,
                 dicom_sequence(form, {{{0x00280030, dicom_numbers({1.25, 0.5})}}})}}})},
         {0x52009230, dicom_sequence(form, groups)},
         {0x7fe00010, {form.is_explicit ? "OB" : "OW", data}}});
  }

  std::string kind;
  std::uint64_t first = 1;
  std::array<std::string, 3> segments;
  std::array<KnownColor, 2> colors;
  Vec3 origin{10, -20.25, 30.5}, step{-2.4, 1.8, 0};
};

}  // namespace

TEST_CASE("segmentations: every segment where it was drawn, in slices without a frame nothing") {
  const TemporaryFolder folder;
  int with_channels = 0;
  for (std::uint64_t seed = 1; seed <= 36; ++seed) {
    CAPTURE(seed);
    const std::string kind = std::array{"BINARY", "FRACTIONAL", "LABELMAP"}[seed / 2 % 3];
    const RandomSegments truth(seed, kind,
                               kind == "FRACTIONAL" || (kind == "BINARY" && seed % 4 < 2));
    DicomForm form;
    form.is_explicit = seed % 5 > 0;
    form.has_lengths = seed % 3 > 0;
    const std::string file = folder.write("seg.dcm", truth.file(form));
    const std::vector<NamedSegment> segments = read_segments(file);
    REQUIRE(segments.size() == 3);
    for (std::size_t n = 0; n < 3; ++n) {
      CHECK(segments[n].name == text("part ", n));
      REQUIRE(segments[n].color.has_value() == (n < 2));
      if (n < 2) CHECK(*segments[n].color == truth.colors[n].srgb);
      ReadOptions options;
      options.channel =
          kind == "FRACTIONAL" ? static_cast<std::int64_t>(n) + 1 : segments[n].channel;
      with_channels += options.channel > 1;
      const Volume volume = read_volume(file, options);
      REQUIRE(volume.dims() == kSegDims);
      CHECK(distance(volume.spacing(), {0.5, 1.25, 3}) < 1e-12);
      CHECK(distance(volume.frame().origin, truth.origin) < 1e-12);
      CHECK(volume.frame().space == AnatomicalSpace::lps);
      std::size_t wrong = 0;
      for (std::size_t at = 0; at < truth.segments[n].size(); ++at) {
        const double sample =
            volume.visit([&](const auto* s) { return static_cast<double>(s[at]); });
        const double drawn = static_cast<unsigned char>(truth.segments[n][at]);
        const bool is_in = sample == static_cast<double>(truth.first + n);
        wrong += kind == "FRACTIONAL" ? sample != drawn : is_in != (drawn > 0);
      }
      CHECK(wrong == 0);
    }
  }
  CHECK(with_channels > 10);
}

TEST_CASE("a segmentation of one slice, or of slices at no even steps, is refused in a line") {
  const TemporaryFolder folder;
  RandomSegments truth(2, "LABELMAP", false);
  truth.step = {};
  CHECK(read_message(folder.write("v.dcm", truth.file({}))) ==
        "v.dcm: is a segmentation of one slice");
  truth.step = {-2.4, 1.8, 0.4};
  CHECK(read_message(folder.write("v.dcm", truth.file({}))) ==
        "v.dcm: frame 1 lies aside of the lowest one");
  RandomSegments bits(6, "BINARY", false);
  std::string cut = bits.file({});
  CHECK(read_message(folder.write("v.dcm", cut.substr(0, cut.size() - 8))).starts_with("v.dcm: "));
}
