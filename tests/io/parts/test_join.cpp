// SPDX-License-Identifier: MIT
// Volumes meshed block by block and joined. The whole must be valid like the mesh of one run. Both
// sides of a seam are equal. Parts that do not belong together are refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "base/check.h"
#include "base/random.h"
#include "check/verify.h"
#include "io/parts/in_blocks.h"
#include "mesh/check_mesh.h"
#include "stress/judge.h"
#include "stress/tiny_volume.h"

using namespace deliso;
using namespace deliso::test;
using stress::make_tiny_volume;

namespace {

std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// `lifted_off`: vertices that the report says are off Sigma, since no point of it would do.
void check_whole(const Volume& volume, double isovalue, const TriMesh& mesh,
                 std::uint64_t lifted_off = 0) {
  Report report;
  report.kappa_effective = geometric_isovalue(volume.type(), isovalue);
  const stress::Verdict verdict = stress::judge(volume, mesh, {}, report);
  if (lifted_off == 0) CHECK_MESSAGE(verdict.fault == std::string(), verdict.fault);
  CHECK(verdict.off_surface <= lifted_off);
  CHECK(verdict.intersections == 0);
  CHECK_FALSE(verdict.invalid);
  CHECK(verdict.topology_exact);
}

// A sphere that every block of a few has a piece of.
Volume sphere(int samples, double radius, float shift = 0) {
  std::vector<float> values;
  const double middle = 0.5 * (samples - 1) + 0.03;
  for (int k = 0; k < samples; ++k) {
    for (int j = 0; j < samples; ++j) {
      for (int i = 0; i < samples; ++i) {
        const Vec3 p{i - middle, j - middle, k - middle};
        values.push_back(static_cast<float>(radius - length(p)) + shift);
      }
    }
  }
  return Volume::from_samples({samples, samples, samples}, {1, 1, 1}, values);
}

// The parts of a volume, in a folder of their own.
struct Parts {
  Parts(const Volume& volume, Index3 of, double isovalue, const Options& options = {},
        const std::string& prefix = "part") {
    for (const BlockChoice& block : all_blocks(of)) {
      const auto [i, j, k] = block.at;
      paths.push_back(
          folder / (prefix + std::to_string(i) + std::to_string(j) + std::to_string(k) + ".ply"));
      Report report;
      write_part(volume, block, isovalue, options, paths.back(), report);
    }
    whole = folder / "whole.ply";
  }
  Joined join() { return join_parts(paths, whole, false, false); }

  TemporaryFolder folder;
  std::vector<std::string> paths;
  std::string whole;
};

std::string fault_of(const std::vector<std::string>& paths, const std::string& whole) {
  try {
    join_parts(paths, whole, false, false);
  } catch (const InputError& error) {
    CHECK(content(whole).empty());
    return error.what();
  }
  std::filesystem::remove(whole);
  return {};
}

}  // namespace

TEST_CASE("random volumes in blocks, joined, are whole") {
  constexpr Index3 kOf[] = {{2, 1, 1}, {1, 2, 2}, {2, 2, 2}, {3, 3, 3}};
  std::uint64_t lifted = 0, lifted_off = 0;
  for (std::uint64_t seed = 1; seed <= 28; ++seed) {
    CAPTURE(seed);
    const auto tiny = make_tiny_volume(seed, 8, 12);
    Report sum;
    const TriMesh mesh = mesh_in_blocks(tiny.volume, kOf[seed % 4], tiny.isovalue, {}, sum);
    check_whole(tiny.volume, tiny.isovalue, mesh, sum[Counter::cap_lifts_off_surface]);
    lifted += sum[Counter::cap_edges_lifted];
    lifted_off += sum[Counter::cap_lifts_off_surface];
  }
  CHECK(lifted > 100);  // edges that lay in a seam, which are the hard part
  CHECK(lifted_off <= 1);
}

TEST_CASE("both sides of a seam have the same vertices in the same places") {
  std::size_t compared = 0;
  for (std::uint64_t seed = 30; seed < 44; ++seed) {
    CAPTURE(seed);
    const auto tiny = make_tiny_volume(seed, 8, 12);
    const int axis = static_cast<int>(seed % 3);
    Index3 of{1, 1, 1};
    of[axis] = 2;
    std::map<GridEdge, Vec3> seam[2];
    for (const BlockChoice& block : all_blocks(of)) {
      const Volume volume = block_of(tiny.volume, block);
      Report report;
      const TriMesh mesh = mesh_isosurface(volume, tiny.isovalue, {}, report);
      for (const SeamVertex& s : seam_of(mesh, volume)) {
        seam[block.at[axis]][s.at] = mesh.points[s.vertex];
      }
    }
    CHECK(seam[0] == seam[1]);
    compared += seam[0].size();
  }
  CHECK(compared > 500);
}

