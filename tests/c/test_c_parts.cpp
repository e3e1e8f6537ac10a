// SPDX-License-Identifier: MIT
// Parts of an array that is read box by box, and their join: the mesh of the whole array.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "base/random.h"
#include "c/deliso.h"
#include "cases.h"
#include "io/files/checksum.h"
#include "io/files/temporary_folder.h"
#include "io/parts/part_file.h"
#include "run/report.h"

using namespace deliso;

namespace {

constexpr double kLevel = 4.25;

// A ball that leaves the box, and a small one; as labels 3 and 5, if asked.
struct BallArray {
  explicit BallArray(bool labels = false) {
    Random random(5);
    for (int z = 0; z < 30; ++z) {
      for (int y = 0; y < 26; ++y) {
        for (int x = 0; x < 34; ++x) {
          const double large = 14 - std::hypot(x - 20, y - 12, z - 14);
          const double small = 8 - std::hypot(x - 4, y - 20, z - 5);
          const double noise = 0.001 * static_cast<double>(random.below(1000));
          const double label = large >= kLevel ? 3 : small >= kLevel ? 5 : 0;
          samples.push_back(static_cast<float>(labels ? label : std::max(large, small) + noise));
        }
      }
    }
    source.type = DELISO_FLOAT32;
    const std::size_t shape[] = {30, 26, 34};
    std::copy_n(shape, 3, source.shape);
    source.place = &place;
    source.context = this;
    source.read = [](void* context, const std::size_t* begin, const std::size_t* end, void* to) {
      BallArray& array = *static_cast<BallArray*>(context);
      if (array.calls++ >= array.calls_before_fault) return 1;
      CHECK(++array.at_once == 1);
      auto* out = static_cast<float*>(to);
      for (std::size_t z = begin[0]; z < end[0]; ++z) {
        for (std::size_t y = begin[1]; y < end[1]; ++y) {
          const auto row = array.samples.begin() + static_cast<std::ptrdiff_t>(34 * (y + 26 * z));
          out = std::copy(row + static_cast<std::ptrdiff_t>(begin[2]),
                          row + static_cast<std::ptrdiff_t>(end[2]), out);
        }
      }
      const std::size_t read = (end[0] - begin[0]) * (end[1] - begin[1]) * (end[2] - begin[2]);
      array.largest_read = std::max(array.largest_read, read);
      --array.at_once;
      return 0;
    };
  }

  std::vector<float> samples;
  deliso_place place{{1, 1.25, 1.5}, {10, -20, 30}, {}, nullptr, {}};
  deliso_source source{};
  std::atomic<int> calls = 0, at_once = 0;
  int calls_before_fault = std::numeric_limits<int>::max();
  std::size_t largest_read = 0;  // samples
};

using Words = std::vector<const char*>;

// What a mesh is: arrays, and the bytes of files.
struct MeshContent {
  explicit MeshContent(deliso_mesh* mesh) {
    std::size_t vertices = 0, triangles = 0, normals = 0;
    const double* p = deliso_mesh_vertices(mesh, &vertices);
    const double* n = deliso_mesh_normals(mesh, &normals);
    const std::uint32_t* t = deliso_mesh_triangles(mesh, &triangles);
    numbers.assign(p, p + 3 * vertices);
    numbers.insert(numbers.end(), n, n + 3 * normals);
    corners.assign(t, t + 3 * triangles);
    CHECK(normals == vertices);
    const test::TemporaryFolder folder;
    for (const char* name : {"m.ply", "m.obj", "m.vtp"}) {
      const std::string path = folder.write(name, "");
      REQUIRE(deliso_mesh_save(mesh, path.c_str()) == DELISO_OK);
      files.push_back(test::file_bytes(path));
    }
    const std::string report = deliso_mesh_report(mesh);
    const std::size_t begin = report.find("\"mesh\": {");
    REQUIRE(begin != std::string::npos);
    topology = report.substr(begin, report.find('}', begin) - begin);
    deliso_mesh_free(mesh);
  }

