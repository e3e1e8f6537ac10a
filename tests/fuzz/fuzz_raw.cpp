// SPDX-License-Identifier: MIT
// Plain samples. The first line holds what the user says, dims, type, spacing, byte order and
// bytes to skip, parsed as the program parses it; the samples follow.
#include "fuzz/reader_target.h"
#include "io/files/text_scan.h"

using namespace deliso;
using namespace deliso::fuzz;

namespace {

ReadOptions options_in(std::string_view line) {
  const std::vector<std::string_view> words = words_of(line);
  const auto word = [&](std::size_t n) { return n < words.size() ? words[n] : ""; };
  RawLayout raw;
  raw.dims = parse_dims(word(0));
  raw.type = parse_sample_type(word(1));
  Vec3 spacing;
  for (int axis = 0; axis < 3; ++axis) {
    spacing[axis] = to_double(word(2 + static_cast<std::size_t>(axis))).value_or(1);
  }
  raw.byte_order = word(5) == "big" ? std::endian::big : std::endian::little;
  raw.skip = static_cast<std::uint64_t>(to_int(word(6)).value_or(0));
  ReadOptions options;
  options.raw = raw;
  options.spacing = spacing;
  if (!word(7).empty()) options.roi = parse_roi(word(7));
  return options;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view all(reinterpret_cast<const char*>(bytes), size);
  TextCursor text(all);
  const std::string_view line = text.line();
  const std::vector<char> copy(text.rest().begin(), text.rest().end());
  ReadLog log;
  try {
    const ReadOptions options = options_in(line);
    const Bytes input{"v.raw", std::as_bytes(std::span(copy)), nullptr};
    check(read_raw({input, "", options, log}));
  } catch (const InputError& error) {
    check(error);
  }
  return 0;
}
