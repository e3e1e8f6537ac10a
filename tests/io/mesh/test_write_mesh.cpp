// SPDX-License-Identifier: MIT
// Files of the writers: text byte by byte, binary decoded by hand. The bytes are the same in every
// locale, and a fault leaves no file.
#include <doctest/doctest.h>

#include <clocale>
#include <cstring>
#include <locale>

#include "base/check.h"
#include "base/triangle.h"
#include "io/mesh/read_mesh.h"
#include "io/mesh/written_mesh.h"
#include "refusal.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr MeshFormat kFormats[] = {MeshFormat::ply,      MeshFormat::off,   MeshFormat::obj,
                                   MeshFormat::stl,      MeshFormat::vtp,   MeshFormat::glb,
                                   MeshFormat::three_mf, MeshFormat::smesh, MeshFormat::poly};

// Numbers that show the shortest form. The frame, even the plain one, makes -0 a 0.
TriMesh triangle() {
  return make_tri_mesh({{0.1, -0.0, 1e300}, {1.0 / 3, 2, 1e-7}, {-5, 123456789, 0.5}},
                       Triangles{{0, 1, 2}});
}

// The number behind `key` in text.
std::size_t attribute(const std::string& text, const std::string& key, std::size_t from = 0) {
  const std::size_t at = text.find(key + "=\"", from);
  REQUIRE(at != std::string::npos);
  return std::stoull(text.substr(at + key.size() + 2));
}

std::string write_error(const std::string& path) {
  return refusal_by([&] { write_mesh(triangle(), path); });
}

}  // namespace

TEST_CASE("the text formats") {
  CHECK(written(triangle(), {.format = MeshFormat::ply, .ascii = true}) ==
        "ply\nformat ascii 1.0\ncomment DelIso\nelement vertex 3\nproperty double x\n"
        "property double y\nproperty double z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n"
        "0.1 0 1e+300\n0.3333333333333333 2 1e-07\n-5 123456789 0.5\n3 0 1 2\n");
  CHECK(written(triangle(), {.format = MeshFormat::off}) ==
        "OFF\n3 1 0\n0.1 0 1e+300\n0.3333333333333333 2 1e-07\n-5 123456789 0.5\n3 0 1 2\n");
  CHECK(written(triangle(), {.format = MeshFormat::obj}) ==
        "# DelIso\nv 0.1 0 1e+300\nv 0.3333333333333333 2 1e-07\nv -5 123456789 0.5\nf 1 2 3\n");
  CHECK(written(triangle(), {.format = MeshFormat::smesh}) ==
        "# DelIso\n3 3 0 0\n0 0.1 0 1e+300\n1 0.3333333333333333 2 1e-07\n2 -5 123456789 0.5\n"
        "1 1\n3 0 1 2 1\n0\n0\n");
  CHECK(written(triangle(), {.format = MeshFormat::poly, .comment = "a", .first_cap = 0}) ==
        "# DelIso\n# a\n3 3 0 0\n0 0.1 0 1e+300\n1 0.3333333333333333 2 1e-07\n"
        "2 -5 123456789 0.5\n1 1\n1 0 2\n3 0 1 2\n0\n0\n");
  TriMesh small = triangle();
  small.points[0].z = 1e30;
  CHECK(written(small, {.format = MeshFormat::obj, .single_precision = true}) ==
        "# DelIso\nv 0.1 0 1e+30\nv 0.33333334 2 1e-07\nv -5 123456792 0.5\nf 1 2 3\n");
  CHECK(written(small, {.format = MeshFormat::ply, .single_precision = true, .ascii = true})
            .find("property float x\n") != std::string::npos);
}

// test_read_stl.cpp has the corners.
TEST_CASE("binary STL: normals by the right-hand rule") {
  TriMesh mesh = random_sphere(8);
  mesh.points[mesh.faces[3].v[0]] = mesh.points[mesh.faces[3].v[1]];  // one facet of no area
  const std::string bytes = written(mesh, {.format = MeshFormat::stl});
  REQUIRE(bytes.size() == 84 + 50 * mesh.faces.size());
  CHECK_FALSE(bytes.starts_with("solid"));
  std::size_t at = 84, flat = 0;
  for (const Face& face : mesh.faces) {
    Vec3 normal;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      normal[static_cast<int>(axis)] = number_at<float>(bytes, at + 4 * axis);
    }
    CHECK(number_at<std::uint16_t>(bytes, at + 48) == 0);
    at += 50;
    const Vec3 n =
        area_normal(mesh.points[face.v[0]], mesh.points[face.v[1]], mesh.points[face.v[2]]);
    if (length(n) == 0) {
      ++flat;
      CHECK(normal == Vec3{});
    } else {
      CHECK(distance(normal, n / length(n)) < 1e-6);
    }
  }
  CHECK(flat >= 1);
}

