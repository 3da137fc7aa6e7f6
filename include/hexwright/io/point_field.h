// Numbers that are given at points of space and hold between them, such as the sizes of cells that
// another program asks for.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "hexwright/base/vec3.h"

namespace hexwright {

struct PointField {
  std::vector<Vec3> points;    ///< where the numbers are known; may be none
  std::vector<double> values;  ///< one per point
  /// Fills in the number at each of the places, infinity where there is none. Empty: the points
  /// alone have one. Equal places must give equal numbers. Called from several threads at once.
  std::function<void(std::span<const Vec3> places, std::span<double> numbers)> between;
};

/// A lattice of points along the axes.
struct PointLattice {
  Vec3 origin;  ///< of point (0, 0, 0)
  /// From each point to the next along each of the lattice's three directions.
  std::array<Vec3, 3> steps = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<std::size_t, 3> counts = {0, 0, 0};
};

/// Trilinear between the points of a lattice, none outside. `values`: one per point, the first
/// direction runs fastest. Throws Error{BadArgument} when their number is another, or the steps
/// lie in a plane.
PointField make_lattice_field(const PointLattice& lattice, std::vector<double> values);

/// Point data of a VTK XML file: an image (.vti), trilinear between its points, or tets, hexes,
/// wedges and pyramids (.vtu), linear in tets, into which the others are cut; elements of other
/// kinds are passed over. `array`: its name; empty: "size", else the only array with one component.
/// Throws Error{CannotOpen}, Error{BadFile} that lists the arrays there are.
PointField read_point_field(const std::filesystem::path& path, const std::string& array = {});

}  // namespace hexwright
