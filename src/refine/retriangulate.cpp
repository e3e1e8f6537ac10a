// SPDX-License-Identifier: MIT
#include "refine/retriangulate.h"

#include <algorithm>

#include "base/sorted_list.h"

namespace deliso {
namespace {

// How many facets are tried to fill a patch, and how many it may have.
constexpr int kMostTried = 80;
constexpr std::size_t kLargestPatch = 40;

template <class T>
bool has(const std::vector<T>& list, const T& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

}  // namespace

bool Retriangulator::in_patch(FaceId f) const {
  return has(change_.out, f);
}

bool Retriangulator::has_empty_ball(const Triangle& v) {
  Triangle key = v;
  std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
  const auto [known, is_new] = empty_.try_emplace(key, false);
  if (is_new) {
    const Dual dual = replacer_.finder().dual(mesh_.points[key[0]], mesh_.points[key[1]],
                                              mesh_.points[key[2]], report_.searches_refine);
    known->second = dual.on_surface && !replacer_.holds_vertex(key, dual);
  }
  return known->second;
}

bool Retriangulator::is_free(VertexId a, VertexId b) const {
  return !has(used_, DirectedEdge{a, b}) && !has(rim_, DirectedEdge{b, a});
}

bool Retriangulator::fill() {
  vertices_.clear();
  rim_.clear();
  used_.clear();
  empty_.clear();
  tried_ = 0;
  change_.in.facets.clear();
  for (const Triangle& t : change_.was.facets)
    vertices_.insert(vertices_.end(), t.begin(), t.end());
  sort_out(vertices_);
  for (const Patch::RimEdge& e : change_.was.rim) rim_.emplace_back(e.from, e.to);
  front_ = rim_;
  return fill_from(0);
}

// From the rim inwards; where two facets would do at an edge, both are tried.
bool Retriangulator::fill_from(std::size_t from) {
  std::vector<Triangle>& filling = change_.in.facets;
  const std::size_t wanted = change_.out.size();
  while (from < front_.size() && has(used_, front_[from])) ++from;
  // As many facets over as many vertices: the Euler number is what it was.
  if (from == front_.size()) return filling.size() == wanted && change_.in.link();
  if (filling.size() == wanted || ++tried_ > kMostTried) return false;
  const auto [u, v] = front_[from];
  for (const VertexId w : vertices_) {
    if (w == u || w == v || !is_free(v, w) || !is_free(w, u) || !has_empty_ball({u, v, w}))
      continue;
    const std::size_t front_before = front_.size(), used_before = used_.size();
    filling.push_back({u, v, w});
    for (const DirectedEdge& e : {DirectedEdge{u, v}, DirectedEdge{v, w}, DirectedEdge{w, u}}) {
      used_.push_back(e);
      if (!has(rim_, e)) front_.emplace_back(e.second, e.first);
    }
    if (fill_from(from + 1)) return true;
    front_.resize(front_before);
    used_.resize(used_before);
    filling.pop_back();
  }
  return false;
}

bool Retriangulator::retriangulate(FaceId f) {
  if (replacer_.is_delaunay(f)) return false;
  change_.out.assign(1, f);
  for (std::size_t n = 0; n < change_.out.size() && change_.out.size() < kLargestPatch; ++n) {
    for (const FaceId g : mesh_.faces[change_.out[n]].n) {
      if (g != kNoId && !in_patch(g) && !replacer_.is_delaunay(g)) change_.out.push_back(g);
    }
  }
  change_.least_cosine = kSharpest;
  std::optional<Refusal> refusal = Refusal::not_a_disk;
  if (replacer_.mark_old(change_)) {
    refusal =
        fill() ? replacer_.replace(change_, [] { return true; }) : std::optional(Refusal::no_gain);
  }
  return !replacer_.count(Rung::patch, change_, refusal);
}

}  // namespace deliso
