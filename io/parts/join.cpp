// SPDX-License-Identifier: MIT
#include "io/parts/join.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "base/check.h"
#include "base/text.h"
#include "io/files/atomic_file.h"
#include "io/files/text_scan.h"
#include "io/mesh/mesh_parsers.h"
#include "io/mesh/ply_writer.h"
#include "io/mesh/read_mesh.h"
#include "io/parts/part_note.h"
#include "mesh/tri_mesh.h"

namespace deliso {
namespace {

std::string name_of(Index3 block) {
  return text(block.i, ",", block.j, ",", block.k);
}

struct Part {
  std::string path;
  PartNote note;
};

// True if a grid edge lies in plane n of the samples across an axis.
bool lies_in(const GridEdge& edge, int axis, int n) {
  return edge.axis != axis && edge.low[static_cast<std::size_t>(axis)] == n;
}

class Joiner {
 public:
  explicit Joiner(std::span<const std::string> paths);
  Joined run(const std::string& output, bool single_precision, bool ascii);

 private:
  // Ids of a part's vertices in the whole. Own vertices have consecutive ids; foreign ones are on a
  // seam and belong to an earlier part.
  struct Numbers {
    std::uint64_t first = 0;                                  // own vertex
    std::vector<std::pair<VertexId, std::uint64_t>> foreign;  // ascending

    struct Place {
      std::uint64_t in_whole;
      bool is_foreign;
    };
    Place of(VertexId v) const {
      const auto at =
          std::ranges::lower_bound(foreign, v, {}, &std::pair<VertexId, std::uint64_t>::first);
      if (at != foreign.end() && at->first == v) return {at->second, true};
      return {first + v - static_cast<std::uint64_t>(at - foreign.begin()), false};
    }
  };
  // An edge of a seam, in the direction of one part.
  struct SeamEdge {
    std::uint64_t low, high;
    bool upwards;
    std::uint32_t part;
  };

  [[noreturn]] void fail_match(const Part& a, const Part& b) const {
    throw InputError(text("the seams of ", quote(a.path), " and ", quote(b.path), " do not match"));
  }
  // pre: there is one part of each block, so parts and blocks have the same numbers.
  std::size_t number_of(Index3 block) const {
    const auto [i, j, k] = block;
    return static_cast<std::size_t>(i + of_.i * (j + std::int64_t{of_.j} * k));
  }
  PartMesh read(std::uint32_t p) const;
  void require_one_of_each() const;
  void require_same_samples() const;
  void number(std::uint32_t p, const PartMesh& part);
  void collect_edges(std::uint32_t p, PartMesh&& part);
  void match_edges();

