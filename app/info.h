// SPDX-License-Identifier: MIT
// The results of the info command about a volume, as text and as JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/input.h"
#include "app/progress.h"
#include "contour/contour.h"
#include "io/filter/histogram.h"
#include "io/filter/segmentation.h"
#include "io/filter/thresholds.h"
#include "more/counts/expected_vertices.h"

namespace deliso {

struct Suggestion {
  Threshold threshold;
  double vertices = 0;                      // expected for a mesh with the options
  std::optional<std::uint64_t> components;  // of the exact surface, if they are quickly counted
};

struct Info {
  const Input& input;
  Histogram histogram;
  std::vector<Padding> padding;
  std::vector<LabelSamples> labels;     // of samples that look like labels
  std::vector<Suggestion> suggestions;  // best first
  double seconds_suggestions = 0;

  std::optional<double> isovalue;  // the user's; the members below are about it
  double effective = 0;
  ContourSummary contour;
  double seconds_contour = 0;
};

// Reads the input. Of a file of several channels or times, if the line chooses none, that is the
// first, with a note: the user wants to know what there is. A picture needs one that is chosen.
// Throws SeveralSeries, too.
Input read_to_inform(const CommandLine& line);

// Returns the information. Keeps a reference to `input`.
Info find_info(const Input& input, const CommandLine& line, Progress& progress);

std::string info_text(const Info& info);
std::string info_json(const Info& info);
void add_info(ReportWriter& out, const Info& info);  // the members of that

// The same of a folder of several series, of which the line chooses none.
std::string series_text(const std::string& folder, const std::vector<FoundSeries>& series);
std::string series_json(const std::string& folder, const std::vector<FoundSeries>& series);
void add_series(ReportWriter& out, const std::string& folder,
                const std::vector<FoundSeries>& series);

}  // namespace deliso
