// SPDX-License-Identifier: MIT
#include "io/volume/sample_grid.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "io/files/field_reader.h"
#include "io/files/text_scan.h"
#include "io/volume/wide_integers.h"

namespace deliso {
namespace {

bool is_gzip(const Bytes& bytes) {
  return bytes.text().starts_with("\x1f\x8b");
}

bool is_swapped(const SampleGrid& grid) {
  return grid.byte_order != std::endian::native && size_of(grid.type) > 1;
}

// Returns " (x and y enclose 45 degrees)" of two axes that are not at right angles, if there are
// any.
std::optional<std::string> shear_of(const Frame& frame) {
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = a + 1; b < 3; ++b) {
      const double cosine = dot(frame.axes[a], frame.axes[b]);
      if (std::abs(cosine) <= kShearTolerance) continue;
      const double degrees = std::acos(std::min(1.0, std::abs(cosine))) * (180 / 3.14159265358979);
      return text(" (", "xyz"[a], " and ", "xyz"[b], " enclose ", std::round(1e4 * degrees) / 1e4,
                  " degrees)");
    }
  }
  return std::nullopt;
}

// Returns the whole grid: steps become spacing and unit axes. What the options give is in place of
// the file's own, which may then be missing or bad.
Grid whole_grid(const SampleGrid& grid) {
  Vec3 spacing;
  Frame frame;
  Coordinates places;
  frame.origin = grid.read.origin.value_or(grid.origin);
  const bool is_directed = has_directions(grid);
  if (is_directed) frame.space = grid.space;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = grid.steps[static_cast<std::size_t>(axis)];
    const std::vector<double>& given = grid.read.coordinates[static_cast<std::size_t>(axis)];
    if (!given.empty()) {
      for (const double at : given) places[axis].push_back(at - given[0]);
      if (!grid.read.origin) frame.origin[axis] = given[0];
    } else if (!grid.read.spacing) {
      places[axis] = grid.places[static_cast<std::size_t>(axis)];
    }
    const double own = length(step);
    double s = grid.read.spacing ? (*grid.read.spacing)[axis] : own;
    if (places[axis].size() > 1) s = std::max(median_gap(places[axis]), kSmallestSpacing);
    if (!(s > 0 && std::isfinite(s))) {
      fail(grid.name, "spacing along ", "xyz"[axis], s > 0 ? " is infinite" : " is not positive",
           grid.is_of_file && !grid.read.spacing ? kGiveSpacing : "");
    }
    spacing[axis] = s;
    if (is_directed) frame.axes[static_cast<std::size_t>(axis)] = step / own;
  }
  if (!in_range(frame.origin)) {
    fail(grid.name, "its origin is further than ", kLargestLength, " away",
         grid.is_of_file && !grid.read.origin ? kGiveOrigin : "");
  }
  require_in_range(grid.size(), spacing, frame, grid.name);
  Grid whole =
      Grid(grid.size(), spacing, grid.type, frame).with_places(std::move(places), grid.name);
  const auto& [u, v, w] = frame.axes;
  if (!(std::abs(dot(cross(u, v), w)) >= kLeastDeterminant)) {
    fail(grid.name, "sheared grid: its axes are too near to one plane",
         shear_of(frame).value_or(""), ": resample it");
  }
  return whole;
}

// Returns the region of the grid to keep, as checked index ranges.
Roi region(const SampleGrid& grid, const Grid& at) {
  const Roi whole{{0, 0, 0}, grid.size()};
  if (grid.read.region) {
    try {
      return grid.read.region(at);
    } catch (const InputError& error) {
      fail(grid.name, error.what());
    }
  }
  if (!grid.read.roi) return whole;
  for (int axis = 0; axis < 3; ++axis) {
    const int lo = grid.read.roi->begin[axis], hi = grid.read.roi->end[axis];
    if (lo >= 0 && hi <= whole.end[axis] && hi - lo >= 2) continue;
    fail(grid.name, "region ", lo, ":", hi, " along ", "xyz"[axis],
         " is not two or more of the samples 0:", whole.end[axis]);
  }
  return *grid.read.roi;
}

