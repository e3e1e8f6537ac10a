// SPDX-License-Identifier: MIT
// Written meshes are read back, and so are files of other programs. Any other bytes give a sound
// mesh, or one line with the fault and its place.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "base/check.h"
#include "base/text.h"
#include "cases.h"
#include "check/check_mesh.h"
#include "io/damage.h"
#include "io/files/temporary_folder.h"
#include "io/mesh/containers.h"
#include "io/mesh/mesh_files.h"
#include "io/mesh/read_mesh.h"
#include "mesh/meshes.h"
#include "refusal.h"

using namespace deliso;
using namespace deliso::test;

namespace {

TriMesh random_mesh(std::uint64_t seed) {
  RandomMesh source(seed % 2 ? octahedron() : l_shape(), seed);
  for (int i = 0; i < 15; ++i) source.change();
  TriMesh mesh = source.mesh();
  Random& random = source.random();
  for (Vec3& p : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) {
      // Any finite double now and then, a plain number else; never -0, which reads back as 0.
      const double any = std::bit_cast<double>(random.next());
      p[axis] = random.below(4) == 0 && std::abs(any) < 1e30 && std::abs(any) > 1e-30
                    ? any
                    : random.uniform(-10, 10);
    }
  }
  return mesh;
}

TriMesh rounded(TriMesh mesh) {
  for (Vec3& p : mesh.points) {
    for (int axis = 0; axis < 3; ++axis) {
      // Through memory: GCC 12's SLP vectorizer drops the conversion to float and back.
      volatile float single = static_cast<float>(p[axis]);
      p[axis] = static_cast<double>(single);
    }
  }
  return mesh;
}

struct Sample {
  MeshFormat format;
  std::string bytes;
  std::optional<ZipForm> archive{};  // of 3MF, with `bytes` for its model
};

TriMesh parsed(const Sample& sample) {
  return parse_mesh(sample.archive ? three_mf_file(sample.bytes, *sample.archive) : sample.bytes,
                    sample.format, "in");
}

std::string error_of(const Sample& sample) {
  return refusal_by([&] { parsed(sample); });
}

// Binary data in either byte order.
class Bytes {
 public:
  explicit Bytes(bool big) : big_(big) {}
  template <class T>
  Bytes& put(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (big_ != (std::endian::native == std::endian::big)) std::reverse(raw, raw + sizeof(T));
    bytes_.append(raw, sizeof(T));
    return *this;
  }
  const std::string& str() const { return bytes_; }

 private:
  bool big_;
  std::string bytes_;
};

// A square and a triangle with everything that may stand beside the geometry.
std::string rich_ply(bool ascii, bool big) {
  std::string head =
      text("ply\r\nformat ",
           ascii ? "ascii"
           : big ? "binary_big_endian"
                 : "binary_little_endian",
           " 1.0\r\ncomment made by hand\r\nobj_info as well\r\nelement camera 1\r\nproperty float "
           "fov\r\n"
           "element void 4000000000000\r\n"
           "element vertex 5\r\nproperty uchar red\r\nproperty float32 y\r\nproperty double x\r\n"
           "property list ushort float weights\r\nproperty int16 z\r\nelement face 2\r\n"
           "property float area\r\nproperty list int8 ushort vertex_index\r\n"
           "property list uint char flags\r\nelement edge 1\r\nproperty int vertex1\r\n"
           "property uint32 vertex2\r\nend_header\r\n");
  if (ascii) {
    return head +
           "0.5\r\n 255 0 0 0 -1\n0 0 +1 2 7.5 nan -1\n0 1 1 1 inf -1\n\n0 1 0 0 -1\n0 2 2 0 -1 "
           "1.5 4 "
           "0 1 2 3 2 -1 -2\n0.5 3\n2 4 3 0\n0 4294967295 ";
  }
  Bytes b(big);
  b.put(0.5f);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto vertex = [&](double x, float y, int weights) {
    b.put<std::uint8_t>(9).put(y).put(x).put(static_cast<std::uint16_t>(weights));
    for (int i = 0; i < weights; ++i) b.put(nan);
    b.put<std::int16_t>(-1);
  };
  vertex(0, 0, 0);
  vertex(1, 0, 2);
  vertex(1, 1, 1);
  vertex(0, 1, 300);
  vertex(2, 2, 0);
  b.put(1.5f).put<std::int8_t>(4);
  for (const int v : {0, 1, 2, 3}) b.put(static_cast<std::uint16_t>(v));
  b.put<std::uint32_t>(2).put<std::int8_t>(-1).put<std::int8_t>(-2);
  b.put(0.5f).put<std::int8_t>(3);
  for (const int v : {2, 4, 3}) b.put(static_cast<std::uint16_t>(v));
  b.put<std::uint32_t>(0).put<std::int32_t>(0).put<std::uint32_t>(4294967295u);
  return head + b.str();
}

