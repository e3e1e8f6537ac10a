// SPDX-License-Identifier: MIT
// Files of several channels, times or segments, and the options that choose one volume of them.
#include "io/volume/several_volumes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "base/text.h"
#include "io/volume/read_volume.h"
#include "read_fault.h"
#include "volume_files.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr Index3 kSize{3, 4, 2};

// Volumes of all channels and times.
struct Recording {
  int channels, times;
  std::vector<Truth> volumes{};

  Recording(SampleType type, int channel_count, int time_count)
      : channels(channel_count), times(time_count) {
    for (int n = 0; n < channels * times; ++n) {
      volumes.push_back(random_truth(type, kSize, 100 + static_cast<std::uint64_t>(n)));
    }
  }
  const Truth& at(int channel, int time) const {
    return volumes[static_cast<std::size_t>(time * channels + channel)];
  }
  // Returns the samples of all, in a file whose axes are the letters of `axes`, the fastest first.
  Truth together(const std::string& axes) const {
    Truth all = volumes[0];
    all.bytes.clear();
    all.channels = channels;
    all.times = times;
    all.spacing = {0.5, 1.25, 3};
    all.origin = {10, -20.25, 30.5};
    all.axes = {Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}};
    const std::map<char, int> sizes{
        {'x', kSize.i}, {'y', kSize.j}, {'z', kSize.k}, {'c', channels}, {'t', times}};
    const std::size_t size = size_of(all.type);
    for (int n = 0; n < kSize.i * kSize.j * kSize.k * channels * times; ++n) {
      std::map<char, int> place;
      int rest = n;
      for (const char axis : axes) {
        place[axis] = rest % sizes.at(axis);
        rest /= sizes.at(axis);
      }
      const int sample = place['x'] + kSize.i * (place['y'] + kSize.j * place['z']);
      all.bytes +=
          at(place['c'], place['t']).bytes.substr(static_cast<std::size_t>(sample) * size, size);
    }
    return all;
  }
};

// Every volume of the file is read, whole and in part; without a choice the file is refused.
void check_recording(const std::string& path, const Recording& recording, bool has_place) {
  const Roi roi{{1, 0, 0}, {3, 3, 2}};
  for (int time = 0; time < recording.times; ++time) {
    for (int channel = 0; channel < recording.channels; ++channel) {
      ReadOptions options;
      if (recording.channels > 1 || time > 0) options.channel = channel + 1;
      if (recording.times > 1 || channel > 0) options.time = time + 1;
      const Truth& truth = recording.at(channel, time);
      const Volume volume = read_volume(path, options);
      REQUIRE(volume.dims() == kSize);
      REQUIRE(volume.type() == truth.type);
      CHECK(bytes_of_samples(volume) == truth.bytes);
      if (has_place) {
        CHECK(distance(volume.spacing(), {0.5, 1.25, 3}) < 1e-6);
        CHECK(distance(volume.frame().origin, {10, -20.25, 30.5}) < 1e-5);
        CHECK(distance(volume.frame().axes[0], {0, 1, 0}) < 1e-6);
      }
      options.roi = roi;
      const Volume part = read_volume(path, options);
      REQUIRE(part.dims() == Index3{2, 3, 2});
      CHECK(part.sample(1, 2, 1) == volume.sample(2, 2, 1));
      CHECK(part.sample(0, 0, 0) == volume.sample(1, 0, 0));
    }
  }
  const auto count = [](int n, const char* noun) { return text(n, " ", noun, n == 1 ? "" : "s"); };
  const std::string channels = count(recording.channels, "channel");
  const std::string times = count(recording.times, "time");
  CHECK(read_fault(path, {}) ==
        (recording.times == 1 ? text("has ", channels, ": --channel N chooses one, counted from 1")
         : recording.channels == 1
             ? text("has ", times, ": --time N chooses one, counted from 1")
             : text("has ", channels, " and ", times,
                    ": --channel N and --time N choose one, counted from 1")));
  ReadOptions beyond;
  beyond.channel = recording.channels + 1;
  CHECK(read_fault(path, beyond) ==
        text("has ", channels, ", and no channel ", recording.channels + 1));
  beyond.channel = recording.channels;
  beyond.time = recording.times + 1;
  CHECK(read_fault(path, beyond) == text("has ", times, ", and no time ", recording.times + 1));
}

std::string ome(const std::string& order, int channels, int times, const std::string& inside) {
  return text("<OME><Image><Pixels DimensionOrder=\"XY", order,
              "\" SizeX=\"3\" SizeY=\"4\" SizeZ=\"", kSize.k, "\" SizeC=\"", channels,
              "\" SizeT=\"", times, "\">", inside, "</Pixels></Image></OME>");
}

