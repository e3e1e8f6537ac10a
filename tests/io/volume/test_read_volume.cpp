// SPDX-License-Identifier: MIT
#include "io/volume/read_volume.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <tuple>

#include "base/text.h"
#include "io/volume/builtin_volume.h"
#include "read_fault.h"
#include "refusal.h"
#include "volume/sampled.h"
#include "volume_files.h"

using namespace deliso;
using namespace deliso::test;

namespace {

double difference(const Vec3& a, const Vec3& b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

// NIfTI-1 holds float32, so its geometry is good to 1e-6 of a coordinate.
void check_same(const Volume& volume, const Truth& truth, bool has_axes, double tolerance) {
  REQUIRE(volume.dims() == truth.dims);
  REQUIRE(volume.type() == truth.type);
  CHECK(bytes_of_samples(volume) == truth.bytes);
  CHECK(difference(volume.spacing(), truth.spacing) <= tolerance);
  if (!has_axes) return;
  CHECK(difference(volume.frame().origin, truth.origin) <= 30 * tolerance);
  for (std::size_t axis = 0; axis < 3; ++axis)
    CHECK(difference(volume.frame().axes[axis], truth.axes[axis]) <= tolerance);
}

// Axes of many kinds: along the world's, permuted, mirrored, turned any way.
std::array<Vec3, 3> axes_of_kind(int kind, Random& random) {
  if (kind == 0) return {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  if (kind == 1) return {Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}};
  if (kind == 2) return {Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}};  // a half turn
  if (kind == 3) return {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}};   // left-handed
  const auto direction = [&] {
    return Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  };
  std::array<Vec3, 3> axes;
  do {  // near a half turn NIfTI's quaternion of three float32 is imprecise by its nature
    const Vec3 a = direction(), b = cross(a, direction());
    axes[0] = a / length(a);
    axes[1] = b / length(b);
    axes[2] = cross(axes[0], axes[1]);
  } while (1 + axes[0].x + axes[1].y + axes[2].z < 0.4);
  if (kind % 2 == 0) axes[2] = -axes[2];
  return axes;
}

}  // namespace

TEST_CASE("every format, encoding, type and byte order reads back what was written") {
  const TemporaryFolder folder;
  int volumes = 0;
  for (SampleType type : kAllTypes) {
    for (int kind = 0; kind < 6; ++kind) {
      const std::uint64_t seed =
          100 * static_cast<std::uint64_t>(type) + static_cast<unsigned>(kind);
      Random random(seed);
      Truth truth = random_truth(type, {2 + kind, 7, 5}, seed);
      truth.spacing = {0.5, 1.25, 3};
      truth.origin = {10, -20.25, 30.5};
      truth.axes = axes_of_kind(kind, random);
      for (const StoredVolume& stored : all_forms(truth)) {
        CAPTURE(stored.label);
        CAPTURE(stored.files.front().name);
        CAPTURE(seed);
        ReadLog log;
        const Volume volume = read_volume(stored.write(folder), stored.options, &log);
        const double tolerance = stored.label.starts_with("nifti") ? 1e-6 : 1e-12;
        check_same(volume, truth, stored.has_axes, tolerance);
        CHECK(volume.frame().left_handed() == (stored.has_axes && (kind == 3 || kind == 4)));
        // The .vti files have a second array.
        CHECK(log.notes.size() == (stored.label.starts_with("vti") ? 1 : 0));
        ++volumes;
      }
    }
  }
  CHECK(volumes > 3000);
}

// Random integers of 64 bits up to 2^`bits`, and some that are near it.
Truth wide_truth(int bits, std::uint64_t seed) {
  Truth truth = random_truth(SampleType::f64, {5, 4, 3}, seed);
  truth.is_wide = true;
  Random random(seed);
  for (std::size_t n = 0; n < truth.count(); ++n) {
    std::int64_t value = (std::int64_t{1} << bits) - static_cast<std::int64_t>(random.below(2));
    if (n % 3 == 0) value = static_cast<std::int64_t>(random.next() >> (64 - bits));
    if (n % 2 == 0) value = -value;
    std::memcpy(&truth.bytes[8 * n], &value, sizeof value);
  }
  return truth;
}

