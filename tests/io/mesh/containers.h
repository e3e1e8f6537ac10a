// SPDX-License-Identifier: MIT
// Files of binary glTF and 3MF from their parts, as other programs might write them.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "io/files/checksum.h"
#include "io/files/deflate.h"
#include "io/files/deflate_writer.h"

namespace deliso::test {

template <class T>
std::string bytes_of_numbers(const std::vector<T>& numbers) {
  std::string bytes(numbers.size() * sizeof(T), '\0');
  if (!numbers.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

inline std::string glb_file(std::string json, std::string data) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  data.resize((data.size() + 3) / 4 * 4);
  std::string file = "glTF" + little(2, 4) + little(28 + json.size() + data.size(), 4);
  file += little(json.size(), 4) + "JSON" + json;
  return file + little(data.size(), 4) + std::string("BIN\0", 4) + data;
}

// How a zip archive is written.
struct ZipForm {
  bool deflated = false;
  bool wide = false;  // sizes and places are in fields of Zip64
};

// Parts are names and contents.
inline std::string zip_file(const std::vector<std::pair<std::string, std::string>>& parts,
                            ZipForm form = {}) {
  std::string file, directory;
  for (const auto& [name, content] : parts) {
    std::string packed = content;
    if (form.deflated) {
      packed = deflate_zlib(content);
      packed = packed.substr(2, packed.size() - 6);
    }
    const std::uint32_t elsewhere = 0xffffffff;
    const auto number = [&](std::uint64_t value) {
      return little(form.wide ? elsewhere : value, 4);
    };
    const std::string extra = form.wide ? little(1, 2) + little(24, 2) + little(content.size(), 8) +
                                              little(packed.size(), 8) + little(file.size(), 8)
                                        : "";
    const std::string common = little(20, 2) + little(0, 2) + little(form.deflated ? 8 : 0, 2) +
                               little(0, 4) + little(crc32(std::as_bytes(std::span(content))), 4) +
                               number(packed.size()) + number(content.size()) +
                               little(name.size(), 2);
    directory += "PK\1\2" + little(20, 2) + common + little(extra.size(), 2) + little(0, 10) +
                 number(file.size()) + name + extra;
    // A field that nobody knows is skipped.
    file += "PK\3\4" + common + little(5, 2) + name + "?\1\1" + little(0, 2) + packed;
  }
  const std::size_t begin = file.size();
  file += directory;
  if (form.wide) {
    const std::size_t end = file.size();
    file += "PK\6\6" + little(44, 8) + little(0, 12) + little(0, 8) + little(parts.size(), 8) +
            little(directory.size(), 8) + little(begin, 8);
    file += "PK\6\7" + little(0, 4) + little(end, 8) + little(1, 4);
  }
  file += "PK\5\6" + little(0, 4) + little(parts.size(), 2) + little(parts.size(), 2) +
          little(directory.size(), 4) + little(form.wide ? 0xffffffff : begin, 4);
  const std::string comment = "a comment";
  return file + little(comment.size(), 2) + comment;
}

inline constexpr const char* kRelations =
    "<Relationships><Relationship Id=\"r\" Target=\"/Model/it.model\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";

// A 3MF with this model.
inline std::string three_mf_file(const std::string& model, ZipForm form = {}) {
  return zip_file({{"_rels/.rels", kRelations}, {"model/IT.model", model}}, form);
}

// A model of a tetrahedron and an object that holds it twice, once mirrored.
inline std::string rich_model() {
  return "<?xml version=\"1.0\"?>\n<!-- made by hand -->\n<model unit=\"centimeter\" "
         "xmlns=\"urn:x\"><metadata name=\"Title\">a &lt; b</metadata><resources>\n"
         "<object id=\"7\" name=\"tetra\" type=\"model\"><mesh><vertices>"
         "<vertex x=\"0\" y='0' z=\"0\"/><vertex y=\"0\" x=\"1\" z=\"0\"/>\n"
         "<vertex x=\"0\" y=\"1e0\" z=\"0\" /><vertex x=\"0\" y=\"0\" z=\"1\"/></vertices>"
         "<triangles><triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/>"
         "<triangle v1=\"1\" v2=\"2\" v3=\"3\" pid=\"1\"/><triangle v1=\"2\" v2=\"0\" v3=\"3\"/>"
         "</triangles></mesh></object>\n<object id=\"two\"><components>"
         "<component objectid=\"7\" transform=\"-1 0 0 0 1 0 0 0 1 10 20 30\"/>"
         "<component objectid=\"7\"/></components></object></resources>\n"
         "<build><item objectid=\"two\" transform=\"0 1 0 -1 0 0 0 0 1 0 0 5\"/></build></model>";
}

// The JSON and the data of glTF: two squares of split vertices (interleaved with normals, 16-bit
// indices), placed by nested nodes; and lines, which are skipped.
inline std::pair<std::string, std::string> rich_gltf() {
  std::vector<float> positions;
  for (const int z : {0, 1}) {
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      for (const int number : {x, y, 0, 0, 0, 1}) positions.push_back(static_cast<float>(number));
      if (z == 1) positions[positions.size() - 6] += 1;  // beside the first square, on its edge
    }
  }
  const std::string data =
      bytes_of_numbers(positions) +
      bytes_of_numbers(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7});
  return {R"({"asset":{"version":"2.0","generator":"a hand \u2014 \"x\""},"scene":0,
"scenes":[{"nodes":[1]}],
"nodes":[{"mesh":0,"scale":[2,2,2]},
{"children":[0,2],"translation":[10,0,0],"rotation":[0,0,0.7071067811865476,0.7071067811865476]},
{"mesh":0,"matrix":[-1,0,0,0,0,1,0,0,0,0,1,0,0,0,5,1]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1},"indices":2},
{"attributes":{"POSITION":0},"mode":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"},
{"bufferView":0,"byteOffset":12,"componentType":5126,"count":8,"type":"VEC3"},
{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":192,"byteStride":24},
{"buffer":0,"byteOffset":192,"byteLength":24}],"buffers":[{"byteLength":216}]})",
          data};
}

}  // namespace deliso::test
