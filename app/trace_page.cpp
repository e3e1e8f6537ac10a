// SPDX-License-Identifier: MIT
#include "app/trace_page.h"

#include <cmath>
#include <vector>

#include "app/criterion_words.h"
#include "base/text.h"
#include "io/files/json.h"
#include "view/trace/trace.h"
#include "view/trace/trace_names.h"

namespace deliso {
namespace {

template <class T>
void add_list(PageData& data, const std::string& name, const TraceList<T>& list) {
  data.add(name, list.values);
  data.add(name + "_begin", list.begin);
}

void add_routine(JsonWriter& json, const RoutineName& routine) {
  json.open_item();
  json.add("name", routine.name);
  json.add("figure", routine.figure);
  json.add("stage", routine.stage);
  json.add("text", routine.text);
  json.close();
}

void add_routines(JsonWriter& json) {
  json.open_list("routines");
  for (std::size_t n = 0; n < static_cast<std::size_t>(Routine::count_); ++n) {
    add_routine(json, name_of(static_cast<Routine>(n)));
  }
  for (std::size_t n = 0; n < kOperations; ++n) {
    add_routine(json, routine_of(static_cast<Operation>(n)));
  }
  json.close();
}

// The names as strings, with the meanings of the refusals.
void add_outcomes(JsonWriter& json) {
  std::vector<std::string> names, texts;
  for (std::size_t n = 0; n < static_cast<std::size_t>(TraceOutcome::count_); ++n) {
    const ReasonName outcome = name_of(static_cast<TraceOutcome>(n));
    names.emplace_back(outcome.name);
    texts.emplace_back(outcome.text);
  }
  for (std::size_t n = 0; n < kRefusals; ++n) {
    const auto refusal = static_cast<Refusal>(n);
    names.push_back("refused: " + std::string(name_of(refusal)));
    texts.emplace_back(row_of(kRefusalTable, refusal).text);
  }
  json.add("outcomes", names);
  json.add("outcome_texts", texts);
}

void add_reasons(JsonWriter& json) {
  const auto add = [&](std::string_view name, std::string_view meaning) {
    json.open_item();
    json.add("name", name);
    json.add("text", meaning);
    json.close();
  };
  json.open_list("reasons");
  for (std::size_t n = 0; n < static_cast<std::size_t>(Reason::count_); ++n) {
    const ReasonName reason = name_of(static_cast<Reason>(n));
    add(reason.name, reason.text);
  }
  for (const CriterionWords& words : kCriterionWords) {
    add(words.measured,
        text("over its limit, in Stage 2 that of ", words.option, "; value: times the limit"));
  }
  for (std::size_t n = 0; n < static_cast<std::size_t>(PaperReason::count_); ++n) {
    const ReasonName reason = name_of(static_cast<PaperReason>(n));
    add(reason.name, reason.text);
  }
  json.close();
}

void add_topology(JsonWriter& json, std::string_view key, const TopologyCounts& topology) {
  json.open(key);
  json.add("components", topology.components);
  json.add("euler", topology.euler);
  json.add("boundary_loops", topology.boundary_loops);
  json.close();
}

struct Scale {
  double first, step;  // value = first + step * stored
};

Scale scale_of(const Volume& volume, const ValueRange& range) {
  if (size_of(volume.type()) <= 2)
    return {volume.type() == SampleType::i8    ? -128.0
            : volume.type() == SampleType::i16 ? -32768.0
                                               : 0.0,
            1};
  const double step = (range.max / 65535 - range.min / 65535);
  return {range.min, step > 0 ? step : 1};
}

template <class T>
std::vector<T> stored(const Volume& volume, const Scale& scale) {
  std::vector<T> out;
  out.reserve(volume.sample_count());
  volume.visit([&](const auto* samples) {
    for (std::size_t n = 0; n < volume.sample_count(); ++n) {
      const double share = (static_cast<double>(samples[n]) - scale.first) / scale.step;
      out.push_back(static_cast<T>(std::lround(share)));
    }
  });
  return out;
}

}  // namespace

Up superior_of(const Frame& frame) {
  Up up;
  if (frame.space == AnatomicalSpace::unknown) return up;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(frame.axes[axis].z) > std::abs(frame.axes[up.axis].z)) up.axis = axis;
  }
  up.sign = frame.axes[up.axis].z < 0 ? -1 : 1;
  return up;
}

void add_trace(const Trace& trace, PageData& data) {
  const TraceArrays& a = trace.arrays();
  data.add("points", a.points);
  data.add("event_routine", a.routine);
  data.add("event_outcome", a.outcome);
  data.add("event_reason", a.reason);
  data.add("event_value", a.value);
  data.add("event_vertex", a.vertex);
  data.add("event_place", a.place);
  data.add("event_caller", a.caller);
  data.add("event_micros", a.micros);
  data.add("event_searches", a.searches);
  data.add("event_computations", a.computations);
  data.add("event_worst", a.worst);
  data.add("event_edge", a.edge);
  data.add("event_ball", a.ball);
  add_list(data, "removed", a.removed);
  add_list(data, "added", a.added);
  add_list(data, "zone", a.zone);
  add_list(data, "star", a.star);
  add_list(data, "cone", a.cone);
  add_list(data, "hits", a.hits);
  add_list(data, "relabel", a.relabel);
  data.add("tets", a.tets);
  if (a.contour_points.empty()) return;
  data.add("contour_points", a.contour_points);
  data.add("contour_triangles", a.contour_triangles);
  data.add("contour_label", a.contour_label);
}

void add_samples(const Volume& volume, const ValueRange& range, PageData& data) {
  const Scale scale = scale_of(volume, range);
  if (size_of(volume.type()) == 1) {
    data.add("samples", stored<std::uint8_t>(volume, scale));
  } else {
    data.add("samples", stored<std::uint16_t>(volume, scale));
  }
}

std::string trace_header(const CommandLine& line, const Input& input, const Report& report,
                         const TopologyCounts& mesh, const Trace& trace) {
  const Volume& volume = input.volume();
  const Box3 box = volume.box();
  const Index3 dims = volume.dims();
  const Vec3 spacing = volume.spacing();
  const Scale scale = scale_of(volume, *input.range);
  JsonWriter json;
  const Up up = line.picture.up.value_or(superior_of(volume.frame()));
  json.add("kind", "trace");
  json.add("up", {double(up.axis), up.sign});
  json.add("input", input.name);
  json.add("isovalue", *input.isovalue);
  json.add("kappa", report.kappa_effective);
  json.add("program", line.paper ? "published" : "exact");
  json.add("box", {box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z});
  json.add("voxel", volume.voxel());
  json.add("r_min", report.r_min);
  json.add("truncated", trace.truncated());
  json.add("limit", line.trace.limit);
  json.add("events_seen", trace.events_seen());
  add_routines(json);
  add_outcomes(json);
  add_reasons(json);
  // Stage 2 keeps the topology, so that of the mesh is also Stage 1's.
  add_topology(json, "topology", mesh);
  if (line.options.components.is_all()) add_topology(json, "exact_topology", report.exact);
  json.add("dims", {double(dims.i), double(dims.j), double(dims.k)});
  json.add("spacing", {spacing.x, spacing.y, spacing.z});
  json.add("origin", {0, 0, 0});
  json.add("sample_scale", {scale.first, scale.step});
  return json.finish();
}

}  // namespace deliso
