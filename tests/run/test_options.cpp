// SPDX-License-Identifier: MIT
// What options become: lengths in the volume's frame.
#include "run/options.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "base/check.h"

using namespace deliso;

namespace {

// The smallest side of the box is 2, a cube with a voxel's volume has a side of 0.5.
Volume small_long_voxels() {
  return Volume::from_samples({9, 9, 9}, {0.25, 0.5, 1}, std::vector<float>(729, 0));
}

}  // namespace

TEST_CASE("the limits of Stage 2 are those of the options") {
  Options options;
  options.limits[Criterion::r_over_l].value = 1.5;
  options.limits[Criterion::h_over_r].value = 0.25;
  options.limits[Criterion::distance] = {0.2, Length::Unit::voxel};
  options.limits[Criterion::radius] = {0.05, Length::Unit::box};
  options.r_min = {0.5, Length::Unit::world};
  const Parameters p = resolve(options, small_long_voxels());
  CHECK(p.refinement[Criterion::r_over_l] == 1.5);
  CHECK(p.refinement[Criterion::h_over_r] == 0.25);
  CHECK(p.refinement[Criterion::distance] == doctest::Approx(0.1));
  CHECK(p.refinement[Criterion::radius] == doctest::Approx(0.1));
  CHECK(p.r_min == 0.5);
  CHECK(p.refinement.r_min == 0.5);
}

TEST_CASE("limits below which refinement would not end are refused") {
  const auto refusal = [](const Options& options) {
    try {
      require_limits(options, small_long_voxels());
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Options options;
  CHECK(refusal(options) == "");
  options.limits[Criterion::r_over_l].value = 0.9;
  CHECK(refusal(options) == "the limit lambda must be at least 1, or refinement would not end");
  options = {};
  options.r_min = {1e-9, Length::Unit::voxel};
  CHECK(refusal(options) ==
        "r_min (--rmin) is 1e-09 voxels, and must be at least 0.001: at creases refinement would "
        "hardly end");
}
