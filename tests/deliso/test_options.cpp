// SPDX-License-Identifier: MIT
// What options become: the published constants, and lengths in the volume's frame.
#include "deliso/options.h"

#include <doctest/doctest.h>

#include <vector>

using namespace deliso;

namespace {

// The smallest side of the box is 2, a cube with a voxel's volume has a side of 0.5.
Volume small_long_voxels() {
  return Volume::from_samples({9, 9, 9}, {0.25, 0.5, 1}, std::vector<float>(729, 0));
}

}  // namespace

TEST_CASE("the published options are the paper's constants") {
  // Section 3.1: epsilon 0.2, lambda 2, r_min a thousandth of the box. Section 3.2: epsilon1 0.1,
  // epsilon2 0.2, the same lambda and r_min.
  const Parameters p = resolve(Options::paper(), small_long_voxels());
  CHECK(p.as_published);
  CHECK(p.recovery[Criterion::h_over_r] == 0.2);
  CHECK(p.recovery[Criterion::r_over_l] == 2);
  CHECK(p.refinement[Criterion::h_over_r] == 0.1);
  CHECK(p.refinement[Criterion::r_over_pole] == 0.2);
  CHECK(p.refinement[Criterion::r_over_l] == 2);
  for (const Criterion none : {Criterion::distance, Criterion::radius}) {
    CHECK_FALSE(p.refinement.asks(none));
  }
  for (const Criteria& criteria : {p.recovery, p.refinement}) {
    CHECK(criteria.r_min == doctest::Approx(0.002));
    CHECK(criteria.shape_floor == criteria.r_min);
  }
}

TEST_CASE("the limits of both stages are those of the options") {
  for (Options options : {Options(), Options::paper()}) {
    options.epsilon = 0.3;
    options.limits[Criterion::r_over_l].value = 1.5;
    options.limits[Criterion::h_over_r].value = 0.25;
    options.limits[Criterion::r_over_pole].value = 0.4;
    options.limits[Criterion::distance] = {0.2, Length::Unit::voxel};
    options.limits[Criterion::radius] = {0.05, Length::Unit::box};
    options.r_min = {0.5, Length::Unit::world};
    options.fingers = {0.8, Length::Unit::voxel};
    const Parameters p = resolve(options, small_long_voxels());
    CHECK(p.recovery[Criterion::h_over_r] == 0.3);
    CHECK(p.recovery[Criterion::r_over_l] == 1.5);
    CHECK(p.refinement[Criterion::r_over_l] == 1.5);
    CHECK(p.refinement[Criterion::h_over_r] == 0.25);
    CHECK(p.refinement[Criterion::r_over_pole] == 0.4);
    CHECK(p.refinement[Criterion::distance] == doctest::Approx(0.1));
    CHECK(p.refinement[Criterion::radius] == doctest::Approx(0.1));
    CHECK(p.r_min == 0.5);
    CHECK(p.recovery.r_min == 0.5);
    CHECK(p.refinement.r_min == 0.5);
    CHECK(p.fingers == doctest::Approx(0.4));
  }
}
