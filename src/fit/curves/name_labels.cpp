// Every quad gets a group; patches are divided where they hold several.
#include "fit/curves/name_labels.h"

#include <algorithm>
#include <map>

#include "hexwright/base/parallel.h"
#include "hexwright/geometry/surface_names.h"

namespace hexwright::fitting {
namespace {

/// Of the nearest triangle of the quad's own patch; -1 where that has none.
std::vector<std::int32_t> find_groups(const SurfaceTree& tree, const PatchIndex& patches,
                                      const HexMesh& mesh) {
  const auto& quads = mesh.labels.quads;
  std::vector<std::int32_t> groups(quads.size(), -1);
  parallel_for(
      quads.size(),
      [&](std::size_t i) {
        Vec3 center;
        for (VertId v : quads[i].verts) center += mesh.positions[v] * 0.25;
        ClosestFilter filter;
        filter.patch = quads[i].patch;
        filter.patches = &patches;
        if (const auto nearest = tree.closest(center, filter))
          groups[i] = tree.surface().group[nearest->tri];
      },
      64);
  return groups;
}

/// Number of quads per group, of one patch.
using GroupCounts = std::map<std::int32_t, std::size_t>;

/// The group with the most quads, the lowest among equals; none (-1) only when there is no other.
std::int32_t largest_group(const GroupCounts& counts) {
  std::int32_t best = -1;
  std::size_t most = 0;
  for (const auto& [group, count] : counts)
    if (group >= 0 && count > most) {
      best = group;
      most = count;
    }
  return best;
}

/// Divides patches by group and returns the group of each patch. Quads without one stay with the
/// largest part of theirs.
std::vector<std::int32_t> divide_patches(const std::vector<std::int32_t>& groups,
                                         std::vector<LabeledQuad>& quads) {
  std::map<PatchId, GroupCounts> patch_to_counts;
  std::int32_t num_patches = 0;
  for (std::size_t i = 0; i < quads.size(); ++i) {
    if (quads[i].patch.is_valid()) ++patch_to_counts[quads[i].patch][groups[i]];
    num_patches = std::max(num_patches, quads[i].patch.value() + 1);
  }
  std::vector<std::int32_t> patch_to_group(static_cast<std::size_t>(num_patches), -1);
  std::map<std::pair<PatchId, std::int32_t>, PatchId> divided;
  for (const auto& [patch, counts] : patch_to_counts) {
    const std::int32_t largest = largest_group(counts);
    patch_to_group[patch.index()] = largest;
    for (const auto& [group, count] : counts) {
      if (group < 0 || group == largest) continue;
      divided[{patch, group}] = PatchId(patch_to_group.size());
      patch_to_group.push_back(group);
    }
  }
  for (std::size_t i = 0; i < quads.size(); ++i)
    if (const auto found = divided.find({quads[i].patch, groups[i]}); found != divided.end())
      quads[i].patch = found->second;
  return patch_to_group;
}

}  // namespace

void name_labels(const SurfaceTree& tree, const PatchIndex& patches, const FeatureGraph& features,
                 HexMesh& mesh) {
  const TriMesh& surface = tree.surface();
  if (!has_named_patches(surface)) return;
  std::vector<std::string> names;
  for (std::int32_t group : divide_patches(find_groups(tree, patches, mesh), mesh.labels.quads))
    names.push_back(group < 0 ? "" : surface.group_names[static_cast<std::size_t>(group)]);
  number_repeated(names);
  mesh.labels.patch_names = IdVector<PatchId, std::string>(std::move(names));
  mesh.labels.curve_names = name_curves(surface, features);
}

void name_all_patches(const std::string& name, BoundaryLabels& labels) {
  std::size_t num_patches = 0;
  for (const LabeledQuad& quad : labels.quads)
    if (quad.patch.is_valid()) num_patches = std::max(num_patches, quad.patch.index() + 1);
  std::vector<std::string> names(num_patches, name);
  number_repeated(names);
  labels.patch_names = IdVector<PatchId, std::string>(std::move(names));
}

}  // namespace hexwright::fitting
