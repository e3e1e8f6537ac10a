// SPDX-License-Identifier: MIT
// The pages of a TIFF file are the slices of a volume, with row 0 at y = 0; or the files of a
// folder are, of one page each. Grayscale only.
//
// A page does not tell the distance to the next. ImageJ and OME-TIFF write it into the first page's
// description; else samples are one apart, or as the option says. ImageJ also writes a stack of
// over 4 GB as one page, with the others behind it. Both tell which pages are of which channel and
// time.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "base/text.h"
#include "io/files/text_scan.h"
#include "io/files/vtk_xml.h"
#include "io/volume/sample_grid.h"
#include "io/volume/scaled_samples.h"
#include "io/volume/several_volumes.h"
#include "io/volume/tiff_file.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

using namespace std::string_view_literals;

constexpr std::pair<std::uint64_t, std::string_view> kColors[] = {
    {2, "RGB"}, {3, "a palette"}, {5, "CMYK"}, {6, "YCbCr"}, {8, "CIELab"}};

StoredType sample_type(const VolumeInput& input, const TiffPage& page) {
  for (const auto& [code, name] : kColors) {
    if (page.photometric == code) {
      fail(input.name(), "is in color (", name, "): only grayscale can be meshed");
    }
  }
  if (page.samples != 1) {
    fail(input.name(), "has ", page.samples, " samples per pixel: only grayscale can be meshed");
  }
  // Format 4 is "undefined", and used like 1.
  const std::uint64_t wanted = page.sample_format == 4 ? 1 : page.sample_format;
  if (wanted == 1 && is_packed(page)) return page.word() == 1 ? SampleType::u8 : SampleType::u16;
  using Wide = StoredType::Wide;
  constexpr std::tuple<std::uint64_t, std::uint64_t, StoredType> kTypes[] = {
      {1, 8, SampleType::u8},   {2, 8, SampleType::i8},   {1, 16, SampleType::u16},
      {2, 16, SampleType::i16}, {1, 32, SampleType::u32}, {2, 32, SampleType::i32},
      {1, 64, Wide::u64},       {2, 64, Wide::i64},       {3, 32, SampleType::f32},
      {3, 64, SampleType::f64}};
  for (const auto& [format, bits, type] : kTypes) {
    if (format == wanted && bits == page.bits) return type;
  }
  const std::string_view kind = page.sample_format == 1   ? "unsigned integers"
                                : page.sample_format == 2 ? "signed integers"
                                : page.sample_format == 3 ? "floating point numbers"
                                                          : "complex numbers";
  fail(input.name(), "its samples are ", kind, " of ", page.bits,
       " bits (unsigned integers of 1 to 16, 32 and 64, signed ones of 8, 16, 32 and 64, floating "
       "point of 32 and 64 are read)");
}

// Refuses a page that cannot be read, or does not go with the first. Messages call them `name` and
// `first_name`.
void check_page(const TiffFile& tiff, const TiffPage& page, const std::string& name,
                const TiffPage& first, const std::string& first_name) {
  if (page.width != first.width || page.height != first.height) {
    fail(tiff.bytes().name, name, " has ", page.width, " x ", page.height, " samples, and ",
         first_name, " ", first.width, " x ", first.height);
  }
  if (page.bits != first.bits || page.sample_format != first.sample_format ||
      page.samples != first.samples || page.photometric != first.photometric) {
    fail(tiff.bytes().name, name, " has samples of another type than ", first_name);
  }
  tiff.check_encoding(page, name);
}

// What a description says: lines "key=value" (ImageJ), or attributes key="value" (OME).
class Description {
 public:
  explicit Description(std::string_view text)
      : text_(text), is_imagej_(text.starts_with("ImageJ=")) {
    const std::size_t pixels = text.find("<Pixels ");
    if (pixels != std::string_view::npos) {
      is_ome_ = true;
      const std::size_t end = std::min(text.find('>', pixels), text.size());
      text_ = text.substr(pixels, end - pixels);
      inside_ = text.substr(end, text.find("</Pixels>", end) - end);
    }
  }

  bool is_imagej() const { return is_imagej_; }
  bool is_ome() const { return is_ome_; }
  VolumeCounts counts() const {
    if (is_imagej_) return {count("channels"), count("frames")};
    return is_ome_ ? VolumeCounts{count("SizeC"), count("SizeT")} : VolumeCounts{};
  }
  std::string_view inside() const { return inside_; }  // the elements in OME's Pixels
  // Returns the value of a key; empty if there is none.
  std::string_view operator()(std::string_view key) const {
    const std::string start = is_ome_ ? text(" ", key, "=\"") : text("\n", key, "=");
    const std::size_t at = text_.find(start);
    if (at == std::string_view::npos) return "";
    const std::string_view rest = text_.substr(at + start.size());
    return trimmed(rest.substr(0, rest.find(is_ome_ ? '"' : '\n')));
  }
  std::int64_t count(std::string_view key) const { return to_int((*this)(key)).value_or(1); }
  double number(std::string_view key) const { return to_double((*this)(key)).value_or(0); }

