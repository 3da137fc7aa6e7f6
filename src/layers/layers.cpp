// The driver, and the figures per patch.
#include "hexwright/layers/layers.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include <fmt/format.h>

#include "hexwright/quality/hex_quality.h"

#include "base/stage_log.h"
#include "layers/grow.h"
#include "layers/heights.h"
#include "layers/split.h"
#include "mesh/quad.h"

namespace hexwright {
namespace {

using namespace layers;

constexpr double kCovered = 0.5;   // least height over the wish where layers count as there
constexpr double kReduced = 0.95;  // less is a reduction

void require_valid(const HexMesh& mesh) {
  if (const auto issue = mesh.find_problem()) throw Error(ErrorCode::BadArgument, issue->message);
  const auto quality = compute_scaled_jacobians(mesh);
  for (HexId h : quality.ids())
    if (!(quality[h] > 0))
      throw Error(ErrorCode::BadArgument,
                  "a corner of the hex is inverted or flat; improve the mesh before it gets layers",
                  fmt::format("hex {}", h.value()));
}

void require_known_units(const LayersOptions& options) {
  for (const LayerSpec& spec : options.specs)
    if (spec.first.unit == LayerLength::Unit::Metre)
      throw Error(
          ErrorCode::BadArgument,
          "layers of '" + spec.pattern +
              "' are given in metres, but nobody knows the surface's unit; give first or total in "
              "the mesh's own unit, or as a share such as 0.1% or 0.05h");
}

/// Sums over the quads of each patch.
class Reporter {
 public:
  Reporter(const HexMesh& mesh, const WallPatches& patches, const SheetMesh& sheet,
           const LayersOptions& options)
      : mesh_(mesh), patches_(patches), sheet_(sheet), options_(options) {}

  std::vector<PatchLayers> run() {
    rows_.resize(patches_.name.size());
    for (PatchId p : patches_.name.ids()) {
      if (patches_.spec[p] == kNoSpec) continue;
      rows_[p].patch = patches_.name[p];
      rows_[p].count = options_.specs[static_cast<std::size_t>(patches_.spec[p])].count;
      rows_[p].least_thickness = 1;
    }
    index_verts();
    for (PatchId p : rows_.ids()) rows_[p].area = sheet_.wall_area[p];
    for (const SheetHex& hex : sheet_.hexes) add_hex(hex);
    for (const LeftOut& left : sheet_.left_out)
      for (PatchId p : left.patches)
        if (rows_[p].note.find(left.why) == std::string::npos)
          rows_[p].note += (rows_[p].note.empty() ? "" : "; ") + left.why;
    return finish();
  }

 private:
  void index_verts() {
    vert_of_.assign(sheet_.mesh.num_verts(), nullptr);
    for (const SheetVert& vert : sheet_.verts) vert_of_[vert.inner] = &vert;
  }

  void add_hex(const SheetHex& hex) {
    const LabeledQuad& quad = sheet_.mesh.labels.quads[static_cast<std::size_t>(hex.label)];
    PatchLayers& row = rows_[quad.patch];
    const double area = quad_area(mesh_.positions, quad.verts);
    double least = std::numeric_limits<double>::infinity(), mean = 0, first = 0;
    const SheetVert* lowest = nullptr;
    for (std::size_t k = 0; k < 4; ++k) {
      const SheetVert& vert = *vert_of_[sheet_.mesh.hexes[hex.hex][k]];
      const double height = measure_height(sheet_, vert);
      const double share = std::min(1.0, height / vert.wish);
      mean += 0.25 * share;
      first += 0.25 * height * options_.specs[static_cast<std::size_t>(vert.spec)].share_of(1);
      if (share < least) {
        least = share;
        lowest = &vert;
      }
    }
    row.mean_thickness += area * mean;
    row.mean_first += area * first;
    if (least >= kCovered) row.covered += area;
    if (mean < kReduced) row.reduced[static_cast<std::size_t>(lowest->limit)] += area;
    if (least < row.least_thickness) {
      row.least_thickness = least;
      row.least_at = mesh_.positions[lowest->wall];
    }
    rows_with_hexes_.resize(rows_.size(), 0);
    rows_with_hexes_[quad.patch] += area;
  }

