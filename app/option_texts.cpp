// SPDX-License-Identifier: MIT
#include "app/option_texts.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "app/option_table.h"
#include "base/text.h"
#include "base/version.h"
#include "io/files/text_scan.h"
#include "io/volume/builtin_fields.h"

namespace deliso {
namespace {

// Returns `words` with a backslash in front of each of these characters.
std::string escaped(std::string_view words, std::string_view characters) {
  std::string result;
  for (const char c : words) {
    if (characters.find(c) != characters.npos) result += '\\';
    result += c;
  }
  return result;
}

// Returns the names of the commands for which `is_listed` is true.
template <class IsListed>
std::string commands(IsListed is_listed, std::string_view between) {
  std::vector<std::string_view> names;
  for (const CommandSpec& command : command_table()) {
    if (is_listed(command.command)) names.push_back(command.name);
  }
  return joined(names, between);
}

std::string commands_of(const OptionSpec& spec) {
  const std::string without = commands(
      [&](Command command) { return command < Command::help && !has_option(command, spec); }, ", ");
  if (without.empty()) return "all";
  if (without.find(',') == without.npos) return text("all but ", without);
  return commands([&](Command command) { return has_option(command, spec); }, ", ");
}

// Returns what the option means to all of its commands: "this; with check: that".
std::string meanings(const OptionSpec& spec) {
  const auto differs = [&](Command command) {
    return has_option(command, spec) && help_in(command, spec) != spec.help;
  };
  const std::string others = commands(differs, ", ");
  return text(spec.help, others.empty() ? "" : text(". With ", others, ": ", spec.other_help));
}

std::string all_commands() {
  return commands([](Command) { return true; }, " ");
}

std::string short_form(const OptionSpec& spec) {
  return spec.letter == 0 ? "" : std::string{'-', spec.letter};
}

bool is_file(const OptionSpec& spec) {
  return spec.argument == "FILE" || spec.argument == "INPUT";
}

// For roff, where - is a hyphen and \- the minus of a command line.
std::string roff(std::string_view words) {
  return escaped(words, "-");
}

// Options are put in backticks.
std::string markdown(std::string_view words) {
  std::string result;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t begin = std::min(words.find("--", at), words.size());
    const std::size_t end = std::min(
        words.find_first_not_of("-abcdefghijklmnopqrstuvwxyz0123456789", begin), words.size());
    result += words.substr(at, begin - at);
    if (begin < end) result += text("`", words.substr(begin, end - begin), "`");
    at = end;
  }
  return result;
}

}  // namespace

std::string man_page() {
  std::string synopsis, commands, options, fields;
  for (const CommandSpec& command : command_table()) {
    synopsis += text(".B deliso\n", roff(command.synopsis), "\n.br\n");
    commands += text(".TP\n.B ", command.name, "\n", roff(command.help), "\n");
  }
  for (const OptionGroup& group : option_groups()) {
    options += text(".SS ", group.title, "\n");
    for (const OptionSpec& spec : group.options) {
      options += text(".TP\n\\fB", roff(spec.name), spec.argument.empty() ? "\\fI" : "\\fR \\fI",
                      joined(split(roff(spec.argument), '|'), "|\\:"), "\\fR",
                      spec.letter == 0 ? "" : ", \\fB\\", short_form(spec), "\\fR\n",
                      roff(meanings(spec)), " [", commands_of(spec), "]\n");
    }
  }
  for (const BuiltinField& field : builtin_fields()) {
    fields += text(".TP\n.B builtin:", field.name, "\n", roff(field.description), "\n");
  }
  // In the place of a date, which would differ from one build to the next.
  return text(R"(.TH DELISO 1 "version )", kVersion, "\" \"DelIso\" \"User Commands\"\n",
              ".SH NAME\ndeliso \\- Delaunay meshes of isosurfaces of volume data\n",
              ".SH SYNOPSIS\n", synopsis, ".SH DESCRIPTION\n", roff(kPurpose), "\n.PP\n",
              roff(kVolumeFiles), "\n.PP\n", roff(kMeshFiles), "\n.SH COMMANDS\n", commands,
              ".SH OPTIONS\nIn brackets are the commands of an option.\n", options,
              ".SH BUILT\\-IN FIELDS\nEach has an isovalue of its own as default.\n", fields,
              ".SH EXAMPLES\n.nf\n", roff(kExamples), ".fi\n.SH EXIT STATUS\n", kExitStatus, "\n");
}

std::string bash_completion() {
  std::string values, options;
  for (const OptionSpec& spec : option_table()) {
    if (spec.argument.empty()) continue;
    const std::string kind =
        is_file(spec) ? "-f" : text("-W '", joined(choices_of(spec), " "), "'");
    values += text("    ", spec.name, spec.letter == 0 ? "" : "|", short_form(spec), ") choose ",
                   kind, "; return ;;\n");
  }
  for (const CommandSpec& command : command_table()) {
    options += text("    ", command.name, ") options='");
    for (const OptionSpec& spec : option_table()) {
      if (has_option(command.command, spec)) options += text(spec.name, " ");
    }
    options += "' ;;\n";
  }
  return text(R"(# Completion for bash, which "deliso help bash" has written.
_deliso() {
  local word=$2 before=$3 command=${COMP_WORDS[1]} options commands=')",
              all_commands(), R"('
  choose() { mapfile -t COMPREPLY < <(compgen "$@" -- "$word"); }
  [[ $word == = ]] && word=
  [[ $before == = ]] && before=${COMP_WORDS[COMP_CWORD-2]}
  case $before in
)",
              values, R"(  esac
  [[ " $commands " == *" $command "* ]] || command=mesh
  case $command in
)",
              options, R"(  esac
  if [[ $word == -* ]]; then
    choose -W "$options"
  elif [[ $COMP_CWORD == 1 ]]; then
    choose -f -W "$commands"
  elif [[ $command == help ]]; then
    choose -W "$commands"
  else
    choose -f
  fi
}
complete -o filenames -F _deliso deliso
)");
}

