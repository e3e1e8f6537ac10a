// SPDX-License-Identifier: MIT
// The C library beside the program's own functions: the same files, faults as statuses, threads,
// and work that is stopped.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "app/parsed_line.h"
#include "app/run.h"
#include "base/random.h"
#include "c/deliso.h"
#include "io/files/json_value.h"
#include "io/volume/volume_files.h"

using namespace deliso;

namespace {

constexpr std::size_t kShape[] = {20, 24, 28};  // along z, y, x
constexpr double kCenter[] = {13, 11.5, 9};     // x, y, z
constexpr double kSpacing[] = {1, 1, 1.25}, kOrigin[] = {10, -20, 30};

// Samples [z][y][x] of 10 less the distance from the center in samples; in Fortran order if asked.
std::vector<float> ball(bool fortran = false) {
  std::vector<float> samples(kShape[0] * kShape[1] * kShape[2]);
  for (std::size_t z = 0; z < kShape[0]; ++z) {
    for (std::size_t y = 0; y < kShape[1]; ++y) {
      for (std::size_t x = 0; x < kShape[2]; ++x) {
        const std::size_t n =
            fortran ? z + kShape[0] * (y + kShape[1] * x) : x + kShape[2] * (y + kShape[1] * z);
        samples[n] = static_cast<float>(10 - std::hypot(static_cast<double>(x) - kCenter[0],
                                                        static_cast<double>(y) - kCenter[1],
                                                        static_cast<double>(z) - kCenter[2]));
      }
    }
  }
  return samples;
}

struct VolumeHandle {
  explicit VolumeHandle(const std::vector<float>& samples, bool fortran = false,
                        bool at_origin = false) {
    deliso_place place{};
    std::copy_n(kSpacing, 3, place.spacing);
    if (!at_origin) std::copy_n(kOrigin, 3, place.origin);
    REQUIRE(deliso_volume_create(samples.data(), DELISO_FLOAT32, kShape,
                                 fortran ? DELISO_FORTRAN_ORDER : DELISO_C_ORDER, &place,
                                 &get) == DELISO_OK);
  }
  ~VolumeHandle() { deliso_volume_free(get); }
  VolumeHandle(const VolumeHandle&) = delete;
  VolumeHandle& operator=(const VolumeHandle&) = delete;
  deliso_volume* get = nullptr;
};

struct MeshHandle {
  MeshHandle() = default;
  ~MeshHandle() { deliso_mesh_free(get); }
  MeshHandle(const MeshHandle&) = delete;
  MeshHandle& operator=(const MeshHandle&) = delete;
  deliso_mesh* get = nullptr;
};

using OptionList = std::vector<const char*>;

deliso_status mesh_ball(const VolumeHandle& volume, MeshHandle& mesh, OptionList options = {},
                        double isovalue = 2.5, const deliso_watch* watch = nullptr) {
  options.push_back(nullptr);
  return deliso_mesh_create(volume.get, isovalue, options.data(), watch, &mesh.get);
}

std::string refusal(OptionList options, double isovalue = 2.5) {
  const std::vector<float> samples = ball();
  const VolumeHandle volume(samples);
  MeshHandle mesh;
  CHECK(mesh_ball(volume, mesh, std::move(options), isovalue) == DELISO_BAD_INPUT);
  CHECK(mesh.get == nullptr);
  return deliso_last_error();
}

}  // namespace

