// SPDX-License-Identifier: MIT
// glTF 2.0, binary (write_glb.cpp has the layout): the triangles of the scene, where its nodes
// place them. y is up in glTF and z here. Its unit is the meter, which is kept; but a file that
// names a patient's space, as the writer's does, is read in millimeters.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "io/files/field_reader.h"
#include "io/files/input_file.h"
#include "io/files/json_value.h"
#include "io/mesh/mesh_formats.h"
#include "io/mesh/placed_objects.h"

namespace deliso {
namespace {

// Component types, and modes of primitives.
constexpr std::size_t kByte = 5121, kShort = 5123, kInt = 5125, kFloat32 = 5126;
constexpr std::size_t kTriangles = 4;

// Extensions without which a file's triangles are the same.
constexpr std::string_view kHarmless[] = {"KHR_materials_", "KHR_texture_", "KHR_lights_"};

class GlbParser {
 public:
  GlbParser(std::string_view bytes, const std::string& name, const ExpansionBudget& budget)
      : name_(name), placed_(name, bytes.size(), budget) {
    const std::span data = std::as_bytes(std::span(bytes));
    const FieldReader words(data, std::endian::little);
    constexpr std::size_t kHead = 12, kChunkHead = 8;
    if (bytes.size() < kHead + kChunkHead || words.get<std::uint32_t>(0) != kGlbMagic)
      fail("is no binary glTF");
    if (words.get<std::uint32_t>(4) != 2) fail("is not of glTF 2");
    for (std::size_t at = kHead; bytes.size() - at >= kChunkHead;) {
      const std::size_t size = words.get<std::uint32_t>(at);
      const auto kind = words.get<std::uint32_t>(at + 4);
      at += kChunkHead;
      if (size > bytes.size() - at) fail("is cut short");
      if (kind == kGlbJson && json_.is_null()) json_ = parse_json(bytes.substr(at, size), name_);
      if (kind == kGlbBinary && buffer_.empty()) buffer_ = data.subspan(at, size);
      at += size;
    }
    if (json_.kind != JsonValue::Kind::object) fail("has no JSON object");
  }

  MeshParts run() {
    for (const JsonValue& extension : json_["extensionsRequired"].items) {
      if (std::ranges::none_of(kHarmless, [&](std::string_view known) {
            return extension.string.starts_with(known);
          })) {
        fail("needs the extension ", quote(extension.string), ", which is not supported");
      }
    }
    const JsonValue& extras = json_["asset"]["extras"];
    const double unit = extras["SPACE"].is_null() ? 1 : kMeters;
    const AffineMap z_up{{Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, -1, 0}, Vec3{0, 0, 0}}};
    used_.resize(json_["nodes"].items.size());
    meshes_.resize(json_["meshes"].items.size());
    if (!json_["scenes"].is_null()) {
      const JsonValue& scene = item("scenes", count(json_, "scene", 0));
      for (const JsonValue& node : scene["nodes"].items) place(whole(node, "a node"), z_up, 0);
    }
    MeshParts mesh = std::move(placed_.mesh);
    for (Vec3& p : mesh.points) p = p / unit;
    mesh.rounding = std::numeric_limits<float>::epsilon() * extent_ / unit;
    keep_comment(extras["comment"].string, mesh.comments);
    mesh.space = space_named(extras["SPACE"].string);
    return mesh;
  }

 private:
  [[noreturn]] void fail(const auto&... fault) const { deliso::fail(name_, fault...); }

  std::size_t whole(const JsonValue& value, std::string_view what) const {
    const double number = value.number;
    if (value.kind != JsonValue::Kind::number || !(number >= 0 && number < 0x1p53) ||
        number != std::floor(number)) {
      fail(what, " is no whole number");
    }
    return static_cast<std::size_t>(number);
  }
  std::size_t count(const JsonValue& object, std::string_view key,
                    std::optional<std::size_t> missing = {}) const {
    const JsonValue& value = object[key];
    if (value.is_null() && missing) return *missing;
    return whole(value, key);
  }
  const JsonValue& item(std::string_view list, std::size_t n) const {
    const std::vector<JsonValue>& items = json_[list].items;
    if (n >= items.size()) fail("names number ", n, " of ", items.size(), " ", list);
    return items[n];
  }

