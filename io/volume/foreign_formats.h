// SPDX-License-Identifier: MIT
// Common volume formats that are not read here. Their messages name the format and a way to convert
// it.
#pragma once

#include <string>
#include <string_view>

#include "io/files/input_file.h"

namespace deliso {

// Throw an InputError: for a file in an unknown format, and for a folder.
[[noreturn]] void refuse_file(const Bytes& bytes);
void refuse_zarr(const std::string& path);  // only if it is Zarr
[[noreturn]] void refuse_folder(const std::string& path, const std::string& also = "");

// Throws an InputError, for an image of VTK whose samples are of its cells.
[[noreturn]] void refuse_cells(const std::string& name, std::string_view reader);

// Returns "convert it with ...": by VTK's class `reader` and, if given, the class `filter` with its
// settings.
std::string conversion_by_vtk(std::string_view reader, std::string_view filter = "");
inline constexpr const char* kVtkReader = "vtkGenericDataObjectReader";
inline constexpr const char* kVtkXmlReader = "vtkXMLGenericDataObjectReader";
inline constexpr const char* kVtkResample =
    "vtkResampleToImage(); f.SetSamplingDimensions(NX, NY, NZ)";

}  // namespace deliso