TEST_CASE("the same bytes as the program") {
  const test::TemporaryFolder folder;
  for (const bool fortran : {false, true}) {
    CAPTURE(fortran);
    const std::vector<float> samples = ball(fortran);
    const std::string npy = folder.write(
        "v.npy", test::npy("<f4", fortran, "20, 24, 28",
                           {reinterpret_cast<const char*>(samples.data()), 4 * samples.size()}));
    const VolumeHandle volume(samples, fortran, true);
    MeshHandle mesh;
    REQUIRE(mesh_ball(volume, mesh, {"max-distance=0.2vox", "cap"}, 1.5) == DELISO_OK);
    // A mesh in glTF and 3MF has the name of its file.
    std::filesystem::create_directory(folder.path("program"));
    const std::string ours = folder.path("mesh."), theirs = folder.path("program/mesh.");
    for (const char* ending : {"ply", "off", "obj", "stl", "vtp", "glb", "3mf", "smesh", "poly"}) {
      CAPTURE(ending);
      REQUIRE(deliso_mesh_save(mesh.get, (ours + ending).c_str()) == DELISO_OK);
      REQUIRE(run_mesh(test::parsed(npy + " --spacing 1,1,1.25 --iso 1.5 --max-distance 0.2vox" +
                                    " --cap -q -o " + theirs + ending)) == kExitSuccess);
      CHECK(test::file_bytes(ours + ending).size() > 1000);
      CHECK(test::file_bytes(ours + ending) == test::file_bytes(theirs + ending));
    }
  }
}

TEST_CASE("arrays: a ball in the world, with normals that point outwards") {
  for (const bool fortran : {false, true}) {
    CAPTURE(fortran);
    const std::vector<float> samples = ball(fortran);
    const VolumeHandle volume(samples, fortran);
    MeshHandle mesh;
    REQUIRE(mesh_ball(volume, mesh) == DELISO_OK);
    std::size_t vertices = 0, triangles = 0, normals = 0;
    const double* p = deliso_mesh_vertices(mesh.get, &vertices);
    const std::uint32_t* t = deliso_mesh_triangles(mesh.get, &triangles);
    const double* n = deliso_mesh_normals(mesh.get, &normals);
    CHECK(normals == vertices);
    CHECK(vertices > 100);
    CHECK(triangles == 2 * vertices - 4);
    for (std::size_t v = 0; v < vertices; ++v, p += 3, n += 3) {
      const double offset[] = {p[0] - kOrigin[0] - kSpacing[0] * kCenter[0],
                               p[1] - kOrigin[1] - kSpacing[1] * kCenter[1],
                               p[2] - kOrigin[2] - kSpacing[2] * kCenter[2]};
      CHECK(std::hypot(offset[0], offset[1], offset[2] / 1.25) ==
            doctest::Approx(7.5).epsilon(0.02));
      // The gradient of the ellipsoid x^2 + y^2 + (z / 1.25)^2.
      const double g[] = {offset[0], offset[1], offset[2] / (1.25 * 1.25)};
      const double size = std::hypot(g[0], g[1], g[2]);
      CHECK(std::hypot(n[0], n[1], n[2]) == doctest::Approx(1));
      CHECK((n[0] * g[0] + n[1] * g[1] + n[2] * g[2]) / size > 0.99);
    }
    p = deliso_mesh_vertices(mesh.get, nullptr);
    double volume_inside = 0;
    for (std::size_t f = 0; f < triangles; ++f, t += 3) {
      const double *a = p + 3 * t[0], *b = p + 3 * t[1], *c = p + 3 * t[2];
      volume_inside += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                        a[2] * (b[0] * c[1] - b[1] * c[0])) /
                       6;
    }
    CHECK(volume_inside == doctest::Approx(4.18879 * 7.5 * 7.5 * 7.5 * 1.25).epsilon(0.05));
    CHECK(std::strstr(deliso_mesh_report(mesh.get), "\"topology_exact\": true"));
  }
}

