// SPDX-License-Identifier: MIT
// The solid command: what it makes of surfaces of other programs and of labels, and what it
// refuses.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "app/closed_surface.h"
#include "app/parsed_line.h"
#include "app/progress.h"
#include "app/run.h"
#include "app/solid_run.h"
#include "io/files/json_value.h"
#include "io/files/temporary_folder.h"
#include "io/solid/read_solid.h"
#include "io/volume/volume_files.h"
#include "refusal.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// A cube of side 1, as corners and triangles of an OFF file.
constexpr const char* kCorners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n";
const std::vector<std::string> kTriangles{"3 0 2 1", "3 0 3 2", "3 4 5 6", "3 4 6 7",
                                          "3 0 1 5", "3 0 5 4", "3 1 2 6", "3 1 6 5",
                                          "3 2 3 7", "3 2 7 6", "3 3 0 4", "3 3 4 7"};

std::string off(const std::string& points, const std::vector<std::string>& triangles) {
  std::string file =
      text("OFF\n", std::ranges::count(points, '\n'), " ", triangles.size(), " 0\n", points);
  for (const std::string& triangle : triangles) file += triangle + "\n";
  return file;
}

struct Made {
  std::string refusal;
  CommandLine line;
  SolidRun run{line};
};

// What the command makes of the file, with these options.
void make(Made& made, const std::string& file, const std::string& options = "") {
  made.line = parsed("solid " + file + options);
  ProgressBar none(solid_stages(), false);
  made.refusal = refusal_by([&] {
    MeshNotes notes;
    const TriMesh surface = read_mesh(file, &notes);
    make_solid_of(surface, notes, made.run, none);
  });
}

double volume_of(const SolidRun& run) {
  return run.check.result.volume;
}

}  // namespace

TEST_CASE("a cube of another program is filled, with its faces marked, whichever way it faces") {
  const TemporaryFolder folder;
  std::vector<std::string> reversed = kTriangles;
  for (std::string& t : reversed) std::swap(t[4], t[6]);
  for (const bool inwards : {false, true}) {
    CAPTURE(inwards);
    Made made;
    make(made, folder.write("cube.off", off(kCorners, inwards ? reversed : kTriangles)));
    REQUIRE(made.refusal == "");
    CHECK(made.run.sound());
    CHECK(volume_of(made.run) == doctest::Approx(1));
    CHECK(made.run.notes.size() == (inwards ? 1 : 0));
    for (const Wall& wall : made.run.solid.walls) {
      REQUIRE(wall.kind >= 1);
      REQUIRE(wall.kind <= 6);
      const auto axis = static_cast<int>(wall.kind - 1) / 2;
      for (const VertexId v : wall.v) {
        CHECK(made.run.solid.points[v][axis] == (wall.kind % 2 == 0 ? 1 : 0));
      }
    }
  }
}

TEST_CASE("vertices at one place are one, and those of no triangle are left out") {
  const TemporaryFolder folder;
  // Triangles with corners of their own, a vertex in the middle, and a triangle of no area.
  std::string points = "0.5 0.5 0.5\n";
  std::vector<std::string> corners, triangles{"3 1 1 2"};
  for (std::size_t at = 0, end; (end = std::string(kCorners).find('\n', at)) != std::string::npos;
       at = end + 1) {
    corners.push_back(std::string(kCorners).substr(at, end + 1 - at));
  }
  for (const std::string& t : kTriangles) {
    const auto n = std::ranges::count(points, '\n');
    for (const std::size_t place : {2, 4, 6})
      points += corners[static_cast<std::size_t>(t[place] - '0')];
    triangles.push_back(text("3 ", n, " ", n + 1, " ", n + 2));
  }
  Made made;
  make(made, folder.write("soup.off", off(points, triangles)), " --no-fill");
  REQUIRE(made.refusal == "");
  CHECK(made.run.vertices == 8);
  CHECK(made.run.triangles == 12);
  CHECK(made.run.sound());
  CHECK(volume_of(made.run) == doctest::Approx(1));
}

