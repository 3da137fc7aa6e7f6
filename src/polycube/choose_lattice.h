// Which lattice a map is sampled on, and how closely for a wanted number of hexes.
#pragma once

#include "hexwright/base/context.h"
#include "hexwright/dual/dual_mesh.h"
#include "hexwright/polycube/polycube.h"

#include "polycube/lattice/lattice.h"

namespace hexwright::polycube {

/// An even lattice where the options say how fine everything is (a spacing, or equal least and
/// greatest levels); otherwise the one that suits the map best and folds no tet that was not folded
/// before. Levels are meant from cubes of the polycube's own spacing, so roots that are finer take
/// their depth off the options' limits. Errors: those of find_faces() and place_on_lattice().
Lattice choose_lattice(const TetMesh& object, const TetMesh& polycube, PolycubeOptions& options);

/// The max_stretch at which the mesh has about options.target_hexes hexes, rather fewer than more.
double find_stretch(const TetMesh& object, const TetMesh& polycube, const PolycubeOptions& options,
                    const Context& context);

/// The hex mesh of a completed grid, by the mode its completion was made for.
DualResult make_dual(const Grid& grid, const PolycubeOptions& options, const Context& context);

}  // namespace hexwright::polycube