TEST_CASE("integers of 64 bits become float64, or numbers of ids, in every format") {
  const TemporaryFolder folder;
  int volumes = 0;
  for (const int bits : {31, 53, 54, 62}) {
    const Truth truth = wide_truth(bits, static_cast<std::uint64_t>(bits));
    std::vector<std::int64_t> values(truth.count());
    std::memcpy(values.data(), truth.bytes.data(), truth.bytes.size());
    const auto [least, most] = std::ranges::minmax(values);
    for (StoredVolume stored : all_forms(truth)) {
      CAPTURE(bits);
      CAPTURE(stored.label);
      CAPTURE(stored.files.front().name);
      const std::string path = stored.write(folder);
      const bool is_exact = bits <= 53;
      if (!is_exact) {
        const std::string error = read_message(path, stored.options);
        CHECK(error.find(text("its integers of 64 bits are from ", least, " to ", most)) !=
              std::string::npos);
      }
      ReadLog log;
      stored.options.as_labels = true;
      const Volume volume = read_volume(path, stored.options, &log);
      CHECK(volume.type() == (is_exact ? SampleType::f64 : SampleType::u32));
      CHECK(log.ids.empty() == is_exact);
      CHECK(std::ranges::is_sorted(log.ids));
      CHECK(text_of(log.notes.back()).find(": 64-bit integers are read as ") != std::string::npos);
      std::size_t wrong = 0;
      for (std::size_t n = 0; n < values.size(); ++n) {
        volume.visit([&](const auto* samples) {
          wrong += is_exact ? static_cast<std::int64_t>(samples[n]) != values[n]
                            : log.ids.at(static_cast<std::size_t>(samples[n])) != values[n];
        });
      }
      CHECK(wrong == 0);
      ++volumes;
    }
  }
  CHECK(volumes > 400);
}

TEST_CASE("unsigned integers of 64 bits have labels up to 2^63 - 1") {
  const TemporaryFolder folder;
  const auto read = [&](std::uint64_t largest, bool as_labels, ReadLog& log) {
    std::string samples;
    for (int n = 0; n < 8; ++n) samples += little(n == 5 ? largest : 3, 8);
    ReadOptions options;
    options.as_labels = as_labels;
    return read_volume(folder.write("v.npy", npy("<u8", false, "2, 2, 2", samples)), options, &log)
        .sample(1, 0, 1);
  };
  ReadLog log;
  CHECK(read(std::uint64_t{1} << 63, false, log) == 0x1p63);
  CHECK(log.ids.empty());
  constexpr std::uint64_t most = std::numeric_limits<std::int64_t>::max();
  CHECK(read(most, true, log) == 1);
  CHECK(log.ids == std::vector<std::int64_t>{3, std::numeric_limits<std::int64_t>::max()});
  CHECK_THROWS_AS(read(most, false, log), InputError);
  CHECK_THROWS_AS(read(most + 2, true, log), InputError);
  CHECK_THROWS_AS(read(~std::uint64_t{0}, true, log), InputError);
}

// Writers of NIfTI have NaN where there is no scale.
TEST_CASE("labels of 64 bits are read where NIfTI's slope is NaN") {
  const TemporaryFolder folder;
  NiftiForm form;
  form.slope = NAN;
  const auto files = nifti(wide_truth(62, 1), form);
  ReadOptions options;
  options.as_labels = true;
  ReadLog log;
  read_volume(folder.write(files[0].name, files[0].content), options, &log);
  CHECK(log.ids.size() > 2);
}

TEST_CASE("a sheared grid is read, with a note") {
  const TemporaryFolder folder;
  Truth truth = random_truth(SampleType::u8, {3, 4, 5}, 1);
  truth.axes[1] = Vec3{0.6, 0.8, 0};
  ReadLog log;
  const Volume volume = read_volume(
      folder.write("v.nrrd",
                   nrrd(truth, std::endian::little, "raw", NrrdForm::attached)[0].content),
      {}, &log);
  check_same(volume, truth, true, 1e-12);
  REQUIRE(log.notes.size() == 1);
  CHECK(log.notes[0].words.find("sheared grid (x and y enclose 53.1301 degrees)") !=
        std::string::npos);
}

