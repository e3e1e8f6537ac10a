// SPDX-License-Identifier: MIT
// The info command: what a volume is, how its samples are distributed, what surface an isovalue
// has.
#include <cstdio>
#include <optional>
#include <string>

#include "app/histogram.h"
#include "app/input.h"
#include "app/json.h"
#include "app/output.h"
#include "app/run.h"
#include "app/stopwatch.h"
#include "app/text.h"
#include "app/topology.h"
#include "contour/contour.h"

namespace deliso {
namespace {

constexpr int kBins = 256;
constexpr int kRows = 16;

struct Info {
  const Input& input;
  Histogram histogram;
  double suggestion = 0;

  std::optional<double> isovalue;
  double effective = 0;
  ContourSummary contour;
  double seconds_contour = 0;
};

std::string info_text(const Info& info) {
  std::string text = input_text(info.input);
  text += '\n';
  text += histogram_text(info.histogram, kRows);
  text += '\n';
  if (info.input.range.min < info.input.range.max) {
    text += "try       --iso " + number_text(info.suggestion) + "\n";
  }
  char line[128];
  std::snprintf(line, sizeof line, "read      %.3f s\n", info.input.seconds);
  text += line;
  if (info.isovalue) {
    text += "\nisovalue  " + number_text(*info.isovalue);
    if (info.effective != *info.isovalue) {
      text += ", lowered to " + number_text(info.effective) + " as samples or saddles equal it";
    }
    text += "\nsurface   " + topology_text(topology_of(info.contour)) + "\n          in " +
            std::to_string(info.contour.active_voxels) + " voxels";
    std::snprintf(line, sizeof line, ", found in %.3f s\n", info.seconds_contour);
    text += line;
  }
  return text;
}

std::string info_json(const Info& info) {
  JsonWriter json;
  add_input(json, info.input);
  json.add("suggested_isovalue", info.suggestion);
  json.add("seconds_read", info.input.seconds);
  if (info.isovalue) {
    json.open("surface");
    json.add("isovalue", *info.isovalue);
    json.add("isovalue_effective", info.effective);
    add_topology(json, "topology", topology_of(info.contour));
    json.add("active_voxels", info.contour.active_voxels);
    json.add("seconds_contour", info.seconds_contour);
    json.close();
  }
  return json.finish();
}

}  // namespace

int run_info(const CommandLine& line) {
  const Input input = read_input(line);
  Info info{input, make_histogram(input.volume, input.range, kBins), 0, line.isovalue, 0, {}, 0};
  info.suggestion = suggested_isovalue(input.volume.type(), otsu_threshold(info.histogram));
  if (line.isovalue) {
    const Stopwatch watch;
    info.effective = settled_isovalue(input.volume, *line.isovalue);
    info.contour = summarize_contour(input.volume, info.effective);
    info.seconds_contour = watch.seconds();
  }
  if (!line.json.empty()) write_text(line.json, info_json(info));
  if (!line.quiet && line.json != "-") print(info_text(info));
  return kFine;
}

}  // namespace deliso