std::string rich_off() {
  return "# made by hand\n\nCOFF # colors\n 5 2 7 # counts\n0 0 -1 255 0 0 255\n1 0 -1 0 0 0 0\n"
         "1 1 -1\n# between\n0 1 -1\n+2 2e0 -1.\n4 0 1 2 3 0.5 0.5 0.5\r\n3 2 4 3 255 # last\n\n";
}

std::string rich_obj() {
  return "# made by hand\nmtllib a.mtl\no thing\nv 0 0 -1 1.0\nv 1 0 -1\nvt 0 0\nvn 0 0 1\n"
         "g one two\nusemtl red\ns off\nf 1/1/1 2//1 3/1 -1\nv 1 1 -1\r\nv 0 \\\n1 -1\nl 1 2 3\n"
         "v 2 2 -1 # last\nf -3 5 \\\r\n 4/1/1 \n";
}

// Valid files of every kind, small so that mutations hit every part of them.
std::vector<Sample> samples() {
  std::vector<Sample> all;
  const TemporaryFolder folder;
  const TriMesh meshes[] = {mesh_of(tetrahedron()), random_mesh(2), TriMesh{}};
  for (const TriMesh& mesh : meshes) {
    for (const MeshFormat format : {MeshFormat::ply, MeshFormat::off, MeshFormat::obj}) {
      for (const bool ascii : {false, true}) {
        write_mesh(mesh, folder / "mesh", {.format = format, .ascii = ascii});
        all.push_back({format, file_bytes(folder / "mesh")});
      }
    }
  }
  all.push_back({MeshFormat::ply, rich_ply(true, false)});
  all.push_back({MeshFormat::ply, rich_ply(false, false)});
  all.push_back({MeshFormat::ply, rich_ply(false, true)});
  all.push_back({MeshFormat::off, rich_off()});
  all.push_back({MeshFormat::obj, rich_obj()});
  for (const TriMesh& mesh : meshes) {
    for (const MeshFormat format :
         {MeshFormat::stl, MeshFormat::vtp, MeshFormat::glb, MeshFormat::three_mf}) {
      write_mesh(mesh, folder / "mesh", {.format = format});
      all.push_back({format, file_bytes(folder / "mesh")});
    }
    all.push_back({MeshFormat::stl, stl_text(mesh)});
  }
  const auto [json, data] = rich_gltf();
  all.push_back({MeshFormat::glb, glb_file(json, data)});
  all.push_back({MeshFormat::three_mf, three_mf_file(rich_model())});
  all.push_back(
      {MeshFormat::three_mf, three_mf_file(rich_model(), {.deflated = true, .wide = true})});
  for (const ZipForm& form : {ZipForm{}, ZipForm{.deflated = true}, ZipForm{.wide = true}}) {
    all.push_back({MeshFormat::three_mf, rich_model(), form});
  }
  for (const VtkForm& form : all_vtk_forms()) {
    all.push_back({MeshFormat::vtp, vtp(kRichPoints, kRichPolygons, form, false)});
  }
  return all;
}

// A format that holds each vertex once.
struct Exact {
  const char* name;
  std::size_t comments;  // of the writer, before the user's
  bool tells_floats;     // else text has their shortest digits, which read as another double
};
constexpr Exact kExact[] = {{"a.ply", 1, true},
                            {"a.off", 0, false},
                            {"a.obj", 1, false},
                            {"a.vtp", 0, true},
                            {"a.3mf", 0, false}};

}  // namespace

