// Objects that stand on the sides of their domain, or reach through them.
#pragma once

#include "hexwright/target/target.h"

namespace hexwright {

/// Makes what of the target's object lies on the domain's sides or beyond them matter to what is
/// inside and what is outside alone: creases end on the sides, where they have corners; patches do
/// not meet beyond them; and what stands on a side goes on beyond it. `domain`: in the target's
/// coordinates. Nothing changes when all of the object is inside. Same result for any thread count.
void cut_by_domain(const Box3& domain, Target& target);

}  // namespace hexwright
