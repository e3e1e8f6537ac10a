// SPDX-License-Identifier: MIT
#include "io/filter/label_parts.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/parallel.h"

namespace deliso {
namespace {

// A body's box may have this many samples, and as many more for each of its own: all boxes together
// take time in proportion to the volume.
constexpr std::uint64_t kMostInBox = 1000, kMostPerSample = 64;

Grid with_margin(const Grid& grid, Index3 margin) {
  Coordinates places = grid.all_places();
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double>& at = places[axis];
    if (at.empty()) continue;
    const double before = at[1] - at[0], after = at.back() - at[at.size() - 2];
    std::vector<double> more;
    more.reserve(at.size() + 2 * static_cast<std::size_t>(margin[axis]));
    for (int n = 0; n < margin[axis]; ++n) more.push_back(n * before);
    for (const double x : at) more.push_back(x + margin[axis] * before);
    for (int n = 0; n < margin[axis]; ++n) more.push_back(more.back() + after);
    at = std::move(more);
  }
  return Grid(grid.dims() + margin + margin, grid.spacing(), SampleType::u32)
      .with_places(std::move(places), "volume");
}

template <class T>
std::int64_t label_of(T sample, std::span<const std::int64_t> ids) {
  // NOLINTNEXTLINE(bugprone-signed-char-misuse): samples of int8 are numbers.
  const auto value = static_cast<std::int64_t>(sample);
  return ids.empty() ? value : ids[static_cast<std::size_t>(value)];
}

using Numbers = std::vector<std::uint32_t>;

// In as few bytes as suffice for `count` numbers.
Volume volume_of(const Numbers& numbers, std::size_t count, const Grid& grid) {
  const auto as = [&]<class T>(T) {
    return Volume::from_samples(grid.of_type(sample_type_of<T>()),
                                std::vector<T>(numbers.begin(), numbers.end()));
  };
  return count <= 0x100     ? as(std::uint8_t())
         : count <= 0x10000 ? as(std::uint16_t())
                            : as(std::uint32_t());
}

// Returns per sample the place of its label, in the larger box.
Numbers places_of_labels(const Segmentation& of, std::span<const LabelSamples> labels,
                         std::span<const std::int64_t> united, const Grid& grid, Index3 margin,
                         int threads) {
  const auto place = [&](std::int64_t label) {
    if (std::ranges::find(united, label) != united.end()) label = united.front();
    return static_cast<std::uint32_t>(
        std::ranges::lower_bound(labels, label, {}, &LabelSamples::label) - labels.begin());
  };
  const Index3 n = grid.dims(), last = of.volume.voxels();
  Numbers places(grid.sample_count());
  of.volume.visit([&](const auto* samples) {
    for_each_task(threads, static_cast<std::size_t>(n.k), [&](std::size_t slice) {
      const int k = static_cast<int>(slice), k_in = std::clamp(k - margin.k, 0, last.k);
      for (int j = 0; j < n.j; ++j) {
        const auto* row = samples + of.volume.index(0, std::clamp(j - margin.j, 0, last.j), k_in);
        std::uint32_t* to = &places[grid.index(0, j, k)];
        for (int i = 0; i < n.i; ++i) {
          const int from = std::clamp(i - margin.i, 0, last.i);
          if (i > 0 && row[from] == row[std::max(0, std::min(from, i - 1 - margin.i))]) {
            to[i] = to[i - 1];
          } else {
            to[i] = place(label_of(row[from], of.ids));
          }
        }
      }
    });
  });
  return places;
}

// Joins samples of one label that are neighbors by faces, edges or corners.
DisjointSets bodies_of(const Numbers& places, const Grid& grid) {
  const Index3 n = grid.dims();
  DisjointSets bodies(places.size());
  for_each_place({}, grid.voxels(), [&](Index3 at) {
    const auto own = static_cast<std::uint32_t>(grid.index(at.i, at.j, at.k));
    const auto join = [&](Index3 step) {
      const Index3 to = at + step;
      if (to.i < 0 || to.j < 0 || to.i == n.i || to.j == n.j || to.k == n.k) return false;
      const auto other = static_cast<std::uint32_t>(grid.index(to.i, to.j, to.k));
      if (places[own] != places[other]) return false;
      bodies.unite(own, other);
      return true;
    };
    // A neighbor across a face joins all that lie beyond it, in its turn.
    const bool x = join({1, 0, 0}), y = join({0, 1, 0}), z = join({0, 0, 1});
    const bool x_low = at.i > 0 && places[own] == places[own - 1];
    const bool y_low = at.j > 0 && places[own] == places[own - static_cast<std::size_t>(n.i)];
    if (!x && !y) join({1, 1, 0});
    if (!x_low && !y) join({-1, 1, 0});
    if (z) return;
    if (!x) join({1, 0, 1});
    if (!x_low) join({-1, 0, 1});
    if (!y) join({0, 1, 1});
    if (!y_low) join({0, -1, 1});
    if (!x && !y) join({1, 1, 1});
    if (!x_low && !y) join({-1, 1, 1});
    if (!x && !y_low) join({1, -1, 1});
    if (!x_low && !y_low) join({-1, -1, 1});
  });
  return bodies;
}

}  // namespace

LabelParts find_parts(const Segmentation& samples, std::span<const LabelSamples> labels,
                      std::span<const std::int64_t> united, Index3 margin, bool may_split,
                      std::string_view name, int threads) {
  const Grid grid = with_margin(samples.volume, margin);
  const Numbers label = places_of_labels(samples, labels, united, grid, margin, threads);
  std::vector<std::size_t> label_of(labels.size());
  for (std::size_t n = 0; n < labels.size(); ++n) label_of[n] = n;
  const Volume label_at = volume_of(label, labels.size(), grid);
  std::vector<LabelSamples> all = find_labels(label_at, name, threads);
  if (!may_split) return {label_at, label_at, margin, all, all, std::move(label_of)};

  const auto number = std::make_shared<Numbers>(bodies_of(label, grid).take_numbers());
  const Volume body_at(grid, reinterpret_cast<const std::byte*>(number->data()), number);
  const std::vector<LabelSamples> bodies = find_labels(body_at, name, threads);
  Numbers label_of_body(bodies.size()), part_of_body;
  for (std::size_t at = 0; at < number->size(); ++at) label_of_body[(*number)[at]] = label[at];
  std::vector<std::uint64_t> largest(labels.size());
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    std::uint64_t& most = largest[label_of_body[n]];
    most = std::max(most, bodies[n].samples);
  }
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const std::uint32_t own = label_of_body[n];
    const Index3 d = bodies[n].box.dims();
    const bool is_main =
        bodies[n].samples == largest[own] ||
        std::uint64_t(d.i) * d.j * d.k > kMostInBox + kMostPerSample * bodies[n].samples;
    part_of_body.push_back(is_main ? own : static_cast<std::uint32_t>(label_of.size()));
    if (!is_main) label_of.push_back(own);
  }
  for (std::uint32_t& n : *number) n = part_of_body[n];  // from now on of parts
  const Volume part_at = volume_of(*number, label_of.size(), grid);
  return {label_at,           part_at, margin, std::move(all), find_labels(part_at, name, threads),
          std::move(label_of)};
}

}  // namespace deliso
