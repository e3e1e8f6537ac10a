// SPDX-License-Identifier: MIT
// A file of several frames; or, behind kDetached, a second slice of a folder.
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace deliso;
  using namespace deliso::fuzz;
  const std::string_view all(reinterpret_cast<const char*>(bytes), size);
  const std::size_t cut = all.find(kDetached);
  if (is_vast(all.substr(0, cut))) return 0;
  if (cut == std::string_view::npos) {
    run_reader(bytes, size, "v.dcm", "v.data", read_dicom);
    return 0;
  }
  if (is_vast(all.substr(cut + kDetached.size()))) return 0;
  const std::string series = folder() + "series";
  std::filesystem::create_directories(series);
  std::ofstream(series + "/1", std::ios::binary) << all.substr(0, cut);
  std::ofstream(series + "/2", std::ios::binary) << all.substr(cut + kDetached.size());
  try {
    check(read_volume(series));
  } catch (const InputError& error) {
    check(error);
  }
  return 0;
}
