// SPDX-License-Identifier: MIT
// TIFF (6.0, with supplement 2) and BigTIFF: the pages of a file are the slices of a volume, with
// row 0 at y = 0. Grayscale in strips or tiles.
//
// A page does not tell the distance to the next. ImageJ and OME-TIFF write it into the first page's
// description; else samples are one apart, or as the option says. ImageJ also writes a stack of
// over 4 GB as one page, with the others behind it.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "base/text.h"
#include "io/files/field_reader.h"
#include "io/files/inflate.h"
#include "io/files/lzw.h"
#include "io/files/packbits.h"
#include "io/files/text_scan.h"
#include "io/volume/sample_grid.h"
#include "io/volume/scaled_samples.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

using namespace std::string_view_literals;

constexpr std::uint64_t kPlain = 1, kLzw = 5, kDeflate = 8, kOldDeflate = 32946, kPackBits = 32773;
constexpr std::uint64_t kLargest = std::numeric_limits<int>::max();

constexpr std::pair<std::uint64_t, std::string_view> kOtherCompressions[] = {
    {2, "CCITT"},    {3, "fax"},           {4, "fax"},      {6, "JPEG"},          {7, "JPEG"},
    {34887, "LERC"}, {34712, "JPEG 2000"}, {34925, "LZMA"}, {50000, "Zstandard"}, {50001, "WebP"}};
constexpr std::pair<std::uint64_t, std::string_view> kColors[] = {
    {2, "RGB"}, {3, "a palette"}, {5, "CMYK"}, {6, "YCbCr"}, {8, "CIELab"}};

// The values of a tag.
struct Field {
  std::uint64_t type = 0, count = 0, at = 0;
};

struct Page {
  std::uint64_t subfile = 0, width = 0, height = 0, bits = 1, compression = kPlain, photometric = 1,
                samples = 1, rows_per_strip = kLargest, resolution_unit = 2, predictor = 1,
                tile_width = 0, tile_height = 0, sample_format = 1, fill_order = 1;
  Field offsets, sizes, description, x_resolution, y_resolution;
};

constexpr std::pair<std::uint64_t, std::uint64_t Page::*> kNumbers[] = {
    {254, &Page::subfile},        {256, &Page::width},
    {257, &Page::height},         {258, &Page::bits},
    {259, &Page::compression},    {262, &Page::photometric},
    {266, &Page::fill_order},     {277, &Page::samples},
    {278, &Page::rows_per_strip}, {296, &Page::resolution_unit},
    {317, &Page::predictor},      {322, &Page::tile_width},
    {323, &Page::tile_height},    {339, &Page::sample_format}};
// The offsets and sizes of strips, and those of tiles.
constexpr std::pair<std::uint64_t, Field Page::*> kFields[] = {
    {270, &Page::description},  {273, &Page::offsets},      {279, &Page::sizes},
    {282, &Page::x_resolution}, {283, &Page::y_resolution}, {324, &Page::offsets},
    {325, &Page::sizes}};

// A strip or a tile.
struct Block {
  std::uint64_t at = 0, size = 0;       // in the file
  std::uint64_t x = 0, y = 0;           // in the page
  std::uint64_t width = 0, height = 0;  // as stored
};

class TiffFile {
 public:
  explicit TiffFile(const Bytes& bytes)
      : bytes_(bytes),
        order_(bytes.text().starts_with('M') ? std::endian::big : std::endian::little),
        is_big_(number(2, 2) == 43) {
    std::set<std::uint64_t> seen;
    std::uint64_t at = is_big_ ? number(8, 8) : number(4, 4);
    while (at != 0) {
      if (!seen.insert(at).second) fail(bytes_.name, "its pages follow each other in a circle");
      at = read_page(at);
    }
  }

  std::endian order() const { return order_; }
  std::vector<Page>& pages() { return pages_; }
  const std::vector<Page>& pages() const { return pages_; }

  // Returns value `n` of a field of integers.
  std::uint64_t value(const Field& field, std::uint64_t n) const {
    const std::uint64_t size = size_of_type(field.type);
    if (n >= field.count || field.type == 5) fail_damaged(field.at);
    return number(field.at + n * size, size);
  }
  // Returns the first value of a field of rational numbers; 0 if there is none.
  double ratio(const Field& field) const {
    if (field.type != 5 || field.count == 0) return 0;
    const double down = static_cast<double>(number(field.at + 4, 4));
    return down == 0 ? 0 : static_cast<double>(number(field.at, 4)) / down;
  }
  std::string_view text_of(const Field& field) const {
    if (field.type != 2 || field.at > bytes_.size()) return "";
    const std::string_view text = bytes_.text().substr(field.at, field.count);
    return text.substr(0, text.find('\0'));
  }

