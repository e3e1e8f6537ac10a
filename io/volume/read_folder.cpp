// SPDX-License-Identifier: MIT
// A folder is a volume if its files are slices: a DICOM series, else TIFF files of one page each.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/text.h"
#include "io/volume/dicom_file.h"
#include "io/volume/foreign_formats.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code fault;
  std::filesystem::directory_iterator entry(folder, fault);
  for (; !fault && entry != std::filesystem::directory_iterator(); entry.increment(fault)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored)) paths.push_back(entry->path().string());
  }
  if (fault) fail(folder, "cannot list the folder: " + fault.message());
  std::ranges::sort(paths);
  return paths;
}

}  // namespace

Volume read_folder(const VolumeInput& input) {
  std::vector<DicomFile> dicom;
  std::vector<Bytes> tiff;
  std::vector<std::string> others;
  for (const std::string& path : files_in(input.name())) {
    const Bytes bytes = open_file(path, NamedBy::file);
    std::optional<DicomFile> slice;
    if (looks_like_dicom(bytes)) slice = parse_dicom(bytes);
    if (slice) {
      input.log.files.push_back(path);
      dicom.push_back(std::move(*slice));
    } else if (looks_like_tiff(bytes)) {
      tiff.push_back(bytes);
    } else {
      others.push_back(path);
    }
  }
  if (dicom.empty() && tiff.empty()) refuse_folder(input.name());
  if (!dicom.empty()) {
    for (const Bytes& bytes : tiff) others.push_back(bytes.name);
  }
  if (!others.empty()) {
    const std::string first = std::filesystem::path(others[0]).filename().string();
    const std::size_t more = others.size() - 1;
    input.note(text("passed over '", first, more > 0 ? text("' and ", more, " more") : "'", ": no ",
                    dicom.empty() ? "TIFF" : "DICOM", " images"));
  }
  if (dicom.empty()) return read_tiff_slices(input, std::move(tiff));
  refuse_spacing(input.name(), input.options);
  return read_dicom_slices(input, dicom);
}

}  // namespace deliso
