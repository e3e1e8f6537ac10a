// SPDX-License-Identifier: MIT
#include "io/files/zip_archive.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "base/text.h"
#include "io/files/checksum.h"
#include "io/files/field_reader.h"
#include "io/files/inflate.h"
#include "io/files/text_scan.h"

namespace deliso {
namespace {

constexpr std::uint32_t kPartMark = 0x04034b50, kEntryMark = 0x02014b50, kWideEndMark = 0x06064b50;
constexpr std::string_view kEndMark = "PK\5\6";
constexpr std::uint32_t kElsewhere = 0xffffffff;  // the number is in a field of Zip64
constexpr std::uint64_t kEndSize = 22, kLocatorSize = 20, kEntrySize = 46, kPartSize = 30;

}  // namespace

template <class T>
T ZipArchive::get(std::uint64_t at) const {
  if (at > file_.size() || file_.size() - at < sizeof(T)) fail("is a damaged zip archive");
  return FieldReader(file_.data, std::endian::little).get<T>(static_cast<std::size_t>(at));
}

ZipArchive::ZipArchive(Bytes file) : file_(std::move(file)) {
  // A comment may follow, of 64 KiB at most.
  const std::size_t end = file_.text().rfind(kEndMark);
  const std::uint64_t rest = end == std::string_view::npos ? 0 : file_.size() - end;
  if (rest < kEndSize || rest > kEndSize + 0xffff) fail("is no zip archive, or is cut short");
  std::uint64_t count = get<std::uint16_t>(end + 10), at = get<std::uint32_t>(end + 16);
  if (at == kElsewhere && end >= kLocatorSize) {
    const auto wide = get<std::uint64_t>(end - kLocatorSize + 8);
    if (get<std::uint32_t>(wide) != kWideEndMark) fail("is a damaged zip archive");
    count = get<std::uint64_t>(wide + 32);
    at = get<std::uint64_t>(wide + 48);
  }
  for (std::uint64_t n = 0; n < count; ++n) parts_.push_back(read_entry(at));
}

ZipArchive::Part ZipArchive::read_entry(std::uint64_t& at) const {
  if (get<std::uint32_t>(at) != kEntryMark) fail("is a damaged zip archive");
  Part part;
  part.flags = get<std::uint16_t>(at + 8);
  part.method = get<std::uint16_t>(at + 10);
  part.sum = get<std::uint32_t>(at + 16);
  part.packed_size = get<std::uint32_t>(at + 20);
  part.size = get<std::uint32_t>(at + 24);
  part.at = get<std::uint32_t>(at + 42);
  const std::uint64_t name = get<std::uint16_t>(at + 28), extra = get<std::uint16_t>(at + 30),
                      comment = get<std::uint16_t>(at + 32);
  at += kEntrySize;
  get<char>(at + name + extra);  // the directory's end follows, or another entry
  part.name = file_.text().substr(static_cast<std::size_t>(at), static_cast<std::size_t>(name));
  // Fields of Zip64, those that are needed, in this order.
  for (std::uint64_t field = at + name; field + 4 <= at + name + extra;) {
    const auto kind = get<std::uint16_t>(field), size = get<std::uint16_t>(field + 2);
    std::uint64_t next = field + 4;
    for (std::uint64_t* number : {&part.size, &part.packed_size, &part.at}) {
      if (kind != 1 || *number != kElsewhere) continue;
      *number = get<std::uint64_t>(next);
      next += 8;
    }
    field += 4 + size;
  }
  at += name + extra + comment;
  return part;
}

Bytes ZipArchive::part(std::string_view name) const {
  const auto found =
      std::ranges::find(parts_, lower(name), [](const Part& p) { return lower(p.name); });
  if (found == parts_.end()) fail("has no part ", quote(name));
  const Part& part = *found;
  const std::string in = text("part ", quote(part.name), ": ");
  if (part.flags & 1) fail(in, "is encrypted");
  if (get<std::uint32_t>(part.at) != kPartMark) fail(in, "is damaged");
  const std::uint64_t begin =
      part.at + kPartSize + get<std::uint16_t>(part.at + 26) + get<std::uint16_t>(part.at + 28);
  if (begin > file_.size() || file_.size() - begin < part.packed_size) fail(in, "is cut short");
  const Bytes packed =
      file_.from(static_cast<std::size_t>(begin)).first(static_cast<std::size_t>(part.packed_size));
  Bytes bytes = packed;
  const bool is_deflated = part.method == 8;
  if (is_deflated) {
    if (part.size > largest_inflated(part.packed_size)) fail(in, "is cut short");
    Buffer buffer(static_cast<std::size_t>(part.size));
    const Inflated inflated = inflate(packed.data, Wrapping::none, buffer.span());
    if (inflated.fault) fail(in, "its compressed data has ", inflated.fault);
    if (inflated.size != part.size || !inflated.ended) fail(in, "has another size");
    bytes = bytes_of(std::move(buffer), file_.name);
  } else if (part.method != 0) {
    fail(in, "compression ", part.method, " is not supported");
  }
  if (bytes.size() != part.size || crc32(bytes.data) != part.sum)
    fail(in, "has another size or checksum");
  return bytes;
}

bool looks_like_zip(std::string_view bytes) {
  return bytes.starts_with("PK\3\4");
}

}  // namespace deliso