  // The numbers of an accessor, of positions or else of indices.
  struct Numbers {
    std::size_t at = 0, count = 0, stride = 0, kind = 0;
  };
  Numbers accessor(std::size_t n, bool positions) const {
    const JsonValue& a = item("accessors", n);
    const std::string_view type = positions ? "VEC3" : "SCALAR";
    if (a["type"].string != type) fail("accessor ", n, " is not of type ", type);
    if (!a["sparse"].is_null()) fail("accessor ", n, " is sparse, which is not supported");
    if (a["bufferView"].is_null()) fail("accessor ", n, " has no data");
    const JsonValue& view = item("bufferViews", count(a, "bufferView"));
    const std::size_t buffer = count(view, "buffer");
    if (buffer != 0 || !item("buffers", 0)["uri"].is_null())
      fail("has data in another file, which is not supported");
    const std::size_t kind = count(a, "componentType");
    if (positions && kind != kFloat32) fail("accessor ", n, ": positions are no floats");
    if (!positions && kind != kByte && kind != kShort && kind != kInt)
      fail("accessor ", n, ": indices are no unsigned numbers");
    const std::size_t size = positions ? 12 : kind == kByte ? 1 : kind == kShort ? 2 : 4;
    const std::size_t stride = count(view, "byteStride", size),
                      begin = count(view, "byteOffset", 0), length = count(view, "byteLength"),
                      offset = count(a, "byteOffset", 0), numbers = count(a, "count");
    const bool is_view = begin <= buffer_.size() && length <= buffer_.size() - begin;
    const bool fits = is_view && stride >= size && offset <= length &&
                      (numbers == 0 || (length - offset >= size &&
                                        numbers - 1 <= (length - offset - size) / stride));
    if (!fits) fail("accessor ", n, " reaches beyond the data");
    return {begin + offset, numbers, stride, kind};
  }
  template <class T>
  T number(const Numbers& from, std::size_t n, std::size_t word = 0) const {
    return FieldReader(buffer_, std::endian::little)
        .get<T>(from.at + n * from.stride + word * sizeof(T));
  }

  // Returns the triangles of a mesh. Its vertices at one position are one, by rule R6.
  const MeshParts& mesh(std::size_t n) {
    const JsonValue& described = item("meshes", n);
    std::optional<MeshParts>& made = meshes_[n];
    if (made) return *made;
    made.emplace();
    std::map<std::size_t, std::size_t> first_vertex;  // of an accessor's positions
    for (const JsonValue& primitive : described["primitives"].items) {
      const std::size_t mode = count(primitive, "mode", kTriangles);
      if (mode < kTriangles) continue;  // points and lines
      if (mode > kTriangles) fail("has triangle strips or fans, which are not supported");
      add_primitive(primitive, first_vertex, *made);
    }
    const std::vector<VertexId> merged = merge_points(made->points);
    for (Triangle& t : made->triangles) t = {merged[t[0]], merged[t[1]], merged[t[2]]};
    return *made;
  }

  void add_primitive(const JsonValue& primitive, std::map<std::size_t, std::size_t>& first_vertex,
                     MeshParts& mesh) {
    const std::size_t place = count(primitive["attributes"], "POSITION");
    const Numbers positions = accessor(place, true);
    const auto [at, is_new] = first_vertex.try_emplace(place, mesh.points.size());
    placed_.count(is_new ? positions.count : 0, 0);
    for (std::size_t v = 0; is_new && v < positions.count; ++v) {
      mesh.points.push_back({static_cast<double>(number<float>(positions, v, 0)) + 0.0,
                             static_cast<double>(number<float>(positions, v, 1)) + 0.0,
                             static_cast<double>(number<float>(positions, v, 2)) + 0.0});
    }
    if (mesh.points.size() > kMostVertices) fail("has too many vertices");
    std::optional<Numbers> indices;
    if (!primitive["indices"].is_null()) indices = accessor(count(primitive, "indices"), false);
    const std::size_t corners = indices ? indices->count : positions.count;
    placed_.count(0, corners / 3);
    for (std::size_t c = 0; c + 2 < corners; c += 3) {
      Triangle t;
      for (int i = 0; i < 3; ++i) {
        const std::size_t n = c + static_cast<std::size_t>(i);
        const std::size_t v = !indices                  ? n
                              : indices->kind == kByte  ? number<std::uint8_t>(*indices, n)
                              : indices->kind == kShort ? number<std::uint16_t>(*indices, n)
                                                        : number<std::uint32_t>(*indices, n);
        if (v >= positions.count) fail("a triangle names vertex ", v, " of ", positions.count);
        t[i] = VertexId(at->second + v);
      }
      mesh.triangles.push_back(t);
    }
    mesh.colors.resize(mesh.triangles.size(), color_of(primitive));
  }

