// SPDX-License-Identifier: MIT
// The info command: what a volume is, how its samples are distributed, what surface an isovalue
// has.
#include "app/info.h"
#include "app/output.h"
#include "app/run.h"

namespace deliso {

int run_info(const CommandLine& line) {
  const Input input = read_input(line);
  const Info info = find_info(input, line);
  if (!line.json.empty()) write_text(line.json, info_json(info));
  if (!line.quiet && line.json != "-") print(info_text(info));
  return kFine;
}

}  // namespace deliso