  // Calls f for the blocks of a page, row by row.
  template <class F>
  void for_each_block(const Page& page, F f) const {
    const bool is_tiled = page.tile_width > 0;
    const std::uint64_t width = is_tiled ? page.tile_width : page.width;
    const std::uint64_t height = is_tiled ? page.tile_height : page.rows_per_strip;
    std::uint64_t n = 0;
    for (std::uint64_t y = 0; y < page.height; y += height) {
      for (std::uint64_t x = 0; x < page.width; x += width, ++n) {
        Block block{.at = value(page.offsets, n), .x = x, .y = y, .width = width};
        block.height = is_tiled ? height : std::min(height, page.height - y);
        if (page.compression == kPlain) {
          block.size = block.width * block.height * (page.bits / 8);
        } else {
          block.size = value(page.sizes, n);
        }
        f(block);
      }
    }
  }

  [[noreturn]] void fail_damaged(std::uint64_t at) const {
    fail(bytes_.name, text("is damaged, or ends too early: see byte ", at));
  }

 private:
  // Returns the integer of `size` bytes at `at`.
  std::uint64_t number(std::uint64_t at, std::uint64_t size) const {
    if (at > bytes_.size() || bytes_.size() - at < size) fail_damaged(at);
    const FieldReader fields(bytes_.data, order_);
    if (size == 1) return fields.get<std::uint8_t>(at);
    if (size == 2) return fields.get<std::uint16_t>(at);
    if (size == 4) return fields.get<std::uint32_t>(at);
    return fields.get<std::uint64_t>(at);
  }

  static std::uint64_t size_of_type(std::uint64_t type) {
    constexpr std::uint64_t kSizes[] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};
    return type < std::size(kSizes) ? kSizes[type] : 0;
  }

  // Returns the place of the next page; 0 at the last.
  std::uint64_t read_page(std::uint64_t at) {
    const std::uint64_t count_size = is_big_ ? 8 : 2, entry_size = is_big_ ? 20 : 12;
    const std::uint64_t value_size = is_big_ ? 8 : 4;
    const std::uint64_t count = number(at, count_size);
    if (count > bytes_.size() / entry_size) fail_damaged(at);
    Page page;
    for (std::uint64_t n = 0; n < count; ++n) {
      const std::uint64_t entry = at + count_size + n * entry_size;
      Field field{number(entry + 2, 2), number(entry + 4, value_size), entry + 4 + value_size};
      const std::uint64_t size = size_of_type(field.type);
      if (size == 0 || field.count == 0) continue;
      if (field.count > value_size / size) field.at = number(field.at, value_size);
      keep(page, number(entry, 2), field);
    }
    pages_.push_back(page);
    return number(at + count_size + count * entry_size, value_size);
  }

  void keep(Page& page, std::uint64_t tag, const Field& field) const {
    for (const auto& [known, member] : kNumbers) {
      if (tag == known) page.*member = value(field, 0);
    }
    for (const auto& [known, member] : kFields) {
      if (tag == known) page.*member = field;
    }
  }

  const Bytes& bytes_;
  std::endian order_;
  bool is_big_;
  std::vector<Page> pages_;
};

SampleType sample_type(const VolumeInput& input, const Page& page) {
  for (const auto& [code, name] : kColors) {
    if (page.photometric == code) {
      fail(input.name(), text("is in color (", name, "): only grayscale can be meshed"));
    }
  }
  if (page.samples != 1) {
    fail(input.name(),
         text("has ", page.samples, " samples per pixel: only grayscale can be meshed"));
  }
  // Format 4 is "undefined", and used like 1.
  constexpr std::tuple<std::uint64_t, std::uint64_t, SampleType> kTypes[] = {
      {1, 8, SampleType::u8},   {2, 8, SampleType::i8},   {1, 16, SampleType::u16},
      {2, 16, SampleType::i16}, {1, 32, SampleType::u32}, {2, 32, SampleType::i32},
      {3, 32, SampleType::f32}, {3, 64, SampleType::f64}};
  for (const auto& [format, bits, type] : kTypes) {
    if (format == (page.sample_format == 4 ? 1 : page.sample_format) && bits == page.bits) {
      return type;
    }
  }
  const std::string_view kind = page.sample_format == 1   ? "unsigned integers"
                                : page.sample_format == 2 ? "signed integers"
                                : page.sample_format == 3 ? "floating point numbers"
                                                          : "complex numbers";
  fail(input.name(),
       text("its samples are ", kind, " of ", page.bits,
            " bits (integers of 8, 16 and 32, floating point of 32 and 64 are read)"));
}

