// SPDX-License-Identifier: MIT
// The field of --median, --smooth and --label, and the meshes of labels.
#include "app/field.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "app/criteria_note.h"
#include "app/input.h"
#include "app/mesh_run.h"
#include "app/parsed_line.h"
#include "app/progress.h"
#include "app/run.h"
#include "base/check.h"
#include "base/random.h"
#include "base/text.h"
#include "base/triangle.h"
#include "check/check_mesh.h"
#include "check/quality.h"
#include "deliso/mesh_isosurface.h"
#include "io/files/temporary_folder.h"
#include "io/filter/gaussian.h"
#include "io/filter/median.h"
#include "io/mesh/read_mesh.h"
#include "mesh/meshes.h"
#include "volume/sampled.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// Balls of labels 1, 2 and 4 that touch each other; 4 is cut by the box.
struct Balls {
  static constexpr Index3 kDims{58, 36, 30};
  Balls() {
    std::vector<std::uint8_t> samples;
    for_each_index(kDims, [&](int i, int j, int k) {
      const auto in = [&](double x, double r) {
        return (i - x) * (i - x) + (j - 17.) * (j - 17.) + (k - 14.) * (k - 14.) <= r * r;
      };
      samples.push_back(in(13, 10) ? 1 : in(34, 11.2) ? 2 : in(56, 11) ? 4 : 0);
    });
    volume = Volume::from_samples(kDims, {1, 1, 1}, samples);
    folder.write("balls.raw", {samples.begin(), samples.end()});
  }
  // The command line of these labels.
  CommandLine line(const std::string& more) const {
    return parsed(folder / "balls.raw" + " --dims 58x36x30 --type uint8 -q " + more);
  }

  Volume volume = Volume::from_samples({2, 2, 2}, {1, 1, 1}, std::vector<float>(8, 0));
  TemporaryFolder folder;
};

// The distance of p from the closed mesh; negative outside.
double depth_in(const TriMesh& mesh, const Vec3& p) {
  double nearest2 = 1e300;
  for (const Face& face : mesh.faces) {
    const auto& [a, b, c] = face.v;
    nearest2 = std::min(nearest2,
                        distance2_to_triangle(p, mesh.points[a], mesh.points[b], mesh.points[c]));
  }
  const bool is_inside = winding_number(mesh.points, triangles_of(mesh), p) > 0.5;
  return (is_inside ? 1 : -1) * std::sqrt(nearest2);
}

}  // namespace

TEST_CASE("a label of a gray image of many values is refused before work without end") {
  const TemporaryFolder folder;
  Random random(1);
  std::string bytes;
  for (int n = 0; n < 20 * 20 * 20; ++n) {
    const std::uint32_t sample = random.below(4000);
    bytes += {static_cast<char>(sample & 255), static_cast<char>(sample >> 8)};
  }
  const std::string path = folder.write("gray.raw", bytes);
  CHECK_THROWS_WITH_AS(read_input(parsed(path + " --dims 20x20x20 --type int16 --label 7 -q")),
                       doctest::Contains("looks like a gray image, not like labels, and has"),
                       InputError);
}

TEST_CASE("a world length is another number of samples on each axis, and vox the side of a cube") {
  std::vector<float> samples;
  for (int n = 0; n < 12 * 12 * 12; ++n) samples.push_back(static_cast<float>(n * n % 97));
  const Volume volume = Volume::from_samples({12, 12, 12}, {0.5, 1, 4}, samples);
  FieldOptions options;
  options.smooth = {1, Length::Unit::world};
  const Field world = make_field(volume, options, {}, "v", 2);
  CHECK(world.sigma == Vec3{2, 1, 0.25});
  CHECK(world.sigma_voxels == doctest::Approx(1 / std::cbrt(2)));
  CHECK(same_samples(all_of(world.source), gaussian(volume, {2, 1, 0.25})));
  options.smooth = {1 / volume.voxel(), Length::Unit::voxel};
  const Field voxels = make_field(volume, options, {}, "v", 1);
  CHECK(same_samples(all_of(world.source), all_of(voxels.source)));
  CHECK(world.is_filtered());
  CHECK_FALSE(make_field(volume, {}, {}, "v", 1).is_filtered());
}

