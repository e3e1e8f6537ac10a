// SPDX-License-Identifier: MIT
#include "io/volume/wide_integers.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/sorted_list.h"
#include "base/text.h"

namespace deliso {
namespace {

constexpr std::size_t kMostIds = std::size_t{1} << 20;

// The words of T, in native order, in which others of at most their size may take their place.
template <class T>
class Words {
 public:
  explicit Words(std::span<std::byte> bytes) : bytes_(bytes) {}
  std::size_t size() const { return bytes_.size() / sizeof(T); }
  T operator[](std::size_t n) const {
    T word;
    std::memcpy(&word, &bytes_[n * sizeof word], sizeof word);
    return word;
  }
  template <class Other>
  void put(std::size_t n, Other value) const {
    std::memcpy(&bytes_[n * sizeof value], &value, sizeof value);
  }

 private:
  std::span<std::byte> bytes_;
};

// True if the double has the same value.
template <class T>
bool is_exact(T value) {
  const auto rounded = static_cast<double>(value);
  return rounded < static_cast<double>(std::numeric_limits<T>::max()) &&
         static_cast<T>(rounded) == value;
}

// Returns the different words, ascending; none if there are too many, or one is no id.
template <class T>
std::vector<std::int64_t> ids_of(const Words<T>& words) {
  std::vector<std::int64_t> ids;
  for (std::size_t n = 0; n < words.size(); ++n) {
    const T word = words[n];
    if (!std::in_range<std::int64_t>(word)) return {};
    if (n > 0 && word == words[n - 1]) continue;
    ids.push_back(static_cast<std::int64_t>(word));
    if (ids.size() < 2 * kMostIds) continue;
    sort_unique(ids);
    if (ids.size() > kMostIds) return {};
  }
  sort_unique(ids);
  return ids.size() > kMostIds ? std::vector<std::int64_t>() : ids;
}

template <class T>
SampleType convert(const SampleGrid& grid, const Words<T>& words) {
  bool all_exact = true;
  T least = words[0], most = words[0];
  for (std::size_t n = 0; n < words.size(); ++n) {
    const T word = words[n];
    all_exact = all_exact && is_exact(word);
    least = std::min(least, word);
    most = std::max(most, word);
  }
  const auto note = [&](const auto&... words_of_note) {
    if (!grid.log) return;
    add_note(grid.log->notes, "wide-integers", grid.name, "64-bit integers are read as ",
             words_of_note...);
  };
  if (all_exact) {
    for (std::size_t n = 0; n < words.size(); ++n) words.put(n, static_cast<double>(words[n]));
    note("float64");
    return SampleType::f64;
  }
  const std::vector<std::int64_t> ids =
      grid.read.as_labels && grid.log ? ids_of(words) : std::vector<std::int64_t>();
  if (ids.empty()) {
    fail(grid.name, "its integers of 64 bits are from ", least, " to ", most,
         ", and float64 does not hold all of them exactly: ",
         grid.read.as_labels
             ? text("labels are at most 2^63 - 1, and ", kMostIds, " different ones at most")
             : std::string("only labels without a scale are read so, by --label"));
  }
  std::uint32_t number = 0;
  for (std::size_t n = 0; n < words.size(); ++n) {
    const auto id = static_cast<std::int64_t>(words[n]);
    if (n == 0 || ids[number] != id) {
      number = static_cast<std::uint32_t>(std::ranges::lower_bound(ids, id) - ids.begin());
    }
    words.put(n, number);
  }
  note("labels: ", ids.size(), " from ", ids.front(), " to ", ids.back());
  grid.log->ids = ids;
  grid.log->type_of_ids = grid.type;
  return SampleType::u32;
}

}  // namespace

SampleType convert_wide(const SampleGrid& grid, std::span<std::byte> words) {
  return grid.type.wide == StoredType::Wide::i64 ? convert(grid, Words<std::int64_t>(words))
                                                 : convert(grid, Words<std::uint64_t>(words));
}

}  // namespace deliso
