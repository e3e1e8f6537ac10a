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

#include "app/input.h"
#include "app/option_table.h"
#include "app/report_writer.h"
#include "app/text.h"
#include "base/text.h"
#include "c/normals.h"
#include "io/files/text_scan.h"

namespace deliso::c {
namespace {

constexpr std::size_t kErrorSize = 1024;  // an InputError has some 500 bytes at most
thread_local char last_error[kErrorSize];
thread_local Diagnostics last_notes;
thread_local std::string last_notes_text;
constexpr double kUnitLength = 1e-4;  // a direction's deviation from length 1

}  // namespace

deliso_status failed(deliso_status status, const char* message, const char* more) noexcept {
  std::snprintf(last_error, kErrorSize, "%s%s", message, more);
  return status;
}

void tell(Diagnostics notes) {
  last_notes = std::move(notes);
}

void require(const void* pointer, const char* name) {
  if (!pointer) throw InputError(name, " is null");
}

AnatomicalSpace space_of(const char* name) {
  const std::string_view wanted = name ? name : "";
  for (const AnatomicalSpace space :
       {AnatomicalSpace::unknown, AnatomicalSpace::ras, AnatomicalSpace::lps}) {
    if (wanted == short_name_of(space)) return space;
  }
  throw InputError("space is RAS or LPS, not ", quote(wanted));
}

SampleGrid grid_of(int type, const size_t shape[3], int order, const deliso_place* place) {
  require(shape, "shape");
  if (type < DELISO_UINT8 || type > DELISO_UINT64) throw InputError("no such type of samples");
  if (order != DELISO_C_ORDER && order != DELISO_FORTRAN_ORDER) throw InputError("no such order");
  const bool is_fortran = order == DELISO_FORTRAN_ORDER;
  SampleGrid grid;
  grid.name = kName;
  grid.type = type == DELISO_INT64    ? StoredType(StoredType::Wide::i64)
              : type == DELISO_UINT64 ? StoredType(StoredType::Wide::u64)
                                      : StoredType(static_cast<SampleType>(type));
  for (std::size_t n = 0; n < 3; ++n) {
    grid.dims[n] = static_cast<std::int64_t>(shape[is_fortran ? n : 2 - n]);
  }
  if (place) {
    const double *s = place->spacing, *d = place->direction, *o = place->origin;
    grid.set_spacing({s[0], s[1], s[2]});
    if (std::any_of(d, d + 9, [](double x) { return x != 0; })) {
      for (std::size_t n = 0; n < 3; ++n) {
        const Vec3 direction{d[n], d[3 + n], d[6 + n]};
        if (std::abs(length(direction) - 1) > kUnitLength)
          throw InputError("direction: column ", n, " has length ", length(direction), ", not 1");
        grid.steps[n] = s[n] * direction;
      }
    }
    grid.origin = {o[0], o[1], o[2]};
    for (std::size_t n = 0; n < 3; ++n) {
      if (const double* at = place->coordinates[n]) grid.set_coordinates(n, {at, shape[2 - n]});
    }
    grid.space = space_of(place->space);
  }
  if (is_fortran) {
    std::swap(grid.steps[0], grid.steps[2]);
    std::swap(grid.places[0], grid.places[2]);
  }
  return grid;
}

CommandLine parse(std::vector<std::string> words, const char* const* options, Reads reads) {
  for (; options && *options; ++options) {
    const std::string option = text("--", *options), name = option.substr(0, option.find('='));
    if (name == "--") {
      throw InputError("an option is ", quote(*options),
                       ", without a name: it is NAME or NAME=VALUE");
    }
    const LibraryUse use = library_use(name);
    if (use == LibraryUse::none || (use == LibraryUse::of_files && reads != Reads::now)) {
      throw InputError(name, " has no meaning for an array");
    }
    words.push_back(option);
  }
  CommandLine line = parse_command_line(std::vector<std::string_view>(words.begin(), words.end()));
  if (reads != Reads::nothing) {
    find_segments(line);
  } else if (!line.field.segments.empty()) {
    throw InputError("an array does not name its labels");
  }
  return line;
}

CommandLine parse(std::vector<std::string> words, double isovalue, const char* const* options,
                  Reads reads) {
  if (!std::isnan(isovalue)) words.push_back(text("--iso=", isovalue));
  return parse(std::move(words), options, reads);
}

void take(const TriMesh& surface, MeshRun& run, double seconds, deliso_mesh& made) {
  made.normals = normals_of(surface, run.input.field.source, run.line.options);
  made.mesh = written_mesh(surface, {.format = MeshFormat::ply});
  made.write = write_options(run, surface);
  made.space = surface.frame.space;
  run.cost.end(seconds);
  made.report = report_json(run);
  tell(run.notes);
}

TriMesh tri_mesh_of(const deliso_mesh* mesh) {
  require(mesh, "mesh");
  TriMesh made = make_tri_mesh(mesh->mesh.points, mesh->mesh.triangles);
  made.frame.space = mesh->space;
  return made;
}

MeshNotes notes_of(const deliso_mesh& mesh) {
  MeshNotes notes = mesh.notes;
  if (notes.sides.empty()) notes.sides = mesh.write.sides;
  return notes;
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

const char* deliso_notes() {
  using namespace deliso;
  try {
    ReportWriter out("notes");
    add_diagnostics(out, c::last_notes);
    c::last_notes_text = out.finish();
    return c::last_notes_text.c_str();
  } catch (const std::bad_alloc&) {
    return R"({"diagnostics": []})";
  }
}
