// SPDX-License-Identifier: MIT
// What TIFF stacks say of themselves. Their encodings are among the forms of test_read_volume.
#include <doctest/doctest.h>

#include <string>

#include "io/files/lzw.h"
#include "io/files/packbits.h"
#include "io/volume/read_volume.h"
#include "read_fault.h"
#include "volume_files.h"

using namespace deliso;
using namespace deliso::test;

namespace {

Truth tiff_truth(SampleType type = SampleType::u8) {
  return random_truth(type, {5, 4, 3}, 5);
}

template <class Unpack>
std::string unpacked(Unpack unpack, const std::string& packed, std::size_t room) {
  std::string out(room, '\0');
  out.resize(unpack(std::as_bytes(std::span(packed)), std::as_writable_bytes(std::span(out))));
  return out;
}

}  // namespace

TEST_CASE("samples of other sizes than bytes are unpacked") {
  const TemporaryFolder folder;
  Random random(5);
  for (const int bits : {1, 2, 4, 7, 10, 12, 15}) {
    for (const TiffForm& form :
         {TiffForm{}, TiffForm{.order = std::endian::big, .compression = 5}, TiffForm{.tile = 4}}) {
      CAPTURE(bits);
      const Truth truth = tiff_truth();  // of three pages of 5 x 4
      std::vector<TiffPage> pages = tiff_pages(truth, form);
      std::vector<unsigned> samples(60);
      for (unsigned& sample : samples) sample = random.below(1u << bits);
      const int width = form.tile > 0 ? form.tile : 5;
      for (int k = 0; k < 3; ++k) {
        TiffPage& page = pages[static_cast<std::size_t>(k)];
        page.tags[258] = tiff_value(form, static_cast<std::uint64_t>(bits), 3);
        const int height = form.tile > 0 ? form.tile : form.rows_per_strip;
        std::size_t block = 0;
        for (int y0 = 0; y0 < 4; y0 += height) {
          for (int x0 = 0; x0 < 5; x0 += width) {
            std::string packed;
            for (int y = y0; y < y0 + height && (form.tile > 0 || y < 4); ++y) {
              std::string row(static_cast<std::size_t>((width * bits + 7) / 8), '\0');
              for (int x = x0; x < std::min(x0 + width, 5); ++x) {
                const unsigned sample = samples[static_cast<std::size_t>(x + 5 * (y + 4 * k))];
                for (int bit = 0; bit < bits; ++bit) {
                  const auto at = static_cast<std::size_t>((x - x0) * bits + bit);
                  row[at / 8] = static_cast<char>(row[at / 8] | (sample >> (bits - 1 - bit) & 1U)
                                                                    << (7 - at % 8));
                }
              }
              packed += row;
            }
            page.blocks[block++] = form.compression == 5 ? lzw(packed) : packed;
          }
        }
      }
      const Volume volume = read_volume(folder.write("v.tif", tiff_file(form, pages)));
      CHECK(volume.type() == (bits <= 8 ? SampleType::u8 : SampleType::u16));
      std::size_t wrong = 0;
      for (std::size_t n = 0; n < samples.size(); ++n) {
        const int at = static_cast<int>(n);
        wrong += volume.sample(at % 5, at / 5 % 4, at / 20) != samples[n];
      }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("slices that ImageJ calls channels are slices") {
  const TemporaryFolder folder;
  const Truth truth = tiff_truth();
  for (const std::string word : {"channels", "frames"}) {
    std::vector<TiffPage> pages = tiff_pages(truth);
    pages[0].tags[270] = tiff_text("ImageJ=1.11a\nimages=3\n" + word + "=3\nhyperstack=true\n");
    ReadLog log;
    const Volume volume = read_volume(folder.write("v.tif", tiff_file({}, pages)), {}, &log);
    CHECK(bytes_of_samples(volume) == truth.bytes);
    REQUIRE(log.notes.size() == 1);
    CHECK(log.notes[0].words.ends_with((word == "frames" ? "3 times" : "3 channels") +
                                       std::string(" of one slice are taken as slices")));
  }
}

TEST_CASE("LZW and PackBits give back what was packed, and nothing beyond") {
  std::string all;
  Random random(3);
  for (int n = 0; n < 20000; ++n) {
    const std::uint32_t alphabet = n < 10000 ? 2 : 256;
    all.append(1 + (random.below(50) == 0 ? 400 : 0), static_cast<char>(random.below(alphabet)));
  }
  for (const std::size_t size : {0, 1, 2, 130, 5000, 40000}) {
    const std::string bytes = all.substr(0, size);
    CHECK(unpacked(unpack_lzw, lzw(bytes), size + 9) == bytes);
    CHECK(unpacked(unpack_bits, pack_bits(bytes), size + 9) == bytes);
    CHECK(unpacked(unpack_lzw, lzw(bytes), size / 2) == bytes.substr(0, size / 2));
    CHECK(unpacked(unpack_bits, pack_bits(bytes), size / 2) == bytes.substr(0, size / 2));
    CHECK(largest_of_lzw(lzw(bytes).size()) >= size);
  }
  CHECK(unpacked(unpack_lzw, lzw(all), all.size()) == all);
  const std::string constant(1u << 20, 'x');
  CHECK(unpacked(unpack_lzw, lzw(constant), constant.size()) == constant);
  CHECK(largest_unpacked(pack_bits(constant).size()) == constant.size());
  // The first code is a string that no code made; 128 in PackBits is no run.
  CHECK(unpacked(unpack_lzw, "\x81\x80", 9) == "");
  CHECK(unpacked(unpack_bits, std::string("\x80\xff\x41\x00\x42\x05\x43", 7), 9) == "AABC");
}

TEST_CASE("ImageJ's spacing, unit and signed samples") {
  const TemporaryFolder folder;
  const Truth truth = tiff_truth(SampleType::u16);
  const TiffForm form{.order = std::endian::big, .rows_per_strip = 4};
  const auto read = [&](const std::string& lines, bool has_resolution, ReadLog& log) {
    std::vector<TiffPage> pages = tiff_pages(truth, form);
    pages[0].tags[270] = tiff_text("ImageJ=1.53t\nimages=3\nslices=3\n" + lines);
    if (has_resolution) {
      pages[0].tags[282] = tiff_ratio(form, 40, 10);
      pages[0].tags[283] = tiff_ratio(form, 5, 10);
      pages[0].tags[296] = tiff_value(form, 1, 3);
    }
    return read_volume(folder.write("v.tif", tiff_file(form, pages)), {}, &log);
  };
  ReadLog log;
  CHECK(read("", false, log).spacing() == Vec3{1, 1, 1});
  CHECK(read("spacing=2.5\n", false, log).spacing() == Vec3{1, 1, 2.5});
  CHECK(read("spacing=-2.5\n", false, log).spacing() == Vec3{1, 1, 2.5});
  CHECK(log.notes.empty());
  CHECK(read("unit=micron\nspacing=2.5\n", true, log).spacing() == Vec3{0.25, 2, 2.5});
  REQUIRE(log.notes.size() == 1);
  CHECK(log.notes[0].words.ends_with("the spacing is in 'micron', as ImageJ has it"));
  CHECK(read("unit=micron\nyunit=nm\nspacing=2.5\nzunit=mm\n", true, log).spacing() ==
        Vec3{0.25, 0.002, 2500});
  CHECK_THROWS_AS(read("unit=micron\nzunit=plane\n", true, log), InputError);
  CHECK(read_fault(folder.path("v.tif")) ==
        "its axes have different units, and zunit is 'plane': --spacing X,Y,Z gives the distances");
  CHECK(bytes_of_samples(read("", true, log)) == truth.bytes);
  const Volume is_signed = read("cf=0\nc0=-32768.0\nc1=1.0\nvunit=Gray Value\n", false, log);
  const Volume plain = read("cf=20\n", false, log);
  CHECK(is_signed.type() == SampleType::f32);
  CHECK(is_signed.sample(2, 3, 1) == plain.sample(2, 3, 1) - 32768);
}

// A file's text went to the terminal with its control characters, 3,000 characters of it and more.
TEST_CASE("a note is one line of bounded length") {
  const TemporaryFolder folder;
  const std::string unit = "\x1b[31m\a\r\nEVIL" + std::string(3000, 'x');
  for (const std::string& description :
       {"ImageJ=1.53t\nimages=3\nunit=" + unit + "\n",
        "<OME><Pixels PhysicalSizeX=\"1\" PhysicalSizeY=\"1\" PhysicalSizeZ=\"1\" "
        "PhysicalSizeXUnit=\"" +
            unit + "\" PhysicalSizeYUnit=\"" + unit + "\" PhysicalSizeZUnit=\"" + unit +
            "\"/></OME>"}) {
    std::vector<TiffPage> pages = tiff_pages(tiff_truth());
    pages[0].tags[270] = tiff_text(description);
    ReadLog log;
    read_volume(folder.write("v\x1b\n.tif", tiff_file({}, pages)), {}, &log);
    REQUIRE(log.notes.size() == 1);
    CHECK(log.notes[0].words.find("?[31m?") != std::string::npos);
    CHECK(text_of(log.notes[0]).find("v??.tif: ") != std::string::npos);
    CHECK(log.notes[0].words.size() < 600);
    CHECK(std::ranges::none_of(text_of(log.notes[0]), [](char c) { return c >= 0 && c < ' '; }));
  }
}

TEST_CASE("ImageJ's pages behind the first") {
  const TemporaryFolder folder;
  const Truth truth = tiff_truth(SampleType::i16);
  const TiffForm form{.order = std::endian::big, .rows_per_strip = 4};
  // One page; its only strip goes on with the samples of the others.
  const auto file = [&](const std::string& images, const std::string& samples) {
    TiffPage page = tiff_page(truth, form, 0);
    page.blocks[0] = samples;
    page.tags[279] = tiff_value(form, 40);
    page.tags[270] = tiff_text("ImageJ=1.53t\nimages=" + images + "\nslices=3\n");
    return folder.write("v.tif", tiff_file(form, {page}));
  };
  const std::string samples = truth.in_order(form.order);
  const Volume volume = read_volume(file("3", samples));
  REQUIRE(volume.dims() == truth.dims);
  CHECK(bytes_of_samples(volume) == truth.bytes);
  CHECK(read_fault(file("1", samples)) ==
        "has one page: give the folder of the slices, if each has a file");
  CHECK(read_fault(file("300", samples)).starts_with("data is too short: 5 x 4 x 300 int16"));
  CHECK(read_fault(file("99999999999", samples)).find("are too many") != std::string::npos);
  CHECK(read_fault(file("3\nchannels=3", samples)) ==
        "has 3 channels: --channel N chooses one, counted from 1");
  TiffForm packed = form;
  packed.compression = 32773;
  TiffPage page = tiff_page(truth, packed, 0);
  page.tags[270] = tiff_text("ImageJ=1.53t\nimages=3\n");
  CHECK(read_fault(folder.write("v.tif", tiff_file(packed, {page}))) ==
        "has one page, and ImageJ's others are not behind it");
}

TEST_CASE("OME's spacing") {
  const TemporaryFolder folder;
  const Truth truth = tiff_truth();
  const auto file = [&](const std::string& attributes) {
    std::vector<TiffPage> pages = tiff_pages(truth);
    pages[0].tags[270] = tiff_text("<?xml version=\"1.0\"?><OME><Image><Pixels ID=\"1\" " +
                                   attributes + "><Channel/></Pixels></Image></OME>");
    return folder.write("v.tif", tiff_file({}, pages));
  };
  const std::string sizes = "PhysicalSizeX=\"0.5\" PhysicalSizeY=\"0.25\" ";
  CHECK(read_volume(file("SizeC=\"1\" " + sizes + "PhysicalSizeZ=\"2\"")).spacing() ==
        Vec3{0.5, 0.25, 2});
  CHECK(read_volume(file(sizes)).spacing() == Vec3{1, 1, 1});

  // A unit for each axis was read as if it were that of x.
  const auto with_units = [&](const std::string& x, const std::string& y, const std::string& z) {
    const auto unit = [](const std::string& axis, const std::string& name) {
      return name.empty() ? "" : " PhysicalSize" + axis + "Unit=\"" + name + "\"";
    };
    return file("PhysicalSizeX=\"700\" PhysicalSizeY=\".9\" PhysicalSizeZ=\".0013\"" +
                unit("X", x) + unit("Y", y) + unit("Z", z));
  };
  const auto near = [](const Vec3& a, const Vec3& b) {
    return distance(a, b) <= 1e-15 * length(b);
  };
  ReadLog log;
  CHECK(near(read_volume(with_units("nm", "\u00b5m", "mm"), {}, &log).spacing(), {700, 900, 1300}));
  REQUIRE(log.notes.size() == 1);
  CHECK(log.notes[0].words.ends_with("the spacing is in 'nm', as OME has it"));
  CHECK(near(read_volume(with_units("nm", "", "mm")).spacing(), {700, 900, 1300}));
  CHECK(near(read_volume(with_units("", "", "m")).spacing(), {700, 0.9, 1300}));
  CHECK(read_volume(with_units("ell", "ell", "ell")).spacing() == Vec3{700, 0.9, 0.0013});
  CHECK(
      read_fault(with_units("nm", "pixel", "mm")) ==
      "its axes have different units, and PhysicalSizeYUnit is 'pixel': --spacing X,Y,Z gives the "
      "distances");
  CHECK(read_fault(with_units("ell", "", ""))
            .starts_with("its axes have different units, and "
                         "PhysicalSizeXUnit is 'ell'"));
  ReadOptions options;
  options.spacing = Vec3{3, 2, 1};
  CHECK(read_volume(file(sizes + "PhysicalSizeZ=\"2\""), options).spacing() == Vec3{3, 2, 1});
  CHECK(read_volume(with_units("ell", "nm", "nm"), options).spacing() == Vec3{3, 2, 1});
}

TEST_CASE("a resolution without the distance of pages is noted, and white zeros") {
  const TemporaryFolder folder;
  std::vector<TiffPage> pages = tiff_pages(tiff_truth());
  pages[0].tags[282] = pages[0].tags[283] = tiff_ratio({}, 300, 1);
  ReadLog log;
  CHECK(read_volume(folder.write("v.tif", tiff_file({}, pages)), {}, &log).spacing() ==
        Vec3{1, 1, 1});
  REQUIRE(log.notes.size() == 1);
  CHECK(log.notes[0].words.find("--spacing gives another distance") != std::string::npos);
  for (TiffPage& page : pages) page.tags[262] = tiff_value({}, 0, 3);
  const Volume volume = read_volume(folder.write("v.tif", tiff_file({}, pages)), {}, &log);
  CHECK(bytes_of_samples(volume) == tiff_truth().bytes);
  CHECK(log.notes.back().words.find("(WhiteIsZero)") != std::string::npos);
}

TEST_CASE("reduced pictures and masks are no slices") {
  const TemporaryFolder folder;
  const Truth truth = tiff_truth(), reduced = random_truth(SampleType::u8, {2, 2, 3}, 6);
  std::vector<TiffPage> pages;
  for (int k = 0; k < 3; ++k) {
    pages.push_back(tiff_page(truth, {}, k));
    pages.push_back(tiff_page(reduced, {}, k));
    pages.back().tags[254] = tiff_value({}, k == 0 ? 1 : 4);
  }
  CHECK(bytes_of_samples(read_volume(folder.write("v.tif", tiff_file({}, pages)))) == truth.bytes);
}

TEST_CASE("a folder of TIFF files is a stack, in the order of the numbers in their names") {
  const TemporaryFolder folder;
  const Truth truth = random_truth(SampleType::u16, {5, 4, 12}, 5);
  const std::string slices = folder.path("slices");
  std::filesystem::create_directories(slices);
  const auto name = [](int k) { return "slices/ct" + std::to_string(k + 1) + "_a.tif"; };
  for (int k = 0; k < truth.dims.k; ++k) {
    const TiffForm form{.order = k % 2 == 0 ? std::endian::little : std::endian::big,
                        .compression = k % 3 == 0 ? 5 : 1};
    folder.write(name(k), tiff_file(form, {tiff_page(truth, form, k)}));
  }
  folder.write("slices/Thumbs.db", "no picture");
  ReadLog log;
  ReadOptions options;
  options.spacing = Vec3{1, 1, 2.5};
  const Volume volume = read_volume(slices, options, &log);
  REQUIRE(volume.dims() == truth.dims);
  CHECK(bytes_of_samples(volume) == truth.bytes);
  CHECK(volume.spacing() == Vec3{1, 1, 2.5});
  CHECK(log.files.size() == 12);
  REQUIRE(log.notes.size() == 2);
  CHECK(log.notes[0].words.ends_with("passed over 'Thumbs.db': no TIFF images"));
  CHECK(log.notes[1].words.ends_with("12 slices, from 'ct1_a.tif' to 'ct12_a.tif'"));

  const auto fault_of_slice = [&](const std::string& content) {
    folder.write(name(4), content);
    const std::string message = read_message(slices), start = name(4) + ": ";
    REQUIRE((message.empty() || message.starts_with(start)));
    return message.substr(std::min(message.size(), start.size()));
  };
  const TiffPage page = tiff_page(truth, {}, 4);
  CHECK(fault_of_slice(tiff_file({}, {page, page})) ==
        "has 2 pages: in a folder of slices each file has one");
  CHECK(fault_of_slice(
            tiff_file({}, {tiff_page(random_truth(SampleType::u16, {5, 3, 1}, 5), {}, 0)})) ==
        "its page has 5 x 3 samples, and ct1_a.tif 5 x 4");
  CHECK(fault_of_slice(
            tiff_file({}, {tiff_page(random_truth(SampleType::i16, {5, 4, 1}, 5), {}, 0)})) ==
        "its page has samples of another type than ct1_a.tif");
  const std::string whole = tiff_file({}, {page});
  CHECK(fault_of_slice(whole.substr(0, whole.size() - 4))
            .starts_with("is damaged, or ends too early"));
  CHECK(fault_of_slice(whole) == "");
  for (int k = 1; k < truth.dims.k; ++k) std::filesystem::remove(folder.path(name(k)));
  CHECK(read_fault(slices) == "has one slice only");
}

TEST_CASE("samples in one piece are mapped, not copied") {
  const TemporaryFolder folder;
  const std::string path = folder.write("v.tif", tiff(tiff_truth(), {}));
  const Volume volume = read_volume(path);
  const double before = volume.sample(0, 0, 0);
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(8);
    file.put(static_cast<char>(static_cast<int>(before) ^ 1));
  }
  CHECK(volume.sample(0, 0, 0) == static_cast<double>(static_cast<int>(before) ^ 1));
}

TEST_CASE("each fault of a TIFF file has its message") {
  const TemporaryFolder folder;
  const Truth truth = tiff_truth();
  // Page 2 of three with another value of a tag.
  const auto with = [&](int tag, std::uint64_t value, const TiffForm& form = {}, int page = 1) {
    std::vector<TiffPage> pages = tiff_pages(truth, form);
    for (int k = page; k < (page == 0 ? 3 : page + 1); ++k) {
      pages[static_cast<std::size_t>(k)].tags[tag] = tiff_value(form, value);
    }
    return read_fault(folder.write("v.tif", tiff_file(form, pages)));
  };
  CHECK(with(256, 5) == "");
  CHECK(with(256, 6) == "page 2 has 6 x 4 samples, and page 1 5 x 4");
  CHECK(with(257, 5) == "page 2 has 5 x 5 samples, and page 1 5 x 4");
  CHECK(with(258, 16) == "page 2 has samples of another type than page 1");
  CHECK(with(339, 2) == "page 2 has samples of another type than page 1");
  CHECK(with(259, 7) == "is compressed (JPEG): convert it with 'tiffcp -c zip IN OUT'");
  CHECK(with(259, 34712).starts_with("is compressed (JPEG 2000)"));
  CHECK(with(259, 77).starts_with("is compressed in a way that is not read (77)"));
  CHECK(with(266, 2) == "its bits are stored in reverse (FillOrder 2)");
  CHECK(with(278, 0) == "page 2 has strips or tiles of an impossible size");
  CHECK(with(322, 0, {.tile = 4}) == "page 2 has strips or tiles of an impossible size");
  CHECK(with(322, 4294967295, {.tile = 4}) == "page 2 has strips or tiles of an impossible size");
  CHECK(with(322, 2147483647, {.tile = 4}).starts_with("is damaged"));
  CHECK(with(317, 3, {.compression = 8}) == "predictor 3 is not known for its samples");
  CHECK(with(273, 4000).starts_with("is damaged, or ends too early"));
  CHECK(with(279, 4000, {.rows_per_strip = 4, .compression = 8}).starts_with("is damaged"));
  CHECK(with(279, 1, {.rows_per_strip = 4, .compression = 5})
            .starts_with("compressed data is damaged: "));
  CHECK(with(262, 2, {}, 0) == "is in color (RGB): only grayscale can be meshed");
  CHECK(with(262, 3, {}, 0) == "is in color (a palette): only grayscale can be meshed");
  CHECK(with(277, 2, {}, 0) == "has 2 samples per pixel: only grayscale can be meshed");
  CHECK(with(258, 24, {}, 0).starts_with("its samples are unsigned integers of 24 bits"));
  CHECK(with(317, 2, {.compression = 8}, 0) == "");
  CHECK(with(339, 6, {}, 0).starts_with("its samples are complex numbers of 8 bits"));
  CHECK(with(256, 4294967295, {}, 0) == "2147483648 samples along x are too many");
  CHECK(with(256, 1, {}, 0) == "1 samples along x: a volume needs two or more along each axis");
  // A width that the data cannot have takes no memory.
  CHECK(with(256, 100000000, {.rows_per_strip = 4, .compression = 8}, 0).starts_with("is damaged"));

  // Two hundred pages of the same strip, which is most of the file.
  const Truth noise = random_truth(SampleType::u8, {200, 200, 1}, 7);
  TiffForm form{.rows_per_strip = 200, .compression = 8};
  std::vector<TiffPage> pages{tiff_page(noise, form, 0)};
  const std::size_t size = pages[0].blocks[0].size();
  pages.resize(200, pages[0]);
  for (std::size_t n = 1; n < pages.size(); ++n) {
    pages[n].blocks.clear();
    pages[n].tags[273] = tiff_value(form, 8);
    pages[n].tags[279] = tiff_value(form, size);
  }
  CHECK(read_fault(folder.write("v.tif", tiff_file(form, pages))) == "its strips or tiles overlap");

  std::string circle = tiff(truth, {});
  circle.replace(circle.size() - 4, 4, circle.substr(4, 4));
  CHECK(read_fault(folder.write("v.tif", circle)) == "its pages follow each other in a circle");
  CHECK(read_fault(folder.write("v.tif", std::string("II*\0\0\0\0\0", 8))) == "has no pages");

  // Directories of 65,535 entries at every 16th byte of 2 MB once took 22 s.
  constexpr std::size_t kEntries = 100, kStep = 16, kDirectories = 200;
  constexpr std::size_t kLink = 2 + 12 * kEntries;
  std::string overlap(8 + kDirectories * kStep + kLink + 4, '\0');
  overlap.replace(0, 8, std::string("II*\0\x8\0\0\0", 8));
  for (std::size_t n = 0; n < kDirectories; ++n) {
    overlap[8 + n * kStep] = kEntries;
    const std::size_t next = n + 1 < kDirectories ? 8 + (n + 1) * kStep : 0;
    overlap.replace(8 + n * kStep + kLink, 4, little(next, 4));
  }
  CHECK(read_fault(folder.write("v.tif", overlap)) == "its directories overlap");
}
