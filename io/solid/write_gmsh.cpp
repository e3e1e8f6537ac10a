// SPDX-License-Identifier: MIT
// Gmsh's .msh, version 4.1 as text (Gmsh reference manual, "MSH file format"). Entities are a
// volume for each region and a surface for each marker, which bounds the volumes of its sides. Each
// is a physical group of its own, so that solvers find regions and walls by number or name. Points
// on walls are in the surface of the first wall that has them, other points in the volume of a
// cell.
#include <algorithm>
#include <vector>

#include "base/box3.h"
#include "base/text.h"
#include "io/solid/solid_formats.h"

namespace deliso {
namespace {

constexpr std::size_t kLongestName = 100;  // bytes: Gmsh reads 127

// Returns a name for quotes, cut at the beginning of a UTF-8 sequence.
std::string quoted_name(std::string name) {
  std::ranges::replace(name, '"', '\'');
  std::size_t end = std::min(name.size(), kLongestName);
  while (end < name.size() && end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0u) == 0x80) {
    --end;
  }
  return name.substr(0, end);
}

// What is in one entity, by number.
using Members = std::vector<std::vector<std::size_t>>;

// Returns the least box of an entity's points, as text.
template <class Elements, class CornersOf>
std::string box_text(const Solid& solid, const Elements& elements, CornersOf corners_of) {
  if (elements.empty()) return "0 0 0 0 0 0 ";
  const Vec3 first = solid.points[corners_of(elements.front())[0]];
  Box3 box{first, first};
  for (const std::size_t n : elements) {
    for (const VertexId v : corners_of(n)) box = united(box, {solid.points[v], solid.points[v]});
  }
  const auto& [lo, hi] = box;
  return text(lo.x, " ", lo.y, " ", lo.z, " ", hi.x, " ", hi.y, " ", hi.z, " ");
}

class GmshFile {
 public:
  GmshFile(AtomicFile& out, const MarkedSolid& marked)
      : out_(out),
        marked_(marked),
        solid_(marked.solid),
        walls_(marked.kinds.size()),
        cells_(marked.regions) {
    for (std::size_t w = 0; w < solid_.walls.size(); ++w) {
      walls_[static_cast<std::size_t>(marked.markers[w] - 1)].push_back(w);
    }
    for (std::size_t c = 0; c < solid_.cells.size(); ++c) {
      cells_[solid_.regions[c] - 1].push_back(c);
    }
  }

  void write() {
    out_.write("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\n");
    put_head(out_, marked_, "", "\n");
    out_.write("$EndComments\n");
    write_names();
    write_entities();
    write_points();
    write_elements();
  }

 private:
  std::string region_name(RegionId r) const {
    if (r == kOutside) return "outside";
    const std::string& name = marked_.names[r - 1];
    return name.empty() ? text(marked_.numbers[r - 1]) : name;
  }

  void write_names() {
    std::vector<std::string> lines;
    for (std::size_t m = 0; m < marked_.kinds.size(); ++m) {
      const auto& [kind, front, behind] = marked_.kinds[m];
      if (!is_named(front) && !is_named(behind)) continue;
      const std::string name = region_name(behind) + "|" + region_name(front);
      lines.push_back(
          text("2 ", m + 1, " \"", quoted_name(kind == 0 ? name : text(name, " ", kind)), "\"\n"));
    }
    for (RegionId r = 1; r <= marked_.regions; ++r) {
      if (!is_named(r)) continue;
      lines.push_back(
          text("3 ", marked_.numbers[r - 1], " \"", quoted_name(region_name(r)), "\"\n"));
    }
    if (lines.empty()) return;
    out_.write(
        text("$PhysicalNames\n", lines.size(), "\n", joined(lines, ""), "$EndPhysicalNames\n"));
  }
  bool is_named(RegionId r) const { return r != kOutside && !marked_.names[r - 1].empty(); }