  Index3 of_;
  std::vector<Part> parts_;  // by block
  std::vector<Numbers> numbers_;
  struct Known {
    std::uint64_t place;
    Vec3 point;
    std::uint32_t part;
  };
  std::map<GridEdge, Known> seam_;
  std::vector<SeamEdge> edges_;
  Joined joined_;
};

Joiner::Joiner(std::span<const std::string> paths) {
  for (const std::string& path : paths) {
    const std::vector<std::string> comments = read_ply_comments(path);
    std::optional<PartNote> note = part_note(comments);
    if (!note) throw InputError(text(quote(path), " is no part of a mesh, as --block makes them"));
    parts_.push_back({path, std::move(*note)});
  }
  DELISO_CHECK(!parts_.empty());
  // If two parts differ, the message names the one of the later block, in any order of paths.
  std::ranges::sort(parts_, {}, [](const Part& part) {
    const Index3 n = part.note.block.at;
    return std::tuple(n.k, n.j, n.i, part.path);
  });
  const Part& first = parts_.front();
  of_ = first.note.block.of;
  for (const Part& part : parts_) {
    const auto [a, b] = std::ranges::mismatch(first.note.words, part.note.words);
    const bool a_ends = a == first.note.words.end(), b_ends = b == part.note.words.end();
    if (!a_ends || !b_ends) {
      throw InputError(text(quote(part.path), " is no part of the same mesh as ", quote(first.path),
                            ": ", b_ends ? "nothing" : *b, " there, ", a_ends ? "nothing" : *a,
                            " here"));
    }
    if (part.note.block.of != of_) {
      throw InputError(text(quote(part.path), " is one of ", name_of(part.note.block.of),
                            " blocks, ", quote(first.path), " one of ", name_of(of_)));
    }
  }
  require_one_of_each();
  require_same_samples();
}

void Joiner::require_one_of_each() const {
  for (std::size_t n = 1; n < parts_.size(); ++n) {
    if (parts_[n].note.block.at == parts_[n - 1].note.block.at) {
      throw InputError(text(quote(parts_[n].path), " and ", quote(parts_[n - 1].path),
                            " are both block ", name_of(parts_[n].note.block.at)));
    }
  }
  // Counts up like an odometer: the number of blocks may exceed 64 bits.
  Index3 due;
  for (std::size_t n = 0; due.k < of_.k; ++n) {
    if (n == parts_.size() || parts_[n].note.block.at != due) {
      throw InputError(text("block ", name_of(due), " of ", name_of(of_), " is missing beside ",
                            quote(parts_.front().path)));
    }
    if (++due.i < of_.i) continue;
    due.i = 0;
    if (++due.j < of_.j) continue;
    due.j = 0;
    ++due.k;
  }
}

// Compares the samples at seams: without surface there, only they show a different volume.
void Joiner::require_same_samples() const {
  for (const Part& part : parts_) {
    for (int axis = 0; axis < 3; ++axis) {
      Index3 beyond = part.note.block.at;
      if (++beyond[axis] == of_[axis]) continue;
      const Part& other = parts_[number_of(beyond)];
      const auto face = static_cast<std::size_t>(2 * axis);
      if (part.note.samples[face + 1] != other.note.samples[face]) {
        throw InputError(text(quote(other.path), " is of other samples than ", quote(part.path),
                              " where the two meet"));
      }
    }
  }
}

void Joiner::number(std::uint32_t p, const PartMesh& part) {
  Numbers numbers{joined_.vertices, {}};
  for (const SeamVertex& s : part.seam) {
    const Vec3& point = part.points[s.vertex];
    const auto known = seam_.find(s.at);
    if (known == seam_.end()) continue;
    if (known->second.point != point) fail_match(parts_[known->second.part], parts_[p]);
    numbers.foreign.emplace_back(s.vertex, known->second.place);
  }
  std::ranges::sort(numbers.foreign);
  const auto twice =
      std::ranges::adjacent_find(numbers.foreign, {}, &std::pair<VertexId, std::uint64_t>::first);
  if (twice != numbers.foreign.end()) {
    throw InputError(
        text(quote(parts_[p].path), ": vertex ", twice->first, " is twice in its seam"));
  }
  numbers_.push_back(std::move(numbers));
  for (const SeamVertex& s : part.seam) {
    seam_.try_emplace(s.at, Known{numbers_.back().of(s.vertex).in_whole, part.points[s.vertex], p});
  }
  joined_.vertices += part.points.size() - numbers_.back().foreign.size();
  joined_.triangles += part.triangles.size();
}

// Returns the part's boundary edges in its inner faces.
void Joiner::collect_edges(std::uint32_t p, PartMesh&& part) {
  const Index3 dims = parts_[p].note.dims;
  const Roi region = region_of(parts_[p].note.block, dims);
  const auto is_inner = [&](int axis, int n) {
    return (n == region.begin[axis] && n > 0) || (n == region.end[axis] - 1 && n < dims[axis] - 1);
  };
  std::vector<const GridEdge*> at(part.points.size(), nullptr);
  for (const SeamVertex& s : part.seam) at[s.vertex] = &s.at;
  const auto is_in_seam = [&](VertexId a, VertexId b) {
    if (at[a] == nullptr || at[b] == nullptr) return false;
    for (int axis = 0; axis < 3; ++axis) {
      const int n = at[a]->low[static_cast<std::size_t>(axis)];
      if (is_inner(axis, n) && lies_in(*at[a], axis, n) && lies_in(*at[b], axis, n)) return true;
    }
    return false;
  };
  const TriMesh mesh = make_tri_mesh(std::move(part.points), part.triangles);
  for (const Face& face : mesh.faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId a = face.v[(i + 1) % 3], b = face.v[(i + 2) % 3];
      if (face.n[i] != kNoId || !is_in_seam(a, b)) continue;
      const std::uint64_t from = numbers_[p].of(a).in_whole, to = numbers_[p].of(b).in_whole;
      edges_.push_back({std::min(from, to), std::max(from, to), from < to, p});
    }
  }
}

// Throws unless two parts have every edge of a seam, in opposite directions.
void Joiner::match_edges() {
  std::ranges::sort(edges_, {},
                    [](const SeamEdge& e) { return std::tuple(e.low, e.high, e.part, e.upwards); });
  for (std::size_t n = 0; n < edges_.size(); n += 2) {
    const SeamEdge& e = edges_[n];
    const bool has_other =
        n + 1 < edges_.size() && edges_[n + 1].low == e.low && edges_[n + 1].high == e.high;
    if (!has_other) {
      throw InputError(text("the seam of ", quote(parts_[e.part].path),
                            " does not match that of the part beside it"));
    }
    const SeamEdge& other = edges_[n + 1];
    if (other.part == e.part || other.upwards == e.upwards) {
      fail_match(parts_[e.part], parts_[other.part]);
    }
  }
  joined_.seam_edges = edges_.size() / 2;
  joined_.seam_vertices = seam_.size();
}

// Reads the part again in each pass. A part that has changed since is refused.
PartMesh Joiner::read(std::uint32_t p) const {
  PartMesh part = read_part(parts_[p].path);
  require_as_noted(parts_[p].note, part, parts_[p].path);
  return part;
}

Joined Joiner::run(const std::string& output, bool single_precision, bool ascii) {
  joined_.parts = parts_.size();
  for (std::uint32_t p = 0; p < parts_.size(); ++p) {
    PartMesh part = read(p);
    number(p, part);
    collect_edges(p, std::move(part));
  }
  match_edges();
  if (joined_.vertices > kMostVertices || joined_.triangles > kMostFaces) {
    throw InputError(text("the whole would have ", joined_.vertices, " vertices and ",
                          joined_.triangles, " triangles, more than 32-bit ids can name"));
  }
  PlyHeader header{{}, joined_.vertices, joined_.triangles, {}, single_precision, ascii};
  const PartNote& first = parts_.front().note;
  header.comments.push_back("DelIso" + (first.space.empty() ? "" : " SPACE=" + first.space));
  std::string& line = header.comments.emplace_back();
  for (const std::string& word : first.words) line += (line.empty() ? "" : " ") + word;
  AtomicFile out(output);
  PlyWriter writer(out, header);
  for (std::uint32_t p = 0; p < parts_.size(); ++p) {
    const PartMesh part = read(p);
    for (VertexId v = 0; v < part.points.size(); ++v) {
      if (!numbers_[p].of(v).is_foreign) writer.vertex(part.points[v]);
    }
  }
  for (std::uint32_t p = 0; p < parts_.size(); ++p) {
    for (Triangle t : read(p).triangles) {
      for (VertexId& v : t) v = VertexId(numbers_[p].of(v).in_whole);
      writer.facet(t);
    }
  }
  writer.finish();
  out.commit();
  return joined_;
}

}  // namespace

Joined join_parts(std::span<const std::string> paths, const std::string& output,
                  bool single_precision, bool ascii) {
  return Joiner(paths).run(output, single_precision, ascii);
}

}  // namespace deliso
