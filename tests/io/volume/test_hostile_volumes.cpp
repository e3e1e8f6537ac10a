// SPDX-License-Identifier: MIT
// Whatever a file holds, reading it ends with an InputError or a volume all of whose samples are
// there. Files of every form are damaged at random; the sanitizers watch.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "io/volume/read_volume.h"
#include "volume_files.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// Pieces of text that headers break on.
constexpr const char* kNasty[] = {"-1",
                                  "0",
                                  "1",
                                  "4294967297",
                                  "9223372036854775807",
                                  "1e308",
                                  "nan",
                                  "inf",
                                  "-0",
                                  "\n",
                                  ":",
                                  "=",
                                  "(",
                                  ")",
                                  "<",
                                  ">",
                                  "\"",
                                  "/",
                                  "%",
                                  " ",
                                  "99999999999999999999999",
                                  "LIST",
                                  "LOCAL",
                                  "none",
                                  "gzip",
                                  "ascii"};

void damage(std::string& content, Random& random) {
  if (content.empty()) return;
  const auto place = [&] {
    // Headers are what hurts: half of the hits go to the first 400 bytes.
    const std::size_t reach =
        random.below(2) ? content.size() : std::min<std::size_t>(content.size(), 400);
    return random.below(static_cast<std::uint32_t>(reach));
  };
  switch (random.below(8)) {
    case 0:
      content.resize(place());
      break;
    case 1:
      content.insert(place(), kNasty[random.below(std::size(kNasty))]);
      break;
    case 2: {  // replace a number
      const std::size_t at = content.find_first_of("0123456789", place());
      if (at == std::string::npos) break;
      const std::size_t end =
          std::min(content.find_first_not_of("0123456789.", at), content.size());
      content.replace(at, end - at, kNasty[random.below(std::size(kNasty))]);
      break;
    }
    case 3:
      content.erase(place(), 1 + random.below(20));
      break;
    case 4:
      content.insert(place(), content.substr(place(), random.below(40)));
      break;
    case 5: {
      const std::size_t at = place();
      for (std::size_t n = at; n < std::min(at + 4, content.size()); ++n)
        content[n] = random.below(2) ? '\xff' : '\0';
      break;
    }
    default:
      for (std::uint32_t n = 1 + random.below(3); n > 0; --n)
        content[place()] = static_cast<char>(random.below(256));
  }
}

// True if a volume came out; every sample of it is touched.
bool reads(const std::string& path, const ReadOptions& options) {
  try {
    ReadLog log;
    const Volume volume = read_volume(path, options, &log);
    REQUIRE(std::min({volume.dims().i, volume.dims().j, volume.dims().k}) >= 2);
    for (int axis = 0; axis < 3; ++axis) {
      REQUIRE(volume.spacing()[axis] > 0);
      REQUIRE(std::isfinite(volume.frame().origin[axis]));
      const Vec3& direction = volume.frame().axes[static_cast<std::size_t>(axis)];
      REQUIRE(std::abs(length(direction) - 1) < 1e-12);
    }
    const ValueRange range = value_range(volume, path);
    REQUIRE(range.min <= range.max);
    return true;
  } catch (const InputError& error) {
    const std::string message = error.what();
    REQUIRE(!message.empty());
    REQUIRE(message.find('\n') == std::string::npos);
    return false;
  }
}

}  // namespace

TEST_CASE("damaged files of every form") {
  const TemporaryFolder folder;
  int read = 0, refused = 0;
  for (SampleType type : {SampleType::u8, SampleType::i16, SampleType::f32}) {
    Truth truth = random_truth(type, {3, 4, 5}, 17);
    truth.spacing = {0.5, 1.25, 3};
    std::uint64_t seed = 1000 * static_cast<std::uint64_t>(type);
    for (const StoredVolume& stored : all_forms(truth)) {
      for (const char* old : {"v.img", "v.img.gz"}) std::filesystem::remove(folder.path(old));
      for (const NamedFile& file : stored.files) folder.write(file.name, file.content);
      for (int round = 0; round < 60; ++round, ++seed) {
        Random random(seed);
        const NamedFile& target =
            stored.files[random.below(static_cast<std::uint32_t>(stored.files.size()))];
        std::string content = target.content;
        for (std::uint32_t n = 1 + random.below(3); n > 0; --n) damage(content, random);
        folder.write(target.name, content);
        CAPTURE(stored.label);
        CAPTURE(seed);
        (reads(folder.path(stored.files[0].name), stored.options) ? read : refused)++;
        folder.write(target.name, target.content);
      }
    }
  }
  CHECK(read > 1000);
  CHECK(refused > 5000);
}

TEST_CASE("truncated files are refused where every byte counts") {
  const TemporaryFolder folder;
  const Truth truth = random_truth(SampleType::u16, {3, 4, 5}, 23);
  int cut = 0;
  for (const StoredVolume& stored : all_forms(truth)) {
    for (const char* old : {"v.img", "v.img.gz"}) std::filesystem::remove(folder.path(old));
    for (const NamedFile& file : stored.files) folder.write(file.name, file.content);
    const NamedFile& last = stored.files.back();
    Random random(static_cast<std::uint64_t>(cut));
    for (int round = 0; round < 20; ++round, ++cut) {
      const std::size_t size = random.below(static_cast<std::uint32_t>(last.content.size()));
      folder.write(last.name, last.content.substr(0, size));
      const bool has_volume = reads(folder.path(stored.files[0].name), stored.options);
      // VTK's files end with markup that is not needed. The last number of a text may lose digits.
      // Data "at the end" may have any bytes before it. Otherwise every byte counts.
      const bool may_read = stored.label.starts_with("vt") ||
                            stored.label.find("ascii") != std::string::npos ||
                            stored.label.find("at end") != std::string::npos;
      CAPTURE(stored.label);
      CAPTURE(size);
      if (!may_read) CHECK(!has_volume);
    }
  }
  CHECK(cut > 1000);
}
