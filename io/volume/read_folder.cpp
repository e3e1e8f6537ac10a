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

// Returns the files of a folder, and of its subfolders if wanted.
std::vector<std::string> files_in(const std::string& folder, bool with_subfolders) {
  namespace fs = std::filesystem;
  std::vector<std::string> paths, folders{folder};
  while (!folders.empty()) {
    const std::string here = std::move(folders.back());
    folders.pop_back();
    std::error_code fault, ignored;
    for (fs::directory_iterator entry(here, fault); !fault && entry != fs::directory_iterator();
         entry.increment(fault)) {
      if (entry->is_regular_file(ignored)) {
        paths.push_back(entry->path().string());
      } else if (with_subfolders && entry->is_directory(ignored) && !entry->is_symlink(ignored)) {
        folders.push_back(entry->path().string());
      }
    }
    // A subfolder without rights, or one that vanished meanwhile, is passed over.
    if (fault && here == folder) fail(folder, "cannot list the folder: ", fault.message());
  }
  std::ranges::sort(paths);
  return paths;
}

struct Images {
  std::vector<DicomFile> dicom{};
  std::vector<Bytes> tiff{};
  std::vector<std::string> others{}, unreadable{};
  std::string fault{};  // of the first that is unreadable
};

Images images_of(const std::vector<std::string>& paths, bool (*is_dicom)(const Bytes&)) {
  Images images;
  for (const std::string& path : paths) {
    Bytes bytes;
    std::optional<DicomFile> slice;
    try {
      bytes = open_file(path, NamedBy::file);
      if (is_dicom(bytes)) slice = parse_dicom(bytes);
    } catch (const InputError& error) {
      if (images.unreadable.empty()) images.fault = error.what();
      images.unreadable.push_back(path);
      continue;
    }
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
  const auto first_of = [](const std::vector<std::string>& paths) {
    const std::size_t more = paths.size() - 1;
    return text("'", std::filesystem::path(paths[0]).filename().string(), "'",
                more > 0 ? text(" and ", more, " more") : "");
  };
  Images found = images_of(files_in(input.name(), false), looks_like_dicom);
  const bool has_slices = !found.dicom.empty() || !found.tiff.empty();
  if (!has_slices) {
    // Files of any kind may be in subfolders, so those without a preamble are not tried.
    refuse_zarr(input.name());
    found = images_of(files_in(input.name(), true), has_dicom_preamble);
  }
  auto& [dicom, tiff, others, unreadable, fault] = found;
  if (!unreadable.empty()) {
    if (has_slices) throw InputError(fault);  // it may be one of them
    input.warn("files-unreadable", "cannot read ", first_of(unreadable), ": passed over");
  }
  if (!has_slices && dicom.empty()) {
    refuse_folder(input.name(), unreadable.empty() ? "" : "; cannot read " + first_of(unreadable));
  }
  if (!dicom.empty()) {
    for (const Bytes& bytes : tiff) others.push_back(bytes.name);
  }
  if (!others.empty()) {
    input.note("files-passed-over", "passed over ", first_of(others), ": no ",
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