  void write_entities() {
    out_.write(text("$Entities\n0 0 ", walls_.size(), " ", cells_.size(), "\n"));
    for (std::size_t m = 0; m < walls_.size(); ++m) {
      out_.write(text(m + 1, " ",
                      box_text(solid_, walls_[m], [&](std::size_t w) { return solid_.walls[w].v; }),
                      "1 ", m + 1, " 0\n"));
    }
    for (RegionId r = 1; r <= marked_.regions; ++r) {
      std::string bounds;
      std::size_t count = 0;
      for (std::size_t m = 0; m < walls_.size(); ++m) {
        const auto& [kind, front, behind] = marked_.kinds[m];
        if ((front == r) == (behind == r)) continue;
        bounds += text(behind == r ? " " : " -", m + 1);
        ++count;
      }
      out_.write(text(
          r, " ", box_text(solid_, cells_[r - 1], [&](std::size_t c) { return solid_.cells[c]; }),
          "1 ", marked_.numbers[r - 1], " ", count, bounds, "\n"));
    }
    out_.write("$EndEntities\n");
  }

  void write_points() {
    // Points by entity: surfaces, then volumes. Those of no cell are in the first.
    Members of(walls_.size() + cells_.size());
    std::vector<std::size_t> entity(solid_.points.size(), 0);
    for (std::size_t c = solid_.cells.size(); c-- > 0;) {
      for (const VertexId v : solid_.cells[c]) entity[v] = walls_.size() + solid_.regions[c] - 1;
    }
    for (std::size_t w = solid_.walls.size(); w-- > 0;) {
      for (const VertexId v : solid_.walls[w].v) {
        entity[v] = static_cast<std::size_t>(marked_.markers[w] - 1);
      }
    }
    if (of.empty()) of.emplace_back();
    for (std::size_t v = 0; v < entity.size(); ++v) of[entity[v]].push_back(v);
    out_.write(text("$Nodes\n", blocks_of(of), " ", entity.size(), " 1 ", entity.size(), "\n"));
    for (std::size_t e = 0; e < of.size(); ++e) {
      if (of[e].empty()) continue;
      const bool is_surface = e < walls_.size();
      out_.write(text(is_surface ? "2 " : "3 ", is_surface ? e + 1 : e - walls_.size() + 1, " 0 ",
                      of[e].size(), "\n"));
      for (const std::size_t v : of[e]) put_text(out_, v + 1, '\n');
      for (const std::size_t v : of[e]) put_point(out_, solid_.points[VertexId(v)], '\n');
    }
    out_.write("$EndNodes\n");
  }

  void write_elements() {
    constexpr int kTriangle = 2, kTetrahedron = 4;  // Gmsh's types of elements
    const std::size_t all = solid_.walls.size() + solid_.cells.size();
    out_.write(
        text("$Elements\n", blocks_of(walls_) + blocks_of(cells_), " ", all, " 1 ", all, "\n"));
    write_blocks(2, kTriangle, walls_, [&](std::size_t w) { return solid_.walls[w].v; });
    write_blocks(3, kTetrahedron, cells_, [&](std::size_t c) { return solid_.cells[c]; });
    out_.write("$EndElements\n");
  }

  static std::ptrdiff_t blocks_of(const Members& members) {
    return std::ranges::count_if(members, [](const auto& list) { return !list.empty(); });
  }
  template <class CornersOf>
  void write_blocks(int dimension, int type, const Members& members, CornersOf corners_of) {
    for (std::size_t e = 0; e < members.size(); ++e) {
      if (members[e].empty()) continue;
      out_.write(text(dimension, " ", e + 1, " ", type, " ", members[e].size(), "\n"));
      for (const std::size_t n : members[e]) {
        put_text(out_, ++elements_, ' ');
        for (const VertexId v : corners_of(n)) put_text(out_, std::uint64_t{v} + 1, ' ');
        out_.write("\n");
      }
    }
  }

  AtomicFile& out_;
  const MarkedSolid& marked_;
  const Solid& solid_;
  Members walls_, cells_;  // by marker, by region
  std::size_t elements_ = 0;
};

}  // namespace

void write_gmsh(const MarkedSolid& marked, const std::string& path) {
  AtomicFile out(path);
  GmshFile(out, marked).write();
  out.commit();
}

}  // namespace deliso
