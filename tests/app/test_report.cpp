// SPDX-License-Identifier: MIT
// The JSON of the commands follows its schema, and uses all of it. Every word of the
// reports is explained in docs/guide/report.md.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "app/command_line.h"
#include "app/json_schema.h"
#include "app/mesh_run.h"
#include "app/option_texts.h"
#include "app/progress.h"
#include "app/run.h"
#include "app/text.h"
#include "check/faults.h"
#include "surface/report.h"

using namespace deliso;

namespace {

std::string content(const std::filesystem::path& path) {
  std::ifstream in(path);
  REQUIRE_MESSAGE(in.good(), path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::filesystem::path docs() {
  return std::filesystem::path(__FILE__).parent_path().parent_path().parent_path() / "docs";
}

const json::Value& schema() {
  static const json::Value value = json::parse(report_schema());
  return value;
}

// A folder of its own, gone at the end.
struct Folder {
  Folder() : path(std::filesystem::temp_directory_path() / "deliso-test-report") {
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string file(const std::string& name) const { return (path / name).string(); }
  std::filesystem::path path;
};

// What a command line writes with --json.
json::Value written(const Folder& folder, std::vector<std::string> arguments) {
  const std::string file = folder.file("report.json");
  arguments.insert(arguments.end(), {"--json", file, "--quiet"});
  const std::vector<std::string_view> views(arguments.begin(), arguments.end());
  const CommandLine line = parse_command_line(views);
  if (line.command == Command::mesh) run_mesh(line);
  if (line.command == Command::info) run_info(line);
  if (line.command == Command::check) run_check(line);
  return json::parse(content(file));
}

// Mesh reports of every kind, checks of good and bad meshes, info of volumes of every kind.
std::vector<json::Value> all_reports() {
  const Folder folder;
  const std::string mesh = folder.file("mesh.ply"), bad = folder.file("bad.off");
  const std::string padded = folder.file("padded.raw");
  std::vector<json::Value> all;
  const std::string field = "builtin:fuel:24";
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{"--check", "-o", mesh},
                                             {"--cap", "--check"},
                                             {"--vertices", "300"},
                                             {"--paper"},
                                             {"--max-radius", "3", "--eps1", "0.2"},
                                             {"--stop-after", "recover"},
                                             {"--iso", "1e9", "--allow-empty", "--check"}}) {
    std::vector<std::string> arguments{field};
    arguments.insert(arguments.end(), more.begin(), more.end());
    all.push_back(written(folder, arguments));
  }
  all.push_back(written(folder, {"check", mesh, field}));
  all.push_back(written(folder, {"check", mesh, field, "--cap"}));  // it has holes
  std::ofstream(bad) << "OFF\n4 2 0\n0 0 0\n9 0 0\n0 9 0\n9 0 0\n3 0 1 2\n3 0 1 1\n";
  all.push_back(written(folder, {"check", bad, field}));
  all.push_back(written(folder, {"info", field}));
  all.push_back(written(folder, {"info", field, "--iso", "0.3"}));
  std::ofstream out(padded, std::ios::binary);
  for (int n = 0; n < 20 * 20 * 20; ++n) {
    const std::array<char, 3> levels{0, static_cast<char>(100 + n % 40),
                                     static_cast<char>(200 - n % 7)};
    out.put(levels[static_cast<std::size_t>(n % 3)]);
  }
  out.close();
  all.push_back(written(folder, {"info", padded, "--dims", "20x20x20", "--type", "uint8"}));
  const std::vector<std::string> mask{padded, "--dims", "20x20x20", "--type", "uint8"};
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{"--label", "120,121,200", "--smooth", "2"},
                                             {"--label", "0", "--median", "1", "--allow-empty"}}) {
    std::vector<std::string> arguments = mask;
    arguments.insert(arguments.end(), more.begin(), more.end());
    all.push_back(written(folder, arguments));
  }
  all.push_back(written(folder, {"info", field, "--median", "1", "--smooth", "1vox"}));
  const std::string named = folder.file("named.vtk");
  std::ofstream(named) << "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET STRUCTURED_POINTS\n"
                          "DIMENSIONS 2 2 2\nSPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA 8\n"
                          "SCALARS density float\nLOOKUP_TABLE default\n0 1 2 3 4 5 6 7\n";
  all.push_back(written(folder, {"info", named, "--array", "density"}));
  return all;
}

const std::vector<json::Value>& reports() {
  static const std::vector<json::Value> all = all_reports();
  return all;
}

