// SPDX-License-Identifier: BSD-3-Clause
/// Physical groups: their names, and the regions of cells that they define.
#include <algorithm>
#include <array>
#include <map>

#include "rondo/core/index.hpp"
#include "rondo/core/text/edit_distance.hpp"
#include "rondo/mesh/gmsh_draft.hpp"
#include "rondo/mesh/physical_group.hpp"

namespace rondo::mesh {
namespace {

constexpr std::array<const char*, 4> kinds{"point", "curve", "surface", "volume"};

std::string in_quotes(std::string_view name) {
  return fmt::format("\"{}\"", name);
}

/// "curves "foot", "top"; surfaces "block""
std::string all_names(const std::vector<NamedGroup>& groups) {
  std::string text;
  for (std::size_t dimension = 0; dimension < kinds.size(); ++dimension) {
    std::vector<std::string> names;
    for (const NamedGroup& group : groups)
      if (group.dimension == static_cast<int>(dimension)) names.push_back(in_quotes(group.name));
    if (names.empty()) continue;
    constexpr std::size_t most = 20;
    const std::size_t shown = std::min(most, names.size());
    text += fmt::format("{}{}s {}", text.empty() ? "" : "; ", kinds[dimension],
                        fmt::join(names.begin(), names.begin() + std::ptrdiff_t(shown), ", "));
    if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
  }
  return text.empty() ? "the file has no physical group" : "the file has " + text;
}

std::string probably_meant(const std::vector<NamedGroup>& groups, int dimension,
                           std::string_view name) {
  constexpr std::size_t longest = 100;
  if (name.size() > longest) return {};
  std::string_view best;
  std::size_t least = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const NamedGroup& group : groups) {
    if (group.dimension != dimension || group.name.size() > longest) continue;
    const std::size_t distance = edit_distance(name, group.name);
    if (distance >= least) continue;
    least = distance;
    best = group.name;
  }
  return best.empty() ? std::string{} : fmt::format("; did you mean {}?", in_quotes(best));
}

void check_name(const std::string& key, const std::string& name, int dimension,
                const std::vector<NamedGroup>& groups, Findings& findings) {
  const char* const kind = kinds[at(dimension)];
  const NamedGroup* const found = find_group(groups, dimension, name);
  if (found != nullptr && !found->empty) return;
  Fault fault;
  fault.file = findings.file;
  fault.key = key;
  fault.found = in_quotes(name);
  fault.message = fmt::format("there is no physical {} of this name", kind);
  if (found != nullptr) {
    fault.message = fmt::format("this physical {} has no elements", kind);
  } else {
    const auto other = std::ranges::find(groups, name, &NamedGroup::name);
    if (other != groups.end())
      fault.message =
          fmt::format("this is a physical {}, not a {}", kinds[at(other->dimension)], kind);
  }
  fault.allowed = all_names(groups) + probably_meant(groups, dimension, name);
  if (found == nullptr && (dimension == 1 || dimension == 2))
    fault.allowed +=
        "; to define one, " + physical_group_line(dimension == 1 ? "Curve" : "Surface", name);
  findings.faults.push_back(std::move(fault));
}

void name_overlaps(const RawMesh& raw, const std::vector<NamedGroup>& groups,
                   const std::vector<std::vector<std::size_t>>& of_entity, Findings& findings) {
  std::vector<std::string> overlaps;
  for (std::size_t k = 0; k < raw.entities.size(); ++k) {
    if (of_entity[k].size() < 2) continue;
    std::string names;
    for (const std::size_t g : of_entity[k])
      names += (names.empty() ? "" : " and ") + in_quotes(groups[g].name);
    overlaps.push_back(fmt::format("surface {} is in {}", raw.entities[k].tag, names));
  }
  if (overlaps.empty()) return;
  findings.add(fmt::format("cells are in more than one physical surface: {}",
                           examples(overlaps.size(), [&](std::size_t k) { return overlaps[k]; })),
               "one physical surface for each cell; in MSH 2.2 also another elementary tag (the "
               "second tag of an element) in each physical surface");
}

}  // namespace

