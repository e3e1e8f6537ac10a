// SPDX-License-Identifier: MIT
// 3MF: what write_mesh writes comes back to the last bit, and so do files of other programs.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "base/check.h"
#include "base/random.h"
#include "io/mesh/containers.h"
#include "io/mesh/read_mesh.h"
#include "io/mesh/written_mesh.h"

using namespace deliso;
using namespace deliso::test;

namespace {

TriMesh read_3mf(const std::string& bytes, MeshNotes* notes = nullptr) {
  return parse_mesh(bytes, MeshFormat::three_mf, "in", notes);
}

std::string fault_of_3mf(const std::string& bytes) {
  try {
    read_3mf(bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

std::string model_with(const std::string& old, const std::string& now) {
  std::string model = rich_model();
  const std::size_t at = model.find(old);
  REQUIRE_MESSAGE(at != std::string::npos, old);
  return model.replace(at, old.size(), now);
}

}  // namespace

TEST_CASE("a written 3MF comes back to the last bit, with its comment") {
  TriMesh mesh = random_sphere(4);
  mesh.frame.origin = {0.1, -4e4, 1e-7};
  MeshNotes notes;
  const TriMesh read =
      read_3mf(written(mesh, {.format = MeshFormat::three_mf, .comment = "deliso x"}), &notes);
  CHECK(notes.comments == std::vector<std::string>{"deliso x"});
  CHECK(notes.rounding == 0);
  CHECK(read.points == mesh.world_points());
  REQUIRE(read.faces.size() == mesh.faces.size());
  for (FaceId f = 0; f < mesh.faces.size(); ++f) CHECK(read.faces[f].v == mesh.faces[f].v);
  CHECK(read_3mf(written(TriMesh{}, {.format = MeshFormat::three_mf})).points.empty());
}

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

TEST_CASE("faults of 3MF have a line each") {
  CHECK(fault_of_3mf("") == "'in': is no zip archive, or is cut short");
  CHECK(fault_of_3mf(zip_file({})) == "'in': has no part '_rels/.rels'");
  CHECK(fault_of_3mf(zip_file({{"_rels/.rels", "<Relationships/>"}})) ==
        "'in': is a zip archive without a 3D model");
  CHECK(fault_of_3mf(zip_file({{"_rels/.rels", kRelations}})) ==
        "'in': has no part 'Model/it.model'");
  for (const std::array<std::string, 3>& row : std::vector<std::array<std::string, 3>>{
           {"centimeter", "parsec", "unit 'parsec' is not known"},
           {"x=\"1\"", "x=\"one\"", "attribute x of a vertex is 'one'"},
           {" z=\"1\"", "", "attribute z of a vertex is ''"},
           {"z=\"1\"", "z=\"1e31\"",
            "coordinate z of vertex 3 is 9.999999999999999e+31, not a number up to 1e+30 in size"},
           {"v3=\"3\"", "v3=\"4\"", "corner v3 of a triangle is '4', not one of 4 vertices"},
           {"v3=\"3\"", "v3=\"-1\"", "corner v3 of a triangle is '-1', not one of 4 vertices"},
           {"id=\"two\"", "id=\"7\"", "has two objects of one id"},
           {"objectid=\"two\"", "objectid=\"3\"", "has no object '3'"},
           {"objectid=\"7\"/>", "objectid=\"two\"/>", "object 'two' is a component of itself"},
           {"30\"/>", "\"/>", "transform '-1 0 0 0 1 0 0 0 1 10 20 ' is not 12 numbers"},
           {"<item ", "<item p:path=\"/a.model\" ",
            "has objects in further parts of the archive, which is not supported"},
           {"</model>", "", "its model ends before </model>"}}) {
    const std::string &old = row[0], &now = row[1], &fault = row[2];
    CAPTURE(old);
    CAPTURE(now);
    const std::string found = fault_of_3mf(three_mf_file(model_with(old, now)));
    CHECK(found == "'in': " + fault);
  }
}

TEST_CASE("faults of the archive have a line each") {
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
  CHECK(with(entry + 24, low_bytes(0xfffffffe, 4)) == "'in': part 'model/IT.model': is cut short");
  CHECK(with(entry + 24, low_bytes(9, 4)) == "'in': part 'model/IT.model': has another size");
  CHECK(with(entry + 42, low_bytes(9, 4)) == "'in': part 'model/IT.model': is damaged");
  CHECK(with(part + 60, "\7\7\7\7\7\7\7\7\7").starts_with("'in': part 'model/IT.model': "));
  CHECK(with(entry, "XX") == "'in': is a damaged zip archive");
  CHECK(fault_of_3mf(sound.substr(0, sound.size() - 20)) ==
        "'in': is no zip archive, or is cut short");
}

TEST_CASE("no mutation of a model does harm") {
  const std::string sound = rich_model();
  const std::string pieces[] = {"<",         ">",     "\"",    "<object id=\"7\">",
                                "</object>", "1e999", "-1",    "<item objectid=\"7\"/>",
                                "nan",       "<!--",  "<mesh>"};
  int meshes = 0, errors = 0;
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    Random random(seed);
    std::string model = sound;
    for (std::uint32_t n = 1 + random.below(3); n > 0; --n) {
      const std::size_t at = random.below(static_cast<std::uint32_t>(model.size()));
      model.replace(at, random.below(12), pieces[random.below(std::size(pieces))]);
    }
    try {
      const TriMesh mesh = read_3mf(three_mf_file(model));
      for (const Face& face : mesh.faces) {
        for (const VertexId v : face.v) REQUIRE(v < mesh.points.size());
      }
      for (const Vec3& p : mesh.points) REQUIRE(in_range(p));
      ++meshes;
    } catch (const InputError&) {
      ++errors;
    }
  }
  CHECK(meshes > 1000);
  CHECK(errors > 1000);
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
  CHECK(fault_of_3mf(three_mf_file(model)) == "'in': places its objects more than 100 times");
}
