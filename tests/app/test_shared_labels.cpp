// SPDX-License-Identifier: MIT
// --label all --shared: the files of random labels, read as another program would.
#include "app/shared_labels.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "app/run.h"
#include "base/random.h"
#include "check/self_intersections.h"
#include "io/mesh/read_mesh.h"
#include "mesh/quality.h"

using namespace deliso;

namespace {

// Labels from 0 to `most`, in spacing 1: cells of a Voronoi diagram, the same in a ball, runs of
// samples in rows, or single voxels in background.
struct RandomLabels {
  explicit RandomLabels(std::uint64_t seed) {
    Random random(seed);
    for (int axis = 0; axis < 3; ++axis) dims[axis] = 4 + static_cast<int>(random.below(7));
    most = 2 + static_cast<int>(random.below(5));
    std::vector<Vec3> centers;
    for (int n = 0; n < 9; ++n) {
      centers.push_back({dims.i * random.uniform(), dims.j * random.uniform(),
                         dims.k * random.uniform()});
    }
    const auto kind = random.below(4);
    int run = 0;
    for (int k = 0; k < dims.k; ++k) {
      for (int j = 0; j < dims.j; ++j) {
        for (int i = 0; i < dims.i; ++i) {
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
        }
      }
    }
    samples[samples.size() / 2] = 1;  // not all is background
  }
  int at(int i, int j, int k) const {
    const bool in = i >= 0 && j >= 0 && k >= 0 && i < dims.i && j < dims.j && k < dims.k;
    return in ? samples[static_cast<std::size_t>((k * dims.j + j) * dims.i + i)] : 0;
  }

  Index3 dims;
  int most = 0;
  std::vector<std::uint8_t> samples;
};

struct SharedFile {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<std::array<int, 2>> sides;  // label_front, label_behind

  // The triangles of a label, counter-clockwise seen from outside.
  std::vector<Triangle> of(int label) const {
    std::vector<Triangle> found;
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      const Triangle& t = triangles[f];
      if (sides[f][1] == label) found.push_back(t);
      if (sides[f][0] == label) found.push_back({t[0], t[2], t[1]});
    }
    return found;
  }
};

SharedFile read_shared(const std::string& name) {
  std::ifstream in(name);
  std::size_t points = 0, triangles = 0;
  std::string line;
  std::vector<std::string> properties;
  while (std::getline(in, line) && line != "end_header") {
    if (line.starts_with("element vertex ")) points = std::stoul(line.substr(15));
    if (line.starts_with("element face ")) triangles = std::stoul(line.substr(13));
    if (line.starts_with("property int ")) properties.push_back(line.substr(13));
  }
  CHECK(properties == std::vector<std::string>{"label_front", "label_behind"});
  SharedFile file;
  for (Vec3 p; points > 0 && in >> p.x >> p.y >> p.z; --points) file.points.push_back(p);
  std::uint32_t three, a, b, c;
  for (std::array<int, 2> s; in >> three >> a >> b >> c >> s[0] >> s[1];) {
    CHECK(three == 3);
    file.triangles.push_back({VertexId(a), VertexId(b), VertexId(c)});
    file.sides.push_back(s);
  }
  CHECK(file.triangles.size() == triangles);
  return file;
}

// True if each edge is passed as often in one direction as in the other.
bool is_closed(std::span<const Triangle> triangles) {
  std::map<std::array<VertexId, 2>, int> passes;
  for (const Triangle& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      const VertexId a = t[i], b = t[(i + 1) % 3];
      if (a < b) ++passes[{a, b}];
      if (b < a) --passes[{b, a}];
    }
  }
  return std::ranges::all_of(passes, [](const auto& edge) { return edge.second == 0; });
}

// How often the triangles go around p.
double winding(const SharedFile& file, std::span<const Triangle> triangles, const Vec3& p) {
  double angles = 0;
  for (const Triangle& t : triangles) {
    const Vec3 a = file.points[t[0].number()] - p, b = file.points[t[1].number()] - p,
               c = file.points[t[2].number()] - p;
    const double la = length(a), lb = length(b), lc = length(c);
    angles += 2 * std::atan2(dot(a, cross(b, c)),
                             la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angles / (4 * 3.14159265358979);
}

using Corners3 = std::array<std::array<double, 3>, 3>;
// The triangle's corners, from the least one.
Corners3 corners_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  Corners3 all{{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}}};
  std::ranges::rotate(all, std::ranges::min_element(all));
  return all;
}

}  // namespace