TEST_CASE("PLY holds values of vertices and facets, as text and as bytes") {
  const TriMesh mesh = mesh_of(tetrahedron());
  MeshWriteOptions options = with_attributes(mesh, MeshFormat::ply);
  options.ascii = true;
  CHECK(written(mesh, options) ==
        "ply\nformat ascii 1.0\ncomment DelIso\nelement vertex 4\nproperty double x\n"
        "property double y\nproperty double z\nproperty float nx\nproperty float ny\n"
        "property float nz\nelement face 4\nproperty list uchar int vertex_indices\n"
        "property int component\nproperty float distance\nproperty uchar cap\nend_header\n"
        "0 0 0 0 0.5 0\n1 1 1 1 -0.5 0.1\n2 4 8 2 -1.5 0.2\n3 9 27 3 -2.5 0.3\n"
        "3 0 2 1 0 0 0\n3 0 1 3 0 0.1 0\n3 1 2 3 1 0.2 0\n3 2 0 3 1 0.3 1\n");
  options.first_cap.reset();
  CHECK(written(mesh, options).find("uchar cap") == std::string::npos);
  CHECK(written(mesh, options).ends_with("3 2 0 3 1 0.3\n"));

  options = with_attributes(mesh, MeshFormat::ply);
  const std::string bytes = written(mesh, options);
  const std::size_t begin = bytes.find("end_header\n") + 11, vertex = 3 * 8 + 3 * 4;
  const std::size_t facets = begin + 4 * vertex, facet = 1 + 3 * 4 + 4 + 4 + 1;
  REQUIRE(bytes.size() == facets + 4 * facet);
  CHECK(number_at<float>(bytes, begin + 2 * vertex + 24 + 4) == -1.5f);
  CHECK(number_at<std::uint32_t>(bytes, facets + 2 * facet + 13) == 1);
  CHECK(number_at<float>(bytes, facets + 3 * facet + 17) == 0.1f * 3);
  CHECK(bytes[facets + 2 * facet + 21] == 0);
  CHECK(bytes[facets + 3 * facet + 21] == 1);
  CHECK(parse_mesh(bytes, MeshFormat::ply, "m").points == mesh.points);
}

TEST_CASE("VTP holds values of vertices and facets as its point and cell data") {
  const TriMesh mesh = mesh_of(tetrahedron());
  MeshWriteOptions options = with_attributes(mesh, MeshFormat::vtp);
  const std::string bytes = written(mesh, options);
  const std::string mark = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t data = bytes.find(mark) + mark.size();
  const auto array = [&](const std::string& name, std::size_t size) {
    const std::size_t at = data + attribute(bytes, "offset", bytes.find("Name=\"" + name + "\""));
    CHECK(number_at<std::uint64_t>(bytes, at) == size);
    return at + 8;
  };
  const std::size_t normals = array("Normals", 48), components = array("component", 16);
  const std::size_t distances = array("distance", 16), caps = array("cap", 4);
  for (std::size_t n = 0; n < 4; ++n) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      CHECK(number_at<float>(bytes, normals + 12 * n + 4 * axis) ==
            options.attributes->normals[n][axis]);
    }
    CHECK(number_at<std::uint32_t>(bytes, components + 4 * n) == n / 2);
    CHECK(number_at<float>(bytes, distances + 4 * n) == options.attributes->distance[n]);
    CHECK(bytes[caps + n] == (n >= 3 ? 1 : 0));
  }
  CHECK(bytes.substr(caps + 4) == "\n  </AppendedData>\n</VTKFile>\n");
  const TriMesh read = parse_mesh(bytes, MeshFormat::vtp, "m");
  CHECK(read.points == mesh.points);
  CHECK(read.faces[3].v == mesh.faces[3].v);
  options.first_cap.reset();
  CHECK(written(mesh, options).find("\"cap\"") == std::string::npos);
}

namespace {

// Holds that with the options, or in the space, the first `old` of the file is another text, and
// nothing else changes.
void check_head(const TriMesh& mesh, MeshFormat format, const std::string& old,
                const std::string& now, AnatomicalSpace space, const std::string& comment) {
  CAPTURE(now);
  std::string expected = written(mesh, {.format = format});
  const std::size_t at = expected.find(old);
  REQUIRE(at != std::string::npos);
  expected.replace(at, old.size(), now);
  TriMesh placed = mesh;
  placed.frame.space = space;
  CHECK(written(placed, {.format = format, .comment = comment}) == expected);
}

}  // namespace

