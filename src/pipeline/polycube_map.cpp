#include "hexwright/pipeline/polycube_map.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

#include "hexwright/base/assert.h"
#include "hexwright/geometry/prepare_surface.h"
#include "hexwright/mesh/cut_hexes.h"
#include "hexwright/pipeline/mesh_surface.h"
#include "hexwright/polycube/deform.h"

#include "mesh/quad.h"

namespace hexwright {
namespace {

constexpr const char* kGroupNames[] = {"label0", "label1", "label2", "label3", "label4", "label5"};

/// The labels of triangles after the clean-up; refuses what cannot be one polycube.
std::vector<std::uint8_t> labels_of_prepared(const PreparedSurface& prepared,
                                             std::span<const std::uint8_t> labels) {
  if (prepared.diagnosis.num_filled_holes > 0 || !prepared.diagnosis.is_closed)
    throw Error(ErrorCode::BadGeometry,
                "the surface is open, so labels do not cover all of the polycube; close its holes "
                "and label them");
  std::vector<std::uint8_t> result;
  for (TriId source : prepared.source_tri) {
    HEXWRIGHT_ASSERT(source.is_valid());  // only holes are filled with triangles of no source
    result.push_back(labels[source.index()]);
  }
  return result;
}

void name_groups(TriMesh& surface, std::span<const std::uint8_t> labels) {
  surface.group.assign(surface.num_tris(), 0);
  for (TriId t : surface.tris.ids()) surface.group[t] = labels[t.index()];
  surface.group_names.assign(std::begin(kGroupNames), std::end(kGroupNames));
}

MeshOptions mesh_options(const PolycubeMapOptions& options, double tolerance) {
  MeshOptions mesh;
  mesh.sizing.tolerance = tolerance;
  mesh.is_tolerance_given = true;
  mesh.max_hexes = options.max_hexes;
  mesh.fit.patch_verts = PatchVerts::OnSurface;
  mesh.mean_share = 0;
  return mesh;
}

using Quad = std::array<VertId, 4>;

/// Labels of the facets that cut_hexes() makes of labelled quads: each has two neighbouring corners
/// of the quad, and a centre that is a new vertex.
class FacetLabels {
 public:
  FacetLabels(const HexMesh& hexes, const TetMesh& tets) : num_verts_(hexes.num_verts()) {
    std::map<Quad, std::uint8_t> of_quad;
    for (const LabeledQuad& quad : hexes.labels.quads)
      if (quad.patch.is_valid()) of_quad[sorted(quad.verts)] = label_of(hexes, quad.patch);
    // Four tets in a row have the same centre of a face, behind the same middle of a hex.
    for (std::size_t t = 0; t + 3 < tets.num_tets(); t += 4) {
      Quad quad;
      for (std::size_t k = 0; k < 4; ++k) quad[k] = tets.tets[TetId(t + k)][1];
      const auto found = of_quad.find(sorted(quad));
      if (found != of_quad.end()) of_center_[tets.tets[TetId(t)][3]] = found->second;
    }
  }

  std::uint8_t operator()(const std::array<VertId, 3>& facet) const {
    for (VertId v : facet) {
      const auto found = v.index() >= num_verts_ ? of_center_.find(v) : of_center_.end();
      if (found != of_center_.end()) return found->second;
    }
    throw Error(ErrorCode::BadGeometry, "a quad of the object's hexes has no label");
  }

 private:
  static std::uint8_t label_of(const HexMesh& hexes, PatchId patch) {
    const std::string& name = hexes.labels.patch_names[patch];
    for (std::uint8_t label = 0; label < 6; ++label)
      if (name.starts_with(kGroupNames[label])) return label;
    throw Error(ErrorCode::BadGeometry, "patch '" + name + "' of the object's hexes has no label");
  }

  std::size_t num_verts_;
  std::map<VertId, std::uint8_t> of_center_;
};

/// Charts of each label, and corners: equal where hexes show all of a labelling.
struct Census {
  std::array<std::size_t, 6> num_charts = {};
  std::size_t num_corners = 0;
  bool operator==(const Census&) const = default;

  explicit Census(const LabelCharts& charts) : num_corners(charts.corners.size()) {
    for (std::uint8_t label : charts.chart_label) ++num_charts[label];
  }
};

/// The mesher's budget is called --map-hexes here.
std::string name_budget(std::string_view said) {
  constexpr std::string_view kOfMesher = "--max-hexes";
  std::string text(said);
  if (const auto at = text.find(kOfMesher); at != std::string::npos)
    text.replace(at, kOfMesher.size(), "--map-hexes");
  return text;
}

MeshResult mesh_object(const TriMesh& surface, const MeshOptions& options, const Context& caller) {
  Context context = caller;
  context.on_warning = [&](std::string_view said) { caller.warn(name_budget(said)); };
  try {
    MeshResult result = mesh_surface(surface, options, context);
    for (std::string& warning : result.warnings) warning = name_budget(warning);
    return result;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::OutOfResources) throw;
    throw Error(error.code(), name_budget(error.what()));
  }
}

PolycubeMap map_at(const TriMesh& surface, const LabelCharts& charts,
                   const PolycubeMapOptions& options, double tolerance, const Context& context) {
  const MeshResult meshed = mesh_object(surface, mesh_options(options, tolerance), context);
  if (meshed.mesh.num_hexes() == 0 || !meshed.verdict.is_valid())
    throw Error(ErrorCode::BadGeometry,
                "no valid hexes of the surface to cut into tets; 'hexwright mesh' says what is "
                "wrong with it");
  PolycubeMap map;
  map.object = cut_hexes(meshed.mesh);
  const FacetLabels label_of(meshed.mesh, map.object);
  Deformation deformed = deform_to_polycube(map.object, label_of, context);
  if (Census(deformed.charts) != Census(charts))
    throw Error(ErrorCode::BadGeometry,
                "the object's hexes are too coarse for some face of the labelling; give a smaller "
                "tolerance");
  map.polycube = std::move(deformed.polycube);
  map.num_charts = deformed.charts.chart_label.size();
  map.num_corners = deformed.charts.corners.size();
  if (meshed.verdict.distance) map.max_distance = meshed.verdict.distance->max_two_way();
  map.least_stretch = deformed.least_det;
  map.greatest_stretch = deformed.greatest_det;
  map.warnings = meshed.warnings;
  return map;
}

}  // namespace

PolycubeMap make_polycube_map(const TriMesh& surface, std::span<const std::uint8_t> labels,
                              const PolycubeMapOptions& options, const Context& context) {
  if (labels.size() != surface.num_tris())
    throw Error(ErrorCode::BadArgument, std::to_string(labels.size()) + " labels for " +
                                            std::to_string(surface.num_tris()) +
                                            " triangles; give one per triangle");
  PreparedSurface prepared = prepare_surface(surface, context);
  const auto prepared_labels = labels_of_prepared(prepared, labels);
  const LabelCharts charts = find_label_charts(prepared.mesh, prepared_labels);
  name_groups(prepared.mesh, prepared_labels);
  // Finer hexes where the first show not all of the labels.
  constexpr int kTries = 3;
  double tolerance = options.tolerance;
  for (int i = 0;; ++i, tolerance /= 2) {
    try {
      return map_at(prepared.mesh, charts, options, tolerance, context);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::BadGeometry || i + 1 == kTries) throw;
    }
  }
}

}  // namespace hexwright