TEST_CASE("the whole has the same bytes in any order of the parts") {
  Parts parts(sphere(14, 5), {2, 2, 2}, 0);
  const Joined joined = parts.join();
  CHECK(joined.parts == 8);
  CHECK(joined.seam_vertices > 0);
  const std::string first = content(parts.whole);
  std::reverse(parts.paths.begin(), parts.paths.end());
  std::swap(parts.paths[2], parts.paths[5]);
  parts.join();
  CHECK(content(parts.whole) == first);
  const TriMesh mesh = read_mesh(parts.whole);
  CHECK(mesh.points.size() == joined.vertices);
  CHECK(mesh.faces.size() == joined.triangles);
  CHECK(mesh_topology(mesh).euler() == 2);
  check_whole(sphere(14, 5), 0, mesh);
}

TEST_CASE("blocks without surface are parts like others, and so are blocks of one voxel") {
  // All but the first block of each axis are empty, or all but a few.
  const Volume volume = sphere(12, 2.2);
  for (const Index3 of : {Index3{5, 1, 1}, Index3{11, 1, 1}, Index3{1, 11, 2}, Index3{3, 4, 5}}) {
    Report sum;
    check_whole(volume, 0, mesh_in_blocks(volume, of, 0, {}, sum));
  }
  Parts parts(volume, {2, 1, 1}, 100);
  CHECK(parts.join().vertices == 0);
}

TEST_CASE("a seam follows from the volume alone, not from the criteria") {
  const Volume volume = sphere(40, 15);
  Options coarse;
  coarse.limits[Criterion::distance].value = 0.4;
  Parts fine_parts(volume, {2, 1, 1}, 0), coarse_parts(volume, {2, 1, 1}, 0, coarse);
  const Joined fine = fine_parts.join(), wide = coarse_parts.join();
  CHECK(wide.seam_vertices == fine.seam_vertices);
  CHECK(wide.vertices < fine.vertices);
  // A circle of radius 15 crosses some 8 r / sqrt 2 grid edges: not all of them are needed.
  CHECK(fine.seam_vertices < 100);
}

TEST_CASE("parts that do not belong together are refused, with the file's name") {
  const Volume volume = sphere(14, 5);
  Parts parts(volume, {2, 1, 1}, 0);
  const std::vector<std::string> paths = parts.paths;
  const std::string to = parts.folder / "refused.ply";
  const auto with = [&](const std::string& other) { return std::vector{paths[0], other}; };
  const auto names = [](const std::string& fault, const std::string& word) {
    return fault.find(word) != std::string::npos;
  };

  CHECK(names(fault_of({paths[0]}, to), "block 1,0,0 of 2,1,1 is missing"));
  CHECK(names(fault_of({paths[1]}, to), "block 0,0,0 of 2,1,1 is missing"));
  CHECK(names(fault_of({paths[0], paths[1], paths[1]}, to), "are both block 1,0,0"));
  CHECK(names(fault_of({paths[0], paths[0]}, to), "are both block 0,0,0"));

  Parts other_isovalue(volume, {2, 1, 1}, 0.5, {}, "isovalue");
  CHECK(names(fault_of(with(other_isovalue.paths[1]), to), "isovalue100"));
  CHECK(names(fault_of(with(other_isovalue.paths[1]), to), "isovalue=0.5"));
  Parts other_blocks(volume, {2, 1, 2}, 0, {}, "blocks");
  CHECK(names(fault_of(with(other_blocks.paths[1]), to), "blocks100"));
  // Another volume of the same size, with the same surface where the blocks meet but not the same
  // samples; and one that has another surface, whose samples are forged.
  Parts other_volume(sphere(14, 5, 0.25f), {2, 1, 1}, 0, {}, "volume");
  CHECK(names(fault_of(with(other_volume.paths[1]), to), "other samples"));
  Parts other_surface(sphere(14, 5.5f), {2, 1, 1}, 0, {}, "surface");
  const std::string ours = content(paths[1]);
  const Volume block = block_of(volume, {{1, 0, 0}, {2, 1, 1}});
  const PartMesh other = read_part(other_surface.paths[1]);
  MeshWriteOptions how;
  how.seam = other.seam;
  how.comment = part_comment("deliso test", block, {{1, 0, 0}, {2, 1, 1}}, 0, other);
  write_mesh(read_mesh(other_surface.paths[1]), parts.folder / "forged.ply", how);
  CHECK(names(fault_of(with(parts.folder / "forged.ply"), to), "does not match"));

  // No part at all.
  write_mesh(read_mesh(paths[0]), parts.folder / "mesh.ply");
  CHECK(names(fault_of(with(parts.folder / "mesh.ply"), to), "is no part of a mesh"));
  std::ofstream(parts.folder / "broken.ply", std::ios::binary) << ours.substr(0, ours.size() / 2);
  CHECK(names(fault_of(with(parts.folder / "broken.ply"), to), "broken.ply"));
  CHECK(fault_of(paths, to).empty());
}

