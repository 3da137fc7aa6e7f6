// Which faces are one patch, what it is called, and which edges are features.
#include "hexwright/cad/cad_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/base/name_pattern.h"

#include "base/disjoint_sets.h"

namespace hexwright {
namespace {

/// A layer or colour that so much of the area has is what the rest differs from.
constexpr double kMostOfArea = 0.5;
/// Of radii that rules ask for.
constexpr double kRadiusTolerance = 1e-3;

std::string color_name(const CadColor& c) {
  return fmt::format("color_{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

std::string layer_of(const CadFace& face) { return face.layer; }
std::string color_of(const CadFace& face) { return face.color ? color_name(*face.color) : ""; }

/// The mark (layer or colour) of each face, without the common one.
IdVector<CadFaceId, std::string> distinguishing(const CadModel& model,
                                                std::string (*mark)(const CadFace&)) {
  std::map<std::string, double> areas;
  double whole = 0;
  IdVector<CadFaceId, std::string> marks;
  for (const CadFace& face : model.faces) {
    marks.push_back(mark(face));
    areas[mark(face)] += face.area;
    whole += face.area;
  }
  for (std::string& of_face : marks)
    if (areas[of_face] > kMostOfArea * whole) of_face.clear();
  return marks;
}

IdVector<CadFaceId, std::string> given_names(const CadModel& model) {
  const auto layers = distinguishing(model, layer_of), colors = distinguishing(model, color_of);
  IdVector<CadFaceId, std::string> names;
  for (const CadFaceId f : model.faces.ids()) {
    const std::string& name = model.faces[f].name;
    names.push_back(!name.empty() ? name : !layers[f].empty() ? layers[f] : colors[f]);
  }
  return names;
}

double length_of(const CadModel& model, const CadEdge& edge) {
  double length = 0;
  const auto& x = model.surface.positions;
  for (std::size_t k = 1; k < edge.verts.size(); ++k)
    length += distance(x[edge.verts[k - 1]], x[edge.verts[k]]);
  return length;
}

bool is_feature(const CadEdge& edge, const CadSurfaceOptions& options) {
  return edge.kind == CadEdgeClass::Sharp || edge.kind == CadEdgeClass::Open ||
         (edge.kind == CadEdgeClass::Tangent && options.split_tangent);
}

/// Sets of faces that are one patch; the least face stands for its set.
class Joiner {
 public:
  Joiner(const CadModel& model, const CadSurfaceOptions& options)
      : names_(given_names(model)), faces_(model.faces.size()) {
    if (options.split_tangent) return;
    for (const CadEdge& edge : model.edges)
      if (edge.kind == CadEdgeClass::Tangent && names_[edge.faces[0]] == names_[edge.faces[1]])
        faces_.unite(edge.faces[0].index(), edge.faces[1].index());
  }

  bool is_named(CadFaceId face) const { return !names_[face].empty(); }
  std::string name_of(CadFaceId face) {
    return is_named(face) ? names_[face] : default_face_name(CadFaceId(faces_.find(face.index())));
  }

 private:
  IdVector<CadFaceId, std::string> names_;
  DisjointSets faces_;
};

/// Names in the order in which they come first.
class GroupNames {
 public:
  std::int32_t group(const std::string& name) {
    const auto [found, is_new] =
        groups_.try_emplace(name, static_cast<std::int32_t>(names_.size()));
    if (is_new) names_.push_back(name);
    return found->second;
  }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::map<std::string, std::int32_t> groups_;
  std::vector<std::string> names_;
};

/// Whether a kind of surface, and its radius, are what a rule asks for.
bool meets(const CadFace& face, CadFaceId id, const PatchCondition& condition) {
  static const std::map<std::string, CadSurfaceKind> kKinds = {
      {"plane", CadSurfaceKind::Plane}, {"cylinder", CadSurfaceKind::Cylinder},
      {"cone", CadSurfaceKind::Cone},   {"sphere", CadSurfaceKind::Sphere},
      {"torus", CadSurfaceKind::Torus}, {"spline", CadSurfaceKind::Spline}};
  if (condition.face_kind == "face")
    return matches_pattern(condition.face_name, face.name) ||
           matches_pattern(condition.face_name, default_face_name(id));
  if (kKinds.at(condition.face_kind) != face.kind) return false;
  if (!(condition.value > 0)) return true;
  const double radius = face.kind == CadSurfaceKind::Torus ? face.minor : face.radius;
  return std::abs(radius - condition.value) <= kRadiusTolerance * condition.value;
}

}  // namespace

TriMesh faces_as_groups(const CadModel& model) {
  TriMesh surface = model.surface;
  const IdVector<CadFaceId, std::string> names = given_names(model);
  for (const CadFaceId f : model.faces.ids())
    surface.group_names.push_back(names[f].empty() ? default_face_name(f) : names[f]);
  for (const CadFaceId f : model.tri_to_face) surface.group.push_back(f.value());
  return surface;
}

void find_faces(const CadModel& model, PatchRule& rule) {
  for (PatchCondition& condition : rule.conditions) {
    if (condition.kind != PatchCondition::Kind::CadFace) continue;
    condition.groups.clear();
    for (const CadFaceId f : model.faces.ids())
      if (meets(model.faces[f], f, condition)) condition.groups.push_back(f.value());
  }
}

CadSurface make_cad_surface(const CadModel& model, TriMesh faces,
                            const CadSurfaceOptions& options) {
  Joiner joiner(model, options);
  CadSurface result;
  GroupNames groups;
  bool any_named = false;
  std::vector<std::int32_t> face_to_group;
  for (const CadFaceId f : model.faces.ids()) {
    result.face_to_patch.push_back(joiner.name_of(f));
    face_to_group.push_back(groups.group(result.face_to_patch[f]));
    result.num_named_faces += joiner.is_named(f);
  }
  // Groups beyond the faces are those that rules gave.
  for (std::int32_t& group : faces.group) {
    const auto given = static_cast<std::size_t>(group);
    any_named = any_named || given >= model.faces.size();
    group =
        given < model.faces.size() ? face_to_group[given] : groups.group(faces.group_names[given]);
  }
  any_named = any_named || result.num_named_faces > 0;
  faces.group_names = groups.names();
  result.surface = std::move(faces);
  if (groups.names().size() == 1 && !any_named) {
    result.surface.group.clear();
    result.surface.group_names.clear();
    result.face_to_patch.assign(model.faces.size(), "");
  }
  for (const CadEdge& edge : model.edges)
    if (is_feature(edge, options))
      for (std::size_t k = 1; k < edge.verts.size(); ++k)
        result.feature_segments.push_back(
            {model.surface.positions[edge.verts[k - 1]], model.surface.positions[edge.verts[k]]});
  return result;
}

CadSummary summarize_cad(const CadModel& model, const CadSurface& surface) {
  CadSummary result;
  result.format = model.format;
  result.unit = model.unit;
  result.notes = model.notes;
  result.num_named_faces = surface.num_named_faces;
  for (const CadSolid& solid : model.solids) result.solids.push_back(solid.name);
  for (const CadFaceId f : model.faces.ids()) {
    const CadFace& face = model.faces[f];
    result.faces.push_back({face.name.empty() ? default_face_name(f) : face.name,
                            surface.face_to_patch[f], describe_face(face), face.area});
  }
  for (const CadEdge& edge : model.edges) {
    result.num_sharp += edge.kind == CadEdgeClass::Sharp;
    result.num_tangent += edge.kind == CadEdgeClass::Tangent;
    result.num_seam += edge.kind == CadEdgeClass::Seam;
    result.num_open += edge.kind == CadEdgeClass::Open;
    if (edge.kind == CadEdgeClass::Sharp) result.sharp_length += length_of(model, edge);
  }
  return result;
}

void use_cad_features(const CadSurface& surface, FeatureOptions& options) {
  options.crease_angle = std::numbers::pi;
  options.extra_segments.insert(options.extra_segments.end(), surface.feature_segments.begin(),
                                surface.feature_segments.end());
}

}  // namespace hexwright