std::string zsh_completion() {
  const auto quoted = [](std::string_view words) {
    std::string result;
    for (const char c : words) result += c == '\'' ? "'\\''" : std::string(1, c);
    return escaped(result, "[]:");
  };
  std::string commands, options;
  for (const CommandSpec& command : command_table()) {
    commands += text("    '", command.name, ":",
                     quoted(command.help.substr(0, command.help.find('.'))), "'\n");
    options += text("  (", command.name, ") options=(\n");
    for (const OptionSpec& spec : option_table()) {
      if (!has_option(command.command, spec)) continue;
      const std::vector<std::string_view> choices = choices_of(spec);
      const std::string kind = is_file(spec)     ? "_files"
                               : choices.empty() ? " "
                                                 : text("(", joined(choices, " "), ")");
      const std::string rest =
          text("[", quoted(help_in(command.command, spec)),
               spec.argument.empty() ? "]" : text("]:", quoted(spec.argument), ":", kind), "'\n");
      options += text("    '", spec.name, spec.argument.empty() ? "" : "=", rest);
      if (spec.letter != 0) options += text("    '", short_form(spec), rest);
    }
    options += "  ) ;;\n";
  }
  return text(
      "#compdef deliso\n# Completion for zsh, which \"deliso help zsh\" has written.\n"
      "local command=$words[2]\nlocal -a commands=(\n",
      commands,
      ") options\n"
      "(( $commands[(I)$command:*] )) || command=mesh\ncase $command in\n",
      options, R"(esac
if (( CURRENT == 2 )) && [[ $words[2] != -* ]]; then
  _describe command commands
  _files
elif [[ $command == help ]]; then
  _describe command commands
else
  _arguments -S $options '*:file:_files'
fi
)");
}

std::string markdown_page() {
  std::string page =
      "# The options\n\nAll of them, with the commands that take them. `make options` writes this "
      "page "
      "from `deliso help markdown`.\n[The command line](command-line.md) says what a table "
      "cannot.\n";
  for (const OptionGroup& group : option_groups()) {
    page += text("\n| ", group.title, " | | commands |\n| --- | --- | --- |\n");
    for (const OptionSpec& spec : group.options) {
      page += text("| `", spec.name, spec.argument.empty() ? "" : " ", escaped(spec.argument, "|"),
                   spec.letter == 0 ? "" : "`, `", short_form(spec), "` | ",
                   markdown(meanings(spec)), " | ", commands_of(spec), " |\n");
    }
  }
  return page;
}

std::string python_options() {
  std::string module = R"(# SPDX-License-Identifier: MIT
"""The options of the functions, for editors and help(), which \"deliso help python\" has written."""

from typing import Literal, Sequence, TypedDict, Union

Value = Union[str, float, Sequence[float]]

)";
  std::string of_files;
  // Parameters of their own.
  constexpr std::string_view kParameters[] = {"--iso", "--volume", "--spacing", "--origin",
                                              "--space"};
  for (const CommandSpec& command : command_table()) {
    constexpr Command kOfLibrary[] = {Command::mesh,   Command::info, Command::check,
                                      Command::render, Command::join, Command::solid};
    if (std::ranges::find(kOfLibrary, command.command) == std::end(kOfLibrary)) continue;
    const bool draws = command.command == Command::render;
    std::string name(command.name);
    name[0] = static_cast<char>(name[0] - 'a' + 'A');
    module += text("\nclass ", name, "Options(TypedDict, total=False):\n");
    for (const OptionSpec& spec : option_table()) {
      const LibraryUse use = library_use(spec.name);
      const bool is_parameter =
          !draws && std::ranges::find(kParameters, spec.name) != std::end(kParameters);
      if (!has_option(command.command, spec) || use == LibraryUse::none || is_parameter) continue;
      std::string key(spec.name.substr(2));
      std::ranges::replace(key, '-', '_');
      if (key == "lambda") key += '_';  // a word of Python
      if (use == LibraryUse::of_files && command.command == Command::mesh)
        of_files += text("\"", key, "\", ");
      const std::vector<std::string_view> choices = choices_of(spec);
      const std::string type = spec.argument.empty()                          ? "bool"
                               : spec.argument == "N" || spec.argument == "R" ? "int"
                               : choices.empty()
                                   ? "Value"
                                   : text("Literal[\"", joined(choices, "\", \""), "\"]");
      module += text("    ", key, ": ", type, "\n    \"\"\"", spec.argument,
                     spec.argument.empty() ? "" : ": ", help_in(command.command, spec), "\"\"\"\n");
    }
  }
  return text(module, "\n# About the reading of a file.\nOF_FILES = (", of_files, ")\n");
}

}  // namespace deliso
