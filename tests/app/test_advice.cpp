// SPDX-License-Identifier: MIT
// What runs say of options that do not fit their samples, and that they keep silent otherwise.
#include "app/advice.h"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <functional>
#include <string>
#include <vector>

#include "app/parsed_line.h"
#include "app/progress.h"
#include "app/run.h"
#include "base/check.h"
#include "base/text.h"
#include "base/vec3.h"
#include "io/files/temporary_folder.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr int kBallSide = 12;

using ByteAt = std::function<int(const Vec3&)>;

// The warnings of a run on these samples, or its fault. `mesh`, if given, receives its mesh.
std::vector<std::string> warnings(const ByteAt& at, const std::string& options,
                                  TriMesh* mesh = nullptr, bool as_floats = false) {
  const TemporaryFolder folder;
  std::string samples;
  for (int n = 0; n < kBallSide * kBallSide * kBallSide; ++n) {
    const int i = n % kBallSide, j = n / kBallSide % kBallSide, k = n / kBallSide / kBallSide;
    const int sample = at({1.0 * i, 1.0 * j, 1.0 * k});
    const std::array bytes = std::bit_cast<std::array<char, 4>>(static_cast<float>(sample));
    as_floats ? samples.append(bytes.data(), bytes.size())
              : samples.append(1, static_cast<char>(sample));
  }
  const CommandLine line =
      parsed(text(folder.write("v.raw", samples), " --dims ", kBallSide, "x", kBallSide, "x",
                  kBallSide, " --type ", as_floats ? "float32 " : "uint8 ", options));
  std::vector<std::string> lines;
  try {
    const Input input = read_input(line);
    MeshRun run(line, input);
    ProgressBar none(mesh_stages(line), false);
    const TriMesh made = mesh_input(run, none);
    lines = warnings_of(run.notes);
    if (mesh) *mesh = made;
  } catch (const InputError& error) {
    lines.emplace_back(error.what());
  }
  return lines;
}

using Lines = std::vector<std::string>;

ByteAt ball(int inside, double middle) {
  return [=](const Vec3& p) { return distance(p, {middle, 5.3, 5.6}) < 4 ? inside : 0; };
}

}  // namespace

// A mask of 0 and 255 at 0.5 was meshed as steps, for seconds, without a word.
TEST_CASE("an isovalue near one of a mask's two values is told of") {
  CHECK(
      warnings(ball(255, 5.4), "--iso 0.5") ==
      Lines{"all samples are 0 or 255, as of a segmentation: --iso 127.5 is half-way, --label 255 "
            "is smooth"});
  CHECK(warnings(ball(1, 5.4), "--iso 1").size() == 1);
  CHECK(warnings(ball(255, 5.4), "--iso 100") == Lines{});
  CHECK(warnings(ball(255, 5.4), "--iso 0.5 --smooth 1vox") == Lines{});
  CHECK(warnings(ball(255, 5.4), "--label 255") == Lines{});
  const ByteAt three = [](const Vec3& p) { return p.z < 3 ? 7 : p.z < 6 ? 0 : 255; };
  CHECK(warnings(three, "--iso 0.5") == Lines{});
}

// Integers are what users type, and what many files of floats hold. Of integer types the level lies
// off all samples.
TEST_CASE("floats that equal the isovalue are told of where triangles get thin by them") {
  const ByteAt bowl = [](const Vec3& p) { return static_cast<int>(dot(p, p) / 4); };
  int told = 0;
  for (int isovalue = 56; isovalue < 80; isovalue += 4) {
    CAPTURE(isovalue);
    CHECK(warnings(bowl, text("--iso ", isovalue)) == Lines{});
    const Lines lines = warnings(bowl, text("--iso ", isovalue), nullptr, true);
    if (!lines.empty()) {
      ++told;
      CHECK(lines == Lines{text("samples equal the isovalue, which makes thin triangles: --iso ",
                                isovalue - 0.5, " gives better ones")});
    }
    CHECK(warnings(bowl, text("--quiet --iso ", isovalue), nullptr, true) == lines);
    CHECK(warnings(bowl, text("--iso ", isovalue - 0.5), nullptr, true) == Lines{});
  }
  CHECK(told > 0);
  CHECK(told < 6);
}

TEST_CASE("a label that the border cuts is told of, with the option that closes it") {
  CHECK(warnings(ball(1, 1.4), "--label 1") ==
        Lines{"the mesh of label 1 is open at the volume's border: --cap closes it"});
  CHECK(warnings(ball(1, 1.4), "--label 1 -q").size() == 1);
  CHECK(warnings(ball(1, 1.4), "--label 1 --cap") == Lines{});
  CHECK(warnings(ball(1, 5.4), "--label 1") == Lines{});
  // All of the border: it is open there, and has no loop.
  const ByteAt around = [](const Vec3& p) { return 1 - ball(1, 5.4)(p); };
  CHECK(warnings(around, "--label 1") ==
        Lines{"the mesh of label 1 is open at the volume's border: --cap closes it"});
  CHECK(warnings(around, "--label 1 --cap") == Lines{});
  Diagnostics notes;
  advise_of_border(std::vector<std::int64_t>{}, notes);
  CHECK(notes.empty());
  advise_of_border(std::vector<std::int64_t>{2, 5}, notes);
  CHECK(warnings_of(notes) ==
        Lines{"the meshes of labels 2, 5 are open at the volume's border: --cap closes them"});
}

// It was refused with "no surface", where --shared gives the block.
TEST_CASE("a label that fills the volume is a block with --cap") {
  const ByteAt full = [](const Vec3&) { return 1; };
  TriMesh block;
  CHECK(warnings(full, "--label 1 --cap", &block) == Lines{});
  CHECK(block.points.size() == 8);
  CHECK(block.faces.size() == 12);
  // A part that is joined knows of the label by its options alone.
  const TemporaryFolder folder;
  const std::string volume = folder.write("full.raw", std::string(64, 1)),
                    one = folder / "one.mesh.part";
  const std::string mesh = folder / "whole.ply", other = folder / "joined.ply";
  const std::string options = volume + " --dims 4x4x4 --type uint8 --label 1 --cap -q -o ";
  CHECK(run_mesh(parsed(options + mesh)) == kExitSuccess);
  CHECK(run_mesh(parsed(options + one + " --part 1/1")) == kExitSuccess);
  CHECK(run_join(parsed("join " + one + " --volume " + volume + " -q -o " + other)) ==
        kExitSuccess);
  CHECK(file_bytes(other) == file_bytes(mesh));
  CHECK(warnings(full, "--label 1") ==
        Lines{"no surface around label 1, which fills the volume: --cap makes the block "
              "(--allow-empty accepts that)"});
  CHECK(warnings(full, "--iso 0.5 --cap").size() == 1);  // as before
}
