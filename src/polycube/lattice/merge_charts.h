// Charts of the polycube that the deformation squeezed to nearly nothing.
#pragma once

#include "polycube/lattice/lattice.h"

namespace hexwright::polycube {

/// Gives the facets of every chart with less than a quarter of a lattice square (`spacing` squared)
/// to the neighbouring chart whose plane they stray least from, and renumbers the charts, whose
/// coordinates must have been measured and are to be measured anew. No grid can represent such a
/// chart: the deformation closed a step or a slit of the object, and the chart lies folded in the
/// plane of a neighbour. Returns how many charts were given away.
std::size_t merge_small_charts(Lattice& lattice,
                               const IdVector<TriId, std::array<TriId, 3>>& neighbor,
                               double spacing);

}  // namespace hexwright::polycube
