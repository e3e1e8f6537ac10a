// SPDX-License-Identifier: MIT
#include <string>
#include <string_view>
#include <utility>

#include "app/command_line.h"
#include "app/option_table.h"
#include "app/option_texts.h"
#include "io/volume/builtin_fields.h"

namespace deliso {
namespace {

// Appends `words` to a line that has reached `column`, broken into lines that begin there.
void append_wrapped(std::string& text, std::string_view words, std::size_t column) {
  constexpr std::size_t kWidth = 92;
  while (words.size() > kWidth - column) {
    const std::size_t end = words.rfind(' ', kWidth - column);
    text.append(words.substr(0, end)).append("\n").append(column, ' ');
    words.remove_prefix(end + 1);
  }
  text += words;
}

// Appends `left`, then the words from kColumn on, in the same line or the next.
void append_entry(std::string& text, std::string left, std::string_view words) {
  constexpr std::size_t kColumn = 30;
  if (left.size() + 2 > kColumn) {
    left.append("\n").append(kColumn, ' ');
  } else {
    left.resize(kColumn, ' ');
  }
  text += left;
  append_wrapped(text, words, kColumn);
  text += '\n';
}

void append_options(std::string& text, Command command) {
  for (const OptionGroup& group : option_groups()) {
    bool is_first = true;
    for (const OptionSpec& spec : group.options) {
      if (!has_option(command, spec)) continue;
      if (is_first) text.append("\n").append(group.title).append(":\n");
      is_first = false;
      std::string left = "  ";
      if (spec.letter != 0) left.append({'-', spec.letter, ',', ' '});
      left += spec.name;
      if (!spec.argument.empty()) left.append(" ").append(spec.argument);
      append_entry(text, std::move(left), help_in(command, spec));
    }
  }
}

void append_paragraph(std::string& text, std::string_view words) {
  append_wrapped(text, words, 0);
  text += '\n';
}

std::string help_of(const CommandSpec& command) {
  std::string text = "usage: deliso " + std::string(command.synopsis) + "\n\n";
  append_paragraph(text, command.help);
  if (command.command >= Command::help) return text;
  if (command.synopsis.find("MESH") != command.synopsis.npos) append_paragraph(text, kMeshFiles);
  append_paragraph(text, kVolumeFiles);
  append_options(text, command.command);
  text += "\nBuilt-in fields, each with an isovalue of its own as default:\n";
  for (const BuiltinField& field : builtin_fields()) {
    append_entry(text, "  builtin:" + std::string(field.name), field.description);
  }
  return text;
}

}  // namespace

std::string help_text(std::string_view topic) {
  for (const auto& [name, write] : kTextTable) {
    if (name == topic) return write();
  }
  for (const CommandSpec& command : command_table()) {
    if (command.name == topic) return help_of(command);
  }
  std::string text = "usage: ";
  for (const CommandSpec& command : command_table()) {
    if (command.command == Command::version) continue;
    text.append(command.command == Command::mesh ? "" : "       ").append("deliso ");
    text.append(command.synopsis).append("\n");
  }
  text +=
      "       deliso COMMAND --help                  all options of a command\n"
      "       deliso --version\n\n";
  for (const std::string_view words : {kPurpose, kVolumeFiles, kMeshFiles})
    append_paragraph(text, words);
  text.append("\nTo begin with:\n").append(kExamples);
  text.append("\nExit status: ").append(kExitStatus).append("\n");
  return text;
}

}  // namespace deliso
