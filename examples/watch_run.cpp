// SPDX-License-Identifier: MIT
// A run, step by step: the exact contour, the mesh that it is coarsened to, and how many vertices
// each operation put in, and for what reasons. The trace also has the triangles that every event
// takes out and puts in; added up, they are the mesh.
// Usage: watch_run [VOLUME [ISOVALUE]]
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "deliso/base/check.h"
#include "deliso/io/volume/read_volume.h"
#include "deliso/mesh_isosurface.h"
#include "deliso/run/criteria.h"
#include "deliso/run/report.h"
#include "deliso/view/trace/recorder.h"
#include "deliso/view/trace/trace_names.h"

namespace {

// Numbers below the count are routines of Stage 1; then come the operations of Stage 2, the ways in
// which it mends a triangle.
constexpr auto kRoutines = static_cast<std::size_t>(deliso::Routine::count_);

std::string name_of_routine(std::size_t number) {
  return number < kRoutines
             ? "Stage 1  " + std::string(name_of(static_cast<deliso::Routine>(number)).name)
             : "Stage 2  " +
                   std::string(name_of(static_cast<deliso::Operation>(number - kRoutines)));
}

// Likewise: reasons, and then the criteria.
std::string_view name_of_reason(std::size_t number) {
  constexpr auto count = static_cast<std::size_t>(deliso::Reason::count_);
  return number < count ? name_of(static_cast<deliso::Reason>(number)).name
                        : deliso::kCriterionTable[number - count].name;
}

void watch(const std::string& input, double isovalue) {
  const deliso::Volume volume = deliso::read_volume(input);
  deliso::value_range(volume);     // throws for a NaN
  deliso::Trace trace(1'000'000);  // so many events at most
  deliso::Options options;
  deliso::Report report;
  deliso::TraceRecorder recorder(trace);
  options.observer = &recorder;
  const deliso::TriMesh mesh = deliso::mesh_isosurface(volume, isovalue, options, report);

  // All events, an array for each of their parts.
  const deliso::TraceArrays& events = trace.arrays();
  std::map<std::pair<std::size_t, std::size_t>, int> vertices;  // by routine and reason
  for (std::size_t e = 0; e < trace.size(); ++e) {
    if (events.routine[e] < kRoutines) {          // puts no vertex in
      if (std::isnan(events.value[e])) continue;  // a removal of many
      std::cout << std::left << std::setw(46) << name_of_routine(events.routine[e]) << std::right
                << std::setw(6) << events.value[e] << " triangles\n";
    }
    if (events.vertex[e] == deliso::kNoId) continue;  // a flip, or an attempt that was refused
    ++vertices[{events.routine[e], events.reason[e]}];
  }
  for (const auto& [who, number] : vertices) {
    std::cout << std::left << std::setw(28) << name_of_routine(who.first) << std::setw(18)
              << name_of_reason(who.second) << std::right << std::setw(6) << number << "\n";
  }
  std::cout << trace.events_seen() << " events; their triangles add up to "
            << trace.complex().size() << ", the mesh has " << mesh.faces.size() << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  try {
    watch(argc > 1 ? argv[1] : "builtin:fuel:32", argc > 2 ? std::strtod(argv[2], nullptr) : 70.1);
  } catch (const deliso::InputError& error) {
    std::cerr << "watch_run: " << error.what() << "\n";
    return 2;
  }
}