  std::vector<double> numbers;
  std::vector<std::uint32_t> corners;
  std::vector<std::string> files;
  std::string topology;  // in the report
};

MeshContent whole_mesh(const BallArray& array, double level, Words options) {
  deliso_volume* volume = nullptr;
  const deliso_source& source = array.source;
  REQUIRE(deliso_volume_create(array.samples.data(), source.type, source.shape, DELISO_C_ORDER,
                               source.place, &volume) == DELISO_OK);
  deliso_mesh* mesh = nullptr;
  options.push_back(nullptr);
  const deliso_status status = deliso_mesh_create(volume, level, options.data(), nullptr, &mesh);
  deliso_volume_free(volume);
  INFO(std::string(deliso_last_error()));
  REQUIRE(status == DELISO_OK);
  return MeshContent(mesh);
}

deliso_status make_part_of(const BallArray& array, double level, int number, int of, Words options,
                           std::string& bytes, const deliso_watch* watch = nullptr) {
  char* made = nullptr;
  std::size_t size = 0;
  options.push_back(nullptr);
  const deliso_status status =
      deliso_part_create(&array.source, level, number, of, options.data(), watch, &made, &size);
  if (made) bytes.assign(made, size);
  deliso_text_free(made);
  return status;
}

std::vector<std::string> all_parts(const BallArray& array, double level, int of,
                                   const Words& options) {
  std::vector<std::string> parts(static_cast<std::size_t>(of));
  for (int n = 1; n <= of; ++n) {
    const deliso_status status =
        make_part_of(array, level, n, of, options, parts[static_cast<std::size_t>(n - 1)]);
    INFO(std::string(deliso_last_error()));
    REQUIRE(status == DELISO_OK);
  }
  return parts;
}

deliso_status join_to(deliso_mesh*& mesh, const BallArray& array,
                      const std::vector<std::string>& parts, Words options = {},
                      const deliso_watch* watch = nullptr) {
  std::vector<const char*> bytes;
  std::vector<std::size_t> sizes;
  for (const std::string& part : parts) {
    bytes.push_back(part.data());
    sizes.push_back(part.size());
  }
  options.push_back(nullptr);
  return deliso_join(bytes.data(), sizes.data(), parts.size(), &array.source, options.data(), watch,
                     &mesh);
}

// Returns why the parts are refused.
std::string join_refusal(const BallArray& array, const std::vector<std::string>& parts,
                         const Words& options = {}) {
  deliso_mesh* mesh = nullptr;
  CHECK(join_to(mesh, array, parts, options) == DELISO_BAD_INPUT);
  CHECK(mesh == nullptr);
  return deliso_last_error();
}

std::string part_refusal(const BallArray& array, int number, int of, const Words& options) {
  std::string bytes = "unchanged";
  CHECK(make_part_of(array, kLevel, number, of, options, bytes) == DELISO_BAD_INPUT);
  CHECK(bytes == "unchanged");
  return deliso_last_error();
}

}  // namespace

TEST_CASE("parts in any order have the mesh of the whole array, to the last byte") {
  struct Kind {
    Words of_parts, of_join{};
    bool labels = false;
  };
  const Kind kinds[] = {{{}},
                        {{"smooth=0.7vox", "median=1"}},
                        {{"label=3"}, {}, true},
                        {{"largest=1"}},
                        {{"cap"}},
                        {{"cap", "min-component=12"}},
                        {{"max-distance=0.3vox"}, {"float"}}};
  Random random(1);
  for (const Kind& kind : kinds) {
    const BallArray array(kind.labels);
    Words of_parts = kind.of_parts, of_whole = kind.of_parts;
    of_parts.push_back("block-side=8");
    of_whole.push_back("block-side=8");
    of_whole.insert(of_whole.end(), kind.of_join.begin(), kind.of_join.end());
    CAPTURE(std::string(of_parts.front()));
    const double level = kind.labels ? std::numeric_limits<double>::quiet_NaN() : kLevel;
    const MeshContent whole = whole_mesh(array, level, of_whole);
    CHECK(whole.numbers.size() > 1000);
    for (const int of : {1, 4, 7}) {
      if (test::kSanitized && of != 4) continue;
      CAPTURE(of);
      std::vector<std::string> parts = all_parts(array, level, of, of_parts);
      for (std::size_t n = parts.size(); n > 1; --n) {
        std::swap(parts[n - 1], parts[random.below(static_cast<std::uint32_t>(n))]);
      }
      Words of_join = kind.of_join;
      of_join.push_back("threads=2");
      deliso_mesh* mesh = nullptr;
      const deliso_status status = join_to(mesh, array, parts, of_join);
      INFO(std::string(deliso_last_error()));
      REQUIRE(status == DELISO_OK);
      const MeshContent joined(mesh);
      CHECK(joined.numbers == whole.numbers);
      CHECK(joined.corners == whole.corners);
      CHECK(joined.files == whole.files);
      CHECK(joined.topology == whole.topology);
    }
  }
}

