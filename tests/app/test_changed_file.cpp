// SPDX-License-Identifier: MIT
// A file that changes while it is meshed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "app/input.h"
#include "app/mesh_run.h"
#include "app/parsed_line.h"
#include "app/progress.h"
#include "base/check.h"
#include "io/files/temporary_folder.h"
#include "refusal.h"
#include "volume/sampled.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr int kSide = 24;

// Samples of a ball, 100 on its surface.
std::string ball(double radius) {
  std::string bytes;
  for_each_index({kSide, kSide, kSide}, [&](int i, int j, int k) {
    const double r = std::hypot(i - 11.5, j - 11.5, k - 11.5);
    const double value = std::clamp(100 + 10 * (radius - r), 0.0, 255.0);
    bytes += static_cast<char>(static_cast<unsigned char>(value));
  });
  return bytes;
}

// Calls act() whenever there is progress.
template <class Act>
class ActsInBetween : public Progress {
 public:
  ActsInBetween(const CommandLine& line, Act act) : Progress(mesh_stages(line)), act_(act) {}

 private:
  void draw(const std::string&, double) override { act_(); }
  Act act_;
};

// Returns why the file is not meshed.
template <class Act>
std::string refusal(const std::string& path, Act act) {
  const CommandLine line = parsed(path + " --dims 24x24x24 --type uint8 --iso 99.5 -q");
  const Input input = read_input(line);
  MeshRun run(line, input);
  ActsInBetween progress(line, act);
  return refusal_by([&] { mesh_input(run, progress); });
}

}  // namespace

TEST_CASE("a file that changes while it is meshed is named, whatever the mesh came to") {
  const TemporaryFolder folder;
  const std::string path = folder.write("v.raw", ball(8));
  int calls = 0;
  CHECK(refusal(path, [&] {
          if (++calls > 1) return;
          std::fstream(path, std::ios::in | std::ios::out | std::ios::binary) << ball(8.1);
        }) == path + ": changed while it was read");
  CHECK(calls > 0);
}

TEST_CASE("a file that is replaced or removed while it is meshed is meshed as it was") {
  const TemporaryFolder folder;
  const std::string path = folder.write("v.raw", ball(8));
  CHECK(refusal(path, [] {}).empty());
  CHECK(refusal(path, [&] { folder.write("v.raw", ball(7)); }).empty());
  CHECK(refusal(path, [&] { std::filesystem::remove(path); }).empty());
}
