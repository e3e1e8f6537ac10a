// SPDX-License-Identifier: MIT
// --check and the check command are one: the same faults, as many of each, and the same exit
// status.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "app/parsed_line.h"
#include "app/run.h"
#include "base/check.h"
#include "base/random.h"
#include "io/files/json_value.h"
#include "io/files/temporary_folder.h"
#include "io/mesh/read_mesh.h"
#include "io/mesh/write_mesh.h"

using namespace deliso;
using namespace deliso::test;

namespace {

struct CheckOutcome {
  int status = 0;
  std::vector<std::string> kinds;
  std::vector<double> counts;
};

CheckOutcome outcome_of(const TemporaryFolder& folder, const std::string& arguments) {
  const std::string file = folder / "report.json";
  const CommandLine line = parsed(arguments + " --quiet --json " + file);
  CheckOutcome outcome;
  outcome.status = line.command == Command::check ? run_check(line) : run_mesh(line);
  const JsonValue report = parse_json(file_bytes(file), file);
  const JsonValue& faults = report["check"]["faults"];
  outcome.kinds = faults.keys;
  for (const JsonValue& fault : faults.items) outcome.counts.push_back(fault["count"].number);
  return outcome;
}

// A walk of single voxels of 255 among zeros, as skeletons of masks are.
std::string skeleton(const TemporaryFolder& folder) {
  constexpr int kSkeletonSide = 10;
  std::string samples(kSkeletonSide * kSkeletonSide * kSkeletonSide, '\0');
  Random random(4);
  std::array<int, 3> at{5, 5, 5};
  for (int step = 0; step < 90; ++step) {
    samples[static_cast<std::size_t>(at[0] + kSkeletonSide * (at[1] + kSkeletonSide * at[2]))] =
        '\xff';
    for (int& x : at)
      x = std::clamp(x + static_cast<int>(random.below(3)) - 1, 1, kSkeletonSide - 2);
  }
  return folder.write("skeleton.raw", samples) + " --dims 10x10x10 --type uint8 --iso 127.5";
}

}  // namespace

TEST_CASE("--check finds the faults that the check command finds in the file") {
  const TemporaryFolder folder;
  int with_fault = 0;
  struct Case {
    std::string volume, options, of_check;  // `of_check`: what the file does not say
    std::string file = "mesh.ply";
  };
  const std::string far = " --origin 3e6,5e6,100";
  const std::string uneven = " --spacing 0.7,0.7,0.7 --origin 100,200,300";
  for (const Case& c : {Case{"builtin:fuel:20", "", ""},
                        {"builtin:gyroid:16", " --cap", " --cap"},
                        {"builtin:five_spheres:24", " --largest 2", " --largest 2"},
                        {"builtin:torus:16", " --paper", ""},
                        // Of so few triangles most are over a limit.
                        {"builtin:marschner_lobb:32", " --vertices 60", ""},

                        {skeleton(folder), "", ""},
                        // Rounded to halves of a voxel, or about the middle.
                        {"builtin:fuel:20", far, far, "mesh.stl"},
                        {"builtin:fuel:20", far, far, "mesh.glb"},
                        // A text of a float, as 22.47, is no float when it is read as a double.
                        {"builtin:sphere:16", uneven + " --float", uneven, "mesh.off"},
                        {"builtin:sphere:16", uneven + " --float", uneven, "mesh.3mf"}}) {
    CAPTURE(c.volume);
    const std::string file = folder / c.file;
    const CheckOutcome made = outcome_of(folder, c.volume + c.options + " --check -o " + file);
    const CheckOutcome checked = outcome_of(folder, "check " + file + " " + c.volume + c.of_check);
    CHECK(made.status == checked.status);
    CHECK(made.kinds == checked.kinds);
    CHECK(made.counts == checked.counts);
    CHECK(made.kinds.empty() == (made.status == 0));
    with_fault += made.status != 0;
  }
  CHECK(with_fault == 3);
}

