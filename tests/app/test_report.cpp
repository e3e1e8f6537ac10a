// SPDX-License-Identifier: MIT
// The JSON of the commands follows its schema, and uses all of it. Every word of the
// reports is explained in docs/glossary.md.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "app/json_schema.h"
#include "app/mesh_run.h"
#include "app/option_texts.h"
#include "app/parsed_line.h"
#include "app/progress.h"
#include "app/run.h"
#include "app/text.h"
#include "check/check_solid.h"
#include "check/faults.h"
#include "io/files/temporary_folder.h"
#include "io/volume/volume_files.h"
#include "run/report.h"

using namespace deliso;
using namespace deliso::test;

namespace {

std::filesystem::path docs() {
  return std::filesystem::path(__FILE__).parent_path().parent_path().parent_path() / "docs";
}

const JsonValue& schema() {
  static const JsonValue value = parse_json(report_schema(), "schema");
  return value;
}

// What a command line writes with --json.
JsonValue written(const TemporaryFolder& folder, const std::string& arguments) {
  const std::string file = folder / "report.json";
  const CommandLine line = parsed(arguments + " --quiet --json " + file);
  if (line.command == Command::mesh) run_mesh(line);
  if (line.command == Command::info) run_info(line);
  if (line.command == Command::check) run_check(line);
  if (line.command == Command::solid) run_solid(line);
  return parse_json(file_bytes(file), file);
}

// Mesh reports of every kind, checks of good and bad meshes, info of volumes of every kind.
std::vector<JsonValue> all_reports() {
  const TemporaryFolder folder;
  const std::string mesh = folder / "mesh.ply", field = "builtin:fuel:24";
  const std::string bad =
      folder.write("bad.off", "OFF\n4 2 0\n0 0 0\n9 0 0\n0 9 0\n9 0 0\n3 0 1 2\n3 0 1 1\n");
  const std::string tetrahedron = folder.write(
      "one.off", "OFF\n4 4 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  std::string samples;
  for (int n = 0; n < 20 * 20 * 20; ++n) {
    const int levels[] = {0, 100 + n % 40, 200 - n % 7};
    samples += static_cast<char>(levels[n % 3]);
  }
  const std::string mask = folder.write("padded.raw", samples) + " --dims 20x20x20 --type uint8";
  const std::string corner = mask + " --roi 0:8,0:8,0:8";  // all of it takes 15 times as long
  const std::string named = folder.write(
      "named.vtk",
      "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\n"
      "SPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA 8\nSCALARS density float\nLOOKUP_TABLE default\n"
      "0 1 2 3 4 5 6 7\n");
  const std::string labels =
      folder.write("labels.raw", {0, 0, 0, 0, 0, 1, 1, 0, 0, 2, 2, 0, 0, 0, 0, 0,
                                  0, 3, 3, 0, 0, 1, 1, 0, 0, 2, 2, 2, 0, 0, 0, 0}) +
      " --dims 4x4x2 --type uint8";
  for (const char* number : {"1", "2"}) {
    DicomElements elements = dicom_image(random_truth(SampleType::u8, {4, 3, 5}, 3), {}, 0, 5);
    elements[0x0020000e] = {"UI", number};
    std::filesystem::create_directories(folder / "series");
    folder.write(text("series/", number), dicom_file({}, elements));
  }
  std::vector<JsonValue> all;
  for (const std::string& line : {field + " --check -o " + mesh,
                                  field + " --cap --check",
                                  field + " --vertices 300 --free-vertices 0.5vox",
                                  field + " --paper",
                                  field + " --max-radius 3 --eps1 0.2",
                                  field + " --stop-after stage1",
                                  field + " --iso 1e9 --allow-empty --check",
                                  "check " + mesh + " " + field + " --triangulate",
                                  "check " + mesh + " " + field + " --cap",  // it has holes
                                  "check " + bad + " " + field,
                                  "info " + field,
                                  "info " + field + " --iso 0.3",
                                  "info " + mask,
                                  corner + " --label 120,121,200 --smooth 2",
                                  corner + " --label 0 --median 1 --allow-empty",
                                  "info " + field + " --median 1 --smooth 1vox",
                                  "info " + named + " --array density",
                                  "check " + mesh + " " + bad,
                                  "solid " + tetrahedron + " -o " + (folder / "s.vtu"),
                                  "check " + (folder / "s.vtu") + " " + bad,
                                  labels + " --label all --cap --vertices 300 --shared " + mesh,
                                  "info " + labels + " --label 1 --coordinates " +
                                      folder.write("z.txt", "z 0 3\nx 0 1 2 4\n"),
                                  "info " + (folder / "series")}) {
    all.push_back(written(folder, line));
  }
  return all;
}

const std::vector<JsonValue>& reports() {
  static const std::vector<JsonValue> all = all_reports();
  return all;
}

// What the report of a mesh says, line by line, but for the cost. `counters` and `close`
// overwrite those of the run.
std::vector<std::string> lines_of_run(const std::string& arguments,
                                      const std::vector<std::pair<Counter, int>>& counters = {},
                                      const std::optional<ClosePlaces>& close = {}) {
  const CommandLine line = parsed(arguments);
  const Input input = read_input(line);
  MeshRun run(line, input);
  ProgressBar progress(mesh_stages(line), false);
  mesh_input(run, progress);
  for (const auto& [counter, value] : counters) {
    run.report[counter] = static_cast<std::uint64_t>(value);
  }
  if (close) run.found.close = *close;
  std::vector<std::string> lines;
  std::istringstream text(report_text(run));
  for (std::string word; std::getline(text, word);) {
    if (!word.starts_with("cost ")) lines.push_back(word);
  }
  return lines;
}

// Every key that stands anywhere in a value.
void collect_keys(const JsonValue& value, std::set<std::string>& keys) {
  keys.insert(value.keys.begin(), value.keys.end());
  for (const JsonValue& item : value.items) collect_keys(item, keys);
}

// The properties that the schema names anywhere.
void collect_properties(const JsonValue& value, std::set<std::string>& keys) {
  const std::vector<std::string>& properties = value["properties"].keys;
  keys.insert(properties.begin(), properties.end());
  for (const JsonValue& item : value.items) collect_properties(item, keys);
}

// All objects in a value: what there is to break.
void collect_objects(JsonValue& value, std::vector<JsonValue*>& objects) {
  if (value.kind == JsonValue::Kind::object) objects.push_back(&value);
  for (JsonValue& item : value.items) collect_objects(item, objects);
}

JsonValue& member(JsonValue& object, const std::string& key) {
  const auto at = std::ranges::find(object.keys, key) - object.keys.begin();
  return object.items.at(static_cast<std::size_t>(at));
}

}  // namespace

TEST_CASE("all JSON of the commands follows the schema, which has a version") {
  const Validator validator(schema());
  for (const JsonValue& report : reports()) {
    REQUIRE(report.keys.size() > 3);
    CHECK(report.keys[0] == "schema");
    CHECK(report["schema"].number == 1);
    CAPTURE(report["command"].string);
    CHECK(validator.fault(report) == "");
  }
}

TEST_CASE("everything in the schema is written by some run") {
  std::set<std::string> keys, described;
  for (const JsonValue& report : reports()) collect_keys(report, keys);
  collect_properties(schema(), described);
  REQUIRE(described.size() > 150);
  std::set<std::string> kinds;
  for (std::size_t n = 0; n < kFaultKinds; ++n) {
    kinds.emplace(name_of(static_cast<FaultKind>(n)));
  }
  for (std::size_t n = 0; n < static_cast<std::size_t>(SolidFaultKind::count_); ++n) {
    kinds.emplace(name_of(static_cast<SolidFaultKind>(n)));
  }
  for (const std::string& kind : kinds) {
    CHECK_MESSAGE(described.contains(kind), kind);
    described.erase(kind);  // no mesh has them all
  }
  for (const std::string& key : described) CHECK_MESSAGE(keys.contains(key), key);
}

TEST_CASE("the schema refuses an added key, a missing key and another type anywhere") {
  const Validator validator(schema());
  int broken = 0;
  for (const std::size_t which : {0u, 3u, 8u, 10u, 12u, 13u}) {
    const JsonValue& good = reports()[which];
    REQUIRE(validator.fault(good) == "");
    JsonValue all = good;
    std::vector<JsonValue*> places;
    collect_objects(all, places);
    // Changes one object of a copy, which must then be refused.
    const auto refuses = [&](std::size_t place, const auto& change) {
      JsonValue copy = good;
      std::vector<JsonValue*> objects;
      collect_objects(copy, objects);
      change(*objects[place]);
      ++broken;
      return validator.fault(copy) != "";
    };
    for (std::size_t n = 0; n < places.size(); ++n) {
      CHECK(refuses(n, [](JsonValue& object) {
        object.keys.emplace_back("no_such_key");
        object.items.emplace_back();
      }));
      for (const std::string& key : places[n]->keys) {
        CAPTURE(key);
        const bool is_boolean = (*places[n])[key].kind == JsonValue::Kind::boolean;
        CHECK(refuses(n, [&](JsonValue& object) {
          member(object, key).kind =
              is_boolean ? JsonValue::Kind::string : JsonValue::Kind::boolean;
        }));
        CHECK(refuses(n, [&](JsonValue& object) {
          object.items.push_back(JsonValue(object[key]));
          object.keys.push_back(key);
        }));
      }
    }
  }
  CHECK(broken > 900);
  JsonValue older = reports()[0];
  member(older, "schema").number = 0;
  CHECK(validator.fault(older) != "");
  JsonValue lacking = reports()[0];
  const auto at = std::ranges::find(lacking.keys, "counters") - lacking.keys.begin();
  lacking.keys.erase(lacking.keys.begin() + at);
  lacking.items.erase(lacking.items.begin() + at);
  CHECK(validator.fault(lacking) != "");
  JsonValue negative = reports()[0];
  member(member(negative, "mesh"), "vertices").number = -1;
  CHECK(validator.fault(negative) != "");
}

TEST_CASE("--verbose adds lines to the report, and leaves none out") {
  for (const std::string arguments :
       {"builtin:noise:16", "builtin:torus --cap --check", "builtin:fuel:24 --vertices 300",
        "builtin:torus --paper", "builtin:torus --paper --certified"}) {
    const std::vector<std::string> lines = lines_of_run(arguments),
                                   all = lines_of_run(arguments + " --verbose");
    CHECK(all.size() > lines.size());
    auto at = all.begin();
    for (const std::string& line : lines) {
      CAPTURE(line);
      at = std::find(at, all.end(), line);
      REQUIRE(at != all.end());
      ++at;
    }
  }
}

TEST_CASE("faults of rounding are told by their kinds") {
  CHECK(place_faults_text({1, 0, 0}) == "1 pair of triangles cross");
  CHECK(place_faults_text({0, 1, 1}) == "1 triangle flat, 1 vertex coincide with others");
}

// Doubles are 2 apart at 1e16. The verdict was on the coordinates in memory: no crossings.
TEST_CASE(
    "the verdict is on the coordinates of the file, which doubles round far from the origin") {
  const TemporaryFolder folder;
  for (const bool far : {false, true}) {
    CAPTURE(far);
    const CommandLine line = parsed("builtin:sphere:16 --iso 0.5 -o " + folder / "far.ply" +
                                    (far ? " --spacing 1,1,1 --origin 1e16,0,0" : ""));
    const Input input = read_input(line);
    MeshRun run(line, input);
    ProgressBar progress(mesh_stages(line), false);
    mesh_input(run, progress);
    CHECK(run.sound() == !far);
    CHECK((run.written.by_rounding().coincident > 0) == far);
    CHECK((report_text(run).find("FAULT: double precision makes") != std::string::npos) == far);
    CHECK((report_text(run).find("no crossings") == std::string::npos) == far);
  }
}

// Saddles of faces at the isovalue: T crosses itself in the smallest cells, too. Stage 2 mends the
// second voxel. The verdict said of both that triangles may cross in one voxel.
TEST_CASE("the verdict tells how many triangles cross, as the check finds them") {
  const TemporaryFolder folder;
  const auto crossings = [&](const std::string& samples, const std::string& isovalue) {
    const std::string file = folder.write(
        "saddles.vtk",
        "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\n"
        "SPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA 8\nSCALARS density double\n"
        "LOOKUP_TABLE default\n" +
            samples + "\n");
    const CommandLine line = parsed(file + " --iso " + isovalue),
                      checked = parsed(file + " --check --iso " + isovalue);
    const Input input = read_input(line);
    MeshRun run(line, input), with_check(checked, input);
    for (MeshRun* each : {&run, &with_check}) {
      ProgressBar progress(mesh_stages(each->line), false);
      mesh_input(*each, progress);
      CHECK(each->report[Counter::voxels_crossed] == 1);
    }
    const std::size_t found = with_check.verification->faults.count(FaultKind::self_intersections);
    CHECK(run.crossings() == found);
    const std::string words =
        found == 0 ? ", no crossings\n" : text("; ", found, " crossing pairs of triangles\n");
    CHECK(report_text(run).find("verdict   exact topology" + words) != std::string::npos);
    return found;
  };
  CHECK(crossings("1 0 0 1 0 1 0 0", "0.5") > 0);
  CHECK(crossings("1 0.5 2 0.5 2 2 1 2.5", "1.5") == 0);
}

TEST_CASE("what is not guaranteed is in the default report, by the names of the JSON") {
  const auto has = [](const std::vector<std::string>& lines, std::string_view line) {
    return std::ranges::find(lines, line) != lines.end();
  };
  const std::vector<std::string> sound =
      lines_of_run("builtin:torus", {{Counter::unrefined_facets, 0}, {Counter::points_far, 0}});
  CHECK(sound.back() == "verdict   exact topology, no crossings");
  const std::vector<std::string> lines =
      lines_of_run("builtin:torus", {{Counter::unrefined_facets, 3}, {Counter::points_far, 1}},
                   ClosePlaces{{4, 7}, {{1, 2}}, {{0, 9}}, 0});
  CHECK(has(lines, "verdict   exact topology, no crossings"));
  CHECK(has(lines, "          1 point of the surface further than 2 D (points_far)"));
  CHECK(has(lines, "          2 triangles with an angle below 0.01 degrees (needle_triangles)"));
  CHECK(has(lines, "          1 pair of triangles folded on each other (folds)"));
  CHECK(has(lines, "          1 vertex nearly on a triangle of others (near_vertices)"));
  CHECK(std::ranges::any_of(lines, [](const std::string& line) {
    return line.starts_with("          3 of ") &&
           line.ends_with(" triangles over a limit (unrefined_facets)");
  }));
  // The README names them, so that its reader finds them in the report.
  const std::string readme = file_bytes(docs().parent_path() / "README.md");
  for (const Counter c : {Counter::unrefined_facets, Counter::points_far}) {
    CHECK(readme.find("`" + std::string(name_of(c)) + "`") != std::string::npos);
  }
}

TEST_CASE("every word of the reports is explained in the dictionary, once") {
  const std::string page = file_bytes(docs() / "glossary.md");
  const auto check_row = [&](std::string_view name) {
    const std::string row = "\n| `" + std::string(name) + "` |";
    const std::size_t at = page.find(row);
    CHECK_MESSAGE(at != std::string::npos, name);
    CHECK_MESSAGE(page.find(row, at + 1) == std::string::npos, name);
  };
  for (std::size_t n = 0; n < kCounterCount; ++n) check_row(name_of(static_cast<Counter>(n)));
  const std::vector<std::string>& of_paper = reports()[3]["paper"].keys;
  auto count = std::ranges::find(of_paper, "cancelled_pairs");
  REQUIRE(count != of_paper.end());
  for (; count != of_paper.end(); ++count) check_row(*count);
  for (std::size_t n = 0; n < kOperations; ++n) check_row(name_of(static_cast<Operation>(n)));
  for (std::size_t n = 0; n < kRefusals; ++n) check_row(name_of(static_cast<Refusal>(n)));
  for (std::size_t n = 0; n < kFaultKinds; ++n) check_row(name_of(static_cast<FaultKind>(n)));
  for (std::size_t n = 0; n < static_cast<std::size_t>(SolidFaultKind::count_); ++n) {
    check_row(name_of(static_cast<SolidFaultKind>(n)));
  }
  for (const std::string_view code : kCodes) check_row(code);
  // Terms, too, which stand above the words.
  for (const std::string id : {"r", "l", "h", "d", "r-min", "lambda", "epsilon", "cpi"}) {
    CHECK_MESSAGE(page.find("\n| <a id=\"" + id + "\"></a>") != std::string::npos, id);
  }
  for (const std::string_view word :
       {"us/point",      "searches/p", "coarsen",  "done",    "counters",  "refused", "kd-tree",
        "exact contour", "initial",    "recover",  "poles",   "refine",    "cap",     "check",
        "exact",         "solid",      "distance", "quality", "delaunay",  "mesh->",  "->mesh",
        "criteria",      "boundary",   "padding",  "try",     "filter",    "label",   "volume",
        "largest",       "sizes",      "count",    "found",   "certified", "fields",  "labels",
        "shared",        "border",     "surface",  "region",  "angles"}) {
    check_row(word);
  }
}
