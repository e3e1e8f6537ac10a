// SPDX-License-Identifier: MIT
#include "io/volume/builtin_volume.h"

#include <doctest/doctest.h>

#include <string>

#include "contour/contour.h"
#include "io/files/checksum.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

std::uint32_t checksum(const Volume& volume) {
  return volume.visit([&](const auto* samples) {
    return crc32(std::as_bytes(std::span(samples, volume.sample_count())));
  });
}

}  // namespace

TEST_CASE("built-in fields have the topology they state, at several sizes") {
  int known = 0;
  for (const BuiltinField& field : builtin_fields()) {
    for (int size : {field.default_size, field.default_size + 13}) {
      const std::string input = "builtin:" + std::string(field.name) + ":" + std::to_string(size);
      CAPTURE(input);
      const Volume volume = make_builtin_volume(input);
      REQUIRE(volume.dims() == Index3{size, size, size});
      const ValueRange range = value_range(volume);
      CHECK(range.min < field.isovalue);
      CHECK(field.isovalue < range.max);
      if (!field.topology) continue;
      ++known;
      const ContourSummary summary = summarize_contour(volume, field.isovalue);
      CHECK(SurfaceTopology{static_cast<int>(summary.components.size()),
                            static_cast<int>(summary.euler()),
                            static_cast<int>(summary.boundary_loops())} == *field.topology);
    }
  }
  CHECK(known >= 2 * 8);
}

TEST_CASE("built-in fields are the same bytes with every compiler") {
  struct Pinned {
    const char* name;
    std::uint32_t crc;
  };
  const Pinned pinned[] = {{"sphere", 0xa3a2e140u},      {"torus", 0x35cb5a6eu},
                           {"linked_tori", 0xb2d2a551u}, {"five_spheres", 0x3705b935u},
                           {"gyroid", 0xf9ea6b6eu},      {"orbital", 0xad520402u},
                           {"fuel", 0xf51a3bccu},        {"marschner_lobb", 0x1ca33537u},
                           {"machine", 0x92bd3892u},     {"noise", 0xe72766eeu}};
  REQUIRE(std::size(pinned) == builtin_fields().size());
  for (std::size_t n = 0; n < std::size(pinned); ++n) {
    CHECK(builtin_fields()[n].name == pinned[n].name);
    const std::string input = "builtin:" + std::string(pinned[n].name);
    CAPTURE(input);
    const Volume volume = make_builtin_volume(input);
    CHECK(checksum(volume) == pinned[n].crc);
    CHECK(checksum(read_volume(input)) == pinned[n].crc);
  }
}

TEST_CASE("a region of a built-in field is the same samples") {
  const Volume whole = make_builtin_volume("builtin:fuel:40");
  const Roi roi{{3, 5, 7}, {21, 30, 40}};
  const Volume part = make_builtin_volume("builtin:fuel:40", {.raw = {}, .roi = roi});
  REQUIRE(part.dims() == Index3{18, 25, 33});
  CHECK(part.frame().origin == Vec3{3, 5, 7});
  int different = 0;
  for_each_index({18, 25, 33}, [&](int i, int j, int k) {
    different += part.sample(i, j, k) != whole.sample(i + 3, j + 5, k + 7);
  });
  CHECK(different == 0);
}

TEST_CASE("faults in the name of a built-in field") {
  CHECK(find_builtin_field("volume.nrrd") == nullptr);
  CHECK(find_builtin_field("builtin:torus:99")->name == "torus");
  for (const char* input : {"builtin:", "builtin:cube", "builtin:cube:64", "builtin:torus:",
                            "builtin:torus:15", "builtin:torus:1025", "builtin:torus:-64",
                            "builtin:torus:64:64", "builtin:torus:64.0", "builtin:torus:x"}) {
    CAPTURE(input);
    CHECK_THROWS_AS(make_builtin_volume(input), InputError);
    CHECK_THROWS_AS(read_volume(input), InputError);
  }
  CHECK_THROWS_WITH_AS(make_builtin_volume("builtin:torus:15"),
                       "builtin:torus:15: size '15' is not a number from 16 to 1024", InputError);
}
