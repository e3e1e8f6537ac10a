// SPDX-License-Identifier: MIT
// Solids of other programs' forms, and of bytes that are none.
#include "io/solid/read_solid.h"

#include <doctest/doctest.h>

#include "base/frame.h"
#include "cases.h"
#include "check/check_solid.h"
#include "io/damage.h"
#include "io/mesh/mesh_files.h"
#include "io/solid/solids.h"
#include "refusal.h"

using namespace deliso;
using namespace deliso::test;

namespace {

const std::string kOneCell = "Tetrahedra 1\n1 2 3 4 6\n";
const std::string kFourPoints = "Vertices\n4\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\n";

std::string medit_refusal(const std::string& body) {
  return refusal_by(
      [&] { parse_solid("MeshVersionFormatted 2\n" + body, SolidFormat::medit, "solid.mesh"); });
}

// Two tetrahedra as VTK writes them, in any form.
std::string vtu(const VtkForm& form, bool wide, const std::string& drop = "") {
  std::string appended;
  std::uint64_t seed = 1;
  const auto array = [&](const std::string& name, const std::string& type, const std::string& block,
                         int components) {
    if (name == drop) return std::string();
    std::string tag =
        text("<DataArray type=\"", type, "\" Name=\"", name, "\" NumberOfComponents=\"", components,
             "\" format=\"", form.format, "\"");
    if (form.format != "appended") return vtk_element(tag, block);
    tag += text(" offset=\"", appended.size(), "\"");
    appended += block;
    return vtk_element(tag, "");
  };
  const auto integers = [&](const std::string& name, const std::vector<double>& values) {
    return array(name, wide ? "Int64" : "Int32",
                 wide ? vtk_numbers<std::int64_t>(values, form, ++seed)
                      : vtk_numbers<std::int32_t>(values, form, ++seed),
                 1);
  };
  const std::vector<double> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  std::string file = text("<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"",
                          form.order == std::endian::little ? "Little" : "Big", "Endian\"");
  if (form.header_size == 8) file += " header_type=\"UInt64\"";
  if (form.block > 0) file += " compressor=\"vtkZLibDataCompressor\"";
  file += ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n<PointData/>\n";
  file += "<CellData>\n";
  file += integers("other", {1, 2});
  file += integers("region", {7, -3});
  file += "</CellData>\n<Points>\n";
  file += array(
      "Points", wide ? "Float64" : "Float32",
      wide ? vtk_numbers<double>(points, form, ++seed) : vtk_numbers<float>(points, form, ++seed),
      3);
  file += "</Points>\n<Cells>\n";
  file += integers("connectivity", {0, 1, 2, 3, 4, 3, 2, 1});
  file += integers("offsets", {4, 8});
  file += array("types", "UInt8", vtk_numbers<std::uint8_t>({10, 10}, form, ++seed), 1);
  file += "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
  if (form.format == "appended") {
    file +=
        "<AppendedData encoding=\"" + form.encoding + "\">\n_" + appended + "\n</AppendedData>\n";
  }
  return file + "</VTKFile>\n";
}

const char* flaw_of(const SolidFile& file) {
  const Solid& solid = file.solid;
  for (const Vec3& p : solid.points) {
    if (!in_range(p)) return "a point out of range";
  }
  for (const Tetrahedron& cell : solid.cells) {
    for (const VertexId v : cell) {
      if (v >= solid.points.size()) return "a corner that is no point";
    }
  }
  for (const Wall& wall : solid.walls) {
    for (const VertexId v : wall.v) {
      if (v >= solid.points.size()) return "a corner of a triangle that is no point";
    }
  }
  if (solid.regions.size() != solid.cells.size()) return "a cell without a region";
  for (const RegionId r : solid.regions) {
    if (r == 0 || r > file.labels.size()) return "a region without a label";
  }
  return nullptr;
}

}  // namespace