TEST_CASE("cubes that touch, and one with a cavity, are filled") {
  const TemporaryFolder folder;
  const auto cube = [](double x, double y, double side, int first, bool inwards) {
    std::string points;
    std::vector<std::string> triangles;
    for (int n = 0; n < 8; ++n) {
      const double dx = n % 4 == 1 || n % 4 == 2, dy = n % 4 >= 2, dz = n / 4;
      points += text(x + side * dx, " ", y + side * dy, " ", x * (side < 1) + side * dz, "\n");
    }
    for (const std::string& t : kTriangles) {
      triangles.push_back(text("3 ", t[2] - '0' + first, " ", t[inwards ? 6 : 4] - '0' + first, " ",
                               t[inwards ? 4 : 6] - '0' + first));
    }
    return std::pair(points, triangles);
  };
  std::pair<std::string, std::vector<std::string>> cubes = cube(0, 0, 1, 0, false);
  std::string& points = cubes.first;
  std::vector<std::string>& triangles = cubes.second;
  const auto add = [&](const std::pair<std::string, std::vector<std::string>>& more) {
    points += more.first;
    triangles.insert(triangles.end(), more.second.begin(), more.second.end());
  };
  SUBCASE("along an edge") {
    add(cube(1, 1, 1, 8, false));
    Made made;
    make(made, folder.write("edge.off", off(points, triangles)), " --max-cell .3");
    REQUIRE(made.refusal == "");
    CHECK(made.run.sound());
    CHECK(volume_of(made.run) == doctest::Approx(2));
  }
  SUBCASE("in a vertex") {
    add(cube(1, 1, .5, 8, false));
    Made made;
    make(made, folder.write("vertex.off", off(points, triangles)), " --max-cell .3");
    REQUIRE(made.refusal == "");
    CHECK(made.run.sound());
    CHECK(volume_of(made.run) == doctest::Approx(1.125));
  }
  SUBCASE("a cavity") {
    add(cube(.25, .25, .5, 8, true));
    Made made;
    make(made, folder.write("cavity.off", off(points, triangles)));
    REQUIRE(made.refusal == "");
    CHECK(made.run.sound());
    CHECK(volume_of(made.run) == doctest::Approx(1 - .125));
  }
  SUBCASE("a cavity that faces the other way is a cube in a cube") {
    add(cube(.25, .25, .5, 8, false));
    Made made;
    make(made, folder.write("nested.off", off(points, triangles)));
    CHECK(made.refusal.ends_with(
        "nested.off: bounds no solid: it is not closed, or its components do not agree on what is "
        "inside; one of them has the triangle at (0.5833333 0.4166667 0.25)"));
  }
  SUBCASE("two apart, one turned") {
    add(cube(4, 0, 2, 8, true));
    Made made;
    make(made, folder.write("apart.off", off(points, triangles)));
    CHECK(made.refusal.ends_with("has the triangle at (0.6666667 0.3333333 0)"));
  }
}

TEST_CASE("a surface that bounds no solid is refused with its place") {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& points, const std::vector<std::string>& triangles) {
    Made made;
    make(made, folder.write("bad.off", off(points, triangles)));
    const std::size_t name = made.refusal.find("bad.off");
    REQUIRE(name != std::string::npos);
    return made.refusal.substr(name);
  };
  std::vector<std::string> open = kTriangles;
  open.pop_back();
  CHECK(refusal(kCorners, open)
            .starts_with("bad.off: the surface is open at edge 3-4 at (0 0.5 0.5), and 2 more; a "
                         "solid needs a closed"));
  std::vector<std::string> turned = kTriangles;
  turned[4] = "3 0 5 1";
  CHECK(refusal(kCorners, turned)
            .starts_with("bad.off: the surface has triangles that face different ways at edge 0-1 "
                         "at (0.5 0 0), and 2 "
                         "more"));
  std::vector<std::string> twice = kTriangles;
  twice.push_back("3 0 2 1");
  CHECK(refusal(kCorners, twice).find("is there already as 0 at (0 0 0)") != std::string::npos);
  // A corner that is pulled through the opposite faces.
  std::string crossed = kCorners;
  crossed.replace(0, 5, "2 2 3");
  CHECK(refusal(crossed, kTriangles).find(" meets triangle ") != std::string::npos);
  CHECK(refusal("0 0 0\n1 0 0\n0 1 0\n", {}) == "bad.off: has no triangle that bounds anything");
  std::vector<std::string> flat = kTriangles;
  flat.insert(flat.end(), {"3 0 1 8", "3 1 0 8"});
  CHECK(refusal(text(kCorners, "0.5 0 0\n"), flat).find("has no area at (") != std::string::npos);
}