  std::vector<PatchLayers> finish() {
    rows_with_hexes_.resize(rows_.size(), 0);
    std::vector<PatchLayers> rows;
    for (PatchId p : rows_.ids()) {
      PatchLayers& row = rows_[p];
      if (row.patch.empty() || !(row.area > 0)) continue;
      const double whole = row.area;
      const double with_layers = rows_with_hexes_[p];
      if (with_layers < whole * (1 - 1e-9)) {
        row.least_thickness = 0;
        row.reduced[static_cast<std::size_t>(LayerLimit::Rim)] += whole - with_layers;
      }
      if (with_layers > 0) row.mean_first /= with_layers;
      row.covered /= whole;
      row.mean_thickness /= whole;
      for (double& share : row.reduced) share /= whole;
      rows.push_back(row);
    }
    return rows;
  }

  const HexMesh& mesh_;
  const WallPatches& patches_;
  const SheetMesh& sheet_;
  const LayersOptions& options_;
  IdVector<VertId, const SheetVert*> vert_of_;
  IdVector<PatchId, PatchLayers> rows_;
  IdVector<PatchId, double> rows_with_hexes_;
};

std::string say_reasons(const PatchLayers& row) {
  constexpr const char* kReasons[kNumLayerLimits] = {"other", "a facing wall", "short edges",
                                                     "the shape of hexes", "no sheet"};
  std::string text;
  for (std::size_t k = 0; k < kNumLayerLimits; ++k)
    if (row.reduced[k] >= 0.0005)
      text += fmt::format("{} {} {:.1f}%", text.empty() ? "; lower by" : ",", kReasons[k],
                          100 * row.reduced[k]);
  return text;
}

}  // namespace

void PatchLayers::to_world(const Similarity& frame) {
  area = frame.length_to_world(frame.length_to_world(area));
  least_at = frame.to_world(least_at);
  mean_first = frame.length_to_world(mean_first);
}

void LayersReport::to_world(const Similarity& frame) {
  for (PatchLayers& row : patches) row.to_world(frame);
}

double LayersReport::coverage() const {
  double area = 0, covered = 0;
  for (const PatchLayers& row : patches) {
    area += row.area;
    covered += row.area * row.covered;
  }
  return area > 0 ? covered / area : 1;
}

LayersResult add_layers(const HexMesh& mesh, const Target& target, const LayersOptions& options,
                        const Context& context) {
  const auto watch = context.watch();
  const Stopwatch clock;
  require_known_units(options);
  require_valid(mesh);
  LayersResult result;
  const WallPatches patches = find_wall_patches(mesh, target.frame, options, result.report);
  context.progress("layers", 0);
  SheetMesh sheet;
  std::vector<VertId> blocked;
  while (true) {  // each time with a wall less
    sheet = insert_sheets(mesh, target.frame, patches, options, blocked);
    if (sheet.hexes.empty()) break;
    set_heights(sheet, target, options);
    context.progress("layers", 0.2);
    const std::vector<VertId> inverted = grow_sheet(sheet, target, options, context);
    if (inverted.empty()) break;
    blocked.insert(blocked.end(), inverted.begin(), inverted.end());
  }
  context.progress("layers", 0.9);
  result.report.patches = Reporter(mesh, patches, sheet, options).run();
  result.report.num_sheet_hexes = sheet.hexes.size();
  SplitMesh split = split_sheet(sheet, options);
  result.mesh = std::move(split.mesh);
  result.layer = std::move(split.layer);
  result.report.seconds = clock.seconds();
  context.progress("layers", 1);
  return result;
}

std::string layers_to_text(const LayersReport& report) {
  std::string text;
  for (const PatchLayers& row : report.patches) {
    text += fmt::format(
        "  layers on {}: {} on {:.1f}% of the area, height {:.1f}% of the wish (least {:.0f}% at "
        "({:.4g} {:.4g} {:.4g})), first {:.4g}{}\n",
        row.patch, row.count, 100 * row.covered, 100 * row.mean_thickness,
        100 * row.least_thickness, row.least_at.x, row.least_at.y, row.least_at.z, row.mean_first,
        say_reasons(row));
    if (!row.note.empty()) text += "    " + row.note + "\n";
  }
  return text;
}

}  // namespace hexwright
