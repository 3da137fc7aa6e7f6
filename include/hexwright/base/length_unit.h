// Units that lengths are written in: "2mm".
#pragma once

#include <string>
#include <string_view>

namespace hexwright {

struct LengthUnit {
  const char* name;
  double metres;
};
inline constexpr LengthUnit kLengthUnits[] = {{"um", 1e-6}, {"mm", 1e-3},   {"cm", 1e-2},
                                              {"km", 1e3},  {"in", 0.0254}, {"ft", 0.3048},
                                              {"m", 1}};

/// Takes the name of a unit off the end of the text. Its length in metres; 0 when there is none.
inline double take_unit(std::string_view& text) {
  for (const LengthUnit& unit : kLengthUnits)
    if (text.ends_with(unit.name)) {
      text.remove_suffix(std::string_view(unit.name).size());
      return unit.metres;
    }
  return 0;
}

/// The unit of this length; "" for none.
inline std::string name_of_unit(double metres) {
  for (const LengthUnit& unit : kLengthUnits)
    if (unit.metres == metres) return unit.name;
  return "";
}

}  // namespace hexwright
