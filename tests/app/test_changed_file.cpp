// SPDX-License-Identifier: MIT
// A file that changes while it is meshed.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "app/input.h"
#include "app/mesh_run.h"
#include "app/parsed_line.h"
#include "app/progress.h"
#include "base/check.h"
#include "base/random.h"
#include "io/files/temporary_folder.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr std::size_t kSide = 24;

std::string random_bytes(std::uint64_t seed) {
  Random random(seed);
  std::string bytes(kSide * kSide * kSide, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random.below(256));
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
  const CommandLine line = parsed(path + " --dims 24x24x24 --type uint8 --iso 127.5 -q");
  const Input input = read_input(line);
  MeshRun run(line, input);
  ActsInBetween progress(line, act);
  try {
    mesh_input(run, progress, [](const std::string&) {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a file that changes while it is meshed is named, whatever the mesh came to") {
  const TemporaryFolder folder;
  const std::string path = folder.write("v.raw", random_bytes(1));
  std::uint64_t seed = 1;
  CHECK(refusal(path, [&] {
          std::fstream(path, std::ios::in | std::ios::out | std::ios::binary)
              << random_bytes(++seed);
        }) == path + ": changed while it was read");
  CHECK(seed > 1);
}

TEST_CASE("a file that is replaced or removed while it is meshed is meshed as it was") {
  const TemporaryFolder folder;
  const std::string path = folder.write("v.raw", random_bytes(1));
  CHECK(refusal(path, [] {}).empty());
  CHECK(refusal(path, [&] { folder.write("v.raw", random_bytes(2)); }).empty());
  CHECK(refusal(path, [&] { std::filesystem::remove(path); }).empty());
}
