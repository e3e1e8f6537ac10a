// SPDX-License-Identifier: MIT
// A TIFF file (6.0, with supplement 2) or BigTIFF: its pages, and their samples in strips or tiles.
// They are plain, LZW, Deflate or PackBits, with the predictors of TIFF.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "io/files/input_file.h"

namespace deliso {

// The values of a tag.
struct TiffField {
  std::uint64_t type = 0, count = 0, at = 0;
};

inline constexpr std::uint64_t kLargestTiffSize = std::numeric_limits<int>::max();

struct TiffPage {
  std::uint64_t subfile = 0, width = 0, height = 0, bits = 1, compression = 1, photometric = 1,
                samples = 1, rows_per_strip = kLargestTiffSize, resolution_unit = 2, predictor = 1,
                tile_width = 0, tile_height = 0, sample_format = 1, fill_order = 1, depth = 1;
  TiffField offsets, sizes, description, x_resolution, y_resolution;

  std::uint64_t word() const { return bits <= 8 ? 1 : bits <= 16 ? 2 : bits / 8; }  // bytes
};

// True if samples have other sizes than words of the machine: then a row is a run of bits, filled
// up to whole bytes.
constexpr bool is_packed(const TiffPage& page) {
  return page.bits > 0 && page.bits < 16 && page.bits != 8;
}

// Reads the pages, without reduced pictures and masks. It keeps the bytes. Everything throws
// InputError with their name.
class TiffFile {
 public:
  explicit TiffFile(const Bytes& bytes);

  const Bytes& bytes() const { return bytes_; }
  std::endian order() const { return order_; }
  const std::vector<TiffPage>& pages() const { return pages_; }

  // Returns the first value of a field of rational numbers; 0 if there is none.
  double ratio(const TiffField& field) const;
  std::string_view text_of(const TiffField& field) const;

  // Makes sure that the samples of the page can be read, whatever they mean. Messages call it
  // `page_name`.
  void check_encoding(const TiffPage& page, std::string_view page_name) const;
  // Makes sure that all strips and tiles are in the file and long enough. Returns the offset of the
  // samples if they stand there in one piece. pre: check_encoding() of all pages.
  std::optional<std::uint64_t> find_samples() const;
  // Fills `out` with the samples of a page, row by row, in native order. pre: find_samples().
  void read_page(const TiffPage& page, std::span<std::byte> out) const;

 private:
  // A strip or a tile.
  struct Block {
    std::uint64_t at = 0, size = 0;       // in the file
    std::uint64_t x = 0, y = 0;           // in the page
    std::uint64_t width = 0, height = 0;  // as stored
  };

  [[noreturn]] void fail_damaged(std::uint64_t at) const;
  std::uint64_t number(std::uint64_t at, std::uint64_t size) const;
  std::uint64_t value(const TiffField& field, std::uint64_t n) const;
  std::uint64_t parse_page(std::uint64_t at);
  void keep(TiffPage& page, std::uint64_t tag, const TiffField& field) const;
  template <class F>
  void for_each_block(const TiffPage& page, F f) const;
  void read_block(const TiffPage& page, const Block& block, std::span<std::byte> out) const;

  Bytes bytes_;
  std::endian order_;
  bool is_big_;
  std::vector<TiffPage> pages_;
  std::uint64_t entries_ = 0;  // of all directories so far
};

}  // namespace deliso