TEST_CASE("written meshes come back, in every format and type, with their comment") {
  const TemporaryFolder folder;
  const std::string comment = "deliso 0.1.0 max-distance=0.1 r-min=0.5 lambda=2";
  for (std::uint64_t seed = 0; seed <= 60; ++seed) {
    CAPTURE(seed);
    TriMesh mesh = seed == 0 ? TriMesh{} : random_mesh(seed);
    mesh.frame.origin = seed % 3 == 0 ? Vec3{0.1, -4e4, 1e-7} : Vec3{};
    TriMesh placed = mesh;
    placed.points = mesh.world_points();
    placed.frame = {};
    for (const Exact& exact : kExact) {
      const std::string path = folder / exact.name;
      CAPTURE(path);
      for (const bool single : {false, true}) {
        for (const bool ascii : {false, true}) {
          MeshWriteOptions options{.single_precision = single, .ascii = ascii, .comment = comment};
          write_mesh(mesh, path, options);
          MeshNotes notes{{"of another file"}, 1};
          const TriMesh back = read_mesh(path, &notes);
          REQUIRE(same_mesh(single && !exact.tells_floats ? rounded(back) : back,
                            single ? rounded(placed) : placed));
          REQUIRE(!notes.comments.empty());
          CHECK(notes.comments.back() == comment);
          CHECK(notes.comments.size() == exact.comments + 1);
          CHECK(notes.rounding == 0);
          if (seed % 20 != 0) continue;
          options.comment.clear();
          write_mesh(mesh, path, options);
          CHECK(same_mesh(read_mesh(path, &notes), back));
          CHECK(notes.comments.size() == exact.comments);
        }
      }
    }
  }
}

// No reader set it, so render --axes never named the patient's directions.
TEST_CASE("the patient's space that a file names comes back, in every format") {
  const TemporaryFolder folder;
  const std::string comment = "deliso 0.1.0 max-distance=0.1 r-min=0.5 lambda=2";
  TriMesh mesh = random_mesh(2);
  for (const Exact& exact : kExact) {
    CAPTURE(exact.name);
    for (const AnatomicalSpace space :
         {AnatomicalSpace::unknown, AnatomicalSpace::ras, AnatomicalSpace::lps}) {
      mesh.frame.space = space;
      write_mesh(mesh, folder / exact.name, {.comment = comment});
      MeshNotes notes;
      CHECK(read_mesh(folder / exact.name, &notes).frame.space == space);
      CHECK(notes.comments.back() == comment);
    }
  }
  for (const char* name : {"a.stl", "a.glb"}) {
    mesh.frame.space = AnatomicalSpace::ras;
    write_mesh(mesh, folder / name);
    CHECK(read_mesh(folder / name).frame.space == AnatomicalSpace::ras);
  }
  const auto space = [](const std::string& bytes, MeshFormat format) {
    return parse_mesh(bytes, format, "a").frame.space;
  };
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  CHECK(space("# 3D Slicer output. SPACE=LPS\n" + obj, MeshFormat::obj) == AnatomicalSpace::lps);
  CHECK(space("# SPACE=scanner\n" + obj, MeshFormat::obj) == AnatomicalSpace::unknown);
  // As VTK 9.1 writes the field that Slicer gives it, in base64.
  const auto vtp = [](const std::string& codes) {
    return R"(<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32">
<PolyData><FieldData><Array type="String" Name="SPACE" NumberOfTuples="1" format="binary">)" +
           codes +
           "</Array></FieldData><Piece NumberOfPoints=\"0\" NumberOfPolys=\"0\"/></PolyData>"
           "</VTKFile>";
  };
  CHECK(space(vtp("BAAAAFJBUwA="), MeshFormat::vtp) == AnatomicalSpace::ras);
  CHECK(space(vtp("BQAAAG90aGVy"), MeshFormat::vtp) == AnatomicalSpace::unknown);
}

TEST_CASE("polygons are read with other elements, comments and line ends of other systems") {
  const TriMesh expected = make_tri_mesh(kRichPoints, kRichTriangles);
  CHECK(same_mesh(parse_mesh(rich_ply(true, false), MeshFormat::ply, "in"), expected));
  CHECK(same_mesh(parse_mesh(rich_ply(false, false), MeshFormat::ply, "in"), expected));
  CHECK(same_mesh(parse_mesh(rich_ply(false, true), MeshFormat::ply, "in"), expected));
  CHECK(same_mesh(parse_mesh(rich_off(), MeshFormat::off, "in"), expected));
  TriMesh obj = parse_mesh(rich_obj(), MeshFormat::obj, "in");
  // Its square was named before two of its corners were there: -1 was vertex 1 (from 0) then.
  CHECK(obj.points == kRichPoints);
  REQUIRE(obj.faces.size() == 3);
  CHECK(obj.faces[0].v == Triangle{0, 1, 2});
  CHECK(obj.faces[1].v == Triangle{0, 2, 1});
  CHECK(obj.faces[2].v == Triangle{2, 4, 3});
}

