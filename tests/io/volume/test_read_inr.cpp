// SPDX-License-Identifier: MIT
// INRIMAGE: what its header may say beside the samples, which test_read_volume has.
#include <doctest/doctest.h>

#include <string>

#include "io/volume/read_fault.h"
#include "io/volume/read_volume.h"
#include "io/volume/volume_files.h"

using namespace deliso;
using namespace deliso::test;

TEST_CASE("channels of INRIMAGE run fastest") {
  const TemporaryFolder folder;
  Truth truth = random_truth(SampleType::u8, {4, 5, 6}, 3);
  truth.dims.i = 2;
  truth.channels = 2;
  const std::string path = folder.write("v.inr", inr(truth, std::endian::little));
  for (const int channel : {1, 2}) {
    ReadOptions options;
    options.channel = channel;
    std::string bytes;
    for (std::size_t n = static_cast<std::size_t>(channel) - 1; n < truth.bytes.size(); n += 2) {
      bytes += truth.bytes[n];
    }
    CHECK(bytes_of_samples(read_volume(path, options)) == bytes);
  }
}

// CGAL ships small-scalar.inr, whose header has 240 bytes.
TEST_CASE("INRIMAGE with a short header, without places, and turned") {
  const TemporaryFolder folder;
  const std::string header =
      "#INRIMAGE-4#{\nXDIM=002\nYDIM=003\nZDIM=04\nTYPE=UNSIGNED FIXED\nPIXSIZE=8\nCPU=decm\n";
  const std::string samples = random_truth(SampleType::u8, {2, 3, 4}, 1).bytes;
  ReadLog log;
  const Volume plain = read_volume(folder.write("a.inr", header + "##}\n" + samples), {}, &log);
  CHECK(bytes_of_samples(plain) == samples);
  CHECK(plain.spacing() == Vec3{1, 1, 1});
  CHECK(plain.frame() == Frame());
  CHECK(log.notes.empty());
  read_volume(folder.write("b.inr", header + "RZ=30\n##}\n" + samples), {}, &log);
  REQUIRE(log.notes.size() == 1);
  CHECK(log.notes[0].words.ends_with("its rotation (RX, RY, RZ) is not read: it is taken as 0"));
}
