// SPDX-License-Identifier: MIT
// Labels from a DICOM segmentation (PS3.3, A.51 and C.8.20): frames of one segment each, of bits or
// of shares, or a map of labels. A slice without a frame is 0, or the padding of a map. A sample's
// label is the number of its segment. Segments that overlap are in several channels, and shares
// are, each segment its own. Segments have colors, in CIELab.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/elementary.h"
#include "base/text.h"
#include "io/files/text_scan.h"
#include "io/volume/dicom_file.h"
#include "io/volume/sample_grid.h"
#include "io/volume/several_volumes.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

// Slices lie at multiples of a step, and over each other, up to these shares of it.
constexpr double kOffStep = 0.01, kMostShift = 0.1;
constexpr double kMostSteps = 1e9;

using Frames = std::vector<std::size_t>;

struct Segmented {
  SampleGrid grid;
  std::vector<Frames> at;  // the frames of each slice
};

// Returns the largest step of which all heights, which ascend, are multiples beside the first: that
// of the file, or else the smallest gap. 0: there is none.
double step_of(const std::vector<double>& heights, std::optional<double> of_file) {
  double gap = heights.back() - heights[0];
  for (std::size_t n = 1; n < heights.size(); ++n) gap = std::min(gap, heights[n] - heights[n - 1]);
  for (const double step : {std::abs(of_file.value_or(gap)), gap}) {
    const auto is_at_step = [&](double height) {
      const double steps = (height - heights[0]) / step;
      return steps < kMostSteps && std::abs(steps - std::round(steps)) <= kOffStep;
    };
    if (step > 0 && std::ranges::all_of(heights, is_at_step)) return step;
  }
  return 0;
}

Segmented place_frames(const VolumeInput& input, const DicomFile& file) {
  const DicomPlane first = file.plane(0);
  if (!first.directions || !first.is_right_angled() || !first.spacing) {
    fail(file.name(), "is a segmentation without the orientation and the spacing of its slices");
  }
  const auto [x, y] = *first.directions;
  const Vec3 normal = cross(x, y);
  const auto count = static_cast<std::size_t>(file.frame_count);
  std::vector<double> height_of, heights;
  Vec3 lowest;
  for (std::size_t n = 0; n < count; ++n) {
    const DicomPlane plane = file.plane(n);
    if (!plane.position) fail(file.name(), "has no position of frame ", n + 1);
    height_of.push_back(dot(*plane.position, normal));
    if (n == 0 || height_of[n] < dot(lowest, normal)) lowest = *plane.position;
  }
  heights = height_of;
  std::ranges::sort(heights);
  const double same = kOffStep * first.thickness.value_or((*first.spacing)[0]);
  heights.erase(std::unique(heights.begin(), heights.end(),
                            [&](double low, double high) { return high - low <= same; }),
                heights.end());
  if (heights.size() == 1) fail(file.name(), "is a segmentation of one slice");
  const double step = step_of(heights, first.distance);
  if (!(step > 0)) fail(file.name(), "is a segmentation whose slices are at no even steps");

  Segmented made{grid_of(input), {}};
  SampleGrid& grid = made.grid;
  grid.type = file.type();
  grid.byte_order = file.is_big_endian ? std::endian::big : std::endian::little;
  grid.dims = {file.columns, file.rows, std::llround((heights.back() - heights[0]) / step) + 1};
  grid.steps = {(*first.spacing)[0] * x, (*first.spacing)[1] * y, step * normal};
  grid.origin = lowest;
  grid.space = AnatomicalSpace::lps;
  input.options.budget.require(input.name(), file.bytes.size(), data_size(grid));
  made.at.resize(static_cast<std::size_t>(grid.dims[2]));
  for (std::size_t n = 0; n < count; ++n) {
    const double height = height_of[n] - heights[0];
    if (distance(*file.plane(n).position, lowest + height * normal) > kMostShift * step) {
      fail(file.name(), "frame ", n + 1, " lies aside of the lowest one");
    }
    made.at[static_cast<std::size_t>(std::llround(height / step))].push_back(n);
  }
  return made;
}

std::int64_t segment_of(const DicomFile& file, std::size_t frame) {
  const std::optional<int> segment = file.plane(frame).segment;
  if (!segment) fail(file.name(), "does not tell the segment of frame ", frame + 1);
  return *segment;
}

// Gives each segment a channel: the first of those where none overlaps it.
void find_channels(const DicomFile& file, const std::vector<Frames>& slices,
                   std::vector<NamedSegment>& segments) {
  std::map<std::int64_t, std::set<std::int64_t>> overlaps;
  std::vector<std::byte> frame(file.frame_size());
  for (const Frames& frames : slices) {
    std::vector<std::vector<std::uint16_t>> owners;  // the first segment at each sample, the second
    for (const std::size_t n : frames) {
      const std::int64_t own = segment_of(file, n);
      file.write_frame(n, frame);
      for (std::size_t at = 0; at < frame.size(); ++at) {
        std::size_t level = 0;
        for (; frame[at] != std::byte{0} && level <= owners.size(); ++level) {
          if (level == owners.size()) owners.emplace_back(frame.size());
          std::uint16_t& owner = owners[level][at];
          if (owner == 0) {
            owner = static_cast<std::uint16_t>(own);
            break;
          }
          overlaps[own].insert(owner);
          overlaps[owner].insert(own);
        }
      }
    }
  }
  for (auto segment = segments.begin(); segment != segments.end(); ++segment) {
    const auto is_taken = [&](const NamedSegment& other) {
      return other.channel == segment->channel && overlaps[segment->label].contains(other.label);
    };
    while (std::any_of(segments.begin(), segment, is_taken)) ++segment->channel;
  }
}

}  // namespace

