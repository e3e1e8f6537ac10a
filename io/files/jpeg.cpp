// SPDX-License-Identifier: MIT
#include "io/files/jpeg.h"

#include <algorithm>
#include <vector>

#include "io/files/jpeg_scan.h"

namespace deliso {
namespace {

constexpr const char *kEarlyEnd = "an early end", *kColor = "a picture in color";

// Reads the segments up to the scan (T.81, annex B; T.87, annex C). Returns a fault or null.
class JpegParser {
 public:
  JpegParser(std::span<const std::byte> in, JpegScan& scan) : in_(in), scan_(scan) {}

  const char* run() {
    if (in_.size() < 2 || word(0) != 0xffd8) return "no JPEG";
    for (std::size_t at = 2;;) {
      while (in_.size() - at >= 2 && word(at) == 0xffff) ++at;
      if (in_.size() - at < 4) return kEarlyEnd;
      const unsigned marker = word(at), size = word(at + 2);
      if (size < 2 || size > in_.size() - at - 2) return kEarlyEnd;
      if (marker == 0xffda) return read_scan(at + 4, size - 2);
      if (const char* fault = read_segment(marker, at + 4, size - 2)) return fault;
      at += 2 + size;
    }
  }

 private:
  unsigned byte(std::size_t at) const { return std::to_integer<unsigned>(in_[at]); }
  unsigned word(std::size_t at) const { return 256 * byte(at) + byte(at + 1); }

  const char* read_segment(unsigned marker, std::size_t at, std::size_t size) {
    switch (marker) {
      case 0xffc3:
      case 0xfff7:  // a frame
        is_ls_ = marker == 0xfff7;
        if (size < 9) return kEarlyEnd;
        scan_.sample_bits = static_cast<int>(byte(at));
        if (scan_.sample_bits < 2 || scan_.sample_bits > 16) return "samples of more than 16 bits";
        if (word(at + 1) != scan_.rows || word(at + 3) != scan_.columns) return "another size";
        return byte(at + 5) != 1 ? kColor : nullptr;
      case 0xffc4:  // Huffman codes
        return read_codes(at, at + size);
      case 0xffdd:
        restart_interval_ = 0;
        for (; size > 0; --size) restart_interval_ = restart_interval_ << 8 | byte(at++);
        return nullptr;
      case 0xfff8:
        if (size < 11 || byte(at) != 1) return "a palette, or a size of its own";
        for (std::size_t n = 0; n < 5; ++n)
          scan_.preset[n] = static_cast<int>(word(at + 1 + 2 * n));
        return nullptr;
      default:
        if (marker <= 0xff00) return "no marker where one is due";
        return marker / 16 == 0xffc ? "another process than the lossless one" : nullptr;
    }
  }

  const char* read_codes(std::size_t at, std::size_t end) {
    for (std::size_t size = 16; at < end; at += 1 + size, size = 16) {
      for (std::size_t n = 1; n <= 16 && n < end - at; ++n) size += byte(at + n);
      if (size >= end - at) return kEarlyEnd;
      codes_[byte(at) % 4] = in_.subspan(at + 1, size);
    }
    return nullptr;
  }

  const char* read_scan(std::size_t at, std::size_t size) {
    if (scan_.sample_bits == 0) return "a scan before its frame";
    if (size < 6) return kEarlyEnd;
    if (byte(at) != 1) return kColor;
    scan_.codes = codes_[byte(at + 2) / 16 % 4];
    scan_.selection = static_cast<int>(byte(at + 3));
    scan_.point_transform = static_cast<int>(byte(at + 5) % 16);
    // A restart interval is in samples, and in JPEG-LS in rows.
    const std::size_t row = is_ls_ ? 1 : scan_.columns;
    if (restart_interval_ % row != 0) return "a restart within a row";
    if (is_ls_ && scan_.point_transform > 0) return "a point transform";
    scan_.restart_rows = restart_interval_ / row;
    scan_.bits = {in_.subspan(at + size), is_ls_};
    return is_ls_ ? decode_jpeg_ls(scan_) : decode_lossless_jpeg(scan_);
  }

  std::span<const std::byte> in_;
  JpegScan& scan_;
  bool is_ls_ = false;
  std::size_t restart_interval_ = 0;
  std::array<std::span<const std::byte>, 4> codes_;
};

// Returns a Huffman code as a table over the next 16 bits: 256 times the value, plus the number of
// its bits; or 0.
std::vector<std::uint16_t> table_of(std::span<const std::byte> codes) {
  std::vector<std::uint16_t> table(std::size_t{1} << 16);
  auto to = table.begin();
  for (std::size_t bits = 1, value = 16; bits <= 16 && !codes.empty(); ++bits) {
    for (unsigned n = std::to_integer<unsigned>(codes[bits - 1]); n > 0; --n, ++value) {
      const std::ptrdiff_t count = std::ptrdiff_t{1} << (16 - bits);
      if (count > table.end() - to) return table;  // more codes than there can be
      const std::size_t entry = 256 * std::to_integer<std::size_t>(codes[value]) + bits;
      to = std::fill_n(to, count, static_cast<std::uint16_t>(entry));
    }
  }
  return table;
}

// Returns the prediction from the samples to the left, above, and above to the left (T.81, H.1).
int predict(int selection, int left, int above, int corner) {
  if (selection <= 3) return selection == 1 ? left : selection == 2 ? above : corner;
  if (selection == 6) return above + ((left - corner) >> 1);
  if (selection == 7) return (left + above) >> 1;
  return left + ((above - corner) >> (selection - 4));
}

}  // namespace

const char* decode_lossless_jpeg(JpegScan& scan) {
  if (scan.selection < 1 || scan.selection > 7) return "an unknown predictor";
  if (scan.point_transform >= scan.sample_bits) return "no bits left";
  const std::vector<std::uint16_t> table = table_of(scan.codes);
  const std::size_t n = scan.columns;
  for (std::size_t y = 0; y < scan.rows; ++y) {
    if (!scan.restart_before(y)) return "no restart marker where one is due";
    std::uint16_t* row = &scan.out[y * n];
    const std::uint16_t* above = row - (scan.starts_at(y) ? 0 : n);
    for (std::size_t x = 0; x < n; ++x) {
      scan.bits.refill();
      const unsigned entry = table[scan.bits.peek(16)], size = entry >> 8;
      if (entry == 0 || size > 16) return "an unknown code";
      scan.bits.skip(entry & 255);
      // A difference modulo 2^16. A number of `size` bits below 2^(size-1) is a negative one.
      int difference = 1 << 15;
      if (size < 16) {
        difference = static_cast<int>(scan.bits.take(size));
        if (difference < 1 << size >> 1) difference -= (1 << size) - 1;
      }
      const int before =
          x > 0 ? predict(above == row ? 1 : scan.selection, row[x - 1], above[x], above[x - 1])
          : above == row ? 1 << (scan.sample_bits - scan.point_transform - 1)
                         : above[0];
      row[x] = static_cast<std::uint16_t>(before + difference);
    }
    if (scan.bits.overrun()) return kEarlyEnd;
  }
  for (std::uint16_t& sample : scan.out) {
    sample = static_cast<std::uint16_t>(sample << scan.point_transform);
  }
  return nullptr;
}

JpegPicture decode_jpeg(std::span<const std::byte> in, std::size_t columns, std::size_t rows,
                        std::span<std::uint16_t> out) {
  JpegScan scan{columns, rows, out};
  const char* fault = JpegParser(in, scan).run();
  return {scan.sample_bits, fault};
}

}  // namespace deliso
