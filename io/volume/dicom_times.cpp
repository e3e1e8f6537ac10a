// SPDX-License-Identifier: MIT
#include "io/volume/dicom_times.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "base/text.h"
#include "io/volume/several_volumes.h"

namespace deliso {
namespace {

// Slices are at one place if their distance is a smaller share of the usual one.
constexpr double kSamePlace = 0.01;

constexpr std::size_t kKeys = kMomentNames.size();

struct Moment {
  DicomSlice slice{};
  DicomMoment keys{};
};
using Place = std::vector<Moment>;  // of all slices there

std::vector<Place> places_of(const std::vector<DicomSlice>& slices) {
  const double apart = kSamePlace * usual_distance(slices);
  std::vector<Place> places;
  for (std::size_t n = 0; n < slices.size(); ++n) {
    const bool is_next = n == 0 || slices[n].height - slices[n - 1].height > apart;
    if (is_next) places.emplace_back();
    places.back().push_back({slices[n], slices[n].plane().moment});
  }
  return places;
}

// Returns how many slices there are at most places.
std::size_t usual_count(const std::vector<Place>& places) {
  std::map<std::size_t, std::size_t> counts;
  for (const Place& place : places) ++counts[place.size()];
  return std::ranges::max_element(counts, {}, [](const auto& count) { return count.second; })
      ->first;
}

void require_same_count(const VolumeInput& input, const std::vector<Place>& places) {
  if (places.size() == 1) {
    fail(input.name(), "all its slices have the same place (ImagePositionPatient)");
  }
  const std::size_t usual = usual_count(places);
  for (const Place& place : places) {
    if (place.size() == usual) continue;
    const DicomSlice& last = place.back().slice;
    if (usual > 1) {
      fail(last.name(), "has a place (ImagePositionPatient) with ", place.size(),
           place.size() == 1 ? " slice" : " slices", ", where others have ", usual);
    }
    fail(last.name(), "has the same place (ImagePositionPatient) as ",
         name_beside(last, place[place.size() - 2].slice));
  }
}

// Returns the keys in the order in which they tell the slices at one place apart: first those that
// have the same values at all places.
std::vector<std::size_t> order_of_keys(const std::vector<Place>& places) {
  const auto values = [](const Place& place, std::size_t key) {
    std::vector<std::optional<double>> all;
    for (const Moment& moment : place) all.push_back(moment.keys[key]);
    std::ranges::sort(all);
    return all;
  };
  std::vector<std::size_t> keys;
  for (std::size_t key = 0; key < kKeys; ++key) keys.push_back(key);
  const auto is_same_everywhere = [&](std::size_t key) {
    const auto first = values(places[0], key);
    return std::ranges::all_of(places,
                               [&](const Place& place) { return values(place, key) == first; });
  };
  std::stable_partition(keys.begin(), keys.end(), is_same_everywhere);
  return keys;
}

// Sorts the slices at each place, and returns the name of the first key that tells them apart.
std::string_view sort_places(std::vector<Place>& places) {
  const std::vector<std::size_t> keys = order_of_keys(places);
  for (Place& place : places) {
    std::ranges::stable_sort(place, [&](const Moment& a, const Moment& b) {
      const auto differs = [&](std::size_t key) { return a.keys[key] != b.keys[key]; };
      const auto key = std::ranges::find_if(keys, differs);
      return key != keys.end() && a.keys[*key] < b.keys[*key];
    });
  }
  for (const std::size_t key : keys) {
    const auto value = [&](const Moment& moment) { return moment.keys[key]; };
    if (std::ranges::adjacent_find(places[0], std::ranges::not_equal_to(), value) !=
        places[0].end()) {
      return kMomentNames[key];
    }
  }
  return "";
}

}  // namespace

void choose_time(const VolumeInput& input, std::vector<DicomSlice>& slices) {
  std::vector<Place> places = places_of(slices);
  require_same_count(input, places);
  const std::size_t times = places[0].size();
  const std::string_view key = sort_places(places);
  const auto chosen =
      choose_volume(input.name(), input.options, {.times = static_cast<std::int64_t>(times)},
                    text(", in the order of ", key.empty() ? "the files" : "their ", key));
  slices.clear();
  for (const Place& place : places) {
    slices.push_back(place[static_cast<std::size_t>(chosen.time)].slice);
  }
}

std::vector<double> gaps_between(const std::vector<DicomSlice>& slices) {
  std::vector<double> gaps;
  for (std::size_t n = 1; n < slices.size(); ++n) {
    gaps.push_back(slices[n].height - slices[n - 1].height);
  }
  return gaps;
}

double usual_distance(const std::vector<DicomSlice>& slices) {
  if (slices.size() < 2) return 0;
  const double mean =
      (slices.back().height - slices[0].height) / static_cast<double>(slices.size() - 1);
  std::vector<double> gaps = gaps_between(slices);
  std::erase_if(gaps, [&](double gap) { return !(gap > kSamePlace * mean); });
  if (gaps.empty()) return 0;
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>((gaps.size() - 1) / 2);
  std::ranges::nth_element(gaps, middle);
  return *middle;
}

}  // namespace deliso
