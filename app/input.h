// SPDX-License-Identifier: MIT
// The volume of a command, with facts for its report.
#pragma once

#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/field.h"
#include "app/report_writer.h"
#include "io/volume/read_volume.h"
#include "volume/volume.h"

namespace deliso {

struct Input {
  std::string name;  // as the user gave it
  Field field;
  // Of the field, but not mirrored; not known of a join, which does not read it.
  std::optional<ValueRange> range;
  ReadLog log;
  double seconds = 0;                // for reading, and for one pass over the samples
  std::optional<double> isovalue{};  // the user's, or the label's

  // Of the field as it is meshed.
  double level() const { return field.mirrored(*isovalue); }
  ValueRange range_of_field() const { return field.mirrored(*range); }
  // True if samples can be on both sides of the isovalue.
  bool has_two_sides() const {
    const ValueRange of = range_of_field();
    return of.min < level() && level() <= of.max;
  }
  const Grid& grid() const { return field.source.shape; }
  // Returns the field with its samples, which are read if they are not in memory.
  Volume volume() const { return all_of(field.source); }
  // Returns the same as the user knows it, with --inside below too.
  Volume samples() const { return field.is_mirrored ? all_of(mirrored(field.source)) : volume(); }
};

// Replaces the segments of --label by their labels, and chooses the channel that has them. Throws
// InputError if the line's input does not name them, or not in one channel.
void find_segments(CommandLine& line);

// True if integers of 64 bits that float64 does not hold are read as labels.
bool may_be_labels(const CommandLine& line);
// Returns the range of the samples, or of the ids that they stand for. Throws as value_range()
// does.
ValueRange range_of(const Volume& volume, const ReadLog& log, std::string_view name);

// Reads the command's input. Throws InputError, also for the first sample that value_range()
// refuses. Also throws if an output of the run cannot be written, or is a file that is read: of the
// volume or of `others`.
Input read_input(const CommandLine& line, std::vector<std::string> others = {});

// The same in two steps, for several fields of one volume.
struct Source {
  Volume volume;
  ValueRange range;                  // of ids (ReadLog::ids), if there are any
  std::vector<LabelSamples> labels;  // only if the command line asks for any
  ReadLog log;
  double seconds = 0;
};
Source read_source(const CommandLine& line, std::vector<std::string> others = {});
// Returns the source of a volume that was read, or given, with its log.
Source source_of(Volume volume, ReadLog log, const CommandLine& line);
Input input_of(const Source& source, const CommandLine& line);

// Turns the volume to the space that a mesh names, if it names one itself; and warns if the line
// asks for another one.
void turn_to(AnatomicalSpace space, const CommandLine& line, Input& input);
void warn_of_space(AnatomicalSpace space, const CommandLine& line, Diagnostics& notes);

// Returns why there is no surface at the isovalue: the range of the samples.
std::string no_surface_text(double isovalue, const ValueRange& range);

std::string_view name_of(AnatomicalSpace space);

// Give aligned lines, and an object "volume".
std::string input_text(const Input& input);
void add_input(ReportWriter& out, const Input& input);
// Adds "inside", beside the isovalue.
void add_inside(ReportWriter& out, const Input& input);

}  // namespace deliso
