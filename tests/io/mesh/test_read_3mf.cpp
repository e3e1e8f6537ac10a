// SPDX-License-Identifier: MIT
// 3MF of other programs, and archives at fault. test_faults.cpp has faults of models.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "base/check.h"
#include "io/mesh/containers.h"
#include "io/mesh/read_mesh.h"
#include "refusal.h"

using namespace deliso;
using namespace deliso::test;

namespace {

TriMesh read_3mf(const std::string& bytes, MeshNotes* notes = nullptr,
                 const ExpansionBudget& budget = {}) {
  return parse_mesh(bytes, MeshFormat::three_mf, "in", notes, budget);
}

std::string fault_of_3mf(const std::string& bytes) {
  return refusal_by([&] { read_3mf(bytes); });
}

}  // namespace

TEST_CASE("3MF of another program: units, components, turned and mirrored") {
  for (const bool deflated : {false, true}) {
    for (const bool wide : {false, true}) {
      MeshNotes notes;
      const TriMesh mesh = read_3mf(three_mf_file(rich_model(), {deflated, wide}), &notes);
      CHECK(notes.comments == std::vector<std::string>{"made by hand"});
      REQUIRE(mesh.points.size() == 8);
      REQUIRE(mesh.faces.size() == 8);
      // Mirrored in x and moved, then turned about z and moved; in millimeters.
      CHECK(mesh.points[0] == Vec3{-200, 100, 350});
      CHECK(mesh.points[1] == Vec3{-200, 90, 350});
      CHECK(mesh.points[4] == Vec3{0, 0, 50});
      CHECK(mesh.points[5] == Vec3{0, 10, 50});
      CHECK(mesh.faces[0].v == Triangle{0, 1, 2});
      CHECK(mesh.faces[4].v == Triangle{4, 6, 5});
    }
  }
}

TEST_CASE("faults of the archive have a line each") {
  CHECK(fault_of_3mf("") == "'in': is no zip archive, or is cut short");
  CHECK(fault_of_3mf(zip_file({})) == "'in': has no part '_rels/.rels'");
  CHECK(fault_of_3mf(zip_file({{"_rels/.rels", "<Relationships/>"}})) ==
        "'in': is a zip archive without a 3D model");
  CHECK(fault_of_3mf(zip_file({{"_rels/.rels", kRelations}})) ==
        "'in': has no part 'Model/it.model'");
  const std::string sound = three_mf_file(rich_model(), {.deflated = true});
  const auto with = [&](std::size_t at, const std::string& bytes) {
    std::string file = sound;
    file.replace(at, bytes.size(), bytes);
    return fault_of_3mf(file);
  };
  const std::size_t entry = sound.rfind("PK\1\2"), part = sound.rfind("PK\3\4");
  CHECK(with(entry + 8, "\1") == "'in': part 'model/IT.model': is encrypted");
  CHECK(with(entry + 10, "\14") == "'in': part 'model/IT.model': compression 12 is not supported");
  CHECK(with(entry + 16, "????") == "'in': part 'model/IT.model': has another size or checksum");
  CHECK(with(entry + 24, little(0xfffffffe, 4)) == "'in': part 'model/IT.model': is cut short");
  CHECK(with(entry + 24, little(9, 4)) == "'in': part 'model/IT.model': has another size");
  CHECK(with(entry + 42, little(9, 4)) == "'in': part 'model/IT.model': is damaged");
  CHECK(with(part + 60, "\7\7\7\7\7\7\7\7\7").starts_with("'in': part 'model/IT.model': "));
  CHECK(with(entry, "XX") == "'in': is a damaged zip archive");
  CHECK(fault_of_3mf(sound.substr(0, sound.size() - 20)) ==
        "'in': is no zip archive, or is cut short");
}

TEST_CASE("components within components do not fill the memory") {
  std::string model =
      "<model><resources><object id=\"0\"><mesh><vertices><vertex x=\"0\" y=\"0\" "
      "z=\"0\"/></vertices></mesh></object>";
  for (int n = 1; n <= 40; ++n) {
    const std::string inner = text("<component objectid=\"", n - 1, "\"/>");
    model += text("<object id=\"", n, "\"><components>", inner, inner, "</components></object>");
  }
  model += "</resources><build><item objectid=\"40\"/></build></model>";
  CHECK_THROWS_WITH_AS(read_3mf(three_mf_file(model), nullptr, {.free_bytes = 1 << 20, .ratio = 1}),
                       doctest::Contains("in memory"), InputError);
}
