// SPDX-License-Identifier: MIT
// The program: one line on standard error for every failure, and the exit status.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "app/command_line.h"
#include "app/input.h"
#include "app/output.h"
#include "app/run.h"
#include "app/signals.h"
#include "base/check.h"
#include "base/memory.h"
#include "base/version.h"

namespace {

using namespace deliso;

int run(std::span<const std::string_view> arguments) {
  CommandLine line = parse_command_line(arguments);
  find_segments(line);
  switch (line.command) {
    case Command::help:
      print(help_text(line.help_of));
      return kExitSuccess;
    case Command::version:
      print("deliso " + std::string(kVersion) + "\n");
      return kExitSuccess;
    case Command::info:
      return run_info(line);
    case Command::render:
      return run_render(line);
    case Command::view:
      return run_view(line);
    case Command::trace:
      return run_trace(line);
    case Command::check:
      return run_check(line);
    case Command::join:
      return run_join(line);
    case Command::solid:
      return run_solid(line);
    case Command::mesh:
      break;
  }
  return run_mesh(line);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string_view> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  handle_signals();
  keep_freed_memory();
  try {
    return run(arguments);
  } catch (const std::bad_alloc&) {
    std::fputs("deliso: out of memory\n", stderr);
  } catch (const InternalError& error) {
    std::fprintf(stderr, "deliso: %s\n", error.what());
    std::abort();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "deliso: %s\n", one_line(error.what()).c_str());
  }
  return kBadUsage;
}
