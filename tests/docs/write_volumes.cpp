// SPDX-License-Identifier: MIT
// Writes a built-in field of bytes under every name given, in the format that the name's ending
// asks for: the volumes that pages name. Usage: write_volumes FIELD FILE...
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "io/volume/builtin_volume.h"
#include "io/volume/volume_files.h"

using namespace deliso;

namespace {

// The first file is the one that was asked for; another, its data, keeps the name that it is
// referred to by. All volumes are the same, so they may share it.
std::vector<test::NamedFile> files_of(const test::Truth& truth, std::string_view name) {
  const auto little = std::endian::little;
  if (name.ends_with(".nrrd")) return test::nrrd(truth, little, "raw", test::NrrdForm::attached);
  if (name.ends_with(".nhdr")) return test::nrrd(truth, little, "raw", test::NrrdForm::detached);
  if (name.ends_with(".mha")) return test::metaimage(truth, little, "raw", test::MetaForm::local);
  if (name.ends_with(".mhd"))
    return test::metaimage(truth, little, "raw", test::MetaForm::detached);
  if (name.ends_with(".nii")) return test::nifti(truth, {});
  if (name.ends_with(".nii.gz")) {
    test::NiftiForm form;
    form.compressed = true;
    return test::nifti(truth, form);
  }
  if (name.ends_with(".vtk")) return test::vtk(truth, true, false);
  if (name.ends_with(".vti")) return test::vti(truth, {});
  if (name.ends_with(".raw")) return {{"", truth.bytes}};
  throw InputError(text(name, ": no format is known by this ending"));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  try {
    const Volume field = make_builtin_volume(argv[1]);
    test::Truth truth{field.dims(), SampleType::u8};
    field.visit([&](const auto* samples) {
      for (std::size_t n = 0; n < field.sample_count(); ++n) {
        truth.bytes += static_cast<char>(static_cast<unsigned char>(samples[n]));
      }
    });
    for (int n = 2; n < argc; ++n) {
      const std::filesystem::path asked = argv[n];
      auto files = files_of(truth, argv[n]);
      files[0].name = asked.filename();
      for (const auto& file : files) {
        std::ofstream(asked.parent_path() / file.name, std::ios::binary) << file.content;
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_volumes: %s\n", error.what());
    return 2;
  }
  return 0;
}
