// SPDX-License-Identifier: MIT
// Files of solids, read again by the lines here: what they hold is the solid in the world.
#include "io/solid/write_solid.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include "io/files/file_size_limit.h"
#include "io/files/text_scan.h"
#include "io/solid/read_solid.h"
#include "io/solid/solids.h"
#include "refusal.h"

using namespace deliso;
using namespace deliso::test;

namespace {

using Numbers = std::vector<double>;

double real(std::size_t n) {
  return static_cast<double>(n);
}

// The lines of a text file without comments.
std::vector<std::string> lines_of(const std::string& bytes) {
  std::vector<std::string> lines;
  std::istringstream in(bytes);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with('#')) lines.push_back(line);
  }
  return lines;
}

Numbers numbers_of(const std::string& line) {
  const auto numbers = to_doubles(line);
  REQUIRE(numbers);
  return *numbers;
}

// The lines between $Name and $EndName of Gmsh's format.
std::vector<std::string> section(const std::string& bytes, const std::string& name) {
  const std::size_t begin = bytes.find("$" + name + "\n"), end = bytes.find("$End" + name + "\n");
  if (begin == std::string::npos || end == std::string::npos) return {};
  return lines_of(bytes.substr(begin + name.size() + 2, end - begin - name.size() - 2));
}

constexpr SolidFormat kFormats[] = {SolidFormat::medit, SolidFormat::vtu, SolidFormat::gmsh};

bool is_positive(const Solid& solid, const Tetrahedron& cell) {
  const auto& p = solid.points;
  return orient3d(p[cell[0]], p[cell[1]], p[cell[2]], p[cell[3]]) > 0;
}

}  // namespace

TEST_CASE("Medit's format, byte by byte") {
  Solid solid;
  solid.points = {{0, 0, 0}, {1, 0, 0}, {0, .1, 0}, {0, 0, 1e-7}};
  solid.cells = {{0, 1, 2, 3}};
  solid.regions = {1};
  solid.walls = {{{0, 2, 1}, 0, 1}, {{0, 1, 3}, 0, 1, 4}};
  SolidWriteOptions options;
  options.format = SolidFormat::medit;
  options.labels = {{7, "bone"}};
  options.comment = "made -- here";
  CHECK(written(solid, {}, options) ==
        "MeshVersionFormatted 2\n# DelIso\n# made -? here\n# region 7: label 7, bone\n"
        "# marker 1: region 0 in front, 7 behind, kind 0\n"
        "# marker 2: region 0 in front, 7 behind, kind 4\n"
        "Dimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 0.1 0 0\n0 0 1e-07 0\n"
        "Triangles\n2\n1 3 2 1\n1 2 4 2\nTetrahedra\n1\n1 2 3 4 7\nEnd\n");
}

TEST_CASE("files hold the solid in the world: cells positive, walls seen from in front") {
  for (const bool mirrored : {false, true}) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      CAPTURE(seed);
      const Solid solid = cube(3, seed);
      const Frame frame = turned_frame(mirrored);
      REQUIRE(frame.left_handed() == mirrored);
      const Solid world = written_solid(solid, frame);
      REQUIRE(world.cells.size() == 6);
      for (std::size_t v = 0; v < 8; ++v) {
        CHECK(world.points[VertexId(v)] == frame.to_world(solid.points[VertexId(v)]));
      }
      for (const Tetrahedron& cell : world.cells) CHECK(is_positive(world, cell));
      // Walls face away from the middle of the cell behind.
      for (const Wall& wall : world.walls) {
        for (std::size_t c = 0; c < 6; ++c) {
          Tetrahedron cell = world.cells[c];
          const auto other = std::ranges::find_if(
              cell, [&](VertexId v) { return std::ranges::find(wall.v, v) == wall.v.end(); });
          const auto inside = std::ranges::count_if(
              cell, [&](VertexId v) { return std::ranges::find(wall.v, v) != wall.v.end(); });
          if (inside != 3) continue;
          const int side = orient3d(world.points[wall.v[0]], world.points[wall.v[1]],
                                    world.points[wall.v[2]], world.points[*other]);
          CHECK(side == (world.regions[c] == wall.behind ? -1 : 1));
        }
      }
      for (const SolidFormat format : {SolidFormat::medit, SolidFormat::vtu}) {
        SolidWriteOptions options;
        options.format = format;
        const std::string bytes = written(solid, frame, options);
        CHECK(bytes == written(solid, frame, options));
        CHECK(bytes.find("SPACE=RAS") != std::string::npos);
        const SolidFile file = parse_solid(bytes, format, "solid");
        CHECK(file.solid.points == world.points);
        CHECK(file.solid.cells == world.cells);
        CHECK(file.solid.regions == world.regions);
        CHECK(file.labels == std::vector<std::int64_t>{1, 2, 3});
        REQUIRE(file.solid.walls.size() == (format == SolidFormat::medit ? world.walls.size() : 0));
        // A marker stands for one pair of sides.
        std::map<std::uint32_t, std::set<std::pair<RegionId, RegionId>>> sides;
        for (std::size_t w = 0; w < file.solid.walls.size(); ++w) {
          CHECK(file.solid.walls[w].v == world.walls[w].v);
          sides[file.solid.walls[w].kind].insert({world.walls[w].front, world.walls[w].behind});
        }
        for (const auto& [marker, pairs] : sides) CHECK(pairs.size() == 1);
      }
    }
  }
}