template <class Word>
void swap_words(std::span<std::byte> bytes) {
  const FieldReader words(bytes, kSwappedOrder);
  for (std::size_t n = 0; n + sizeof(Word) <= bytes.size(); n += sizeof(Word)) {
    const Word swapped = words.get<Word>(n);
    std::memcpy(&bytes[n], &swapped, sizeof swapped);
  }
}

// Returns the places of the samples of a grid that is not among others.
SampleGrid::Among places_alone(const SampleGrid& grid) {
  const auto nx = static_cast<std::uint64_t>(grid.dims[0]);
  const std::uint64_t area = nx * static_cast<std::uint64_t>(grid.dims[1]);
  return {0, {1, nx, area}, area * static_cast<std::uint64_t>(grid.dims[2])};
}

// Returns a copy of the region's samples.
Buffer copy_region(const SampleGrid& grid, const Roi& roi, std::span<const std::byte> data) {
  const SampleGrid::Among at = grid.among.value_or(places_alone(grid));
  const auto length_of = [&](int axis) {
    return static_cast<std::size_t>(roi.end[axis] - roi.begin[axis]);
  };
  const std::size_t sample = size_of(grid.type), row = sample * length_of(0);
  Buffer buffer(row * length_of(1) * length_of(2));
  std::byte* to = buffer.data.get();
  for (int k = roi.begin.k; k < roi.end.k; ++k) {
    for (int j = roi.begin.j; j < roi.end.j; ++j, to += row) {
      const std::byte* from =
          data.data() + sample * (at.first + static_cast<std::size_t>(roi.begin.i) * at.steps[0] +
                                  static_cast<std::size_t>(j) * at.steps[1] +
                                  static_cast<std::size_t>(k) * at.steps[2]);
      if (at.steps[0] == 1) {
        std::memcpy(to, from, row);
        continue;
      }
      for (std::size_t n = 0; n < row; n += sample) {
        std::memcpy(to + n, from + n * at.steps[0], sample);
      }
    }
  }
  return buffer;
}

std::string size_fault(const SampleGrid& grid, std::uint64_t expected, std::uint64_t found) {
  return text(found < expected ? "data is too short" : "data is too long", ": ", describe(grid),
              " need ", expected, " bytes, found ", found);
}

template <class T>
void parse_samples(const SampleGrid& grid, const Bytes& data, bool more_may_follow,
                   std::span<std::byte> out) {
  TextCursor text(data.text());
  const std::size_t count = out.size() / sizeof(T);
  for (std::size_t n = 0; n < count; ++n) {
    const std::string_view word = text.word();
    if (word.empty())
      fail(data.name, "data is too short: ", describe(grid), " need ", count, " numbers, found ",
           n);
    T value{};
    const char* begin = word.data() + (word.size() > 1 && word[0] == '+' ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      fail(data.name, "sample ", n, " is ", quote(word), ", not a number of type ",
           name_of(grid.type));
    std::memcpy(&out[n * sizeof(T)], &value, sizeof value);
  }
  if (!more_may_follow && !text.word().empty())
    fail(data.name, "data is too long: more than the ", count, " numbers of ", describe(grid));
}

}  // namespace

void swap_bytes(std::span<std::byte> bytes, std::size_t word_size) {
  if (word_size == 2) swap_words<std::uint16_t>(bytes);
  if (word_size == 4) swap_words<std::uint32_t>(bytes);
  if (word_size == 8) swap_words<std::uint64_t>(bytes);
}

void SampleGrid::set_spacing(const Vec3& own) {
  // A negative spacing would mirror the axis unseen; NaN is refused where the steps are.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vec3 other = read.spacing.value_or(Vec3{nan, nan, nan});
  for (int axis = 0; axis < 3; ++axis) {
    Vec3& step = steps[static_cast<std::size_t>(axis)];
    step = {0, 0, 0};
    step[axis] = own[axis] > 0 ? own[axis] : other[axis];
  }
}