// What the report of a mesh says, line by line, but for the cost. `counters` overwrites those of
// the run.
std::vector<std::string> lines_of_run(std::vector<std::string_view> arguments,
                                      const std::vector<std::pair<Counter, int>>& counters = {}) {
  const CommandLine line = parse_command_line(arguments);
  const Input input = read_input(line);
  MeshRun run(line, input);
  ProgressBar progress(mesh_stages(line), false);
  mesh_input(run, progress, [](const std::string&) {});
  for (const auto& [counter, value] : counters) {
    run.report[counter] = static_cast<std::uint64_t>(value);
  }
  std::vector<std::string> lines;
  std::istringstream text(report_text(run));
  for (std::string word; std::getline(text, word);) {
    if (!word.starts_with("cost ")) lines.push_back(word);
  }
  return lines;
}

// Every key that stands anywhere in a value.
void collect_keys(const json::Value& value, std::set<std::string>& keys) {
  for (const auto& [key, member] : value.members) {
    keys.insert(key);
    collect_keys(member, keys);
  }
  for (const json::Value& item : value.items) collect_keys(item, keys);
}

// The properties that the schema names anywhere.
void collect_properties(const json::Value& value, std::set<std::string>& keys) {
  for (const auto& [key, member] : value.members) {
    if (key == "properties") keys.insert(member.order.begin(), member.order.end());
    collect_properties(member, keys);
  }
  for (const json::Value& item : value.items) collect_properties(item, keys);
}

// All objects in a value: what there is to break.
void collect_objects(json::Value& value, std::vector<json::Value*>& objects) {
  if (value.kind == json::Value::Kind::object) objects.push_back(&value);
  for (auto& [key, member] : value.members) collect_objects(member, objects);
  for (json::Value& item : value.items) collect_objects(item, objects);
}

}  // namespace

TEST_CASE("all JSON of the commands follows the schema, which has a version") {
  const json::Validator validator(schema());
  for (const json::Value& report : reports()) {
    REQUIRE(report.order.size() > 3);
    CHECK(report.order[0] == "schema");
    CHECK(report.find("schema")->number == 1);
    CAPTURE(report.find("command")->string);
    CHECK(validator.fault(report) == "");
  }
}

TEST_CASE("everything in the schema is written by some run") {
  std::set<std::string> keys, described;
  for (const json::Value& report : reports()) collect_keys(report, keys);
  collect_properties(schema(), described);
  REQUIRE(described.size() > 150);
  for (std::size_t n = 0; n < kFaultKinds; ++n) {
    const std::string kind(name_of(static_cast<FaultKind>(n)));
    CHECK_MESSAGE(described.contains(kind), kind);
    described.erase(kind);  // no mesh has them all
  }
  for (const std::string& key : described) CHECK_MESSAGE(keys.contains(key), key);
}

TEST_CASE("the schema refuses an added key, a missing key and another type anywhere") {
  const json::Validator validator(schema());
  int broken = 0;
  for (const std::size_t which : {0u, 8u, 10u, 12u, 13u}) {
    const json::Value& good = reports()[which];
    REQUIRE(validator.fault(good) == "");
    json::Value all = good;
    std::vector<json::Value*> places;
    collect_objects(all, places);
    // Changes one object of a copy, which must then be refused.
    const auto refuses = [&](std::size_t place, const auto& change) {
      json::Value copy = good;
      std::vector<json::Value*> objects;
      collect_objects(copy, objects);
      change(*objects[place]);
      ++broken;
      return validator.fault(copy) != "";
    };
    for (std::size_t n = 0; n < places.size(); ++n) {
      CHECK(refuses(n, [](json::Value& object) { object.members["no_such_key"] = {}; }));
      for (const std::string& key : places[n]->order) {
        CAPTURE(key);
        const bool is_boolean = places[n]->find(key)->kind == json::Value::Kind::boolean;
        CHECK(refuses(n, [&](json::Value& object) {
          object.members[key].kind =
              is_boolean ? json::Value::Kind::string : json::Value::Kind::boolean;
        }));
      }
    }
  }
  CHECK(broken > 500);
  json::Value older = reports()[0];
  older.members["schema"].number = 0;
  CHECK(validator.fault(older) != "");
  json::Value lacking = reports()[0];
  lacking.members.erase("counters");
  CHECK(validator.fault(lacking) != "");
  json::Value negative = reports()[0];
  negative.members["mesh"].members["vertices"].number = -1;
  CHECK(validator.fault(negative) != "");
  CHECK_THROWS(json::parse("{\"a\": 1, \"a\": 2}"));
  CHECK_THROWS(json::parse("{\"a\": 1"));
  CHECK_THROWS(json::parse("[1, 2] 3"));
}