TEST_CASE("no call reads much more than a block, unless all samples are needed") {
  BallArray array;
  const std::vector<std::string> parts = all_parts(array, kLevel, 3, {"block-side=16"});
  deliso_mesh* mesh = nullptr;
  REQUIRE(join_to(mesh, array, parts) == DELISO_OK);
  deliso_mesh_free(mesh);
  CHECK(array.largest_read < array.samples.size());
  REQUIRE(join_to(mesh, array, parts, {"check"}) == DELISO_OK);
  deliso_mesh_free(mesh);
  CHECK(array.largest_read == array.samples.size());
}

TEST_CASE("faults of parts are statuses, with one line each") {
  BallArray array;
  const Words blocks{"block-side=16"};
  CHECK(part_refusal(array, 1, 2, {"part=1/2"}) == "--part has no meaning for an array");
  CHECK(part_refusal(array, 1, 2, {"vertices=90"}) == "--part and --vertices exclude each other");
  CHECK(part_refusal(array, 1, 2, {"float"}) ==
        "--part and --float exclude each other: give it to deliso join");
  CHECK(part_refusal(array, 3, 2, {}).starts_with("--part "));
  CHECK(part_refusal(array, 0, 0, {}).starts_with("--part "));

  const std::vector<std::string> parts = all_parts(array, kLevel, 2, blocks);
  CHECK(join_refusal(array, {}) == "no parts given");
  CHECK(join_refusal(array, {parts[1]}) == "part 1 of 2 is missing beside 'parts[0]'");
  CHECK(join_refusal(array, {parts[1], parts[1]}).find("are both part 2 of 2") !=
        std::string::npos);
  CHECK(join_refusal(array, {parts[0], "solid"}) ==
        "parts[1]: is no part of a mesh, as --part makes them");
  CHECK(
      join_refusal(array, {parts[0], parts[1].substr(0, 999)}).starts_with("parts[1]: is a part "));
  CHECK(join_refusal(array, parts, {"smooth=1"}) == "--smooth has no meaning for deliso join");
  CHECK(join_refusal(array, parts, {"volume=x"}) == "--volume has no meaning for an array");
  CHECK(join_refusal(array, parts, {"attributes"}) == "--attributes has no meaning for an array");
  std::vector<std::string> mixed = all_parts(array, kLevel, 2, {"block-side=16", "lambda=1.9"});
  mixed[0] = parts[0];
  CHECK(join_refusal(array, mixed).find("is no part of the same mesh as") != std::string::npos);

  PartFile forged = part_in(std::as_bytes(std::span(parts[0])), "forged");
  std::erase_if(forged.words, [](const std::string& word) { return word.starts_with("--iso"); });
  forged.words.insert(forged.words.begin(), "--label=all");
  forged.choice = {1, 1};
  CHECK(join_refusal(array, {part_bytes(forged)}).starts_with("'parts[0]' is no sound part: "));

  // The array is another one, is not finite, or cannot be read.
  BallArray other;
  for (float& sample : other.samples) sample += 0.01f;
  CHECK(join_refusal(other, parts).ends_with(" is no part of 'array'"));
  other.place.spacing[0] = 2;
  CHECK(join_refusal(other, parts) == "'parts[0]' is no part of 'array'");
  other.samples[34 * (20 + 26 * 17) + 30] = std::numeric_limits<float>::infinity();
  CHECK(part_refusal(other, 2, 2, blocks) == "array: infinite sample at (30, 20, 17)");
  array.calls = 0;
  array.calls_before_fault = 1;
  CHECK(part_refusal(array, 1, 2, blocks).starts_with("the samples ["));
  CHECK(std::string(deliso_last_error()).ends_with("] of the array cannot be read"));
  array.calls_before_fault = 0;
  CHECK(join_refusal(array, parts).ends_with("] of the array cannot be read"));

  other.source.shape[1] = 1;
  CHECK(part_refusal(other, 1, 2, {}).starts_with("array: 1 samples along y"));
  other.source.read = nullptr;
  CHECK(part_refusal(other, 1, 2, {}) == "read is null");
  char* bytes = nullptr;
  std::size_t size = 0;
  CHECK(deliso_part_create(nullptr, 1, 1, 1, nullptr, nullptr, &bytes, &size) == DELISO_BAD_INPUT);
  CHECK(std::string(deliso_last_error()) == "source is null");
  CHECK(deliso_part_create(&array.source, 1, 1, 1, nullptr, nullptr, nullptr, &size) ==
        DELISO_BAD_INPUT);
}