 private:
  std::string_view text_, inside_;
  bool is_imagej_ = false, is_ome_ = false;
};

// Units of length as OME and ImageJ spell them, each a power of ten of a meter.
struct Unit {
  std::string_view name;
  int power;
};
constexpr Unit kUnits[] = {{"km", 3},       {"m", 0},        {"dm", -1},      {"cm", -2},
                           {"mm", -3},      {"\u00b5m", -6}, {"\u03bcm", -6}, {"\\u00B5m", -6},
                           {"um", -6},      {"micron", -6},  {"microns", -6}, {"nm", -9},
                           {"\u00c5", -10}, {"pm", -12},     {"fm", -15}};

// Returns lengths along x, y and z, each with its own unit, all in the unit of x. Refuses units
// that differ where one is not known. `names`: the keys of the units.
Vec3 in_unit_of_x(const VolumeInput& input, Vec3 lengths,
                  const std::array<std::string_view, 3>& units,
                  const std::array<std::string_view, 3>& names) {
  if (units[1] == units[0] && units[2] == units[0]) return lengths;
  std::array<int, 3> powers{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto known = std::ranges::find(kUnits, units[axis], &Unit::name);
    if (known == std::end(kUnits)) {
      fail(input.name(), "its axes have different units, and ", names[axis], " is ",
           quote(units[axis]), ": --spacing X,Y,Z gives the distances");
    }
    powers[axis] = known->power;
  }
  for (int axis = 1; axis < 3; ++axis) {
    const int power = powers[static_cast<std::size_t>(axis)] - powers[0];
    // Powers of ten up to 22 are doubles: each step rounds once.
    double scale = 1;
    for (int n = 0; n < std::abs(power); ++n) scale *= 10;
    lengths[axis] = power < 0 ? lengths[axis] / scale : lengths[axis] * scale;
  }
  return lengths;
}

// Returns the distance of samples along x, y and z.
Vec3 spacing_of(const VolumeInput& input, const TiffFile& tiff, const Description& description) {
  if (input.options.spacing) return *input.options.spacing;
  const TiffPage& page = tiff.pages()[0];
  const double per_unit[] = {tiff.ratio(page.x_resolution), tiff.ratio(page.y_resolution)};
  const bool has_resolution = per_unit[0] > 0 && per_unit[1] > 0;
  if (description.is_ome()) {
    const Vec3 sizes{description.number("PhysicalSizeX"), description.number("PhysicalSizeY"),
                     description.number("PhysicalSizeZ")};
    if (!(sizes.x > 0 && sizes.y > 0 && sizes.z > 0)) return {1, 1, 1};
    constexpr std::array kNames{"PhysicalSizeXUnit"sv, "PhysicalSizeYUnit"sv,
                                "PhysicalSizeZUnit"sv};
    std::array<std::string_view, 3> units;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      units[axis] = description(kNames[axis]);
      if (units[axis].empty()) units[axis] = "\u00b5m";
    }
    const Vec3 spacing = in_unit_of_x(input, sizes, units, kNames);
    input.note("unit-of-file", "the spacing is in ", quote(units[0]), ", as OME has it");
    return spacing;
  }
  if (description.is_imagej()) {
    const std::string_view unit = description("unit");
    const double depth = std::abs(description.number("spacing"));
    Vec3 spacing{1, 1, depth > 0 ? depth : 1};
    if (has_resolution && (!unit.empty() || page.resolution_unit == 1)) {
      spacing.x = 1 / per_unit[0];
      spacing.y = 1 / per_unit[1];
    }
    if (unit.empty()) return spacing;
    constexpr std::array kNames{"unit"sv, "yunit"sv, "zunit"sv};
    std::array units{unit, description("yunit"), description("zunit")};  // if they are unlike x's
    for (std::string_view& own : units) own = own.empty() ? unit : own;
    spacing = in_unit_of_x(input, spacing, units, kNames);
    input.note("unit-of-file", "the spacing is in ", quote(unit), ", as ImageJ has it");
    return spacing;
  }
  if (has_resolution && page.resolution_unit != 1) {
    input.warn("page-distance-unknown",
               "has a resolution, but not the distance of its pages: samples are taken to be 1 "
               "apart; --spacing gives another distance");
  }
  return {1, 1, 1};
}