// A mesh of another program: no comment, and vertices off the surface.
TEST_CASE(
    "vertices off the surface are no fault of another program's mesh if a distance is asked for") {
  const TemporaryFolder folder;
  const std::string ours = folder / "ours.ply", field = " builtin:torus:24";
  REQUIRE(run_mesh(parsed(field.substr(1) + " --quiet -o " + ours)) == kExitSuccess);
  Random random(1);
  TriMesh mesh = read_mesh(ours);
  for (Vec3& p : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) p[axis] += random.uniform(-0.05, 0.05);
  }
  const std::string theirs = folder / "theirs.ply", ours_moved = folder / "moved.ply";
  write_mesh(mesh, theirs, {});
  MeshWriteOptions noted;
  MeshNotes notes;
  read_mesh(ours, &notes);
  noted.comment = notes.comments.back();
  write_mesh(mesh, ours_moved, noted);
  const auto status = [&](const std::string& file, const std::string& options) {
    return outcome_of(folder, "check " + file + field + options).status;
  };
  CHECK(status(theirs, "") == kFaultFound);
  CHECK(status(theirs, " --max-distance 0.3vox") == kExitSuccess);
  CHECK(status(theirs, " --max-distance 0.001vox") == kFaultFound);
  CHECK(status(ours_moved, " --max-distance 0.3vox") == kFaultFound);
  CHECK(status(ours_moved, " --tolerance 0.1") == kExitSuccess);
}

// A square, and one of twice its length above it: distances follow from the figure.
TEST_CASE("two meshes are compared without a volume") {
  const TemporaryFolder folder;
  const std::string square =
      folder.write("square.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  const std::string longer =
      folder.write("longer.obj", "v 0 0 .25\nv 2 0 .25\nv 2 1 .25\nv 0 1 .25\nf 1 2 3\nf 1 3 4\n");
  const std::string file = folder / "report.json";
  const auto report = [&](const std::string& arguments, int status) {
    CHECK(run_check(parsed("check " + arguments + " --quiet --json " + file)) == status);
    return parse_json(file_bytes(file), file);
  };
  const JsonValue both = report(square + " " + longer, kExitSuccess);
  const JsonValue &there = both["first"]["to_other"], &back = both["second"]["to_other"];
  CHECK(there["max"].number == doctest::Approx(0.25));
  CHECK(there["mean"].number == doctest::Approx(0.25));
  const double furthest = std::sqrt(1 + 0.25 * 0.25);
  CHECK(back["max"].number == doctest::Approx(furthest));
  CHECK(both["hausdorff"].number == back["max"].number);
  CHECK(back["furthest"].items[0].number == 2);
  // The mean square is .0625 over one half, and a third more over the other.
  CHECK(back["rms"].number == doctest::Approx(std::sqrt(0.0625 + 0.5 / 3)).epsilon(1e-4));
  CHECK(both["first"]["topology"]["boundary_loops"].number == 1);
  CHECK(both["first"]["genus"].number == 0);
  report(square + " " + longer + " --max-distance 1.1", kExitSuccess);
  report(square + " " + longer + " --max-distance 1", kFaultFound);
  const std::string turned =
      folder.write("turned.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 3 2\n");
  CHECK(report(square + " " + turned, kFaultFound)["second"]["faults"].keys ==
        std::vector<std::string>{"orientation"});
  CHECK_THROWS_AS(parsed("check a.ply b.ply --iso 3"), InputError);
  // Half a turn about the patient's head.
  const std::string lps = folder.write("lps.off",
                                       "OFF\n# SPACE=LPS\n3 1 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n"),
                    ras = folder.write("ras.off",
                                       "OFF\n# SPACE=RAS\n3 1 0\n-1 0 0\n0 -1 0\n0 0 1\n3 0 1 2\n");
  CHECK(report(lps + " " + ras, kExitSuccess)["hausdorff"].number < 1e-12);
}

TEST_CASE("caps that nearly touch are told of, and are no faults") {
  const TemporaryFolder folder;
  // Samples at the isovalue, on the box too: curves of the surface there run next to grid lines.
  Random random(1);
  std::string samples;
  for (int n = 0; n < 4 * 5 * 6; ++n) {
    const auto sample = static_cast<float>(50 * random.below(3));
    const auto bytes = std::bit_cast<std::array<char, 4>>(sample);
    samples.append(bytes.data(), bytes.size());
  }
  const std::string volume =
      folder.write("ties.raw", samples) + " --dims 4x5x6 --type float32 --cap";
  const std::string mesh = folder / "mesh.ply", file = folder / "report.json";
  const auto report = [&](const std::string& arguments) {
    const CommandLine line = parsed(arguments + " --quiet --json " + file);
    line.command == Command::check ? run_check(line) : run_mesh(line);
    return parse_json(file_bytes(file), file);
  };
  for (const bool ties : {true, false}) {
    CAPTURE(ties);
    const std::string at = volume + (ties ? " --iso 50" : " --iso 30");
    const double made = report(at + " -o " + mesh)["mesh"]["cap_close_places"].number;
    const JsonValue check = report("check " + mesh + " " + at)["check"];
    CHECK(check["cap_close_places"].number == made);
    CHECK(check["faults"]["near vertices"].is_null());
    CHECK((made > 20) == ties);
  }
}
