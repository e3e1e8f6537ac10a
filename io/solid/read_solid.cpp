// SPDX-License-Identifier: MIT
#include "io/solid/read_solid.h"

#include <algorithm>
#include <span>

#include "base/check.h"
#include "base/sorted_list.h"
#include "base/text.h"
#include "io/solid/solid_formats.h"

namespace deliso {

SolidFile parse_solid(std::string_view bytes, SolidFormat format, const std::string& name) {
  DELISO_CHECK(is_read(format));
  const Bytes all{text("'", name, "'"), std::as_bytes(std::span(bytes)), nullptr};
  ParsedSolid parts = format == SolidFormat::medit ? parse_medit(all) : parse_vtu(all);
  SolidFile file{std::move(parts.solid), parts.labels};
  Solid& solid = file.solid;
  for (std::size_t v = 0; v < solid.points.size(); ++v) {
    if (in_range(solid.points[VertexId(v)])) continue;
    fail(all.name, "point ", v, " has a coordinate that is no number up to ", kLargestLength,
         " in size");
  }
  if (solid.cells.empty()) fail(all.name, "has no tetrahedra");
  sort_unique(file.labels);
  for (const std::int64_t label : parts.labels) {
    const auto at = std::ranges::lower_bound(file.labels, label);
    solid.regions.push_back(static_cast<RegionId>(at - file.labels.begin() + 1));
  }
  return file;
}

SolidFile read_solid(const std::string& path) {
  const SolidFormat format = solid_format_of(path);
  if (!is_read(format)) throw InputError("'", path, "': solids are read from .mesh and .vtu");
  return parse_solid(open_file(path).text(), format, path);
}

}  // namespace deliso