TEST_CASE("VTP in every encoding, type and byte order is read") {
  const TriMesh expected = make_tri_mesh(kRichPoints, kRichTriangles);
  for (const VtkForm& form : all_vtk_forms()) {
    for (const bool wide : {false, true}) {
      CAPTURE(form.format);
      CAPTURE(form.encoding);
      CAPTURE(form.block);
      const auto read = [&](const std::vector<Vec3>& points,
                            const std::vector<std::vector<VertexId>>& polygons) {
        MeshNotes notes;
        const std::string file = vtp(points, polygons, form, wide);
        const TriMesh mesh = parse_mesh(file, MeshFormat::vtp, "in", &notes);
        CHECK(notes.comments == std::vector<std::string>{"made by hand"});
        return mesh;
      };
      CHECK(same_mesh(read(kRichPoints, kRichPolygons), expected));
      CHECK(read(kRichPoints, {}).points == kRichPoints);
      CHECK(read({}, {}).points.empty());
    }
  }
}

TEST_CASE("text of single precision is read as floats") {
  const std::string file = vtp({{0.1, 0.2, 0.3}}, {}, {.format = "ascii"}, false);
  CHECK(file.find("0.1 0.2 0.3") != std::string::npos);
  const TriMesh mesh = parse_mesh(file, MeshFormat::vtp, "in");
  REQUIRE(mesh.points.size() == 1);
  CHECK(mesh.points[0].x == static_cast<double>(0.1f));
}

TEST_CASE("only comments of the head are read, with any bytes and length") {
  using Comments = std::vector<std::string>;
  const auto comments_of = [](const std::string& bytes, MeshFormat format) {
    MeshNotes notes;
    parse_mesh(bytes, format, "in", &notes);
    return notes.comments;
  };
  CHECK(comments_of(rich_ply(true, false), MeshFormat::ply) == Comments{"made by hand"});
  CHECK(comments_of(rich_ply(false, true), MeshFormat::ply) == Comments{"made by hand"});
  CHECK(comments_of(rich_off(), MeshFormat::off) == Comments{"made by hand", "colors", "counts"});
  CHECK(comments_of(rich_obj(), MeshFormat::obj) == Comments{"made by hand"});
  CHECK(comments_of("v 0 0 0\n# late\n", MeshFormat::obj).empty());

  std::string any;
  for (int c = 0; c < 256; ++c) {
    if (c != '\n') any += static_cast<char>(c);
  }
  const auto ply = [](const std::string& comment) {
    return "ply\nformat ascii 1.0\ncomment " + comment +
           "\nelement vertex 0\nproperty float x\nproperty float y\n"
           "property float z\nend_header\n";
  };
  for (const std::string& body :
       {"x" + any + "x", std::string(5000000, 'x'), std::string(70000, '#') + "end"}) {
    CHECK(comments_of(ply(body), MeshFormat::ply) == Comments{body});
    CHECK(comments_of("OFF\n# " + body + "\n0 0 0\n", MeshFormat::off) == Comments{body});
    CHECK(comments_of("# " + body + "\nv 0 0 0\n", MeshFormat::obj) == Comments{body});
  }
  // Blank ones are none, and of very many the first are enough.
  CHECK(comments_of(ply(""), MeshFormat::ply).empty());
  CHECK(comments_of("#\n# \t\r\nv 0 0 0\n", MeshFormat::obj).empty());
  std::string many;
  for (int n = 0; n < 100000; ++n) many += text("# ", n, "\n");
  for (const Comments& first : {comments_of(many + "v 0 0 0\n", MeshFormat::obj),
                                comments_of(many + "OFF\n0 0 0\n", MeshFormat::off)}) {
    REQUIRE(first.size() == 100);
    CHECK(first[0] == "0");
    CHECK(first[99] == "99");
  }
}

// A mesh with a vertex at 1e306 was checked for ever: no exact predicate ends there.
TEST_CASE("coordinates out of the predicates' range are refused, with vertex and value") {
  const auto line = [](const std::string& what) {
    return "'in': coordinate " + what + ", not a number up to 1e+30 in size";
  };
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\n"
      "property double y\nproperty double z\nend_header\n0 0 0\n";
  for (const std::string x : {"1e306", "-1.5e+30", "inf", "-inf", "nan"}) {
    const std::string value = x == "1e306" ? "1e+306" : x;
    CHECK(error_of({MeshFormat::ply, ply + "0 " + x + " 0\n"}) ==
          line("y of vertex 1 is " + value));
    CHECK(error_of({MeshFormat::off, "OFF\n2 0 0\n0 0 0\n0 0 " + x}) ==
          line("z of vertex 1 is " + value));
    CHECK(error_of({MeshFormat::obj, "v 0 0 0\nv " + x + " 0 0\n"}) ==
          line("x of vertex 2 is " + value));
    const std::string vtp_file =
        "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"2\"><Points>"
        "<DataArray type=\"Float64\" NumberOfComponents=\"3\">0 0 0 0 " +
        x + " 0</DataArray></PolyData>";
    CHECK(error_of({MeshFormat::vtp, vtp_file}) == line("y of vertex 1 is " + value));
  }
}