// Returns the axes of the planes of a file: z, channels and times, the fastest first. ImageJ has
// channels first, OME tells the order.
std::vector<DataAxis> axes_of(const VolumeInput& input, const Description& description,
                              std::int64_t planes) {
  std::string_view order = description.is_ome() ? description("DimensionOrder") : "XYCZT";
  if (order.empty()) order = "XYZCT";
  if (!order.starts_with("XY") || !std::ranges::is_permutation(order.substr(2), "ZCT"sv)) {
    fail(input.name(), "its DimensionOrder is ", quote(order), ", not XY and Z, C, T");
  }
  VolumeCounts counts = description.counts();
  // Programs that write the slices of a volume without saying so: ImageJ takes them for channels.
  if (description.is_imagej() && description.count("slices") == 1 &&
      (counts.channels == planes || counts.times == planes)) {
    input.note("channels-as-slices", "its ", planes, counts.times == 1 ? " channels" : " times",
               " of one slice are taken as slices");
    counts = {};
  }
  const bool is_one = counts.channels == 1 && counts.times == 1;
  std::vector<DataAxis> axes;
  for (const char axis : order.substr(2)) {
    if (axis == 'C') axes.push_back({DataAxis::Kind::channel, counts.channels});
    if (axis == 'T') axes.push_back({DataAxis::Kind::time, counts.times});
    if (axis == 'Z') {
      const std::int64_t depth = description.count(description.is_ome() ? "SizeZ" : "slices");
      axes.push_back({DataAxis::Kind::z, is_one ? planes : depth});
    }
  }
  return axes;
}

// Returns the page of each plane: OME may number them in another order than they come in.
std::vector<std::size_t> pages_of_planes(const VolumeInput& input, const Description& description,
                                         std::span<const DataAxis> axes, std::size_t pages) {
  std::vector<std::size_t> page_of(pages);
  std::iota(page_of.begin(), page_of.end(), std::size_t{0});
  const auto most = static_cast<std::int64_t>(pages);
  std::int64_t told = 0;
  for (XmlTag tag = next_tag(description.inside(), 0); !tag.name.empty();
       tag = next_tag(description.inside(), tag.end)) {
    if (tag.name != "TiffData") continue;
    const auto number = [&](const char* key, std::int64_t missing) {
      return to_int(tag.attribute(key).value_or("")).value_or(missing);
    };
    const std::int64_t page = number("IFD", 0);
    std::int64_t plane = 0, step = 1;
    for (const DataAxis& axis : axes) {
      const char* first = axis.kind == DataAxis::Kind::z         ? "FirstZ"
                          : axis.kind == DataAxis::Kind::channel ? "FirstC"
                                                                 : "FirstT";
      plane += step * std::clamp<std::int64_t>(number(first, 0), 0, most);
      step *= axis.size;
    }
    const std::int64_t rest = most - std::max(plane, page);
    const std::int64_t count = number("PlaneCount", tag.attribute("IFD") ? 1 : rest);
    if (page < 0 || count < 1 || count > rest || count > most - told) {
      fail(input.name(), "its TiffData are of pages that it does not have: give a file with all");
    }
    told += count;
    for (std::int64_t n = 0; n < count; ++n) {
      page_of[static_cast<std::size_t>(plane + n)] = static_cast<std::size_t>(page + n);
    }
  }
  return page_of;
}

// Returns the grid of `count` slices like the first page of `tiff`, the file of `input`.
SampleGrid grid_of(const VolumeInput& input, const TiffFile& tiff, std::int64_t count) {
  const TiffPage& page = tiff.pages()[0];
  SampleGrid grid = grid_of(input);
  grid.type = sample_type(input, page);
  grid.byte_order = tiff.order();
  const auto length = [](std::uint64_t n) {  // data_size() refuses what is over kLargestTiffSize
    return static_cast<std::int64_t>(std::min(n, kLargestTiffSize + 1));
  };
  grid.dims = {length(page.width), length(page.height), count};
  return grid;
}

void set_spacing(SampleGrid& grid, const VolumeInput& input, const TiffFile& tiff,
                 const Description& description) {
  grid.set_spacing(spacing_of(input, tiff, description));
  if (tiff.pages()[0].photometric == 0) {
    input.note("inverted-gray",
               "its small samples are shown bright (WhiteIsZero); they are kept as stored");
  }
}

// ImageJ has signed samples as unsigned ones with a calibration function, 0 for a straight line.
Volume calibrated(const VolumeInput& input, const Description& description, Volume volume) {
  if (!description.is_imagej() || description("cf") != "0") return volume;
  const double slope = description.number("c1"), intercept = description.number("c0");
  if (!(slope != 0 && std::abs(slope) < 1e30 && std::abs(intercept) < 1e30)) return volume;
  return scaled_volume(input, volume, slope, intercept);
}

}  // namespace

