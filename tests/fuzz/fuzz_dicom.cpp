// SPDX-License-Identifier: MIT
// A file of several frames; or, with kDetached between them, the slices of a folder.
#include <algorithm>

#include "fuzz/reader_target.h"
#include "io/volume/dicom_file.h"

namespace {

// True if the samples would take long: a byte of JPEG-LS may stand for 2^18 of them.
bool is_vast(std::string_view file) {
  try {
    const auto dicom = deliso::parse_dicom({"v.dcm", std::as_bytes(std::span(file)), nullptr});
    return dicom && dicom->fault.empty() &&
           static_cast<std::size_t>(dicom->frame_count) > (1u << 22) / dicom->frame_size();
  } catch (const deliso::InputError&) {
    return false;
  }
}

// Reads the path as it is, and with all that may be given in place of what files lack.
void read_both_ways(const std::string& path) {
  for (const bool is_given : {false, true}) {
    deliso::ReadOptions options;
    if (is_given) {
      options.spacing = deliso::Vec3{1, 2, 3};
      options.series = 1;
      options.time = 2;
    }
    try {
      deliso::fuzz::check(read_volume(path, options));
    } catch (const deliso::InputError& error) {
      deliso::fuzz::check(error);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace deliso;
  using namespace deliso::fuzz;
  constexpr std::size_t kMostFiles = 16;
  std::string_view rest(reinterpret_cast<const char*>(bytes), size);
  std::vector<std::string_view> files;
  while (!rest.empty() && files.size() < kMostFiles) {
    const std::size_t cut = std::min(rest.find(kDetached), rest.size());
    files.push_back(rest.substr(0, cut));
    rest.remove_prefix(std::min(cut + kDetached.size(), rest.size()));
  }
  if (std::ranges::any_of(files, is_vast)) return 0;
  if (files.size() == 1) {
    run_reader(bytes, size, "v.dcm", "v.data", read_dicom);
    return 0;
  }
  const std::string series = folder() + "series";
  std::filesystem::remove_all(series);
  std::filesystem::create_directories(series);
  for (std::size_t n = 0; n < files.size(); ++n) {
    std::ofstream(series + "/" + std::to_string(n), std::ios::binary) << files[n];
  }
  read_both_ways(series);
  return 0;
}