// Refuses what cannot be read of a page, or does not go with the first.
void check_page(const VolumeInput& input, const Page& page, const Page& first, std::size_t n) {
  if (page.width != first.width || page.height != first.height) {
    fail(input.name(), text("page ", n + 1, " has ", page.width, " x ", page.height,
                            " samples, and page 1 ", first.width, " x ", first.height));
  }
  if (page.bits != first.bits || page.sample_format != first.sample_format ||
      page.samples != first.samples || page.photometric != first.photometric) {
    fail(input.name(), text("page ", n + 1, " has samples of another type than page 1"));
  }
  for (const auto& [code, name] : kOtherCompressions) {
    if (page.compression != code) continue;
    fail(input.name(), text("is compressed (", name, "): convert it with 'tiffcp -c zip IN OUT'"));
  }
  if (page.compression != kPlain && page.compression != kLzw && page.compression != kDeflate &&
      page.compression != kOldDeflate && page.compression != kPackBits) {
    fail(input.name(), text("is compressed in a way that is not read (", page.compression,
                            "): convert it with 'tiffcp -c zip IN OUT'"));
  }
  const bool is_float = page.sample_format == 3;
  if (page.predictor < 1 || page.predictor > 3 || (page.predictor == 3 && !is_float)) {
    fail(input.name(), text("predictor ", page.predictor, " is not known for its samples"));
  }
  if (page.fill_order != 1) fail(input.name(), "its bits are stored in reverse (FillOrder 2)");
  if (page.rows_per_strip == 0 || (page.tile_width == 0) != (page.tile_height == 0) ||
      page.tile_width > kLargest || page.tile_height > kLargest) {
    fail(input.name(), text("page ", n + 1, " has strips or tiles of an impossible size"));
  }
}

// Returns the most bytes that a block can hold.
std::uint64_t largest_block(const Page& page, std::uint64_t stored) {
  if (page.compression == kPlain) return stored;
  if (page.compression == kLzw) return largest_of_lzw(stored);
  if (page.compression == kPackBits) return largest_unpacked(stored);
  return largest_inflated(stored);
}

// Makes sure that all blocks are in the file and long enough. Returns the offset of the samples if
// they stand there in one piece.
std::optional<std::uint64_t> find_samples(const VolumeInput& input, const TiffFile& tiff) {
  std::uint64_t used = 0, end = 0, begin = 0;
  bool is_whole = true;
  for (const Page& page : tiff.pages()) {
    tiff.for_each_block(page, [&](const Block& block) {
      const std::uint64_t samples = block.width * block.height;  // kLargest each at most
      if (block.at > input.bytes.size() || block.size > input.bytes.size() - block.at ||
          samples > largest_block(page, block.size) / (page.bits / 8)) {
        tiff.fail_damaged(block.at);
      }
      // Blocks that share their bytes could become any number of samples.
      used += block.size;
      if (used > input.bytes.size()) fail(input.name(), "its strips or tiles overlap");
      if (end == 0) begin = end = block.at;
      is_whole = is_whole && block.at == end && page.compression == kPlain && page.tile_width == 0;
      end = block.at + block.size;
    });
  }
  if (!is_whole) return std::nullopt;
  return begin;
}

