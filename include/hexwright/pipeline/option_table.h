// The options of every stage by name: one table from which the command line, the Python package and
// their documentation are made.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "hexwright/pipeline/evaluate.h"
#include "hexwright/pipeline/mesh_surface.h"
#include "hexwright/pipeline/polycube_map.h"
#include "hexwright/pipeline/stages.h"
#include "hexwright/polycube/polycube.h"
#include "hexwright/relax/improve.h"

namespace hexwright {

/// What may be written for an option.
enum class OptionKind {
  Flag,     ///< given or not; as text "true" or "false"
  Whole,    ///< a whole number: digits only
  Number,   ///< a finite number
  Share,    ///< of the bounding box's diagonal, above 0 and below 1: "0.5%" or "0.005"
  Length,   ///< above 0, in the surface's unit, or a share of the diagonal: "2" or "1%"
  Degrees,  ///< an angle
  Choice,   ///< one of a few names
  File,     ///< the name of a file
  Text,     ///< in a form of its own
  List      ///< the same, repeated: one per line
};

/// One option, bound to the struct that its table was made for.
struct NamedOption {
  std::string name;  ///< "max-level": --max-level on the command line, max_level in Python
  OptionKind kind = OptionKind::Flag;
  std::string allowed;  ///< the range, or the names with '|' between them; for people
  std::string
      fallback;      ///< the default as text; "false" for a flag, "none" where nothing is asked for
  std::string help;  ///< one sentence without its full stop
  /// Takes the value as text. Throws Error{BadArgument}, without the option's name, when it is not
  /// what the option allows; the struct is unchanged then.
  std::function<void(const std::string& text)> set;
};

/// In the order in which they are applied and listed: later rows win where two set the same field.
using OptionTable = std::vector<NamedOption>;

/// The tables. Each refers to the struct, which must outlive it; its values are the defaults.
OptionTable make_option_table(MeshOptions& options);
/// Of the grid alone: sizing and features.
OptionTable make_grid_option_table(MeshOptions& options);
/// Of `hexwright inspect`: what decides what a surface becomes before it is meshed.
OptionTable make_inspect_option_table(MeshOptions& options);
OptionTable make_option_table(CompleteOptions& options);
OptionTable make_option_table(DualStageOptions& options);
OptionTable make_option_table(FitStageOptions& options);
OptionTable make_option_table(ImproveOptions& options);
OptionTable make_option_table(PolycubeOptions& options);
OptionTable make_option_table(PolycubeMapOptions& options);
/// Of the judge: which creases count.
OptionTable make_option_table(FeatureOptions& options);
OptionTable make_option_table(EvaluateOptions& options);

/// The row of this name; absent rows give null.
const NamedOption* find_option(const OptionTable& table, std::string_view name);

/// A share of the diagonal: "0.5%" or "0.005". Throws Error{BadArgument}.
double parse_share(const std::string& text, bool zero_allowed = false);

/// "0.5%" for 0.005.
std::string share_to_text(double share);

}  // namespace hexwright
