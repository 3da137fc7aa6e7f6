// Where rules about sizes hold: places become bounds of cells.
#pragma once

#include "hexwright/pipeline/mesh_surface.h"

namespace hexwright {

/// The bound of a rule in the target's unit coordinates: cells that may come within the rule's
/// distance of its place are no larger than its size. Regions have their triangles.
/// The target must outlive the bound. Errors: BadArgument when the rule names no patch or curve of
/// the target; also of the bound, when a field's size is no length.
SizeField::Limit limit_by_rule(const SizeRule& rule, const Target& target);

/// Cells that meet the surface, or the inside where that is meshed as well, are no larger than
/// `size`, of the target's unit. The target must outlive the bound.
SizeField::Limit limit_at_object(const Target& target, Side side, double size);

/// A length of the wishes in the target's unit.
double to_unit(const Length& length, const Target& target);

/// Regions that are names get the triangles of the groups so called, in the surface's coordinates;
/// `inside` and `outside`, where no group is called so, all of them. Errors: BadArgument when there
/// is no such group or its triangles enclose nothing.
void find_regions(std::vector<SizeRule>& rules, const Target& target);

/// Throws Error{BadArgument} that names the rule unless its triangles are closed.
void require_closed(const SizeRule& rule, const TriMesh& region);

}  // namespace hexwright
