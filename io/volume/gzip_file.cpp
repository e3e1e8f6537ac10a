// SPDX-License-Identifier: MIT
#include "io/volume/gzip_file.h"

#include <algorithm>
#include <utility>

#include "io/files/inflate.h"

namespace deliso {

bool is_gzip(const Bytes& bytes) {
  return bytes.text().starts_with("\x1f\x8b");
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

}  // namespace deliso