TEST_CASE("an anatomical space and a comment are in the head; nothing else changes") {
  const TriMesh mesh = random_sphere(3);
  const auto in_space = [&](MeshFormat format, const std::string& old, const std::string& now) {
    check_head(mesh, format, old, now, AnatomicalSpace::lps, "");
  };
  in_space(MeshFormat::ply, "comment DelIso", "comment DelIso SPACE=LPS");
  in_space(MeshFormat::obj, "# DelIso", "# DelIso SPACE=LPS");
  in_space(MeshFormat::stl, "DelIso          ", "DelIso SPACE=LPS");
  in_space(MeshFormat::vtp, "<PolyData>\n",
           "<PolyData>\n    <FieldData>\n      <Array type=\"String\" Name=\"SPACE\" "
           "NumberOfTuples=\"1\" format=\"ascii\">76 80 83 0</Array>\n    </FieldData>\n");
  in_space(MeshFormat::smesh, "# DelIso", "# DelIso SPACE=LPS");
  in_space(MeshFormat::off, "OFF\n", "OFF\n# DelIso SPACE=LPS\n");

  TriMesh placed = random_sphere(4);
  placed.frame.space = AnatomicalSpace::ras;
  const std::string comment = "deliso 0.1.0 max-distance=0.1 r-min=0.5 lambda=2";
  const auto noted = [&](MeshFormat format, const std::string& old, const std::string& line) {
    check_head(placed, format, old, old + line + "\n", AnatomicalSpace::ras, comment);
  };
  noted(MeshFormat::ply, "comment DelIso SPACE=RAS\n", "comment " + comment);
  noted(MeshFormat::obj, "# DelIso SPACE=RAS\n", "# " + comment);
  noted(MeshFormat::off, "OFF\n# DelIso SPACE=RAS\n", "# " + comment);
  noted(MeshFormat::vtp, "<?xml version=\"1.0\"?>\n", "<!-- " + comment + " -->");
}

TEST_CASE("STL has a comment where the header has room for all of it") {
  TriMesh mesh = random_sphere(4);
  const std::string plain = written(mesh, {.format = MeshFormat::stl});
  for (std::size_t size = 1; size < 100; ++size) {
    for (const bool space : {false, true}) {
      MeshWriteOptions options{.format = MeshFormat::stl};
      mesh.frame.space = space ? AnatomicalSpace::lps : AnatomicalSpace::unknown;
      options.comment = std::string(size, 'x');
      const std::string bytes = written(mesh, options);
      CHECK(bytes.size() == plain.size());
      CHECK(bytes.substr(80) == plain.substr(80));
      std::string head = space ? "binary STL by DelIso SPACE=LPS" : "binary STL by DelIso";
      if (head.size() + 1 + size <= 80) head += " " + options.comment;
      head.resize(80, ' ');
      CHECK(bytes.substr(0, 80) == head);
    }
  }
}

TEST_CASE("bytes that some format does not allow in comments are written as question marks") {
  const std::pair<std::string, std::string> comments[] = {
      {"two\nlines\r\tand\x01 more", "two?lines??and? more"},
      {std::string("a\0b", 3), "a?b"},
      {"gr\xc3\xbc\xc3\x9f", "gr????"},
      {"the end -->", "the end -?>"},
      {"-----", "-?-?-"},
      {"on the next line \\", "on the next line ?"},
      {"1e-05 r-min a - b", "1e-05 r-min a - b"}};
  for (const auto& [given, expected] : comments) {
    for (const MeshFormat format : kFormats) {
      const std::string& now = expected;
      CAPTURE(now);
      const TriMesh mesh = triangle();
      CHECK(written(mesh, {.format = format, .comment = given}) ==
            written(mesh, {.format = format, .comment = expected}));
    }
    CHECK(written(triangle(), {.format = MeshFormat::obj, .comment = given})
              .starts_with("# DelIso\n# " + expected + "\nv "));
  }
}

TEST_CASE("an empty mesh is a valid file of every format") {
  for (const MeshFormat format : kFormats) {
    const std::string bytes = written(TriMesh{}, {.format = format});
    CHECK(bytes.size() > 8);
  }
}

TEST_CASE("the locale changes nothing") {
  struct Commas : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const TriMesh mesh = random_sphere(3);
  for (const MeshFormat format : kFormats) {
    const std::string plain = written(mesh, {.format = format, .ascii = true});
    const std::locale before = std::locale::global(std::locale(std::locale(), new Commas));
    std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is installed
    const std::string german = written(mesh, {.format = format, .ascii = true});
    std::setlocale(LC_ALL, "C");
    std::locale::global(before);
    CHECK(plain == german);
  }
}