TEST_CASE("the median comes before the Gaussian") {
  const Balls balls;
  FieldOptions options;
  options.median = 1;
  options.smooth = {0.8, Length::Unit::voxel};
  const Field field = make_field(balls.volume, options, {}, "v", 2);
  const Vec3 sigma{0.8, 0.8, 0.8};
  CHECK(same_samples(all_of(field.source), gaussian(median(balls.volume, 1), sigma)));
  CHECK_FALSE(same_samples(all_of(field.source), median(gaussian(balls.volume, sigma), 1)));
  CHECK(filter_text(field) ==
        "median of 3 x 3 x 3 samples, then Gaussian of sigma 0.8 voxels (0.8 0.8 0.8 samples)");
}

TEST_CASE("the comment of a mesh names its field, and criteria are read past it") {
  const Balls balls;
  const CommandLine line = balls.line("--label 4,1 --smooth 1.5 --median 1");
  const std::string note = criteria_note(line, balls.volume);
  CHECK(note.ends_with(" median=1 smooth=1.5 label=1,4"));
  const std::vector<std::string> comments{"DelIso", note};
  CHECK(noted_criteria(comments).has_value());
  CHECK(noted_field(comments) == field_note(line.field, balls.volume));
  const std::string plain = criteria_note(balls.line("--iso 1"), balls.volume);
  CHECK(noted_field(std::vector{plain}) == "");
  CHECK_FALSE(noted_field(std::vector<std::string>{"by another program"}).has_value());
}

TEST_CASE("a label's mesh has the volume of its voxels within one percent") {
  const Balls balls;
  for (const std::string label : {"1", "2", "4"}) {
    CAPTURE(label);
    const CommandLine line =
        balls.line("--max-distance 0.05vox --label " + label + (label == "4" ? " --cap" : ""));
    const Input input = read_input(line);
    REQUIRE(input.isovalue.has_value());
    CHECK(*input.isovalue == 0);
    CHECK(input.field.label->weight > 1.04);  // equal ones would shrink it
    CHECK(std::fabs(input.field.label->off) < 0.005);
    Report report;
    const TriMesh mesh = mesh_isosurface(input.volume(), *input.isovalue, line.options, report);
    CHECK(check_mesh(mesh).empty());
    CHECK(enclosed_volume(mesh) == doctest::Approx(input.field.label->volume).epsilon(0.01));
  }
}

TEST_CASE("no point is inside the meshes of two labels by more than D") {
  const Balls balls;
  std::vector<TriMesh> meshes;
  double most = 0;
  for (const std::string label : {"1", "2", "4"}) {
    const CommandLine line = balls.line("--cap --label " + label);
    const Input input = read_input(line);
    Report report;
    TriMesh mesh = mesh_isosurface(input.volume(), 0, line.options, report);
    mesh.points = mesh.world_points();
    meshes.push_back(mesh);
    most = std::max(most, report.max_distance);
  }
  // Balls 1 and 2 touch near x = 23, balls 2 and 4 near x = 45.
  Random random(4);
  int inside = 0;
  for (int n = 0; n < 3000; ++n) {
    const double x = n % 2 == 0 ? 23 : 45;
    const Vec3 p{random.uniform(x - 1, x + 1), random.uniform(13, 21), random.uniform(10, 18)};
    int deep = 0;
    for (const TriMesh& mesh : meshes) {
      const double depth = depth_in(mesh, p);
      inside += depth > 0;
      deep += depth > most;
    }
    CHECK(deep <= 1);
  }
  CHECK(inside > 1000);
}

TEST_CASE("a mesh for each label, where the label lies, and each passes the check") {
  const Balls balls;
  const CommandLine line = balls.line("--label all -o " + balls.folder.path("part-%d.ply") +
                                      " --json " + balls.folder.path("%d.json"));
  CHECK(run_mesh(line) == kExitSuccess);
  CHECK_FALSE(std::filesystem::exists(balls.folder.path("part-0.ply")));
  for (const std::string label : {"1", "2"}) {
    CAPTURE(label);
    const double middle = label == "1" ? 13 : 34;
    const std::string file = balls.folder.path("part-" + label + ".ply");
    const TriMesh mesh = read_mesh(file);
    // The middle of the surface, however its vertices lie.
    Vec3 sum{};
    double area = 0;
    for (const Face& face : mesh.faces) {
      const auto& [a, b, c] = face.v;
      const double part = length(area_normal(mesh.points[a], mesh.points[b], mesh.points[c]));
      sum = sum + part / 3 * (mesh.points[a] + mesh.points[b] + mesh.points[c]);
      area += part;
    }
    CHECK(std::fabs(sum.x / area - middle) < 0.5);
    CHECK(std::fabs(sum.y / area - 17) < 0.2);
    CHECK(std::filesystem::exists(balls.folder.path(label + ".json")));
    CommandLine check = balls.line("--label " + label);
    check.meshes = {file};
    CHECK(run_check(check) == kExitSuccess);
    check.field.labels = {4};
    CHECK(run_check(check) == kFaultFound);
    // One label alone gives the same file.
    const std::string alone = balls.folder.path("alone.ply");
    CHECK(run_mesh(balls.line("--label " + label + " -o " + alone)) == kExitSuccess);
    CHECK(file_bytes(file) == file_bytes(alone));
  }
  CHECK(std::filesystem::exists(balls.folder.path("part-4.ply")));
}