Volume read_dicom_segmentation(const VolumeInput& input, const DicomFile& file) {
  if (!file.fault.empty()) fail(file.name(), file.fault);
  const Segmented made = place_frames(input, file);
  std::vector<NamedSegment> segments = file.segments;
  if (segments.empty()) fail(file.name(), "is a segmentation without a segment");
  const bool is_map = file.segmentation_type == "LABELMAP",
             has_shares = file.segmentation_type == "FRACTIONAL";
  if (has_shares) {
    for (std::size_t n = 0; n < segments.size(); ++n) segments[n].channel = 1 + std::int64_t(n);
  } else if (!is_map) {
    find_channels(file, made.at, segments);
  }
  VolumeCounts counts;
  std::string names;
  for (const NamedSegment& segment : segments) {
    counts.channels = std::max(counts.channels, segment.channel);
    names += text(names.empty() ? "" : ", ", quote(segment.name));
  }
  const VolumeChoice chosen =
      choose_volume(input.name(), input.options, counts,
                    has_shares ? ": " + names : "; --label NAME chooses one of " + names);
  const auto is_read = [&](const NamedSegment& segment) {
    return segment.channel == chosen.channel + 1;
  };
  if (!has_shares) {
    input.note("segments-named", "names segments, which --label takes: ", names);
    std::ranges::copy_if(segments, std::back_inserter(input.log.segments), is_read);
  }
  SampleGrid grid = made.grid;
  if (!is_map && !has_shares && std::ranges::max(segments, {}, &NamedSegment::label).label > 255) {
    grid.type = SampleType::u16;
  }
  std::vector<std::byte> frame(file.frame_size());
  return volume_from_slices(grid, [&](std::size_t k, std::span<std::byte> out) {
    std::ranges::fill(out, std::byte{0});
    if (is_map) {
      with_type(file.type(), [&]<class T>(T) {
        std::fill_n(reinterpret_cast<T*>(out.data()), out.size() / sizeof(T),
                    static_cast<T>(file.padding_value));
      });
    }
    for (const std::size_t n : made.at[k]) {
      if (is_map) {
        file.write_frame(n, out);
        continue;
      }
      const auto own = std::ranges::find(segments, segment_of(file, n), &NamedSegment::label);
      if (own == segments.end()) fail(file.name(), "has no segment of frame ", n + 1);
      if (!is_read(*own)) continue;
      file.write_frame(n, frame);
      for (std::size_t at = 0; at < frame.size(); ++at) {
        if (has_shares) {
          out[at] = frame[at];
        } else if (frame[at] != std::byte{0} && grid.type == SampleType::u8) {
          out[at] = static_cast<std::byte>(own->label);
        } else if (frame[at] != std::byte{0}) {
          reinterpret_cast<std::uint16_t*>(out.data())[at] = static_cast<std::uint16_t>(own->label);
        }
      }
    }
  });
}

// The page names no white. That of sRGB (D65) is the one of dcmqi and DCMTK: their triples come out
// as the whole numbers that went in, and with ICC's D50 up to 59 off. A color that sRGB does not
// have is cut off.
std::array<std::uint8_t, 3> srgb_of_cielab(const std::array<std::uint16_t, 3>& scaled) {
  constexpr Vec3 kWhiteOfSrgb{0.95047, 1, 1.08883};
  constexpr std::array<Vec3, 3> kSrgbOfXyz{{{3.2404542, -1.5371385, -0.4985314},
                                            {-0.9692660, 1.8760108, 0.0415560},
                                            {0.0556434, -0.2040259, 1.0572252}}};
  const auto [l, a, b] = scaled;
  const double y = (l * 100 / 65535.0 + 16) / 116;
  const auto share = [](double t) {
    return t > 6.0 / 29 ? t * t * t : 108.0 / 841 * (t - 4.0 / 29);
  };
  const Vec3 xyz{kWhiteOfSrgb.x * share(y + (a * 255 / 65535.0 - 128) / 500),
                 kWhiteOfSrgb.y * share(y),
                 kWhiteOfSrgb.z * share(y - (b * 255 / 65535.0 - 128) / 200)};
  std::array<std::uint8_t, 3> color{};
  for (std::size_t n = 0; n < color.size(); ++n) {
    const double linear = std::clamp(dot(kSrgbOfXyz[n], xyz), 0.0, 1.0), third = cube_root(linear);
    const double curved =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * third * std::sqrt(std::sqrt(third)) - 0.055;
    color[n] = static_cast<std::uint8_t>(std::lround(255 * curved));
  }
  return color;
}

std::vector<NamedSegment> segments_of_dicom(const Bytes& bytes) {
  const std::optional<DicomFile> file = parse_dicom(bytes);
  if (!file || !file->is_segmentation()) return {};
  ReadOptions options;
  ReadLog log;
  std::vector<NamedSegment> segments = file->segments;
  if (file->segmentation_type == "BINARY" && file->fault.empty()) {
    find_channels(*file, place_frames({bytes, "", options, log}, *file).at, segments);
  }
  return segments;
}

}  // namespace deliso
