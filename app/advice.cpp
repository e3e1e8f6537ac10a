// SPDX-License-Identifier: MIT
#include "app/advice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"

namespace deliso {
namespace {

// Degrees. Of six CT volumes the smallest angle was .05 to 1.2 at seven isovalues that samples
// have, and 2.5 to 15, once .7, half a step lower.
constexpr double kThinAngle = 1;

// Samples. Smaller volumes are meshed at once, and are no scans.
constexpr std::size_t kLeastMask = 1000;

bool is_whole(double x) {
  return std::floor(x) == x;
}

}  // namespace

void advise_of_mask(const Input& input, Diagnostics& notes) {
  const Volume& volume = input.volume();
  const double lo = input.range->min, hi = input.range->max;
  const double isovalue = *input.isovalue, middle = lo + (hi - lo) / 2;
  const bool is_middle = std::abs(isovalue - middle) <= (hi - lo) / 4;
  if (volume.sample_count() < kLeastMask || input.field.is_filtered() || is_middle ||
      !input.has_two_sides()) {
    return;
  }
  const bool is_mask = volume.visit([&](const auto* samples) {
    return std::all_of(samples, samples + volume.sample_count(), [&](auto sample) {
      const double value = input.field.mirrored(static_cast<double>(sample));
      return value == lo || value == hi;
    });
  });
  if (!is_mask) return;
  add_warning(notes, "isovalue-of-mask", "", "all samples are ", lo, " or ", hi,
              ", as of a segmentation: --iso ", middle, " is half-way",
              is_whole(hi) ? text(", --label ", hi, " is smooth") : "")
      .with("isovalue", middle);
}

void advise_of_ties(MeshRun& run) {
  const std::optional<Volume>& volume = run.input.field.source.in_memory;
  const double isovalue = run.input.level();
  // Of integers the level lies off all samples (geometric_isovalue()).
  const SampleType type = run.input.grid().type();
  const bool is_float = type == SampleType::f32 || type == SampleType::f64;
  if (!volume || run.input.field.label || !is_float || run.found.triangles == 0 ||
      run.found.quality.min_angle >= kThinAngle || !is_whole(isovalue)) {
    return;
  }
  bool equal = false;
  double below = -std::numeric_limits<double>::infinity();
  volume->visit([&](const auto* samples) {
    for (std::size_t n = 0; n < volume->sample_count(); ++n) {
      const auto value = static_cast<double>(samples[n]);
      equal |= value == isovalue;
      if (value < isovalue) below = std::max(below, value);
    }
  });
  if (!equal || !std::isfinite(below) || !is_whole(below)) return;
  const double better = run.input.field.mirrored(below + (isovalue - below) / 2);
  add_warning(run.notes, "isovalue-on-samples", "",
              "samples equal the isovalue, which makes thin triangles: --iso ", better,
              " gives better ones")
      .with("isovalue", better);
}

void advise_of_border(std::span<const std::int64_t> labels, Diagnostics& notes) {
  if (labels.empty()) return;
  const bool is_one = labels.size() == 1;
  add_warning(notes, "open-at-border", "", is_one ? "the mesh of label " : "the meshes of labels ",
              joined(labels, ", "), is_one ? " is" : " are",
              " open at the volume's border: --cap closes ", is_one ? "it" : "them");
}

}  // namespace deliso
