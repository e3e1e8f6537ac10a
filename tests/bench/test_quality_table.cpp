// SPDX-License-Identifier: MIT
// What `make quality` tells of two builds is right: marks where ranges part and nowhere else, files
// of runs, a child's status and CPU time.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

#include "base/check.h"
#include "io/files/temporary_folder.h"
#include "refusal.h"
#include "support/quality_table.h"
#include "support/run_program.h"

using namespace deliso;
using deliso::test::TemporaryFolder;
using deliso::test::write_bytes;

namespace {

QualityRun run_of(const std::string& build, const std::string& volume, std::uint64_t turn,
                  double vertices) {
  QualityRun run{build, volume, "", turn, {}};
  run.measured[Metric::vertices] = vertices;
  run.measured[Metric::min_angle] = vertices / 10;
  run.measured[Metric::exact] = turn == 1 ? 1 : 0;
  return run;
}

bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("builds differ where the ranges of their runs do not overlap") {
  const std::vector<double> low{1, 3, 2}, middle{3, 5, 4}, high{6, 7};
  CHECK(compare(low, high, Better::less) == Verdict::better);
  CHECK(compare(low, high, Better::more) == Verdict::worse);
  CHECK(compare(high, low, Better::less) == Verdict::worse);
  CHECK(compare(high, low, Better::more) == Verdict::better);
  CHECK(compare(low, middle, Better::less) == Verdict::alike);  // both have a 3
  CHECK(compare(low, {}, Better::less) == Verdict::alike);
  CHECK(compare({NAN, 1}, {2, NAN}, Better::less) == Verdict::better);
  CHECK(compare({NAN}, {2}, Better::less) == Verdict::alike);
}

TEST_CASE("tables have medians, ranges, marks and their sums") {
  std::vector<QualityRun> runs;
  for (const std::uint64_t turn : {1, 2, 3}) {
    const auto n = static_cast<double>(turn);
    runs.push_back(run_of("new", "A", turn, 1000 * n));
    runs.push_back(run_of("old", "A", turn, 4000 * n));
    runs.push_back(run_of("new", "B", turn, 1000 * n));
    runs.push_back(run_of("old", "B", turn, 2000 * n));
    runs.push_back(run_of("old", "C", turn, 1));  // of no use without the other
  }
  const std::vector<Table> tables = quality_tables(runs);
  REQUIRE(tables.size() == 3);
  const std::string first = tables[0].print(TableFormat::text);
  CHECK(has(first, "2,000 (1,000-3,000) +"));         // vertices of A: fewer are better
  CHECK(has(first, "200.0 (100.0-300.0) !"));         // its angle: less is worse
  CHECK(has(first, "8,000 (4,000-12,000)"));          // the other build
  CHECK_FALSE(has(first, "8,000 (4,000-12,000) +"));  // has no marks
  CHECK(has(first, "2,000 (1,000-3,000)  "));         // B: 1,000-3,000 beside 2,000-6,000
  CHECK_FALSE(has(first, "\nC "));
  CHECK(has(tables[1].print(TableFormat::text), "1 of 3"));  // topologies
  // Of two volumes one is better; medians are as 1 to 4 and 1 to 2.
  CHECK(has(tables[2].print(TableFormat::csv), "vertices,1,0,2,0.354\n"));
  CHECK(has(tables[2].print(TableFormat::csv), "angle,0,1,2,0.354\n"));
}

TEST_CASE("a switch pays where runs without it are worse on three volumes") {
  std::vector<QualityRun> runs;
  const auto add = [&](const std::string& build, const std::string& volume, double vertices,
                       double far, bool is_sound) {
    for (const std::uint64_t turn : {0, 1, 2}) {
      QualityRun run{build, volume, "", turn, {}};
      run.measured[Metric::vertices] = vertices + static_cast<double>(turn);
      run.measured[Metric::points_far] = far;
      run.measured[Metric::crossings] = run.measured[Metric::other_faults] = 0;
      run.measured[Metric::failed] = 0;
      run.measured[Metric::exact] = is_sound || turn == 0 ? 1 : 0;
      runs.push_back(run);
    }
  };
  for (const std::string volume : {"A", "B", "C"}) add("base.tsv", volume, 1000, 2, true);
  for (const std::string volume : {"A", "B", "C"}) add("no-moves.tsv", volume, 2001, 2, true);
  add("no-flips.tsv", "A", 2001, 1, true);
  add("no-flips.tsv", "B", 2001, 3, false);
  add("no-flips.tsv", "C", 1002, 2, true);  // 1,002 to 1,004 beside 1,000 to 1,002
  const std::string table = switch_table(runs).print(TableFormat::csv);
  CHECK(has(table, "(none),1.000,-,-,-,6,-,-,-,0,\n"));
  CHECK(has(table, "no-moves,2.000 !3,-,-,-,6,-,-,-,0,yes\n"));
  // On two volumes it is worse. Of three runs with faults two are in one volume.
  CHECK(has(table, "no-flips,1.588 !2,-,-,-,6 +1 !1,-,-,-,2,no\n"));
}

TEST_CASE("runs are read back as they were written") {
  const TemporaryFolder folder;
  const std::string path = folder / "kept.tsv";
  QualityRun run = run_of("deliso", "A", 7, 0.1);
  run.options = "--paper --lambda 3";
  write_bytes(path, header_of_runs() + line_of(run));
  const std::vector<QualityRun> read = read_runs(path);
  REQUIRE(read.size() == 1);
  CHECK(read[0].build == "kept.tsv");
  CHECK(read[0].volume == "A");
  CHECK(read[0].options == run.options);
  CHECK(read[0].turn == 7);
  CHECK(read[0].measured[Metric::vertices] == 0.1);
  CHECK(std::isnan(read[0].measured[Metric::crossings]));
  run.build = "other";
  std::ofstream(path, std::ios::app) << line_of(run);
  REQUIRE(read_runs(path).size() == 2);
  CHECK(read_runs(path)[1].build == "kept.tsv:other");

  // Columns of later days are passed over, those of earlier ones are absent.
  write_bytes(path, "build\tvolume\toptions\tturn\tvertices\tbeauty\nx\tA\t\t1\t12\t-\n");
  CHECK(read_runs(path)[0].measured[Metric::vertices] == 12);
  const auto refused = [&](const std::string& bytes, const std::string& words) {
    write_bytes(path, bytes);
    return has(test::refusal_by([&] { read_runs(path); }), words);
  };
  CHECK(refused("", "is no file of runs"));
  CHECK(refused("build\tvolume\tturn\n", "is no file of runs"));
  CHECK(refused(header_of_runs(), "has no runs"));
  CHECK(refused("build\tvolume\toptions\tturn\nx\tA\t\n", "line 2: has another number of fields"));
  CHECK(refused("build\tvolume\toptions\tturn\nx\tA\t\tz\n", "line 2: 'z' is not a number"));
}

TEST_CASE("a program's own word is read from its report") {
  const std::string json = "{\n  \"counters\": {\n    \"points_far\": 12,\n    \"last\": 7\n  }\n}";
  CHECK(reported(json, "points_far") == 12);
  CHECK(reported(json, "last") == 7);
  CHECK(std::isnan(reported(json, "far")));
  CHECK(std::isnan(reported(json, "counters")));
}

TEST_CASE("a child's status and CPU time are told") {
  const auto shell = [](const std::string& script, unsigned limit = 60) {
    return run_program({"/bin/sh", "-c", script}, limit);
  };
  CHECK(shell("exit 0").status == 0);
  CHECK(shell("exit 3").status == 3);
  CHECK(shell("kill -9 $$").status == 128 + 9);
  CHECK(shell("sleep 0.3").cpu_seconds < 0.2);
  const Ended endless = shell("while :; do :; done", 1);
  CHECK(endless.status > 128);
  CHECK(endless.cpu_seconds > 0.3);
  CHECK_THROWS_AS(run_program({"/nowhere/deliso"}, 1), InputError);
}
