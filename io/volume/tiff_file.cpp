// SPDX-License-Identifier: MIT
#include "io/volume/tiff_file.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

#include "base/text.h"
#include "io/files/field_reader.h"
#include "io/files/inflate.h"
#include "io/files/lzw.h"
#include "io/files/packbits.h"
#include "io/volume/sample_grid.h"

namespace deliso {
namespace {

constexpr std::uint64_t kPlain = 1, kLzw = 5, kDeflate = 8, kOldDeflate = 32946, kPackBits = 32773;

constexpr std::pair<std::uint64_t, std::string_view> kOtherCompressions[] = {
    {2, "CCITT"},    {3, "fax"},           {4, "fax"},      {6, "JPEG"},          {7, "JPEG"},
    {34887, "LERC"}, {34712, "JPEG 2000"}, {34925, "LZMA"}, {50000, "Zstandard"}, {50001, "WebP"}};
constexpr std::pair<std::uint64_t, std::uint64_t TiffPage::*> kNumbers[] = {
    {254, &TiffPage::subfile},        {256, &TiffPage::width},
    {257, &TiffPage::height},         {258, &TiffPage::bits},
    {259, &TiffPage::compression},    {262, &TiffPage::photometric},
    {266, &TiffPage::fill_order},     {277, &TiffPage::samples},
    {278, &TiffPage::rows_per_strip}, {296, &TiffPage::resolution_unit},
    {317, &TiffPage::predictor},      {322, &TiffPage::tile_width},
    {323, &TiffPage::tile_height},    {339, &TiffPage::sample_format},
    {32997, &TiffPage::depth}};
// The offsets and sizes of strips, and those of tiles.
constexpr std::pair<std::uint64_t, TiffField TiffPage::*> kTiffFields[] = {
    {270, &TiffPage::description},  {273, &TiffPage::offsets},      {279, &TiffPage::sizes},
    {282, &TiffPage::x_resolution}, {283, &TiffPage::y_resolution}, {324, &TiffPage::offsets},
    {325, &TiffPage::sizes}};

std::uint64_t size_of_type(std::uint64_t type) {
  constexpr std::uint64_t kSizes[] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};
  return type < std::size(kSizes) ? kSizes[type] : 0;
}

// Returns the bytes of a row of samples, as they are stored.
std::uint64_t stored_row(const TiffPage& page, std::uint64_t width) {
  return is_packed(page) ? (width * page.bits + 7) / 8 : width * page.word();
}

// Fills `out` with the samples of packed rows, the highest bit of each first.
void unpack_samples(const TiffPage& page, std::span<const std::byte> packed, std::uint64_t width,
                    std::span<std::byte> out) {
  const std::size_t word = page.word(), row = stored_row(page, width);
  for (std::size_t n = 0; n < out.size() / word; ++n) {
    const std::size_t first = n % width * page.bits, begin = n / width * row;
    std::uint16_t sample = 0;
    for (std::size_t bit = first; bit < first + page.bits; ++bit) {
      const unsigned byte = std::to_integer<unsigned>(packed[begin + bit / 8]);
      sample = static_cast<std::uint16_t>(sample << 1U | (byte >> (7 - bit % 8) & 1U));
    }
    if (word == 1) {
      out[n] = static_cast<std::byte>(sample);
    } else {
      std::memcpy(&out[2 * n], &sample, 2);
    }
  }
}

// Returns the most bytes that a block can hold.
std::uint64_t largest_block(const TiffPage& page, std::uint64_t stored) {
  if (page.compression == kPlain) return stored;
  if (page.compression == kLzw) return largest_of_lzw(stored);
  if (page.compression == kPackBits) return largest_unpacked(stored);
  return largest_inflated(stored);
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

}  // namespace

TiffFile::TiffFile(const Bytes& bytes)
    : bytes_(bytes),
      order_(bytes.text().starts_with('M') ? std::endian::big : std::endian::little),
      is_big_(number(2, 2) == 43) {
  std::set<std::uint64_t> seen;
  std::uint64_t at = is_big_ ? number(8, 8) : number(4, 4);
  while (at != 0) {
    if (!seen.insert(at).second) fail(bytes_.name, "its pages follow each other in a circle");
    at = parse_page(at);
  }
  // Reduced pictures and masks go with a page.
  std::erase_if(pages_, [](const TiffPage& page) { return (page.subfile & 5) != 0; });
  if (pages_.empty()) fail(bytes_.name, "has no pages");
}

// Returns value `n` of a field of integers.
std::uint64_t TiffFile::value(const TiffField& field, std::uint64_t n) const {
  const std::uint64_t size = size_of_type(field.type);
  if (n >= field.count || field.type == 5) fail_damaged(field.at);
  return number(field.at + n * size, size);
}
double TiffFile::ratio(const TiffField& field) const {
  if (field.type != 5 || field.count == 0) return 0;
  const double down = static_cast<double>(number(field.at + 4, 4));
  return down == 0 ? 0 : static_cast<double>(number(field.at, 4)) / down;
}
std::string_view TiffFile::text_of(const TiffField& field) const {
  if (field.type != 2 || field.at > bytes_.size()) return "";
  const std::string_view text = bytes_.text().substr(field.at, field.count);
  return text.substr(0, text.find('\0'));
}

// Calls f for the blocks of a page, row by row.
template <class F>
void TiffFile::for_each_block(const TiffPage& page, F f) const {
  const bool is_tiled = page.tile_width > 0;
  const std::uint64_t width = is_tiled ? page.tile_width : page.width;
  const std::uint64_t height = is_tiled ? page.tile_height : page.rows_per_strip;
  std::uint64_t n = 0;
  for (std::uint64_t y = 0; y < page.height; y += height) {
    for (std::uint64_t x = 0; x < page.width; x += width, ++n) {
      Block block{.at = value(page.offsets, n), .x = x, .y = y, .width = width};
      block.height = is_tiled ? height : std::min(height, page.height - y);
      if (page.compression == kPlain) {
        block.size = stored_row(page, block.width) * block.height;
      } else {
        block.size = value(page.sizes, n);
      }
      f(block);
    }
  }
}

void TiffFile::fail_damaged(std::uint64_t at) const {
  fail(bytes_.name, "is damaged, or ends too early: see byte ", at);
}

// Returns the integer of `size` bytes at `at`.
std::uint64_t TiffFile::number(std::uint64_t at, std::uint64_t size) const {
  if (at > bytes_.size() || bytes_.size() - at < size) fail_damaged(at);
  const FieldReader fields(bytes_.data, order_);
  if (size == 1) return fields.get<std::uint8_t>(at);
  if (size == 2) return fields.get<std::uint16_t>(at);
  if (size == 4) return fields.get<std::uint32_t>(at);
  return fields.get<std::uint64_t>(at);
}

// Returns the place of the next page; 0 at the last.
std::uint64_t TiffFile::parse_page(std::uint64_t at) {
  const std::uint64_t count_size = is_big_ ? 8 : 2, entry_size = is_big_ ? 20 : 12;
  const std::uint64_t value_size = is_big_ ? 8 : 4;
  const std::uint64_t count = number(at, count_size);
  if (count > bytes_.size() / entry_size) fail_damaged(at);
  // Directories that share their bytes could have any number of entries.
  entries_ += count;
  if (entries_ > bytes_.size() / entry_size) fail(bytes_.name, "its directories overlap");
  TiffPage page;
  for (std::uint64_t n = 0; n < count; ++n) {
    const std::uint64_t entry = at + count_size + n * entry_size;
    TiffField field{number(entry + 2, 2), number(entry + 4, value_size), entry + 4 + value_size};
    const std::uint64_t size = size_of_type(field.type);
    if (size == 0 || field.count == 0) continue;
    if (field.count > value_size / size) field.at = number(field.at, value_size);
    keep(page, number(entry, 2), field);
  }
  if (page.depth > 1) {
    fail(bytes_.name, "its pages have a depth of ", page.depth,
         " samples: convert it with python3 -c ",
         "\"import tifffile; tifffile.imwrite('volume.tif', tifffile.imread('FILE'))\"");
  }
  pages_.push_back(page);
  return number(at + count_size + count * entry_size, value_size);
}

void TiffFile::keep(TiffPage& page, std::uint64_t tag, const TiffField& field) const {
  for (const auto& [known, member] : kNumbers) {
    if (tag == known) page.*member = value(field, 0);
  }
  for (const auto& [known, member] : kTiffFields) {
    if (tag == known) page.*member = field;
  }
}

void TiffFile::check_encoding(const TiffPage& page, std::string_view page_name) const {
  for (const auto& [code, name] : kOtherCompressions) {
    if (page.compression != code) continue;
    fail(bytes_.name, "is compressed (", name, "): convert it with 'tiffcp -c zip IN OUT'");
  }
  if (page.compression != kPlain && page.compression != kLzw && page.compression != kDeflate &&
      page.compression != kOldDeflate && page.compression != kPackBits) {
    fail(bytes_.name, "is compressed in a way that is not read (", page.compression,
         "): convert it with 'tiffcp -c zip IN OUT'");
  }
  const bool is_float = page.sample_format == 3;
  if (page.predictor < 1 || page.predictor > 3 || (page.predictor == 3 && !is_float)) {
    fail(bytes_.name, "predictor ", page.predictor, " is not known for its samples");
  }
  if (is_packed(page) && page.predictor != 1) {
    fail(bytes_.name, "predictor ", page.predictor, " is not known for its samples");
  }
  if (page.fill_order != 1) fail(bytes_.name, "its bits are stored in reverse (FillOrder 2)");
  if (page.rows_per_strip == 0 || (page.tile_width == 0) != (page.tile_height == 0) ||
      page.tile_width > kLargestTiffSize || page.tile_height > kLargestTiffSize) {
    fail(bytes_.name, page_name, " has strips or tiles of an impossible size");
  }
}

std::optional<std::uint64_t> TiffFile::find_samples() const {
  std::uint64_t used = 0, end = 0, begin = 0;
  bool is_whole = true;
  for (const TiffPage& page : pages_) {
    for_each_block(page, [&](const Block& block) {
      // Each is kLargestTiffSize at most, and a row has eight times as many bytes.
      const std::uint64_t row = stored_row(page, block.width);
      if (block.at > bytes_.size() || block.size > bytes_.size() - block.at ||
          block.height > largest_block(page, block.size) / std::max<std::uint64_t>(row, 1)) {
        fail_damaged(block.at);
      }
      // Blocks that share their bytes could become any number of samples.
      used += block.size;
      if (used > bytes_.size()) fail(bytes_.name, "its strips or tiles overlap");
      if (end == 0) begin = end = block.at;
      is_whole = is_whole && block.at == end && page.compression == kPlain &&
                 page.tile_width == 0 && !is_packed(page);
      end = block.at + block.size;
    });
  }
  if (!is_whole) return std::nullopt;
  return begin;
}

// Fills `out` with the samples of a block: packed, or in native order.
void TiffFile::read_block(const TiffPage& page, const Block& block,
                          std::span<std::byte> out) const {
  const std::span<const std::byte> stored = bytes_.data.subspan(block.at, block.size);
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
      fail(bytes_.name, "compressed data is damaged: ", inflated.fault, " behind byte ", block.at);
    }
    found = inflated.size;
  }
  if (found != out.size()) {
    fail(bytes_.name, "compressed data is damaged: ", found, " of ", out.size(),
         " bytes behind byte ", block.at);
  }
  const bool has_predictor = page.compression != kPlain && page.compression != kPackBits;
  if (is_packed(page)) return;
  const std::size_t word = page.word(), row_size = block.width * word;
  const std::uint64_t predictor = has_predictor ? page.predictor : 1;
  if (predictor != 3 && order_ != std::endian::native) swap_bytes(out, word);
  if (predictor == 1) return;
  std::vector<std::byte> scratch(predictor == 3 ? row_size : 0);
  for (std::size_t at = 0; at < out.size(); at += row_size) {
    if (predictor == 2) add_differences(out.subspan(at, row_size), word);
    if (predictor == 3) join_bytes(out.subspan(at, row_size), word, scratch);
  }
}

void TiffFile::read_page(const TiffPage& page, std::span<std::byte> out) const {
  const std::size_t word = page.word();
  for_each_block(page, [&](const Block& block) {
    const std::size_t row_size = block.width * word;
    Buffer samples(row_size * block.height);
    if (is_packed(page)) {
      Buffer packed(stored_row(page, block.width) * block.height);
      read_block(page, block, packed.span());
      unpack_samples(page, packed.span(), block.width, samples.span());
    } else {
      read_block(page, block, samples.span());
    }
    const std::size_t width = word * std::min(block.width, page.width - block.x);
    for (std::uint64_t y = 0; y < std::min(block.height, page.height - block.y); ++y) {
      std::memcpy(&out[word * (block.x + page.width * (block.y + y))], &samples.data[y * row_size],
                  width);
    }
  });
}

}  // namespace deliso