TEST_CASE("a rectilinear grid of VTK has its coordinates, in text and in bytes") {
  const TemporaryFolder folder;
  const auto file = [&](const std::string& coordinates) {
    std::string samples;
    for (int n = 0; n < 24; ++n) samples += text(n * n % 17, " ");
    return folder.write(
        "v.vtr",
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"RectilinearGrid\" version=\"0.1\" "
        "byte_order=\"LittleEndian\">\n<RectilinearGrid WholeExtent=\"5 7 0 1 -3 0\">\n<Piece "
        "Extent=\"5 7 0 1 -3 0\"><PointData Scalars=\"a\"><DataArray type=\"Int16\" Name=\"a\" "
        "format=\"ascii\">" +
            samples + "</DataArray></PointData><Coordinates>" + coordinates +
            "</Coordinates></Piece></RectilinearGrid></VTKFile>\n");
  };
  const auto array = [](const char* numbers) {
    return text("<DataArray type=\"Float64\" format=\"ascii\">", numbers, "</DataArray>");
  };
  // Bytes in base64: their number, 16, then 1 and 4 as float64.
  const std::string bytes =
      "<DataArray type=\"Float64\" format=\"binary\">EAAAAAAAAAAAAPA/AAAAAAAAEEA=</DataArray>";
  const std::string x = array("-2 0 0.5"), y = array("1 4"), z = array("3 4 6 6.5");
  for (const std::string& middle : {y, bytes}) {
    const Volume volume = read_volume(file(x + middle + z));
    CHECK(volume.dims() == Index3{3, 2, 4});
    CHECK(volume.frame().origin == Vec3{-2, 1, 3});
    CHECK(volume.all_places() == Coordinates{{{0, 2, 2.5}, {0, 3}, {0, 1, 3, 3.5}}});
    CHECK(volume.sample(1, 1, 2) == 16 * 16 % 17);
  }
  CHECK(read_message(file(x + y)) == "v.vtr: has 2 arrays of coordinates, not three");
  CHECK(read_message(file(x + z + y)) == "v.vtr: more than 2 numbers for the coordinates along y");
  CHECK(read_message(file(array("0 1 1") + y + z)) ==
        "v.vtr: its coordinates along x do not increase at sample 2");
  // Those of a text file stand for any other.
  ReadOptions options;
  options.coordinates =
      read_coordinates(folder.write("c.txt", "# made by hand\nz 1 2 4 8\n\nx 0 1 5\n"));
  const Volume volume = read_volume(file(x + y + z), options);
  CHECK(volume.frame().origin == Vec3{0, 1, 1});
  CHECK(volume.all_places() == Coordinates{{{0, 1, 5}, {0, 3}, {0, 1, 3, 7}}});
  for (const auto& [lines, fault] : {std::pair{"w 1 2", "has a line that is no x, y or z with"},
                                     {"x 1", "two or more numbers: 'x 1'"},
                                     {"x 1 b", "'x 1 b'"},
                                     {"x 1 2\nx 1 2", "has the coordinates along x twice"}}) {
    const std::string path = folder.write("c.txt", lines);
    const std::string told = refusal_by([&] { read_coordinates(path); });
    CHECK(told.find(fault) != std::string::npos);
  }
}

TEST_CASE("the anatomical space of a file is kept") {
  const TemporaryFolder folder;
  const Truth truth = random_truth(SampleType::u8, {3, 4, 5}, 1);
  const auto space = [&](const std::vector<NamedFile>& files) {
    return read_volume(folder.write(files.front().name, files.front().content)).frame().space;
  };
  CHECK(space(nrrd(truth, std::endian::little, "raw", NrrdForm::attached)) == AnatomicalSpace::lps);
  CHECK(space(metaimage(truth, std::endian::little, "raw", MetaForm::local)) ==
        AnatomicalSpace::lps);
  CHECK(space(nifti(truth, {})) == AnatomicalSpace::ras);
  CHECK(space(vtk(truth, true, false)) == AnatomicalSpace::unknown);
  std::vector<NamedFile> ras = nrrd(truth, std::endian::little, "raw", NrrdForm::attached);
  std::string& text = ras.front().content;
  text.replace(text.find("left-posterior-superior"), 23, "right-anterior-superior");
  CHECK(space(ras) == AnatomicalSpace::ras);
}

