// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/tyre/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

using Neighbours = std::map<int, std::vector<int>>;  ///< of each node of a curve

Neighbours neighbours_of(const std::vector<mesh::Edge>& edges) {
  Neighbours all;
  for (const auto& [a, b] : edges) {
    all[a].push_back(b);
    all[b].push_back(a);
  }
  return all;
}

/// The nodes of the chain that begins there, which are taken out.
std::vector<int> take_chain(int first, Neighbours& left) {
  std::vector<int> chain{first};
  for (int node = first;;) {
    const std::vector<int> there = left[node];
    left.erase(node);
    const auto next = std::ranges::find_if(there, [&](int other) { return left.contains(other); });
    if (next == there.end()) return chain;
    chain.push_back(node = *next);
  }
}

}  // namespace

const std::vector<mesh::Edge>& section_curve(const Case& c, const mesh::Mesh& section,
                                             const std::string& key, const std::string& name) {
  std::string names;
  for (const mesh::Curve& curve : section.curves) {
    if (curve.name == name) return curve.edges;
    names += (names.empty() ? "" : ", ") + fmt::format("\"{}\"", curve.name);
  }
  throw case_error(c, key, "there is no curve of this name in the section of the wheel", names);
}

std::string place_text(const mesh::Mesh& section, int node) {
  const Vec2 x = section.coordinates[at(node)];
  return fmt::format("r = {:.6g}, z = {:.6g} m", x.x, x.y);
}

std::vector<int> ends_of(const std::vector<mesh::Edge>& edges) {
  std::vector<int> ends;
  for (const auto& [node, others] : neighbours_of(edges))
    if (others.size() % 2 == 1) ends.push_back(node);
  return ends;
}

std::vector<mesh::Edge> directed_curve(const Case& c, const mesh::Mesh& section,
                                       const std::string& key, const std::string& name) {
  const std::vector<mesh::Edge>& edges = section_curve(c, section, key, name);
  Neighbours left = neighbours_of(edges);
  for (const auto& [node, others] : left)
    if (others.size() > 2)
      throw case_error(c, key,
                       fmt::format("the curve branches at {}: cords go on in one direction alone",
                                   place_text(section, node)),
                       "a curve without branches; [[cords]] of its own for each branch");
  std::vector<mesh::Edge> directed;
  for (const int end : ends_of(edges)) {
    if (!left.contains(end)) continue;  // the other end of a chain
    std::vector<int> chain = take_chain(end, left);
    const Vec2 a = section.coordinates[at(chain.front())],
               b = section.coordinates[at(chain.back())];
    if (a.y > b.y || (a.y == b.y && a.x > b.x)) std::ranges::reverse(chain);
    for (std::size_t i = 1; i < chain.size(); ++i) directed.push_back({chain[i - 1], chain[i]});
  }
  if (!left.empty())
    throw case_error(c, key,
                     fmt::format("the curve is closed, through {}: its cords have no direction",
                                 place_text(section, left.begin()->first)),
                     "a curve with two ends");
  return directed;
}

}  // namespace rondo::study
