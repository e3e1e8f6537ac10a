// SPDX-License-Identifier: MIT
// The line of a mesh's criteria. A written line is read back. Any other comment is ignored, or
// gives criteria in range.
#include "app/criteria_note.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "app/check_report.h"
#include "app/parsed_line.h"
#include "base/random.h"
#include "base/text.h"
#include "base/version.h"
#include "fields.h"
#include "io/damage.h"

using namespace deliso;
using namespace deliso::test;

namespace {

std::optional<Criteria> read(const std::string& comment) {
  return noted_criteria(std::vector<std::string>{comment});
}

bool in_range(const Criteria& c) {
  for (std::size_t n = 0; n < kCriteria; ++n) {
    const double limit = c.limits.values[n];
    if (!(limit > 0) || limit < kCriterionTable[n].least) return false;
  }
  return c.r_min > 0 && std::isfinite(c.r_min) && c.asks(Criterion::r_over_l);
}

// Nothing is asked for but these.
Criteria asking(double r_min, std::initializer_list<std::pair<Criterion, double>> limits) {
  Criteria criteria;
  criteria.limits.values.fill(kNotAsked);
  criteria.r_min = r_min;
  for (const auto& [criterion, limit] : limits) criteria[criterion] = limit;
  return criteria;
}

std::string words(const std::string& behind_version) {
  return text("deliso ", kVersion, behind_version);
}

// 9 x 9 x 9 samples; a cube with a voxel's volume has a side of 0.5.
Volume long_voxels() {
  return Volume::from_samples({9, 9, 9}, {0.25, 0.5, 1}, std::vector<float>(729, 0));
}

}  // namespace

TEST_CASE("the line of a run has lengths in voxels for options in any unit") {
  const Volume volume = long_voxels();
  const auto note = [&](const std::string& options) {
    return criteria_note(parsed("a --iso 1" + options), volume);
  };
  CHECK(note("") == words(" r-min=0.25 max-distance=0.1 lambda=2"));
  CHECK(note(" --max-distance 0.2 --rmin 0.25 --lambda 1.5 --max-radius 2") ==
        words(" r-min=1 max-distance=0.4 lambda=1.5 max-radius=4"));
  CHECK(note(" --eps1 0.3") == words(" r-min=0.25 lambda=2 eps1=0.3"));
  CHECK(note(" --paper") == words(" r-min=0.004 lambda=2 eps1=0.1 eps2=0.2"));
  // The distance is a result, and no limit to check against.
  CHECK(note(" --vertices 100") == words(" r-min=0.25 lambda=2"));
  CHECK(note(" --vertices 100 --free-vertices 1vox") ==
        words(" r-min=0.25 lambda=2 free-vertices=1"));
  CHECK(note(" --stop-after stage1") == words(" stop-after=stage1"));
  CHECK_FALSE(read(note(" --stop-after stage1")));
}

TEST_CASE("criteria are read back to the last bit") {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto any = [&] { return std::exp(random.uniform(-30, 30)); };
    Criteria criteria = asking(any(), {});
    for (std::size_t n = 0; n < kCriteria; ++n) {
      const bool needed = n == static_cast<std::size_t>(Criterion::r_over_l);
      if (needed || random.below(2) == 0) {
        criteria.limits.values[n] = kCriterionTable[n].least + any();
      }
    }
    if (seed % 2 == 0) criteria.free_vertices = any();
    const std::vector<std::string> comments = {"DelIso SPACE=RAS", "", criteria_note(criteria),
                                               words(" r-min=7 lambda=7")};
    CHECK(noted_criteria(comments) == criteria);
  }
}

TEST_CASE("a line of a later version is read, and bad lines are ignored") {
  CHECK(read("deliso 9.9-beta  color=red r-min=0.25 lambda=3 max-distance=0.5 words more ") ==
        asking(0.25, {{Criterion::distance, 0.5}, {Criterion::r_over_l, 3}}));
  CHECK_FALSE(noted_criteria({}));
  for (const std::string line :
       {"", " ", "DelIso", "deliso", "deliso 0.1.0", "deliso 0.1.0 r-min=1",
        "deliso 0.1.0 lambda=2", "delis 0.1.0 r-min=1 lambda=2", "deliso 0.1.0 r-min=1 lambda=0.5",
        "deliso 0.1.0 r-min=0 lambda=2", "deliso 0.1.0 r-min=-1 lambda=2",
        "deliso 0.1.0 r-min=inf lambda=2", "deliso 0.1.0 r-min=nan lambda=2",
        "deliso 0.1.0 r-min= lambda=2", "deliso 0.1.0 r-min=1x lambda=2",
        "deliso 0.1.0 r-min lambda=2", "deliso 0.1.0 r-min=1 lambda=2 max-distance=1e999",
        "deliso 0.1.0 r-min=1 lambda=2 max-distance=0", "deliso 0.1.0 r-min=1 lambda=2 eps1=no"}) {
    CAPTURE(line);
    CHECK_FALSE(read(line));
  }
}

