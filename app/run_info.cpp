// SPDX-License-Identifier: MIT
// The info command: a volume's properties, the distribution of its samples, and the surface at an
// isovalue.
#include "app/info.h"
#include "app/output.h"
#include "app/run.h"

namespace deliso {

int run_info(const CommandLine& line) {
  ProgressBar progress(info_stages(line), !line.quiet);
  progress.show("reading", 0);
  const Input input = read_input(line);
  progress.clear();
  print_warning(input.warning, line);
  const Info info = find_info(input, line, progress);
  progress.clear();
  if (!line.json.empty()) write_text(line.json, info_json(info));
  if (!line.quiet && line.json != "-") print(info_text(info));
  return kExitSuccess;
}

}  // namespace deliso