TEST_CASE("labels are regions with a common wall, and the faces of the box are kinds") {
  const TemporaryFolder folder;
  std::string samples;
  for (int n = 0; n < 12 * 12 * 12; ++n) {
    const int x = n % 12, y = n / 12 % 12, z = n / 144;
    samples += static_cast<char>(x < 2 ? 0 : y < 6 ? 4 : z < 5 ? 7 : 9);
  }
  const std::string volume = folder.write("labels.raw", samples) + " --dims 12x12x12 --type uint8";
  const std::string shared = folder / "shared.ply";
  run_mesh(parsed("mesh " + volume + " --label all --cap -q --shared " + shared));
  Made made;
  make(made, shared);
  REQUIRE(made.refusal == "");
  CHECK(made.run.sound());
  std::vector<std::int64_t> labels;
  for (const RegionLabel& label : made.run.check.labels) labels.push_back(label.number);
  CHECK(labels == std::vector<std::int64_t>{4, 7, 9});
  // All of the box but the slab of 0, whose wall lies between x = 1 and 2.
  CHECK(std::abs(volume_of(made.run) - 9.5 * 11 * 11) < .5 * 11 * 11);
  std::set<std::uint32_t> kinds;
  for (const Wall& wall : made.run.solid.walls) kinds.insert(wall.kind);
  CHECK(kinds == std::set<std::uint32_t>{0, 2, 3, 4, 5, 6});  // at low x there is 0

  // Without caps the labels are open.
  run_mesh(parsed("mesh " + volume + " --label all -q --shared " + shared));
  Made open;
  make(open, shared);
  CHECK(open.refusal.find("label 4 is open at edge ") != std::string::npos);
}

TEST_CASE(
    "a solid's file is read back and checked against its surface, and another surface fails") {
  const TemporaryFolder folder;
  const std::string surface = folder / "a.ply", other = folder / "b.ply";
  run_mesh(parsed("builtin:torus:16 -q -o " + surface));
  run_mesh(parsed("builtin:torus:16 --max-distance 0.3vox -q -o " + other));
  for (const char* ending : {"mesh", "vtu"}) {
    const std::string solid = folder / "a." + ending;
    REQUIRE(run_solid(parsed("solid " + surface + " -q -o " + solid)) == kExitSuccess);
    CHECK(run_check(parsed("check " + solid + " -q")) == kExitSuccess);
    CHECK(run_check(parsed("check " + solid + " " + surface + " -q")) == kExitSuccess);
    CHECK(run_check(parsed("check " + solid + " " + other + " -q")) == kFaultFound);
  }
}

TEST_CASE("a shorter --max-cell and a smaller --growth give more cells; --no-fill adds no point") {
  const TemporaryFolder folder;
  const std::string surface = folder / "ball.ply";
  run_mesh(parsed("builtin:sphere:24 -q -o " + surface));
  std::vector<std::size_t> cells;
  for (const char* options : {" --growth 2", "", " --growth .1", " --max-cell .8", " --no-fill"}) {
    Made made;
    make(made, surface, options);
    REQUIRE(made.refusal == "");
    CHECK(made.run.sound());
    const bool has_inner = made.run.solid.points.size() > made.run.solid.skin_points;
    CHECK(has_inner == made.line.solid.fills);
    if (has_inner) cells.push_back(made.run.solid.cells.size());
    const bool is_short = std::string(options) == " --max-cell .8";
    REQUIRE(made.run.notes.size() == (is_short ? 1 : 0));
    if (is_short) CHECK(made.run.notes[0].code.name() == "coarse-surface");
  }
  CHECK(std::ranges::is_sorted(cells));
  CHECK(std::ranges::adjacent_find(cells) == cells.end());
  Made made;
  make(made, surface, " --max-cell 1e-4");
  CHECK(made.refusal.starts_with("--max-cell 1e-04: some "));
}

TEST_CASE("another output that is one of TetGen's three files is refused") {
  const TemporaryFolder folder;
  const std::string surface = folder.write("cube.off", off(kCorners, kTriangles));
  const std::string words = "solid " + surface + " -q -o " + folder / "cube.node --json ";
  CHECK(refusal_by([&] { run_solid(parsed(words + folder / "x.json")); }) == "");
  CHECK(refusal_by([&] {
          run_solid(parsed(words + folder / "cube.face"));
        }).starts_with("cannot write '" + (folder / "cube.face") + "': this run writes that"));
  std::filesystem::create_hard_link(surface, folder / "hard.ele");
  CHECK(refusal_by([&] {
          run_solid(parsed("solid " + surface + " -q -o " + folder / "hard.node"));
        }).starts_with("cannot write '" + (folder / "hard.ele") + "': this run reads that"));
  CHECK(refusal_by([&] {
          run_solid(parsed("solid " + surface + " -q --format tetgen -o -"));
        }).starts_with("TetGen's format has three files"));
}
