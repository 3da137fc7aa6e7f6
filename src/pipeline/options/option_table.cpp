// The options of every stage. docs/cli.md and the signatures of the Python package are generated
// from these rows (tools/option_docs.py).
#include "hexwright/pipeline/option_table.h"

#include <limits>
#include <utility>

#include "pipeline/options/option_rows.h"
#include "pipeline/options/size_rows.h"

namespace hexwright {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

void append(OptionTable& table, OptionTable rows) {
  for (NamedOption& row : rows) table.push_back(std::move(row));
}

OptionTable sizing_rows(SizingOptions& options) {
  return {
      choice_row({"sizing",
                  "Where cells are fine: 'deviation' where the surface bends or walls are near, "
                  "'thickness' by the shape diameter alone"},
                 options.sizing, kSizingNames),
      share_row(
          {"tolerance", "Distance goal as a share of the bounding box's diagonal, 0.5% or 0.005"},
          options.tolerance),
      whole_row({"min-level", "Cells at the surface are at least this deep"}, options.min_level, 0,
                kMaxGridLevel),
      whole_row({"max-level", "No cell is deeper"}, options.max_level, 0, kMaxGridLevel),
      count_row({"max-cells", "Stop refining, at a whole level, before the grid has more cells"},
                options.max_cells),
  };
}

OptionTable complete_rows(CompleteOptions& options) {
  return {
      choice_row({"pairing", "How the grid is made hexmeshable"}, options.pairing, kPairingNames),
      choice_row(
          {"balance",
           "Cells sharing a face (weak) or also an edge or vertex (strong) differ by at most one "
           "level, or by two (relaxed; for sheets); auto: relaxed for sheets, else weak"},
          options.balance, kBalanceNames),
  };
}

NamedOption feature_angle_row(FeatureOptions& options) {
  return degrees_row({"feature-angle", "Edges whose faces turn by more are sharp, degrees"},
                     options.crease_angle, 1, 180);
}

NamedOption order_row(int& order) {
  return whole_row(
      {"order",
       "Order of the elements: 2 gives edges a node on the surface, and puts all vertices on it"},
      order, 1, 2);
}

OptionTable fit_rows(FitOptions& options) {
  return {
      choice_row(
          {"side", "What to mesh: the object, the box around it, or both with two region tags"},
          options.carve.side, kSideNames),
      choice_row({"padding", "Where a layer of hexes is put under the boundary"}, options.padding,
                 kPaddingNames),
      choice_row(
          {"vertices",
           "Vertices of curved patches: beside the surface, so that quads err to both sides of "
           "it, or on it"},
          options.patch_verts, kPatchVertsNames),
      number_row({"lift-goal",
                  "While the least scaled Jacobian is lower, vertices may leave the surface within "
                  "the tolerance; 0 = never"},
                 options.lift_goal, 0, 1),
  };
}

OptionTable layer_rows(LayersOptions& options) {
  return {
      list_row(
          {"layers",
           "Wall layers on the patches of this name (glob or regular expression, * for all): any "
           "three of first, growth, count and total; lengths in the surface's unit, as 1% of "
           "the diagonal or as 0.05h of the wall's edges; repeatable"},
          "PATTERN=first:H,growth:R,count:N",
          [&options](const std::string& text) { options.specs.push_back(parse_layer_spec(text)); }),
      number_row({"layers-min-coverage",
                  "Least share of the walls' area with all layers at half of their height or more; "
                  "less fails the gate"},
                 options.min_coverage, 0, 1),
  };
}

OptionTable prepare_rows(PrepareOptions& options) {
  OptionTable table = {
      choice_row({"parts",
                  "Solids that overlap or touch: united; those that only touch kept apart; or all "
                  "surfaces left as they are"},
                 options.parts, kPartsNames),
      share_row(
          {"min-part",
           "Parts no longer than this share of the diagonal are left out, with a warning, and "
           "voids filled"},
          options.min_part),
  };
  table.back().fallback = "the tolerance";
  return table;
}

/// A tolerance asked for is not derived from sizes.
void mark_tolerance(OptionTable& table, MeshOptions& options) {
  for (NamedOption& row : table)
    if (row.name == "tolerance")
      row.set = [&options, set = std::move(row.set)](const std::string& text) {
        set(text);
        options.is_tolerance_given = true;
      };
}

NamedOption gap_row(double& gap) {
  NamedOption row = share_row(
      {"gap",
       "Bodies nearer to each other than this share of the diagonal, or touching, are meshed each "
       "by itself (inside only); 0 = never"},
      gap);
  row.allowed = "0, or a share of the diagonal below 100%";
  row.fallback = "twice the tolerance";
  row.set = [&gap](const std::string& text) { gap = parse_share(text, true); };
  return row;
}

/// A level asked for binds the loop too.
void let_level_bind_loop(OptionTable& table, MeshOptions& options) {
  for (NamedOption& row : table)
    if (row.name == "max-level")
      row.set = [&options, set = std::move(row.set)](const std::string& text) {
        set(text);
        options.loop_extra_levels = 0;
      };
}

}  // namespace

