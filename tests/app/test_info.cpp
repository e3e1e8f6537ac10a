// SPDX-License-Identifier: MIT
// What the info command says of an input that holds several volumes.
#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "app/json_schema.h"
#include "app/option_texts.h"
#include "app/parsed_line.h"
#include "app/run.h"
#include "base/text.h"
#include "io/files/temporary_folder.h"
#include "io/volume/volume_files.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// Returns what the info command prints.
std::string info_of(const TemporaryFolder& folder, const std::string& arguments) {
  const std::string file = folder / "stdout";
  std::fflush(stdout);
  const int kept = dup(STDOUT_FILENO);
  REQUIRE(std::freopen(file.c_str(), "w", stdout) != nullptr);
  int status = -1;
  try {
    status = run_info(parsed("info " + arguments));
  } catch (const InputError&) {
    status = 2;
  }
  std::fflush(stdout);
  dup2(kept, STDOUT_FILENO);
  close(kept);
  return text("exit ", status, "\n", file_bytes(file));
}

void write_slices(const TemporaryFolder& folder, int series, int slices) {
  const Truth truth = random_truth(SampleType::u8, {4, 3, 5}, 3);
  std::filesystem::create_directories(folder / "disk");
  for (int k = 0; k < slices; ++k) {
    DicomElements elements = dicom_image(truth, {}, k, 1);
    elements[0x0020000e] = {"UI", text("1.2.", series)};
    elements[0x0008103e] = {"LO", text("Scan ", series)};
    elements[0x00200011] = {"IS", text(series)};
    folder.write(text("disk/", series, "-", k), dicom_file({}, elements));
  }
}

}  // namespace

// The error message had five of them, and its middle was cut.
TEST_CASE("info lists the series of a folder, each in a line") {
  const TemporaryFolder folder;
  for (int series = 1; series <= 11; ++series) write_slices(folder, series, series == 3 ? 1 : 3);
  const std::string disk = folder / "disk", list = info_of(folder, disk);
  CHECK(list.starts_with("exit 0\n" + disk +
                         ": 11 series; --series N takes one\n"
                         "  1  'Scan 1', 3 images of 4 x 3 ('1-0')\n"));
  CHECK(
      list.ends_with("\n 10  'Scan 11', 3 images of 4 x 3 ('11-0')\n"
                     " 11  'Scan 3', 1 image of 4 x 3 ('3-0')\n"));
  CHECK(info_of(folder, disk + " --series 10").find("4 x 3 x 3 uint8") != std::string::npos);
  const std::string file = folder / "r.json";
  CHECK(info_of(folder, disk + " -q --json " + file) == "exit 0\n");
  const JsonValue report = parse_json(file_bytes(file), file);
  CHECK(Validator(parse_json(report_schema(), "schema")).fault(report) == "");
  REQUIRE(report["series"].items.size() == 11);
  const JsonValue& last = report["series"].items.back();
  CHECK(last["description"].string == "Scan 3");
  CHECK(last["images"].number == 1);
  CHECK(report["diagnostics"].items.at(0)["values"]["series"].number == 11);
  const std::string slice = disk + "/1-0", bytes = file_bytes(slice);
  CHECK(info_of(folder, disk + " --json " + slice) == "exit 2\n");
  CHECK(file_bytes(slice) == bytes);
  // A picture is of one volume.
  CHECK(info_of(folder, disk + " -o " + (folder / "r.png")) == "exit 2\n");
  CHECK(info_of(folder, disk + " --series 12") == "exit 2\n");
}

TEST_CASE("info shows the first volume of several, and says so") {
  const TemporaryFolder folder;
  Truth truth = random_truth(SampleType::i16, {4, 3, 5}, 3);
  truth.times = 3;
  for (const std::uint64_t seed : {4, 5}) {
    truth.bytes += random_truth(SampleType::i16, truth.dims, seed).bytes;
  }
  const std::string file = folder.write("v.nii", nifti(truth, {})[0].content);
  const std::string found = info_of(folder, file);
  CHECK(found.starts_with("exit 0\n"));
  CHECK(found.find("has 3 times: --time N chooses one, counted from 1; this is the first\n") !=
        std::string::npos);
  CHECK(info_of(folder, file + " --time 2").find("this is the first") == std::string::npos);
  const std::string report = folder / "r.json";
  CHECK(info_of(folder, file + " -q --json " + report) == "exit 0\n");
  const JsonValue told = parse_json(file_bytes(report), report)["diagnostics"].items.at(0);
  CHECK(told["code"].string == "first-of-several");
  CHECK(told["file"].string == file);
  CHECK(told["values"]["times"].number == 3);
}
