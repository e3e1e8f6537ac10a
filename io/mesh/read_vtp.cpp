// SPDX-License-Identifier: MIT
// VTP: VTK's XML PolyData. Reads the points of its piece and the polygons. The array `connectivity`
// has the corners of all polygons in order, `offsets` the end of each. The markup and the arrays
// are in io/files/vtk_xml.h.
#include "io/files/input_file.h"
#include "io/files/vtk_xml.h"
#include "io/mesh/mesh_parsers.h"

namespace deliso {
namespace {

class VtpParser {
 public:
  VtpParser(std::string_view bytes, const std::string& name)
      : bytes_{name, std::as_bytes(std::span(bytes)), nullptr},
        xml_(bytes_, "PolyData", "holds a mesh") {}

  MeshParts run() {
    MeshParts mesh;
    for (const std::string_view comment : xml_.comments()) keep_comment(comment, mesh.comments);
    read_structure();
    xml_.for_each_point(coordinates_, points_, [&](const Vec3& p) { mesh.points.push_back(p); });
    read_polygons(mesh);
    read_values(mesh);
    mesh.space = space();
    return mesh;
  }

 private:
  [[noreturn]] void fail(const auto&... fault) const { deliso::fail(bytes_.name, fault...); }

  void read_structure() {
    std::string_view inside;  // the section that began last
    int pieces = 0;
    bool whole = false;
    for (XmlTag tag = xml_.next(); !tag.name.empty(); tag = xml_.next()) {
      if (tag.name == "Piece") {
        if (++pieces > 1) fail("has several pieces: only one is supported");
        points_ = xml_.count(tag, "NumberOfPoints", 0);
        polygons_ = xml_.count(tag, "NumberOfPolys", 0);
        has_other_cells_ =
            xml_.count(tag, "NumberOfVerts", 0) > 0 || xml_.count(tag, "NumberOfLines", 0) > 0;
        if (xml_.count(tag, "NumberOfStrips", 0) != 0)
          fail("has triangle strips, which are not supported");
        if (points_ > kMostVertices) fail(points_, " points are too many");
        if (polygons_ > kMostFaces) fail(polygons_, " polygons are too many");
      } else if (tag.name == "/PolyData") {
        whole = true;
      } else if (tag.name == "Array" && tag.attribute("Name") == "SPACE") {
        space_ = tag;
      } else if (tag.name != "DataArray") {
        if (!tag.name.starts_with('/')) inside = tag.name;
      } else if (inside == "Points") {
        coordinates_ = tag;
      } else if (inside == "Polys") {
        if (tag.attribute("Name") == "offsets") offsets_ = tag;
        if (tag.attribute("Name") == "connectivity") connectivity_ = tag;
      } else if (inside == "CellData") {
        if (tag.attribute("Name") == "color") colors_ = tag;
        if (tag.attribute("Name") == "label_front") fronts_ = tag;
        if (tag.attribute("Name") == "label_behind") behinds_ = tag;
      }
    }
    if (!whole) fail("ends before </PolyData>");
  }

  // Returns the space in the field data: a text, as character codes that end with 0.
  AnatomicalSpace space() const {
    constexpr std::size_t kCodes = 4;
    std::string name;
    if (space_.name.empty()) return AnatomicalSpace::unknown;
    if (xml_.is_text(space_)) {
      for (const std::string_view word : words_of(xml_.inside(space_).text())) {
        name += static_cast<char>(to_int(word).value_or(0));
      }
    } else {
      try {
        name = xml_.binary(space_, kCodes, "the space").text();
      } catch (const InputError&) {
        return AnatomicalSpace::unknown;  // some other text
      }
    }
    return space_named(name.c_str());
  }

  void read_polygons(MeshParts& mesh) {
    if (polygons_ == 0) return;
    std::vector<std::uint64_t> ends;
    std::uint64_t last = 0;
    xml_.for_each<std::int64_t>(
        offsets_, polygons_, text("the offsets of ", polygons_, " polygons"),
        [&](std::int64_t end) {
          const auto next = static_cast<std::uint64_t>(end);
          if (end < 0 || next < last || next - last < 3 || next > kMostCorners)
            fail("polygon ", ends.size(), " ends at corner ", end, ", the one before at ", last);
          ends.push_back(last = next);
        });
    std::vector<VertexId> corners;
    std::size_t polygon = 0;
    std::uint64_t n = 0;
    xml_.for_each<std::int64_t>(
        connectivity_, last, text("the corners of ", polygons_, " polygons"), [&](std::int64_t v) {
          if (v < 0 || static_cast<std::uint64_t>(v) >= points_)
            fail("a corner of polygon ", polygon, " is ", v, ", not one of ", points_, " points");
          corners.emplace_back(v);
          if (++n < ends[polygon]) return;
          mesh.add_polygon(corners);
          corners.clear();
          triangle_ends_.push_back(mesh.triangles.size());
          ++polygon;
        });
  }

  // Reads the values that write_mesh gives polygons, if they have its types.
  void read_values(MeshParts& mesh) const {
    const auto is_of = [&](const XmlTag& array, std::string_view type, std::uint64_t components) {
      return array.attribute("type") == type &&
             xml_.count(array, "NumberOfComponents", 1) == components;
    };
    if (polygons_ == 0 || has_other_cells_) return;
    // Calls put(triangle, component, value) for the triangles of each polygon.
    const auto for_each_triangle = [&](const XmlTag& array, std::size_t components, auto put) {
      std::size_t n = 0;
      xml_.for_each<std::int64_t>(array, components * polygons_, "the values of polygons",
                                  [&](std::int64_t value) {
                                    const std::size_t polygon = n / components;
                                    std::size_t t = polygon == 0 ? 0 : triangle_ends_[polygon - 1];
                                    for (; t < triangle_ends_[polygon]; ++t)
                                      put(t, n % components, value);
                                    ++n;
                                  });
    };
    if (is_of(colors_, "UInt8", 3)) {
      mesh.colors.resize(mesh.triangles.size());
      for_each_triangle(colors_, 3, [&](std::size_t t, std::size_t n, std::int64_t byte) {
        mesh.colors[t][n] = static_cast<std::uint8_t>(byte);
      });
    }
    const auto has_labels = [&](const XmlTag& array) {
      return is_of(array, "Int32", 1) || is_of(array, "Int64", 1);
    };
    if (!has_labels(fronts_) || !has_labels(behinds_)) return;
    mesh.sides.resize(mesh.triangles.size());
    for (const std::size_t side : {0, 1}) {
      for_each_triangle(
          side == 0 ? fronts_ : behinds_, 1,
          [&](std::size_t t, std::size_t, std::int64_t label) { mesh.sides[t][side] = label; });
    }
  }

  static constexpr std::uint64_t kMostCorners = std::uint64_t{1} << 40;  // no product overflows

  Bytes bytes_;
  VtkXml xml_;
  std::uint64_t points_ = 0, polygons_ = 0;
  bool has_other_cells_ = false;            // before the polygons, in the arrays of cells
  std::vector<std::size_t> triangle_ends_;  // of each polygon
  XmlTag coordinates_, connectivity_, offsets_, space_, colors_, fronts_, behinds_;
};

}  // namespace

MeshParts parse_vtp(std::string_view bytes, const std::string& name,
                    const ExpansionBudget& /*budget*/) {
  return VtpParser(bytes, name).run();
}

}  // namespace deliso
