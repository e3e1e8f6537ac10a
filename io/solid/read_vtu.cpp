// SPDX-License-Identifier: MIT
// VTU: VTK's XML UnstructuredGrid of one piece of tetrahedra. The markup and the arrays are in
// io/files/vtk_xml.h.
#include "base/text.h"
#include "io/files/vtk_xml.h"
#include "io/solid/solid_formats.h"

namespace deliso {
namespace {

class VtuParser {
 public:
  explicit VtuParser(const Bytes& bytes)
      : name_(bytes.name), xml_(bytes, "UnstructuredGrid", "holds a solid") {}

  ParsedSolid run() {
    read_structure();
    xml_.for_each_point(coordinates_, points_,
                        [&](const Vec3& p) { parts_.solid.points.push_back(p); });
    read_cells();
    return std::move(parts_);
  }

 private:
  void read_structure() {
    std::string_view inside;  // the section that began last
    int pieces = 0;
    bool is_whole = false;
    for (XmlTag tag = xml_.next(); !tag.name.empty(); tag = xml_.next()) {
      const std::string_view name = tag.attribute("Name").value_or("");
      if (tag.name == "Piece") {
        if (++pieces > 1) fail(name_, "has several pieces: only one is supported");
        points_ = xml_.count(tag, "NumberOfPoints", 0);
        cells_ = xml_.count(tag, "NumberOfCells", 0);
        if (points_ > kMostPoints) fail(name_, points_, " points are too many");
        if (cells_ > kMostCells) fail(name_, cells_, " cells are too many");
      } else if (tag.name == "/UnstructuredGrid") {
        is_whole = true;
      } else if (tag.name != "DataArray") {
        if (!tag.name.starts_with('/')) inside = tag.name;
      } else if (inside == "Points") {
        coordinates_ = tag;
      } else if (inside == "Cells") {
        if (name == "connectivity") corners_ = tag;
        if (name == "offsets") ends_ = tag;
        if (name == "types") types_ = tag;
      } else if (inside == "CellData" && name == "region") {
        regions_ = tag;
      }
    }
    if (!is_whole) fail(name_, "ends before </UnstructuredGrid>");
  }

  void read_cells() {
    constexpr std::int64_t kTetrahedron = 10;
    if (cells_ == 0) return;
    const std::string of_cells = text(" of ", cells_, " cells");
    xml_.for_each<std::int64_t>(types_, cells_, "the types" + of_cells, [&](std::int64_t type) {
      if (type != kTetrahedron) fail(name_, "a cell has the type ", type, ": it is no tetrahedron");
    });
    std::int64_t end = 0;
    xml_.for_each<std::int64_t>(ends_, cells_, "the offsets" + of_cells, [&](std::int64_t next) {
      if (next != end + 4) fail(name_, "a cell ends at corner ", next, ", the one before at ", end);
      end = next;
    });
    Tetrahedron cell;
    std::size_t n = 0;
    xml_.for_each<std::int64_t>(
        corners_, 4 * cells_, "the corners" + of_cells, [&](std::int64_t v) {
          if (v < 0 || static_cast<std::uint64_t>(v) >= points_) {
            fail(name_, "a corner of a cell is ", v, ", not one of ", points_, " points");
          }
          cell[n] = VertexId(v);
          if (n == 3) parts_.solid.cells.push_back(cell);
          n = (n + 1) % 4;
        });
    if (regions_.name.empty()) {
      parts_.labels.assign(cells_, 1);
    } else {
      xml_.for_each<std::int64_t>(regions_, cells_, "the regions" + of_cells,
                                  [&](std::int64_t label) { parts_.labels.push_back(label); });
    }
  }

  const std::string& name_;
  VtkXml xml_;
  ParsedSolid parts_;
  std::uint64_t points_ = 0, cells_ = 0;
  XmlTag coordinates_, corners_, ends_, types_, regions_;
};

}  // namespace

ParsedSolid parse_vtu(const Bytes& bytes) {
  return VtuParser(bytes).run();
}

}  // namespace deliso
