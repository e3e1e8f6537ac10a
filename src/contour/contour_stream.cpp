// SPDX-License-Identifier: MIT
#include "contour/contour_stream.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/cancel.h"

namespace deliso {
namespace {

using std::size_t;

// One bit per sample of a layer. Rows are padded to whole words and one empty word more, so that
// the word after any word of a row may be read.
class LayerBits {
 public:
  LayerBits(int nx, int ny)
      : nx_(nx), words_((nx + 63) / 64), stride_(words_ + 1), bits_(size_t(stride_) * size_t(ny)) {
    buffer_.resize(static_cast<std::size_t>(words_) * 64);
  }

  const std::uint64_t* row(int j) const { return bits_.data() + std::size_t(stride_) * size_t(j); }

  // Sets row j to the bits of row (j, k) of the volume.
  void load_row(const Volume& volume, int j, int k, double kappa) {
    // First bytes, in a loop that vectorizes; then eight bytes at a time into bits.
    std::uint8_t* inside = buffer_.data();
    volume.visit([&](const auto* samples) {
      using T = std::remove_cvref_t<decltype(*samples)>;
      const std::optional<T> threshold = inside_threshold<T>(kappa);
      const T* row = samples + volume.index(0, j, k);
      const int n = threshold ? nx_ : 0;  // without one all samples are outside
      for (int i = 0; i < n; ++i) inside[i] = row[i] >= *threshold;
    });
    const std::uint8_t* next = inside;
    std::uint64_t* out = bits_.data() + std::size_t(stride_) * size_t(j);
    for (int w = 0; w < words_; ++w) {
      std::uint64_t word = 0;
      for (int byte = 0; byte < 8; ++byte) {
        std::uint64_t eight;
        std::memcpy(&eight, next, 8);
        next += 8;
        word |= (eight * kGather >> 56) << (8 * byte);
      }
      out[w] = word;
    }
  }

 private:
  // The product's top byte holds the lowest bits of the eight bytes, in order of address.
  static constexpr std::uint64_t kGather =
      std::endian::native == std::endian::little ? 0x0102040810204080u : 0x8040201008040201u;

  int nx_, words_, stride_;
  std::vector<std::uint64_t> bits_;
  std::vector<std::uint8_t> buffer_;
};

// Keeps two layers of samples as bits (inside or not), and for each grid edge between them a slot
// with the vertex on it. So it needs no hash table.
class ContourStream {
 public:
  ContourStream(const Volume& volume, double kappa, ContourSink& sink)
      : volume_(volume),
        kappa_(kappa),
        sink_(sink),
        dims_(volume.dims()),
        layers_{LayerBits(dims_.i, dims_.j), LayerBits(dims_.i, dims_.j)} {}

  WalkResult run() {
    if (dims_.i < 2 || dims_.j < 2 || dims_.k < 2) return {};
    for (auto& slots : slots_) slots.resize(volume_.index(0, 0, 1));
    for (int k = 0; k < dims_.k; ++k) {
      throw_if_canceled();
      aim_slots(k - 1);
      for (int j = 0; j < dims_.j; ++j) {
        layers_[k & 1].load_row(volume_, j, k, kappa_);
        cross_edges(j, k);
        if (j > 0 && k > 0) walk_row(j - 1, k - 1);
      }
    }
    sink_.replace_boundary(found_.boundary);
    return std::move(found_);
  }

 private:
  struct Slot {
    ContourId vertex;
    std::uint32_t label;  // kNoId before its first voxel
  };
  const std::uint64_t* row(int j, int k) const { return layers_[k & 1].row(j); }
  // Returns the slots of the edges along an axis from layer k. Those along z have one layer.
  std::vector<Slot>& slots(int axis, int k) { return slots_[axis == 2 ? 4 : 2 * axis + (k & 1)]; }
  std::size_t in_layer(int i, int j) const { return volume_.index(i, j, 0); }
  double value(Index3 at) const { return volume_.sample(at.i, at.j, at.k) - kappa_; }

  // Calls visit(i) for every bit set in bits(w), below `limit`.
  template <class Bits, class Visit>
  static void for_each_bit(int limit, Bits bits, Visit visit) {
    for (int w = 0; 64 * w < limit; ++w) {
      std::uint64_t rest = bits(w);
      if (limit - 64 * w < 64) rest &= (std::uint64_t{1} << (limit - 64 * w)) - 1;
      for (; rest != 0; rest &= rest - 1) visit(64 * w + std::countr_zero(rest));
    }
  }

  // Returns the bits of the next samples along x.
  static std::uint64_t shifted(const std::uint64_t* row, int w) {
    return row[w] >> 1 | row[w + 1] << 63;
  }

  void add_crossing(int axis, Index3 sample) {
    Index3 end = sample;
    ++end[axis];
    const unsigned faces = outer_faces(sample, dims_) & ~(3u << (2 * axis));
    const ContourId vertex =
        sink_.crossing(axis, sample, value(sample), value(end), static_cast<std::uint8_t>(faces));
    slots(axis, sample.k)[in_layer(sample.i, sample.j)] = {vertex, kNoId};
  }