bool looks_like_tiff(const Bytes& bytes) {
  for (const std::string_view magic : {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv}) {
    if (bytes.text().starts_with(magic)) return true;
  }
  return false;
}

Volume read_tiff(const VolumeInput& input) {
  const TiffFile tiff(input.bytes);
  const TiffPage& first = tiff.pages()[0];
  const Description description(tiff.text_of(first.description));
  const std::size_t pages = tiff.pages().size();
  const std::int64_t images = description.is_imagej() ? description.count("images") : 1;
  const bool has_hidden_pages = pages == 1 && images > 1;
  const std::int64_t planes = has_hidden_pages ? images : static_cast<std::int64_t>(pages);
  if (planes == 1) {
    fail(input.name(), "has one page: give the folder of the slices, if each has a file");
  }
  SampleGrid grid = grid_of(input, tiff, planes);
  std::vector<DataAxis> axes = axes_of(input, description, planes);
  axes.insert(axes.begin(), {{DataAxis::Kind::x, grid.dims[0]}, {DataAxis::Kind::y, grid.dims[1]}});
  set_axes(grid, axes);
  const auto area = static_cast<std::uint64_t>(grid.dims[0] * grid.dims[1]);
  if (const std::uint64_t count = data_size(grid) / size_of(grid.type) / area;
      count != static_cast<std::uint64_t>(planes)) {
    fail(input.name(), "has ", planes, " pages, and a description of ", count);
  }
  for (std::size_t n = 0; n < pages; ++n) {
    check_page(tiff, tiff.pages()[n], text("page ", n + 1), first, "page 1");
  }
  set_spacing(grid, input, tiff, description);

  const std::optional<std::uint64_t> begin = tiff.find_samples();
  if (has_hidden_pages && !begin)
    fail(input.name(), "has one page, and ImageJ's others are not behind it");
  const std::vector<std::size_t> page_of =
      pages_of_planes(input, description, std::span(axes).subspan(2), pages);
  const bool as_they_come =
      std::ranges::adjacent_find(page_of, std::greater_equal()) == page_of.end();
  if (begin && as_they_come) {
    const std::uint64_t size = data_size(grid);
    const Bytes data = input.bytes.from(*begin);
    return calibrated(
        input, description,
        volume_from_raw(grid, data.first(std::min<std::uint64_t>(size, data.size()))));
  }
  input.options.budget.require(input.name(), input.bytes.size(), data_size(grid));
  const SampleGrid::Among among = grid.among.value_or(SampleGrid::Among{0, {0, 0, area}, 0});
  grid.among.reset();
  return calibrated(input, description,
                    volume_from_slices(grid, [&](std::size_t k, std::span<std::byte> out) {
                      const std::uint64_t plane = (among.first + k * among.steps[2]) / area;
                      tiff.read_page(tiff.pages()[page_of[plane]], out);
                    }));
}

Volume read_tiff_slices(const VolumeInput& input, std::vector<Bytes> files) {
  std::ranges::sort(files, {}, [](const Bytes& file) { return with_long_numbers(file.name); });
  std::vector<TiffFile> slices;
  for (const Bytes& file : files) {
    const TiffFile& slice = slices.emplace_back(file);
    if (slice.pages().size() == 1) continue;
    fail(file.name, "has ", slice.pages().size(),
         " pages: in a folder of slices each file has one");
  }
  if (files.size() == 1) fail(input.name(), "has one slice only");
  const VolumeInput first{files[0], input.directory, input.options, input.log};
  const Description description(slices[0].text_of(slices[0].pages()[0].description));
  const VolumeCounts counts = description.counts();
  if (counts.channels != 1 || counts.times != 1) {
    fail(first.name(), "is of several channels or times: give one file that has them all");
  }
  SampleGrid grid = grid_of(first, slices[0], static_cast<std::int64_t>(files.size()));
  grid.name = input.name();
  std::uint64_t stored = 0;
  for (const Bytes& file : files) stored += file.size();
  input.options.budget.require(input.name(), stored, data_size(grid));
  const auto file_name = [&](std::size_t k) {
    return std::filesystem::path(files[k].name).filename().string();
  };
  for (const TiffFile& slice : slices) {
    check_page(slice, slice.pages()[0], "its page", slices[0].pages()[0], file_name(0));
    slice.find_samples();
    input.log.files.push_back(state_of(slice.bytes().name));
  }
  set_spacing(grid, first, slices[0], description);
  input.note("slice-count", files.size(), " slices, from '", file_name(0), "' to '",
             file_name(files.size() - 1), "'");
  return calibrated(first, description,
                    volume_from_slices(grid, [&](std::size_t k, std::span<std::byte> out) {
                      slices[k].read_page(slices[k].pages()[0], out);
                    }));
}

}  // namespace deliso
