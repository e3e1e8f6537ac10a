// SPDX-License-Identifier: MIT
// The first inputs of the fuzz targets: every form in which the tests store a volume, a small mesh
// and a small solid in every format, and seeded bytes for the pipeline. Usage: make_corpus FOLDER
#include <filesystem>
#include <fstream>
#include <map>

#include "base/random.h"
#include "base/text.h"
#include "fuzz/reader_target.h"
#include "io/files/jpeg_writer.h"
#include "io/mesh/containers.h"
#include "io/mesh/mesh_files.h"
#include "io/mesh/write_mesh.h"
#include "io/solid/solids.h"
#include "io/volume/volume_files.h"

using namespace deliso;
using namespace deliso::test;

namespace {

class Corpus {
 public:
  explicit Corpus(std::string folder) : folder_(std::move(folder)) {}

  void add(const std::string& target, const std::string& content) {
    std::filesystem::create_directories(folder_ + "/" + target);
    const std::string name = folder_ + "/" + target + "/seed-" + std::to_string(counts_[target]++);
    std::ofstream(name, std::ios::binary) << content;
  }

 private:
  std::string folder_;
  std::map<std::string, int> counts_;
};

std::string with_detached(const std::vector<NamedFile>& files) {
  if (files.size() == 1) return files[0].content;
  return files[0].content + std::string(fuzz::kDetached) + files[1].content;
}

void add_volumes(Corpus& corpus) {
  for (const SampleType type : {SampleType::u8, SampleType::i16, SampleType::f32}) {
    Truth truth = random_truth(type, {3, 4, 5}, 17);
    truth.spacing = {0.5, 1.25, 3};
    for (const StoredVolume& stored : all_forms(truth)) {
      const std::string target = stored.label.substr(0, stored.label.find(' '));
      if (target == "raw") {
        const bool big = stored.options.raw->byte_order == std::endian::big;
        corpus.add("raw", "3x4x5 " + std::string(name_of(type)) + " 0.5 1.25 3 " +
                              (big ? "big" : "little") + " 4 0:3,1:3,2:5\n" +
                              stored.files[0].content);
        continue;
      }
      corpus.add(target, with_detached(stored.files));
      if (stored.files.size() == 1 && type == SampleType::u8) {
        corpus.add("stdin", stored.files[0].content);
      }
    }
  }
  for (const bool binary : {false, true}) corpus.add("vtk", vtk_of_many(binary));
  // Series: even, uneven, of two times, tilted, and without places.
  const Truth slices = random_truth(SampleType::i16, {4, 3, 6}, 17);
  for (const DicomForm& form : {DicomForm{}, DicomForm{.coding = DicomForm::Coding::rle}}) {
    for (int kind = 0; kind < 5; ++kind) {
      std::string series;
      for (int k = 0; k < 6; ++k) {
        DicomElements slice = dicom_image(slices, form, k, 1);
        const double places[] = {1.0 * k, k > 2 ? k - 0.4 : k, 1.0 * (k % 3), 1.0 * k, 1.0 * k};
        slice[0x00200032] = dicom_vector({kind == 3 ? 0.7 * k : 0, 0, places[kind]});
        slice[0x00080018] = {"UI", text("1.2.", k)};
        slice[0x00200013] = {"IS", text(k)};
        slice[0x00200100] = {"IS", text(k / 3)};
        slice[0x00200037] = {"DS", "1\\0\\0\\0\\1\\0"};
        if (kind == 4) {
          slice.erase(0x00200032);
          slice.erase(0x00200037);
          slice[0x00180050] = {"DS", "3"};
          slice[0x7fe00010].value += form.is_packed() ? "" : "padding ";
        }
        series += (k > 0 ? std::string(fuzz::kDetached) : "") + dicom_file(form, slice);
      }
      corpus.add("dicom", series);
    }
  }
  for (int n = 0; n < 16; ++n) {
    JpegImage image{16, 4, 2 + n};
    if (n == 15) image = {64, 1, 8};
    for (int at = 0; at < 64; ++at) image.samples.push_back(at * n % 23 % (1 << image.bits) % 9);
    for (const bool is_ls : {false, true}) {
      JpegForm form{.is_ls = is_ls, .predictor = 1 + n % 7, .near = image.bits > 3 ? n % 3 : 0};
      form.restart_rows = n % 4;
      if (n % 5 == 0) form.preset[4] = 3;
      const std::string size{static_cast<char>(image.columns - 1),
                             static_cast<char>(image.rows - 1)};
      corpus.add("jpeg", size + jpeg_stream(image, form));
    }
  }
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    Random random(seed);
    std::string data;
    for (std::uint32_t n = 40 * random.below(20); n > 0; --n) {
      data += static_cast<char>(random.below(1 + static_cast<std::uint32_t>(seed) * 10));
    }
    const char wrapping = static_cast<char>(seed % 2), room = static_cast<char>(random.below(16));
    corpus.add("inflate", std::string{wrapping, room} +
                              (seed % 2 == 0 ? gzipped(data, seed) : zlibbed(data, seed)));
  }
}