// The pages of a recording whose planes are in this order, the fastest axis first.
std::vector<TiffPage> pages_of_recording(const Recording& recording, const std::string& order,
                                         const TiffForm& form) {
  const std::map<char, int> sizes{
      {'Z', kSize.k}, {'C', recording.channels}, {'T', recording.times}};
  std::vector<TiffPage> pages;
  for (int n = 0; n < kSize.k * recording.channels * recording.times; ++n) {
    std::map<char, int> place;
    int rest = n;
    for (const char axis : order) {
      place[axis] = rest % sizes.at(axis);
      rest /= sizes.at(axis);
    }
    pages.push_back(tiff_page(recording.at(place['C'], place['T']), form, place['Z']));
  }
  return pages;
}

constexpr std::pair<int, int> kCounts[] = {{3, 1}, {1, 3}, {2, 3}};

}  // namespace

TEST_CASE("a channel and a time of NRRD, MetaImage and NIfTI are those that were written") {
  const TemporaryFolder folder;
  int files = 0;
  for (const SampleType type : {SampleType::u8, SampleType::i16, SampleType::f32}) {
    for (const auto& [channels, times] : kCounts) {
      const Recording recording(type, channels, times);
      std::vector<StoredVolume> all;
      for (const std::endian order : {std::endian::little, std::endian::big}) {
        const Truth interleaved = recording.together("cxyzt"),
                    stacked = recording.together("xyztc");
        for (const char* encoding : {"raw", "gzip", "ascii"}) {
          all.push_back({"nrrd", nrrd(interleaved, order, encoding, NrrdForm::detached_skips)});
        }
        all.push_back({"nrrd", nrrd(interleaved, order, "raw", NrrdForm::detached_at_end)});
        for (const char* encoding : {"raw", "zlib", "ascii"}) {
          all.push_back({"metaimage", metaimage(interleaved, order, encoding, MetaForm::local)});
        }
        all.push_back(
            {"metaimage", metaimage(interleaved, order, "raw", MetaForm::detached_at_end)});
        for (const int version : {1, 2}) {
          for (const bool compressed : {false, true}) {
            all.push_back({"nifti", nifti(stacked, {version, order, false, compressed})});
          }
        }
      }
      for (const StoredVolume& stored : all) {
        CAPTURE(stored.label);
        check_recording(stored.write(folder), recording, true);
        ++files;
      }
    }
  }
  CHECK(files == 3 * 3 * 24);
}

TEST_CASE("a channel and a time of OME-TIFF and ImageJ are those that were written") {
  const TemporaryFolder folder;
  for (const auto& [channels, times] : kCounts) {
    const Recording recording(SampleType::u16, channels, times);
    for (const int compression : {1, 8}) {
      for (const std::endian endian : {std::endian::little, std::endian::big}) {
        const TiffForm form{.order = endian, .rows_per_strip = 4, .compression = compression};
        std::string order = "CTZ";
        do {
          CAPTURE(order);
          std::vector<TiffPage> pages = pages_of_recording(recording, order, form);
          pages[0].tags[270] = tiff_text(ome(order, channels, times, "<TiffData/>"));
          check_recording(folder.write("v.tif", tiff_file(form, pages)), recording, false);
          // The pages the other way round, told one by one.
          std::string data;
          for (std::size_t page = 0; page < pages.size(); ++page) {
            const std::size_t plane = pages.size() - 1 - page;
            std::size_t rest = plane;
            data += text("<TiffData IFD=\"", page, "\"");
            for (const char axis : order) {
              const auto size = static_cast<std::size_t>(axis == 'Z'   ? kSize.k
                                                         : axis == 'C' ? channels
                                                                       : times);
              data += text(" First", std::string(1, axis), "=\"", rest % size, "\"");
              rest /= size;
            }
            data += " PlaneCount=\"1\"><UUID>urn:uuid:1</UUID></TiffData>";
          }
          std::ranges::reverse(pages);
          pages.back().tags.erase(270);
          pages[0].tags[270] = tiff_text(ome(order, channels, times, data));
          check_recording(folder.write("v.tif", tiff_file(form, pages)), recording, false);
        } while (std::ranges::next_permutation(order).found);

        std::vector<TiffPage> pages = pages_of_recording(recording, "CZT", form);
        const std::string description =
            text("ImageJ=1.53t\nimages=", pages.size(), "\nslices=", kSize.k,
                 "\nchannels=", channels, "\nframes=", times, "\nhyperstack=true\n");
        pages[0].tags[270] = tiff_text(description);
        check_recording(folder.write("v.tif", tiff_file(form, pages)), recording, false);
        if (compression != 1) continue;
        // All samples behind one page.
        std::string samples;
        for (const TiffPage& page : pages) samples += page.blocks[0];
        TiffPage first = pages[0];
        first.blocks = {samples};
        first.tags[279] = tiff_value(form, 24);
        check_recording(folder.write("v.tif", tiff_file(form, {first})), recording, false);
      }
    }
  }
}

