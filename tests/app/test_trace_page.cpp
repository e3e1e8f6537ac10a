// SPDX-License-Identifier: MIT
// The trace command: what its page holds, read back from the file.
#include "app/trace_page.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>

#include "app/parsed_line.h"
#include "app/published.h"
#include "app/run.h"
#include "base/check.h"
#include "base/text.h"
#include "io/files/temporary_folder.h"
#include "io/volume/builtin_volume.h"
#include "view/page/page_text.h"

using namespace deliso;
using namespace deliso::test;

namespace {

std::string page_of(const std::string& options) {
  const TemporaryFolder folder;
  const std::string file = folder / "page.html";
  CHECK(run_trace(parsed("trace -q -o " + file + " " + options)) == kExitSuccess);
  return file_bytes(file);
}

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

}  // namespace

TEST_CASE("the page has every array of the events, of one length, and what each program has") {
  for (const std::string program : {"", " --paper", " --paper --certified"}) {
    CAPTURE(program);
    const std::string page = page_of("builtin:torus:16" + program);
    const std::string_view header = element_of(page, "header");
    const bool paper = !program.empty();
    CHECK(has(header, "\"kind\": \"trace\""));
    CHECK(has(header, paper ? "\"program\": \"published\"" : "\"program\": \"exact\""));
    CHECK(has(header, "\"truncated\": false"));
    CHECK(has(header, "\"refused: crossing\""));
    const std::size_t events = array_of<std::uint8_t>(page, "event_routine").size();
    REQUIRE(events > 10);
    CHECK(array_of<std::uint8_t>(page, "event_outcome").size() == events);
    CHECK(array_of<std::uint8_t>(page, "event_reason").size() == events);
    CHECK(array_of<float>(page, "event_value").size() == events);
    CHECK(array_of<std::uint32_t>(page, "event_vertex").size() == events);
    CHECK(array_of<float>(page, "event_place").size() == 3 * events);
    CHECK(array_of<std::uint32_t>(page, "event_caller").size() == 3 * events);
    CHECK(array_of<float>(page, "event_edge").size() == 6 * events);
    CHECK(array_of<float>(page, "event_ball").size() == 4 * events);
    for (const char* name : {"event_micros", "event_searches", "event_computations"}) {
      CHECK(array_of<std::uint32_t>(page, name).size() == events);
    }
    for (const char* name : {"removed", "added", "zone", "star", "cone", "hits", "relabel"}) {
      CAPTURE(name);
      const auto begin = array_of<std::uint32_t>(page, std::string(name) + "_begin");
      REQUIRE(begin.size() == events + 1);
      CHECK(std::is_sorted(begin.begin(), begin.end()));
      const bool pairs = std::string_view(name) == "relabel";
      const bool fours = std::string_view(name) == "zone";
      const std::size_t width = pairs ? 2 : fours ? 4 : 3;
      CHECK(array_of<std::uint32_t>(page, name).size() == width * begin.back());
    }
    // The run's counts never fall, and the page has the final mesh.
    const auto searches = array_of<std::uint32_t>(page, "event_searches");
    CHECK(std::is_sorted(searches.begin(), searches.end()));
    // There are tetrahedra and regions of T only where Stage 1 has them.
    CHECK(array_of<std::uint32_t>(page, "tets").empty() == !paper);
    CHECK(array_of<float>(page, "contour_points").empty() == (program != " --paper --certified"));
  }
}

TEST_CASE("with --paper the page shows the published program, with its counts") {
  const std::string words = "builtin:fuel:16 --paper --rmin 0.3vox";
  const std::string page = page_of(words);
  const CommandLine line = parsed("trace -o page.html " + words);
  const Volume volume = make_builtin_volume("builtin:fuel:16");
  paper::Observer none;
  paper::Report published;
  Report report;
  const TriMesh mesh = mesh_as_published(volume, *line.isovalue, line, none, published, report);
  const auto routine = array_of<std::uint8_t>(page, "event_routine");
  const auto vertex = array_of<std::uint32_t>(page, "event_vertex");
  const auto at_switch = std::ranges::find(routine, trace_code(Routine::build_tri_mesh));
  REQUIRE(at_switch != routine.end());
  std::size_t in_recover = 0, in_refine = 0;
  for (std::size_t e = 0; e < routine.size(); ++e) {
    const bool is_stage1 = routine.begin() + static_cast<std::ptrdiff_t>(e) < at_switch;
    (is_stage1 ? in_recover : in_refine) += vertex[e] != kNoId;
    CHECK((routine[e] <= trace_code(Routine::approximate_geom) ||
           routine[e] == trace_code(Routine::build_tri_mesh) ||
           routine[e] == trace_code(Operation::surface_point)));
  }
  CHECK(in_recover == published.insertions_recover);
  CHECK(in_refine == published.insertions_refine);
  CHECK(array_of<std::uint32_t>(page, "event_searches").back() ==
        published.searches_recover.searches + published.searches_refine.searches);
  const auto facets = [&](const char* name) {
    return array_of<std::uint32_t>(page, name).size() / 3;
  };
  CHECK(facets("added") - facets("removed") == mesh.faces.size());
  const std::string_view header = element_of(page, "header");
  CHECK(has(header, "exact_topology"));
}

