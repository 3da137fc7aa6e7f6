// Shared options of the subcommands.
#include "options.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numbers>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hexwright/base/error.h"
#include "hexwright/io/feature_io.h"

namespace hexwright::cli {
namespace {

/// An option that takes one of a few names.
template <class Enum>
void add_choice(CLI::App& cmd, const std::string& name, Enum& value,
                const std::map<std::string, Enum>& choices, const std::string& help) {
  std::string names, fallback;
  for (const auto& [text, choice] : choices) {
    names += (names.empty() ? "" : "|") + text;
    if (choice == value) fallback = text;
  }
  cmd.add_option_function<std::string>(
         name,
         [&value, choices, names, name](const std::string& text) {
           const auto it = choices.find(text);
           if (it == choices.end())
             throw CLI::ValidationError(name, fmt::format("'{}' is none of {}", text, names));
           value = it->second;
         },
         help + " [" + fallback + "]")
      ->type_name(names);
}

}  // namespace

/// Signs, fractions, exponents and overflow are refused, which the parser alone would let through.
CLI::Validator whole_count() {
  const auto check = [](const std::string& text) {
    std::uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc{} && stop == end && value > 0) return std::string();
    return fmt::format("'{}' is no whole number from 1 up to 2^64; write digits only", text);
  };
  return {check, "COUNT"};
}

/// "0.5%" or "0.005"; a share of 1 or more is nearly always a forgotten percent sign.
double parse_share(const std::string& option, const std::string& text) {
  char* end = nullptr;
  double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str()) throw CLI::ValidationError(option, "'" + text + "' is not a number");
  if (*end == '%') {
    value /= 100;
    ++end;
  }
  if (*end != '\0' || !(value > 0) || !(value < 1))
    throw CLI::ValidationError(
        option, "'" + text + "' is not a share of the diagonal; write e.g. 0.5% or 0.005");
  return value;
}

void add_console_options(CLI::App& cmd, Program& program) {
  cmd.add_flag("-q,--quiet", program.console.is_quiet, "No progress and no summary");
  cmd.add_option("--threads", program.console.num_threads,
                 "Threads to use, 0 = one per core; the result does not depend on it")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
}

void add_sizing_options(CLI::App& cmd, SizingOptions& options) {
  add_choice(cmd, "--sizing", options.sizing,
             {{"deviation", Sizing::Deviation}, {"thickness", Sizing::Thickness}},
             "Where cells are fine: 'deviation' where the surface bends or walls are near, "
             "'thickness' by the shape diameter alone");
  cmd.add_option_function<std::string>(
         "--tolerance",
         [&options](const std::string& text) {
           options.tolerance = parse_share("--tolerance", text);
         },
         "Distance goal as a share of the bounding box's diagonal, 0.5% or 0.005 [0.5%]")
      ->type_name("SHARE");
  cmd.add_option("--min-level", options.min_level, "Cells at the surface are at least this deep")
      ->check(CLI::Range(0, kMaxGridLevel))
      ->capture_default_str();
  cmd.add_option("--max-level", options.max_level, "No cell is deeper")
      ->check(CLI::Range(0, kMaxGridLevel))
      ->capture_default_str();
  cmd.add_option("--max-cells", options.max_cells,
                 "Stop refining, at a whole level, before the grid has more cells")
      ->check(whole_count())
      ->capture_default_str();
}

void add_complete_options(CLI::App& cmd, CompleteOptions& options) {
  add_choice(cmd, "--pairing", options.pairing,
             {{"sheets", Pairing::Sheets},
              {"blocks", Pairing::Blocks},
              {"octree", Pairing::Octree},
              {"none", Pairing::None}},
             "How the grid is made hexmeshable");
  add_choice(cmd, "--balance", options.balance,
             {{"auto", Balance::Auto},
              {"weak", Balance::Weak},
              {"strong", Balance::Strong},
              {"relaxed", Balance::Relaxed}},
             "Cells sharing a face (weak) or also an edge or vertex (strong) differ by at most one "
             "level, or by two (relaxed; for sheets); auto: relaxed for sheets, else weak");
}

void add_placement_option(CLI::App& cmd, TargetOptions& options) {
  add_choice(cmd, "--placement", options.placement,
             {{"faces", Placement::Faces}, {"as-given", Placement::AsGiven}},
             "The lattice along the part's faces, however they are turned (inside only), or along "
             "the given axes");
}

void add_feature_options(CLI::App& cmd, FeatureOptions& options) {
  cmd.add_option_function<double>(
         "--feature-angle",
         [&options](double degrees) { options.crease_angle = degrees * std::numbers::pi / 180; },
         "Edges whose faces turn by more are sharp, degrees [50]")
      ->check(CLI::Range(1.0, 180.0))
      ->type_name("DEG");
}

void add_feature_file_option(CLI::App& cmd, std::string& file) {
  cmd.add_option("--features", file,
                 "Your own creases, besides those by angle: OBJ with 'l' lines, or text with two "
                 "vertex numbers (from 0) of the surface per line");
}

void load_features(const std::string& file, const TriMesh& surface, FeatureOptions& options) {
  if (!file.empty()) options.extra_segments = read_feature_edges(file, surface);
}

void add_fit_options(CLI::App& cmd, FitOptions& options) {
  add_choice(cmd, "--side", options.carve.side,
             {{"inside", Side::Inside}, {"outside", Side::Outside}, {"both", Side::Both}},
             "What to mesh: the object, the box around it, or both with two region tags");
  add_choice(cmd, "--padding", options.padding,
             {{"selective", Padding::Selective}, {"everywhere", Padding::Everywhere}},
             "Where a layer of hexes is put under the boundary");
  add_choice(cmd, "--vertices", options.patch_verts,
             {{"balanced", PatchVerts::Balanced}, {"on-surface", PatchVerts::OnSurface}},
             "Vertices of curved patches: beside the surface, so that quads err to both sides of "
             "it, or on it");
}

bool has_extension(const std::string& path, const std::vector<std::string>& extensions) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

const std::vector<std::string>& grid_extensions() {
  static const std::vector<std::string> kExtensions = {".cells", ".htg", ".vtu", ".mesh"};
  return kExtensions;
}

/// Before the work, like all checks of outputs.
void require_extension(const std::string& path, const std::vector<std::string>& extensions) {
  if (!has_extension(path, extensions))
    throw CLI::ValidationError(fmt::format("cannot write '{}': the extension must be one of {}",
                                           path, fmt::join(extensions, ", ")));
}

TriMesh load_surface(const std::string& path, Program& program) {
  SurfaceFile file = read_surface(path);
  for (const std::string& w : file.warnings) program.console.warn(path + ": " + w);
  return std::move(file.mesh);
}

}  // namespace hexwright::cli
