// SPDX-License-Identifier: MIT
// VTK's files may hold several arrays: which one is read, and how the others are passed over.
#include <doctest/doctest.h>

#include <string>

#include "base/check.h"
#include "io/volume/read_volume.h"
#include "read_fault.h"
#include "volume_files.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr Index3 kDims{2, 3, 4};
constexpr int kPoints = 24;

struct Outcome {
  std::string error;
  double first = 0, last = 0;
  ReadLog log;
};

Outcome read(const TemporaryFolder& folder, const std::string& file, const std::string& content,
             const std::optional<std::string>& array) {
  folder.write(file, content);
  ReadOptions options;
  options.array = array;
  Outcome out;
  try {
    const Volume volume = read_volume(folder.path(file), options, &out.log);
    REQUIRE(volume.dims() == kDims);
    out.first = volume.sample(0, 0, 0);
    out.last = volume.sample(1, 2, 3);
  } catch (const InputError& error) {
    out.error = error.what();
    out.error.erase(0, out.error.find(file));
  }
  return out;
}

std::string vti_of_three() {
  std::string file =
      "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 1 0 2 0 3\"><Piece>"
      "<PointData>";
  int from = 0;
  for (const char* tag :
       {"type=\"Float32\" Name=\"velocity\" NumberOfComponents=\"3\"",
        "type=\"Int16\" Name=\"density\"", "type=\"Float64\" Name=\"pressure\""}) {
    file += std::string("<DataArray ") + tag + " format=\"ascii\">" +
            vtk_values(false, from == 0 ? 3 * kPoints : kPoints, 0, from) + "</DataArray>";
    from += 100;
  }
  return file +
         "</PointData><CellData><DataArray type=\"Int8\" Name=\"of_cells\"/></CellData>"
         "</Piece></ImageData></VTKFile>";
}

}  // namespace

TEST_CASE("the named array is read, at any place in the file") {
  const TemporaryFolder folder;
  for (const bool binary : {false, true}) {
    CAPTURE(binary);
    for (const std::string end :
         {"", "METADATA", "garbage 12", "SCALARS", "FIELD x 3\na 1 1 int\n"}) {
      const std::string file = vtk_of_many(binary, end);
      const Outcome density = read(folder, "v.vtk", file, "density");
      CHECK(density.error == "");
      CHECK(density.first == 10);
      CHECK(density.last == 33);
      const Outcome pressure = read(folder, "v.vtk", file, "pressure");
      CHECK(pressure.first == 1000);
      CHECK(pressure.last == 1023);
      CHECK(pressure.log.notes.empty());
    }
  }
  const Outcome pressure = read(folder, "v.vti", vti_of_three(), "pressure");
  CHECK(pressure.first == 200);
  CHECK(pressure.last == 223);
  CHECK(pressure.log.notes.empty());
}

// --spacing was no remedy.
TEST_CASE("a VTI whose spacing is none is read by a spacing that is given") {
  const TemporaryFolder folder;
  for (const char* spacing : {"1 1", "inf 1 1", "x", "0 0 0"}) {
    CAPTURE(spacing);
    std::string file = vti_of_three();
    const std::size_t at = file.find("<ImageData") + 10;
    file.insert(at, std::string(" Spacing=\"") + spacing + "\"");
    const std::string path = folder.write("v.vti", file);
    const std::string fault = spacing[0] == '0'   ? "spacing along x is not positive: "
                              : spacing[0] == 'i' ? "spacing along x is infinite: "
                                                  : text("attribute Spacing is '", spacing, "', ");
    CHECK(read_message(path).starts_with("v.vti: " + fault));
    ReadOptions options;
    options.spacing = Vec3{2, 3, 4};
    const Volume volume = read_volume(path, options);
    CHECK(volume.spacing() == Vec3{2, 3, 4});
    CHECK(volume.frame().origin == Vec3{0, 0, 0});
  }
}

TEST_CASE("without a name the first array that can be meshed is read and logged") {
  const TemporaryFolder folder;
  for (const bool binary : {false, true}) {
    const Outcome first = read(folder, "v.vtk", vtk_of_many(binary), std::nullopt);
    CHECK(first.first == 10);
    REQUIRE(first.log.notes.size() == 1);
    CHECK(first.log.notes[0].words.ends_with(
        "array 'density' is read, one of 8; --array names another"));
    std::string names;
    for (const NamedArray& array : first.log.arrays)
      names += array.name + " " + array.type + " " + to_text(array.components) +
               (array.read ? " read\n" : "\n");
    CHECK(names ==
          "velocity float32 3\nnormals float64 3\nstress float32 9\nuv float32 2\n"
          "wide uint16 2\nids int64 1\ndensity uint8 1 read\npressure int32 1\n");
  }
  const Outcome first = read(folder, "v.vti", vti_of_three(), std::nullopt);
  CHECK(first.first == 100);
  CHECK(first.log.arrays.size() == 3);
  REQUIRE(first.log.notes.size() == 1);
  CHECK(first.log.notes[0].words.ends_with(
      "array 'density' is read, one of 3; --array names another"));
}

TEST_CASE("unknown names, arrays that cannot be meshed and formats without names are refused") {
  const TemporaryFolder folder;
  for (const bool binary : {false, true}) {
    const auto error = [&](const std::string& name) {
      return read(folder, "v.vtk", vtk_of_many(binary), name).error;
    };
    CHECK(error("Density") ==
          "v.vtk: has no array 'Density', but 'velocity', 'normals', 'stress', 'uv', 'wide', "
          "'ids', 'density', 'pressure'");
    CHECK(error("ids").empty());
    CHECK(error("of_cells").starts_with("v.vtk: has no array 'of_cells', but"));
    CHECK(error("wide") ==
          "v.vtk: array 'wide' has 2 components per point: only scalar volumes can be meshed; "
          "--array takes 'ids', 'density', 'pressure'");
    const std::string whole = vtk_of_many(binary);
    const std::string cut = whole.substr(0, whole.find("NORMALS") + 100);
    CHECK(read(folder, "v.vtk", cut, "density").error == "v.vtk: ends within its array 'normals'");
  }
  CHECK(read(folder, "v.vti", vti_of_three(), "none").error ==
        "v.vti: has no array 'none', but 'velocity', 'density', 'pressure'");
  const Truth truth = random_truth(SampleType::u8, kDims, 1);
  for (const StoredVolume& stored : all_forms(truth)) {
    if (stored.label.starts_with("vt")) continue;
    ReadOptions options = stored.options;
    options.array = "values";
    CHECK(read_fault(stored.write(folder), options) ==
          "has no named arrays to take 'values' of, as VTK files have");
  }
}
