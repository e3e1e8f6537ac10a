// SPDX-License-Identifier: MIT
#include "app/input.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <utility>

#include "app/output.h"
#include "app/text.h"
#include "base/check.h"
#include "base/sorted_list.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "io/files/text_scan.h"
#include "io/filter/looks_like_labels.h"
#include "io/filter/nan_samples.h"
#include "io/filter/thresholds.h"
#include "io/volume/read_volume.h"

namespace deliso {
namespace {

std::string numbers_of(const Vec3& v) {
  return text(v.x, " ", v.y, " ", v.z);
}

// Returns the type of the samples, in the file if they stand for ids.
std::string_view type_name(const Input& input) {
  return name_of(input.log.ids.empty() || input.field.label ? StoredType(input.grid().type())
                                                            : input.log.type_of_ids);
}

// Warns if the user wants labels of a volume that looks like a gray image.
void warn_of_gray_image(const CommandLine& line, const Volume& volume, const ValueRange& range,
                        ReadLog& log) {
  if (!line.field.of_labels() || !log.ids.empty() || looks_like_labels(volume)) return;
  const std::vector<Threshold> levels = find_thresholds(volume, range).levels;
  if (levels.empty()) return;  // all samples are equal
  const double isovalue = levels[0].isovalue;
  add_warning(log.notes, "gray-image", line.input,
              "looks like a gray image, not like labels: try --iso ", isovalue)
      .with("isovalue", isovalue);
}

}  // namespace

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

void find_segments(CommandLine& line) {
  if (line.field.segments.empty()) return;
  const std::vector<NamedSegment> known = read_segments(line.input);
  std::string names;
  for (const NamedSegment& segment : known) {
    names += text(names.empty() ? ", but " : ", ", quote(segment.name));
  }
  for (const std::string& name : std::exchange(line.field.segments, {})) {
    const auto found = std::ranges::find(known, name, &NamedSegment::name);
    if (found == known.end()) {
      throw InputError(line.input, ": has no segment ", quote(name),
                       names.empty() ? ": --label takes whole numbers, or all" : names);
    }
    if (line.read.channel.value_or(found->channel) != found->channel) {
      throw InputError(line.input, ": segment ", quote(name), " is in channel ", found->channel,
                       ", not in ", *line.read.channel);
    }
    line.read.channel = found->channel;
    line.field.labels.push_back(found->label);
  }
  sort_unique(line.field.labels);
}

bool may_be_labels(const CommandLine& line) {
  return line.field.of_labels() ||
         (line.command == Command::info && !line.isovalue && !line.field.any());
}

ValueRange range_of(const Volume& volume, const ReadLog& log, std::string_view name) {
  if (log.ids.empty()) return value_range(volume, name);
  return {static_cast<double>(log.ids.front()), static_cast<double>(log.ids.back())};
}

Source read_source(const CommandLine& line, std::vector<std::string> others) {
  const Stopwatch watch;
  ReadLog log;
  ReadOptions read = line.read;
  read.as_labels = may_be_labels(line);
  Volume volume = [&] {
    try {
      return read_volume(line.input, read, &log);
    } catch (SeveralSeries& several) {
      several.paths = log.paths();
      several.notes = log.notes;
      throw;
    }
  }();
  std::ranges::copy(log.paths(), std::back_inserter(others));
  if (line.input == "-") others.push_back(line.input);
  require_outputs(std::array{line.output, line.json}, others);
  Source source = source_of(std::move(volume), std::move(log), line);
  source.seconds = watch.seconds();
  return source;
}

Source source_of(Volume volume, ReadLog log, const CommandLine& line) {
  const Stopwatch watch;
  for (const Diagnostic& item : line.notes) add_to(log.notes, item);
  if (line.field.nan) {
    std::uint64_t count = 0;
    volume = without_nan(volume, *line.field.nan, count);
    add_note(log.notes, "nan-replaced", "", counted(count, "sample is NaN", "samples are NaN"),
             ", and taken as ", *line.field.nan)
        .with("samples", static_cast<double>(count));
  }
  const ValueRange range = range_of(volume, log, line.input);
  std::vector<LabelSamples> labels;
  if (line.field.of_labels()) {
    labels = find_labels({volume, log.ids}, line.input, line.options.threads);
  }
  warn_of_gray_image(line, volume, range, log);
  return {std::move(volume), range, std::move(labels), std::move(log), watch.seconds()};
}

Input input_of(const Source& source, const CommandLine& line) {
  const int threads = line.options.threads;
  Field field =
      make_field({source.volume, source.log.ids}, line.field, source.labels, line.input, threads);
  ValueRange range = source.range;
  if (field.is_filtered()) range = field.mirrored(value_range(all_of(field.source), line.input));
  Input input{line.input, std::move(field), range, source.log, source.seconds, line.isovalue};
  if (input.field.label) input.isovalue = 0;
  return input;
}

Input read_input(const CommandLine& line, std::vector<std::string> others) {
  return input_of(read_source(line, std::move(others)), line);
}

void warn_of_space(AnatomicalSpace space, const CommandLine& line, Diagnostics& notes) {
  const AnatomicalSpace asked = line.read.space;
  constexpr AnatomicalSpace unknown = AnatomicalSpace::unknown;
  if (asked == unknown || space == unknown || asked == space) return;
  add_warning(notes, "space-differs", "", "the mesh names the space ", short_name_of(space),
              ", which stands: --space ", short_name_of(asked), " has no effect");
}

void turn_to(AnatomicalSpace space, const CommandLine& line, Input& input) {
  warn_of_space(space, line, input.log.notes);
  const Frame turned = input.grid().frame().in_space(space);
  input.field.source = source_of(input.volume().with_frame(turned));
}

std::string no_surface_text(double isovalue, const ValueRange& range) {
  return text("no surface at isovalue ", isovalue, ": the samples are ", range.min, " to ",
              range.max);
}

std::string input_text(const Input& input) {
  const Grid& volume = input.grid();
  const Index3 dims = volume.dims();
  const auto sample_text = [&](double sample) {
    return is_integer(volume.type()) ? text(sample) : rounded(sample, 7);
  };
  std::string lines =
      text("volume    ", one_line(input.name), "\n          ", dims.i, " x ", dims.j, " x ", dims.k,
           " ", type_name(input), ", spacing ", numbers_of(volume.spacing()));
  for (int axis = 0; axis < 3; ++axis) {
    if (volume.places(axis)) lines += text(", uneven along ", "xyz"[axis]);
  }
  // A note has the ids.
  if (input.range && (input.log.ids.empty() || input.field.label)) {
    lines += ", samples " + sample_text(input.range->min) + " to " + sample_text(input.range->max);
  }
  lines += "\n";

  const Frame& at = volume.frame();
  if (at != Frame{}) {
    lines += text("          origin ", numbers_of(at.origin), ", axes ",
                  joined(at.axes, " / ", numbers_of), at.left_handed() ? ", left-handed" : "",
                  ", space ", name_of(at.space), "\n");
  }
  for (const NamedArray& array : input.log.arrays) {
    std::string of = array.name + ": " + array.type;
    if (array.components != 1) of += text(" x ", array.components);
    lines += "          array " + one_line(of + (array.read ? ", read" : "")) + "\n";
  }
  for (const Diagnostic& told : input.log.notes) {
    if (told.severity == Severity::note) lines += "          " + text_of(told) + "\n";
  }
  return lines + field_text(input.field);
}

void add_input(ReportWriter& out, const Input& input) {
  const Grid& volume = input.grid();
  const Frame& at = volume.frame();
  out.open("volume", "what was read");
  out.add("input", input.name, "as it was given: a path, builtin:NAME, or - for standard input");
  out.add("dims", volume.dims(), "samples along x, y and z", Rule::positive);
  std::vector<std::string> types = names_up_to(SampleType::f64);
  types.insert(types.end(), {"int64", "uint64"});
  const auto type = std::ranges::find(types, type_name(input)) - types.begin();
  out.add_choice("type", static_cast<std::size_t>(type), types,
                 "of a sample; int64 and uint64 are held as numbers of ids");
  out.add("spacing", volume.spacing(), "between samples along x, y and z; world units");
  if (out.if_any(!volume.is_even())) {
    out.open(
        "coordinates",
        "of samples along an axis of uneven steps, from the first one; the spacing is their median "
        "distance");
    for (std::size_t axis = 0; axis < 3; ++axis) {
      out.add_list(std::string(1, "xyz"[axis]), volume.all_places()[axis], "number",
                   "world units; none along an axis of even steps");
    }
    out.close();
  }
  out.add("origin", at.origin, "of the first sample; world units");
  out.add("axis_x", at.axes[0], "the direction of the volume's x axis in the world");
  out.add("axis_y", at.axes[1], "of its y axis");
  out.add("axis_z", at.axes[2], "of its z axis");
  out.add_choice("space", static_cast<std::size_t>(at.space), names_up_to(AnatomicalSpace::lps),
                 "which way the world's axes point in a patient");
  const ValueRange range = input.range.value_or(ValueRange());
  constexpr const char* kRange = "the smallest and the largest sample; a join does not look at all";
  if (!input.log.ids.empty() && !input.field.label) {
    const std::vector<std::int64_t>& ids = input.log.ids;
    out.add_list("range", std::array{ids.front(), ids.back()}, kRange);
  } else {
    out.optional(input.range.has_value())
        .add_list("range", std::array{range.min, range.max}, "number", kRange);
  }
  if (out.if_any(!input.log.arrays.empty())) {
    out.open("arrays",
             "of a VTK file, by their names: type, components, and whether the volume is this one "
             "(read)");
    for (const NamedArray& array : input.log.arrays) {
      out.open(array.name, "");
      out.add("type", array.type, "");
      out.add("components", array.components, "");
      out.add("read", array.read, "");
      out.close();
    }
    out.close(true);
  }
  add_field(out, input.field);
  out.close();
}

void add_inside(ReportWriter& out, const Input& input) {
  const std::array<std::string, 2> sides{"above", "below"};
  out.add_choice("inside", input.field.is_mirrored ? 1 : 0, sides,
                 "which side of the isovalue is inside");
}

}  // namespace deliso
