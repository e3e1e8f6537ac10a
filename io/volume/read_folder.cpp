// SPDX-License-Identifier: MIT
// A folder is a volume if its files are slices: DICOM, else TIFF files of one page each. Without
// slices of its own it is one if those of its subfolders are, in DICOM.
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
#include "io/volume/several_volumes.h"
#include "io/volume/volume_formats.h"

namespace deliso {
namespace {

// Returns the files of a folder, and of its subfolders with a recursive Iterator.
template <class Iterator>
std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code fault;
  // Folders without rights are passed over, but for this one.
  const std::filesystem::directory_iterator readable(folder, fault);
  Iterator entry;
  if (!fault) {
    entry = Iterator(folder, std::filesystem::directory_options::skip_permission_denied, fault);
  }
  for (; !fault && entry != Iterator(); entry.increment(fault)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored)) paths.push_back(entry->path().string());
  }
  if (fault == std::errc::no_such_file_or_directory) fail(folder, "changed while it was listed");
  if (fault) fail(folder, "cannot list the folder: ", fault.message());
  std::ranges::sort(paths);
  return paths;
}

struct Images {
  std::vector<DicomFile> dicom{};
  std::vector<Bytes> tiff{};
  std::vector<std::string> others{};
};

Images images_of(const std::vector<std::string>& paths, bool (*is_dicom)(const Bytes&)) {
  Images images;
  for (const std::string& path : paths) {
    const Bytes bytes = open_file(path, NamedBy::file);
    std::optional<DicomFile> slice;
    if (is_dicom(bytes)) slice = parse_dicom(bytes);
    if (slice) {
      images.dicom.push_back(std::move(*slice));
    } else if (looks_like_tiff(bytes)) {
      images.tiff.push_back(bytes);
    } else {
      images.others.push_back(path);
    }
  }
  return images;
}

}  // namespace

Volume read_folder(const VolumeInput& input) {
  namespace fs = std::filesystem;
  auto [dicom, tiff, others] =
      images_of(files_in<fs::directory_iterator>(input.name()), looks_like_dicom);
  if (dicom.empty() && tiff.empty()) {
    // Files of any kind may be in subfolders, so those without a preamble are not tried.
    refuse_zarr(input.name());
    Images nested =
        images_of(files_in<fs::recursive_directory_iterator>(input.name()), has_dicom_preamble);
    if (nested.dicom.empty()) refuse_folder(input.name());
    dicom = std::move(nested.dicom);
    tiff = std::move(nested.tiff);
    others = std::move(nested.others);
  }
  if (!dicom.empty()) {
    for (const Bytes& bytes : tiff) others.push_back(bytes.name);
  }
  if (!others.empty()) {
    const std::string first = std::filesystem::path(others[0]).filename().string();
    const std::size_t more = others.size() - 1;
    input.note("files-passed-over", "passed over '", first,
               more > 0 ? text("' and ", more, " more") : "'", ": no ",
               dicom.empty() ? "TIFF" : "DICOM", " images");
  }
  if (dicom.empty()) {
    refuse_series(input.name(), input.options);
    choose_volume(input.name(), input.options, {});
    return read_tiff_slices(input, std::move(tiff));
  }
  note_place(input);
  for (const DicomFile& file : dicom) input.log.files.push_back(state_of(file.name()));
  return read_dicom_series(input, std::move(dicom));
}

}  // namespace deliso
