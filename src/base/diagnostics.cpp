// SPDX-License-Identifier: MIT
#include "base/diagnostics.h"

#include <algorithm>
#include <utility>

#include "base/check.h"

namespace deliso {

Diagnostic& Diagnostic::with(std::string_view name, double value) {
  values.emplace_back(name, value);
  return *this;
}

std::string text_of(const Diagnostic& diagnostic) {
  const std::string& file = diagnostic.file;
  return file.empty() ? diagnostic.words : one_line(text(file, ": ", diagnostic.words));
}

Diagnostic& add_to(Diagnostics& list, Diagnostic item) {
  item.words = one_line(std::move(item.words));
  const auto known = std::ranges::find_if(list, [&](const Diagnostic& other) {
    return other.severity == item.severity && other.code == item.code &&
           other.words == item.words && other.file == item.file;
  });
  return known == list.end() ? list.emplace_back(std::move(item)) : *known;
}

bool has(const Diagnostics& list, Code code) {
  return std::ranges::find(list, code, &Diagnostic::code) != list.end();
}

}  // namespace deliso
