// SPDX-License-Identifier: MIT
// Everything the info command finds out about a volume, and its two forms: text for people, JSON
// for programs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/histogram.h"
#include "app/input.h"
#include "app/modes.h"
#include "contour/contour.h"

namespace deliso {

struct Suggestion {
  Valley valley;
  double vertices = 0;                      // expected of a mesh by the options
  std::optional<std::uint64_t> components;  // of the exact surface, where that is quickly told
};

struct Info {
  const Input& input;
  Histogram histogram;
  std::vector<Padding> padding;
  std::vector<Suggestion> suggestions;  // best first
  bool one_mode = false;                // the suggestion is Otsu's
  double seconds_suggestions = 0;

  std::optional<double> isovalue;  // asked for; what follows is about it
  double effective = 0;
  ContourSummary contour;
  double seconds_contour = 0;
};

// `input` must outlive the result.
Info find_info(const Input& input, const CommandLine& line);

std::string info_text(const Info& info);
std::string info_json(const Info& info);

}  // namespace deliso
