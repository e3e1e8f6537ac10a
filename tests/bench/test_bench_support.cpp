// SPDX-License-Identifier: MIT
// What the benchmark programs print and draw is as right as what they measure: the list of data
// sets against the paper's own arithmetic, tables, statistics, checksums, axes.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "base/check.h"
#include "base/random.h"
#include "io/files/temporary_folder.h"
#include "refusal.h"
#include "support/datasets.h"
#include "support/insertion_cost.h"
#include "support/line_chart.h"
#include "support/runs.h"
#include "support/sha256.h"
#include "support/single_stage.h"
#include "support/statistics.h"
#include "support/table.h"

using namespace deliso;
using deliso::test::TemporaryFolder;

namespace {

const std::string kManifest = DELISO_DATASETS;

std::string sha256_of(const std::string& text) {
  return sha256(std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace

TEST_CASE("the list of data sets agrees with what the paper says of its own figures") {
  const auto datasets = read_datasets(kManifest);
  REQUIRE(datasets.size() == 11);  // rows of Table 1
  std::set<std::string> names;
  for (const Dataset& d : datasets) {
    CAPTURE(d.name);
    CHECK(names.insert(d.name).second);
    const PaperFigures& p = d.paper;
    // Table 2's third column is the ratio of the first two, rounded.
    CHECK(std::fabs(p.seconds_3d / p.seconds_deliso - p.speedup) <= 0.0101);
    // "approximately two orders of magnitude"
    CHECK(p.t_recover / p.t_refine > 50);
    CHECK(p.t_recover / p.t_refine < 200);
    // "on average we only do one per search, but ... where we find ... more"
    CHECK(std::fabs(p.cpi_recover - 1) < 0.3);
    CHECK(p.cpi_hit_recover > p.cpi_recover);
    CHECK(p.cpi_hit_refine > p.cpi_refine);
    CHECK((d.sha256 == "-" || d.sha256.size() == 64));
    CHECK((d.lines == 50 || d.lines == 500 || d.lines == 5000));  // D3
    const OpenedDataset analogue = open_dataset(d, "");
    CHECK(analogue.is_analogue);
    CHECK(analogue.lines == 50);
  }
}

TEST_CASE("a damaged list is refused with its line") {
  const TemporaryFolder folder;
  const std::string path = folder / "list.tsv";
  std::ifstream in(kManifest);
  std::string all((std::istreambuf_iterator<char>(in)), {});
  const auto refused = [&](const std::string& text, const std::string& words) {
    std::ofstream(path) << text;
    return test::refusal_by([&] { read_datasets(path); }).find(words) != std::string::npos;
  };
  CHECK(refused("", "lists no data set"));
  CHECK(refused("name\tfile\n", "line 1: not the header"));
  std::string broken = all;
  broken.replace(broken.find("17.73"), 5, "17,73");
  CHECK(refused(broken, "'17,73' is not a number"));
  broken = all;
  broken.erase(broken.find("\t17.73"), 6);
  CHECK(refused(broken, "another number of fields"));
}

TEST_CASE("a volume that is there is taken, and what is not as in the paper is said") {
  const TemporaryFolder folder;
  Dataset d = read_datasets(kManifest).front();
  std::ofstream(folder / d.file) << "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 3 4\n"
                                    "encoding: ascii\n\n"
                                    "0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 "
                                    "22 23\n";
  const std::string directory = folder.path().string();
  OpenedDataset opened = open_dataset(d, directory);
  CHECK_FALSE(opened.is_analogue);
  CHECK(opened.data == "2x3x4?");
  CHECK(opened.remarks.size() == 2);
  CHECK(opened.isovalue == d.isovalue);
  CHECK(opened.lines == d.lines);
  d.dims = {2, 3, 4};
  d.lines = 500;
  d.sha256 = sha256_of_samples(opened.volume);
  opened = open_dataset(d, directory);
  CHECK(opened.data == "paper's");
  CHECK(opened.lines == 500);
  CHECK(opened.remarks.empty());

  // The folder is not told to the world.
  d.file = "absent.nhdr";
  opened = open_dataset(d, directory);
  CHECK(opened.is_analogue);
  REQUIRE(opened.remarks.size() == 1);
  CHECK(opened.remarks[0].find(directory) == std::string::npos);
  CHECK(opened.remarks[0].find("absent.nhdr") != std::string::npos);
}

TEST_CASE("SHA-256 of FIPS 180-4's examples, and across the padding's edges") {
  CHECK(sha256_of("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256_of("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(sha256_of(std::string(1'000'000, 'a')) ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  std::set<std::string> sums;
  for (std::size_t n = 50; n < 140; ++n) CHECK(sums.insert(sha256_of(std::string(n, 'x'))).second);
}

TEST_CASE("median and spread") {
  CHECK(statistic({}).count == 0);
  CHECK(statistic({3}).median == 3);
  CHECK(statistic({3}).spread == 0);
  CHECK(statistic({5, 1, 3}).median == 3);
  CHECK(statistic({4, 1, 3, 2}).median == 2.5);
  CHECK(statistic({9, 8, 10}).spread == doctest::Approx(2. / 9));
}

TEST_CASE("tables in their three forms") {
  Table table("Title", {"name", "n"}, 1);
  table.add({"a, \"b\"", count_cell(12345)});
  table.add({"c", ratio_cell(1, 0)});
  table.remark("A remark.");
  CHECK(table.print(TableFormat::text) ==
        "Title\n\nname         n\na, \"b\"  12,345\nc            -\n\n  A remark.\n\n");
  CHECK(table.print(TableFormat::markdown) ==
        "**Title**\n\n| name   |      n |\n| ------ | -----: |\n| a, \"b\" | 12,345 |\n"
        "| c      |      - |\n\n- A remark.\n\n");
  CHECK(table.print(TableFormat::csv) == "name,n\n\"a, \"\"b\"\"\",12345\nc,-\n");

  CHECK(count_cell(0) == "0");
  CHECK(count_cell(999) == "999");
  CHECK(count_cell(1000) == "1,000");
  CHECK(count_cell(1234567) == "1,234,567");
  CHECK(fixed_cell(NAN, 2) == "-");
  CHECK(scientific_cell(0.00154) == "1.54e-03");
  CHECK(percent_cell(0.042) == "4.2%");
  CHECK(percent_cell(0.5) == "50%");
  CHECK(ratio_cell(3, 2) == "1.50");
  CHECK(ratio_cell(25, 2) == "12.5");
  CHECK(ratio_cell(1000, 8) == "125");
}

TEST_CASE("ticks are few, round, in order and within the axis") {
  CHECK(axis_ticks(0, 10, false) == std::vector<double>{0, 2, 4, 6, 8, 10});
  CHECK(axis_ticks(1, 1000, true) == std::vector<double>{1, 10, 100, 1000});
  CHECK(axis_ticks(1, 20, true) == std::vector<double>{1, 2, 5, 10, 20});
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const double lo = std::exp(random.uniform(-12, 12));
    const double hi = lo * std::exp(random.uniform(0.5, 12));
    for (const bool logarithmic : {false, true}) {
      const std::vector<double> ticks = axis_ticks(lo, hi, logarithmic);
      // A logarithmic axis of less than half a decade may hold only one of 1, 2, 5.
      CHECK(ticks.size() >= (logarithmic ? 0u : 2u));
      CHECK(ticks.size() <= 14);
      for (std::size_t n = 0; n < ticks.size(); ++n) {
        CHECK(ticks[n] >= lo * (1 - 1e-12));
        CHECK(ticks[n] <= hi * (1 + 1e-12));
        if (n > 0) CHECK(ticks[n] > ticks[n - 1]);
      }
    }
  }
}

TEST_CASE("a chart draws every point inside its frame and leaves out what it cannot") {
  LineChart chart{"a < b & c", {"x", true}, {"y"}, {{"s", {{1, 1}, {10, 4}, {100, 2}, {0, 1}}}}};
  chart.series.push_back({"empty", {{NAN, 1}}});
  const std::string svg = chart.svg();
  CHECK(svg == chart.svg());
  CHECK(svg.find("a &lt; b &amp; c") != std::string::npos);
  CHECK(svg.find(">empty<") == std::string::npos);
  std::size_t circles = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos;
       at = svg.find("<circle", at + 1)) {
    ++circles;
    double x = 0, y = 0;
    REQUIRE(std::sscanf(svg.c_str() + at, "<circle cx=\"%lf\" cy=\"%lf\"", &x, &y) == 2);
    CHECK((x > 78 && x < 582 && y > 46 && y < 384));
  }
  CHECK(circles == 3);
  CHECK(svg.ends_with("</svg>\n"));
}

TEST_CASE("an axis with ticks of its own shows these, those within, and no others") {
  LineChart chart{"t", {"x", true, {{1, "one"}, {4, "<four>"}, {500, "beyond"}}}, {"y"}, {}};
  chart.series.push_back({"s", {{1, 1}, {4, 4}, {10, 2}}});
  const std::string svg = chart.svg();
  CHECK(svg.find(">one<") != std::string::npos);
  CHECK(svg.find(">&lt;four><") != std::string::npos);
  CHECK(svg.find("beyond") == std::string::npos);
  CHECK(svg.find(">10<") == std::string::npos);  // a round number that y does not reach
}

TEST_CASE("single stage: the same criteria on Del S") {
  const OpenedDataset opened = open_builtin("builtin:torus:24");
  const paper::Options options = published_options(opened);
  const PublishedRuns two = run_once(opened, options);
  const PublishedRuns one = run_once(opened, options, single_stage_deliso);
  CHECK(one.last().insertions_recover == two.last().insertions_recover);
  CHECK(one.last().insertions_refine > 1000);
  CHECK(one.last().searches_refine.searches == 0);
  CHECK(static_cast<double>(one.mesh.points.size()) ==
        doctest::Approx(static_cast<double>(two.mesh.points.size())).epsilon(0.1));
}

TEST_CASE("a search by pairs looks at every voxel that is active, and at some that are not") {
  const OpenedDataset opened = open_builtin("builtin:torus:24");
  const paper::Report report = run_once(opened, published_options(opened)).last();
  const SearchCounters& by_voxels = report.searches_recover;
  const InsertionCosts costs = measure_insertions(opened, published_options(opened));
  CHECK(costs.by_pairs.searches == by_voxels.searches);
  CHECK(costs.by_pairs.searches_with_hit == by_voxels.searches_with_hit);
  CHECK(costs.by_pairs.computations > 1.1 * static_cast<double>(by_voxels.computations));
  CHECK(costs.by_pairs.computations < 2.0 * static_cast<double>(by_voxels.computations));
  CHECK(costs.recover.insertion_seconds > 0);
  CHECK(costs.recover.search_seconds > 0);
}
