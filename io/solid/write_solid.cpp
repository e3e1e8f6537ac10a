// SPDX-License-Identifier: MIT
#include "io/solid/write_solid.h"

#include <algorithm>
#include <utility>

#include "base/check.h"
#include "base/sorted_list.h"
#include "base/text.h"
#include "io/files/plain_text.h"
#include "io/files/text_scan.h"
#include "io/solid/solid_formats.h"

namespace deliso {
namespace {

struct EndingRow {
  std::string_view ending;
  SolidFormat format;
};
constexpr EndingRow kEndings[] = {{".mesh", SolidFormat::medit}, {".vtu", SolidFormat::vtu},
                                  {".msh", SolidFormat::gmsh},   {".node", SolidFormat::tetgen},
                                  {".ele", SolidFormat::tetgen}, {".face", SolidFormat::tetgen}};

const EndingRow* row_of_ending(std::string_view path) {
  for (const EndingRow& row : kEndings) {
    if (path.size() > row.ending.size() && lower(path).ends_with(row.ending)) return &row;
  }
  return nullptr;
}

// Sets the regions' labels and numbers.
void set_labels(MarkedSolid& marked, const std::vector<RegionLabel>& labels) {
  for (const RegionId r : marked.solid.regions) marked.regions = std::max(marked.regions, r);
  for (const Wall& wall : marked.solid.walls) {
    marked.regions = std::max({marked.regions, wall.front, wall.behind});
  }
  DELISO_CHECK(labels.empty() || labels.size() >= marked.regions);
  bool all_fit = true;
  for (RegionId r = 1; r <= marked.regions; ++r) {
    marked.labels.push_back(labels.empty() ? r : labels[r - 1].number);
    marked.names.push_back(labels.empty() ? "" : plain_name(labels[r - 1].name));
    all_fit &= marked.labels.back() > 0 && std::in_range<std::int32_t>(marked.labels.back());
  }
  for (RegionId r = 1; r <= marked.regions; ++r) {
    marked.numbers.push_back(static_cast<std::int32_t>(all_fit ? marked.labels[r - 1] : r));
  }
}

void set_markers(MarkedSolid& marked) {
  const auto kind_of = [](const Wall& wall) {
    return WallKind{wall.kind, wall.front, wall.behind};
  };
  for (const Wall& wall : marked.solid.walls) marked.kinds.push_back(kind_of(wall));
  sort_unique(marked.kinds);
  for (const Wall& wall : marked.solid.walls) {
    const auto at = std::ranges::lower_bound(marked.kinds, kind_of(wall));
    marked.markers.push_back(static_cast<std::int32_t>(at - marked.kinds.begin() + 1));
  }
}

void set_head(MarkedSolid& marked, const std::string& comment) {
  marked.head.push_back(marked.space.empty() ? "DelIso" : text("DelIso SPACE=", marked.space));
  if (!comment.empty()) marked.head.push_back(comment);
  for (RegionId r = 1; r <= marked.regions; ++r) {
    const std::string& name = marked.names[r - 1];
    if (marked.labels[r - 1] == r && name.empty()) continue;
    marked.head.push_back(text("region ", marked.numbers[r - 1], ": label ", marked.labels[r - 1],
                               name.empty() ? "" : ", ", name));
  }
  const auto number = [&](RegionId r) { return r == kOutside ? 0 : marked.numbers[r - 1]; };
  for (std::size_t m = 1; m <= marked.kinds.size(); ++m) {
    const auto& [kind, front, behind] = marked.kinds[m - 1];
    marked.head.push_back(text("marker ", m, ": region ", number(front), " in front, ",
                               number(behind), " behind, kind ", kind));
  }
  for (std::string& line : marked.head) line = plain_comment(line);
}

SolidFormat format_for(const std::string& path, std::optional<SolidFormat> asked) {
  return asked ? *asked : path == "-" ? SolidFormat::medit : solid_format_of(path);
}

}  // namespace

SolidFormat solid_format_of(std::string_view path) {
  if (const EndingRow* row = row_of_ending(path)) return row->format;
  throw InputError("'", path, "' has no solid format's ending (",
                   joined(kEndings, ", ", [](const EndingRow& row) { return row.ending; }), ")");
}

bool has_solid_ending(std::string_view path) {
  return row_of_ending(path) != nullptr;
}

Solid written_solid(const Solid& solid, const Frame& frame) {
  Solid written = solid;
  for (Vec3& p : written.points) p = frame.to_world(p);
  const bool mirrors = frame.left_handed();
  for (Tetrahedron& v : written.cells) {
    if (mirrors) std::swap(v[2], v[3]);
  }
  for (Wall& wall : written.walls) {
    const bool is_turned = wall.front > wall.behind;
    if (is_turned) std::swap(wall.front, wall.behind);
    if (is_turned != mirrors) std::swap(wall.v[1], wall.v[2]);
  }
  return written;
}

void put_head(AtomicFile& out, const MarkedSolid& marked, std::string_view before,
              std::string_view after) {
  for (const std::string& line : marked.head) out.write(text(before, line, after));
}

void put_point(AtomicFile& out, const Vec3& p, char after) {
  put_text(out, p.x, ' ');
  put_text(out, p.y, ' ');
  put_text(out, p.z, after);
}

std::vector<std::string> solid_files(const std::string& path, std::optional<SolidFormat> format) {
  if (path.empty() || format_for(path, format) != SolidFormat::tetgen) return {path};
  if (path == "-") throw InputError("TetGen's format has three files: none for standard output");
  const std::string base = has_solid_ending(path) ? path.substr(0, path.rfind('.')) : path;
  return {base + ".node", base + ".ele", base + ".face"};
}

void write_solid(const Solid& solid, const Frame& frame, const std::string& path,
                 const SolidWriteOptions& options) {
  MarkedSolid marked;
  marked.solid = written_solid(solid, frame);
  marked.space = short_name_of(frame.space);
  set_labels(marked, options.labels);
  set_markers(marked);
  set_head(marked, options.comment);
  switch (format_for(path, options.format)) {
    case SolidFormat::medit:
      return write_medit(marked, path);
    case SolidFormat::vtu:
      return write_vtu(marked, path);
    case SolidFormat::gmsh:
      return write_gmsh(marked, path);
    case SolidFormat::tetgen:
      return write_tetgen_solid(marked, path);
  }
}

}  // namespace deliso