TEST_CASE("the options turn the world to another space, by half a turn about S") {
  const TemporaryFolder folder;
  Truth truth = random_truth(SampleType::i16, {6, 7, 8}, 3);
  truth.origin = {10, -20, 30};
  for (const StoredVolume& stored : all_forms(truth)) {
    CAPTURE(stored.label);
    const std::string path = stored.write(folder);
    ReadOptions options = stored.options;
    options.roi = Roi{{1, 0, 2}, {5, 7, 8}};
    const Volume own = read_volume(path, options);
    for (const AnatomicalSpace space : {AnatomicalSpace::ras, AnatomicalSpace::lps}) {
      options.space = space;
      if (own.frame().space == AnatomicalSpace::unknown) {
        CHECK(read_fault(path, options) ==
              "names no patient's space, RAS or LPS, that --space could turn");
        continue;
      }
      const Volume turned = read_volume(path, options);
      CHECK(turned.frame().space == space);
      CHECK(turned.frame().left_handed() == own.frame().left_handed());
      CHECK(turned.frame().in_space(own.frame().space) == own.frame());
      const Vec3 p = own.frame().to_world({1, 2, 3}), q = turned.frame().to_world({1, 2, 3});
      CHECK(q == (space == own.frame().space ? p : Vec3{-p.x, -p.y, p.z}));
    }
  }
}

// Only axes were kept; a wrong spacing could not be mended but in raw files.
TEST_CASE("a spacing and an origin of the options stand for the file's, in every format") {
  const TemporaryFolder folder;
  Truth truth = random_truth(SampleType::i16, {6, 7, 8}, 3);
  truth.spacing = {0.5, 1.25, 3};
  truth.origin = {10, -20, 30};
  truth.axes = {Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}};
  for (const StoredVolume& stored : all_forms(truth)) {
    CAPTURE(stored.label);
    const std::string path = stored.write(folder);
    const Frame own = read_volume(path, stored.options).frame();
    ReadOptions options = stored.options;
    options.spacing = Vec3{2, 3, 4};
    ReadLog log;
    const Volume spaced = read_volume(path, options, &log);
    CHECK(spaced.spacing() == Vec3{2, 3, 4});
    CHECK(spaced.frame() == own);
    CHECK(bytes_of_samples(spaced) == truth.bytes);
    options.origin = Vec3{-1, -2, -3};
    options.roi = Roi{{1, 0, 2}, {5, 7, 8}};
    const Volume placed = read_volume(path, options, &log);
    Frame moved = own;
    moved.origin = {-1, -2, -3};
    CHECK(placed.spacing() == Vec3{2, 3, 4});
    CHECK(distance(placed.frame().origin, moved.to_world({2, 0, 8})) < 1e-9);
    const auto is_of = [&](const char* option) {
      return std::ranges::count_if(log.notes, [&](const Diagnostic& note) {
        return note.words.ends_with(
            text("the ", option + 2, " is that of ", option, ", whatever the file says"));
      });
    };
    const bool has_none = stored.options.spacing.has_value();  // raw, NumPy, TIFF
    CHECK(is_of("--spacing") == (has_none ? 0 : 1));
    CHECK(is_of("--origin") == (has_none ? 0 : 1));
  }
  ReadOptions options;
  options.spacing = Vec3{2, 3, 4};
  options.origin = Vec3{1, 2, 3};
  const Volume torus = read_volume("builtin:torus:16", options);
  CHECK(torus.spacing() == Vec3{2, 3, 4});
  CHECK(torus.frame().origin == Vec3{1, 2, 3});
}

// The file was refused before anybody looked at the options.
TEST_CASE("a spacing and an origin of the options stand for bad ones, which name the options") {
  const TemporaryFolder folder;
  Truth truth = random_truth(SampleType::i16, {6, 7, 8}, 3);
  int replaced = 0;
  for (const double bad : {std::nan(""), 0.0}) {
    truth.spacing = {0.5, 1.25, bad};
    truth.origin = {0, std::nan(""), 0};
    for (const StoredVolume& stored : all_forms(truth)) {
      // DICOM is another matter: test_read_dicom.
      if (stored.options.spacing || stored.label.starts_with("dicom")) continue;
      CAPTURE(stored.label);
      const std::string path = stored.write(folder);
      ReadOptions options;
      CHECK(read_message(path).ends_with(
          ": spacing along z is not positive: --spacing SX,SY,SZ gives it"));
      options.spacing = Vec3{2, 3, 4};
      CHECK(read_message(path, options)
                .ends_with(": its origin is further than 1e+30 away: --origin X,Y,Z gives it"));
      options.origin = Vec3{-1, -2, -3};
      const Volume volume = read_volume(path, options);
      CHECK(volume.spacing() == Vec3{2, 3, 4});
      CHECK(volume.frame().origin == Vec3{-1, -2, -3});
      CHECK(volume.frame().axes == Frame().axes);
      CHECK(bytes_of_samples(volume) == truth.bytes);
      ++replaced;
    }
  }
  CHECK(replaced > 20);
}

