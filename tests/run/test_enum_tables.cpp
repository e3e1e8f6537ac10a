// SPDX-License-Identifier: MIT
// A name is that of its enumerator, as the compiler spells it: two that are swapped would make
// every report lie.
#include <doctest/doctest.h>

#include <cctype>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "check/faults.h"
#include "run/report.h"
#include "view/trace/trace_names.h"

using namespace deliso;

namespace {

// The enumerator V as it stands in the source.
template <auto V>
std::string spelled() {
  std::string_view name = __PRETTY_FUNCTION__;  // "... [with auto V = deliso::Refusal::frozen ..."
  name.remove_prefix(name.find("V = ") + 4);
  name = name.substr(0, name.find_first_of(";]"));
  return std::string(name.substr(name.rfind(':') + 1));
}

// "refused: beside a curve" is beside_a_curve, "r/pole" is r_over_pole.
std::string as_enumerator(std::string_view name) {
  if (name.starts_with("refused: ")) name.remove_prefix(9);
  std::string spelling;
  for (const char c : name) {
    if (c == '/')
      spelling += "_over_";
    else
      spelling +=
          std::isalnum(static_cast<unsigned char>(c)) ? static_cast<char>(std::tolower(c)) : '_';
  }
  return spelling;
}

template <class Enum, std::size_t... N>
std::vector<std::string> all_spelled(std::index_sequence<N...>) {
  return {spelled<static_cast<Enum>(N)>()...};
}

}  // namespace

TEST_CASE_TEMPLATE("each value is called what its enumerator is called", Enum, Counter, Operation,
                   Refusal, FaultKind, Routine, Reason, PaperReason, TraceOutcome) {
  constexpr auto kValues = static_cast<std::size_t>(Enum::count_);
  const auto spellings = all_spelled<Enum>(std::make_index_sequence<kValues>());
  for (std::size_t n = 0; n < kValues; ++n) {
    const auto name = name_of(static_cast<Enum>(n));
    if constexpr (requires { name.text; }) {
      CHECK(as_enumerator(name.name) == spellings[n]);
    } else {
      CHECK(as_enumerator(name) == spellings[n]);
    }
  }
}
