// SPDX-License-Identifier: MIT
#include "more/bodies/regions.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/sorted_list.h"

namespace deliso {
namespace {

// The sheets in a region.
struct Region {
  std::vector<std::uint32_t> free, fixed;  // facets of all sheets
  std::vector<VertexId> vertices;          // of all sheets, per vertex here
  Sheets sheets;
};

Sheets part_of(const Sheets& all, Region& region) {
  Sheets part;
  for (const auto* facets : {&region.free, &region.fixed}) {
    for (const std::uint32_t f : *facets) part.facets.push_back(all.facets[f]);
  }
  part.free_facets = region.free.size();
  // By sorting: a table of all vertices, as number_vertices() wants it, is too large for each
  // region.
  for (const SheetFacet& f : part.facets) {
    region.vertices.insert(region.vertices.end(), f.v.begin(), f.v.end());
  }
  sort_unique(region.vertices);
  for (SheetFacet& f : part.facets) {
    for (VertexId& v : f.v) {
      v = VertexId(std::ranges::lower_bound(region.vertices, v) - region.vertices.begin());
    }
  }
  for (const VertexId v : region.vertices) part.points.push_back(all.points[v]);
  return part;
}

// Puts the points and the free facets of a region in the place of what they were made of.
void put_back(Region& region, Sheets& all) {
  const std::size_t known = region.vertices.size();
  for (std::size_t v = 0; v < region.sheets.points.size(); ++v) {
    if (v < known) {
      all.points[region.vertices[v]] = region.sheets.points[v];
    } else {
      region.vertices.emplace_back(all.points.size());
      all.points.push_back(region.sheets.points[v]);
    }
  }
  for (std::size_t f = 0; f < region.sheets.free_facets; ++f) {
    SheetFacet facet = region.sheets.facets[f];
    for (VertexId& v : facet.v) v = region.vertices[v];
    all.facets.push_back(facet);
  }
}

}  // namespace

Regions::Regions(const Grid& shape, int side, int shift) : shape_(shape) {
  const Index3 voxels = shape.voxels();
  for (int axis = 0; axis < 3; ++axis) {
    const int n = side > 0 ? std::max(1, (voxels[axis] + side / 2) / side) : 1;
    std::vector<double>& planes = planes_[axis];
    planes.push_back(0);
    for (int k = 0; k < n; ++k) {
      const int from = static_cast<int>(std::int64_t{voxels[axis]} * k / n),
                to = static_cast<int>(std::int64_t{voxels[axis]} * (k + 1) / n);
      const double at = from + 0.25 * shift * (to - from);
      if (n > 1 && at > 0) planes.push_back(shape.at_samples(at, axis));
    }
    planes.push_back(shape.box().hi[axis]);
  }
}

Index3 Regions::planes() const {
  Index3 count;
  for (int axis = 0; axis < 3; ++axis) count[axis] = static_cast<int>(planes_[axis].size());
  return count;
}

std::size_t Regions::size() const {
  const auto [nx, ny, nz] = planes();
  return std::size_t(nx - 1) * (ny - 1) * (nz - 1);
}

Box3 Regions::box(std::size_t region) const {
  const Index3 at = numbered_voxel(planes(), region);
  Box3 box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = planes_[axis][at[axis]];
    box.hi[axis] = planes_[axis][at[axis] + 1];
  }
  return box;
}

SampleBox Regions::samples(std::size_t region) const {
  const Box3 box = this->box(region);
  SampleBox samples;
  for (int axis = 0; axis < 3; ++axis) {
    samples.begin[axis] = static_cast<int>(std::lround(shape_.in_all_samples(box.lo, axis)));
    samples.end[axis] = static_cast<int>(std::lround(shape_.in_all_samples(box.hi, axis)));
  }
  return samples;
}

unsigned Regions::inner_faces(std::size_t region) const {
  constexpr unsigned kAllFaces = 63;
  const Index3 count = planes();
  return kAllFaces ^ outer_faces(numbered_voxel(count, region), count + Index3{-1, -1, -1});
}

void Regions::for_each(Sheets& all, int threads, const Change& change) const {
  std::vector<Region> regions(size());
  std::vector<std::uint8_t> is_taken(all.facets.size());
  const Index3 count = planes();
  const auto cell_of = [&](double at, int axis) {
    const std::vector<double>& planes = planes_[axis];
    return static_cast<int>(std::upper_bound(planes.begin() + 1, planes.end() - 1, at) -
                            planes.begin()) -
           1;
  };
  for (std::uint32_t f = 0; f < all.facets.size(); ++f) {
    const auto& [a, b, c] = all.facets[f].v;
    const Box3 box = box_of(all.points[a], all.points[b], all.points[c]);
    Index3 lo, hi;
    bool is_in_one = true;
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = cell_of(box.lo[axis], axis);
      hi[axis] = cell_of(box.hi[axis], axis);
      is_in_one &=
          lo[axis] == hi[axis] && (lo[axis] == 0 || box.lo[axis] > planes_[axis][lo[axis]]);
    }
    for_each_place(lo, hi, [&](Index3 at) {
      Region& region = regions[voxel_number(count, at)];
      (is_in_one ? region.free : region.fixed).push_back(f);
    });
  }
  for_each_task(threads, regions.size(), [&](std::size_t n) {
    Region& region = regions[n];
    if (std::ranges::all_of(region.free, [&](std::uint32_t f) { return all.facets[f].is_done; })) {
      region.free.clear();
      return;
    }
    region.sheets = part_of(all, region);
    change(region.sheets, n);
  });
  std::vector<SheetFacet> left;
  for (const Region& region : regions) {
    for (const std::uint32_t f : region.free) is_taken[f] = 1;
  }
  for (std::size_t f = 0; f < all.facets.size(); ++f) {
    if (is_taken[f] == 0) left.push_back(all.facets[f]);
  }
  all.facets = std::move(left);
  for (Region& region : regions) {
    if (!region.free.empty()) put_back(region, all);
  }
  all.free_facets = all.facets.size();
}

}  // namespace deliso