TEST_CASE("pages that a description does not account for are refused") {
  const TemporaryFolder folder;
  const Recording recording(SampleType::u8, 2, 1);
  ReadOptions first;
  first.channel = 1;
  const auto fault_of_pages = [&](const std::string& description, const ReadOptions& options) {
    std::vector<TiffPage> pages = pages_of_recording(recording, "ZCT", {});
    pages[0].tags[270] = tiff_text(description);
    return read_fault(folder.write("v.tif", tiff_file({}, pages)), options);
  };
  const auto with = [&](const std::string& data) {
    return fault_of_pages(ome("ZCT", 2, 1, data), first);
  };
  CHECK(fault_of_pages(ome("ZCT", 3, 1, ""), first) == "has 4 pages, and a description of 6");
  CHECK(fault_of_pages("ImageJ=1.53t\nimages=4\nslices=3\nchannels=2\n", first) ==
        "has 4 pages, and a description of 6");
  CHECK(fault_of_pages(ome("ZCC", 2, 1, ""), first) ==
        "its DimensionOrder is 'XYZCC', not XY and Z, C, T");
  CHECK(fault_of_pages(ome("ZCT", 0, 1, ""), first) == "has 0 channels, and no channel 1");
  CHECK(fault_of_pages(ome("ZCT", 2147483647, 2147483647, ""), first)
            .starts_with("has 2147483647 times: --time N chooses"));
  ReadOptions both = first;
  both.time = 1;
  for (const auto& [channels, times] : {std::pair{2147483647, 2147483647}, {2147483647, 9}}) {
    CHECK(fault_of_pages(ome("ZCT", channels, times, ""), both) != "");
  }
  const std::string beyond =
      "its TiffData are of pages that it does not have: give a file with all";
  for (const char* data :
       {"<TiffData IFD=\"4\"/>", "<TiffData IFD=\"-1\"/>", "<TiffData IFD=\"1\" PlaneCount=\"4\"/>",
        "<TiffData IFD=\"0\" FirstC=\"2\"/>", "<TiffData IFD=\"0\" FirstZ=\"99999999999999\"/>",
        "<TiffData IFD=\"0\" PlaneCount=\"4\"/><TiffData IFD=\"0\"/>",
        "<TiffData IFD=\"0\" PlaneCount=\"-1\"/>",
        "<TiffData IFD=\"99999999999999\" PlaneCount=\"9223372036854775807\"/>"}) {
    CAPTURE(data);
    CHECK(with(data) == beyond);
  }
  CHECK(with("<TiffData IFD=\"0\" PlaneCount=\"4\"/>") == "");
  std::filesystem::create_directories(folder.path("slices"));
  for (const char* name : {"slices/1.tif", "slices/2.tif"}) {
    TiffPage page = tiff_page(recording.at(0, 0), {}, 0);
    page.tags[270] = tiff_text(ome("ZCT", 2, 1, ""));
    folder.write(name, tiff_file({}, {page}));
  }
  CHECK(read_message(folder.path("slices")) ==
        "slices/1.tif: is of several channels or times: give one file that has them all");
}

TEST_CASE("a file of one volume has channel 1 and time 1, in every format") {
  const TemporaryFolder folder;
  for (const StoredVolume& stored : all_forms(random_truth(SampleType::u8, {2, 3, 4}, 1))) {
    CAPTURE(stored.label);
    const std::string path = stored.write(folder);
    ReadOptions options = stored.options;
    options.channel = options.time = 1;
    CHECK(read_fault(path, options) == "");
    const bool has_names = stored.label.starts_with("vt");
    const char* const named = "has named arrays, and no channels or times: --array names one";
    options.channel = 2;
    CHECK(read_fault(path, options) == (has_names ? named : "has 1 channel, and no channel 2"));
    options.channel.reset();
    options.time = 2;
    CHECK(read_fault(path, options) == (has_names ? named : "has 1 time, and no time 2"));
  }
  ReadOptions second;
  second.channel = 2;
  CHECK_THROWS_AS(read_volume("builtin:torus:16", second), InputError);
}

