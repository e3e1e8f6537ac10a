// SPDX-License-Identifier: MIT
// 3MF (3D Manufacturing Format, core specification): a zip archive of three parts. The first two
// say where the third is, the mesh as XML. Numbers are text, so they keep double precision. The
// unit is the millimeter, which slicing programs take for every file without one.
#include <limits>
#include <span>
#include <vector>

#include "base/check.h"
#include "base/text.h"
#include "io/files/checksum.h"
#include "io/files/deflate.h"
#include "io/mesh/mesh_formats.h"

namespace deliso {
namespace {

// A zip archive (APPNOTE 6.3) of deflated parts, written in one go: a part's sizes and checksum
// follow its data. The time of all parts is that at which DOS begins.
class ZipWriter {
 public:
  explicit ZipWriter(AtomicFile& out) : out_(out) {}

  void begin(std::string name) {
    parts_.push_back({std::move(name), position_});
    put32(0x04034b50);
    put_common(parts_.back(), kSizesFollow);
    put(parts_.back().name);
    data_begins_ = position_;
  }
  // Adds bytes to the part that was begun.
  void write(std::string_view bytes) {
    text_ += bytes;
    if (text_.size() >= kPiece) deflate_text();
  }
  void end() {
    deflate_text();
    put(stream_.finish());
    stream_ = DeflateStream(Wrapping::none);
    Part& part = parts_.back();
    part.packed_size = position_ - data_begins_;
    if (part.size > kMost || position_ > kMost) {
      throw InputError("cannot write '", out_.path(), "': more than the 4 GiB that 3MF holds here");
    }
    put32(0x08074b50);
    put_sums(part);
  }
  void finish() {
    const std::uint64_t directory = position_;
    for (const Part& part : parts_) {
      put32(0x02014b50);
      put16(kVersion);
      put_common(part, kSizesFollow);
      put16(0);  // size of the comment
      put16(0);  // disk
      put16(0);
      put32(0);  // attributes
      put32(static_cast<std::uint32_t>(part.at));
      put(part.name);
    }
    const std::uint64_t directory_size = position_ - directory;
    const auto count = static_cast<std::uint16_t>(parts_.size());
    put32(0x06054b50);
    put32(0);  // disks
    put16(count);
    put16(count);
    put32(static_cast<std::uint32_t>(directory_size));
    put32(static_cast<std::uint32_t>(directory));
    put16(0);  // size of the comment
  }

 private:
  struct Part {
    std::string name;
    std::uint64_t at = 0, size = 0, packed_size = 0;
    std::uint32_t sum = 0;
  };
  static constexpr std::size_t kPiece = std::size_t{1} << 16;
  static constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint16_t kVersion = 20, kSizesFollow = 8, kDeflated = 8, kDay = 0x21;

  void put(std::string_view bytes) {
    out_.write(bytes);
    position_ += bytes.size();
  }
  void put16(std::uint16_t value) {
    put_binary(out_, value);
    position_ += sizeof value;
  }
  void put32(std::uint32_t value) {
    put_binary(out_, value);
    position_ += sizeof value;
  }
  void put_sums(const Part& part) {
    put32(part.sum);
    put32(static_cast<std::uint32_t>(part.packed_size));
    put32(static_cast<std::uint32_t>(part.size));
  }
  // Writes the fields that a part's header and its entry in the directory have in common. They are
  // 0 in the header where the part is not known yet.
  void put_common(const Part& part, std::uint16_t flags) {
    put16(kVersion);
    put16(flags);
    put16(kDeflated);
    put16(0);  // time
    put16(kDay);
    put_sums(part);
    put16(static_cast<std::uint16_t>(part.name.size()));
    put16(0);  // size of the extra field
  }
  void deflate_text() {
    Part& part = parts_.back();
    part.sum = crc32(std::as_bytes(std::span(text_)), part.sum);
    part.size += text_.size();
    put(stream_.add(text_));
    text_.clear();
  }

