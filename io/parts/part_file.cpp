// SPDX-License-Identifier: MIT
#include "io/parts/part_file.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <utility>

#include "base/check.h"
#include "base/text.h"
#include "base/version.h"
#include "check/check_mesh.h"
#include "io/files/checksum.h"
#include "io/files/input_file.h"
#include "io/files/text_scan.h"
#include "io/parts/part_archive.h"

namespace deliso {
namespace {

constexpr std::string_view kMagic = "DelIso part ";
constexpr std::size_t kChecksumSize = sizeof(std::uint32_t);
std::string first_line() {
  return text(kMagic, kVersion, "\n");
}

// The same list of members writes a part and reads it.
template <class Archive>
void pass(Archive& a, Index3& n) {
  a(n.i, n.j, n.k);
}
template <class Archive>
void pass(Archive& a, Vec3& p) {
  a(p.x, p.y, p.z);
}
template <class Archive>
void pass(Archive& a, std::string& word) {
  a.list(word, [&](char& c) { a(c); });
}
template <class Archive, class List>
void pass_points(Archive& a, List& points) {
  a.list(points, [&](Vec3& p) { pass(a, p); });
}
template <class Archive, class List>
void pass_numbers(Archive& a, List& numbers) {
  a.list(numbers, [&](auto& n) { a(n); });
}

template <class Archive>
void pass(Archive& a, BlockComponents& of_block) {
  a.list(of_block.components, [&](ContourComponent& c) {
    a(c.euler, c.crossings, c.pieces, c.tubes);
    pass(a, c.first);
    pass(a, c.lo);
    pass(a, c.hi);
  });
  a.list(of_block.crossings, [&](BlockComponents::Crossing& c) {
    pass(a, c.point);
    a(c.component);
  });
  pass_numbers(a, of_block.segments_on_inner);
  a.list(of_block.arcs, [&](BlockComponents::Arc& arc) {
    pass(a, arc.from);
    pass(a, arc.to);
  });
  a(of_block.closed_curves);
}

template <class Archive>
void pass(Archive& a, BoundaryLoop& loop) {
  a.list(loop, [&](LoopPoint& p) {
    pass(a, p.point);
    a(p.face, p.is_kept, p.is_fixed);
  });
}

template <class Archive>
void pass(Archive& a, SearchCounters& c) {
  a(c.searches, c.searches_with_hit, c.computations, c.computations_with_hit);
}

template <class Archive>
void pass(Archive& a, Report& r) {
  a(r.seconds_contour, r.seconds_coarsen, r.seconds_refine, r.vertices_coarsened,
    r.insertions_refine);
  pass(a, r.searches_coarsen);
  pass(a, r.searches_refine);
  for (std::uint64_t& n : r.counters) a(n);
  for (OperationCounts& o : r.operations) {
    a(o.done);
    for (std::uint64_t& n : o.refused) a(n);
  }
}

// Links follow from the triangles, and the chain's from the places on the curves.
struct Place {
  VertexId vertex{0};
  CurvePlace at;
};

template <class Archive>
void pass(Archive& a, PartFile& part, std::vector<Triangle>& triangles, std::vector<Place>& places,
          BoundaryLoops& loops) {
  a(part.choice.number, part.choice.of);
  a.list(part.words, [&](std::string& word) { pass(a, word); });
  pass(a, part.dims);
  pass(a, part.spacing);
  for (std::vector<double>& along : part.places) pass_numbers(a, along);
  a(part.type);
  pass(a, part.frame.origin);
  for (Vec3& axis : part.frame.axes) pass(a, axis);
  a(part.frame.space, part.isovalue, part.samples_at_seams);
  Block& block = part.block;
  a.list(block.components, [&](BlockComponents& c) { pass(a, c); });
  pass_points(a, block.mesh.mesh.points);
  a.list(triangles, [&](Triangle& t) { a(t[0], t[1], t[2]); });
  a.list(block.mesh.duals, [&](Dual& dual) {
    pass(a, dual.center);
    a(dual.radius2, dual.on_surface);
  });
  a.list(places, [&](Place& p) { a(p.vertex, p.at.loop, p.at.s); });
  a.list(loops, [&](BoundaryLoop& loop) { pass(a, loop); });
  pass_numbers(a, block.is_open);
  pass_numbers(a, block.may_thin);
  pass_points(a, block.samples_near_seams);
  pass(a, block.report);
}

// True if p is in the box, and predicates are exact for it (exact/predicates.h).
bool is_place(const Vec3& p, const Box3& box) {
  constexpr double kLeast = 0x1p-140;
  const auto is_exact = [](double x) { return x == 0 || std::fabs(x) >= kLeast; };
  return box.contains(p) && is_exact(p.x) && is_exact(p.y) && is_exact(p.z);
}

void require(bool condition, std::string_view name, const char* fault) {
  if (!condition) fail(name, "is no sound part: ", fault);
}

bool are_flags(const std::vector<std::uint8_t>& flags) {
  return std::ranges::all_of(flags, [](std::uint8_t flag) { return flag <= 1; });
}

void require_sound_components(const Block& block, Index3 voxels, std::string_view name) {
  for (const BlockComponents& c : block.components) {
    const std::size_t count = c.components.size();
    bool sound = c.segments_on_inner.size() == count;
    for (const auto& crossing : c.crossings) sound &= crossing.component < count;
    for (const ContourComponent& component : c.components) {
      for (int axis = 0; axis < 3; ++axis) {
        sound &= 0 <= component.first[axis] && component.first[axis] < voxels[axis];
      }
    }
    require(sound, name, "its components");
  }
}

void require_sound_curves(const BoundaryLoops& loops, const std::vector<Place>& places,
                          std::size_t vertices, const Box3& box, std::string_view name) {
  const auto is_sound = [&](const LoopPoint& p) { return p.face < 6 && is_place(p.point, box); };
  for (const BoundaryLoop& loop : loops) {
    require(!loop.empty() && std::ranges::all_of(loop, is_sound), name, "its curves");
  }
  for (const auto& [vertex, at] : places) {
    const bool sound = vertex < vertices && at.loop < loops.size() && at.s >= 0 &&
                       at.s < static_cast<double>(loops[at.loop].size());
    require(sound, name, "its places on curves");
  }
}

// Makes the chain. Throws unless its edges are those where the mesh ends.
void link_chain(SurfaceMesh& s, std::vector<Place> places, std::string_view name) {
  std::ranges::sort(
      places, {}, [](const Place& p) { return std::tuple(p.at.loop, p.at.s, p.vertex.number()); });
  for (std::size_t begin = 0, end; begin < places.size(); begin = end) {
    std::vector<VertexId> vertices;
    std::vector<CurvePlace> at;
    for (end = begin; end < places.size() && places[end].at.loop == places[begin].at.loop; ++end) {
      require(!s.chain.is_boundary(places[end].vertex), name, "a vertex is twice on its curves");
      vertices.push_back(places[end].vertex);
      at.push_back(places[end].at);
    }
    s.chain.add_loop(vertices, at);
  }
  require(ends_on_chain(s), name, "it ends elsewhere than on its curves");
}

}  // namespace

Grid PartFile::shape() const {
  return Grid(dims, spacing, type, frame).with_places(places, name);
}

bool PartFile::is_of(const Grid& field, double level) const {
  return dims == field.dims() && spacing == field.spacing() && places == field.all_places() &&
         type == field.type() && frame == field.frame() && isovalue == level;
}

std::string part_bytes(PartFile part) {
  std::vector<Triangle> triangles = part.block.mesh.mesh.triangles();
  std::vector<Place> places;
  const BoundaryChain& chain = part.block.mesh.chain;
  for (VertexId v = 0; v < chain.vertex_capacity(); ++v) {
    if (chain.is_boundary(v)) places.push_back({v, chain.place(v)});
  }
  BoundaryLoops loops;
  if (part.block.loops) loops = *part.block.loops;
  std::string bytes = first_line();
  PartWriter writer(bytes);
  pass(writer, part, triangles, places, loops);
  std::uint32_t sum = crc32(std::as_bytes(std::span(bytes)));
  writer(sum);
  return bytes;
}

PartFile part_in(std::span<const std::byte> bytes, std::string_view name) {
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!all.starts_with(kMagic)) fail(name, "is no part of a mesh, as --part makes them");
  const std::string line = first_line();
  if (!all.starts_with(line)) {
    fail(name, "is a part of another version than ", kVersion, ": make it again");
  }
  if (all.size() < line.size() + kChecksumSize) fail(name, "is a part cut short: make it again");
  const std::string_view body = all.substr(0, all.size() - kChecksumSize);
  PartReader sum_reader(all.substr(body.size()), name);
  std::uint32_t sum = 0;
  sum_reader(sum);
  if (sum != crc32(std::as_bytes(std::span(body)))) {
    fail(name, "is a part that is not as it was made, or cut short: make it again");
  }