TEST_CASE("no bytes in a comment do harm") {
  const std::string whole = words(" r-min=0.5 max-distance=0.1 lambda=2 eps1=0.1");
  int taken = 0, passed = 0;
  for (std::uint64_t seed = 1; seed <= 50000; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto criteria = read(damaged(whole, random));
    if (criteria) REQUIRE(in_range(*criteria));
    ++(criteria ? taken : passed);
  }
  CHECK(taken > 1000);
  CHECK(passed > 1000);
}

TEST_CASE("a check uses the file's criteria, except those given as options") {
  const Volume volume = long_voxels();
  const auto limits = [](double distance, double h_over_r, double r_over_l, double r_min) {
    return asking(r_min, {{Criterion::distance, distance},
                          {Criterion::h_over_r, h_over_r},
                          {Criterion::r_over_l, r_over_l}});
  };
  const Criteria noted = limits(0.3, 0.4, 1.5, 0.7);
  const auto options = [&](const std::string& given, bool with_file = true) {
    return verify_options(parsed("check m a --iso 1" + given), volume,
                          with_file ? std::optional(noted) : std::nullopt);
  };
  CHECK(options("").limits == limits(0.3 * 0.5, 0.4, 1.5, 0.7 * 0.5));
  CHECK(options("", false).limits == limits(0.1 * 0.5, kNotAsked, 2, 0.25 * 0.5));
  CHECK(options(" --lambda 3").limits == limits(0.3 * 0.5, 0.4, 3, 0.7 * 0.5));
  CHECK(options(" --rmin 2vox").limits == limits(0.3 * 0.5, 0.4, 1.5, 1));
  CHECK(options(" --max-distance 0.25").limits == limits(0.25, 0.4, 1.5, 0.7 * 0.5));
  CHECK(options(" --eps1 0.2").limits == limits(kNotAsked, 0.2, 1.5, 0.7 * 0.5));
  CHECK(options(" --eps1 0.2 --max-distance 0.25").limits == limits(0.25, 0.2, 1.5, 0.7 * 0.5));
  CHECK(options(" --paper").limits == limits(kNotAsked, 0.1, 2, 0.001 * 2));

  // A length is a share of a voxel in the file.
  Criteria with_radius = limits(kNotAsked, kNotAsked, 2, 1);
  with_radius[Criterion::radius] = 3;
  CHECK(
      verify_options(parsed("check m a --iso 1"), volume, with_radius).limits[Criterion::radius] ==
      1.5);

  // Only a distance that the check command itself was given is required.
  CHECK_FALSE(options("").require_distance);
  CHECK_FALSE(options(" --lambda 3").require_distance);
  CHECK(options(" --max-distance 0.25").require_distance);
  CHECK(options(" --max-distance 0.25", false).require_distance);
  // The mesh command holds its mesh to what its file will say.
  const CommandLine mesh = parsed("a --iso 1 --check --max-distance 0.25 --rmin 2vox");
  const std::vector<std::string> comments{criteria_note(mesh, volume)};
  const VerifyOptions by_mesh = verify_options(mesh, volume, noted_criteria(comments));
  CHECK(by_mesh.limits == options(" --max-distance 0.25 --rmin 2vox --lambda 2", false).limits);
  CHECK(by_mesh.most_over_limit == options("").most_over_limit);
  CHECK_FALSE(by_mesh.require_distance);
  // No vertex is excused but by --free-vertices.
  CHECK(by_mesh.allowed_off_surface == 0);
  const CommandLine free = parsed("a --iso 1 --check --vertices 9 --free-vertices 0.5vox");
  const std::vector<std::string> said{criteria_note(free, volume)};
  CHECK(verify_options(free, volume, noted_criteria(said)).allowed_off_surface ==
        0.5 * volume.voxel());
}