TEST_CASE("a note tells of directions that a bad axis takes along") {
  const TemporaryFolder folder;
  Truth truth = random_truth(SampleType::u8, {3, 4, 5}, 1);
  truth.spacing.z = 0;
  ReadOptions options;
  options.spacing = Vec3{2, 3, 4};
  ReadLog log;
  read_volume(folder.write("v.nrrd",
                           nrrd(truth, std::endian::little, "raw", NrrdForm::attached)[0].content),
              options, &log);
  REQUIRE(log.notes.size() == 2);
  CHECK(text_of(log.notes[1])
            .ends_with(
                ": an axis of it has no direction: all are taken as x, y, z, in no known space"));
}

TEST_CASE("NIfTI's meters and micrometers become millimeters") {
  const TemporaryFolder folder;
  Truth truth = random_truth(SampleType::u8, {3, 4, 5}, 1);
  truth.spacing = {0.5, 1.25, 3};
  truth.origin = {10, -20, 30};
  for (const int version : {1, 2}) {
    for (const auto placement : {NiftiForm::Placement::qform, NiftiForm::Placement::sform}) {
      for (const auto& [unit, scale, noun] : {std::tuple{0, 1.0, ""},
                                              {1 + 8, 1000.0, "meters"},
                                              {2 + 8, 1.0, ""},
                                              {3 + 16, 0.001, "micrometers"}}) {
        NiftiForm form{version};
        form.placement = placement;
        std::string file = nifti(truth, form)[0].content;
        file[version == 1 ? 123 : 500] = static_cast<char>(unit);
        ReadLog log;
        const Volume volume = read_volume(folder.write("v.nii", file), {}, &log);
        CHECK(distance(volume.spacing(), scale * truth.spacing) < 1e-6 * scale);
        CHECK(distance(volume.frame().origin, scale * truth.origin) < 1e-5 * scale);
        CHECK(log.notes.size() == (scale == 1 ? 0 : 1));
        if (scale != 1) {
          CHECK(log.notes[0].words.ends_with(text("in millimeters, the header's in ", noun)));
        }
      }
    }
  }
}

TEST_CASE("a region has the same samples in every format") {
  const TemporaryFolder folder;
  Truth truth = random_truth(SampleType::i16, {6, 7, 8}, 3);
  truth.spacing = {0.5, 1.25, 3};
  truth.origin = {10, -20, 30};
  truth.axes = {Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}};
  const Roi regions[] = {{{0, 0, 0}, {6, 7, 8}},
                         {{0, 0, 3}, {6, 7, 5}},
                         {{1, 2, 3}, {4, 7, 8}},
                         {{4, 0, 6}, {6, 2, 8}}};
  for (const StoredVolume& stored : all_forms(truth)) {
    const std::string path = stored.write(folder);
    const Volume whole = read_volume(path, stored.options);
    for (const Roi& roi : regions) {
      CAPTURE(stored.label);
      ReadOptions options = stored.options;
      options.roi = roi;
      const Volume part = read_volume(path, options);
      REQUIRE(part.dims() ==
              Index3{roi.end.i - roi.begin.i, roi.end.j - roi.begin.j, roi.end.k - roi.begin.k});
      int different = 0;
      for_each_index(part.dims(), [&](int i, int j, int k) {
        different +=
            part.sample(i, j, k) != whole.sample(i + roi.begin.i, j + roi.begin.j, k + roi.begin.k);
      });
      CHECK(different == 0);
      // The same sample is at the same place in the world.
      const Vec3 there = whole.frame().to_world(whole.position(roi.begin));
      CHECK(difference(part.frame().to_world({0, 0, 0}), there) <= 1e-9);
    }
  }
}

