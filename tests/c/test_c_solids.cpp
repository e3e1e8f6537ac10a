// SPDX-License-Identifier: MIT
// Solids by the C library: what the program writes, faults as statuses, and labels.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "app/parsed_line.h"
#include "app/run.h"
#include "c/deliso.h"
#include "io/files/json_value.h"
#include "io/files/temporary_folder.h"
#include "io/volume/volume_files.h"

using namespace deliso;
using namespace deliso::test;

namespace {

struct TorusMesh {
  explicit TorusMesh(const char* name = "builtin:torus:20", double isovalue = 0,
                     std::vector<const char*> options = {"cap", nullptr}) {
    REQUIRE(deliso_volume_read(name, nullptr, &volume) == DELISO_OK);
    REQUIRE(deliso_mesh_create(volume, isovalue, options.data(), nullptr, &get) == DELISO_OK);
  }
  ~TorusMesh() {
    deliso_mesh_free(get);
    deliso_volume_free(volume);
  }
  TorusMesh(const TorusMesh&) = delete;
  TorusMesh& operator=(const TorusMesh&) = delete;
  deliso_volume* volume = nullptr;
  deliso_mesh* get = nullptr;
};

}  // namespace

TEST_CASE("the solid of the C library is that of the program, to the byte") {
  const TemporaryFolder folder;
  const TorusMesh mesh;
  const std::string surface = folder / "torus.ply", by_program = folder / "program.msh",
                    by_library = folder / "library.msh";
  REQUIRE(deliso_mesh_save(mesh.get, surface.c_str()) == DELISO_OK);
  run_solid(parsed("solid " + surface + " --growth 0.6 -q -o " + by_program));
  const char* const options[] = {"growth=0.6", nullptr};
  int calls = 0;
  const deliso_watch watch{nullptr, [](void* n, const char*, double) { ++*static_cast<int*>(n); },
                           &calls};
  deliso_solid* solid = nullptr;
  REQUIRE(deliso_solid_create(mesh.get, options, &watch, &solid) == DELISO_OK);
  CHECK(calls > 0);
  REQUIRE(deliso_solid_save(solid, by_library.c_str()) == DELISO_OK);
  CHECK(file_bytes(by_library) == file_bytes(by_program));

  std::size_t points = 0, cells = 0, regions = 0, walls = 0, kinds = 0, triangles = 0;
  const double* p = deliso_solid_points(solid, &points);
  const uint32_t* v = deliso_solid_cells(solid, &cells);
  const int64_t* region = deliso_solid_regions(solid, &regions);
  deliso_solid_walls(solid, &walls);
  const uint32_t* kind = deliso_solid_kinds(solid, &kinds);
  deliso_mesh_triangles(mesh.get, &triangles);
  CHECK(regions == cells);
  CHECK(walls >= triangles);
  CHECK(kinds == walls);
  CHECK(std::set<uint32_t>(kind, kind + kinds) == std::set<uint32_t>{0});
  double volume = 0;
  for (std::size_t c = 0; c < cells; ++c) {
    CHECK(region[c] == 1);
    const auto at = [&](std::size_t n) {
      REQUIRE(v[4 * c + n] < points);
      const double* q = p + 3 * v[4 * c + n];
      return Vec3{q[0], q[1], q[2]};
    };
    const double sixfold = dot(cross(at(1) - at(0), at(2) - at(0)), at(3) - at(0));
    CHECK(sixfold > 0);
    volume += sixfold / 6;
  }
  const JsonValue report = parse_json(deliso_solid_report(solid), "report");
  CHECK(report["check"]["volume"].number == doctest::Approx(volume));
  deliso_solid_free(solid);
}

TEST_CASE("open meshes and bad options are refused, and nothing is made") {
  const TorusMesh open("builtin:gyroid:16", 0, {nullptr});
  deliso_solid* solid = nullptr;
  CHECK(deliso_solid_create(open.get, nullptr, nullptr, &solid) == DELISO_BAD_INPUT);
  CHECK(std::strstr(deliso_last_error(), "is open at edge ") != nullptr);
  CHECK(deliso_solid_create(nullptr, nullptr, nullptr, &solid) == DELISO_BAD_INPUT);
  const TorusMesh mesh;
  for (const char* option : {"growth=0", "format=vtu", "iso=3", "max-cell"}) {
    const char* const options[] = {option, nullptr};
    CHECK(deliso_solid_create(mesh.get, options, nullptr, &solid) == DELISO_BAD_INPUT);
  }
  CHECK(solid == nullptr);
  CHECK(deliso_solid_save(nullptr, "a.vtu") == DELISO_BAD_INPUT);
  std::size_t count = 1;
  CHECK(deliso_solid_points(nullptr, &count) == nullptr);
  CHECK(count == 0);
  CHECK(std::strcmp(deliso_solid_report(nullptr), "") == 0);
  deliso_solid_free(nullptr);
}

TEST_CASE("labels that share their interfaces are regions, made and read") {
  const TemporaryFolder folder;
  std::vector<std::uint8_t> samples;
  for (int n = 0; n < 1000; ++n) samples.push_back(n % 10 < 4 ? 3 : n / 100 < 5 ? 8 : 11);
  const std::size_t shape[] = {10, 10, 10};
  deliso_volume* volume = nullptr;
  REQUIRE(deliso_volume_create(samples.data(), DELISO_UINT8, shape, DELISO_C_ORDER, nullptr,
                               &volume) == DELISO_OK);
  const char* const options[] = {"cap", nullptr};
  deliso_mesh* shared = nullptr;
  REQUIRE(deliso_mesh_shared(volume, options, nullptr, &shared) == DELISO_OK);
  const std::string file = folder / "shared.ply";
  REQUIRE(deliso_mesh_save(shared, file.c_str()) == DELISO_OK);
  deliso_mesh* read = nullptr;
  REQUIRE(deliso_mesh_read(file.c_str(), &read) == DELISO_OK);
  for (const deliso_mesh* mesh : {shared, read}) {
    deliso_solid* solid = nullptr;
    REQUIRE(deliso_solid_create(mesh, nullptr, nullptr, &solid) == DELISO_OK);
    std::size_t cells = 0, walls = 0;
    const int64_t* region = deliso_solid_regions(solid, &cells);
    CHECK(std::set<int64_t>(region, region + cells) == std::set<int64_t>{3, 8, 11});
    const uint32_t* kind = deliso_solid_kinds(solid, &walls);
    CHECK(std::set<uint32_t>(kind, kind + walls) == std::set<uint32_t>{0, 1, 2, 3, 4, 5, 6});
    deliso_solid_free(solid);
  }
  deliso_mesh_free(read);
  deliso_mesh_free(shared);
  deliso_volume_free(volume);
}