TEST_CASE("random labels fill space once, between common triangles that never cross") {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / "deliso-test-shared-labels";
  std::filesystem::create_directories(folder);
  const auto path = [&](const std::string& name) { return (folder / name).string(); };
  int sound = 0, samples = 0, kept = 0;
  constexpr int kVolumes = 200;
  for (std::uint64_t seed = 0; seed < kVolumes; ++seed) {
    CAPTURE(seed);
    const RandomLabels labels(seed);
    std::ofstream(path("labels.raw"), std::ios::binary)
        .write(reinterpret_cast<const char*>(labels.samples.data()),
               static_cast<std::streamsize>(labels.samples.size()));
    std::ostringstream dims;
    dims << labels.dims.i << 'x' << labels.dims.j << 'x' << labels.dims.k;
    const bool is_sharp = seed % 2 == 0;
    const std::vector<std::string> words{
        path("labels.raw"), "--dims",    dims.str(),      "--type", "uint8",
        "--label",          "all",       "--shared",      path("all.ply"), "-o",
        path("%d.ply"),     "-q",        "--ply-ascii",   "--double",      "--smooth",
        is_sharp ? "0.3vox" : "1vox"};
    const int status =
        run_mesh(parse_command_line(std::vector<std::string_view>(words.begin(), words.end())));
    CHECK((status == kExitSuccess || status == kFaultFound));
    sound += status == kExitSuccess ? 1 : 0;
    const SharedFile all = read_shared(path("all.ply"));
    REQUIRE(!all.triangles.empty());

    // Each facet once, between two labels of samples near.
    std::set<std::set<VertexId>> facets;
    for (std::size_t f = 0; f < all.triangles.size(); ++f) {
      const Triangle& t = all.triangles[f];
      facets.insert({t[0], t[1], t[2]});
      CHECK(all.sides[f][0] != all.sides[f][1]);
      for (const int side : all.sides[f]) {
        bool is_near = false;
        const Vec3& p = all.points[t[0].number()];
        const int x = static_cast<int>(std::lround(p.x)), y = static_cast<int>(std::lround(p.y)),
                  z = static_cast<int>(std::lround(p.z));
        for (int n = 0; n < 125; ++n) {
          is_near |= labels.at(x + n % 5 - 2, y + n / 5 % 5 - 2, z + n / 25 - 2) == side;
        }
        CHECK(is_near);
      }
    }
    CHECK(facets.size() == all.triangles.size());
    std::vector<Face> faces;
    for (const Triangle& t : all.triangles) faces.push_back({t, {}});
    CHECK(count_crossings(all.points, faces) == 0);

    // Each label is closed; its own file has the same triangles.
    std::vector<std::vector<Triangle>> of;
    double volume = 0, union_volume = 0;
    for (int label = 0; label <= labels.most; ++label) {
      of.push_back(all.of(label));
      CHECK(is_closed(of.back()));
      double enclosed = 0;
      std::vector<Corners3> here, own;
      for (const Triangle& t : of.back()) {
        const Vec3 &a = all.points[t[0].number()], &b = all.points[t[1].number()],
                   &c = all.points[t[2].number()];
        enclosed += dot(a, cross(b, c)) / 6;
        here.push_back(corners_of(a, b, c));
      }
      (label == 0 ? union_volume : volume) += enclosed;
      if (label == 0 || of.back().empty()) continue;
      const TriMesh mesh = read_mesh(path(std::to_string(label) + ".ply"));
      for (const Face& face : mesh.faces) {
        own.push_back(corners_of(mesh.points[face.v[0]], mesh.points[face.v[1]],
                                 mesh.points[face.v[2]]));
      }
      std::ranges::sort(here);
      std::ranges::sort(own);
      CHECK(here == own);
      CHECK(enclosed_volume(mesh) == doctest::Approx(enclosed).epsilon(1e-9));
    }
    CHECK(volume == doctest::Approx(-union_volume).epsilon(1e-9));

    // A sample is in one label, mostly its own.
    for (int k = 0; k < labels.dims.k; ++k) {
      for (int j = 0; j < labels.dims.j; ++j) {
        for (int i = k % 2; i < labels.dims.i; i += 2) {
          int inside = 0, where = 0;
          for (int label = 1; label <= labels.most; ++label) {
            const double turns = winding(all, of[static_cast<std::size_t>(label)],
                                         {double(i), double(j), double(k)});
            CHECK(std::fabs(turns - std::round(turns)) < 1e-6);
            CHECK((std::lround(turns) == 0 || std::lround(turns) == 1));
            if (std::lround(turns) == 0) continue;
            ++inside;
            where = label;
          }
          CHECK(inside <= 1);
          samples += is_sharp ? 1 : 0;
          kept += is_sharp && where == labels.at(i, j, k) ? 1 : 0;
        }
      }
    }
  }
  MESSAGE(sound << " sound, " << kept << " of " << samples << " samples kept");
  CHECK(sound > kVolumes / 2);
  CHECK(kept > 0.98 * samples);
  std::filesystem::remove_all(folder);
}
