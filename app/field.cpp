// SPDX-License-Identifier: MIT
#include "app/field.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "app/solid.h"
#include "app/text.h"
#include "base/check.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "io/files/append_format.h"
#include "io/files/input_file.h"
#include "io/filter/gaussian.h"
#include "io/filter/looks_like_labels.h"
#include "io/filter/median.h"

namespace deliso {
namespace {

// Each value of a gray image is near most of the others, so their weights
// (io/filter/label_fields.h) take time by the square of their number: 2,429 values of 20 x 19 x 19
// samples over 40 s.
constexpr std::size_t kMostGrayValues = 1000;

// Lengths that were given in voxels stay as they are, to the last digit.
double in_voxels(const Length& length, const Grid& volume) {
  return length.unit == Length::Unit::voxel ? length.value : length.in(volume) / volume.voxel();
}

// The facts of the field that was made of a label.
LabelFacts facts_of(const Volume& field, const Grid& whole, const FieldOptions& options,
                    const LabelSamples& label, int threads) {
  const Vec3 s = whole.spacing();
  LabelFacts facts;
  facts.labels = options.labels;
  facts.whole = whole.dims();
  facts.samples = label.samples;
  facts.volume = world_volume(label.volume * s.x * s.y * s.z, whole.frame());
  facts.weight = label.weight;
  facts.off = inside_volume(field, threads) / label.volume - 1;
  return facts;
}

Volume mirrored(const Volume& volume) {
  return volume.visit([&]<class T>(const T* samples) {
    std::vector<T> others(samples, samples + volume.sample_count());
    for (T& v : others) {
      if constexpr (std::is_floating_point_v<T>) {
        v = -v;
      } else {
        v = static_cast<T>(~v);
      }
    }
    return Volume::from_samples(volume, others);
  });
}

}  // namespace

double Field::mirrored(double value) const {
  if (!is_mirrored) return value;
  return with_type(source.shape.type(), [&]<class T>(T) {
    return std::is_floating_point_v<T> ? -value
           : std::is_signed_v<T>       ? -1 - value
                                       : std::numeric_limits<T>::max() - value;
  });
}

ValueRange Field::mirrored(const ValueRange& range) const {
  const auto [min, max] = std::minmax({mirrored(range.min), mirrored(range.max)});
  return {min, max};
}

VolumeSource mirrored(const VolumeSource& source) {
  if (source.in_memory) return source_of(mirrored(*source.in_memory));
  return {source.shape, [source](const SampleBox& box) { return mirrored(source.read(box)); }};
}

Vec3 sigma_of(const Length& smooth, const Grid& volume) {
  Vec3 sigma;
  int widest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    sigma[axis] = in_voxels(smooth, volume) * volume.voxel() / volume.spacing()[axis];
    // Written so that what overflows is refused.
    if (!(sigma[axis] <= kLargestSigma)) {
      throw InputError("--smooth is ", rounded(sigma[axis]), " samples along ", "xyz"[axis],
                       ", and must be at most ", kLargestSigma);
    }
    widest = std::max(widest, gaussian_radius(sigma[axis]));
  }
  if (widest == 0) {
    throw InputError(
        "--smooth is less than an eighth of a sample along all axes: that changes nothing");
  }
  return sigma;
}

Field unfiltered_field(const VolumeSource& samples, const FieldOptions& options) {
  const Grid& volume = samples.shape;
  Field field{samples};
  field.median = options.median;
  field.is_mirrored = options.inside_below;
  std::optional<Length> smooth = options.smooth;
  if (options.of_labels() && !smooth) smooth = {1, Length::Unit::voxel};
  if (smooth && smooth->value > 0) {
    field.sigma = sigma_of(*smooth, volume);
    field.sigma_voxels = in_voxels(*smooth, volume);
  }
  return field;
}

Field make_field(const Segmentation& samples, const FieldOptions& options,
                 std::span<const LabelSamples> found, std::string_view name, int threads) {
  const Stopwatch watch;
  Volume volume = samples.volume;
  Field field = unfiltered_field(source_of(volume), options);
  if (!options.labels.empty()) {
    LabelFields labels = label_fields(samples, options, found, name, threads);
    const std::int64_t label = options.labels.front();
    volume = labels.field(label);
    field.label = facts_of(volume, samples.volume, options, labels.weighed(label), threads);
  } else {
    if (field.median > 0) volume = median(volume, field.median, threads);
    if (field.sigma_voxels > 0) volume = gaussian(volume, field.sigma, threads);
  }
  if (field.is_filtered()) field.source = source_of(volume);
  if (field.is_mirrored) field.source = mirrored(field.source);
  field.seconds = watch.seconds();
  return field;
}