TEST_CASE("--verbose adds lines to the report, and leaves none out") {
  const std::vector<std::string_view> runs[] = {{"builtin:noise:16"},
                                                {"builtin:torus", "--cap", "--check"},
                                                {"builtin:fuel:24", "--vertices", "300"},
                                                {"builtin:torus", "--paper"}};
  for (const std::vector<std::string_view>& arguments : runs) {
    std::vector<std::string_view> more = arguments;
    more.push_back("--verbose");
    const std::vector<std::string> lines = lines_of_run(arguments), all = lines_of_run(more);
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

TEST_CASE("a cost is told in units of its size") {
  CHECK(cost_text(75.4, 3e8) == "75 seconds and 286 MiB");
  CHECK(cost_text(600, 1.5e9) == "10 minutes and 1.4 GiB");
  CHECK(cost_text(1e4, 1e12) == "2.8 hours and 931 GiB");
}

TEST_CASE("faults of rounding are told by their kinds") {
  CHECK(place_faults_text({1, 0, 0}) == "1 pair of triangles cross");
  CHECK(place_faults_text({0, 1, 1}) == "1 triangle flat, 1 vertex coincide with others");
}

TEST_CASE("what is not guaranteed is in the default report, by the names of the JSON") {
  const auto has = [](const std::vector<std::string>& lines, std::string_view line) {
    return std::ranges::find(lines, line) != lines.end();
  };
  const std::vector<std::string> sound =
      lines_of_run({"builtin:torus"}, {{Counter::unrefined_facets, 0}, {Counter::points_far, 0}});
  CHECK(sound.back() == "verdict   exact topology, no crossings");
  const std::vector<std::string> lines = lines_of_run(
      {"builtin:torus"},
      {{Counter::unrefined_facets, 3}, {Counter::points_far, 1}, {Counter::uncertified_sites, 2}});
  CHECK(has(lines, "verdict   exact topology, no crossings"));
  CHECK(has(lines, "          1 point of the surface further than 2 D (points_far)"));
  CHECK(has(lines, "          2 places where the proof of the topology fails (uncertified_sites)"));
  CHECK(std::ranges::any_of(lines, [](const std::string& line) {
    return line.starts_with("          3 of ") &&
           line.ends_with(" triangles over a limit (unrefined_facets)");
  }));
  // The README names them, so that its reader finds them in the report.
  const std::string readme = content(docs().parent_path() / "README.md");
  for (const Counter c :
       {Counter::unrefined_facets, Counter::points_far, Counter::uncertified_sites}) {
    CHECK(readme.find("`" + std::string(name_of(c)) + "`") != std::string::npos);
  }
}

TEST_CASE("every word of the reports is explained in the guide, once") {
  const std::string page = content(docs() / "guide" / "report.md");
  const auto check_row = [&](std::string_view name) {
    const std::string row = "\n| `" + std::string(name) + "` |";
    const std::size_t at = page.find(row);
    CHECK_MESSAGE(at != std::string::npos, name);
    CHECK_MESSAGE(page.find(row, at + 1) == std::string::npos, name);
  };
  for (std::size_t n = 0; n < kCounterCount; ++n) check_row(name_of(static_cast<Counter>(n)));
  for (std::size_t n = 0; n < kOperations; ++n) check_row(name_of(static_cast<Operation>(n)));
  for (std::size_t n = 0; n < kRefusals; ++n) check_row(name_of(static_cast<Refusal>(n)));
  for (std::size_t n = 0; n < kFaultKinds; ++n) check_row(name_of(static_cast<FaultKind>(n)));
  for (const std::string_view word :
       {"us/point", "searches/p", "CPI",           "CPI*",     "r",        "l",       "h",
        "D",        "r_min",      "r/l",           "h/r",      "labels",   "done",    "counters",
        "refused",  "kd-tree",    "exact contour", "initial",  "recover",  "poles",   "refine",
        "cap",      "check",      "exact",         "solid",    "distance", "quality", "delaunay",
        "mesh->",   "->mesh",     "criteria",      "boundary", "padding",  "try",     "filter",
        "label",    "volume",     "largest",       "sizes",    "count",    "off"}) {
    check_row(word);
  }
}