TEST_CASE("the world frame moves points, and a mirroring one reverses triangles") {
  const TriMesh mesh = random_sphere(5);
  const auto volume = [](const std::string& obj) {
    std::vector<Vec3> points;
    double six = 0;
    char* at = const_cast<char*>(obj.c_str());
    while ((at = std::strpbrk(at, "vf")) != nullptr) {
      const bool vertex = *at++ == 'v';
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis) p[axis] = std::strtod(at, &at);
      if (vertex)
        points.push_back(p);
      else
        six += dot(points[static_cast<std::size_t>(p.x) - 1],
                   cross(points[static_cast<std::size_t>(p.y) - 1],
                         points[static_cast<std::size_t>(p.z) - 1]));
    }
    return six;
  };
  // A reflection keeps the enclosed volume once the triangles are turned round; so does a rotation.
  Frame mirror{{3, 4, 5}, {Vec3{-1, 0, 0}, Vec3{0, 0.6, 0.8}, Vec3{0, -0.8, 0.6}}};
  Frame turn{{3, 4, 5}, {Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}}};
  CHECK(mirror.left_handed());
  CHECK_FALSE(turn.left_handed());
  std::string plain = written(mesh, {.format = MeshFormat::obj});
  plain = plain.substr(plain.find('\n'));
  for (const Frame& frame : {mirror, turn}) {
    TriMesh placed = mesh;
    placed.frame = frame;
    std::string moved = written(placed, {.format = MeshFormat::obj});
    moved = moved.substr(moved.find('\n'));
    CHECK(volume(moved) == doctest::Approx(volume(plain)).epsilon(1e-9));
    const Vec3 p = frame.to_world(mesh.points[0]);
    Vec3 q;
    CHECK(std::sscanf(moved.c_str(), "\nv %lf %lf %lf", &q.x, &q.y, &q.z) == 3);
    CHECK(p == q);
  }
  CHECK(turn.to_world({1, 2, 3}) == Vec3{6, 5, 7});
}

TEST_CASE("the points as written are those that are read back") {
  TriMesh mesh = random_sphere(6);
  mesh.frame = {{30, -4, 5.5}, {Vec3{0, 0.6, 0.8}, Vec3{1, 0, 0}, Vec3{0, -0.8, 0.6}}};
  for (const bool single : {false, true}) {
    const MeshWriteOptions options{.format = MeshFormat::ply, .single_precision = single};
    const TriMesh read = parse_mesh(written(mesh, options), MeshFormat::ply, "m");
    CHECK(read.points == written_points(mesh, options));
  }
  const MeshWriteOptions stl{.format = MeshFormat::stl};
  const TriMesh read = parse_mesh(written(mesh, stl), MeshFormat::stl, "m");
  for (const Vec3& p : written_points(mesh, stl)) {
    CHECK(std::find(read.points.begin(), read.points.end(), p) != read.points.end());
  }
}

TEST_CASE("the ending decides the format") {
  CHECK(mesh_format_of("a.ply") == MeshFormat::ply);
  CHECK(mesh_format_of("dir.off/a.OBJ") == MeshFormat::obj);
  CHECK(mesh_format_of("a.ply.Vtp") == MeshFormat::vtp);
  CHECK(mesh_format_of("a.stl") == MeshFormat::stl);
  CHECK(mesh_format_of("a.off") == MeshFormat::off);
  CHECK(mesh_format_of("a.GLB") == MeshFormat::glb);
  CHECK(mesh_format_of("a.3mf") == MeshFormat::three_mf);
  CHECK(mesh_format_of("a.smesh") == MeshFormat::smesh);
  CHECK(mesh_format_of("a.poly") == MeshFormat::poly);
  const TemporaryFolder folder;
  for (const std::string name : {"mesh.plyx", "mesh", "ply", ".ply", "mesh.gz", ""}) {
    CHECK(write_error(name) ==
          "'" + name +
              "' has no mesh format's ending (.ply, .off, .obj, .stl, .vtp, .glb, .3mf, "
              ".smesh, .poly)");
  }
}

TEST_CASE(
    "every fault of the file system, in every format: one line, nothing left, old file kept") {
  const TemporaryFolder folder;
  const std::string endings[] = {".ply", ".off", ".obj",   ".stl", ".vtp",
                                 ".glb", ".3mf", ".smesh", ".poly"};
  for (const std::string& ending : endings) {
    CHECK(write_error(folder / ("absent/mesh" + ending)) ==
          "cannot write '" + (folder / ("absent/mesh" + ending)) + "': No such file or directory");
    std::filesystem::create_directory(folder / ("folder" + ending));
    CHECK(write_error(folder / ("folder" + ending)) ==
          "cannot write '" + (folder / ("folder" + ending)) + "': Is a directory");
    std::filesystem::create_symlink("/dev/full", folder / ("full" + ending));
    CHECK(write_error(folder / ("full" + ending)) ==
          "cannot write '" + (folder / ("full" + ending)) + "': No space left on device");
  }
  CHECK(folder.file_count() == 2 * std::size(endings));
}