OptionTable make_option_table(MeshOptions& options) {
  OptionTable table = sizing_rows(options.sizing);
  let_level_bind_loop(table, options);
  mark_tolerance(table, options);
  append(table, size_rows(options.sizes));
  table.push_back(size_file_row(options.sizes));
  table.push_back(choice_row(
      {"placement",
       "The lattice along the part's faces, however they are turned (inside only), or along the "
       "given axes"},
      options.target.placement, kPlacementNames));
  append(table, prepare_rows(options.target.prepare));
  table.push_back(gap_row(options.gap));
  table.push_back(
      number_row({"transition-cost",
                  "What a cell beside another level counts more than one that is not, when levels "
                  "are evened out; 0 = never even out"},
                 options.even.transition_cost, 0, kNoLimit));
  table.push_back(whole_row({"rounds", "At most so many refinements"}, options.max_rounds, 0, 100));
  // After the rounds, which it sets too.
  table.push_back(flag_row({"no-loop",
                            "A single pass with a stricter a-priori sizing, instead of refining "
                            "where the fit missed"},
                           [&options] { use_single_pass(options); }));
  table.push_back(count_row({"max-hexes",
                             "The mesh has no more hexes: the nearest to the surface that they "
                             "allow; with --size or --cells, more are an error"},
                            options.most_hexes));
  table.back().fallback = "none";
  append(table, complete_rows(options.complete));
  append(table, fit_rows(options.fit));
  table.push_back(order_row(options.order));
  append(table, layer_rows(options.layers));
  table.push_back(feature_angle_row(options.target.features));
  table.push_back(flag_row({"tangent-edges",
                            "CAD files: edges where faces meet smoothly are features too, and "
                            "every face is a patch of its own"},
                           options.cad.split_tangent));
  return table;
}

OptionTable make_grid_option_table(MeshOptions& options) {
  OptionTable table = sizing_rows(options.sizing);
  table.push_back(flag_row({"no-loop", "The stricter sizing of a single pass"},
                           [&options] { use_single_pass(options); }));
  table.push_back(feature_angle_row(options.target.features));
  return table;
}

OptionTable make_inspect_option_table(MeshOptions& options) {
  OptionTable table = prepare_rows(options.target.prepare);
  table.push_back(share_row(
      {"tolerance", "What is thinner than this share of the bounding box's diagonal is thin"},
      options.sizing.tolerance));
  table.push_back(feature_angle_row(options.target.features));
  return table;
}

OptionTable make_option_table(CompleteOptions& options) { return complete_rows(options); }

OptionTable make_option_table(DualStageOptions& options) {
  return {
      choice_row({"mode", "'blocks' needs a paired grid, 'sheets' a balanced one; 'auto' looks"},
                 options.mode, kDualModeNames),
      flag_row({"no-optimize", "Leave the vertices where they were made"}, options.optimize, false),
  };
}

