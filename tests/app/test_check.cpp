// SPDX-License-Identifier: MIT
// --check and the check command are one: the same faults, as many of each, and the same exit
// status.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "app/parsed_line.h"
#include "app/run.h"
#include "io/files/json_value.h"
#include "io/files/temporary_folder.h"

using namespace deliso;
using namespace deliso::test;

namespace {

struct CheckOutcome {
  int status = 0;
  std::vector<std::string> kinds;
  std::vector<double> counts;
};

CheckOutcome outcome_of(const TemporaryFolder& folder, const std::string& arguments) {
  const std::string file = folder / "report.json";
  const CommandLine line = parsed(arguments + " --quiet --json " + file);
  CheckOutcome outcome;
  outcome.status = line.command == Command::check ? run_check(line) : run_mesh(line);
  const JsonValue report = parse_json(file_bytes(file), file);
  const JsonValue& faults = report["check"]["faults"];
  outcome.kinds = faults.keys;
  for (const JsonValue& fault : faults.items) outcome.counts.push_back(fault["count"].number);
  return outcome;
}

}  // namespace

TEST_CASE("--check finds the faults that the check command finds in the file") {
  const TemporaryFolder folder;
  const std::string file = folder / "mesh.ply";
  int with_fault = 0;
  struct Case {
    std::string volume, options, of_check;  // `of_check`: what the file does not say
  };
  for (const Case& c : {Case{"builtin:fuel:20", "", ""},
                        {"builtin:gyroid:16", " --cap", " --cap"},
                        {"builtin:five_spheres:24", " --largest 2", " --largest 2"},
                        {"builtin:torus:16", " --paper", ""},
                        // Of so few triangles most are over a limit.
                        {"builtin:marschner_lobb:32", " --vertices 60", ""}}) {
    CAPTURE(c.volume);
    const CheckOutcome made = outcome_of(folder, c.volume + c.options + " --check -o " + file);
    const CheckOutcome checked = outcome_of(folder, "check " + file + " " + c.volume + c.of_check);
    CHECK(made.status == checked.status);
    CHECK(made.kinds == checked.kinds);
    CHECK(made.counts == checked.counts);
    CHECK(made.kinds.empty() == (made.status == 0));
    with_fault += made.status != 0;
  }
  CHECK(with_fault == 1);
}