TEST_CASE("VTU in every encoding, with 32 and 64 bits") {
  int forms = 0;
  for (const VtkForm& form : all_vtk_forms()) {
    for (const bool wide : {false, true}) {
      const SolidFile file = parse_solid(vtu(form, wide), SolidFormat::vtu, "solid.vtu");
      CHECK(file.solid.points.size() == 5);
      CHECK(file.solid.points[4] == Vec3{1, 1, 1});
      CHECK(file.solid.cells == std::vector<Tetrahedron>{{0, 1, 2, 3}, {4, 3, 2, 1}});
      CHECK(file.labels == std::vector<std::int64_t>{-3, 7});
      CHECK(file.solid.regions == std::vector<RegionId>{2, 1});
      ++forms;
    }
  }
  CHECK(forms > 20);
  const VtkForm ascii{"ascii", "", std::endian::little, 4, 0};
  CHECK(parse_solid(vtu(ascii, true, "region"), SolidFormat::vtu, "x").labels ==
        std::vector<std::int64_t>{1});
  for (const char* name : {"Points", "connectivity", "offsets", "types"}) {
    CHECK(refusal_by([&] { parse_solid(vtu(ascii, true, name), SolidFormat::vtu, "x"); }) != "");
  }
}

TEST_CASE("VTU that is no solid of tetrahedra is refused") {
  const VtkForm ascii{"ascii", "", std::endian::little, 4, 0};
  const std::string sound = vtu(ascii, false);
  const auto with = [&](const std::string& old, const std::string& now) {
    std::string bytes = sound;
    const std::size_t at = bytes.find(old);
    REQUIRE(at != std::string::npos);
    bytes.replace(at, old.size(), now);
    return refusal_by([&] { parse_solid(bytes, SolidFormat::vtu, "solid.vtu"); });
  };
  CHECK(with("10 10", "10 12") == "'solid.vtu': a cell has the type 12: it is no tetrahedron");
  CHECK(with("4 8", "4 9") == "'solid.vtu': a cell ends at corner 9, the one before at 4");
  CHECK(with("4 3 2 1", "5 3 2 1") == "'solid.vtu': a corner of a cell is 5, not one of 5 points");
  CHECK(with("0 1 2 3", "-1 1 2 3") ==
        "'solid.vtu': a corner of a cell is -1, not one of 5 points");
  CHECK(with("0 0 0 1", "nan 0 0 1") ==
        "'solid.vtu': point 0 has a coordinate that is no number up to 1e+30 in size");
  CHECK(with("NumberOfCells=\"2\"", "NumberOfCells=\"4000000000\"") ==
        "'solid.vtu': 4000000000 cells are too many");
  CHECK(with("NumberOfCells=\"2\"", "NumberOfCells=\"1000000000\"") != "");
  CHECK(with("</UnstructuredGrid>", "") == "'solid.vtu': ends before </UnstructuredGrid>");
  CHECK(with("<Cells>", "<Piece><Cells>") ==
        "'solid.vtu': has several pieces: only one is supported");
}

TEST_CASE("Medit's format with what other programs add") {
  const std::string bytes =
      "MeshVersionFormatted 1 # a comment\n\nDimension\n3\n#Vertices 9\n" + kFourPoints +
      "Corners 2 1\n4\nEdges\n1\n1 2 0\nTriangles 1 1 3 2 5\nNormals 1 0 0 1.5 " + kOneCell +
      "Ridges 1 1\nEnd and more";
  const SolidFile file = parse_solid(bytes, SolidFormat::medit, "solid.mesh");
  CHECK(file.solid.points.size() == 4);
  CHECK(file.solid.points[3] == Vec3{0, 0, 1});
  CHECK(file.solid.cells == std::vector<Tetrahedron>{{0, 1, 2, 3}});
  CHECK(file.labels == std::vector<std::int64_t>{6});
  REQUIRE(file.solid.walls.size() == 1);
  CHECK(file.solid.walls[0].v == Triangle{0, 2, 1});
  CHECK(file.solid.walls[0].kind == 5);
}

