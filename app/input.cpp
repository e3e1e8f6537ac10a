// SPDX-License-Identifier: MIT
#include "app/input.h"

#include <array>
#include <cstdio>
#include <utility>

#include "app/histogram.h"
#include "app/looks_like_labels.h"
#include "app/output.h"
#include "app/text.h"
#include "app/thresholds.h"
#include "base/check.h"
#include "base/stopwatch.h"
#include "io/volume/read_volume.h"

namespace deliso {
namespace {

std::string_view name_of(AnatomicalSpace space) {
  switch (space) {
    case AnatomicalSpace::ras:
      return "right-anterior-superior";
    case AnatomicalSpace::lps:
      return "left-posterior-superior";
    case AnatomicalSpace::unknown:
      break;
  }
  return "unknown";
}

std::string text_of(const Vec3& v) {
  return number_text(v.x) + " " + number_text(v.y) + " " + number_text(v.z);
}

void add_vector(JsonWriter& json, std::string_view key, const Vec3& v) {
  json.add(key, {v.x, v.y, v.z});
}

// Returns a warning if the user wants labels of a volume that looks like a gray image.
std::string gray_image_warning(const CommandLine& line, const Volume& volume,
                               const ValueRange& range) {
  if (!line.field.of_labels() || looks_like_labels(volume)) return "";
  const std::vector<Threshold> levels = find_thresholds(volume, range).levels;
  if (levels.empty()) return "";  // all samples are equal
  return one_line(line.input + " looks like a gray image, not like labels: try --iso " +
                  number_text(levels[0].isovalue));
}

}  // namespace

void print_warning(const std::string& warning, const CommandLine& line) {
  if (warning.empty() || line.quiet) return;
  std::fprintf(stderr, "deliso: warning: %s\n", warning.c_str());
}

Source read_source(const CommandLine& line, std::vector<std::string> others) {
  const Stopwatch watch;
  ReadLog log;
  Volume volume = read_volume(line.input, line.read, &log);
  others.insert(others.end(), log.files.begin(), log.files.end());
  if (line.input == "-") others.push_back(line.input);
  require_outputs(std::array{line.output, line.json}, others);
  const ValueRange range = value_range(volume, line.input);
  std::vector<LabelSamples> labels;
  if (line.field.of_labels()) labels = find_labels(volume, line.input, line.options.threads);
  std::string warning = gray_image_warning(line, volume, range);
  return {std::move(volume), range,           std::move(labels),
          std::move(log),    watch.seconds(), std::move(warning)};
}

Input input_of(const Source& source, const CommandLine& line) {
  const int threads = line.options.threads;
  Field field = make_field(source.volume, line.field, source.labels, line.input, threads);
  const ValueRange range =
      field.is_filtered() ? value_range(field.volume, line.input) : source.range;
  Input input{line.input,     std::move(field), range,         source.log,
              source.seconds, line.isovalue,    source.warning};
  if (input.field.label) input.isovalue = 0;
  return input;
}

Input read_input(const CommandLine& line, std::vector<std::string> others) {
  return input_of(read_source(line, std::move(others)), line);
}

std::string no_surface_text(double isovalue, const ValueRange& range) {
  return "no surface at isovalue " + number_text(isovalue) + ": the samples are " +
         number_text(range.min) + " to " + number_text(range.max);
}

std::string input_text(const Input& input) {
  const Volume& volume = input.volume();
  const Index3 dims = volume.dims();
  const auto sample_text = [&](double sample) {
    return is_integer(volume.type()) ? number_text(sample) : rounded(sample, 7);
  };
  std::string text = "volume    " + one_line(input.name) + "\n          " + std::to_string(dims.i) +
                     " x " + std::to_string(dims.j) + " x " + std::to_string(dims.k) + " " +
                     std::string(name_of(volume.type())) + ", spacing " + text_of(volume.spacing());
  if (input.range) {
    text += ", samples " + sample_text(input.range->min) + " to " + sample_text(input.range->max);
  }
  text += "\n";

  const Frame& at = volume.frame();
  if (at != Frame{}) {
    text += "          origin " + text_of(at.origin) + ", axes " + text_of(at.axes[0]) + " / " +
            text_of(at.axes[1]) + " / " + text_of(at.axes[2]) +
            (at.left_handed() ? ", left-handed" : "") + ", space " +
            std::string(name_of(at.space)) + "\n";
  }
  for (const NamedArray& array : input.log.arrays) {
    std::string of = array.name + ": " + array.type;
    if (array.components != 1) of += " x " + std::to_string(array.components);
    text += "          array " + one_line(of + (array.read ? ", read" : "")) + "\n";
  }
  for (const std::string& note : input.log.notes) text += "          " + note + "\n";
  return text + field_text(input.field);
}

void add_input(JsonWriter& json, const Input& input) {
  const Volume& volume = input.volume();
  const Frame& at = volume.frame();
  const Index3 dims = volume.dims();
  json.open("volume");
  json.add("input", input.name);
  json.add("dims", {double(dims.i), double(dims.j), double(dims.k)});
  json.add("type", name_of(volume.type()));
  add_vector(json, "spacing", volume.spacing());
  add_vector(json, "origin", at.origin);
  add_vector(json, "axis_x", at.axes[0]);
  add_vector(json, "axis_y", at.axes[1]);
  add_vector(json, "axis_z", at.axes[2]);
  json.add("space", name_of(at.space));
  if (input.range) json.add("range", {input.range->min, input.range->max});
  if (!input.log.arrays.empty()) json.open("arrays");
  for (const NamedArray& array : input.log.arrays) {
    json.open(array.name);
    json.add("type", array.type);
    json.add("components", array.components);
    json.add("read", array.read);
    json.close();
  }
  if (!input.log.arrays.empty()) json.close();
  add_field(json, input.field);
  json.close();
}

}  // namespace deliso
