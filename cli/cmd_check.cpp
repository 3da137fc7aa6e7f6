// hexwright check: judges a hex mesh, alone or against its surface, or an adaptive grid.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hexwright/io/atomic_file.h"
#include "hexwright/io/grid_io.h"
#include "hexwright/io/mesh_io.h"
#include "hexwright/io/set_summary.h"
#include "hexwright/pipeline/mesh_surface.h"
#include "hexwright/quality/judge_distance.h"
#include "hexwright/quality/verdict_json.h"

#include "check_grid.h"
#include "commands.h"
#include "options.h"
#include "output.h"
#include "view_file.h"

namespace hexwright::cli {
namespace {

struct CheckCommand {
  std::string input, reference, report, view, feature_file;
  bool as_grid = false, as_json = false;
  FeatureOptions features;
  double tolerance = SizingOptions{}.tolerance;
  std::optional<Balance> balance;
  bool needs_blocks = false;

  bool is_of_grid() const { return as_grid || has_extension(input, {".cells", ".htg"}); }
};

/// Files that do not read as grids are simply none; their own errors were reported as meshes.
bool is_grid(const std::string& path) {
  if (!has_extension(path, grid_extensions())) return false;
  try {
    return read_grid(path).num_cells() > 0;
  } catch (const Error& e) {
    if (e.code() == ErrorCode::Cancelled) throw;
    return false;
  }
}

struct Judgement {
  std::optional<SurfaceTree> surface;  ///< what it was judged against, for the page; else absent
  Verdict verdict;
};

/// Against a surface, the mesh is judged by the features that sizing would see: the angles given,
/// without short loose creases. Feature files refer to the surface as it was read, before it is
/// prepared.
Judgement judge_mesh(const CheckCommand& cmd, const HexMesh& mesh, Program& program) {
  const Context context = program.console.start(cmd.reference);
  if (cmd.reference.empty()) return {std::nullopt, judge(mesh, {}, context)};
  const TriMesh surface = load_surface(cmd.reference, program);
  TargetOptions wishes;
  wishes.features = cmd.features;
  load_features(cmd.feature_file, surface, wishes.features);
  return naming_file(cmd.reference, [&] {
    const Target target = make_target(surface, wishes, context);
    const JudgeOptions options{.bound_gap = kBoundOfTolerance * cmd.tolerance};
    Judgement judgement{std::nullopt, judge(to_unit(mesh, target.frame), target, options, context)};
    judgement.verdict.to_world(target.frame);
    if (!cmd.view.empty()) judgement.surface.emplace(to_world(target.surface(), target.frame));
    return judgement;
  });
}

/// A mesh that is not valid is shown too: to look at it is the way to see why. An empty one has
/// nothing to show.
void write_page(const CheckCommand& cmd, const HexMesh& mesh, const Judgement& judgement) {
  if (cmd.view.empty() || mesh.num_hexes() == 0) return;
  ViewOptions options;
  options.title = std::filesystem::path(cmd.input).filename().string();
  options.verdict = &judgement.verdict;
  options.surface = judgement.surface ? &*judgement.surface : nullptr;
  write_view(cmd.view, mesh, options);
}

/// As they would be written.
std::vector<SetSummary> summarize_named_sets(const HexMesh& mesh) {
  SetTable table = make_set_table(mesh);
  name_by_place(mesh, table);
  return summarize_sets(mesh, table);
}

std::string with_sets(const std::string& verdict, const std::vector<SetSummary>& sets) {
  auto json = nlohmann::ordered_json::parse(verdict);
  json["sets"] = nlohmann::ordered_json::parse(sets_to_json(sets));
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void check_mesh(const CheckCommand& cmd, Program& program) {
  const HexMesh mesh = read_hex_mesh(cmd.input);
  const Judgement judgement = judge_mesh(cmd, mesh, program);
  const Verdict& verdict = judgement.verdict;
  write_page(cmd, mesh, judgement);
  const std::vector<SetSummary> sets = summarize_named_sets(mesh);
  const std::string json = with_sets(verdict_to_json(verdict), sets);
  if (!cmd.report.empty()) write_file_atomically(cmd.report, json);
  if (cmd.as_json) {
    std::puts(json.c_str());
  } else {
    program.console.print(
        fmt::format("{}\n{}{}", cmd.input, sets_to_text(sets), verdict_to_text(verdict)));
  }
  if (cmd.as_json || program.console.is_quiet)  // otherwise the text has said so
    for (const std::string& f : verdict.failures) program.console.fail(cmd.input + ": " + f);
  if (!verdict.topology.hanging_verts.empty() && is_grid(cmd.input))
    program.console.warn(cmd.input + ": it is a grid with hanging nodes: check it with --grid");
  program.exit_code = verdict.is_valid() ? Valid : FailsGate;
}

/// Balance and pairing that a grid must have to pass.
void add_grid_demands(CLI::App& sub, CheckCommand& cmd) {
  sub.add_option_function<std::string>(
         "--balance",
         [&cmd](const std::string& name) {
           cmd.balance = name == "strong" ? Balance::Strong
                         : name == "weak" ? Balance::Weak
                                          : Balance::Relaxed;
         },
         "For a grid: fail unless it has this balance [relaxed, the least that sheets need]")
      ->check(CLI::IsMember({"relaxed", "weak", "strong"}));
  sub.add_flag("--blocks", cmd.needs_blocks, "For a grid: fail unless it is paired by blocks");
}

}  // namespace

void add_check_command(CLI::App& app, Program& program) {
  auto cmd = std::make_shared<CheckCommand>();
  CLI::App* sub = app.add_subcommand("check", "Judge a hex mesh of any program, or a grid");
  sub->add_option("input", cmd->input,
                  "Hex mesh (VTU, VTK, MEDIT, Gmsh, Abaqus, MFEM, Exodus) or grid (.cells, .htg)")
      ->required();
  sub->add_option("reference", cmd->reference,
                  "Of a mesh: the surface it stands for. Of a grid: the grid before completion, "
                  "which it must refine");
  sub->add_flag("--grid", cmd->as_grid, "The .vtu or .mesh file holds a grid with hanging nodes");
  sub->add_flag("--json", cmd->as_json, "Print the verdict as JSON");
  sub->add_option("--report", cmd->report, "Write the verdict as JSON");
  sub->add_option("--view", cmd->view, "Of a mesh: write a page to look into it with (.html)");
  sub->add_option_function<std::string>(
         "--tolerance",
         [cmd](const std::string& text) {
           cmd->tolerance = text == "0" ? 0 : read_share("--tolerance", text);
         },
         "Of a mesh: its largest distance comes with an upper bound that is at most 2% of this "
         "share of the diagonal above it; 0 = without a bound [0.5%]")
      ->type_name("SHARE");
  add_options(*sub, make_option_table(cmd->features));
  add_feature_file_option(*sub, cmd->feature_file);
  add_grid_demands(*sub, *cmd);
  add_console_options(*sub, program);
  sub->footer(
      "Exit code 0 when valid, 1 when not.\n"
      "Examples:\n"
      "  hexwright check part.vtu part.stl\n"
      "  hexwright check other.mesh --json\n"
      "  hexwright check paired.cells grid.cells --balance weak --blocks");
  sub->callback([cmd, &program] {
    check_outputs({cmd->report, cmd->view}, {cmd->input, cmd->reference});
    require_extension(cmd->view, {".html"});
    if (!cmd->view.empty() && cmd->is_of_grid())
      throw Error(ErrorCode::BadArgument, "--view shows meshes, not grids; leave it out",
                  cmd->input);
    if (cmd->is_of_grid())
      check_grid(
          {cmd->input, cmd->reference, cmd->report, cmd->as_json, cmd->balance, cmd->needs_blocks},
          program);
    else
      check_mesh(*cmd, program);
  });
}

}  // namespace hexwright::cli