TEST_CASE("regions know their place in the whole, and have its samples") {
  const Volume whole = make_builtin_volume("builtin:noise:23");
  const Index3 of{3, 2, 4};
  std::vector<int> seen(whole.sample_count());  // voxels, by their first samples
  int different = 0;
  for (int n = 0; n < 24; ++n) {
    const Index3 which{n % 3, n / 3 % 2, n / 6};
    ReadOptions options;
    options.region = [&](const Grid& grid) {
      const Index3 all = grid.dims();
      Roi roi;
      for (int axis = 0; axis < 3; ++axis) {
        roi.begin[axis] = which[axis] * (all[axis] - 1) / of[axis];
        roi.end[axis] = (which[axis] + 1) * (all[axis] - 1) / of[axis] + 1;
      }
      return roi;
    };
    const Volume block = make_builtin_volume("builtin:noise:23", options);
    CHECK(block.is_block());
    CHECK(block.whole_dims() == whole.dims());
    CHECK(block.frame() == whole.frame());
    const Index3 first = block.first(), dims = block.dims();
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(((block.inner_faces() >> (2 * axis)) & 1) == (which[axis] > 0));
      CHECK(((block.inner_faces() >> (2 * axis + 1)) & 1) == (which[axis] + 1 < of[axis]));
    }
    for_each_index(dims, [&](int i, int j, int k) {
      const Index3 at{first.i + i, first.j + j, first.k + k};
      different += block.sample(i, j, k) != whole.sample(at.i, at.j, at.k) ||
                   block.position({i, j, k}) != whole.position(at);
      const bool is_voxel = i + 1 < dims.i && j + 1 < dims.j && k + 1 < dims.k;
      seen[whole.index(at.i, at.j, at.k)] += is_voxel;
    });
    const Vec3 p = block.position({1, 1, 1}) + Vec3{0.25, 0.5, -0.125};
    CHECK(block.value(p) == whole.value(p));
    CHECK(block.gradient(p) == whole.gradient(p));
    CHECK(block.voxel_at(p) == Index3{1, 1, 0});
  }
  CHECK(different == 0);
  CHECK(std::ranges::count(seen, 1) == 22 * 22 * 22);
  CHECK(std::ranges::count(seen, 0) == 23 * 23 * 23 - 22 * 22 * 22);
  CHECK_FALSE(whole.is_block());
  ReadOptions failing;
  failing.region = [](const Grid&) -> Roi { throw InputError("too small"); };
  CHECK_THROWS_WITH_AS(make_builtin_volume("builtin:noise:23", failing),
                       "builtin:noise:23: too small", InputError);
}