  // Adds vertices on the grid edges that row (j, k) completes.
  void cross_edges(int j, int k) {
    const std::uint64_t* const here = row(j, k);
    const auto cross_from = [&](int axis, int from_j, int from_k) {
      const std::uint64_t* const from = row(from_j, from_k);
      for_each_bit(
          dims_.i, [&](int w) { return from[w] ^ here[w]; },
          [&](int i) {
            add_crossing(axis, {i, from_j, from_k});
          });
    };
    if (k > 0) cross_from(2, j, k - 1);
    if (j > 0) cross_from(1, j - 1, k);
    for_each_bit(
        dims_.i - 1, [&](int w) { return here[w] ^ shifted(here, w); },
        [&](int i) {
          add_crossing(0, {i, j, k});
        });
  }

  // Visits the active voxels of row (j, k).
  void walk_row(int j, int k) {
    const std::uint64_t* rows[4] = {row(j, k), row(j + 1, k), row(j, k + 1), row(j + 1, k + 1)};
    for (int w = 0; 64 * w < dims_.i; ++w) {
      std::uint64_t near[4], far[4], any = 0, all = ~std::uint64_t{0};
      for (int r = 0; r < 4; ++r) {
        near[r] = rows[r][w];
        far[r] = shifted(rows[r], w);
        any |= near[r] | far[r];
        all &= near[r] & far[r];
      }
      std::uint64_t active = any & ~all;
      const int valid = dims_.i - 1 - 64 * w;
      if (valid < 64) active &= (std::uint64_t{1} << valid) - 1;
      for (; active != 0; active &= active - 1) {
        const int b = std::countr_zero(active);
        int mask = 0;
        for (int r = 0; r < 4; ++r) {
          mask |= static_cast<int>((near[r] >> b & 1) | (far[r] >> b & 1) << 1) << (2 * r);
        }
        walk_voxel({64 * w + b, j, k}, mask);
      }
    }
  }

  // Sets for each edge of a voxel the array of its slot, offset so that the voxel's place is the
  // index.
  void aim_slots(int k) {
    for (int e = 0; e < 12; ++e) {
      const int m = corners_of_edge(e)[0];
      edge_slots_[e] = slots(e / 4, k + (m >> 2)).data() + in_layer(m & 1, m >> 1 & 1);
    }
  }

  void walk_voxel(Index3 voxel, int mask) {
    const VoxelValues values(volume_.corners(voxel), kappa_);
    ++found_.active_voxels;
    const VoxelLoops loops = voxel_loops(mask, values);
    const Tube tube = loops.count > 1 ? find_tube(mask, values, loops) : Tube{};
    VoxelPieces pieces(voxel, values.above, loops, tube);
    auto& vertex = pieces.vertex;
    for (int l = 0; l < loops.count; ++l) {
      if (tube && l == tube.b) continue;
      std::uint32_t label = join(voxel, loops.edges(l), vertex.data() + loops.first[l], kNoId);
      const bool is_tube = tube && l == tube.a;
      if (is_tube) {
        label = join(voxel, loops.edges(tube.b), vertex.data() + loops.first[tube.b], label);
      }
      found_.components.counts(label).add(
          {.pieces = 1, .tubes = is_tube, .first = voxel, .lo = voxel, .hi = voxel});
      count_sides(voxel, loops, l, vertex, label);
      pieces.label[l] = label;
      if (is_tube) {
        count_sides(voxel, loops, tube.b, vertex, label);
        pieces.label[tube.b] = label;
      }
    }
    sink_.voxel(pieces);
  }

  // Writes the loop's vertices to `out` and makes them one component, united with that of `label`
  // unless it is kNoId. Returns its root.
  std::uint32_t join(Index3 voxel, std::span<const std::uint8_t> edges, ContourId* out,
                     std::uint32_t label) {
    const std::size_t place = in_layer(voxel.i, voxel.j);
    std::array<Slot*, 12> slots;
    std::size_t new_crossings = 0;
    for (std::size_t n = 0; n < edges.size(); ++n) {
      slots[n] = edge_slots_[edges[n]] + place;
      out[n] = slots[n]->vertex;
      if (slots[n]->label == kNoId) {
        ++new_crossings;
        continue;
      }
      const std::uint32_t root = found_.components.root(slots[n]->label);
      label = label == kNoId ? root : found_.components.unite(label, root);
    }
    if (label == kNoId) label = found_.components.add(voxel);
    for (std::size_t n = 0; n < edges.size(); ++n) slots[n]->label = label;
    found_.components.counts(label).crossings += new_crossings;
    return label;
  }

  void count_sides(Index3 voxel, const VoxelLoops& loops, int l,
                   const std::array<ContourId, 12>& vertex, std::uint32_t label) {
    const int first = loops.first[l], end = loops.first[l + 1];
    auto& counts = found_.components.counts(label);
    counts.half_sides += static_cast<std::uint64_t>(end - first);
    const unsigned on_box = outer_faces(voxel, volume_.voxels());
    if (on_box == 0) return;
    for (int n = first; n < end; ++n) {
      const std::uint8_t face = loops.face[n];
      if ((on_box >> face & 1) == 0) continue;
      ++counts.half_sides;
      found_.boundary.push_back({vertex[n], vertex[n + 1 < end ? n + 1 : first], label, face});
    }
  }

  const Volume& volume_;
  double kappa_;
  ContourSink& sink_;
  Index3 dims_;
  std::array<LayerBits, 2> layers_;
  std::array<std::vector<Slot>, 5> slots_;
  std::array<Slot*, 12> edge_slots_{};
  WalkResult found_;
};

}  // namespace

WalkResult walk_contour(const Volume& volume, double kappa, ContourSink& sink) {
  return ContourStream(volume, kappa, sink).run();
}

}  // namespace deliso