TEST_CASE("faults are statuses, with one line each") {
  CHECK(refusal({"max-distanc=1"}) ==
        "unknown option '--max-distanc'; did you mean --max-distance?");
  CHECK(refusal({"max-distance=x"}) ==
        "--max-distance wants a number above 0, or voxels as in '0.5vox', not 'x'");
  CHECK(refusal({"max-distance"}) == "--max-distance needs a value: D|Dvox");
  CHECK(refusal({"cap", "cap"}) == "--cap is given twice");
  CHECK(refusal({"vertices=100", "max-distance=1"}) ==
        "--vertices and --max-distance exclude each other");
  for (const char* option : {"iso=3", "output=a.ply", "json=-", "help", "version", "roi=0:2",
                             "origin=0,0,0", "channel=1", "time=1", "shared=a.ply"}) {
    const std::string text = option;
    CHECK(refusal({option}) ==
          "--" + text.substr(0, text.find('=')) + " has no meaning for an array");
  }
  CHECK(refusal({"label=Liver"}, std::numeric_limits<double>::quiet_NaN()) ==
        "an array does not name its labels");
  CHECK(refusal({}, std::numeric_limits<double>::quiet_NaN()) ==
        "no isovalue given: --iso K (deliso info INPUT shows the range)");
  CHECK(refusal({}, 11).starts_with("no surface at isovalue 11: the samples are "));
  CHECK(refusal({"rmin=1e-9vox"}).find("rmin") != std::string::npos);
  CHECK(refusal({""}) == "an option is '', without a name: it is NAME or NAME=VALUE");
  CHECK(refusal({"=3"}) == "an option is '=3', without a name: it is NAME or NAME=VALUE");

  std::vector<float> samples = ball();
  deliso_volume* volume = nullptr;
  const auto create = [&](const void* array, std::size_t nz, double dx, int type) {
    const std::size_t shape[] = {nz, 24, 28};
    const deliso_place place{{dx, 1, 1}, {}, {}, nullptr, {}};
    const deliso_status status =
        deliso_volume_create(array, type, shape, DELISO_C_ORDER, &place, &volume);
    CHECK(status == DELISO_BAD_INPUT);
    CHECK(volume == nullptr);
    return std::string(deliso_last_error());
  };
  CHECK(create(nullptr, 20, 1, DELISO_FLOAT32) == "samples is null");
  CHECK(create(samples.data(), 1, 1, DELISO_FLOAT32).starts_with("array: 1 samples along z"));
  CHECK(create(samples.data(), 20, 0, DELISO_FLOAT32).starts_with("array: "));
  CHECK(create(samples.data(), 20, 1, 10) == "no such type of samples");
  create(samples.data(), std::numeric_limits<std::size_t>::max() / 2, 1, DELISO_FLOAT32);

  samples[5] = std::numeric_limits<float>::infinity();
  const VolumeHandle infinite(samples);
  MeshHandle mesh;
  CHECK(mesh_ball(infinite, mesh) == DELISO_BAD_INPUT);
  CHECK(std::string(deliso_last_error()) == "array: infinite sample at (5, 0, 0)");
  CHECK(deliso_mesh_create(nullptr, 1, nullptr, nullptr, &mesh.get) == DELISO_BAD_INPUT);
  CHECK(std::string(deliso_last_error()) == "volume is null");
  const double corner[] = {0, 0, 0};
  const std::uint32_t beyond[] = {0, 0, 1};
  CHECK(deliso_mesh_import(corner, 1, beyond, 1, &mesh.get) == DELISO_BAD_INPUT);
  CHECK(std::string(deliso_last_error()) == "triangle 0 has a vertex beyond the last");
  std::thread([] { CHECK(std::string(deliso_last_error()).empty()); }).join();
}

TEST_CASE("samples that change during a call do not end the process") {
  // Once the invariants that they break did. A run on such samples need not end: it is canceled.
  int failed = 0;
  for (std::uint64_t seed = 1; seed <= 400 && failed == 0; ++seed) {
    Random random(seed);
    std::vector<float> samples = ball();
    volatile int cancel = 0;
    std::atomic<bool> ended = false;
    std::thread other([&] {
      for (int fills = 0; !ended; ++fills) {
        for (float& sample : samples) sample = static_cast<float>(random.uniform(0, 5));
        if (fills == 2000) cancel = 1;
      }
    });
    deliso_watch watch{};
    watch.cancel = &cancel;
    const VolumeHandle volume(samples);
    MeshHandle mesh;
    const deliso_status status =
        mesh_ball(volume, mesh, {"threads=1", "max-distance=0.01vox"}, 2.5, &watch);
    ended = true;
    other.join();
    if (status != DELISO_FAILED) continue;
    ++failed;
    const std::string what = deliso_last_error();
    CHECK(what.starts_with("internal error: "));
    CHECK(what.ends_with("; it may be that samples changed during the call"));
  }
  CHECK(failed > 0);
}

