// SPDX-License-Identifier: MIT
// The rounding that avoids faults by place, of triangles where they are known.
#include "app/round_points.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/input.h"
#include "app/mesh_run.h"
#include "app/parsed_line.h"
#include "app/progress.h"
#include "base/random.h"
#include "check/place_faults.h"
#include "io/mesh/to_float.h"

using namespace deliso;
using namespace deliso::test;

namespace {

using Triangles = std::vector<Triangle>;

// Two triangles, the second above the first by `gap` where the first is at x = 1000.
std::vector<Vec3> sheets(double gap) {
  return {{1000, 0, 0},       {1001, 0, 0},       {1000, 1, 0},
          {1000 + gap, 0, 0}, {1000 + gap, 1, 1}, {1000 + gap, -1, 1}};
}

}  // namespace

TEST_CASE("points without faults are rounded to the nearest float") {
  Random random(3);
  std::vector<Vec3> points;
  for (int n = 0; n < 30; ++n) {
    points.push_back({random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)});
  }
  const std::vector<Vec3> rounded = round_without_faults(points, Triangles{{0, 1, 2}}, 1);
  for (std::size_t v = 0; v < points.size(); ++v) CHECK(rounded[v] == to_float(points[v]));
}

TEST_CASE("where rounding makes faults, other floats around the exact place are taken") {
  const Triangles two{{0, 1, 2}, {3, 4, 5}};
  // Floats at 1000 are 6e-5 apart, so both sheets round to one place.
  const std::vector<Vec3> exact = sheets(-2e-5);
  CHECK(find_place_faults(exact, two, 1).count() == 0);
  std::vector<Vec3> rounded;
  for (const Vec3& p : exact) rounded.push_back(to_float(p));
  CHECK(find_place_faults(rounded, two, 1).count() > 0);

  const std::vector<Vec3> mended = round_without_faults(exact, two, 1);
  CHECK(find_place_faults(mended, two, 1).count() == 0);
  for (std::size_t v = 0; v < exact.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = exact[v][axis];
      CHECK(to_float(mended[v][axis]) == mended[v][axis]);
      // A float stays; others go to one of the two floats around them.
      const double most = to_float(x) == x ? 0 : std::ldexp(1.0, std::ilogb(x) - 23);
      CHECK(std::fabs(mended[v][axis] - x) <= most);
    }
  }
}

TEST_CASE("rounding to floats moves points by half of the distance between floats, at most") {
  Random random(4);
  for (int n = 0; n < 100; ++n) {
    const double size = std::ldexp(random.uniform(1, 2), 5 + n % 30);
    std::vector<Vec3> points{{size, 0, 0}};
    for (int i = 0; i < 30; ++i) {
      points.push_back({random.uniform(-size, size), random.uniform(0, size), -size});
    }
    double moved = 0;
    for (const Vec3& p : points) {
      for (int axis = 0; axis < 3; ++axis) {
        moved = std::max(moved, std::fabs(to_float(p[axis]) - p[axis]));
      }
    }
    CHECK(moved <= float_rounding(points));
    CHECK(moved > 0.25 * float_rounding(points));
  }
}

// Warnings of a run in single precision, with D = 0.1 voxels.
TEST_CASE("a mesh too far from the origin for single precision is told of") {
  struct Case {
    std::string options;
    bool is_told;
  };
  for (const Case& c : {Case{"--origin 1e6,0,0 -o far.stl", true},
                        {"--origin 1e6,0,0 --float -o far.ply", true},
                        // Half a step of floats is 0.0156 voxels there.
                        {"--origin 4e5,0,0 -o far.stl", false},
                        {"--origin 4e5,0,0 -o far.stl --vertices 300", false},
                        {"--origin 4e5,0,0 -o far.stl --max-distance 0.05", true},
                        {"--origin 4e5,0,0 -o far.stl --spacing 2,2,2", false},
                        {"--origin 1e6,0,0 -o far.ply", false},
                        {"--origin 1e6,0,0 -o far.glb", false},
                        {"--origin 1e6,0,0", false},
                        {"-o near.stl", false},
                        {"-o near.stl --paper", false}}) {
    CAPTURE(c.options);
    const CommandLine line = parsed("builtin:fuel:16 " + c.options);
    const Input input = input_of(read_source(line), line);
    MeshRun run(line, input);
    ProgressBar progress(mesh_stages(line), false);
    mesh_input(run, progress);
    const std::vector<std::string> warnings = warnings_of(run.notes);
    CHECK((warnings.size() == 1) == c.is_told);
    if (!c.is_told || warnings.empty()) continue;
    CHECK(warnings[0].find("--origin 0,0,0") != std::string::npos);
    CHECK(warnings[0].find(".ply") != std::string::npos);
  }
}

TEST_CASE("vertices that are all floats cannot be mended") {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}};
  CHECK(round_without_faults(points, Triangles{{0, 1, 2}}, 1) == points);
  // Nor can those of no triangle.
  CHECK(round_without_faults({{1, 0, 0}, {1, 0, 0}}, {}, 1).size() == 2);
}