TEST_CASE("Medit's format: faults have their words") {
  const std::string end = "End\n";
  CHECK(refusal_by([&] { parse_solid("", SolidFormat::medit, "x"); }) ==
        "'x': does not begin with MeshVersionFormatted");
  CHECK(medit_refusal(kFourPoints + kOneCell) == "'solid.mesh': ends before End");
  CHECK(medit_refusal("Dimension 2 " + end) == "'solid.mesh': has 2 dimensions, not 3");
  CHECK(medit_refusal("Hexahedra 1 1 2 3 4 5 6 7 8 0 " + end) ==
        "'solid.mesh': 'Hexahedra' is not supported");
  CHECK(medit_refusal(kFourPoints + "Tetrahedra 1 1 2 3 5 0 " + end) ==
        "'solid.mesh': a corner is point 5, and there are 4");
  CHECK(medit_refusal(kFourPoints + "Tetrahedra 1 0 2 3 4 0 " + end) ==
        "'solid.mesh': a corner is point 0");
  CHECK(medit_refusal("Tetrahedra 1000000000000 1 2 3 4 0 1 " + end) ==
        "'solid.mesh': a corner is 'End' at byte 63");
  CHECK(medit_refusal("Vertices 1 0 x 0 0 " + end) ==
        "'solid.mesh': a coordinate is 'x' at byte 37");
  CHECK(medit_refusal("Vertices 1 0 1e31 0 0 " + end) ==
        "'solid.mesh': point 0 has a coordinate that is no number up to 1e+30 in size");
  CHECK(medit_refusal("Vertices -1 " + kOneCell + end) ==
        "'solid.mesh': the count of a section is '-1' at byte 34");
  CHECK(medit_refusal(kFourPoints + end) == "'solid.mesh': has no tetrahedra");
}

TEST_CASE("files are read by their endings") {
  const TemporaryFolder folder;
  const Solid solid = cube(2);
  for (const char* name : {"solid.mesh", "solid.vtu"}) {
    write_solid(solid, {}, folder / name);
    CHECK(read_solid(folder / name).solid.cells == solid.cells);
  }
  write_solid(solid, {}, folder / "solid.msh");
  CHECK(refusal_by([&] { read_solid(folder / "solid.msh"); }) ==
        "'" + folder / "solid.msh" + "': solids are read from .mesh and .vtu");
  CHECK(refusal_by([&] { read_solid(folder / "none.mesh"); }) != "");
}

TEST_CASE("any bytes give a solid or a message of one line") {
  int solids = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= cases(20000u); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const bool is_medit = seed % 2 == 0;
    const SolidFormat format = is_medit ? SolidFormat::medit : SolidFormat::vtu;
    SolidWriteOptions options;
    options.format = format;
    static const std::string medit = written(cube(2), {}, {.format = SolidFormat::medit});
    static const std::string raw = written(cube(2), {}, {.format = SolidFormat::vtu});
    static const std::vector<VtkForm> forms = all_vtk_forms();
    const std::string sound = is_medit        ? medit
                              : seed % 4 == 1 ? raw
                                              : vtu(forms[seed / 4 % forms.size()], seed % 8 == 3);
    const std::string bytes = damaged(sound, random);
    try {
      const SolidFile file = parse_solid(bytes, format, "solid");
      const char* flaw = flaw_of(file);
      if (flaw) FAIL_CHECK(flaw);
      if (solids % 8 == 0) check_solid(file.solid);  // whatever it is, it can be checked
      ++solids;
    } catch (const InputError& error) {
      const char* flaw = flaw_of(error);
      if (flaw) FAIL_CHECK(flaw);
      ++refused;
    }
  }
  CHECK(solids > static_cast<int>(cases(1000u)));
  CHECK(refused > static_cast<int>(cases(1000u)));
}