TEST_CASE("a check of the mesh, and of one that misses a triangle") {
  const std::vector<float> samples = ball();
  const VolumeHandle volume(samples);
  MeshHandle mesh, torn;
  REQUIRE(mesh_ball(volume, mesh) == DELISO_OK);
  CHECK(deliso_mesh_save(mesh.get, "no-such-folder/mesh.ply") == DELISO_BAD_INPUT);
  CHECK(deliso_mesh_save(mesh.get, "mesh.doc") == DELISO_BAD_INPUT);
  std::size_t vertices = 0, triangles = 0;
  const double* points = deliso_mesh_vertices(mesh.get, &vertices);
  const std::uint32_t* corners = deliso_mesh_triangles(mesh.get, &triangles);
  REQUIRE(deliso_mesh_import(points, vertices, corners, triangles - 1, &torn.get) == DELISO_OK);
  char* json = nullptr;
  CHECK(deliso_check(mesh.get, volume.get, 2.5, nullptr, nullptr, &json) == DELISO_OK);
  CHECK(std::strstr(json, "\"criteria_of_file\": true"));
  deliso_text_free(json);
  CHECK(deliso_check(torn.get, volume.get, 2.5, nullptr, nullptr, &json) == DELISO_FAULT);
  CHECK(std::strstr(json, "\"criteria_of_file\": false"));
  deliso_text_free(json);
  CHECK(deliso_check(torn.get, volume.get, 2.5, nullptr, nullptr, nullptr) == DELISO_FAULT);
  const char* const options[] = {"seed=3", nullptr};
  CHECK(deliso_check(mesh.get, volume.get, 2.5, options, nullptr, nullptr) == DELISO_BAD_INPUT);
}

TEST_CASE("labels as one mesh: the bytes of the program, two labels for each triangle") {
  const test::TemporaryFolder folder;
  std::string samples(8 * 8 * 8, 0);
  for (std::size_t n = 0; n < samples.size(); ++n) {
    if (n % 8 > 1 && n / 8 % 8 > 1) samples[n] = n % 8 < 5 ? 4 : 9;
  }
  const std::string npy = folder.write("v.npy", test::npy("|i1", false, "8, 8, 8", samples));
  const std::size_t shape[] = {8, 8, 8};
  deliso_volume* volume = nullptr;
  REQUIRE(deliso_volume_create(samples.data(), DELISO_INT8, shape, DELISO_C_ORDER, nullptr,
                               &volume) == DELISO_OK);
  const char* const options[] = {"cap", "max-distance=0.3vox", nullptr};
  MeshHandle shared, copy;
  const deliso_status status = deliso_mesh_shared(volume, options, nullptr, &shared.get);
  REQUIRE_MESSAGE(status == DELISO_OK, std::string(deliso_last_error()));
  REQUIRE(run_mesh(test::parsed(npy + " --label all --cap --max-distance 0.3vox -q --shared " +
                                folder.path("theirs.ply") + " -o " +
                                folder.path("label-%d.ply"))) == kExitSuccess);
  deliso_mesh_data data;
  REQUIRE(deliso_mesh_get_data(shared.get, &data) == DELISO_OK);
  REQUIRE(deliso_mesh_from_data(&data, &copy.get) == DELISO_OK);
  const std::string ours = folder.path("ours.ply");
  for (const deliso_mesh* mesh : {shared.get, copy.get}) {
    REQUIRE(deliso_mesh_save(mesh, ours.c_str()) == DELISO_OK);
    CHECK(test::file_bytes(ours) == test::file_bytes(folder.path("theirs.ply")));
    std::size_t triangles = 0, sides = 0, of_labels = 0;
    deliso_mesh_triangles(mesh, &triangles);
    const std::int64_t* side = deliso_mesh_sides(mesh, &sides);
    CHECK(sides == triangles);
    for (const std::int64_t label : {4, 9, 5}) {
      MeshHandle one;
      REQUIRE(deliso_mesh_of_label(mesh, label, &one.get) == DELISO_OK);
      deliso_mesh_triangles(one.get, &triangles);
      CHECK(triangles == static_cast<std::size_t>(std::count(side, side + 2 * sides, label)));
      of_labels += triangles;
      if (label == 5) continue;
      REQUIRE(deliso_mesh_save(one.get, ours.c_str()) == DELISO_OK);
      CHECK(test::file_bytes(ours) ==
            test::file_bytes(folder.path("label-" + std::to_string(label) + ".ply")));
    }
    CHECK(of_labels > sides);
  }
  CHECK(std::strstr(deliso_mesh_report(shared.get), "\"borders\""));
  MeshHandle none;
  const char* const checked[] = {"check", nullptr};
  CHECK(deliso_mesh_shared(volume, checked, nullptr, &none.get) == DELISO_BAD_INPUT);
  CHECK(std::string(deliso_last_error()) == "--shared and --check exclude each other");
  MeshHandle four;
  REQUIRE(deliso_mesh_of_label(shared.get, 4, &four.get) == DELISO_OK);
  CHECK(deliso_mesh_sides(four.get, nullptr) == nullptr);
  CHECK(deliso_mesh_of_label(four.get, 4, &none.get) == DELISO_BAD_INPUT);
  CHECK(none.get == nullptr);
  deliso_volume_free(volume);
}

