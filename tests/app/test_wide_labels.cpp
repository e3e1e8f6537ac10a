// SPDX-License-Identifier: MIT
// Labels of 64 bits through the whole program: what becomes of ids is what becomes of the labels 1,
// 2 and 3 in their places, but for the numbers that are printed.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "app/parsed_line.h"
#include "app/run.h"
#include "base/check.h"
#include "base/text.h"
#include "io/files/temporary_folder.h"
#include "io/volume/volume_files.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr std::int64_t kIds[] = {0, 5, 720575940621039145, 720575940621039146};

// Two balls that touch and a third one; `number` of each sample's label.
template <class Number>
std::string balls(Number number) {
  std::string samples;
  for (int k = 0; k < 16; ++k) {
    for (int j = 0; j < 16; ++j) {
      for (int i = 0; i < 20; ++i) {
        const auto is_in = [&](int x, int y, int z, int square) {
          return (i - x) * (i - x) + (j - y) * (j - y) + (k - z) * (k - z) < square;
        };
        const std::size_t label = is_in(6, 8, 8, 20) ? 2 : is_in(12, 8, 8, 20) ? 3 : 0;
        const auto value = number(label == 0 && is_in(9, 3, 4, 5) ? 1 : label);
        samples.append(reinterpret_cast<const char*>(&value), sizeof value);
      }
    }
  }
  return samples;
}

std::string after(const std::string& text, const std::string& mark) {
  return text.substr(text.find(mark));
}

}  // namespace

TEST_CASE("ids of 64 bits are meshed as the small labels in their place, and named exactly") {
  const TemporaryFolder folder;
  const auto write = [&](const char* name, const char* type, const std::string& samples) {
    return folder.write(name, npy(type, false, "16, 16, 20", samples));
  };
  const std::string wide = write("w.npy", "<i8", balls([](std::size_t n) { return kIds[n]; }));
  const std::string small =
      write("s.npy", "|u1", balls([](std::size_t n) { return static_cast<std::uint8_t>(n); }));
  const auto mesh = [&](const std::string& input, const std::string& options,
                        const std::string& output) {
    const std::string path = folder.path(output);
    const std::string to = options.find("--shared") == options.npos ? " -o " : " ";
    REQUIRE(run_mesh(parsed(text(input, " -q ", options, to, path))) == kExitSuccess);
    return file_bytes(path);
  };
  const std::string body = "\nend_header\n";
  for (std::size_t n = 1; n < 4; ++n) {
    const std::string one = mesh(wide, text("--label ", kIds[n]), "o.ply");
    CHECK(after(one, body) == after(mesh(small, text("--label ", n), "o.ply"), body));
    CHECK(one.find(text(" label=", kIds[n], "\n")) != one.npos);
  }
  mesh(wide, "--label 5,720575940621039145 --json " + folder.path("o.json"), "o.ply");
  CHECK(file_bytes(folder.path("o.json")).find("\"labels\": [5, 720575940621039145]") !=
        std::string::npos);

  // info of a label: the field has no ids.
  CHECK(run_info(parsed(text("info ", wide, " -q --label ", kIds[2], " --json ",
                             folder.path("i.json")))) == kExitSuccess);
  CHECK(file_bytes(folder.path("i.json")).find("\"looks_like_labels\": false") !=
        std::string::npos);

  const std::string all = "--label all --json " + folder.path("o.json") + " --shared";
  const std::string ply = mesh(wide, all, "o.ply");
  CHECK(after(ply, body) == after(mesh(small, all, "o.ply"), body));
  CHECK(
      ply.find("comment label 2 is 720575940621039145\ncomment label 3 is 720575940621039146\n") !=
      ply.npos);
  mesh(wide, all, "o.ply");
  const std::string json = file_bytes(folder.path("o.json"));
  CHECK(json.find("\"range\": [0, 720575940621039146]") != json.npos);
  CHECK(json.find("\"type\": \"int64\"") != json.npos);
  CHECK(json.find("\"front\": 720575940621039146") != json.npos);
  const std::string cap = "--cap " + all;
  const std::string smesh = mesh(wide, cap, "o.smesh");
  CHECK(after(smesh, "\n0\n") == after(mesh(small, cap, "o.smesh"), "\n0\n"));
  CHECK(smesh.find("# region of label 2 is 720575940621039145\n") != smesh.npos);
  CHECK(mesh(wide, all, "o.vtp").find(R"(type="Int64" Name="label_front")") != std::string::npos);
  CHECK(mesh(small, all, "o.vtp").find(R"(type="Int32" Name="label_front")") != std::string::npos);
  CHECK_THROWS_WITH_AS(run_mesh(parsed(text(wide, " -q --iso 1 -o ", folder.path("o.ply")))),
                       text(wide,
                            ": its integers of 64 bits are from 0 to 720575940621039146, and "
                            "float64 does not hold all of them exactly: only labels without a "
                            "scale are read so, by --label")
                           .c_str(),
                       InputError);
}
