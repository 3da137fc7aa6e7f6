// Shared options of the subcommands.
#include "options.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hexwright/base/error.h"
#include "hexwright/geometry/patch_rules.h"
#include "hexwright/io/feature_io.h"
#include "hexwright/io/mesh_io.h"

namespace hexwright::cli {
namespace {

/// What is written behind the option's name in the help.
std::string type_name(const NamedOption& row) {
  switch (row.kind) {
    case OptionKind::Choice:
      return row.allowed;
    case OptionKind::Share:
      return "SHARE";
    case OptionKind::Length:
      return "LENGTH or SHARE";
    case OptionKind::File:
    case OptionKind::Text:
    case OptionKind::List:
      return row.allowed;
    case OptionKind::Degrees:
      return "DEG";
    default:
      return "NUMBER, " + row.allowed;
  }
}

/// What a value cannot be becomes an error of the command line that names the option.
template <class Read>
auto naming_option(const std::string& name, Read&& read) {
  try {
    return read();
  } catch (const Error& e) {
    if (e.code() != ErrorCode::BadArgument) throw;  // about a file
    throw CLI::ValidationError(name, e.what());
  }
}

}  // namespace

double read_share(const std::string& option, const std::string& text) {
  return naming_option(option, [&] { return parse_share(text); });
}

void add_options(CLI::App& cmd, const OptionTable& table) {
  for (const NamedOption& row : table) {
    const std::string name = "--" + row.name;
    const auto set = [name, set = row.set](const std::string& text) {
      naming_option(name, [&] { set(text); });
    };
    if (row.kind == OptionKind::List)
      cmd.add_option_function<std::vector<std::string>>(
             name,
             [set](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) set(text);
             },
             row.help)
          ->allow_extra_args(false)
          ->type_name(row.allowed);
    else if (row.kind == OptionKind::Flag)
      cmd.add_flag_callback(
          name, [set] { set("true"); }, row.help);
    else
      cmd.add_option_function<std::string>(name, set, row.help + " [" + row.fallback + "]")
          ->type_name(type_name(row));
  }
}

void add_console_options(CLI::App& cmd, Program& program) {
  cmd.add_flag("-q,--quiet", program.console.is_quiet, "No progress and no summary");
  cmd.add_option("--threads", program.console.num_threads,
                 "Threads to use, 0 = one per core; the result does not depend on it")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
}

void add_feature_file_option(CLI::App& cmd, std::string& file) {
  cmd.add_option("--features", file,
                 "Your own creases, besides those by angle: OBJ with 'l' lines, or text with two "
                 "vertex numbers (from 0) of the surface per line");
}

void load_features(const std::string& file, const TriMesh& surface, FeatureOptions& options) {
  if (!file.empty()) options.extra_segments = read_feature_edges(file, surface);
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
  if (!path.empty() && !has_extension(path, extensions))
    throw CLI::ValidationError(fmt::format("cannot write '{}': the extension must be one of {}",
                                           path, fmt::join(extensions, ", ")));
}

void add_mesh_output_option(CLI::App& cmd, std::string& output) {
  cmd.add_option("-o,--output", output, "Mesh: .vtu, .vtk, .msh, .inp, polyMesh ...")->required();
}

void add_picture_option(CLI::App& cmd, std::string& picture) {
  cmd.add_option("--picture", picture, "Write a cut through the mesh as PNG");
}

void require_mesh_format(const std::string& path, const ElementChoice& choice, int order) {
  if (order == 1 && choice.nodes_per_hex > 8)
    throw CLI::ValidationError("--nodes", "hexes of " + std::to_string(choice.nodes_per_hex) +
                                              " nodes are of second order; add --order 2");
  try {
    check_hex_mesh_format(path, choice.format, order, choice.nodes_per_hex);
  } catch (const Error& error) {
    throw CLI::ValidationError(error.what());
  }
}

void add_element_options(CLI::App& cmd, ElementChoice& choice) {
  cmd.add_option("--format", choice.format, "Format of the mesh, where the extension does not tell")
      ->check(CLI::IsMember(hex_mesh_formats()));
  cmd.add_option("--nodes", choice.nodes_per_hex,
                 "Of second order, nodes of a hex: 20 or 27 [what is usual in the format]")
      ->check(CLI::IsMember({20, 27}));
}

void add_patch_option(CLI::App& cmd, std::vector<std::string>& rules) {
  cmd.add_option(
         "--patch", rules,
         "NAME=RULE names a part of the surface, such as inlet=plane:x<0.001; repeated, the "
         "first that fits counts")
      ->allow_extra_args(false)
      ->check([](const std::string& rule) {
        try {
          parse_patch_rule(rule);
          return std::string();
        } catch (const Error& error) {
          return std::string(error.what());
        }
      });
}

namespace {

std::vector<PatchRule> read_rules(const std::vector<std::string>& texts, Program& program) {
  std::vector<PatchRule> rules;
  for (const std::string& text : texts) {
    rules.push_back(parse_patch_rule(text));
    for (PatchCondition& condition : rules.back().conditions)
      if (!condition.path.empty()) condition.surface = load_surface(condition.path, program);
  }
  return rules;
}

void warn_unmatched(const std::vector<std::string>& rules, const std::vector<std::size_t>& matched,
                    Program& program) {
  for (std::size_t r = 0; r < rules.size(); ++r)
    if (matched[r] == 0)
      program.console.warn("--patch " + rules[r] + ": no part of the surface fits the rule");
}

}  // namespace

TriMesh name_patches(TriMesh&& surface, const std::vector<std::string>& rules, Program& program) {
  if (rules.empty()) return std::move(surface);
  const std::vector<PatchRule> parsed = read_rules(rules, program);
  for (std::size_t r = 0; r < rules.size(); ++r)
    for (const PatchCondition& condition : parsed[r].conditions)
      if (condition.kind == PatchCondition::Kind::CadFace)
        throw Error(
            ErrorCode::BadArgument,
            "--patch " + rules[r] + " asks for a face of a CAD file, which the input is not");
  RuledSurface ruled = apply_patch_rules(surface, parsed);
  warn_unmatched(rules, ruled.num_matched, program);
  return std::move(ruled.surface);
}

TriMesh load_surface(const std::string& path, Program& program) {
  if (is_cad_file(path)) return load_cad(path, {}, {}, program).surface.surface;
  SurfaceFile file = read_surface(path);
  for (const std::string& w : file.warnings) program.console.warn(path + ": " + w);
  return std::move(file.mesh);
}

CadInput load_cad(const std::string& path, const std::vector<std::string>& rules,
                  const MeshOptions& options, Program& program) {
  CadModel model = read_cad(path, read_options_for(options));
  for (const std::string& w : model.warnings) program.console.warn(path + ": " + w);
  CadInput input = prepare_cad(std::move(model), read_rules(rules, program), options);
  warn_unmatched(rules, input.num_matched, program);
  return input;
}

}  // namespace hexwright::cli