TEST_CASE(
    "the header has the topology of the mesh and, unless components are chosen, of the surface") {
  const std::string page = page_of("builtin:torus:16");
  const std::string counts =
      "{\n    \"components\": 1,\n    \"euler\": 0,\n    \"boundary_loops\": 0\n  }";
  CHECK(has(element_of(page, "header"), "\"topology\": " + counts));
  CHECK(has(element_of(page, "header"), "\"exact_topology\": " + counts));
  CHECK_FALSE(has(element_of(page_of("builtin:torus:16 --largest 1"), "header"), "exact_topology"));
}

TEST_CASE("samples are those of the volume") {
  const std::string page = page_of("builtin:torus:16");
  const Volume volume = make_builtin_volume("builtin:torus:16");
  const auto samples = array_of<std::uint16_t>(page, "samples");
  REQUIRE(samples.size() == volume.sample_count());
  const ValueRange range = value_range(volume);
  const double step = (range.max - range.min) / 65535;
  const Index3 dims = volume.dims();
  std::size_t n = 0;
  for (int k = 0; k < dims.k; ++k) {
    for (int j = 0; j < dims.j; ++j) {
      for (int i = 0; i < dims.i; ++i, ++n) {
        CHECK(std::abs(range.min + step * samples[n] - volume.sample(i, j, k)) <= 0.51 * step);
      }
    }
  }
}

TEST_CASE("without times two pages are the same, and the page has the limit") {
  const std::string first = page_of("builtin:fuel:16 --no-times");
  CHECK(first == page_of("builtin:fuel:16 --no-times"));
  CHECK_FALSE(has(element_of(first, "header"), "seconds"));
  const std::string cut = page_of("builtin:fuel:16 --trace-limit 20");
  CHECK(array_of<std::uint8_t>(cut, "event_routine").size() == 20);
  CHECK(has(element_of(cut, "header"), "\"truncated\": true"));
  CHECK(has(element_of(cut, "header"), "\"limit\": 20"));
}

// A site added after the trace was full has no number. Its number was read all the same, from
// memory after the array. The page does not show it, so only sanitizers can find the fault.
TEST_CASE("a trace that fills up in the middle of a stage has events of vertices that it knows") {
  for (const std::string program : {"", " --paper"}) {
    for (const std::string limit : {"1", "20", "512"}) {
      CAPTURE(program);
      CAPTURE(limit);
      const std::string page = page_of("builtin:gyroid:16 --trace-limit " + limit + program);
      const std::size_t events = array_of<std::uint8_t>(page, "event_routine").size();
      CHECK(std::to_string(events) == limit);
      const std::size_t vertices = array_of<float>(page, "points").size() / 3;
      REQUIRE(vertices > 0);
      for (const char* name : {"event_vertex", "event_caller", "zone", "added", "removed"}) {
        CAPTURE(name);
        for (const std::uint32_t v : array_of<std::uint32_t>(page, name)) {
          const bool is_known = v < vertices || v == kNoId;
          REQUIRE(is_known);
        }
      }
    }
  }
}

TEST_CASE("up is superior if the file tells it, and --up goes before that") {
  using enum AnatomicalSpace;
  Frame frame;
  CHECK(superior_of(frame) == Up{2, 1});
  // A sagittal scan whose second axis runs down, a little tilted.
  frame.axes = {Vec3{0, 1, 0}, Vec3{0.1, 0, -0.995}, Vec3{0.995, 0, 0.1}};
  CHECK(superior_of(frame) == Up{2, 1});
  for (const AnatomicalSpace space : {ras, lps}) {
    frame.space = space;
    CHECK(superior_of(frame) == Up{1, -1});
  }
  CHECK(has(element_of(page_of("builtin:torus:16"), "header"), "\"up\": [2, 1]"));
  const std::string page = page_of("builtin:torus:16 --up -x");
  CHECK(has(element_of(page, "header"), "\"up\": [0, -1]"));
}

TEST_CASE("a volume without a surface has no trace") {
  const TemporaryFolder folder;
  const std::string file = folder / "a.html";
  CHECK_THROWS_AS(run_trace(parsed("trace builtin:torus:16 --iso 1e9 -q -o " + file)), InputError);
  CHECK_FALSE(std::filesystem::exists(file));
}