// Undoes the predictors (TIFF 6.0, section 14; Adobe's technical note 3) in a row of samples.
template <class Word>
void add_differences(std::span<std::byte> row) {
  Word sum = 0;
  for (std::size_t n = 0; n < row.size(); n += sizeof(Word)) {
    Word word;
    std::memcpy(&word, &row[n], sizeof word);
    sum = static_cast<Word>(sum + word);
    std::memcpy(&row[n], &sum, sizeof sum);
  }
}
void add_differences(std::span<std::byte> row, std::size_t word_size) {
  if (word_size == 1) add_differences<std::uint8_t>(row);
  if (word_size == 2) add_differences<std::uint16_t>(row);
  if (word_size == 4) add_differences<std::uint32_t>(row);
  if (word_size == 8) add_differences<std::uint64_t>(row);
}
// The highest bytes of all numbers stand first, then the next ones.
void join_bytes(std::span<std::byte> row, std::size_t word_size, std::span<std::byte> scratch) {
  add_differences<std::uint8_t>(row);
  const std::size_t count = row.size() / word_size;
  for (std::size_t n = 0; n < count; ++n) {
    for (std::size_t k = 0; k < word_size; ++k) {
      const std::size_t byte = std::endian::native == std::endian::big ? k : word_size - 1 - k;
      scratch[n * word_size + byte] = row[k * count + n];
    }
  }
  std::ranges::copy(scratch.first(row.size()), row.begin());
}

// Fills `out` with the samples of a block, in native order.
void read_block(const VolumeInput& input, const TiffFile& tiff, const Page& page,
                const Block& block, std::span<std::byte> out) {
  const std::span<const std::byte> stored = input.bytes.data.subspan(block.at, block.size);
  std::size_t found = 0;
  if (page.compression == kPlain) {
    std::ranges::copy(stored, out.begin());
    found = out.size();
  } else if (page.compression == kPackBits) {
    found = unpack_bits(stored, out);
  } else if (page.compression == kLzw) {
    found = unpack_lzw(stored, out);
  } else {
    const Inflated inflated = inflate(stored, Wrapping::zlib, out);
    if (inflated.fault) {
      fail(input.name(),
           text("compressed data is damaged: ", inflated.fault, " behind byte ", block.at));
    }
    found = inflated.size;
  }
  if (found != out.size()) {
    fail(input.name(), text("compressed data is damaged: ", found, " of ", out.size(),
                            " bytes behind byte ", block.at));
  }
  const bool has_predictor = page.compression != kPlain && page.compression != kPackBits;
  const std::size_t word = page.bits / 8, row_size = block.width * word;
  const std::uint64_t predictor = has_predictor ? page.predictor : 1;
  if (predictor != 3 && tiff.order() != std::endian::native) swap_bytes(out, word);
  if (predictor == 1) return;
  std::vector<std::byte> scratch(predictor == 3 ? row_size : 0);
  for (std::size_t at = 0; at < out.size(); at += row_size) {
    if (predictor == 2) add_differences(out.subspan(at, row_size), word);
    if (predictor == 3) join_bytes(out.subspan(at, row_size), word, scratch);
  }
}

void read_slice(const VolumeInput& input, const TiffFile& tiff, const Page& page,
                std::span<std::byte> out) {
  const std::size_t word = page.bits / 8;
  tiff.for_each_block(page, [&](const Block& block) {
    const std::size_t row_size = block.width * word;
    Buffer samples(row_size * block.height);
    read_block(input, tiff, page, block, samples.span());
    const std::size_t width = word * std::min(block.width, page.width - block.x);
    for (std::uint64_t y = 0; y < std::min(block.height, page.height - block.y); ++y) {
      std::memcpy(&out[word * (block.x + page.width * (block.y + y))], &samples.data[y * row_size],
                  width);
    }
  });
}

// What a description says: lines "key=value" (ImageJ), or attributes key="value" (OME).
class Description {
 public:
  explicit Description(std::string_view text)
      : text_(text), is_imagej_(text.starts_with("ImageJ=")) {
    const std::size_t pixels = text.find("<Pixels ");
    if (pixels != std::string_view::npos) {
      is_ome_ = true;
      text_ = text.substr(pixels, text.find('>', pixels) - pixels);
    }
  }

  bool is_imagej() const { return is_imagej_; }
  bool is_ome() const { return is_ome_; }
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
  std::string_view text_;
  bool is_imagej_ = false, is_ome_ = false;
};

