// SPDX-License-Identifier: MIT
// --label all --shared: the files of random labels, read as another program would.
#include "app/shared_labels.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "app/input.h"
#include "app/mesh_run.h"
#include "app/parsed_line.h"
#include "app/run.h"
#include "base/check.h"
#include "base/random.h"
#include "base/text.h"
#include "cases.h"
#include "io/files/temporary_folder.h"
#include "io/mesh/read_mesh.h"
#include "mesh/meshes.h"
#include "refusal.h"
#include "stress/shared_file.h"
#include "view/render/color_map.h"
#include "volume/sampled.h"

using namespace deliso;
using namespace deliso::stress;
using namespace deliso::test;

namespace {

// Labels from 0 to `most`, in spacing 1: cells of a Voronoi diagram, the same in a ball, runs of
// samples in rows, or single voxels in background.
struct RandomLabels {
  explicit RandomLabels(std::uint64_t seed) {
    Random random(seed);
    for (int axis = 0; axis < 3; ++axis) dims[axis] = 3 + static_cast<int>(random.below(5));
    most = 2 + static_cast<int>(random.below(5));
    std::vector<Vec3> centers;
    for (int n = 0; n < 9; ++n) {
      centers.push_back(
          {dims.i * random.uniform(), dims.j * random.uniform(), dims.k * random.uniform()});
    }
    const auto kind = random.below(4);
    int run = 0;
    for_each_index(dims, [&](int i, int j, int k) {
      const Vec3 p{double(i), double(j), double(k)};
      const auto nearest =
          std::ranges::min_element(centers, {}, [&](const Vec3& c) { return distance2(c, p); });
      const int cell = static_cast<int>(nearest - centers.begin()) % (most + 1);
      const int drawn = static_cast<int>(random.below(static_cast<std::uint32_t>(most + 1)));
      if (random.below(3) == 0) run = drawn;
      const bool outside = distance(p, {dims.i / 2., dims.j / 2., dims.k / 2.}) > dims.i / 2.;
      samples.push_back(static_cast<std::uint8_t>(kind == 0   ? cell
                                                  : kind == 1 ? (outside ? 0 : 1 + cell % most)
                                                  : kind == 2 ? run
                                                  : random.below(12) == 0 ? drawn
                                                                          : 0));
    });
    samples[samples.size() / 2] = 1;  // not all is background
  }
  int at(int i, int j, int k) const {
    const bool in = i >= 0 && j >= 0 && k >= 0 && i < dims.i && j < dims.j && k < dims.k;
    return in ? samples[static_cast<std::size_t>((k * dims.j + j) * dims.i + i)] : 0;
  }

  // True if a sample within two voxels of p has the label.
  bool is_near(const Vec3& p, int label) const {
    const auto x = std::lround(p.x), y = std::lround(p.y), z = std::lround(p.z);
    for (int n = 0; n < 125; ++n) {
      if (at(static_cast<int>(x) + n % 5 - 2, static_cast<int>(y) + n / 5 % 5 - 2,
             static_cast<int>(z) + n / 25 - 2) == label) {
        return true;
      }
    }
    return false;
  }

  Box3 box() const { return {{0, 0, 0}, {dims.i - 1., dims.j - 1., dims.k - 1.}}; }