void add_meshes(Corpus& corpus, const TemporaryFolder& folder) {
  const std::vector<Triangle> triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const TriMesh mesh = make_tri_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0.5, 1.25}}, triangles);
  const auto add = [&](const char* target, const MeshWriteOptions& options) {
    const std::string path = folder.path(std::string("mesh.") + target);
    write_mesh(mesh, path, options);
    std::ifstream in(path, std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(in), {}};
    corpus.add(target, content);
    corpus.add("stdin", content);
  };
  for (const char* target : {"off", "obj", "stl", "vtp", "glb", "3mf"}) add(target, {});
  for (const bool ascii : {false, true}) {
    for (const bool single : {false, true}) {
      MeshWriteOptions options;
      options.ascii = ascii;
      options.single_precision = single;
      add("ply", options);
    }
  }
  corpus.add("stl", stl_text(mesh));
  const auto [json, data] = rich_gltf();
  corpus.add("glb", glb_file(json, data));
  for (const bool deflated : {false, true}) {
    corpus.add("3mf", three_mf_file(rich_model(), {.deflated = deflated, .wide = deflated}));
  }
  corpus.add("3mf", rich_model());
  for (const VtkForm& form : all_vtk_forms()) {
    for (const bool wide : {false, true}) {
      corpus.add("vtp", vtp(mesh.points, {{0, 2, 1}, {0, 1, 3, 2}}, form, wide));
    }
  }
  corpus.add("ply",
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
             "property float z\nproperty uchar red\nelement face 1\nproperty list uchar int "
             "vertex_index\nelement extra 1\nproperty list int short values\nend_header\n"
             "0 0 0 1\n1 0 0 2\n0 1 0 3\n3 0 1 2\n2 5 6\n");
  corpus.add("off", "# comment\nCNOFF 3 1 0\n0 0 0 0 0 1 9 9 9 1\n1 0 0\n0 1 0\n3 0 1 2 255\n");
  corpus.add("obj", "mtllib a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2/1/1 \\\n -1\ns off\n");
}

void add_pipeline(Corpus& corpus) {
  for (std::uint64_t seed = 1; seed <= 64; ++seed) {
    Random random(seed);
    std::string bytes;
    for (std::uint32_t n = 32 + random.below(400); n > 0; --n) {
      bytes += static_cast<char>(random.below(256));
    }
    corpus.add("pipeline", bytes);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: make_corpus FOLDER\n", stderr);
    return 2;
  }
  Corpus corpus(argv[1]);
  const TemporaryFolder folder;
  add_volumes(corpus);
  add_meshes(corpus, folder);
  corpus.add("medit", written(cube(2), {}, {.format = SolidFormat::medit}));
  corpus.add("vtu", written(cube(2), {}, {.format = SolidFormat::vtu}));
  add_pipeline(corpus);
  return 0;
}