TEST_CASE("a mesh made of another's data is the same") {
  const test::TemporaryFolder folder;
  const std::vector<float> samples = ball();
  const VolumeHandle volume(samples);
  const std::string here = folder.write("unused", "");
  const auto saved = [&](const deliso_mesh* mesh) {
    std::string files;
    for (const char* ending :
         {".ply", ".off", ".obj", ".stl", ".vtp", ".glb", ".3mf", ".smesh", ".poly"}) {
      REQUIRE(deliso_mesh_save(mesh, (here + ending).c_str()) == DELISO_OK);
      files += test::file_bytes(here + ending);
    }
    return files;
  };
  // The last leaves the box, and has caps.
  const std::pair<OptionList, double> kinds[] = {
      {{}, 2.5}, {{"float"}, 2.5}, {{"cap"}, 1.5}, {{"cap", "float"}, -2.5}};
  for (const auto& [options, value] : kinds) {
    const double isovalue = value;
    CAPTURE(isovalue);
    MeshHandle mesh, copy;
    REQUIRE(mesh_ball(volume, mesh, options, isovalue) == DELISO_OK);
    deliso_mesh_data data;
    REQUIRE(deliso_mesh_get_data(mesh.get, &data) == DELISO_OK);
    CHECK(data.vertices == deliso_mesh_vertices(mesh.get, nullptr));
    CHECK(data.triangles == deliso_mesh_triangles(mesh.get, nullptr));
    REQUIRE(deliso_mesh_from_data(&data, &copy.get) == DELISO_OK);
    const std::string expected = saved(mesh.get), report = deliso_mesh_report(mesh.get);
    std::size_t count = 0;
    const double* const normals = deliso_mesh_normals(mesh.get, &count);
    const std::vector<double> expected_normals(normals, normals + 3 * count);
    deliso_mesh_free(std::exchange(mesh.get, nullptr));
    CHECK(saved(copy.get) == expected);
    CHECK(deliso_mesh_report(copy.get) == report);
    REQUIRE(deliso_mesh_get_data(copy.get, &data) == DELISO_OK);
    CHECK(std::equal(expected_normals.begin(), expected_normals.end(), data.normals,
                     data.normals + 3 * data.vertex_count));
    if (isovalue < 0) CHECK(data.first_cap < data.triangle_count);
  }
}

