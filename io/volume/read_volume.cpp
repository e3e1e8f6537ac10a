// SPDX-License-Identifier: MIT
#include "io/volume/read_volume.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "io/files/text_scan.h"
#include "io/volume/builtin_volume.h"
#include "io/volume/foreign_formats.h"
#include "io/volume/several_volumes.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

struct Format {
  bool (*is_of)(const Bytes& bytes);
  Volume (*read)(const VolumeInput& input);
  bool has_named_arrays = false;
  bool has_several_volumes = false;
  bool has_place = true;  // a spacing and an origin
};
constexpr Format kFormats[] = {{looks_like_nrrd, read_nrrd, false, true},
                               {looks_like_vtk, read_vtk, true},
                               {looks_like_nifti, read_nifti, false, true},
                               {looks_like_vti, read_vti, true},
                               {looks_like_npy, read_npy, false, false, false},
                               {looks_like_mrc, read_mrc, false, true},
                               {looks_like_inr, read_inr, false, true},
                               {looks_like_dicom, read_dicom, false, true},
                               {looks_like_tiff, read_tiff, false, true, false},
                               {looks_like_metaimage, read_metaimage, false, true}};

void refuse_array(const std::string& name, const ReadOptions& options) {
  if (options.array)
    fail(name, "has no named arrays to take ", quote(*options.array), " of, as VTK files have");
}

// Throws if another channel or time than the first is chosen, where arrays have names.
void refuse_volumes(const VolumeInput& input) {
  if (input.options.channel.value_or(1) == 1 && input.options.time.value_or(1) == 1) return;
  fail(input.name(), "has named arrays, and no channels or times: --array names one");
}

Volume read_recognized(const VolumeInput& input) {
  if (input.options.raw) {
    refuse_array(input.name(), input.options);
    refuse_series(input.name(), input.options);
    choose_volume(input.name(), input.options, {});
    return read_raw(input);
  }
  for (const Format& format : kFormats) {
    if (!format.is_of(input.bytes)) continue;
    if (!format.has_named_arrays) refuse_array(input.name(), input.options);
    if (format.has_named_arrays) refuse_volumes(input);
    if (!format.has_several_volumes) choose_volume(input.name(), input.options, {});
    if (format.read != read_dicom) refuse_series(input.name(), input.options);
    if (format.has_place) note_place(input);
    return format.read(input);
  }
  refuse_file(input.bytes);
}

Volume read_as_stored(const std::string& input, const ReadOptions& options, ReadLog& log) {
  if (input.starts_with("builtin:")) {
    refuse_array(input, options);
    refuse_series(input, options);
    choose_volume(input, options, {});
    return make_builtin_volume(input, options);
  }
  const std::size_t slash = input.rfind('/');
  const std::string directory = slash == std::string::npos ? "" : input.substr(0, slash + 1);
  if (input == "-") return read_recognized({read_standard_input(), directory, options, log});
  std::error_code ignored;
  if (std::filesystem::is_directory(input, ignored)) {
    if (options.raw) refuse_folder(input);
    refuse_array(input, options);
    return read_folder({{input, {}, nullptr}, directory, options, log});
  }
  log.files.push_back(state_of(input));
  return read_recognized({open_file(input), directory, options, log});
}

[[noreturn]] void fail_option(std::string_view text, const char* wanted) {
  throw InputError(quote(text), " is not ", wanted);
}

std::optional<int> to_index(std::string_view text) {
  const std::optional<std::int64_t> value = to_int(text);
  if (!value || *value < 0 || *value > std::numeric_limits<int>::max()) return std::nullopt;
  return static_cast<int>(*value);
}

}  // namespace

Volume read_volume(const std::string& input, const ReadOptions& options, ReadLog* log) {
  ReadLog own_log;
  ReadLog& filled = log ? *log : own_log;
  try {
    const Volume stored = read_as_stored(input, options, filled);
    constexpr AnatomicalSpace unknown = AnatomicalSpace::unknown;
    if (options.space != unknown && stored.frame().space == unknown)
      fail(input, "names no patient's space, RAS or LPS, that --space could turn");
    return stored.with_frame(stored.frame().in_space(options.space));
  } catch (const std::bad_alloc&) {
    fail(input, "not enough memory to read it");
  } catch (const std::length_error&) {
    fail(input, "not enough memory to read it");
  }
}

void note_place(const VolumeInput& input) {
  if (input.options.spacing)
    input.note("spacing-given", "the spacing is that of --spacing, whatever the file says");
  if (input.options.coordinates != Coordinates()) {
    input.note("coordinates-given",
               "the coordinates are those of --coordinates, whatever the file says");
  }
  if (input.options.origin)
    input.note("origin-given", "the origin is that of --origin, whatever the file says");
}