  AtomicFile& out_;
  std::vector<Part> parts_;
  DeflateStream stream_{Wrapping::none};
  std::string text_;  // of the part, not yet deflated
  std::uint64_t position_ = 0, data_begins_ = 0;
};

constexpr std::string_view kXml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

void write_vertices(ZipWriter& zip, const WorldMesh& mesh) {
  constexpr std::string_view kBefore[] = {"<vertex x=\"", "y=\"", "z=\""};
  zip.write("<vertices>\n");
  for_each_coordinate(mesh, [&](auto value, int axis) {
    zip.write(kBefore[axis]);
    put_text(zip, value, '"');
    zip.write(axis == 2 ? "/>\n" : " ");
  });
  zip.write("</vertices>\n");
}

void write_triangles(ZipWriter& zip, const WorldMesh& mesh) {
  constexpr std::string_view kBefore[] = {"<triangle v1=\"", "v2=\"", "v3=\""};
  zip.write("<triangles>\n");
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const Triangle t = mesh.triangle(f);
    for (int i = 0; i < 3; ++i) {
      zip.write(kBefore[i]);
      put_text(zip, t[i].number(), '"');
      zip.write(i == 2 ? "/>\n" : " ");
    }
  }
  zip.write("</triangles>\n");
}

// Returns the name as an attribute.
std::string name_attribute(const WorldMesh& mesh) {
  std::string escaped;
  for (const char c : mesh.name()) {
    escaped += c == '&'   ? "&amp;"
               : c == '<' ? "&lt;"
               : c == '>' ? "&gt;"
               : c == '"' ? "&quot;"
                          : std::string(1, c);
  }
  return text(" name=\"", escaped, "\"");
}

// Writes the colors of labels as a resource with this number. A material has a name.
void write_materials(ZipWriter& zip, std::span<const WorldMesh> objects, std::size_t id) {
  zip.write(text("<basematerials id=\"", id, "\">\n"));
  for (const WorldMesh& mesh : objects) {
    zip.write(text("<base", name_attribute(mesh), " displaycolor=\"#"));
    for (const std::uint8_t byte : mesh.options().label->color) {
      constexpr std::string_view kHex = "0123456789ABCDEF";
      zip.write(kHex.substr(byte / 16, 1));
      zip.write(kHex.substr(byte % 16, 1));
    }
    zip.write("\"/>\n");
  }
  zip.write("</basematerials>\n");
}

}  // namespace

void write_3mf(AtomicFile& out, std::span<const WorldMesh> objects) {
  ZipWriter zip(out);
  zip.begin("[Content_Types].xml");
  zip.write(kXml);
  zip.write(R"(<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
)");
  zip.end();
  zip.begin("_rels/.rels");
  zip.write(kXml);
  zip.write(R"(<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Id="model" Target="/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
)");
  zip.end();
  zip.begin("3D/3dmodel.model");
  zip.write(kXml);
  zip.write(objects.front().space_line("<!-- ", " -->\n"));
  zip.write(objects.front().comment_line("<!-- ", " -->\n"));
  zip.write(
      R"(<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<metadata name="Application">DelIso</metadata>
<resources>
)");
  const std::size_t materials = objects.size() + 1;  // objects are numbered from 1
  const bool colored = objects.front().options().label.has_value();
  if (colored) write_materials(zip, objects, materials);
  std::string items;
  for (std::size_t n = 0; n < objects.size(); ++n) {
    const WorldMesh& mesh = objects[n];
    // An object without triangles is not allowed; only a closed one is a solid, a "model".
    if (mesh.face_count() == 0) continue;
    const char* const type = mesh.is_closed() ? "model" : "surface";
    zip.write(text("<object id=\"", n + 1, "\" type=\"", type, "\"", name_attribute(mesh)));
    if (colored) zip.write(text(" pid=\"", materials, "\" pindex=\"", n, "\""));
    zip.write(">\n<mesh>\n");
    write_vertices(zip, mesh);
    write_triangles(zip, mesh);
    zip.write("</mesh>\n</object>\n");
    items += text("<item objectid=\"", n + 1, "\"/>\n");
  }
  zip.write(text("</resources>\n<build>\n", items));
  zip.write("</build>\n</model>\n");
  zip.end();
  zip.finish();
}

}  // namespace deliso