TEST_CASE("which axes of NRRD are of space") {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& fields) {
    std::string samples;
    for (int n = 0; n < 48; ++n) samples += static_cast<char>(n);
    return folder.write("v.nrrd",
                        "NRRD0004\ntype: uchar\nencoding: raw\n" + fields + "\n" + samples);
  };
  const auto first_two = [&](const std::string& fields, const ReadOptions& options) {
    const Volume volume = read_volume(write(fields), options);
    REQUIRE(volume.dims() == Index3{2, 3, 4});
    return text(volume.sample(0, 0, 0), " ", volume.sample(1, 0, 0));
  };
  ReadOptions channel, time;
  channel.channel = 2;
  time.time = 2;
  CHECK(first_two("dimension: 4\nsizes: 2 3 4 2\n", time) == "24 25");
  CHECK(first_two("dimension: 4\nsizes: 2 3 4 2\nkinds: domain domain domain list\n", channel) ==
        "24 25");
  CHECK(first_two("dimension: 4\nsizes: 2 3 4 2\nkinds: space ??? domain time\n", time) == "24 25");
  CHECK(first_two("dimension: 4\nsizes: 2 2 3 4\nkinds: vector domain domain domain\n", channel) ==
        "1 3");
  CHECK(first_two("dimension: 4\nsizes: 2 2 3 4\nspace: LPS\n"
                  "space directions: none (1,0,0) (0,1,0) (0,0,1)\n",
                  channel) == "1 3");
  CHECK(first_two("dimension: 4\nsizes: 2 2 3 4\nkinds: time domain domain domain\n", time) ==
        "1 3");
  CHECK(first_two("dimension: 5\nsizes: 2 1 3 4 2\n", time) == "24 25");
  CHECK(first_two("dimension: 4\nsizes: 2 2 3 4\nkinds: domain list domain domain\n", channel) ==
        "2 3");
  CHECK(read_fault(write("dimension: 5\nsizes: 2 2 3 2 2\n"), {}) ==
        "sizes '2 2 3 2 2' are 5-dimensional: only three-dimensional scalar volumes can be meshed");
}

TEST_CASE("Slicer's segments are those that its file names") {
  const TemporaryFolder folder;
  const std::string names =
      "Segment0_Name:=Liver\nSegment0_LabelValue:=1\nSegment0_Layer:=0\nSegment0_Color:=1 0 0\n"
      "Segment1_Name:= left kidney\nSegment1_LabelValue:=2\nSegment1_Layer:=0\n"
      "Segment2_Name:=Tumor\nSegment2_LabelValue:=1\nSegment2_Layer:=1\n";
  const std::string path =
      folder.write("v.seg.nrrd",
                   "NRRD0004\ntype: uchar\nencoding: raw\ndimension: 4\nsizes: 2 2 2 2\n"
                   "kinds: list domain domain domain\n" +
                       names + "\n0123456789abcdef");
  const std::vector<NamedSegment> segments = read_segments(path);
  REQUIRE(segments.size() == 3);
  CHECK(segments[0].color == std::array<std::uint8_t, 3>{255, 0, 0});
  CHECK(!segments[1].color);
  CHECK(segments[1].name == "left kidney");
  CHECK(segments[1].label == 2);
  CHECK(segments[1].channel == 1);
  CHECK(segments[2].label == 1);
  CHECK(segments[2].channel == 2);
  CHECK(read_fault(path, {}) ==
        "has 2 channels: --channel N chooses one, counted from 1; --label NAME chooses one of "
        "'Liver', 'left kidney', 'Tumor'");
  ReadOptions second;
  second.channel = 2;
  ReadLog log;
  CHECK(read_volume(path, second, &log).sample(0, 0, 0) == '1');
  REQUIRE(log.segments.size() == 1);
  CHECK(log.segments[0].name == "Tumor");
  REQUIRE(log.notes.size() == 1);
  CHECK(log.notes[0].words.ends_with(
      "names segments, which --label takes: 'Liver', 'left kidney', 'Tumor'"));
  // Before Slicer 4.11: a layer for each.
  const std::string old =
      folder.write("old.seg.nrrd",
                   "NRRD0004\ntype: uchar\nencoding: raw\ndimension: 4\nsizes: 2 2 2 2\n"
                   "Segment0_Name:=a\nSegment1_Name:=b\n\n0123456789abcdef");
  CHECK(read_segments(old)[1].channel == 2);
  CHECK(read_segments(old)[1].label == 1);
  CHECK(read_segments(folder.write("v.raw", "abc")).empty());
  CHECK(read_segments("-").empty());
  CHECK(read_segments("builtin:torus").empty());
}
