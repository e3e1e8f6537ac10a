// SPDX-License-Identifier: MIT
#include "io/volume/builtin_volume.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/files/text_scan.h"
#include "io/volume/sample_grid.h"

namespace deliso {

const BuiltinField* find_builtin_field(std::string_view input) {
  const std::vector<std::string_view> words = split(input, ':');  // "builtin:NAME:SIZE"
  if (words[0] != "builtin" || words.size() < 2) return nullptr;
  std::string known;
  for (const BuiltinField& field : builtin_fields()) {
    if (field.name == words[1]) return &field;
    known += (known.empty() ? "" : ", ") + std::string(field.name);
  }
  fail(input, "no built-in field ", quote(words[1]), " (there are ", known, ")");
}

Volume make_builtin_volume(std::string_view input, const ReadOptions& options) {
  const BuiltinField* field = find_builtin_field(input);
  if (!field) fail(input, "is no built-in field");
  int size = field->default_size;
  const std::string_view text =
      input.substr(std::string_view("builtin:").size() + field->name.size());
  if (!text.empty()) {
    const std::optional<std::int64_t> given = to_int(text.substr(1));
    if (!given || *given < 16 || *given > 1024)
      fail(input, "size ", quote(text.substr(1)), " is not a number from 16 to 1024");
    size = static_cast<int>(*given);
  }
  const auto whole = std::make_shared<const Volume>(sample_builtin_field(*field, size));
  SampleGrid grid;
  grid.name = input;
  grid.dims.fill(size);
  grid.type = whole->type();
  grid.read = options;
  const auto bytes_at = [](const auto* samples) {
    return reinterpret_cast<const std::byte*>(samples);
  };
  const std::size_t size_in_bytes = static_cast<std::size_t>(data_size(grid));
  return volume_from_raw(grid, {grid.name, {whole->visit(bytes_at), size_in_bytes}, whole});
}

}  // namespace deliso
