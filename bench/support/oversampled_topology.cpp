// SPDX-License-Identifier: MIT
#include "support/oversampled_topology.h"

#include <algorithm>
#include <cstddef>
#include <unordered_map>
#include <utility>

#include "base/check.h"
#include "support/sampled_voxel.h"

namespace deliso {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

// The pieces of all voxels, joined through the voxels' faces as they come, in scan order.
class JoinedPieces {
 public:
  explicit JoinedPieces(Index3 voxels) : voxels_(voxels) {
    last_y_.resize(static_cast<std::size_t>(voxels.i));
    last_z_.resize(static_cast<std::size_t>(voxels.i) * static_cast<std::size_t>(voxels.j));
  }

  void add(Index3 v, const VoxelPieces& its) {
    const std::uint32_t first = pieces_.size();  // the number of the voxel's piece 0
    for (const std::int64_t quarters : its.quarters) {
      pieces_.add();
      quarters_.push_back(quarters);
    }
    const auto x = static_cast<std::size_t>(v.i), y = static_cast<std::size_t>(v.j);
    const std::array<FacePieces*, 3> shared{&last_x_, &last_y_[x],
                                            &last_z_[x + static_cast<std::size_t>(voxels_.i) * y]};
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      FacePieces& face = *shared[a];
      // If a face has a crossing, its corners have both signs. So the voxel before was sampled, and
      // `face` is that voxel's.
      const FacePieces& ours = its.on_first_face[a];
      if (v[axis] > 0 && !ours.empty()) {
        DELISO_CHECK(ours.size() == face.size());
        for (std::size_t s = 0; s < ours.size(); ++s) pieces_.unite(first + ours[s], face[s]);
      }
      face = its.on_last_face[a];
      for (std::uint32_t& piece : face) piece += first;
    }
    for (const VoxelPieces::BoxSegment& segment : its.on_box) {
      box_.unite(box_crossing(segment.from, first + segment.piece),
                 box_crossing(segment.to, first + segment.piece));
    }
  }

  std::vector<OversampledComponent> components() {
    std::vector<std::uint32_t> component(pieces_.size(), kNone);
    std::vector<OversampledComponent> components;
    for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece) {
      std::uint32_t& its = component[pieces_.root(piece)];
      if (its == kNone) {
        its = static_cast<std::uint32_t>(components.size());
        components.emplace_back();
      }
      component[piece] = its;
      components[its].euler += quarters_[piece];
    }
    for (OversampledComponent& c : components) {
      DELISO_CHECK(c.euler % 4 == 0);
      c.euler /= 4;
    }
    for (std::uint32_t crossing = 0; crossing < box_.size(); ++crossing) {
      if (box_.root(crossing) != crossing) continue;
      ++components[component[piece_of_box_crossing_[crossing]]].boundary_loops;
    }
    std::sort(components.begin(), components.end());
    return components;
  }

 private:
  using FacePieces = std::vector<std::uint32_t>;

  std::uint32_t box_crossing(std::uint64_t number, std::uint32_t piece) {
    const auto [found, is_new] = box_crossings_.try_emplace(number, box_.size());
    if (is_new) {
      box_.add();
      piece_of_box_crossing_.push_back(piece);
    }
    return found->second;
  }

  Index3 voxels_;
  Sets pieces_;
  std::vector<std::int64_t> quarters_;  // by piece
  // The crossings on the last faces of the voxels before: of one voxel along x, of a row of them
  // along y, of a layer along z.
  FacePieces last_x_;
  std::vector<FacePieces> last_y_, last_z_;
  Sets box_;  // crossings on the box, joined by the segments on it
  std::unordered_map<std::uint64_t, std::uint32_t> box_crossings_;
  std::vector<std::uint32_t> piece_of_box_crossing_;
};

}  // namespace

OversampledTopology oversampled_topology(const Volume& volume, double kappa, int n) {
  DELISO_CHECK(n >= 1 && n <= kMaxOversampling);
  const Index3 voxels = volume.voxels();
  if (voxels.i < 1 || voxels.j < 1 || voxels.k < 1) return {};
  SampledVoxel sampled(volume, kappa, n);
  JoinedPieces apart(voxels), joined(voxels);
  Index3 v;
  for (v.k = 0; v.k < voxels.k; ++v.k) {
    for (v.j = 0; v.j < voxels.j; ++v.j) {
      for (v.i = 0; v.i < voxels.i; ++v.i) {
        if (!sampled.sample(v)) continue;
        const VoxelPieces& pieces = sampled.find_pieces(AlternatingFaces::cut_off_inside);
        apart.add(v, pieces);
        if (pieces.alternate) sampled.find_pieces(AlternatingFaces::cut_off_outside);
        joined.add(v, pieces);
      }
    }
  }
  return {apart.components(), joined.components()};
}

TopologyCounts counts_of(const OversampledComponents& components) {
  TopologyCounts counts;
  counts.components = components.size();
  for (const OversampledComponent& component : components) {
    counts.euler += component.euler;
    counts.boundary_loops += component.boundary_loops;
  }
  return counts;
}

}  // namespace deliso
