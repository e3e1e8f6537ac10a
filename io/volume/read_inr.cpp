// SPDX-License-Identifier: MIT
// INRIMAGE-4, the format of INRIA's image library, which CGAL, pygalmesh and iso2mesh write: a
// header with lines "KEY=value", filled up to 256 bytes or a multiple of it, and the samples.
#include <array>
#include <string>
#include <string_view>

#include "io/volume/header_fields.h"
#include "io/volume/sample_grid.h"
#include "io/volume/several_volumes.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

constexpr std::string_view kInrMagic = "#INRIMAGE-4#{", kInrEnd = "\n##}\n";
constexpr std::size_t kMostHeader = 1 << 16;

// Sets the type and the byte order, which the header knows by the machine.
void read_type(const VolumeInput& input, const HeaderFields& header, SampleGrid& grid) {
  std::string type = lower(header.get("TYPE"));
  if (type.ends_with(" fixed")) type = type.starts_with("un") ? "uint" : "int";
  const std::string_view bits = header.get("PIXSIZE");  // "8 bits"
  grid.type = supported_type(input, type + std::string(bits.substr(0, bits.find(' '))));
  if (header.get("SCALE", "2**0") != "2**0") header.fail_field("SCALE", "only 2**0 is supported");
  const std::string cpu = lower(header.get("CPU"));
  const bool is_big = cpu == "sun" || cpu == "sgi";
  if (!is_big && cpu != "decm" && cpu != "alpha" && cpu != "pc")
    header.fail_field("CPU", "not decm, alpha, pc, sun or sgi");
  grid.byte_order = is_big ? std::endian::big : std::endian::little;
}

}  // namespace

bool looks_like_inr(const Bytes& bytes) {
  return start_of(bytes, kInrMagic.size()).text() == kInrMagic;
}

Volume read_inr(const VolumeInput& input) {
  const Bytes start = start_of(input.bytes, kMostHeader);
  const std::size_t end = start.text().find(kInrEnd);
  if (end == std::string_view::npos) fail(input.name(), "its header has no end, '##}'");
  HeaderFields header(input.name(), "key");
  for (const std::string_view line : split(start.text().substr(0, end), '\n')) {
    const std::size_t key = line.find('=');
    if (key != std::string_view::npos) header.set(line.substr(0, key), line.substr(key + 1));
  }
  const auto number = [&](const char* key, double fallback) {
    return header.has(key) ? header.numbers({key}, 1)->front() : fallback;
  };
  SampleGrid grid = grid_of(input);
  read_type(input, header, grid);
  using Kind = DataAxis::Kind;
  const DataAxis channel{Kind::channel, header.integer("VDIM", 1)};
  const DataAxis x{Kind::x, header.integer("XDIM")}, y{Kind::y, header.integer("YDIM")};
  set_axes(grid, std::array{channel, x, y, DataAxis{Kind::z, header.integer("ZDIM")}});
  grid.set_spacing({number("VX", 1), number("VY", 1), number("VZ", 1)});
  grid.origin = {number("TX", 0), number("TY", 0), number("TZ", 0)};
  if (number("RX", 0) != 0 || number("RY", 0) != 0 || number("RZ", 0) != 0)
    input.warn("orientation-unknown", "its rotation (RX, RY, RZ) is not read: it is taken as 0");
  return volume_behind(grid, input.bytes, end + kInrEnd.size());
}

}  // namespace deliso