TEST_CASE("Gmsh's format: each point and element once, volumes bounded by their surfaces") {
  const Solid solid = cube(2, 5);
  SolidWriteOptions options;
  options.format = SolidFormat::gmsh;
  options.labels = {{12, "soft \"tissue\""}, {5, ""}};
  const std::string bytes = written(solid, {}, options);
  CHECK(bytes.starts_with("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"));
  CHECK(section(bytes, "PhysicalNames") ==
        std::vector<std::string>{"3", "2 1 \"soft 'tissue'|outside\"", "2 3 \"5|soft 'tissue'\"",
                                 "3 12 \"soft 'tissue'\""});

  const auto entities = section(bytes, "Entities");
  REQUIRE(entities.size() == 6);
  CHECK(entities[0] == "0 0 3 2");
  std::map<int, std::vector<int>> bounds;  // of each volume
  for (std::size_t n = 4; n < 6; ++n) {
    const Numbers row = numbers_of(entities[n]);
    CHECK(row[7] == 1);
    CHECK(row[8] == (n == 4 ? 12 : 5));
    REQUIRE(row.size() == 10 + static_cast<std::size_t>(row[9]));
    for (std::size_t k = 10; k < row.size(); ++k) {
      bounds[static_cast<int>(row[0])].push_back(static_cast<int>(row[k]));
    }
  }
  // Markers: 1 and 2 between the outside and a region, 3 with region 1 in front of 2.
  CHECK(bounds[1] == std::vector<int>{1, -3});
  CHECK(bounds[2] == std::vector<int>{2, 3});

  const auto nodes = section(bytes, "Nodes");
  const Numbers head = numbers_of(nodes[0]);
  CHECK(head == Numbers{head[0], 8, 1, 8});
  std::map<int, Vec3> found;
  std::size_t line = 1;
  for (int block = 0; block < head[0]; ++block) {
    const auto count = static_cast<std::size_t>(numbers_of(nodes[line])[3]);
    REQUIRE(nodes.size() >= line + 1 + 2 * count);
    for (std::size_t n = 1; n <= count; ++n) {
      const Numbers p = numbers_of(nodes[line + count + n]);
      found[static_cast<int>(numbers_of(nodes[line + n])[0])] = {p[0], p[1], p[2]};
    }
    line += 1 + 2 * count;
  }
  CHECK(line == nodes.size());
  REQUIRE(found.size() == 8);
  for (int v = 0; v < 8; ++v) CHECK(found[v + 1] == solid.points[VertexId(v)]);

  const auto elements = section(bytes, "Elements");
  const std::size_t all = solid.walls.size() + 6;
  CHECK(numbers_of(elements[0]) == Numbers{5, real(all), 1, real(all)});
  std::set<Numbers> walls, cells;
  std::size_t number = 0;
  for (std::size_t n = 1; n < elements.size();) {
    const Numbers block = numbers_of(elements[n++]);
    for (int k = 0; k < block[3]; ++k) {
      Numbers row = numbers_of(elements[n++]);
      CHECK(row[0] == ++number);
      row[0] = block[1];  // the entity
      CHECK(block[2] == (block[0] == 2 ? 2 : 4));
      (block[0] == 2 ? walls : cells).insert(row);
    }
  }
  std::set<Numbers> wanted;
  for (std::size_t c = 0; c < 6; ++c) {
    Numbers row{1. * solid.regions[c]};
    for (const VertexId v : solid.cells[c]) row.push_back(v + 1.);
    wanted.insert(row);
  }
  CHECK(cells == wanted);
  wanted.clear();
  for (const Wall& wall : solid.walls) {
    Numbers row{wall.front == kOutside ? 1. * wall.behind : 3};
    const bool is_turned = wall.front > wall.behind;
    for (const int i : {0, is_turned ? 2 : 1, is_turned ? 1 : 2}) row.push_back(wall.v[i] + 1.);
    wanted.insert(row);
  }
  CHECK(walls == wanted);
}

