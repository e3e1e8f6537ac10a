// SPDX-License-Identifier: MIT
// Whatever a file holds, reading it ends with an InputError or a volume all of whose samples are
// there. Files of every form are damaged at random; the sanitizers watch.
#include <doctest/doctest.h>

#include <string>

#include "io/damage.h"
#include "io/volume/read_volume.h"
#include "read_fault.h"
#include "volume_files.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// True if a volume came out.
bool reads(const std::string& path, const ReadOptions& options) {
  const char* flaw = nullptr;
  bool has_volume = false;
  try {
    ReadLog log;
    flaw = flaw_of(read_volume(path, options, &log));
    has_volume = true;
  } catch (const InputError& error) {
    flaw = flaw_of(error);
  }
  REQUIRE(flaw == nullptr);
  return has_volume;
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
      const std::string path = stored.write(folder);
      for (int round = 0; round < 60; ++round, ++seed) {
        Random random(seed);
        const NamedFile& target =
            stored.files[random.below(static_cast<std::uint32_t>(stored.files.size()))];
        folder.write(target.name, damaged(target.content, random));
        CAPTURE(stored.label);
        CAPTURE(seed);
        (reads(path, stored.options) ? read : refused)++;
        folder.write(target.name, target.content);
      }
    }
  }
  CHECK(read > 1000);
  CHECK(refused > 5000);
}

TEST_CASE("a small file of equal samples does not fill the memory") {
  const TemporaryFolder folder;
  Truth truth = random_truth(SampleType::u8, {64, 64, 8}, 17);
  truth.bytes.assign(truth.bytes.size(), 'x');
  const ExpansionBudget small{.free_bytes = 1024, .ratio = 4};
  int refused = 0;
  for (StoredVolume& stored : all_forms(truth)) {
    CAPTURE(stored.label);
    const std::string path = stored.write(folder);
    CHECK(read_message(path, stored.options).empty());
    stored.options.budget = small;
    const std::string message = read_message(path, stored.options);
    const std::uint64_t size = stored.files[0].content.size();
    const bool is_small = size <= (truth.bytes.size() - small.free_bytes) / small.ratio;
    const bool is_tiff = stored.label.starts_with("tiff");
    const bool is_packed_dicom =
        stored.label.starts_with("dicom") && stored.label.find("deflated") == std::string::npos;
    const bool is_expected = is_small && (is_tiff || is_packed_dicom);
    CHECK((message.find("would become 32768 or more") != std::string::npos) == is_expected);
    refused += is_expected;
  }
  CHECK(refused > 10);
}

TEST_CASE("truncated files are refused where every byte counts") {
  const TemporaryFolder folder;
  const Truth truth = random_truth(SampleType::u16, {3, 4, 5}, 23);
  int cut = 0;
  for (const StoredVolume& stored : all_forms(truth)) {
    const std::string path = stored.write(folder);
    const NamedFile& last = stored.files.back();
    Random random(static_cast<std::uint64_t>(cut));
    for (int round = 0; round < 20; ++round, ++cut) {
      const std::size_t size = random.below(static_cast<std::uint32_t>(last.content.size()));
      folder.write(last.name, last.content.substr(0, size));
      const bool has_volume = reads(path, stored.options);
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