std::vector<NamedSegment> read_segments(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return {};
  const Bytes bytes = open_file(path);
  if (looks_like_dicom(bytes)) return segments_of_dicom(bytes);
  return looks_like_nrrd(bytes) ? segments_of_nrrd(bytes) : std::vector<NamedSegment>();
}

void refuse_series(const std::string& name, const ReadOptions& options) {
  if (options.series) fail(name, "has no series to choose from, as a folder of DICOM has");
}

SampleGrid grid_of(const VolumeInput& input) {
  SampleGrid grid;
  grid.name = input.name();
  grid.read = input.options;
  grid.is_of_file = true;
  grid.log = &input.log;
  return grid;
}

Bytes open_data_file(const VolumeInput& input, std::string_view file_name) {
  if (file_name.empty()) fail(input.name(), "names no data file");
  const bool absolute = file_name[0] == '/';
  const std::string path = (absolute ? "" : input.directory) + std::string(file_name);
  input.log.files.push_back(state_of(path));
  try {
    return open_file(path, NamedBy::file);
  } catch (const InputError& error) {
    fail(input.name(), "its data file ", error.what());
  }
}

StoredType supported_type(const VolumeInput& input, std::string_view name) {
  if (const std::optional<StoredType> type = sample_type_named(name)) return *type;
  fail(input.name(), "sample type ", quote(name),
       " is not supported (integers of 8 to 64 bits, float32, float64 are)");
}

std::optional<StoredType> sample_type_named(std::string_view name) {
  std::string plain = lower(trimmed(name));
  for (char& c : plain)
    if (c == '_') c = ' ';
  if (plain.starts_with("met ")) plain.erase(0, 4);
  if (plain.ends_with(" t")) plain.resize(plain.size() - 2);
  using Wide = StoredType::Wide;
  constexpr std::pair<StoredType, std::string_view> kSpellings[] = {
      {SampleType::u8, "uint8,uchar,unsigned char"},
      {SampleType::i8, "int8,char,signed char"},
      {SampleType::u16, "uint16,ushort,unsigned short,unsigned short int"},
      {SampleType::i16, "int16,short,short int,signed short,signed short int"},
      {SampleType::u32, "uint32,uint,unsigned int"},
      {SampleType::i32, "int32,int,signed int"},
      {Wide::i64, "int64,long long,long long int,signed long long,signed long long int,longlong"},
      {Wide::u64, "uint64,unsigned long long,unsigned long long int,ulonglong,ulong long"},
      {SampleType::f32, "float32,float"},
      {SampleType::f64, "float64,double"}};
  for (const auto& [type, spellings] : kSpellings) {
    if (std::ranges::count(split(spellings, ','), plain) > 0) return type;
  }
  return std::nullopt;
}

Roi parse_roi(std::string_view text) {
  constexpr const char* wanted = "a region like 0:64,0:64,10:32";
  const std::vector<std::string_view> axes = split(text, ',');
  if (axes.size() != 3) fail_option(text, wanted);
  Roi roi;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<std::string_view> ends = split(axes[static_cast<std::size_t>(axis)], ':');
    const std::optional<int> begin = to_index(ends.front()), end = to_index(ends.back());
    if (ends.size() != 2 || !begin || !end || *begin >= *end) fail_option(text, wanted);
    roi.begin[axis] = *begin;
    roi.end[axis] = *end;
  }
  return roi;
}

Index3 parse_dims(std::string_view text) {
  constexpr const char* wanted = "dimensions like 256x256x128";
  const std::vector<std::string_view> parts = split(text, 'x');
  if (parts.size() != 3) fail_option(text, wanted);
  Index3 dims;
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<int> n = to_index(parts[static_cast<std::size_t>(axis)]);
    if (!n) fail_option(text, wanted);
    dims[axis] = *n;
  }
  return dims;
}

Coordinates read_coordinates(const std::string& path) {
  const Bytes bytes = open_file(path);
  TextCursor lines(bytes.text());
  Coordinates coordinates;
  while (!lines.at_end()) {
    const std::string_view line = trimmed(lines.line());
    if (line.empty() || line[0] == '#') continue;
    const std::size_t axis = std::string_view("xyz").find(line[0]);
    const std::optional<std::vector<double>> numbers = to_doubles(line.substr(1));
    if (axis == std::string_view::npos || !numbers || numbers->size() < 2) {
      fail(path,
           "has a line that is no x, y or z with two or more numbers: ", quote(line.substr(0, 40)));
    }
    if (!coordinates[axis].empty()) fail(path, "has the coordinates along ", line[0], " twice");
    coordinates[axis] = *numbers;
  }
  return coordinates;
}

StoredType parse_sample_type(std::string_view text) {
  if (const std::optional<StoredType> type = sample_type_named(text)) return *type;
  fail_option(
      text,
      "a sample type (uint8, int8, uint16, int16, uint32, int32, uint64, int64, float32, float64)");
}

}  // namespace deliso
