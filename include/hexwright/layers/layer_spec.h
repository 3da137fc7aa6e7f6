// What is asked of the wall layers of some patches.
#pragma once

#include <string>
#include <vector>

namespace hexwright {

/// A length given in one of four ways.
struct LayerLength {
  enum class Unit {
    World,     ///< the surface's own unit
    Diagonal,  ///< a share of the surface's diagonal: "0.1%"
    Edge,      ///< a share of the wall's edges around a vertex: "0.05h"
    Metre      ///< "2mm", whatever the surface's unit is
  };
  double value = 0;
  Unit unit = Unit::World;
  friend bool operator==(const LayerLength&, const LayerLength&) = default;
};

/// `count` layers, the first of height `first` at the wall, each `growth` times as high as the one
/// before.
struct LayerSpec {
  std::string pattern;  ///< of the names of patches (base/name_pattern.h)
  LayerLength first;
  double growth = 1;
  int count = 0;

  /// Height of all layers together, in the unit of `first`.
  double total() const;
  /// Height of the first k layers over that of all.
  double share_of(int k) const;
};

constexpr int kMaxLayers = 100;
constexpr double kMaxLayerGrowth = 5;

/// Reads "PATTERN=first:H,growth:R,count:N" with any three of first, growth, count and total; four
/// must agree. Errors: BadArgument, with the keys that are missing or contradict each other.
LayerSpec parse_layer_spec(const std::string& text);

}  // namespace hexwright
