// SPDX-License-Identifier: MIT
// VTK's XML formats for images and rectilinear grids ("VTK File Formats", XML formats; ImageData or
// RectilinearGrid with one piece). io/files/vtk_xml.h has the markup and the arrays.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/text.h"
#include "io/files/text_scan.h"
#include "io/files/vtk_xml.h"
#include "io/volume/foreign_formats.h"
#include "io/volume/named_arrays.h"
#include "io/volume/sample_grid.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

constexpr std::string_view kRectilinear = "RectilinearGrid", kCoordinates = "Coordinates";

class VtiParser {
 public:
  // `kind`: of the data set, which the file names.
  VtiParser(const VolumeInput& input, std::string_view kind)
      : input_(input),
        grid_(grid_of(input)),
        kind_(kind),
        xml_(input.bytes, kind, "can be meshed") {}

  Volume run() {
    grid_.byte_order = xml_.byte_order();
    const XmlTag array = read_structure();
    const std::uint64_t size = data_size(grid_);
    if (kind_ == kRectilinear) read_coordinates();
    if (xml_.is_text(array)) return volume_from_text(grid_, xml_.inside(array), false);
    return volume_from_raw(grid_, xml_.binary(array, size, describe(grid_)));
  }

 private:
  std::vector<double> numbers(const XmlTag& tag, const char* name, std::size_t count) const {
    const std::string_view words = tag.attribute(name).value_or("");
    const std::optional<std::vector<double>> values = to_doubles(words);
    if (!values || values->size() != count)
      fail(input_.name(), "attribute ", name, " is ", quote(words), ", not ", count, " numbers");
    return *values;
  }

  void read_image(const XmlTag& tag) {
    if (const auto words = tag.attribute("Spacing")) {
      // Where the options give a spacing, the file's may be anything.
      const auto own = to_doubles(*words);
      const auto is_finite = [](double x) { return std::isfinite(x); };
      const bool is_bad = !own || own->size() != 3 || !std::ranges::all_of(*own, is_finite);
      const std::vector<double> s =
          input_.options.spacing && is_bad ? std::vector<double>(3) : numbers(tag, "Spacing", 3);
      grid_.set_spacing({s[0], s[1], s[2]});
    }
    if (tag.attribute("Origin")) {
      const std::vector<double> o = numbers(tag, "Origin", 3);
      grid_.origin = {o[0], o[1], o[2]};
    }
    if (tag.attribute("Direction")) {  // row by row; the axes are its columns
      const std::vector<double> d = numbers(tag, "Direction", 9);
      for (std::size_t a = 0; a < 3; ++a)
        grid_.steps[a] = grid_.steps[a][static_cast<int>(a)] * Vec3{d[a], d[a + 3], d[a + 6]};
    }
  }

  // Extents are the first and last index along each axis; index (0,0,0) lies at the origin.
  void read_extent(const XmlTag& tag, const char* name) {
    const std::string_view words = tag.attribute(name).value_or("");
    const std::optional<std::vector<std::int64_t>> e = to_ints(words);
    constexpr std::int64_t limit = std::int64_t{1} << 40;
    bool valid = e && e->size() == 6;
    for (std::size_t n = 0; valid && n < 6; ++n) valid = (*e)[n] > -limit && (*e)[n] < limit;
    if (!valid) fail(input_.name(), name, " is ", quote(words), ", not six integers");
    for (std::size_t a = 0; a < 3; ++a) {
      grid_.dims[a] = (*e)[2 * a + 1] - (*e)[2 * a] + 1;
      start_[a] = static_cast<double>((*e)[2 * a]);
    }
  }

  // Reads the places of samples along each axis.
  void read_coordinates() {
    if (coordinates_.size() != 3) {
      fail(input_.name(), "has ", coordinates_.size(), " arrays of coordinates, not three");
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      xml_.for_each<double>(coordinates_[axis], static_cast<std::uint64_t>(grid_.dims[axis]),
                            text("the coordinates along ", "xyz"[axis]),
                            [&](double x) { values.push_back(x); });
      grid_.set_coordinates(axis, values);
    }
  }

  // Reads the markup: the image, its piece, its arrays. Returns the array to read.
  XmlTag read_structure() {
    std::string_view active;  // the array that PointData names
    std::vector<XmlTag> tags;
    std::vector<NamedArray> arrays;
    std::string_view section;  // PointData, CellData, FieldData
    bool has_cells = false;
    int pieces = 0;
    for (XmlTag tag = xml_.next(); !tag.name.empty(); tag = xml_.next()) {
      if (tag.name == kind_) {
        if (kind_ != kRectilinear) read_image(tag);
        read_extent(tag, "WholeExtent");
      } else if (tag.name == "Piece") {
        if (++pieces > 1)
          fail(input_.name(), "has several pieces: ", conversion_by_vtk(kVtkXmlReader));
        if (tag.attribute("Extent")) read_extent(tag, "Extent");
      } else if ((tag.name.ends_with("Data") && !tag.name.starts_with('/')) ||
                 tag.name == kCoordinates) {
        section = tag.name;
        if (section == "PointData") active = tag.attribute("Scalars").value_or("");
      } else if (tag.name == "DataArray" && section == kCoordinates) {
        coordinates_.push_back(tag);
      } else if (tag.name == "DataArray" && section == "CellData") {
        has_cells = true;
      } else if (tag.name == "DataArray" && section == "PointData") {
        tags.push_back(tag);
        arrays.push_back({std::string(tag.attribute("Name").value_or("")),
                          std::string(tag.attribute("type").value_or("")),
                          xml_.count(tag, "NumberOfComponents", 1)});
      }
    }
    for (std::size_t a = 0; a < 3 && kind_ != kRectilinear; ++a) {
      grid_.origin = grid_.origin + start_[a] * grid_.steps[a];
    }
    if (arrays.empty() && has_cells) refuse_cells(input_.name(), kVtkXmlReader);
    const std::size_t chosen = choose_array(input_, std::move(arrays), active);
    grid_.type = supported_type(input_, tags[chosen].attribute("type").value_or(""));
    return tags[chosen];
  }

  const VolumeInput& input_;
  SampleGrid grid_;
  std::string_view kind_;
  VtkXml xml_;
  std::array<double, 3> start_{};  // the first sample's index
  std::vector<XmlTag> coordinates_;
};

}  // namespace

bool looks_like_vti(const Bytes& bytes) {
  return looks_like_vtk_xml(bytes.text());
}

Volume read_vti(const VolumeInput& input) {
  const XmlTag file = next_tag(input.bytes.text(), 0);
  const std::string_view type = file.attribute("type").value_or("");
  const std::string_view compressor = file.attribute("compressor").value_or("");
  if (type == "PImageData" || type == "PRectilinearGrid") {
    fail(input.name(), "lists pieces: ", conversion_by_vtk(kVtkXmlReader));
  }
  if (type.ends_with("Grid") && type != kRectilinear) {
    fail(input.name(), "is a VTK file of type ", quote(type), ": ",
         conversion_by_vtk(kVtkXmlReader, kVtkResample));
  }
  if ((type == "ImageData" || type == kRectilinear) && !compressor.empty() &&
      compressor != "vtkZLibDataCompressor") {
    fail(input.name(), "is compressed by ", quote(compressor), ": ",
         conversion_by_vtk(kVtkXmlReader));
  }
  return VtiParser(input, type == kRectilinear ? kRectilinear : "ImageData").run();
}

}  // namespace deliso