TEST_CASE("raw data in native order is mapped, not copied") {
  // A volume that refers to its file changes with the file; a copy would not.
  const TemporaryFolder folder;
  const Truth truth = random_truth(SampleType::u8, {8, 8, 8}, 5);
  const auto files = nrrd(truth, std::endian::native, "raw", NrrdForm::detached);
  folder.write(files[1].name, files[1].content);
  const Volume volume = read_volume(folder.write(files[0].name, files[0].content));
  const double before = volume.sample(7, 7, 7);
  {
    std::fstream file(folder.path(files[1].name), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(511);
    file.put(static_cast<char>(static_cast<int>(before) ^ 1));
  }
  CHECK(volume.sample(7, 7, 7) == static_cast<double>(static_cast<int>(before) ^ 1));
}

TEST_CASE("NIfTI scaling is applied and logged") {
  const TemporaryFolder folder;
  for (SampleType type : kAllTypes) {
    const Truth truth = random_truth(type, {3, 4, 5}, 11);
    NiftiForm form;
    const auto read = [&](double slope, double intercept, ReadLog& log) {
      form.slope = slope;
      form.intercept = intercept;
      const auto files = nifti(truth, form);
      return read_volume(folder.write(files[0].name, files[0].content), {}, &log);
    };
    ReadLog log;
    for (const auto& [slope, intercept] : {std::pair{0.0, 5.0}, {1.0, 0.0}}) {
      CHECK(bytes_of_samples(read(slope, intercept, log)) == truth.bytes);
      CHECK(log.notes.empty());
    }
    CHECK(bytes_of_samples(read(NAN, 0, log)) == truth.bytes);
    CHECK(log.notes.size() == 1);
    log.notes.clear();

    const Volume plain = read(0, 0, log), scaled = read(0.5, -3, log);
    REQUIRE(log.notes.size() == 1);
    CHECK(log.notes[0].words.find("samples are scaled") != std::string::npos);
    const bool wide = type == SampleType::u32 || type == SampleType::i32 || type == SampleType::f64;
    REQUIRE(scaled.type() == (wide ? SampleType::f64 : SampleType::f32));
    for (int k = 0; k < 5; ++k) {
      const double expected = 0.5 * plain.sample(2, 3, k) - 3;
      CHECK(scaled.sample(2, 3, k) ==
            (wide ? expected : static_cast<double>(static_cast<float>(expected))));
    }
    CHECK_THROWS_AS(read(2, INFINITY, log), InputError);
  }
}

TEST_CASE("a NumPy array is indexed [z][y][x], in C and in Fortran order") {
  const TemporaryFolder folder;
  const Truth truth = random_truth(SampleType::i16, {4, 3, 2}, 7);
  const auto sample = [&](int i, int j, int k) {
    std::int16_t value;
    std::memcpy(&value, truth.bytes.data() + 2 * (i + 4 * (j + 3 * k)), 2);
    return value;
  };
  std::string by_z;  // z runs fastest
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 2; ++k) {
        const std::int16_t value = sample(i, j, k);
        by_z.append(reinterpret_cast<const char*>(&value), 2);
      }
    }
  }
  ReadOptions options;
  options.spacing = Vec3{0.5, 2, 3};
  const Volume c = read_volume(
      folder.write("c.npy", npy("<i2", false, "1, 2, 3, 4", truth.in_order(std::endian::little))),
      options);
  const Volume f = read_volume(folder.write("f.npy", npy("<i2", true, "2, 3, 4", by_z)), options);
  REQUIRE(c.dims() == Index3{4, 3, 2});
  REQUIRE(f.dims() == Index3{2, 3, 4});
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 2; ++k) {
        CHECK(c.sample(i, j, k) == sample(i, j, k));
        CHECK(f.sample(k, j, i) == sample(i, j, k));
        const Vec3 place{0.5 * i, 2.0 * j, 3.0 * k};
        CHECK(c.frame().to_world({0.5 * i, 2.0 * j, 3.0 * k}) == place);
        CHECK(f.frame().to_world({3.0 * k, 2.0 * j, 0.5 * i}) == place);
      }
    }
  }
}

TEST_CASE("NumPy's booleans become bytes") {
  const TemporaryFolder folder;
  const Volume mask = read_volume(
      folder.write("b.npy", npy("|b1", false, "2, 2, 2", std::string("\1\0\1\0\0\0\1\1", 8))));
  CHECK(mask.type() == SampleType::u8);
  CHECK(mask.sample(0, 0, 0) == 1);
  CHECK(mask.sample(1, 0, 0) == 0);
}

TEST_CASE("NRRD without directions: spacings, axis mins and maxs, centers; axes of size 1") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& fields) {
    return read_volume(folder.write("v.nrrd", "NRRD0001\r\ntype: uchar\r\nencoding: raw\r\n" +
                                                  fields + "\r\n\r\n" + std::string(24, 'x')));
  };
  const std::string three = "dimension: 3\r\nsizes: 2 3 4\r\n";
  CHECK(read(three + "spacings: 0.5 2 3").spacing() == Vec3{0.5, 2, 3});
  Volume volume = read(three + "axis mins: 0 10 20\r\naxis maxs: 1 14 32");
  CHECK(volume.spacing() == Vec3{1, 2, 4});
  CHECK(volume.frame().origin == Vec3{0, 10, 20});
  volume = read(three + "axis mins: 0 10 20\r\naxismaxs: 1 16 28\r\ncenters: cell cell cell");
  CHECK(volume.spacing() == Vec3{0.5, 2, 2});
  CHECK(volume.frame().origin == Vec3{0.25, 11, 21});
  volume = read("dimension: 4\r\nsizes: 2 1 3 4\r\nspacings: 5 nan 6 7");
  CHECK(volume.dims() == Index3{2, 3, 4});
  CHECK(volume.spacing() == Vec3{5, 6, 7});
  volume = read(
      "dimension: 4\r\nsizes: 1 2 3 4\r\nspace: LAS\r\nspace directions: none (0,2,0) (1,0,0) "
      "(0,0,3)");
  CHECK(volume.spacing() == Vec3{2, 1, 3});
  CHECK(volume.frame().axes[0] == Vec3{0, 1, 0});
  CHECK(volume.frame().left_handed());
  CHECK(read(three + "spacings: 1 1 1\r\nbyte skip: 0").sample(1, 2, 3) == 'x');
}

