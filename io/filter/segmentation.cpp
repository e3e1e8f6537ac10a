// SPDX-License-Identifier: MIT
#include "io/filter/segmentation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <type_traits>
#include <utility>

#include "base/check.h"
#include "base/parallel.h"
#include "base/text.h"
#include "io/files/input_file.h"

namespace deliso {
namespace {

constexpr std::size_t kSlicesOfCount = 8;
constexpr std::size_t kLabelsNamed = 12;  // in a message

using Found = std::map<std::int64_t, LabelSamples>;

void add(LabelSamples& to, const LabelSamples& from) {
  if (to.samples == 0) {
    const std::int64_t label = to.label;
    to = from;
    to.label = label;
    return;
  }
  to.samples += from.samples;
  to.volume += from.volume;
  to.box = united(to.box, from.box);
}

template <class T>
std::int64_t label_of(T value, Index3 at, std::string_view name) {
  if constexpr (std::is_floating_point_v<T>) {
    if (!is_label(value)) {
      fail(name, "the sample at (", at.i, ", ", at.j, ", ", at.k, ") is ",
           static_cast<double>(value), ", and labels are whole numbers of 64 bits");
    }
  }
  return static_cast<std::int64_t>(value);
}

// Adds the labels of a row of `box`, one run of equal samples after the other.
template <class T>
void add_row(Found& found, const T* row, const Grid& grid, const SampleBox& box, int j, int k,
             std::string_view name) {
  const double share = grid.share_of(1, j, j + 1) * grid.share_of(2, k, k + 1);
  for (int begin = box.begin.i; begin <= box.end.i;) {
    int end = begin + 1;
    while (end <= box.end.i && row[end] == row[begin]) ++end;
    LabelSamples run{label_of(row[begin], {begin, j, k}, name),
                     static_cast<std::uint64_t>(end - begin),
                     share * grid.share_of(0, begin, end),
                     {{begin, j, k}, {end - 1, j, k}}};
    LabelSamples& all = found[run.label];
    all.label = run.label;
    add(all, run);
    begin = end;
  }
}

}  // namespace

std::vector<LabelSamples> find_labels(const Segmentation& samples_of, std::string_view name,
                                      int threads, const std::optional<SampleBox>& within) {
  const Volume& volume = samples_of.volume;
  const std::vector<std::int64_t>& ids = samples_of.ids;
  const SampleBox box = within ? *within : SampleBox{{}, volume.voxels()};
  const auto slices = static_cast<std::size_t>(box.dims().k);
  std::vector<Found> found(runs_of(slices, kSlicesOfCount));
  volume.visit([&](const auto* samples) {
    for_each_run(
        threads, slices, kSlicesOfCount, [&](std::size_t task, std::size_t begin, std::size_t end) {
          for (std::size_t n = begin; n < end; ++n) {
            const int k = box.begin.k + static_cast<int>(n);
            for (int j = box.begin.j; j <= box.end.j; ++j) {
              add_row(found[task], samples + volume.index(0, j, k), volume, box, j, k, name);
            }
          }
        });
  });
  Found all;
  for (const Found& part : found) {
    for (const auto& [label, samples] : part) {
      all[label].label = label;
      add(all[label], samples);
    }
  }
  std::vector<LabelSamples> labels;
  for (auto& [label, samples] : all) {
    if (!ids.empty()) samples.label = ids[static_cast<std::size_t>(label)];
    labels.push_back(samples);
  }
  return labels;
}

LabelSamples united_labels(std::span<const LabelSamples> found,
                           std::span<const std::int64_t> labels, std::string_view name) {
  LabelSamples all;
  all.label = labels.front();
  for (const std::int64_t label : labels) {
    const auto at = std::ranges::find(found, label, &LabelSamples::label);
    if (at == found.end()) {
      std::string there;
      for (std::size_t n = 0; n < std::min(found.size(), kLabelsNamed); ++n) {
        there += text(n == 0 ? "" : ", ", found[n].label);
      }
      fail(name, "no sample has label ", label, ": its ", found.size(), " labels are ", there,
           found.size() > kLabelsNamed ? ", ..." : "");
    }
    add(all, *at);
  }
  return all;
}

Volume label_indicator(const Segmentation& samples_of, std::span<const std::int64_t> labels,
                       const SampleBox& box, int threads) {
  const Volume& volume = samples_of.volume;
  const std::vector<std::int64_t>& ids = samples_of.ids;
  DELISO_CHECK(!volume.is_block());
  std::vector<std::int64_t> values(labels.begin(), labels.end());  // of their samples
  if (!ids.empty()) {
    for (std::int64_t& value : values) value = std::ranges::lower_bound(ids, value) - ids.begin();
  }
  const Index3 first = box.begin, dims = box.dims();
  const std::size_t nx = static_cast<std::size_t>(dims.i), ny = static_cast<std::size_t>(dims.j);
  Buffer buffer(nx * ny * static_cast<std::size_t>(dims.k));
  auto* const out = reinterpret_cast<std::uint8_t*>(buffer.data.get());
  const auto is_in = [&](auto value) {
    return std::ranges::find(values, static_cast<std::int64_t>(value)) != values.end();
  };
  volume.visit([&](const auto* samples) {
    for_each_task(threads, static_cast<std::size_t>(dims.k), [&](std::size_t k) {
      for (std::size_t j = 0; j < ny; ++j) {
        const auto* row = samples + volume.index(first.i, first.j + static_cast<int>(j),
                                                 first.k + static_cast<int>(k));
        for (std::size_t i = 0; i < nx; ++i) out[(k * ny + j) * nx + i] = is_in(row[i]);
      }
    });
  });
  const Bytes bytes = bytes_of(std::move(buffer), {});
  return {volume.cropped(first, dims).of_type(SampleType::u8), bytes.data.data(), bytes.owner};
}

}  // namespace deliso