TEST_CASE("data that is no mesh is refused, and one without normals has none") {
  const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint32_t triangle[] = {0, 1, 2};
  deliso_mesh_data sound{};
  sound.vertices = corners;
  sound.vertex_count = 3;
  sound.triangles = triangle;
  sound.triangle_count = 1;
  sound.first_cap = SIZE_MAX;
  MeshHandle mesh;
  REQUIRE(deliso_mesh_from_data(&sound, &mesh.get) == DELISO_OK);
  deliso_mesh_data got;
  REQUIRE(deliso_mesh_get_data(mesh.get, &got) == DELISO_OK);
  CHECK(got.normals == nullptr);
  CHECK(std::string(got.report) + got.comment == "");
  CHECK(got.first_cap == SIZE_MAX);

  const auto refusal_of = [&](auto spoil) {
    deliso_mesh_data data = sound;
    spoil(data);
    MeshHandle none;
    CHECK(deliso_mesh_from_data(&data, &none.get) == DELISO_BAD_INPUT);
    CHECK(none.get == nullptr);
    return std::string(deliso_last_error());
  };
  CHECK(refusal_of([](deliso_mesh_data& d) { d.vertices = nullptr; }) == "vertices is null");
  CHECK(refusal_of([](deliso_mesh_data& d) { d.triangles = nullptr; }) == "triangles is null");
  CHECK(refusal_of([](deliso_mesh_data& d) { d.vertex_count = 2; }) ==
        "triangle 0 has a vertex beyond the last");
  CHECK(refusal_of([](deliso_mesh_data& d) { d.first_cap = 2; }) ==
        "first_cap is beyond the last triangle");
  const double far[] = {0, 0, 0, 1, 0, 0, 0, 1, std::numeric_limits<double>::quiet_NaN()};
  CHECK(refusal_of([&](deliso_mesh_data& d) { d.vertices = far; }) ==
        "vertex 2 is not finite, or too far away");
  CHECK(deliso_mesh_from_data(nullptr, &mesh.get) == DELISO_BAD_INPUT);
  CHECK(deliso_mesh_get_data(nullptr, &got) == DELISO_BAD_INPUT);
  CHECK(deliso_mesh_get_data(mesh.get, nullptr) == DELISO_BAD_INPUT);
}

TEST_CASE("null is a mesh without vertices, triangles and texts") {
  std::size_t count = 7;
  CHECK(deliso_mesh_vertices(nullptr, &count) == nullptr);
  CHECK(count == 0);
  count = 7;
  CHECK(deliso_mesh_triangles(nullptr, &count) == nullptr);
  CHECK(count == 0);
  count = 7;
  CHECK(deliso_mesh_normals(nullptr, &count) == nullptr);
  CHECK(count == 0);
  CHECK(deliso_mesh_vertices(nullptr, nullptr) == nullptr);
  CHECK(std::string(deliso_mesh_report(nullptr)).empty());
  CHECK(deliso_mesh_save(nullptr, "mesh.ply") == DELISO_BAD_INPUT);
  deliso_mesh_free(nullptr);
  deliso_volume_free(nullptr);
  deliso_text_free(nullptr);
}

TEST_CASE("two meshes at once are the same as alone") {
  const std::vector<float> samples = ball();
  const VolumeHandle volume(samples);
  MeshHandle alone[2], at_once[2];
  const OptionList options[] = {{"threads=2"}, {"threads=2", "max-distance=0.02vox"}};
  for (std::size_t n = 0; n < 2; ++n) REQUIRE(mesh_ball(volume, alone[n], options[n]) == DELISO_OK);
  {
    std::vector<std::jthread> threads;
    for (std::size_t n = 0; n < 2; ++n) {
      threads.emplace_back([&, n] {
        for (int round = 0; round < 5; ++round) {
          deliso_mesh_free(std::exchange(at_once[n].get, nullptr));
          mesh_ball(volume, at_once[n], options[n]);
        }
      });
    }
  }
  for (std::size_t n = 0; n < 2; ++n) {
    std::size_t count = 0, other = 0;
    const double* p = deliso_mesh_vertices(alone[n].get, &count);
    const double* q = deliso_mesh_vertices(at_once[n].get, &other);
    REQUIRE(count == other);
    CHECK(std::equal(p, p + 3 * count, q));
  }
}