  std::array<std::uint8_t, 3> color_of(const JsonValue& primitive) const {
    std::array<std::uint8_t, 3> color = kNoColor;
    if (primitive["material"].is_null()) return color;
    const JsonValue& material = item("materials", count(primitive, "material"));
    const JsonValue& shares = material["pbrMetallicRoughness"]["baseColorFactor"];
    for (std::size_t n = 0; n < color.size() && n < shares.items.size(); ++n) {
      // The first that is not darker: the curve rises.
      const auto share = static_cast<float>(shares.items[n].number);
      color[n] = 0;
      while (color[n] < 255 && linear_of(color[n]) < share) ++color[n];
    }
    return color;
  }

  // Places the meshes of a node and of those below it.
  void place(std::size_t n, const AffineMap& above, int depth) {
    constexpr int kMostDepth = 1000;
    const JsonValue& node = item("nodes", n);
    if (used_[n]++ || depth > kMostDepth) fail("node ", n, " is below itself or two others");
    const AffineMap map = above * map_of(node);
    if (!node["mesh"].is_null()) {
      const MeshParts& object = mesh(count(node, "mesh"));
      placed_.add(object, map);
      for (const Vec3& p : object.points) extent_ = std::max(extent_, distance(map(p), map({})));
    }
    for (const JsonValue& child : node["children"].items)
      place(whole(child, "a node"), map, depth + 1);
  }

  // Returns numbers of a node; `missing` if it has none.
  template <std::size_t N>
  std::array<double, N> numbers(const JsonValue& node, std::string_view key,
                                std::array<double, N> missing) const {
    const JsonValue& value = node[key];
    if (value.is_null()) return missing;
    if (value.items.size() != N) fail("a node has no ", N, " numbers in its ", key);
    for (std::size_t n = 0; n < N; ++n) missing[n] = value.items[n].number;
    return missing;
  }

  // Rows that are 0, 0, 0, 1 at the end are not looked at.
  AffineMap map_of(const JsonValue& node) const {
    if (!node["matrix"].is_null()) {
      const auto m = numbers<16>(node, "matrix", {});
      return {{Vec3{m[0], m[1], m[2]}, Vec3{m[4], m[5], m[6]}, Vec3{m[8], m[9], m[10]},
               Vec3{m[12], m[13], m[14]}}};
    }
    const auto t = numbers<3>(node, "translation", {0, 0, 0}),
               s = numbers<3>(node, "scale", {1, 1, 1});
    const auto [x, y, z, w] = numbers<4>(node, "rotation", {0, 0, 0, 1});
    return {{s[0] * Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
             s[1] * Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
             s[2] * Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
             Vec3{t[0], t[1], t[2]}}};
  }

  const std::string& name_;
  JsonValue json_;
  std::span<const std::byte> buffer_;
  std::vector<std::optional<MeshParts>> meshes_;
  std::vector<int> used_;  // nodes
  double extent_ = 0;      // the largest distance of a vertex from its node
  PlacedObjects placed_;
};

}  // namespace

MeshParts parse_glb(std::string_view bytes, const std::string& name,
                    const ExpansionBudget& budget) {
  return GlbParser(bytes, name, budget).run();
}

}  // namespace deliso
