// What and where the named sets of a mesh are, for people who look for their inlet.
#pragma once

#include <string>
#include <vector>

#include "hexwright/io/set_table.h"

namespace hexwright {

/// The shape of a patch, where it is a simple one.
enum class SetShape { Other, Plane, Cylinder };

struct SetSummary {
  SetKind kind = SetKind::Region;
  std::string name;
  std::size_t num_elements = 0;
  double measure = 0;  ///< volume of a region, area of a patch, length of a curve; 0 for corners
  Vec3 centroid;
  SetShape shape = SetShape::Other;
  Vec3 direction;     ///< unit: a plane's normal, outwards; a cylinder's axis
  double radius = 0;  ///< of a cylinder
};

/// In the order of the table: regions, patches, groups of patches, curves, corners. A patch is
/// plane when all its quads face one way within a degree and its vertices are within 1e-3 of the
/// mesh's diagonal of one plane; a cylinder when they face across one axis and its vertices are
/// within 1% of one distance from it, no larger than the diagonal.
std::vector<SetSummary> summarize_sets(const HexMesh& mesh, const SetTable& table);

/// Calls patches without a name by their place where that is plain: patch_xmin, patch_zmax for a
/// plane side of the bounding box, patch_cyl_r2_5 for a cylinder of radius 2.5. A name that two
/// patches would get says nothing: both keep their numbers.
void name_by_place(const HexMesh& mesh, SetTable& table);

/// One object per set: kind, name, elements, measure, centroid, and normal or axis and radius.
std::string sets_to_json(const std::vector<SetSummary>& sets);
/// One line per region and patch.
std::string sets_to_text(const std::vector<SetSummary>& sets);

}  // namespace hexwright