TEST_CASE("data files are found beside their header, in any folder") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("deep/er"));
  const Truth truth = random_truth(SampleType::u16, {4, 5, 6}, 9);
  folder.write("deep/er/v.data", truth.in_order(std::endian::little));
  const auto files = nrrd(truth, std::endian::little, "raw", NrrdForm::detached);
  CHECK(bytes_of_samples(read_volume(folder.write("deep/er/v.nhdr", files[0].content))) ==
        truth.bytes);
  std::string text = files[0].content;
  text.replace(text.rfind("v.data"), 6, "deep/er/v.data");
  CHECK(bytes_of_samples(read_volume(folder.write("v.nhdr", text))) == truth.bytes);
  text.replace(text.rfind("deep/er/v.data"), 14, folder.path("deep/er/v.data"));
  CHECK(bytes_of_samples(read_volume(folder.write("absolute.nhdr", text))) == truth.bytes);
}

TEST_CASE("VTK's nameless bytes are COLOR_SCALARS") {
  const TemporaryFolder folder;
  const Truth truth = random_truth(SampleType::u8, {4, 5, 6}, 9);
  std::string file = vtk(truth, true, false).front().content;
  const std::string usual = "SCALARS values unsigned_char 1\nLOOKUP_TABLE default\n";
  file.replace(file.find(usual), usual.size(), "COLOR_SCALARS scalars 1\n");
  CHECK(bytes_of_samples(read_volume(folder.write("v.vtk", file))) == truth.bytes);
  file.replace(file.find("BINARY"), 6, "ASCII");
  CHECK_THROWS_AS(read_volume(folder.write("v.vtk", file)), InputError);
}

TEST_CASE("standard input is recognized by its content") {
  const Truth truth = random_truth(SampleType::i16, {4, 5, 6}, 9);
  for (const StoredVolume& stored : all_forms(truth)) {
    if (stored.files.size() > 1) continue;
    const std::string& content = stored.files.front().content;
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    REQUIRE(::write(ends[1], content.data(), content.size()) ==
            static_cast<ssize_t>(content.size()));
    ::close(ends[1]);
    const int saved = ::dup(STDIN_FILENO);
    ::dup2(ends[0], STDIN_FILENO);
    ::close(ends[0]);
    CAPTURE(stored.label);
    CHECK(bytes_of_samples(read_volume("-", stored.options)) == truth.bytes);
    ::dup2(saved, STDIN_FILENO);
    ::close(saved);
  }
}

TEST_CASE("command-line spellings are parsed") {
  const Roi roi = parse_roi("0:64,3:10,5:7");
  CHECK(roi.begin == Index3{0, 3, 5});
  CHECK(roi.end == Index3{64, 10, 7});
  CHECK(parse_dims("256x256x128") == Index3{256, 256, 128});
  for (SampleType type : kAllTypes) CHECK(parse_sample_type(name_of(type)) == type);
  CHECK(parse_sample_type("unsigned short") == SampleType::u16);
  CHECK(parse_sample_type("unsigned_char") == SampleType::u8);
  for (const char* text : {"", "0:64", "0:64,0:64", "0:64,0:64,0:64,0:64", "5:5,0:2,0:2",
                           "a:b,0:2,0:2", "-1:5,0:2,0:2", "0:99999999999,0:2,0:2", "0:2:3,0:2,0:2"})
    CHECK_THROWS_AS(parse_roi(text), InputError);
  for (const char* text : {"", "256", "256x256", "1x2x3x4", "ax2x3", "-1x2x3", "1x2x99999999999"})
    CHECK_THROWS_AS(parse_dims(text), InputError);
  for (const char* text : {"", "int128", "uint128", "complex", "uint8 x"})
    CHECK_THROWS_AS(parse_sample_type(text), InputError);
}