OptionTable make_option_table(FitStageOptions& options) {
  OptionTable table = {flag_row({"no-carve", "The mesh already stands for the object: only fit it"},
                                options.fit.do_carve, false)};
  append(table, fit_rows(options.fit));
  table.push_back(order_row(options.order));
  table.push_back(share_row(
      {"tolerance",
       "How far vertices may leave the surface for the least scaled Jacobian's sake, as a "
       "share of the bounding box's diagonal"},
      options.fit.tolerance));
  table.push_back(feature_angle_row(options.target.features));
  return table;
}

OptionTable make_option_table(ImproveOptions& options) {
  return {
      whole_row({"rounds", "At most so many rounds"}, options.max_rounds, 1, 10000),
      number_row({"goal", "Stop at this least scaled Jacobian"}, options.goal, -1, 1),
  };
}

OptionTable make_option_table(PolycubeOptions& options) {
  OptionTable table = {
      share_row(
          {"max-stretch",
           "A cell is split while it is longer on the object than this share of the diagonal: "
           "along its edges, or between two of the object's vertices in it"},
          options.max_stretch),
      count_row({"cells",
                 "Hexes wanted, about: the stretch follows from it, and the surface ends up where "
                 "that leads; 0 = off"},
                options.target_hexes, 0),
      share_row({"max-surface-error",
                 "Cells are split where the mesh would miss the surface by more than this share of "
                 "the diagonal, and again where it does"},
                options.max_surface_error),
      flag_row({"ignore-distance", "Split by stretch and size alone, wherever the surface ends up"},
               [&options] { options.max_surface_error = 0; }),
      whole_row({"rounds", "Meshes made at most; more than one only where the surface was missed"},
                options.max_rounds, 1, 20),
      flag_row({"pad",
                "Put a layer of hexes under the boundary: for polycube edges where the object is "
                "smooth"},
               options.pad),
      number_row(
          {"spacing",
           "Edge of a lattice cube in polycube units, everywhere; 0 suits the lattice to the map"},
          options.spacing, 0, kNoLimit),
      whole_row({"min-level", "Cells are at least this deep"}, options.min_level, 0, 12),
      whole_row({"max-level", "No cell is deeper"}, options.max_level, 0, 12),
      count_row({"max-cells", "Budget of cells"}, options.max_cells),
  };
  append(table, complete_rows(options.complete));
  return table;
}

OptionTable make_option_table(PolycubeMapOptions& options) {
  return {
      share_row({"tolerance",
                 "The tets that are deformed stand off the surface by no more than this share of "
                 "the diagonal"},
                options.tolerance),
      count_row({"map-hexes", "Budget of hexes that are cut into 24 tets each"}, options.max_hexes),
  };
}

OptionTable make_option_table(FeatureOptions& options) { return {feature_angle_row(options)}; }

OptionTable make_option_table(EvaluateOptions& options) {
  return {
      whole_row({"grid-max-level", "Input grids are no deeper"}, options.sizing.max_level, 1,
                kMaxGridLevel),
      count_row({"grid-max-cells", "Input grids have no more cells"}, options.sizing.max_cells),
      share_row({"tolerance", "Distance goal of the final mesh, share of the diagonal"},
                options.mesh.sizing.tolerance),
      whole_row({"max-level", "Deepest cell of the final mesh's grid"},
                options.mesh.sizing.max_level, 0, kMaxGridLevel),
      whole_row({"rounds", "Refinements of the final mesh"}, options.mesh.max_rounds, 0, 100),
      count_row({"max-hexes", "Budget of the final mesh"}, options.mesh.max_hexes),
      flag_row({"no-dual", "Count cells only: no dual mesh of the grids"}, options.run_dual, false),
      flag_row({"no-mesh", "Compare completions only: no final mesh"}, options.run_mesh, false),
  };
}

}  // namespace hexwright