LabelFields label_fields(const Segmentation& samples, const FieldOptions& options,
                         std::span<const LabelSamples> found, std::string_view name, int threads) {
  if (found.size() > kMostGrayValues && !looks_like_labels(samples.volume)) {
    fail(name, "looks like a gray image, not like labels, and has ", found.size(),
         " values: try --iso");
  }
  const Field field = unfiltered_field(source_of(samples.volume), options);
  return {samples, {found.begin(), found.end()}, options.labels, {field.median, field.sigma}, name,
          threads};
}

std::string field_note(const FieldOptions& options, const Grid& volume) {
  std::string words;
  if (options.median > 0) words += text(" median=", options.median);
  if (options.smooth) words += text(" smooth=", in_voxels(*options.smooth, volume));
  if (!options.labels.empty()) words += " label=" + joined(options.labels, ",");
  if (options.inside_below) words += " inside=below";
  return words;
}

std::optional<std::string> noted_field(std::span<const std::string> comments) {
  for (const std::string& comment : comments) {
    if (!comment.starts_with("deliso ")) continue;
    std::string words;
    for (const std::string_view name : {" median=", " smooth=", " label=", " inside="}) {
      const std::size_t begin = comment.find(name);
      if (begin == std::string::npos) continue;
      words += comment.substr(begin, comment.find(' ', begin + 1) - begin);
    }
    return words;
  }
  return std::nullopt;
}

std::string filter_text(const Field& field) {
  std::string line;
  if (field.median > 0) {
    const int side = 2 * field.median + 1;
    line = text("median of ", side, " x ", side, " x ", side, " samples");
  }
  if (field.sigma_voxels > 0) {
    line += text(line.empty() ? "" : ", then ", "Gaussian of sigma ", rounded(field.sigma_voxels),
                 " voxels (", rounded(field.sigma.x), " ", rounded(field.sigma.y), " ",
                 rounded(field.sigma.z), " samples)");
  }
  return line;
}

std::string field_text(const Field& field) {
  std::string lines;
  if (field.label) {
    const LabelFacts& label = *field.label;
    lines += text("label     ", joined(label.labels, ", "), " of ", label.whole.i, " x ",
                  label.whole.j, " x ", label.whole.k, ": ") +
             counted(label.samples, "voxel") +
             text(", volume ", volume_text(label.volume), "\n          weight ",
                  rounded(label.weight), ", the volume in its surface ");
    append_format(lines, "%+.2f %% off\n", 100 * label.off);
  }
  if (const std::string filters = filter_text(field); !filters.empty()) {
    lines += "filter    " + filters + "\n";
  }
  return lines;
}

void add_field(ReportWriter& out, const Field& field) {
  if (out.if_any(field.median > 0 || field.sigma_voxels > 0)) {
    out.open("filter",
             "with --median, --smooth or --label: what the samples went through before all else; "
             "type and range are those after it");
    out.optional(field.median > 0)
        .add("median_radius", field.median, "with --median; samples", Rule::positive);
    out.optional(field.sigma_voxels > 0)
        .add("sigma_voxels", field.sigma_voxels, "of the Gaussian; voxels (of the shortest side)",
             Rule::not_negative);
    out.optional(field.sigma_voxels > 0)
        .add("sigma_samples", field.sigma, "the same along x, y and z; samples");
    out.close();
  }
  if (!out.if_any(field.label.has_value())) return;
  const LabelFacts label = field.label.value_or(LabelFacts());
  out.open("label",
           "with --label: the labels whose indicator is meshed; dims and origin are of the box "
           "that is cut out around them");
  out.add_list("labels", label.labels, "whose samples are inside");
  out.add("cut_from", label.whole, "samples of the whole volume along x, y and z", Rule::positive);
  out.add("voxels", label.samples, "samples with the labels");
  out.add("volume_of_voxels", label.volume, "of their voxels, within the box; world units, cubed");
  out.add("weight", label.weight,
          "of its smoothed indicator, less which the largest other weighted one is the field that "
          "is meshed, at 0");
  out.add(
      "off", label.off,
      "the share by which the volume inside the field's surface differs from that of the voxels");
  out.close();
}

}  // namespace deliso