TEST_CASE("TetGen's three files, by the name of any") {
  const Solid solid = written_solid(cube(2, 3), {});
  for (const char* name : {"solid.node", "solid.ELE", "solid.face"}) {
    const TemporaryFolder folder;
    write_solid(solid, {}, folder / name);
    CHECK(folder.file_count() == 3);
    const auto node = lines_of(file_bytes(folder / "solid.node"));
    const auto ele = lines_of(file_bytes(folder / "solid.ele"));
    const auto face = lines_of(file_bytes(folder / "solid.face"));
    REQUIRE(node.size() == 9);
    REQUIRE(ele.size() == 7);
    REQUIRE(face.size() == solid.walls.size() + 1);
    CHECK(node[0] == "8 3 0 0");
    CHECK(ele[0] == "6 4 1");
    CHECK(numbers_of(face[0]) == Numbers{real(solid.walls.size()), 1});
    for (std::size_t v = 0; v < 8; ++v) {
      const Vec3& p = solid.points[VertexId(v)];
      CHECK(numbers_of(node[v + 1]) == Numbers{real(v), p.x, p.y, p.z});
    }
    for (std::size_t c = 0; c < 6; ++c) {
      const auto& [p, q, r, s] = solid.cells[c];
      CHECK(numbers_of(ele[c + 1]) ==
            Numbers{real(c), 1. * p, 1. * q, 1. * r, 1. * s, 1. * solid.regions[c]});
    }
    for (std::size_t w = 0; w < solid.walls.size(); ++w) {
      const Wall& wall = solid.walls[w];
      const double marker = wall.front == kOutside ? wall.behind : 3;
      CHECK(numbers_of(face[w + 1]) ==
            Numbers{real(w), 1. * wall.v[0], 1. * wall.v[1], 1. * wall.v[2], marker});
    }
  }
}

TEST_CASE("labels that are no positive numbers of 32 bits are numbered, but for VTK") {
  const Solid solid = cube(3);
  for (const std::int64_t odd : {std::int64_t{0}, std::int64_t{-4}, std::int64_t{1} << 40}) {
    SolidWriteOptions options;
    options.labels = {{9, ""}, {odd, "x"}, {20, ""}};
    options.format = SolidFormat::medit;
    const std::string bytes = written(solid, {}, options);
    CHECK(parse_solid(bytes, SolidFormat::medit, "solid").labels ==
          std::vector<std::int64_t>{1, 2, 3});
    CHECK(bytes.find("# region 2: label " + std::to_string(odd) + ", x\n") != std::string::npos);
    options.format = SolidFormat::vtu;
    std::vector<std::int64_t> sorted{9, odd, 20};
    std::ranges::sort(sorted);
    CHECK(parse_solid(written(solid, {}, options), SolidFormat::vtu, "solid").labels == sorted);
  }
}

TEST_CASE("a solid is written whole or not at all") {
  const Solid solid = cube(1);
  CHECK(refusal_by([&] { write_solid(solid, {}, "solid.stl"); }) ==
        "'solid.stl' has no solid format's ending (.mesh, .vtu, .msh, .node, .ele, .face)");
  CHECK(has_solid_ending("a.MSH"));
  CHECK_FALSE(has_solid_ending(".msh"));
  SolidWriteOptions options;
  options.format = SolidFormat::tetgen;
  CHECK(refusal_by([&] { write_solid(solid, {}, "-", options); }) ==
        "TetGen's format has three files: none for standard output");
  const TemporaryFolder folder;
  // The third file has the name of a folder that is not empty: none of the three is left.
  std::filesystem::create_directories(folder.path() / "solid.face" / "x");
  CHECK(refusal_by([&] { write_solid(solid, {}, folder / "solid.node"); }) != "");
  CHECK(folder.file_count() == 1);
  for (const SolidFormat format : kFormats) {
    options.format = format;
    CHECK(refusal_by([&] { write_solid(solid, {}, folder / "no/solid", options); }) != "");
  }
  CHECK(folder.file_count() == 1);
}

TEST_CASE("a disk that is full before the last of TetGen's files leaves all three as they were") {
  Solid solid = cube(1);
  for (int doubled = 0; doubled < 4; ++doubled) {  // so that the file of cells is the longest
    solid.cells.insert(solid.cells.end(), solid.cells.begin(), solid.cells.end());
    solid.regions.insert(solid.regions.end(), solid.regions.begin(), solid.regions.end());
  }
  const TemporaryFolder folder;
  const std::vector<std::string> paths = solid_files(folder / "solid.ele", {});
  CHECK(paths == std::vector<std::string>{folder / "solid.node", folder / "solid.ele",
                                          folder / "solid.face"});
  write_solid(solid, {}, paths[0]);
  std::vector<std::size_t> sizes;
  for (const std::string& path : paths) sizes.push_back(file_bytes(path).size());
  CHECK(sizes[1] > sizes[0]);
  for (const std::size_t size : sizes) {
    for (const std::string& path : paths) write_bytes(path, "old");
    std::string refusal;
    {
      const FileSizeLimit full(size - 1);
      refusal = refusal_by([&] { write_solid(solid, {}, paths[0]); });
    }
    CHECK(refusal.ends_with("File too large"));
    for (const std::string& path : paths) CHECK(file_bytes(path) == "old");
    CHECK(folder.file_count() == 3);
  }
}
