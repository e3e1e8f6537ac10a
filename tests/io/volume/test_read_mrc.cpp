// SPDX-License-Identifier: MIT
// MRC: what its header may say beside the samples, which test_read_volume has.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <string>

#include "io/volume/read_fault.h"
#include "io/volume/read_volume.h"
#include "io/volume/volume_files.h"

using namespace deliso;
using namespace deliso::test;

namespace {

Truth turned_truth() {
  Truth truth = random_truth(SampleType::i16, {3, 4, 5}, 7);
  truth.spacing = {0.5, 2, 3};
  truth.axes = {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  return truth;
}

struct Edit {
  std::size_t at;
  std::uint32_t word;
};

Edit real_at(std::size_t at, float value) {
  return {at, std::bit_cast<std::uint32_t>(value)};
}

// The file with these words of its header replaced.
std::string edited(const Truth& truth, std::initializer_list<Edit> edits) {
  std::string file = mrc(truth, std::endian::little);
  for (const auto& [at, word] : edits) file.replace(at, 4, little(word, 4));
  return file;
}

}  // namespace

TEST_CASE("samples of MRC begin at their place in the cell, if there is no origin") {
  const TemporaryFolder folder;
  const Truth truth = turned_truth();
  const auto origin = [&](std::initializer_list<Edit> edits) {
    return read_volume(folder.write("v.mrc", edited(truth, edits))).frame().origin;
  };
  CHECK(origin({}) == Vec3{0, 0, 0});
  // Along the columns, which are along z, the rows (x) and the sections (y).
  CHECK(origin({{16, 4}, {20, static_cast<std::uint32_t>(-3)}, {24, 2}}) == Vec3{-6, 6, 2});
  CHECK(origin({{16, 4}, real_at(200, 8)}) == Vec3{0, 8, 0});
}

TEST_CASE("the cell of MRC may have other angles than right ones") {
  const TemporaryFolder folder;
  const Truth truth = random_truth(SampleType::f32, {3, 4, 5}, 7);
  const auto axes = [&](float yz, float xz, float xy) {
    const std::string file = edited(truth, {real_at(52, yz), real_at(56, xz), real_at(60, xy)});
    return read_volume(folder.write("v.map", file)).frame().axes;
  };
  CHECK(axes(90, 90, 90) == Frame().axes);
  CHECK(axes(0, 0, 0) == Frame().axes);
  for (const auto& [yz, xz, xy] :
       {std::array{90.f, 90.f, 120.f}, {90.f, 100.f, 90.f}, {70.f, 100.f, 80.f}}) {
    const auto [x, y, z] = axes(yz, xz, xy);
    CHECK(x == Vec3{1, 0, 0});
    CHECK(y.z == 0);
    CHECK(z.z > 0);
    const auto cosine_of = [](float degrees) { return std::cos(degrees * std::acos(-1.0) / 180); };
    CHECK(dot(y, z) == doctest::Approx(cosine_of(yz)).epsilon(1e-12));
    CHECK(dot(x, z) == doctest::Approx(cosine_of(xz)).epsilon(1e-12));
    CHECK(dot(x, y) == doctest::Approx(cosine_of(xy)).epsilon(1e-12));
    for (const Vec3& axis : {x, y, z}) CHECK(length(axis) == doctest::Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("MRC without axes has x, y, z; IMOD's flag says that bytes have a sign") {
  const TemporaryFolder folder;
  const Truth truth = random_truth(SampleType::u8, {3, 4, 5}, 7);
  const auto read = [&](std::initializer_list<Edit> edits) {
    return read_volume(folder.write("v.mrc", edited(truth, edits)));
  };
  CHECK(read({{64, 0}, {68, 0}, {72, 0}}).frame().axes == Frame().axes);
  CHECK(read({}).type() == SampleType::u8);
  CHECK(read({{156, 1}}).type() == SampleType::i8);
  CHECK(read({{152, 0}}).type() == SampleType::i8);
}

TEST_CASE("a stack of volumes of MRC has times") {
  const TemporaryFolder folder;
  const Truth truth = random_truth(SampleType::u16, {3, 4, 6}, 7);
  const std::string path = folder.write("v.mrc", edited(truth, {{88, 401}, {36, 2}}));
  ReadOptions options;
  for (const int time : {1, 2, 3}) {
    options.time = time;
    const Volume volume = read_volume(path, options);
    CHECK(volume.dims() == Index3{3, 4, 2});
    CHECK(bytes_of_samples(volume) ==
          truth.bytes.substr(48 * static_cast<std::size_t>(time - 1), 48));
  }
  options.time = 4;
  CHECK(read_fault(path, options) == "has 3 times, and no time 4");
}

TEST_CASE("a byte order that the stamp of MRC denies is found") {
  const TemporaryFolder folder;
  const Truth truth = turned_truth();
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    std::string file = mrc(truth, order);
    for (const char* stamp : {"\x44\x44", "\x44\x41", "\x11\x11", "xx"}) {
      file.replace(212, 2, stamp);
      CHECK(bytes_of_samples(read_volume(folder.write("v.mrc", file))) == truth.bytes);
    }
  }
}