TEST_CASE("progress goes from stage to stage, and a flag stops the work at each") {
  const std::vector<float> samples = ball();
  const VolumeHandle volume(samples);
  struct Watched {
    int flag = 0;
    std::string stop_at{};
    std::vector<std::string> stages{};
    double last = 0;
  };
  const auto progress = [](void* context, const char* stage, double share) {
    Watched& watched = *static_cast<Watched*>(context);
    if (watched.stages.empty() || watched.stages.back() != stage)
      watched.stages.emplace_back(stage);
    CHECK(share >= watched.last);
    CHECK(share <= 1);
    watched.last = share;
    if (watched.stop_at == stage) std::atomic_ref(watched.flag).store(1);
  };
  Watched all;
  const deliso_watch watch{&all.flag, progress, &all};
  MeshHandle mesh;
  REQUIRE(mesh_ball(volume, mesh, {"threads=2"}, 2.5, &watch) == DELISO_OK);
  CHECK(all.stages.size() >= 5);
  CHECK(all.last > 0.5);
  for (const std::string& stage : all.stages) {
    if (stage == "refine") continue;  // the ball is all done in regions: there is no step left
    CAPTURE(stage);
    Watched stopped{.stop_at = stage};
    const deliso_watch stop{&stopped.flag, progress, &stopped};
    MeshHandle none;
    CHECK(mesh_ball(volume, none, {"threads=2"}, 2.5, &stop) == DELISO_CANCELED);
    CHECK(std::string(deliso_last_error()) == "canceled");
    CHECK(none.get == nullptr);
  }
  MeshHandle again;  // the flag of one call stops no other
  CHECK(mesh_ball(volume, again) == DELISO_OK);
}

// Readers' notes, the mesher's advice and what rounding does were lost.
TEST_CASE("what a call tells is JSON: of reading, meshing and saving") {
  const test::TemporaryFolder folder;
  const auto has = [](const char* json, const std::string& code, const std::string& severity) {
    const JsonValue parsed = parse_json(json, "notes");
    return std::ranges::any_of(parsed["diagnostics"].items, [&](const JsonValue& item) {
      return item["code"].string == code && item["severity"].string == severity;
    });
  };
  const char* const far[] = {"origin=1e7,0,0", "spacing=1,1,1", nullptr};
  std::string samples(sizeof(float) * 16 * 16 * 16, '\0');
  for (std::size_t n = 0; n < 16 * 16 * 16; ++n) {
    const std::size_t x = n % 16, y = n / 16 % 16, z = n / 256;
    const auto value =
        static_cast<float>((x - 8) * (x - 8) + (y - 8) * (y - 8) + (z - 8) * (z - 8));
    std::memcpy(&samples[n * sizeof value], &value, sizeof value);
  }
  const std::string file =
      folder.write("v.nrrd",
                   "NRRD0004\ntype: float\ndimension: 3\nsizes: 16 16 16\nencoding: raw\n"
                   "endian: little\n\n" +
                       samples);
  deliso_volume* volume = nullptr;
  REQUIRE(deliso_volume_read(file.c_str(), far, &volume) == DELISO_OK);
  CHECK(has(deliso_notes(), "origin-given", "note"));
  MeshHandle mesh;
  REQUIRE(deliso_mesh_create(volume, 20.5, nullptr, nullptr, &mesh.get) == DELISO_OK);
  CHECK(has(deliso_notes(), "spacing-given", "note"));
  CHECK(has(deliso_mesh_report(mesh.get), "spacing-given", "note"));
  REQUIRE(deliso_mesh_save(mesh.get, folder.path("m.stl").c_str()) == DELISO_OK);
  CHECK(has(deliso_notes(), "rounded-to-float", "warning"));
  REQUIRE(deliso_mesh_save(mesh.get, folder.path("m.ply").c_str()) == DELISO_OK);
  CHECK(!has(deliso_notes(), "rounded-to-float", "warning"));
  char* json = nullptr;
  const char* const eight[] = {"vertices=8", nullptr};
  REQUIRE(deliso_info_file(file.c_str(), 20.5, far, nullptr, &json) == DELISO_OK);
  CHECK(has(json, "origin-given", "note"));
  deliso_text_free(json);
  CHECK(has(deliso_notes(), "origin-given", "note"));
  MeshHandle other;
  REQUIRE(deliso_mesh_create(volume, 20.5, eight, nullptr, &other.get) != DELISO_BAD_INPUT);
  CHECK(deliso_mesh_create(volume, 1e9, nullptr, nullptr, &other.get) == DELISO_BAD_INPUT);
  CHECK(parse_json(deliso_notes(), "notes")["diagnostics"].items.empty());
  const char* const all[] = {"label=all", nullptr};
  CHECK(deliso_mesh_shared(volume, all, nullptr, &other.get) == DELISO_BAD_INPUT);
  CHECK(std::string(deliso_last_error()) ==
        "'label=all': all labels are meshed, and no option chooses them");
  deliso_volume_free(volume);
}

