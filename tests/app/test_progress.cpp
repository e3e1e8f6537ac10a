// SPDX-License-Identifier: MIT
// The bar's shares and lines for any calls, and the stages that a run reports.
#include "app/progress.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "app/parsed_line.h"
#include "app/published.h"
#include "base/random.h"
#include "deliso/mesh_isosurface.h"
#include "io/volume/builtin_volume.h"
#include "run/observer.h"

using namespace deliso;

namespace {

CommandLine command_line(const std::string& more = "") {
  return test::parsed("builtin:fuel:24 -o mesh.ply" + more);
}

// Tells each stage when it begins, and holds its steps to be more and more.
template <class Base>
struct Stages : Base {
  std::function<void(const std::string&)> begins;
  std::size_t steps = 0;
  explicit Stages(std::function<void(const std::string&)> tell) : begins(std::move(tell)) {}
  void stage_begins(const char* stage) override {
    begins(stage);
    steps = 0;
  }
  void steps_done(std::size_t done, std::size_t) override {
    CHECK(done > steps);
    steps = done;
  }
};

// Columns that a line takes: without what sets colors.
std::size_t width_of(std::string line) {
  for (const std::string_view color : {"\033[32m", "\033[0m"}) {
    const std::size_t at = line.find(color);
    if (at != std::string::npos) line.erase(at, color.size());
  }
  return line.size();
}

}  // namespace

TEST_CASE("the bar never goes back") {
  const std::vector<StageCost> stages = mesh_stages(command_line());
  REQUIRE(stages.size() > 5);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    ProgressModel model(stages);
    double last = 0;
    for (int n = 0; n < 200; ++n) {
      const std::size_t stage = random.below(static_cast<std::uint32_t>(stages.size() + 1));
      const double shares[] = {random.uniform(), random.uniform(-2, 3), kNan, 0, 1};
      const double at = model.at(stage < stages.size() ? stages[stage].stage : "no such stage",
                                 shares[random.below(5)]);
      REQUIRE(at >= last);
      REQUIRE(at <= 1);
      last = at;
    }
  }
}

TEST_CASE("the bar goes from 0 to 100 %, and is not there before the last stage ends") {
  for (const char* more : {"", " --paper", " --check", " --cap -q", " --stop-after stage1"}) {
    const std::vector<StageCost> stages = mesh_stages(command_line(more));
    ProgressModel model(stages);
    CHECK(model.at(stages.front().stage, 0) == 0);
    for (const StageCost& s : stages) {
      const double begin = model.at(s.stage, 0);
      CHECK(begin < 1);
      CHECK(model.at(s.stage, 1) > begin);
    }
    CHECK(model.at(stages.back().stage, 1) == doctest::Approx(1));
  }
}

TEST_CASE("the program knows every stage that a run reports") {
  const Volume volume = make_builtin_volume("builtin:fuel:24");
  for (const char* more : {"", " --cap", " --vertices 500", " --stop-after stage1", " --paper",
                           " --paper --facet-cycles", " --paper --stop-after stage1",
                           " --paper --certified", " --paper --certified --stop-after stage1"}) {
    CAPTURE(more);
    CommandLine line = command_line(more);
    std::string told, known;
    // With a desired count Refine runs several times.
    Stages<Observer> stages([&](const std::string& stage) {
      if (!told.ends_with(" " + stage)) told += " " + stage;
    });
    Stages<paper::Observer> published(stages.begins);
    Report report;
    if (line.paper) {
      paper::Report counts;
      mesh_as_published(volume, 0.3, line, published, counts, report);
    } else {
      line.options.observer = &stages;
      mesh_isosurface(volume, 0.3, line.options, report);
    }
    for (const StageCost& s : mesh_stages(line)) {
      if (s.stage != "reading" && s.stage != "weld" && s.stage != "seams" && s.stage != "check" &&
          s.stage != "writing") {
        known += " " + std::string(s.stage);
      }
    }
    CHECK(told == known);
  }
}

TEST_CASE("in blocks the bar runs from reading to the seams") {
  CommandLine line = command_line(" --cap --block-side 8 --threads 2");
  struct Shares : Observer {
    ProgressModel model;
    std::vector<std::string> order;
    std::vector<double> reached;
    explicit Shares(const CommandLine& of) : model(mesh_stages(of)) {}
    void stage_begins(const char* stage) override {
      if (order.empty() || order.back() != stage) order.emplace_back(stage);
      reached.push_back(model.at(stage, 0));
    }
    void steps_done(std::size_t done, std::size_t left) override {
      const auto steps = static_cast<double>(done);
      reached.push_back(model.at(order.back(), steps / (steps + static_cast<double>(left))));
    }
  } stages(line);
  line.options.observer = &stages;
  Report report;
  mesh_isosurface(make_builtin_volume("builtin:fuel:24"), 0.3, line.options, report);
  CHECK(stages.order == std::vector<std::string>{"blocks", "weld", "seams", "cap"});
  CHECK(stages.reached.size() > 4 + 27);
  CHECK(std::ranges::is_sorted(stages.reached));
  CHECK(stages.reached[0] < 0.05);
  CHECK(stages.reached[27] > 0.7);
}

TEST_CASE("no line is as wide as the terminal") {
  for (int columns = 0; columns <= 120; ++columns) {
    CAPTURE(columns);
    for (const double seconds : {0.0, 7.9, 65.0, 3723.0, 1e6}) {
      for (const double share : {0.0, 0.5, 1.0}) {
        const std::string line = progress_line("coarsen", share, seconds, columns, true);
        CHECK(width_of(line) <= static_cast<std::size_t>(std::max(0, columns - 1)));
        CHECK(progress_line("coarsen", share, seconds, columns, false).find('\033') ==
              std::string::npos);
      }
    }
  }
}

TEST_CASE("what a line says") {
  CHECK(progress_line("coarsen", 0.42, 4.9, 80, false) ==
        "[############..................]  42 %  coarsen  0:04");
  CHECK(progress_line("coarsen", 0.42, 4.9, 36, false) == "[#####.......]  42 %  coarsen  0:04");
  CHECK(progress_line("coarsen", 0.42, 4.9, 28, false) == " 42 %  coarsen  0:04");
  CHECK(progress_line("coarsen", 0.25, 30, 80, false) ==
        "[#######.......................]  25 %  coarsen  0:30, 1:30 left");
  CHECK(progress_line("coarsen", 0.04, 30, 80, false).find("left") == std::string::npos);
  CHECK(progress_line("writing", 1, 30, 80, false).find("left") == std::string::npos);
  CHECK(progress_line("coarsen", 0.42, 7.9, 10, false) == " 42 %  co");
  CHECK(progress_line("refine", 0.999, 3723, 80, false).find(" 99 %  refine   1:02:03") !=
        std::string::npos);
  CHECK(progress_line("writing", 1, 0, 80, true).find("\033[32m##############################") !=
        std::string::npos);
}
