// SPDX-License-Identifier: MIT
// The field that is meshed: the samples as they are, or after --label, --median and --smooth, in
// this order.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/command_line.h"
#include "app/report_writer.h"
#include "io/filter/label_fields.h"
#include "volume/volume_source.h"

namespace deliso {

// Facts about --label, for reports.
struct LabelFacts {
  std::vector<std::int64_t> labels;
  Index3 whole;               // samples of the volume that the label is cut out of
  std::uint64_t samples = 0;  // with the labels
  double volume = 0;          // of their voxels within the box; world units
  double weight = 0;          // io/filter/label_fields.h
  double off = 0;             // the volume inside the field's surface over that, less 1
};

struct Field {
  VolumeSource source;      // of its samples; not in memory where parts are filtered one by one
  int median = 0;           // radius, in samples; 0: none
  Vec3 sigma{};             // in samples; 0: none
  double sigma_voxels = 0;  // in a voxel's shortest sides
  std::optional<LabelFacts> label{};
  double seconds = 0;  // for the filters
  // With --inside below: its samples, and isovalues, are mirrored, so that inside is above.
  bool is_mirrored = false;

  // Returns the field's value for a sample or isovalue of the user, and the other way round.
  double mirrored(double value) const;
  ValueRange mirrored(const ValueRange& range) const;
  bool is_filtered() const { return label || median > 0 || sigma_voxels > 0; }
};

// Returns the field before its filters. Labels are always smoothed. Throws as sigma_of() does.
Field unfiltered_field(const VolumeSource& samples, const FieldOptions& options);

// Returns the field. Throws InputError, with the volume's `name`, for labels that it has not, for
// those of a gray image with too many values, and for a Gaussian out of range. `found`: the
// volume's labels; only of --label.
Field make_field(const Segmentation& samples, const FieldOptions& options,
                 std::span<const LabelSamples> found, std::string_view name, int threads);

// Returns a source whose order of samples is turned round, without loss: of numbers with a sign
// -v, of whole numbers their complement.
VolumeSource mirrored(const VolumeSource& source);

// Returns the fields of all labels, each by itself.
LabelFields label_fields(const Segmentation& samples, const FieldOptions& options,
                         std::span<const LabelSamples> found, std::string_view name, int threads);

// Returns the standard deviations of a Gaussian in samples along the axes. Throws InputError for
// one out of range.
Vec3 sigma_of(const Length& smooth, const Grid& volume);

// Returns " median=1 smooth=0.5 label=1,4" or the like, for the comment in a mesh's file. Lengths
// are in voxels. Empty without a filter.
std::string field_note(const FieldOptions& options, const Grid& volume);
// Returns these words of the program's line in a file's comments; nothing without that line.
std::optional<std::string> noted_field(std::span<const std::string> comments);

// Returns "median of 3 x 3 x 3 samples, Gaussian of ..."; empty without either.
std::string filter_text(const Field& field);
// Gives aligned lines; none without a filter.
std::string field_text(const Field& field);
// Adds the objects "filter" and "label", as far as there are any.
void add_field(ReportWriter& out, const Field& field);

}  // namespace deliso