// Returns the distance of samples along x, y and z.
Vec3 spacing_of(const VolumeInput& input, const TiffFile& tiff, const Page& page,
                const Description& description) {
  if (input.options.spacing) return *input.options.spacing;
  const double per_unit[] = {tiff.ratio(page.x_resolution), tiff.ratio(page.y_resolution)};
  const bool has_resolution = per_unit[0] > 0 && per_unit[1] > 0;
  if (description.is_ome()) {
    const Vec3 sizes{description.number("PhysicalSizeX"), description.number("PhysicalSizeY"),
                     description.number("PhysicalSizeZ")};
    if (!(sizes.x > 0 && sizes.y > 0 && sizes.z > 0)) return {1, 1, 1};
    const std::string_view unit = description("PhysicalSizeXUnit");
    input.note(text("the spacing is in ", unit.empty() ? "\u00b5m"sv : unit, ", as OME has it"));
    return sizes;
  }
  if (description.is_imagej()) {
    const std::string_view unit = description("unit");
    const double depth = std::abs(description.number("spacing"));
    Vec3 spacing{1, 1, depth > 0 ? depth : 1};
    if (has_resolution && (!unit.empty() || page.resolution_unit == 1)) {
      spacing.x = 1 / per_unit[0];
      spacing.y = 1 / per_unit[1];
    }
    if (!unit.empty()) input.note(text("the spacing is in ", quote(unit), ", as ImageJ has it"));
    return spacing;
  }
  if (has_resolution && page.resolution_unit != 1) {
    input.note(
        "has a resolution, but not the distance of its pages: samples are taken to be 1 "
        "apart; --spacing gives another distance");
  }
  return {1, 1, 1};
}

}  // namespace

bool looks_like_tiff(const Bytes& bytes) {
  for (const std::string_view magic : {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv}) {
    if (bytes.text().starts_with(magic)) return true;
  }
  return false;
}

Volume read_tiff(const VolumeInput& input) {
  TiffFile tiff(input.bytes);
  // Reduced pictures and masks go with a page.
  std::erase_if(tiff.pages(), [](const Page& page) { return (page.subfile & 5) != 0; });
  if (tiff.pages().empty()) fail(input.name(), "has no pages");
  const Page first = tiff.pages()[0];
  const Description description(tiff.text_of(first.description));
  const bool is_imagej = description.is_imagej();
  for (const char* key : {is_imagej ? "channels" : "SizeC", is_imagej ? "frames" : "SizeT"}) {
    if (!is_imagej && !description.is_ome()) break;
    if (description.count(key) == 1) continue;
    fail(input.name(), text("has ", key, " = ", description(key),
                            ": only a stack of one channel and one time can be meshed"));
  }

  SampleGrid grid = grid_of(input);
  grid.type = sample_type(input, first);
  grid.byte_order = tiff.order();
  const auto length = [](std::uint64_t n) {  // data_size() refuses what is over kLargest
    return static_cast<std::int64_t>(std::min(n, kLargest + 1));
  };
  grid.dims = {length(first.width), length(first.height), length(tiff.pages().size())};
  const std::int64_t images = is_imagej ? description.count("images") : 1;
  const bool has_hidden_pages = tiff.pages().size() == 1 && images > 1;
  if (has_hidden_pages) grid.dims[2] = images;
  if (grid.dims[2] == 1) {
    fail(input.name(), "has one page: join the slices with 'tiffcp SLICES stack.tif'");
  }
  data_size(grid);
  for (std::size_t n = 0; n < tiff.pages().size(); ++n)
    check_page(input, tiff.pages()[n], first, n);
  grid.set_spacing(spacing_of(input, tiff, first, description));
  if (first.photometric == 0) {
    input.note("its small samples are shown bright (WhiteIsZero); they are kept as stored");
  }

  const std::optional<std::uint64_t> begin = find_samples(input, tiff);
  if (has_hidden_pages && !begin)
    fail(input.name(), "has one page, and ImageJ's others are not behind it");
  auto volume = [&] {
    if (begin) {
      const std::uint64_t size = data_size(grid);
      const Bytes data = input.bytes.from(*begin);
      return volume_from_raw(grid, data.first(std::min<std::uint64_t>(size, data.size())));
    }
    return volume_from_slices(grid, [&](std::size_t k, std::span<std::byte> out) {
      read_slice(input, tiff, tiff.pages()[k], out);
    });
  }();
  // ImageJ has signed samples as unsigned ones with a calibration function, 0 for a straight line.
  if (!is_imagej || description("cf") != "0") return volume;
  const double slope = description.number("c1"), intercept = description.number("c0");
  if (!(slope != 0 && std::abs(slope) < 1e30 && std::abs(intercept) < 1e30)) return volume;
  return scaled_volume(input, volume, slope, intercept);
}

}  // namespace deliso
