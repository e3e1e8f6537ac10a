// SPDX-License-Identifier: MIT
// --vertices and --triangles: the number is the one asked for, or one line says what stopped it.
#include "app/count_stop.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "app/input.h"
#include "app/mesh_run.h"
#include "app/parsed_line.h"
#include "app/progress.h"

namespace deliso {
namespace {

struct CountRun {
  CountStop stop = CountStop::none;
  std::size_t vertices = 0, triangles = 0;  // without caps
  std::vector<std::string> warnings;
  std::string report;
};

CountRun outcome_of(const std::string& arguments) {
  const CommandLine line = test::parsed(arguments);
  const Input input = read_input(line);
  MeshRun run(line, input);
  ProgressBar progress(mesh_stages(line), false);
  CountRun out;
  mesh_input(run, progress);
  out.warnings = test::warnings_of(run.notes);
  out.stop = count_stop(run);
  out.vertices = line.options.cap ? run.report.cap.surface_vertices : run.found.vertices;
  out.triangles = line.options.cap ? run.report.cap.surface_triangles : run.found.triangles;
  out.report = report_text(run);
  return out;
}

// The warning and the report's line are the same, and begin with the number.
void check_said(const CountRun& out, const std::string& beginning) {
  REQUIRE(out.warnings.size() == 1);
  CHECK(out.warnings[0].starts_with(beginning));
  CHECK(out.report.find("\ncount     " + out.warnings[0] + "\n") != std::string::npos);
}

}  // namespace

TEST_CASE("a number that is reached needs no word") {
  for (const std::string field : {"builtin:torus:16", "builtin:gyroid:16"}) {
    CAPTURE(field);
    const CountRun vertices = outcome_of(field + " --vertices 500");
    CHECK(vertices.vertices == 500);
    const CountRun triangles = outcome_of(field + " --triangles 501");
    CHECK(triangles.triangles <= 501);
    CHECK(triangles.triangles >= 500);
    for (const CountRun& out : {vertices, triangles}) {
      CHECK(out.stop == CountStop::none);
      CHECK(out.warnings.empty());
      CHECK(out.report.find("\ncount ") == std::string::npos);
    }
  }
}

TEST_CASE("what the topology needs is said with its features") {
  const CountRun vertices = outcome_of("builtin:gyroid:16 --vertices 10");
  CHECK(vertices.stop == CountStop::topology);
  check_said(vertices, std::to_string(vertices.vertices) + " vertices, 10 asked for: ");
  CHECK(vertices.warnings[0].find(" handles, ") != std::string::npos);
  const CountRun triangles = outcome_of("builtin:five_spheres:16 --triangles 10");
  CHECK(triangles.stop == CountStop::topology);
  check_said(triangles, "20 triangles, 10 asked for: ");
  CHECK(triangles.warnings[0].find("(5 components)") != std::string::npos);
}

TEST_CASE("what is not refined is said") {
  const CountRun out = outcome_of("builtin:torus:16 --vertices 100000 --rmin 2vox");
  CHECK(out.stop == CountStop::refinement);
  check_said(out, std::to_string(out.vertices));
  CHECK(out.warnings[0].find("--rmin") != std::string::npos);
}

TEST_CASE("caps do not count") {
  const CountRun out = outcome_of("builtin:gyroid:16 --triangles 800 --cap");
  CHECK((out.stop == CountStop::none) == (out.triangles <= 800 && out.triangles >= 784));
  CHECK(out.triangles < 820);
  CHECK(out.warnings.size() == (out.stop == CountStop::none ? 0 : 1));
}

}  // namespace deliso