TEST_CASE("missing and unreadable files are refused") {
  const auto error = [](const std::string& path) { return refusal_by([&] { read_mesh(path); }); };
  const TemporaryFolder folder;
  CHECK(error(folder / "absent.ply") ==
        folder / "absent.ply" + ": cannot open: No such file or directory");
  std::filesystem::create_directory(folder / "folder.ply");
  CHECK(error(folder / "folder.ply") == folder / "folder.ply" + ": is a directory, not a file");
  write_bytes(folder / "a.stl", "solid");
  CHECK(error(folder / "a.stl") ==
        text("'", folder / "a.stl", "' line 1: the file ends before 'endsolid'"));
  CHECK(error("a.xyz") ==
        "'a.xyz' has no readable mesh format's ending (.ply, .off, .obj, .stl, .vtp, .glb, .3mf)");
  CHECK(error("a.poly") ==
        "'a.poly' has no readable mesh format's ending (.ply, .off, .obj, .stl, .vtp, .glb, .3mf)");
}

TEST_CASE("every truncation of a binary PLY is noticed, of the others most") {
  for (const Sample& sample : samples()) {
    std::size_t unnoticed = 0;
    for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
      try {
        const TriMesh mesh = parsed({sample.format, sample.bytes.substr(0, size), sample.archive});
        REQUIRE(flaw_of(mesh) == nullptr);
        ++unnoticed;
      } catch (const InputError&) {
      }
    }
    // Text may end within its last number or before its last blank, and so may the header of an
    // empty mesh; OBJ has no count at all.
    const bool binary = sample.bytes.find("format binary") != std::string::npos;
    const bool empty = sample.bytes.find("element vertex 0") != std::string::npos;
    if (binary)
      CHECK(unnoticed <= std::size_t{empty});
    else if (sample.format == MeshFormat::vtp)  // which ends with markup that nobody needs
      CHECK(unnoticed <= 120);
    else if (sample.format != MeshFormat::obj)
      CHECK(unnoticed <= 24);
  }
}

TEST_CASE("no mutation of a file does harm") {
  std::size_t meshes = 0, errors = 0;
  const std::vector<Sample> all = samples();
  REQUIRE(all.size() == 81);
  for (std::uint64_t seed = 1; seed <= test::cases(400000u); ++seed) {
    Random random(seed);
    Sample sample = all[seed % all.size()];
    sample.bytes = damaged(sample.bytes, random);
    const char* flaw = nullptr;
    try {
      flaw = flaw_of(parsed(sample));
      ++meshes;
    } catch (const InputError& error) {
      const std::string_view line = error.what();
      flaw = line.starts_with("'in'") && line.size() < 300 ? flaw_of(error) : "another line";
      ++errors;
    }
    REQUIRE_MESSAGE(flaw == nullptr, "seed ", seed, ": ", flaw);
  }
  CHECK(meshes > test::cases(1000u));
  CHECK(errors > test::cases(1000u));
}

TEST_CASE("random bytes, also after headers with large counts, give a mesh or an InputError") {
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    Random random(seed);
    std::string noise(random.below(400), ' ');
    for (char& c : noise) c = static_cast<char>(random.next());
    const std::string heads[] = {"", "ply\n", "OFF\n", "v ",
                                 "ply\nformat binary_little_endian 1.0\nelement vertex 4294967290\n"
                                 "property double x\nproperty double y\nproperty double z\n"
                                 "element face 18446744073709551615\n"
                                 "property list uint uint vertex_indices\nend_header\n"};
    for (const std::string& head : heads) {
      for (const MeshFormat format :
           {MeshFormat::ply, MeshFormat::off, MeshFormat::obj, MeshFormat::stl, MeshFormat::vtp,
            MeshFormat::glb, MeshFormat::three_mf}) {
        try {
          const TriMesh mesh = parsed({format, head + noise});
          REQUIRE(flaw_of(mesh) == nullptr);
        } catch (const InputError&) {
        }
      }
    }
  }
}
