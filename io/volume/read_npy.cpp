// SPDX-License-Identifier: MIT
// NumPy's .npy, versions 1 to 3 (numpy.lib.format): a magic number, the length of the header, the
// header, which is a Python dictionary in text, and the samples.
//
// An array is indexed [z][y][x], as scikit-image and SimpleITK have it: in C order x runs fastest,
// in Fortran order z does.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text.h"
#include "io/files/field_reader.h"
#include "io/files/text_scan.h"
#include "io/volume/sample_grid.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kVersionEnd = 8;
constexpr std::size_t kMostAxes = 64;  // of NumPy 2; NumPy 1 has 32

// Returns the text behind 'key': in the header, without leading blanks.
std::string_view value_of(const VolumeInput& input, std::string_view header, std::string_view key) {
  const std::size_t at = header.find(text("'", key, "':"));
  if (at == std::string_view::npos) fail(input.name(), "the header has no key ", quote(key));
  return trimmed(header.substr(at + key.size() + 3));
}

// Returns the text between `open` and the next `close`, if `text` begins with `open`.
std::string_view between(const VolumeInput& input, std::string_view text, char open, char close,
                         const char* wanted) {
  const std::size_t end = text.find(close, 1);
  if (!text.starts_with(open) || end == std::string_view::npos) {
    fail(input.name(), "the header has ", quote(text.substr(0, 20)), " in place of ", wanted);
  }
  return text.substr(1, end - 1);
}

// Returns the lengths of the axes, slowest first in C order. Axes of length 1 beyond three are
// left out.
std::vector<std::int64_t> shape_of(const VolumeInput& input, std::string_view header) {
  std::string lengths(between(input, value_of(input, header, "shape"), '(', ')', "a shape"));
  std::ranges::replace(lengths, ',', ' ');
  std::optional<std::vector<std::int64_t>> shape = to_ints(lengths);
  if (!shape) fail(input.name(), "the shape (", lengths, ") is not of integers");
  if (shape->size() <= kMostAxes) {  // each removal costs the length of the shape
    for (std::size_t n = shape->size(); n-- > 0 && shape->size() > 3;) {
      if ((*shape)[n] == 1) shape->erase(shape->begin() + static_cast<std::ptrdiff_t>(n));
    }
  }
  if (shape->size() != 3) {
    fail(input.name(), "is an array of ", shape->size(),
         " dimensions: only three-dimensional ones can be meshed");
  }
  return *shape;
}

struct NpySamples {
  StoredType type = SampleType::u8;
  std::endian byte_order = std::endian::little;
};

NpySamples samples_of(const VolumeInput& input, std::string_view header) {
  const std::string_view descr =
      between(input, value_of(input, header, "descr"), '\'', '\'', "a plain type");
  NpySamples samples;
  if (descr.starts_with('>')) samples.byte_order = std::endian::big;
  const std::string_view kind = descr.substr(std::min<std::size_t>(1, descr.size()));
  using Wide = StoredType::Wide;
  constexpr std::pair<std::string_view, StoredType> kKinds[] = {
      {"b1", SampleType::u8},  {"u1", SampleType::u8},  {"i1", SampleType::i8},
      {"u2", SampleType::u16}, {"i2", SampleType::i16}, {"u4", SampleType::u32},
      {"i4", SampleType::i32}, {"f4", SampleType::f32}, {"f8", SampleType::f64},
      {"i8", Wide::i64},       {"u8", Wide::u64}};
  for (const auto& [name, type] : kKinds) {
    if (kind != name) continue;
    samples.type = type;
    return samples;
  }
  fail(input.name(), "samples of type ", quote(descr),
       " are not supported: write the array with astype('float32')");
}

}  // namespace

bool looks_like_npy(const Bytes& bytes) {
  return bytes.text().starts_with(kMagic);
}

Volume read_npy(const VolumeInput& input) {
  const Bytes& bytes = input.bytes;
  const FieldReader fields(bytes.data, std::endian::little);
  const std::size_t major =
      bytes.size() > kMagic.size() ? fields.get<std::uint8_t>(kMagic.size()) : 0;
  const std::size_t length_size = major == 1 ? 2 : 4;
  if (major < 1 || major > 3) {
    fail(input.name(), "has version ", major, " of .npy: 1, 2 and 3 are known");
  }
  const std::size_t begin = kVersionEnd + length_size;
  if (bytes.size() < begin) fail(input.name(), "ends in the header");
  const std::size_t length =
      major == 1 ? fields.get<std::uint16_t>(kVersionEnd) : fields.get<std::uint32_t>(kVersionEnd);
  if (bytes.size() - begin < length) fail(input.name(), "ends in the header");
  const std::string_view header = bytes.text().substr(begin, length);

  const std::vector<std::int64_t> shape = shape_of(input, header);
  const NpySamples samples = samples_of(input, header);
  const std::string_view order = value_of(input, header, "fortran_order");
  const bool is_fortran = order.starts_with("True");
  if (!is_fortran && !order.starts_with("False")) {
    fail(input.name(), "the header's fortran_order is neither True nor False");
  }

  SampleGrid grid = grid_of(input);
  grid.type = samples.type;
  grid.byte_order = samples.byte_order;
  for (std::size_t n = 0; n < 3; ++n) grid.dims[n] = shape[is_fortran ? n : 2 - n];
  if (is_fortran) {  // a spacing of the options is along the world's axes
    std::swap(grid.steps[0], grid.steps[2]);
    if (grid.read.spacing) std::swap(grid.read.spacing->x, grid.read.spacing->z);
  }
  return volume_from_raw(grid, bytes.from(begin + length));
}

}  // namespace deliso