  PartFile part;
  part.name = name;
  std::vector<Triangle> triangles;
  std::vector<Place> places;
  BoundaryLoops loops;
  PartReader reader(body.substr(line.size()), name);
  pass(reader, part, triangles, places, loops);
  reader.end();

  require(part.choice.number >= 1 && part.choice.number <= part.choice.of, name, "its number");
  require(part.type <= SampleType::f64 && part.frame.space <= AnatomicalSpace::lps, name,
          "its volume's type");
  require_in_range(part.dims, part.spacing, part.frame, name);
  require(std::isfinite(part.isovalue), name, "its isovalue");
  const Grid shape = part.shape();
  const Box3 box = shape.box();
  SurfaceMesh& s = part.block.mesh;
  const auto is_inside = [&](const Vec3& p) { return is_place(p, box); };
  require(std::ranges::all_of(s.mesh.points, is_inside), name, "a vertex is outside the volume");
  require(std::ranges::all_of(part.block.samples_near_seams, is_inside), name,
          "a sample is outside the volume");
  for (const Triangle& t : triangles) {
    for (const VertexId v : t) require(v < s.mesh.points.size(), name, "a triangle's vertex");
  }
  require(s.duals.size() == triangles.size(), name, "its duals");
  for (const Dual& dual : s.duals) {
    // The circumcenter of a flat facet may be infinite; it has no surface ball.
    const double total = dual.center.x + dual.center.y + dual.center.z + dual.radius2;
    const bool is_ball = std::isfinite(total) && dual.radius2 >= 0;
    require(is_ball || (!std::isnan(total) && !dual.on_surface), name, "its duals");
  }
  s.mesh = make_tri_mesh(std::move(s.mesh.points), triangles);
  if (const std::string fault = check_mesh(s.mesh); !fault.empty()) {
    fail(name, "is no sound part: ", fault);
  }
  const std::size_t marked = part.block.is_open.empty() ? 0 : triangles.size();
  require(part.block.is_open.size() == marked && are_flags(part.block.is_open) &&
              part.block.may_thin.size() == (marked == 0 ? 0 : s.mesh.points.size()) &&
              are_flags(part.block.may_thin),
          name, "its marks");
  // Caps are made of the joined mesh.
  require(part.block.report[Counter::cap_refused] == 0, name, "its counters");
  require_sound_components(part.block, shape.voxels(), name);
  require_sound_curves(loops, places, s.mesh.points.size(), box, name);
  link_chain(s, std::move(places), name);
  part.block.loops = std::make_shared<const BoundaryLoops>(std::move(loops));
  return part;
}