TEST_CASE("an input is not overwritten by the mesh of a label") {
  const Balls balls;
  std::filesystem::copy(balls.folder.path("balls.raw"), balls.folder.path("2.ply"));
  CommandLine line = balls.line("--label all -o " + balls.folder.path("%d.ply"));
  line.input = balls.folder.path("2.ply");
  CHECK_THROWS_AS(run_mesh(line), InputError);
  CHECK_FALSE(std::filesystem::exists(balls.folder.path("1.ply")));
}

TEST_CASE("segments of --label are the labels and the channel of the file") {
  const TemporaryFolder folder;
  const std::string path = folder.write(
      "v.seg.nrrd",
      "NRRD0004\ntype: uchar\nencoding: raw\ndimension: 4\nsizes: 2 2 2 2\n"
      "kinds: list domain domain domain\nSegment0_Name:=Liver\nSegment0_LabelValue:=7\n"
      "Segment0_Layer:=0\nSegment1_Name:=Spleen\nSegment1_LabelValue:=3\nSegment1_Layer:=0\n"
      "Segment2_Name:=Tumor\nSegment2_LabelValue:=7\nSegment2_Layer:=1\n\n0123456789abcdef");
  const auto found = [&](const std::string& label, const std::string& more = "") {
    CommandLine line = parsed("mesh " + path + " --label=" + label + more);
    find_segments(line);
    return line;
  };
  const CommandLine two = found("Spleen,Liver,5");
  CHECK(two.field.labels == std::vector<std::int64_t>{3, 5, 7});
  CHECK(two.field.segments.empty());
  CHECK(two.read.channel == 1);
  CHECK(found("Tumor").read.channel == 2);
  CHECK(found("Tumor").field.labels == std::vector<std::int64_t>{7});
  CHECK_FALSE(found("7").read.channel.has_value());
  CHECK_THROWS_WITH_AS(found("liver"),
                       (path + ": has no segment 'liver', but 'Liver', 'Spleen', 'Tumor'").c_str(),
                       InputError);
  CHECK_THROWS_WITH_AS(found("Liver,Tumor"),
                       (path + ": segment 'Tumor' is in channel 2, not in 1").c_str(), InputError);
  CHECK_THROWS_WITH_AS(found("Liver", " --channel=2"),
                       (path + ": segment 'Liver' is in channel 1, not in 2").c_str(), InputError);
}

// Statistical maps have NaN outside of the brain.
TEST_CASE("with --nan a volume has the mesh of the volume with these values, also in parts") {
  const TemporaryFolder folder;
  std::vector<float> filled;
  for (int n = 0; n < 24 * 24 * 24; ++n) {
    const Vec3 p{n % 24 - 11.3, n / 24 % 24 - 11.6, n / 576 - 11.8};
    filled.push_back(n % 24 < 2 ? -3 : static_cast<float>(8 - length(p)));
  }
  std::vector<float> with_nan = filled;
  std::ranges::replace(with_nan, -3.f, std::nanf(""));
  const auto write = [&](const char* name, const std::vector<float>& samples) {
    return folder.write(name, {reinterpret_cast<const char*>(samples.data()), 4 * samples.size()});
  };
  const std::string whole = write("whole.raw", filled), gaps = write("gaps.raw", with_nan);
  const auto line_of_mesh = [](const std::string& words) {
    return parsed(words +
                  " --dims=24x24x24 --type=float32 --iso=1 --block-side=8 --smooth=0.5vox -q");
  };
  const std::string ply = folder.path("a.ply"), out = " -o " + ply;
  REQUIRE(run_mesh(line_of_mesh(whole + out)) == kExitSuccess);
  const std::string wanted = file_bytes(ply);
  CHECK_THROWS_AS(run_mesh(line_of_mesh(gaps + out)), InputError);
  REQUIRE(run_mesh(line_of_mesh(gaps + out + " --nan=-3")) == kExitSuccess);
  CHECK(file_bytes(ply) == wanted);
  const std::string one = folder.path("1"), two = folder.path("2");
  CHECK(run_part(line_of_mesh(gaps + " --nan=-3 --part=1/2 -o " + one)) == kExitSuccess);
  CHECK(run_part(line_of_mesh(gaps + " --nan=-3 --part=2/2 -o " + two)) == kExitSuccess);
  const CommandLine join =
      parsed("join " + one + " " + two + " --volume=" + gaps + out + " --quiet");
  CHECK(run_join(join) == kExitSuccess);
  CHECK(file_bytes(ply) == wanted);
  CHECK(read_input(line_of_mesh(gaps + " --nan=-3")).log.notes.back().words ==
        "1,152 samples are NaN, and taken as -3");
}

