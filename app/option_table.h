// SPDX-License-Identifier: MIT
// The one table of commands and options: for parsing, for suggestions to misspelt names, and for
// all texts about them (help, manual page, completions, the guide's tables).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "app/command_line.h"

namespace deliso {

// The commands of an option.
enum Commands : std::uint8_t {
  kMeshOnly = 1 << static_cast<int>(Command::mesh),
  kInfoOnly = 1 << static_cast<int>(Command::info),
  kCheckOnly = 1 << static_cast<int>(Command::check),
  kRenderOnly = 1 << static_cast<int>(Command::render),
  kViewOnly = 1 << static_cast<int>(Command::view),
  kTraceOnly = 1 << static_cast<int>(Command::trace),
  kJoinOnly = 1 << static_cast<int>(Command::join),
  kSolidOnly = 1 << static_cast<int>(Command::solid),
  kReports = kMeshOnly | kInfoOnly | kCheckOnly,
  kShown = kRenderOnly | kViewOnly,
  kSeen = kShown | kTraceOnly,
  kVolume = kReports | kSeen,
  kMeshAndCheck = kMeshOnly | kCheckOnly,
  kMeshAndTrace = kMeshOnly | kTraceOnly,
  kAllMeshing = kMeshAndCheck | kTraceOnly,
  kMeshAndJoin = kMeshOnly | kJoinOnly,
  kOutput = kMeshAndJoin | kSeen | kInfoOnly | kSolidOnly,
  kFormats = kMeshAndJoin | kSolidOnly,
  kPictures = kRenderOnly | kInfoOnly,
  kShownAndJoin = kShown | kJoinOnly,
  kReportsAndFiles = kReports | kJoinOnly | kSolidOnly,
  kThreaded = kAllMeshing | kJoinOnly | kSolidOnly,
  kAll = kVolume | kJoinOnly | kSolidOnly
};

struct CommandSpec {
  Command command;
  std::string_view name, synopsis, help;
};

struct OptionSpec {
  std::string_view name;
  char letter;  // of its short form; 0: none
  // The name of its value, in capitals, or all values: a|b. Empty for a switch.
  std::string_view argument;
  Commands commands;
  std::string_view help;
  // Throws InputError that names the option.
  void (*apply)(CommandLine& line, std::string_view name, std::string_view value);
  std::string_view other_help = {};  // for commands other than mesh, if it has less effect there
};

constexpr bool has_option(Command command, const OptionSpec& spec) {
  return (spec.commands & 1 << static_cast<int>(command)) != 0;
}
// Returns what the option means to the command.
std::string_view help_in(Command command, const OptionSpec& spec);

// The use of an option in a library, by its name.
enum class LibraryUse : std::uint8_t {
  always,
  of_files,  // it says how a file is read: without meaning for an array, nor its isovalue
  none       // about files that the program writes, and its texts
};
LibraryUse library_use(std::string_view name);

// An option, and what other programs call it.
struct OtherNames {
  std::string_view option, words;
};

// A heading of the help texts.
struct OptionGroup {
  std::string_view title;
  std::span<const OptionSpec> options;
};

std::span<const CommandSpec> command_table();
std::span<const OptionSpec> option_table();
std::span<const OtherNames> other_names();
std::vector<OptionGroup> option_groups();
const OptionSpec& option_named(std::string_view name);  // of the table
// The values of an argument that lists them, else none.
std::vector<std::string_view> choices_of(const OptionSpec& spec);

}  // namespace deliso
