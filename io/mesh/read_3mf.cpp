// SPDX-License-Identifier: MIT
// 3MF (write_3mf.cpp): the triangles of all objects that are to be built, where they are placed, in
// millimeters. Of colors those of objects are read; the extensions for slices and beams are
// skipped.
#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "io/files/input_file.h"
#include "io/files/vtk_xml.h"
#include "io/files/zip_archive.h"
#include "io/mesh/placed_objects.h"

namespace deliso {
namespace {

// Millimeters in a unit.
constexpr std::pair<std::string_view, double> kUnits[] = {{"micron", 0.001},  {"millimeter", 1},
                                                          {"centimeter", 10}, {"inch", 25.4},
                                                          {"foot", 304.8},    {"meter", 1000}};

class ThreeMfParser {
 public:
  ThreeMfParser(std::string_view bytes, const std::string& name, const ExpansionBudget& budget)
      : name_(name),
        archive_({name_, std::as_bytes(std::span(bytes)), nullptr}),
        placed_(name, bytes.size(), budget) {}

  MeshParts run() {
    const Bytes model = archive_.part(model_name());
    std::vector<std::string_view> comments;
    read_model(model.text(), comments);
    for (const auto& [object, map] : build_) place(object, map, 0);
    for (Vec3& p : placed_.mesh.points) p = unit_ * p;
    for (const std::string_view comment : comments) keep_comment(comment, placed_.mesh.comments);
    return std::move(placed_.mesh);
  }

 private:
  using Place = std::pair<std::string, AffineMap>;  // of the object with this id
  using Color = std::array<std::uint8_t, 3>;
  struct Object {
    MeshParts mesh;
    std::vector<Place> components;
  };

  [[noreturn]] void fail(const auto&... fault) const { deliso::fail(name_, fault...); }

  std::string model_name() const {
    const Bytes relations = archive_.part("_rels/.rels");
    std::size_t at = 0;
    for (XmlTag tag = next_tag(relations.text(), at); !tag.name.empty();
         tag = next_tag(relations.text(), at)) {
      at = tag.end;
      std::string_view target = tag.attribute("Target").value_or("");
      if (!tag.attribute("Type").value_or("").ends_with("/3dmodel") || target.empty()) continue;
      if (target.starts_with('/')) target.remove_prefix(1);
      return std::string(target);
    }
    fail("is a zip archive without a 3D model");
  }

  void read_model(std::string_view xml, std::vector<std::string_view>& comments) {
    Object* object = nullptr;
    std::vector<Color>* material = nullptr;
    std::optional<Color> color;  // of the object
    bool whole = false;
    std::vector<std::string_view>* head = &comments;
    XmlTag tag = next_tag(xml, 0, head);
    for (; !tag.name.empty(); tag = next_tag(xml, tag.end)) {
      if (tag.name == "vertex" && object) {
        object->mesh.points.push_back({real(tag, "x"), real(tag, "y"), real(tag, "z")});
        if (object->mesh.points.size() > kMostVertices) fail("has too many vertices");
      } else if (tag.name == "triangle" && object) {
        object->mesh.triangles.push_back(
            {corner(tag, "v1", *object), corner(tag, "v2", *object), corner(tag, "v3", *object)});
      } else if (tag.name == "object") {
        object = &objects_[std::string(tag.attribute("id").value_or(""))];
        if (!object->mesh.points.empty() || !object->components.empty())
          fail("has two objects of one id");
        color = color_of(tag);
      } else if (tag.name == "/object" && object) {
        if (color) object->mesh.colors.assign(object->mesh.triangles.size(), *color);
        object = nullptr;
      } else if (tag.name == "basematerials") {
        material = &materials_[std::string(tag.attribute("id").value_or(""))];
      } else if (tag.name == "base" && material) {
        material->push_back(color_in(tag.attribute("displaycolor").value_or("")));
      } else if (tag.name == "component" && object) {
        object->components.push_back(place_in(tag));
      } else if (tag.name == "item") {
        build_.push_back(place_in(tag));
      } else if (tag.name == "model") {
        const std::string_view unit = tag.attribute("unit").value_or("millimeter");
        const auto known =
            std::ranges::find(kUnits, unit, &std::pair<std::string_view, double>::first);
        if (known == std::end(kUnits)) fail("unit ", quote(unit), " is not known");
        unit_ = known->second;
      } else if (tag.name == "/model") {
        whole = true;
      }
    }
    if (!whole) fail("its model ends before </model>");
  }

  // Returns the color in "#RRGGBB", whatever follows.
  static Color color_in(std::string_view text) {
    Color color = kNoColor;
    for (std::size_t n = 0; n < color.size() && text.starts_with('#'); ++n) {
      const std::string_view digits = text.substr(std::min(1 + 2 * n, text.size())).substr(0, 2);
      std::uint8_t byte = 0;
      if (std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16).ec == std::errc())
        color[n] = byte;
    }
    return color;
  }
  // Returns the color that an object names.
  std::optional<Color> color_of(const XmlTag& object) const {
    const auto colors = materials_.find(std::string(object.attribute("pid").value_or("")));
    const auto n = number_in<std::size_t>(object.attribute("pindex").value_or(""));
    if (colors == materials_.end() || !n || *n >= colors->second.size()) return std::nullopt;
    return colors->second[*n];
  }

  double real(const XmlTag& tag, std::string_view key) const {
    const std::string_view word = trimmed(tag.attribute(key).value_or(""));
    const auto value = to_double(word);
    if (!value) fail("attribute ", key, " of a ", tag.name, " is ", quote(word));
    return *value;
  }

  VertexId corner(const XmlTag& tag, std::string_view key, const Object& object) const {
    const std::string_view word = trimmed(tag.attribute(key).value_or(""));
    const auto value = number_in<std::uint64_t>(word);
    if (!value || *value >= object.mesh.points.size()) {
      fail("corner ", key, " of a triangle is ", quote(word), ", not one of ",
           object.mesh.points.size(), " vertices");
    }
    return VertexId(*value);
  }

  Place place_in(const XmlTag& tag) const {
    if (tag.attributes.find(":path") != std::string_view::npos)
      fail("has objects in further parts of the archive, which is not supported");
    AffineMap map;
    if (const auto words = tag.attribute("transform")) {
      const auto m = to_doubles(*words);
      if (!m || m->size() != 12) fail("transform ", quote(*words), " is not 12 numbers");
      for (std::size_t n = 0; n < 4; ++n)
        map.columns[n] = {(*m)[3 * n], (*m)[3 * n + 1], (*m)[3 * n + 2]};
    }
    return {std::string(tag.attribute("objectid").value_or("")), map};
  }

  void place(const std::string& id, const AffineMap& map, int depth) {
    constexpr int kMostDepth = 100;
    const auto object = objects_.find(id);
    if (object == objects_.end()) fail("has no object ", quote(id));
    if (depth > kMostDepth && !object->second.components.empty())
      fail("object ", quote(id), " is a component of itself");
    placed_.add(object->second.mesh, map);
    for (const auto& [component, inner] : object->second.components)
      place(component, map * inner, depth + 1);
  }

  const std::string& name_;
  ZipArchive archive_;
  std::map<std::string, Object> objects_;
  std::map<std::string, std::vector<Color>> materials_;  // the colors of each list
  std::vector<Place> build_;
  double unit_ = 1;
  PlacedObjects placed_;
};

}  // namespace

MeshParts parse_3mf(std::string_view bytes, const std::string& name,
                    const ExpansionBudget& budget) {
  return ThreeMfParser(bytes, name, budget).run();
}

}  // namespace deliso