TEST_CASE("inside below is inside above of the mirrored samples") {
  const TemporaryFolder folder;
  struct Type {
    const char* name;
    double mirror, least;  // of samples: mirror - v
  };
  std::size_t facets = 0;
  for (int run = 0; run < 60; ++run) {
    CAPTURE(run);
    Random random(static_cast<std::uint64_t>(run));
    const Type type =
        std::array<Type, 3>{{{"uint8", 255, 100}, {"int16", -1, -3}, {"float32", 0, -3}}}[run % 3];
    const Index3 dims{3 + run % 5, 3 + run % 3, 4};
    std::vector<double> values;  // few, so that many samples equal the isovalue
    for_each_index(dims, [&](int, int, int) { values.push_back(type.least + random.below(7)); });
    const double isovalue = type.least + 1 + 0.5 * random.below(8);
    const bool is_float = run % 3 == 2;
    const std::string options = std::array{"", " --cap", " --median 1", " --largest 1",
                                           " --smooth 0.6vox --cap"}[random.below(4 + is_float)];
    const auto mesh_of = [&](bool is_mirrored) {
      std::string bytes;
      for (const double value : values) {
        const double v = is_mirrored ? type.mirror - value : value;
        const auto put = [&](auto sample) {
          bytes.append(reinterpret_cast<const char*>(&sample), sizeof sample);
        };
        if (is_float) {
          put(static_cast<float>(v));
        } else if (run % 3 == 1) {
          put(static_cast<std::int16_t>(v));
        } else {
          put(static_cast<std::uint8_t>(v));
        }
      }
      const std::string name = folder.write("volume.raw", bytes);
      const CommandLine line = parsed(text(
          name, " --dims ", dims.i, "x", dims.j, "x", dims.k, " --type ", type.name, " -q",
          " --allow-empty", options, " --iso ", is_mirrored ? type.mirror - isovalue : isovalue,
          is_mirrored ? "" : " --inside below"));
      const Input input = read_input(line);
      MeshRun made(line, input);
      ProgressBar none(mesh_stages(line), false);
      return mesh_input(made, none);
    };
    const TriMesh below = mesh_of(false), above = mesh_of(true);
    facets += below.faces.size();
    CHECK(below.points == above.points);
    CHECK(below.triangles() == above.triangles());
  }
  CHECK(facets > 1000);
}

TEST_CASE("several isovalues: each mesh is that of its own run, or none is written") {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& isovalues, const std::string& file) {
    run_mesh(parsed("builtin:machine:16 -q --cap --iso " + isovalues + " -o " + (folder / file)));
  };
  run("60,127.5", "of-%d.ply");
  run("60,127.5", "all.glb");
  std::size_t facets = 0;
  for (const std::string isovalue : {"60", "127.5"}) {
    run(isovalue, "alone.ply");
    CHECK(file_bytes(folder / "alone.ply") == file_bytes(folder / ("of-" + isovalue + ".ply")));
    facets += read_mesh(folder / "alone.ply").faces.size();
  }
  MeshNotes notes;
  CHECK(read_mesh(folder / "all.glb", &notes).faces.size() == facets);
  CHECK(std::set(notes.colors.begin(), notes.colors.end()).size() == 2);
  CHECK_THROWS_AS(run("60,300", "late-%d.ply"), InputError);
  CHECK_FALSE(std::filesystem::exists(folder / "late-60.ply"));
  CHECK_THROWS_AS(run("60,80", "one.ply"), InputError);
  CHECK_THROWS_AS(parsed("info builtin:machine --iso 60,80"), InputError);
}
