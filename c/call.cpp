// SPDX-License-Identifier: MIT
#include "c/call.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <string_view>

#include "app/peak_memory.h"
#include "app/text.h"
#include "base/text.h"
#include "c/normals.h"

namespace deliso::c {
namespace {

constexpr std::size_t kErrorSize = 1024;  // an InputError has some 500 bytes at most
thread_local char last_error[kErrorSize];

}  // namespace

deliso_status failed(deliso_status status, const char* message) noexcept {
  std::snprintf(last_error, kErrorSize, "%s", message);
  return status;
}

void require(const void* pointer, const char* name) {
  if (!pointer) throw InputError(text(name, " is null"));
}

SampleGrid grid_of(int type, const size_t shape[3], int order, const double spacing[3],
                   const double origin[3]) {
  require(shape, "shape");
  if (type < DELISO_UINT8 || type > DELISO_FLOAT64) throw InputError("no such type of samples");
  if (order != DELISO_C_ORDER && order != DELISO_FORTRAN_ORDER) throw InputError("no such order");
  const bool is_fortran = order == DELISO_FORTRAN_ORDER;
  SampleGrid grid;
  grid.name = kName;
  grid.type = static_cast<SampleType>(type);
  for (std::size_t n = 0; n < 3; ++n) {
    grid.dims[n] = static_cast<std::int64_t>(shape[is_fortran ? n : 2 - n]);
  }
  if (spacing) grid.set_spacing({spacing[0], spacing[1], spacing[2]});
  if (is_fortran) std::swap(grid.steps[0], grid.steps[2]);
  if (origin) grid.origin = {origin[0], origin[1], origin[2]};
  return grid;
}

CommandLine parse(std::vector<std::string> words, const char* const* options) {
  constexpr std::string_view kOfFiles[] = {
      "iso",     "output",    "format",     "json",   "quiet",   "verbose", "roi",    "part",
      "type",    "array",     "dims",       "skip",   "spacing", "endian",  "volume", "help",
      "version", "ply-ascii", "attributes", "origin", "channel", "time"};
  for (; options && *options; ++options) {
    const std::string_view option = *options, name = option.substr(0, option.find('='));
    if (std::ranges::find(kOfFiles, name) != std::end(kOfFiles)) {
      throw InputError(text("--", name, " has no meaning for an array"));
    }
    words.push_back(text("--", option));
  }
  CommandLine line = parse_command_line(std::vector<std::string_view>(words.begin(), words.end()));
  if (!line.field.segments.empty()) throw InputError("an array does not name its labels");
  return line;
}

CommandLine parse(std::vector<std::string> words, double isovalue, const char* const* options) {
  bool of_labels = false;
  for (auto at = options; at && *at; ++at) of_labels |= std::string_view(*at).starts_with("label=");
  if (!of_labels || !std::isnan(isovalue)) words.push_back("--iso=" + number_text(isovalue));
  CommandLine line = parse(std::move(words), options);
  if (line.field.all_labels) throw InputError("--label all has no meaning for an array");
  return line;
}

void take(const TriMesh& surface, const VolumeSource& field, MeshRun& run, double seconds,
          deliso_mesh& made) {
  made.normals = normals_of(surface, field, run.line.options);
  made.mesh = written_mesh(surface, {.format = MeshFormat::ply});
  made.write = write_options(run, surface);
  run.peak_bytes = peak_memory_bytes();
  run.seconds_total = seconds;
  made.report = report_json(run);
}

char* copied(const std::string& text) {
  auto* const copy = static_cast<char*>(std::malloc(text.size() + 1));
  if (!copy) throw std::bad_alloc();
  std::memcpy(copy, text.c_str(), text.size() + 1);
  return copy;
}

}  // namespace deliso::c

const char* deliso_last_error() {
  return deliso::c::last_error;
}