void sort_parts(std::vector<PartFile>& parts) {
  // If two parts differ, the message names the one of the later number, in any order of names.
  std::ranges::sort(parts, {}, [](const PartFile& part) {
    return std::pair(part.choice.number, std::string_view(part.name));
  });
  const PartFile& first = parts.front();
  for (std::size_t n = 1; n < parts.size(); ++n) {
    const PartFile& part = parts[n];
    const auto refuse = [&](std::string_view difference) {
      throw InputError(quote(part.name), " is no part of the same mesh as ", quote(first.name),
                       ": ", difference);
    };
    if (part.choice.of != first.choice.of) {
      refuse(text("one of ", part.choice.of, ", and one of ", first.choice.of));
    }
    const auto [a, b] = std::ranges::mismatch(first.words, part.words);
    const bool a_ends = a == first.words.end(), b_ends = b == part.words.end();
    if (!a_ends || !b_ends) {
      refuse(text(a_ends ? "nothing" : *a, " there, ", b_ends ? "nothing" : *b, " here"));
    }
    if (!part.is_of(first.shape(), first.isovalue)) refuse("another volume or isovalue");
    if (part.choice.number == parts[n - 1].choice.number) {
      throw InputError(quote(part.name), " and ", quote(parts[n - 1].name), " are both part ",
                       part.choice.number, " of ", part.choice.of);
    }
  }
  for (int number = 1; number <= first.choice.of; ++number) {
    const auto n = static_cast<std::size_t>(number - 1);
    if (n < parts.size() && parts[n].choice.number == number) continue;
    throw InputError("part ", number, " of ", first.choice.of, " is missing beside ",
                     quote(first.name));
  }
}

std::uint32_t checksum_at_seams(const VolumeSource& source, const BlockGrid& grid,
                                PartChoice part) {
  const std::vector<SampleBox> boxes = grid.boxes();
  const CellRun own = cells_of(part, boxes.size());
  const Index3 last = source.shape.voxels();
  std::uint32_t sum = 0;
  for (std::size_t cell = own.begin; cell < own.end; ++cell) {
    for (BoxFace face = 0; face < 6; ++face) {
      const int axis = axis_of(face);
      const bool is_high = (face & 1) != 0;
      SampleBox plane = boxes[cell];
      (is_high ? plane.begin : plane.end)[axis] = (is_high ? plane.end : plane.begin)[axis];
      Index3 beyond = plane.begin;
      if (!is_high) --beyond[axis];
      if (beyond[axis] < 0 || beyond[axis] >= last[axis]) continue;
      if (own.holds(grid.number_of(grid.cell_of(beyond)))) continue;
      const Volume samples = source.read(plane);
      sum = samples.visit([&](const auto* s) {
        return crc32(std::as_bytes(std::span(s, samples.sample_count())), sum);
      });
    }
  }
  return sum;
}

}  // namespace deliso
