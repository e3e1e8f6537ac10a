// SPDX-License-Identifier: MIT
// The one table of options, for parsing, for suggestions to misspelt names and for help texts.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "app/command_line.h"

namespace deliso {

// The commands of an option.
enum Commands : std::uint8_t {
  kMeshOnly = 1,
  kInfoOnly = 2,
  kRenderOnly = 4,
  kCheckOnly = 8,
  kJoinOnly = 16,
  kViewOnly = 32,
  kTraceOnly = 64,
  kReports = kMeshOnly | kInfoOnly | kCheckOnly,
  kShown = kRenderOnly | kViewOnly,
  kSeen = kShown | kTraceOnly,
  kVolume = kReports | kSeen,
  kMeshAndCheck = kMeshOnly | kCheckOnly,
  kMeshAndTrace = kMeshOnly | kTraceOnly,
  kAllMeshing = kMeshAndCheck | kTraceOnly,
  kMeshAndJoin = kMeshOnly | kJoinOnly,
  kOutput = kMeshAndJoin | kSeen,
  kShownAndJoin = kShown | kJoinOnly,
  kReportsAndJoin = kReports | kJoinOnly,
  kMeshingAndJoin = kAllMeshing | kJoinOnly,
  kAll = kVolume | kJoinOnly
};

constexpr Commands flag_of(Command command) {
  return command == Command::info     ? kInfoOnly
         : command == Command::render ? kRenderOnly
         : command == Command::check  ? kCheckOnly
         : command == Command::join   ? kJoinOnly
         : command == Command::view   ? kViewOnly
         : command == Command::trace  ? kTraceOnly
                                      : kMeshOnly;
}

struct OptionSpec {
  std::string_view name;
  char letter;                // of its short form; 0: none
  std::string_view argument;  // the name of its value; empty for a switch
  Commands commands;
  std::string_view help;
  // Throws InputError that names the option.
  void (*apply)(CommandLine& line, std::string_view name, std::string_view value);
  std::string_view other_help = {};  // for commands other than mesh, if it has less effect there
};

// A heading of the help texts.
struct OptionGroup {
  std::string_view title;
  std::string_view first;  // name of its first option
};

std::span<const OptionSpec> option_table();
std::span<const OptionGroup> option_groups();

}  // namespace deliso