  Index3 dims;
  int most = 0;
  std::vector<std::uint8_t> samples;
};

using Corners3 = std::array<std::array<double, 3>, 3>;
// The triangle's corners, from the least one.
Corners3 corners_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  Corners3 all{{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}}};
  std::rotate(all.begin(), std::min_element(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

TEST_CASE("random labels fill space once, between common triangles that never cross") {
  const TemporaryFolder folder;
  const std::uint64_t kVolumes = test::cases(120u);
  int facets = 0, caps = 0, far = 0, samples = 0, kept = 0;
  for (std::uint64_t seed = 0; seed < kVolumes; ++seed) {
    CAPTURE(seed);
    const RandomLabels labels(seed);
    folder.write("labels.raw", {labels.samples.begin(), labels.samples.end()});
    const bool is_sharp = seed % 2 == 0, capped = seed % 4 < 2;
    const Index3 n = labels.dims;
    const int status = run_mesh(parsed(text(
        folder / "labels.raw", " --dims ", n.i, "x", n.j, "x", n.k,
        " --type uint8 --label all --shared ", folder / "all.ply", " -o ", folder / "%d.ply",
        " -q --ply-ascii --double --smooth ", is_sharp ? "0.3vox" : "1vox", capped ? " --cap" : "",
        seed % 5 == 0 ? " --block-side 4" : "", " --threads ", 1 + seed % 3)));
    CHECK(status == kExitSuccess);
    const SharedFile all = read_shared(folder / "all.ply");
    CHECK(shared_fault(all, labels.box(), capped) == "");

    for (std::size_t f = 0; f < all.triangles.size(); ++f) {
      const Vec3& p = all.points[all.triangles[f][0].number()];
      for (const std::int64_t side : all.sides[f])
        far += side < 0 || labels.is_near(p, static_cast<int>(side)) ? 0 : 1;
      ++(all.sides[f][0] < 0 ? caps : facets);
    }

    // Each label's own file has the same triangles, to the bit.
    std::vector<std::vector<Triangle>> of;
    for (int label = 0; label <= labels.most; ++label) {
      of.push_back(all.of(label));
      if (label == 0 || of.back().empty()) continue;
      std::vector<Corners3> here, own;
      for (const Triangle& t : of.back()) {
        here.push_back(corners_of(all.points[t[0].number()], all.points[t[1].number()],
                                  all.points[t[2].number()]));
      }
      const TriMesh mesh = read_mesh(folder / text(label, ".ply"));
      for (const Face& face : mesh.faces) {
        own.push_back(
            corners_of(mesh.points[face.v[0]], mesh.points[face.v[1]], mesh.points[face.v[2]]));
      }
      std::ranges::sort(here);
      std::ranges::sort(own);
      CHECK(here == own);
    }
    if (!capped) continue;
    // Near a sample is one label: its own, if smoothing is slight.
    for_each_index(n, [&](int i, int j, int k) {
      const auto within = [](int at, int count) { return at + (2 * at < count ? 2e-3 : -1.7e-3); };
      const Vec3 p{within(i, n.i), within(j, n.j), within(k, n.k)};
      int found = 0;
      for (int label = 1; label <= labels.most; ++label) {
        const double turns = winding_number(all.points, of[static_cast<std::size_t>(label)], p);
        CHECK(std::fabs(turns - std::round(turns)) < 1e-6);
        if (std::lround(turns) == 0) continue;
        CHECK(found == 0);
        found = label;
      }
      ++samples;
      kept += !is_sharp || found == labels.at(i, j, k) ? 1 : 0;
    });
  }
  CHECK(facets > test::cases(30000));
  CHECK(caps > test::cases(3000));
  CHECK(far == 0);
  CHECK(samples > test::cases(3000));
  CHECK(kept == samples);
}

namespace {

// Notes the stages that a run tells.
struct ToldStages : Progress {
  using Progress::Progress;
  void stage_begins(const char* stage) override { told.insert(stage); }
  void draw(const std::string&, double) override {}
  std::set<std::string> told;
};

// Two halves of a block in background, and a voxel in one of them. The halves are labels 2 and 5,
// the voxel is `odd`.
struct Halves {
  static constexpr Index3 kDims{9, 8, 7};
  explicit Halves(int odd = 3) {
    std::string samples;
    for_each_index(kDims, [&](int i, int j, int k) {
      const bool outside = j == 0 || k == 0;
      const bool is_odd = i == 2 && j == 4 && k == 3;
      samples += static_cast<char>(is_odd ? odd : outside ? 0 : i < 5 ? 2 : 5);
    });
    folder.write("halves.raw", samples);
  }
  CommandLine line_of(const std::string& more) const {
    return parsed(folder / "halves.raw" + " --dims 9x8x7 --type int8 --label all " + more);
  }
  CommandLine line(const std::string& more) const {
    return line_of("--shared " + (folder / "all.ply") + " " + more);
  }
  // Meshes the labels. Returns the warnings. The progress knows all stages.
  std::vector<std::string> warnings(SharedRun& run) const {
    const std::vector<StageCost> known = mesh_stages(run.line);
    ToldStages stages(known);
    make_shared_mesh(run, stages);
    CHECK(!stages.told.empty());
    for (const std::string& stage : stages.told) {
      const bool is_known = std::ranges::any_of(
          known, [&](const StageCost& s) { return s.stage == stage || s.together == stage; });
      CHECK_MESSAGE(is_known, stage);
    }
    return warnings_of(run.notes);
  }
  std::string refusal(const std::string& more) const {
    return refusal_by([&] { run_mesh(line("-q " + more)); });
  }
  TemporaryFolder folder;
};

}  // namespace

TEST_CASE("a label that vanishes is told of, with the samples that it had") {
  const Halves halves;
  for (const char* more : {"", "--median 1"}) {
    CAPTURE(more);
    const bool vanishes = *more != 0;
    const CommandLine line = halves.line(more);
    const Source source = read_source(line);
    SharedRun run(line, source);
    const std::vector<std::string> warnings = halves.warnings(run);
    CHECK(run.sound());
    REQUIRE(run.labels.size() == 4);
    const SharedLabel& odd = run.labels[2];
    CHECK(odd.label.label == 3);
    CHECK(odd.label.samples == 1);
    CHECK((odd.kept == 0) == vanishes);
    CHECK((odd.triangles == 0) == vanishes);
    CHECK(warnings.size() == (vanishes ? 1 : 0));
    if (!vanishes) continue;
    const std::string told =
        "label 3 vanished: smoothing left nothing of its 1 sample; a smaller --smooth or "
        "--median keeps more";
    CHECK(warnings[0] == told);
    CHECK(report_json(run).find("\"kept_voxels\": 0,") != std::string::npos);
    // Of labels that are meshed one by one, too.
    const CommandLine all = halves.line_of(more);
    for (const CommandLine& one : lines_of_labels(all, source)) {
      const Input input = input_of(source, one);
      MeshRun alone(one, input);
      ProgressBar none(mesh_stages(one), false);
      mesh_input(alone, none);
      const std::vector<std::string> others = warnings_of(alone.notes, "open-at-border");
      CHECK(others == (one.field.labels[0] == 3 ? std::vector{told} : std::vector<std::string>()));
    }
  }
}

TEST_CASE("the report of common surfaces: topology, borders, caps, and a number that is not met") {
  const Halves halves;
  const CommandLine line = halves.line("--cap --vertices 4 --verbose --smooth 0.4vox");
  const Source source = read_source(line);
  SharedRun run(line, source);
  const std::vector<std::string> warnings = halves.warnings(run);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find(" without caps, 4 asked for: with fewer the topology would change") !=
        std::string::npos);
  CHECK(run.sound());
  for (const SharedLabel& l : run.labels) {
    if (l.label.label == 0) continue;
    CHECK(l.exact ==
          (l.label.label == 2 ? TopologyCounts{2, 4, 0} : TopologyCounts{1, 2, 0}));  // 3 is in 2
    CHECK(l.mesh == l.exact);
    REQUIRE(l.mesh_volume.has_value());
    // Label 3 has one voxel, and those around it keep their labels.
    CHECK(*l.mesh_volume > (l.label.label == 3 ? 0.2 : 0.8) * l.voxel_volume);
    CHECK(*l.mesh_volume < 1.2 * l.voxel_volume);
  }
  // The background is in front of 2 and 5, the larger label of the others; four faces are all of
  // one label and background.
  std::vector<std::array<std::int64_t, 2>> borders;
  double area = 0;
  for (const SharedBorder& border : run.borders) {
    borders.push_back(border.sides);
    CHECK(border.triangles > 0);
    area += border.sides[0] < 0 ? border.area : 0;
  }
  const std::vector<std::array<std::int64_t, 2>> expected{
      {-6, 2}, {-6, 5}, {-4, 2}, {-4, 5}, {-2, 5}, {-1, 2}, {0, 2}, {0, 5}, {3, 2}, {5, 2}};
  CHECK(borders == expected);
  // Caps without the background's: 8 x 6.5, 8 x 5.5, and two of 6.5 x 5.5. For so few vertices the
  // bound on the distance is two voxels.
  CHECK(area == doctest::Approx(8 * 6.5 + 8 * 5.5 + 2 * 6.5 * 5.5).epsilon(0.03));
  const std::string report = report_text(run);
  for (const char* words : {"\nshared    ", "4 pairs of labels, no crossings, smallest angle ",
                            "\ncount     ", "\nborder    5 and 2: ", "\ncost      read "}) {
    CHECK_MESSAGE(report.find(words) != std::string::npos, words);
  }
  // glTF has a primitive for each two, in the color of the label behind. They share vertices.
  const std::string glb = halves.folder / "all.glb";
  MeshWriteOptions write = united_options(run);
  write.format = MeshFormat::glb;
  CHECK(write.groups.size() == expected.size());
  write_mesh(united_mesh(run), glb, write);
  MeshNotes notes;
  CHECK(read_mesh(glb, &notes).points.size() == run.mesh.points.size());
  REQUIRE(notes.colors.size() == run.sides.size());
  for (std::size_t f = 0; f < notes.colors.size(); ++f) {
    const Rgb color = category_color(static_cast<std::size_t>(run.sides[f][1]));
    CHECK(notes.colors[f] == std::array{color.red, color.green, color.blue});
  }
  const std::string bytes = file_bytes(glb);
  for (const char* name : {"label 2 / label 5", "label 5 / label 0", "label 2 / border"}) {
    CHECK_MESSAGE(bytes.find(text("{\"name\":\"", name)) != bytes.npos, name);
  }
}

TEST_CASE("a label around others has no volume without caps, though it has no loop") {
  const Halves halves;
  const std::string around = halves.folder.write("around.raw", [] {
    std::string samples;
    for_each_index({9, 8, 7}, [&](int i, int j, int k) {
      const bool is_in = i > 2 && i < 6 && j > 1 && j < 6 && k > 1 && k < 5;
      samples += static_cast<char>(is_in ? 2 : 5);
    });
    return samples;
  }());
  for (const bool cap : {false, true}) {
    const CommandLine line = parsed(around + " --dims 9x8x7 --type int8 --label all --shared " +
                                    (halves.folder / "all.ply") + (cap ? " --cap" : ""));
    const Source source = read_source(line);
    SharedRun run(line, source);
    CHECK(halves.warnings(run).empty());
    REQUIRE(run.labels.size() == 2);
    CHECK(run.labels[0].mesh_volume.has_value());
    CHECK(run.labels[1].mesh_volume.has_value() == cap);
  }
}

TEST_CASE("labels that cannot be common surfaces are refused in one line") {
  const auto told = [](const std::string& message) { return message.substr(message.find(": ")); };
  CHECK(told(Halves(-3).refusal("--cap")) ==
        ": label -3: with --cap, -1 to -6 stand for the faces of the volume");
  CHECK(Halves(-3).refusal("") == "");
  CHECK(told(Halves(5).refusal("--roi 6:9,2:8,2:7")) ==
        ": no two labels meet, so the mesh is empty (--cap closes labels on the volume's border, "
        "--allow-empty accepts it)");
  CHECK(Halves(5).refusal("--roi 6:9,2:8,2:7 --cap") == "");
  CHECK(Halves(5).refusal("--roi 6:9,2:8,2:7 --allow-empty") == "");
}