TEST_CASE("files: a volume and a mesh are read, labels saved together, and null is refused") {
  const test::TemporaryFolder folder;
  deliso_volume* volume = nullptr;
  const char* const roi[] = {"roi=2:14,0:16,0:16", nullptr};
  REQUIRE(deliso_volume_read("builtin:machine:16", roi, &volume) == DELISO_OK);
  struct Taken {
    std::vector<std::int64_t> labels;
    std::vector<deliso_mesh*> meshes;
  } taken;
  const auto take = [](void* context, std::int64_t label, deliso_mesh* mesh, deliso_status) {
    static_cast<Taken*>(context)->labels.push_back(label);
    static_cast<Taken*>(context)->meshes.push_back(mesh);
  };
  REQUIRE(deliso_mesh_labels(volume, nullptr, nullptr, take, &taken) == DELISO_OK);
  REQUIRE(!taken.meshes.empty());
  const std::string path = folder.path("all.glb"), picture = folder.path("all.png");
  REQUIRE(deliso_labels_save(taken.meshes.data(), taken.labels.data(), taken.meshes.size(),
                             path.c_str()) == DELISO_OK);
  MeshHandle read;
  REQUIRE(deliso_mesh_read(path.c_str(), &read.get) == DELISO_OK);
  std::size_t in_file = 0, made = 0;
  deliso_mesh_vertices(read.get, &in_file);
  for (deliso_mesh* mesh : taken.meshes) {
    std::size_t count = 0;
    deliso_mesh_vertices(mesh, &count);
    made += count;
  }
  CHECK(in_file == made);
  const char* const size[] = {"size=60x40", nullptr};
  CHECK(deliso_render(taken.meshes.data(), 1, size, picture.c_str()) == DELISO_OK);
  CHECK(test::file_bytes(picture).size() > 100);
  char* json = nullptr;
  REQUIRE(deliso_info(volume, std::nan(""), nullptr, nullptr, &json) == DELISO_OK);
  CHECK(std::strstr(json, "\"dims\": [12, 16, 16]") != nullptr);
  deliso_text_free(json);
  for (deliso_mesh* mesh : taken.meshes) deliso_mesh_free(mesh);

  CHECK(deliso_volume_read(nullptr, nullptr, &volume) == DELISO_BAD_INPUT);
  CHECK(deliso_mesh_labels(nullptr, nullptr, nullptr, take, &taken) == DELISO_BAD_INPUT);
  CHECK(deliso_mesh_labels(volume, nullptr, nullptr, nullptr, &taken) == DELISO_BAD_INPUT);
  CHECK(deliso_mesh_read(nullptr, &read.get) == DELISO_BAD_INPUT);
  CHECK(deliso_labels_save(nullptr, nullptr, 1, path.c_str()) == DELISO_BAD_INPUT);
  CHECK(deliso_render(nullptr, 1, nullptr, picture.c_str()) == DELISO_BAD_INPUT);
  CHECK(deliso_info(volume, 1, nullptr, nullptr, nullptr) == DELISO_BAD_INPUT);
  deliso_volume_free(volume);
}