TEST_CASE("a part that differs from its note, or has no checksum, is refused") {
  Parts parts(sphere(14, 5), {2, 1, 1}, 0);
  const std::string ours = content(parts.paths[1]), to = parts.folder / "refused.ply";
  const std::string edited = parts.folder / "edited.ply";
  const auto fault_with = [&](std::string bytes) {
    write_bytes(edited, bytes);
    return fault_of({parts.paths[0], edited}, to);
  };
  const auto without = [&](const std::string& words) {
    std::string bytes = ours;
    const std::size_t at = bytes.find(words);
    return bytes.erase(at, bytes.find_first_of(" \n", at + 1) - at);
  };
  CHECK(fault_with(ours).empty());
  std::string inside = ours;
  inside[ours.find("end_header") + 11 + 24 * 20] ^= 1;  // a coordinate's last bit
  CHECK(fault_with(inside).find("edited.ply' is not as it was made: it has holds=") !=
        std::string::npos);
  std::string isovalue = ours;
  isovalue.replace(isovalue.find("deliso test"), 11, "deliso text");
  CHECK(fault_with(isovalue).find("is no part of the same mesh") != std::string::npos);
  CHECK(fault_with(without(" checksum=")).find("its note says holds=") != std::string::npos);
  std::string old = ours;
  const std::size_t at = old.find(" holds=");
  old.erase(at, old.find('\n', at) - at);
  CHECK(fault_with(old).find("edited.ply' has no checksum in its note") != std::string::npos);
}

TEST_CASE("more blocks than 64 bits can count are not taken for fewer") {
  Parts parts(sphere(14, 5), {1, 1, 1}, 0);
  for (const auto& [dims, of] :
       {std::pair{"642x6700418x2", "641,6700417,1"},
        std::pair{"2147483647x2147483647x2147483647", "2147483646,2147483646,2147483646"}}) {
    std::string bytes = content(parts.paths[0]);
    bytes.replace(bytes.find("14x14x14"), 8, dims);
    bytes.replace(bytes.find("0/1,1,1") + 2, 5, of);
    write_bytes(parts.folder / "huge.ply", bytes);
    CHECK(fault_of({parts.folder / "huge.ply"}, parts.whole).find("block 1,0,0 of") !=
          std::string::npos);
  }
}

TEST_CASE("text and floats have their checksums as well, and a turned frame keeps its space") {
  const Volume straight = sphere(14, 5);
  const std::array<Vec3, 3> axes{Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}};  // left-handed
  const Frame frame{{0.1, -7, 1e-9}, axes, AnatomicalSpace::lps};
  std::vector<float> samples;
  for (int n = 0; n < 14 * 14 * 14; ++n) {
    samples.push_back(static_cast<float>(straight.sample(n % 14, n / 14 % 14, n / 196)));
  }
  const Volume volume = Volume::from_samples({14, 14, 14}, {1, 1, 1}, samples, frame);
  for (const bool ascii : {false, true}) {
    for (const bool single : {false, true}) {
      const TemporaryFolder folder;
      std::vector<std::string> paths;
      for (const BlockChoice& block : all_blocks({2, 1, 1})) {
        paths.push_back(folder / ("part" + std::to_string(paths.size()) + ".ply"));
        Report report;
        MeshWriteOptions how;
        how.ascii = ascii;
        how.single_precision = single;
        write_part(volume, block, 0, {}, paths.back(), report, how);
      }
      join_parts(paths, folder / "whole.ply", false, false);
      CHECK(content(folder / "whole.ply").find("\ncomment DelIso SPACE=LPS\n") !=
            std::string::npos);
    }
  }
}

TEST_CASE("one block is at the isovalue of blocks, where samples equal it") {
  std::vector<std::uint8_t> samples(64, 0);
  for (const std::size_t n : {21u, 22u, 25u, 26u, 37u, 38u, 41u, 42u}) samples[n] = 9;
  const Volume volume = Volume::from_samples({4, 4, 4}, {1, 1, 1}, samples);
  Report report;
  check_whole(volume, 9, mesh_in_blocks(volume, {1, 1, 1}, 9, {}, report));
}
