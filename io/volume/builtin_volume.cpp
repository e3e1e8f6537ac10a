// SPDX-License-Identifier: MIT
#include "io/volume/builtin_volume.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "io/files/text_scan.h"
#include "io/volume/sample_grid.h"

namespace deliso {
namespace {

// "builtin:NAME:SIZE" -> NAME, SIZE (or empty); nothing without the prefix.
std::optional<std::pair<std::string_view, std::optional<std::string_view>>> parse(
    std::string_view input) {
  constexpr std::string_view prefix = "builtin:";
  if (!input.starts_with(prefix)) return std::nullopt;
  input.remove_prefix(prefix.size());
  const std::size_t colon = input.find(':');
  if (colon == std::string_view::npos) return std::pair{input, std::nullopt};
  return std::pair{input.substr(0, colon), std::optional(input.substr(colon + 1))};
}

}  // namespace

const BuiltinField* find_builtin_field(std::string_view input) {
  const auto parts = parse(input);
  if (!parts) return nullptr;
  std::string known;
  for (const BuiltinField& field : builtin_fields()) {
    if (field.name == parts->first) return &field;
    known += (known.empty() ? "" : ", ") + std::string(field.name);
  }
  fail(input, "no built-in field ", quote(parts->first), " (there are ", known, ")");
}

Volume make_builtin_volume(std::string_view input, const ReadOptions& options) {
  const BuiltinField* field = find_builtin_field(input);
  if (!field) fail(input, "is no built-in field");
  int size = field->default_size;
  if (const auto text = parse(input)->second) {
    const std::optional<std::int64_t> given = to_int(*text);
    if (!given || *given < 16 || *given > 1024)
      fail(input, "size ", quote(*text), " is not a number from 16 to 1024");
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