void SampleGrid::set_coordinates(std::size_t axis, std::span<const double> at) {
  for (const double x : at) places[axis].push_back(x - at[0]);
  origin = origin + at[0] / length(steps[axis]) * steps[axis];
}

bool has_directions(const SampleGrid& grid) {
  return std::ranges::all_of(grid.steps,
                             [](const Vec3& step) { return in_range(step) && length(step) > 0; });
}

std::string describe(const SampleGrid& grid) {
  return text(grid.dims[0], " x ", grid.dims[1], " x ", grid.dims[2], " ", name_of(grid.type),
              " samples", grid.among ? " of several volumes" : "");
}

std::uint64_t data_size(const SampleGrid& grid) {
  std::uint64_t bytes = size_of(grid.type);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t n = grid.dims[axis];
    const std::string samples = text(n, " samples along ", "xyz"[axis]);
    if (n < 1) fail(grid.name, samples, ": dimensions must be positive");
    if (n < 2) fail(grid.name, samples, ": a volume needs two or more along each axis");
    if (n > std::numeric_limits<int>::max()) fail(grid.name, samples, " are too many");
    const std::uint64_t limit = std::numeric_limits<std::ptrdiff_t>::max();
    if (bytes > limit / static_cast<std::uint64_t>(n))
      fail(grid.name, describe(grid), " are too many");
    bytes *= static_cast<std::uint64_t>(n);
  }
  return grid.among ? grid.among->count * size_of(grid.type) : bytes;
}

Bytes data_behind(const SampleGrid& grid, const Bytes& data, std::int64_t skip, const char* which) {
  const std::uint64_t needed = data_size(grid), found = data.size();
  if (skip == -1) return data.from(static_cast<std::size_t>(found - std::min(found, needed)));
  if (static_cast<std::uint64_t>(skip) > found)
    fail(data.name, "has ", found, " bytes, fewer than the ", skip, " ", which);
  return data.from(static_cast<std::size_t>(skip));
}

Grid grid_of_volume(const SampleGrid& grid) {
  const Grid whole = whole_grid(grid);
  if (const auto shear = shear_of(whole.frame()); shear && grid.log) {
    add_note(
        grid.log->notes, "sheared-grid", grid.name, "sheared grid", *shear,
        ": its mesh has the right shape, but D, angles and filters are measured as if the axes "
        "were at right angles");
  }
  if (!has_directions(grid) && grid.log) {
    add_warning(grid.log->notes, "axis-without-direction", grid.name,
                "an axis of it has no direction: all are taken as x, y, z, in no known space");
  }
  const Roi roi = region(grid, whole);
  const Index3 dims{roi.end.i - roi.begin.i, roi.end.j - roi.begin.j, roi.end.k - roi.begin.k};
  return grid.read.roi ? whole.cropped(roi.begin, dims) : whole.part(roi.begin, dims);
}

Volume volume_from_raw(const SampleGrid& grid, const Bytes& data) {
  const std::uint64_t expected = data_size(grid);
  if (data.size() != expected) fail(data.name, size_fault(grid, expected, data.size()));
  const Grid read = grid_of_volume(grid);
  const Index3 dims = read.dims();
  const Roi roi = region(grid, read.whole());
  const SampleGrid::Among alone = places_alone(grid), at = grid.among.value_or(alone);
  const bool whole_slices =
      dims.i == grid.dims[0] && dims.j == grid.dims[1] && at.steps == alone.steps;
  const std::byte* start =
      data.data.data() +
      size_of(grid.type) * (at.first + at.steps[2] * static_cast<std::size_t>(roi.begin.k));
  const bool aligned = reinterpret_cast<std::uintptr_t>(start) % size_of(grid.type) == 0;
  const bool is_wide = grid.type.wide != StoredType::Wide::no;
  if (whole_slices && aligned && !is_swapped(grid) && !is_wide) return {read, start, data.owner};

  Buffer samples = copy_region(grid, roi, data.data);
  if (is_swapped(grid)) swap_bytes(samples.span(), size_of(grid.type));
  const SampleType type = is_wide ? convert_wide(grid, samples.span()) : grid.type.type;
  const Bytes bytes = bytes_of(std::move(samples), data.name);
  return {read.of_type(type), bytes.data.data(), bytes.owner};
}

