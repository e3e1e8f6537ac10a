// SPDX-License-Identifier: MIT
#include "app/topology.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <span>
#include <vector>

#include "app/text.h"
#include "base/text.h"
#include "io/files/append_format.h"

namespace deliso {
namespace {

constexpr std::size_t kClassesShown = 10;
constexpr std::size_t kListed = 100;  // in JSON

// The components whose longest side has lo to 2 lo - 1 voxels.
struct SizeClass {
  int lo = 1;
  std::uint64_t count = 0, crossings = 0;
};

// The same order as that of --largest (contour/contour.h, chosen_components).
std::vector<ContourComponent> largest_first(const ContourSummary& surface) {
  std::vector<ContourComponent> sorted = surface.components;
  std::ranges::stable_sort(sorted, std::ranges::greater(), &ContourComponent::crossings);
  return sorted;
}

std::vector<SizeClass> size_classes(const ContourSummary& surface) {
  std::vector<SizeClass> classes;
  for (const ContourComponent& c : surface.components) {
    const auto n = static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(c.side())) - 1);
    while (classes.size() <= n) classes.push_back({1 << classes.size()});
    ++classes[n].count;
    classes[n].crossings += c.crossings;
  }
  return classes;
}

std::uint64_t crossings_of(std::span<const ContourComponent> components) {
  std::uint64_t sum = 0;
  for (const ContourComponent& c : components) sum += c.crossings;
  return sum;
}

double share(std::uint64_t part, std::uint64_t whole) {
  return static_cast<double>(part) / static_cast<double>(std::max<std::uint64_t>(1, whole));
}

Index3 extent(const ContourComponent& c) {
  return {1 + c.hi.i - c.lo.i, 1 + c.hi.j - c.lo.j, 1 + c.hi.k - c.lo.k};
}

}  // namespace

std::string topology_text(const TopologyCounts& topology) {
  return counted(topology.components, "component") + ", Euler number " +
         std::to_string(topology.euler) + ", " + counted(topology.boundary_loops, "boundary loop");
}

void add_topology(ReportWriter& out, std::string_view key, const TopologyCounts& topology,
                  std::string_view words) {
  out.open(key, words);
  out.add("components", topology.components, "connected ones");
  out.add("euler", topology.euler, "V - E + F of all components together");
  out.add("boundary_loops", topology.boundary_loops, "closed curves in which it ends");
  out.close();
}

std::string components_text(const ContourSummary& surface) {
  if (surface.components.size() < 2) return {};
  const std::vector<ContourComponent> sorted = largest_first(surface);
  const std::uint64_t whole = crossings_of(sorted);
  std::string table = "largest   share      voxels             Euler number  boundary loops\n";
  const std::size_t rows = std::min(kClassesShown, sorted.size());
  for (std::size_t n = 0; n < rows; ++n) {
    const ContourComponent& c = sorted[n];
    const Index3 e = extent(c);
    const std::string voxels = text(e.i, " x ", e.j, " x ", e.k);
    append_format(table, "%7zu   %7.3f %%  %-18s %12lld  %14llu\n", n + 1,
                  100 * share(c.crossings, whole), voxels.c_str(), static_cast<long long>(c.euler),
                  static_cast<unsigned long long>(c.boundary_loops));
  }
  if (rows < sorted.size()) {
    append_format(table, "   rest   %7.3f %%  %s\n",
                  100 * share(crossings_of(std::span(sorted).subspan(rows)), whole),
                  counted(sorted.size() - rows, "component").c_str());
  }
  table += "sizes     longest side in voxels   components   share\n";
  for (const SizeClass& c : size_classes(surface)) {
    if (c.count == 0) continue;
    const std::string side = c.lo == 1 ? "1" : text(c.lo, " to ", 2 * c.lo - 1);
    append_format(table, "          %-22s   %10llu   %7.3f %%\n", side.c_str(),
                  static_cast<unsigned long long>(c.count), 100 * share(c.crossings, whole));
  }
  return table;
}

void add_components(ReportWriter& out, const ContourSummary& surface) {
  std::vector<ContourComponent> sorted = largest_first(surface);
  const std::uint64_t whole = crossings_of(sorted);
  constexpr std::string_view kShare = "of the grid edges that the surface crosses";
  sorted.resize(std::min(kListed, sorted.size()));
  out.add_objects("largest_components", "one of a hundred at most, in the order of --largest",
                  sorted, [&](const ContourComponent& c) {
                    out.add("share", share(c.crossings, whole), kShare, Rule::not_negative);
                    out.add("first_voxel", c.lo, "the lowest corner of the voxels it meets, x y z",
                            Rule::not_negative);
                    out.add("last_voxel", c.hi, "the highest corner of the voxels it meets, x y z",
                            Rule::not_negative);
                    out.add("euler", c.euler, "V - E + F");
                    out.add("boundary_loops", c.boundary_loops, "closed curves in which it ends");
                  });
  out.add_objects(
      "component_sizes", "how many components there are of a size", size_classes(surface),
      [&](const SizeClass& c) {
        out.add("longest_side_from", c.lo, "of the component's box; voxels", Rule::positive);
        out.add("longest_side_to", 2 * c.lo - 1, "of the component's box; voxels", Rule::positive);
        out.add("components", c.count, "connected ones");
        out.add("share", share(c.crossings, whole), kShare, Rule::not_negative);
      });
}

}  // namespace deliso