std::vector<NamedGroup> named_groups(const RawMesh& raw) {
  std::vector<RawGroup> sorted = raw.groups;
  std::ranges::sort(sorted, {}, [](const RawGroup& g) { return std::pair{g.dimension, g.tag}; });
  std::vector<NamedGroup> groups;
  std::map<std::pair<int, std::string>, std::size_t> by_name;
  std::map<std::pair<int, int>, std::size_t> by_tag;
  for (const RawGroup& group : sorted) {
    if (group.dimension < 0 || group.dimension > 3) continue;
    const std::string name = group.name.empty() ? fmt::format("{}", group.tag) : group.name;
    const auto [at, fresh] = by_name.try_emplace({group.dimension, name}, groups.size());
    if (fresh)
      groups.push_back(
          {.dimension = group.dimension, .name = name, .tags = {}, .entities = {}, .empty = true});
    groups[at->second].tags.push_back(group.tag);
    by_tag.try_emplace({group.dimension, group.tag}, at->second);
  }
  std::vector<char> filled(raw.entities.size(), 0);
  for (const RawBlock& block : raw.blocks)
    if (!block.tags.empty()) filled[block.entity] = 1;
  for (std::size_t k = 0; k < raw.entities.size(); ++k)
    for (const int tag : raw.entities[k].groups) {
      const auto at = by_tag.find({raw.entities[k].dimension, tag});
      if (at == by_tag.end()) continue;
      NamedGroup& group = groups[at->second];
      if (group.entities.empty() || group.entities.back() != k) group.entities.push_back(k);
      group.empty = group.empty && filled[k] == 0;
    }
  return groups;
}

namespace {

/// MSH 4.1 also lists surfaces in no physical group, whose elements are not saved with groups.
void warn_of_empty_surfaces(const RawMesh& raw, Findings& findings) {
  std::vector<char> filled(raw.entities.size(), 0);
  for (const RawBlock& block : raw.blocks)
    if (!block.tags.empty()) filled[block.entity] = 1;
  std::vector<int> empty;
  std::size_t all = 0;
  for (std::size_t k = 0; k < raw.entities.size(); ++k) {
    if (raw.entities[k].dimension != 2) continue;
    ++all;
    if (!filled[k]) empty.push_back(raw.entities[k].tag);
  }
  if (empty.empty() || empty.size() == all) return;
  findings.warnings.push_back(fmt::format(
      "{} of {} surfaces of the geometry have no elements in the file and are not part of the "
      "body: surface {}. Where there are physical groups, Gmsh saves what is in one of them; to "
      "have the others too, {}",
      empty.size(), all,
      examples(empty.size(), [&](std::size_t k) { return fmt::format("{}", empty[k]); }),
      physical_group_line("Surface", "body")));
}

}  // namespace

void warn_of_groups(const RawMesh& raw, const std::vector<NamedGroup>& groups, Findings& findings) {
  for (const NamedGroup& group : groups) {
    if (group.tags.size() < 2) continue;
    findings.warnings.push_back(
        fmt::format("{} physical {}s have the name {} (numbers {}): they are taken as one",
                    group.tags.size(), kinds[at(group.dimension)], in_quotes(group.name),
                    examples(group.tags.size(),
                             [&](std::size_t k) { return fmt::format("{}", group.tags[k]); })));
  }
  warn_of_empty_surfaces(raw, findings);
}

const NamedGroup* find_group(const std::vector<NamedGroup>& groups, int dimension,
                             std::string_view name) {
  for (const NamedGroup& group : groups)
    if (group.dimension == dimension && group.name == name) return &group;
  return nullptr;
}

void check_names(const MeshRequest& request, const std::vector<NamedGroup>& groups,
                 Findings& findings) {
  for (const std::string& name : request.clamped) check_name("clamped", name, 1, groups, findings);
  if (!request.contact.empty()) check_name("contact", request.contact, 1, groups, findings);
  for (const std::string& name : request.curves) check_name("curve", name, 1, groups, findings);
  for (const std::string& name : request.lines) check_name("curve", name, 1, groups, findings);
  for (const std::string& name : request.surfaces) check_name("surface", name, 2, groups, findings);
}

void add_regions(const RawMesh& raw, const std::vector<NamedGroup>& groups, Draft& draft,
                 Findings& findings) {
  std::vector<std::vector<std::size_t>> of_entity(raw.entities.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (groups[g].dimension == 2)
      for (const std::size_t k : groups[g].entities) of_entity[k].push_back(g);
  name_overlaps(raw, groups, of_entity, findings);

  Mesh& mesh = draft.mesh;
  std::vector<int> place(groups.size() + 1, -1);  // last: cells in no physical surface
  const auto group_of = [&](std::size_t cell) {
    const auto& of = of_entity[draft.cell_entity[cell]];
    return of.empty() ? groups.size() : of.front();
  };
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) place[group_of(e)] = 0;
  if (std::ranges::find(place.begin(), place.end() - 1, 0) == place.end() - 1) return;
  for (std::size_t g = 0; g < place.size(); ++g) {
    if (place[g] < 0) continue;
    place[g] = static_cast<int>(mesh.region_names.size());
    mesh.region_names.push_back(g < groups.size() ? groups[g].name : "");
  }
  mesh.region.reserve(mesh.cells.size());
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) mesh.region.push_back(place[group_of(e)]);
}

}  // namespace rondo::mesh