Volume volume_from_text(const SampleGrid& grid, const Bytes& data, bool more_may_follow) {
  const std::uint64_t expected = data_size(grid);
  const std::uint64_t count = expected / size_of(grid.type);
  // n numbers have 2n - 1 characters at least.
  if (count > data.size() / 2 + 1)
    fail(data.name, "data is too short: ", describe(grid), " do not fit in ", data.size(),
         " characters");
  Buffer buffer(static_cast<std::size_t>(expected));
  const auto parse = [&]<class T>(T) {
    parse_samples<T>(grid, data, more_may_follow, buffer.span());
  };
  if (grid.type.wide == StoredType::Wide::i64) {
    parse(std::int64_t{});
  } else if (grid.type.wide == StoredType::Wide::u64) {
    parse(std::uint64_t{});
  } else {
    with_type(grid.type, parse);
  }
  SampleGrid native = grid;
  native.byte_order = std::endian::native;
  return volume_from_raw(native, bytes_of(std::move(buffer), data.name));
}

Volume volume_from_compressed(const SampleGrid& grid, const Bytes& data, Wrapping wrapping,
                              std::uint64_t skip) {
  const std::uint64_t expected = data_size(grid);
  const std::uint64_t possible = largest_inflated(data.size());
  if (skip > possible || expected > possible - skip)
    fail(data.name, size_fault(grid, expected, data.size()), " compressed");
  Buffer buffer(static_cast<std::size_t>(skip + expected));
  const Inflated result = inflate(data.data, wrapping, buffer.span());
  if (result.fault) {
    fail(data.name, "compressed data is damaged: ", result.fault, " after ", result.size, " of ",
         buffer.size, " bytes");
  }
  if (result.size != buffer.size)
    fail(data.name, size_fault(grid, expected, result.size > skip ? result.size - skip : 0));
  if (!result.ended)
    fail(data.name, "data is too long: ", describe(grid), " need ", expected,
         " bytes, the compressed data holds more");
  const Bytes bytes = bytes_of(std::move(buffer), data.name);
  return volume_from_raw(grid, bytes.from(static_cast<std::size_t>(skip)));
}

Bytes start_of(const Bytes& bytes, std::size_t count) {
  if (!is_gzip(bytes)) return bytes.first(std::min(count, bytes.size()));
  Buffer start(count);
  const Inflated inflated = inflate(bytes.data, Wrapping::gzip, start.span());
  if (inflated.fault) fail(bytes.name, "compressed data is damaged: ", inflated.fault);
  return bytes_of(std::move(start), bytes.name).first(inflated.size);
}

Volume volume_behind(const SampleGrid& grid, const Bytes& bytes, std::uint64_t skip) {
  if (is_gzip(bytes)) return volume_from_compressed(grid, bytes, Wrapping::gzip, skip);
  if (skip > bytes.size())
    fail(bytes.name, "has ", bytes.size(), " bytes, its samples begin at ", skip);
  return volume_from_raw(grid, bytes.from(static_cast<std::size_t>(skip)));
}

Volume volume_from_slices(
    const SampleGrid& grid,
    const std::function<void(std::size_t k, std::span<std::byte> out)>& write_slice) {
  const std::size_t size = static_cast<std::size_t>(data_size(grid));
  const Roi roi =
      region(grid, whole_grid(grid));  // a fault of the geometry is found before the work
  const std::size_t slice = size / static_cast<std::size_t>(grid.dims[2]);
  // Not initialized: the system gives memory to the pages that are written.
  Buffer buffer(size);
  for (std::size_t k = static_cast<std::size_t>(roi.begin.k);
       k < static_cast<std::size_t>(roi.end.k); ++k) {
    write_slice(k, buffer.span().subspan(k * slice, slice));
  }
  SampleGrid native = grid;
  native.byte_order = std::endian::native;
  return volume_from_raw(native, bytes_of(std::move(buffer), grid.name));
}

}  // namespace deliso