TEST_CASE("a part whose counters contradict its options is refused") {
  // Once a counter of caps made the join look at samples that it had not read. The counters are
  // numbers of eight bytes, before those of the operations.
  const BallArray array;
  const Words options{"block-side=16", "max-distance=1", "threads=1"};
  const std::vector<std::string> parts = all_parts(array, kLevel, 2, options);
  constexpr std::size_t kSum = sizeof(std::uint32_t);
  const std::size_t last = parts[0].size() - kSum - sizeof(std::uint64_t);
  int refused = 0;
  for (std::size_t back = 0; back < 8 * (kOperations * (1 + kRefusals) + kCounterCount);
       back += 8) {
    std::string forged = parts[0];
    forged[last - back] = 1;
    forged.resize(forged.size() - kSum);
    const std::uint32_t sum = crc32(std::as_bytes(std::span(forged)));
    char of_sum[kSum];
    std::memcpy(of_sum, &sum, kSum);
    forged.append(of_sum, kSum);
    deliso_mesh* mesh = nullptr;
    const deliso_status status = join_to(mesh, array, {forged, parts[1]});
    deliso_mesh_free(mesh);
    CHECK((status == DELISO_OK || status == DELISO_BAD_INPUT));
    if (status == DELISO_OK) continue;
    ++refused;
    CHECK(std::string(deliso_last_error()).find("is no sound part: ") != std::string::npos);
  }
  CHECK(refused == 2);  // cap triangles refused, and components left out
}

TEST_CASE("an empty mesh of parts is refused unless it is allowed") {
  const BallArray array;
  const std::vector<std::string> parts = all_parts(array, 99, 2, {"block-side=16"});
  CHECK(join_refusal(array, parts) ==
        "the mesh at isovalue 99 is empty (--allow-empty accepts that)");
  deliso_mesh* mesh = nullptr;
  REQUIRE(join_to(mesh, array, parts, {"allow-empty"}) == DELISO_OK);
  CHECK(MeshContent(mesh).corners.empty());
}

TEST_CASE("parts and joins tell their progress, and stop when they are canceled") {
  const BallArray array;
  struct Watched {
    int flag = 0;
    int stop_after = std::numeric_limits<int>::max();
    int calls = 0;
    double last = 0;
  };
  const auto progress = [](void* context, const char*, double share) {
    Watched& watched = *static_cast<Watched*>(context);
    CHECK(share >= watched.last);
    watched.last = share;
    if (++watched.calls > watched.stop_after) std::atomic_ref(watched.flag).store(1);
  };
  const Words blocks{"block-side=8"};
  const std::vector<std::string> parts = all_parts(array, kLevel, 2, blocks);
  for (const bool stops : {false, true}) {
    const deliso_status expected = stops ? DELISO_CANCELED : DELISO_OK;
    Watched of_part, of_join;
    if (stops) of_part.stop_after = of_join.stop_after = 0;
    const deliso_watch first{&of_part.flag, progress, &of_part};
    std::string bytes;
    CHECK(make_part_of(array, kLevel, 1, 2, blocks, bytes, &first) == expected);
    CHECK(bytes.empty() == stops);
    const deliso_watch second{&of_join.flag, progress, &of_join};
    deliso_mesh* mesh = nullptr;
    CHECK(join_to(mesh, array, parts, {}, &second) == expected);
    CHECK((mesh == nullptr) == stops);
    deliso_mesh_free(mesh);
    CHECK(of_part.calls > 0);
    CHECK(of_join.calls > 0);
  }
}
