// From a CAD model to the surface that is meshed: faces become named groups, sharp edges features.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "hexwright/cad/cad_model.h"
#include "hexwright/geometry/feature_graph.h"
#include "hexwright/geometry/patch_rules.h"

namespace hexwright {

/// The model's triangles with one group per face, in their order: what rules name parts of before
/// faces are joined.
TriMesh faces_as_groups(const CadModel& model);

/// Fills the groups of conditions that ask for faces of a CAD model ("cylinder:r=5").
void find_faces(const CadModel& model, PatchRule& rule);

struct CadSurfaceOptions {
  /// Smooth edges are features too, and every face a patch of its own.
  bool split_tangent = false;
};

struct CadSurface {
  TriMesh surface;  ///< groups are the patches' names
  /// Sharp and open edges as segments along the surface's edges; borders between groups are
  /// features by themselves.
  std::vector<std::array<Vec3, 2>> feature_segments;
  IdVector<CadFaceId, std::string> face_to_patch;  ///< name of each face's group; "" for none
  std::size_t num_named_faces = 0;                 ///< by the file or by rules, wholly
};

/// Joins faces that meet smoothly into one group unless their names differ. The name of a face is
/// that of the file, else its layer, else its colour ("color_ff0000") where faces differ in it: the
/// colour or layer of most of the area names nothing. Groups without a name are called by their
/// first face, "face_12"; a model of one such group has none.
///
/// `faces`: what faces_as_groups() gave for the model, with parts renamed by rules.
CadSurface make_cad_surface(const CadModel& model, TriMesh faces,
                            const CadSurfaceOptions& options = {});

/// A face in words.
struct CadFaceSummary {
  std::string name;   ///< given in the file, or by default
  std::string patch;  ///< what its part of the mesh's boundary is called; "" for none
  std::string shape;  ///< "cylinder r=5 along z through (1, 2, 0)"
  double area = 0;
};

/// A model in words and numbers.
struct CadSummary {
  std::string format, unit;  ///< see CadModel
  std::vector<std::string> solids;
  std::vector<CadFaceSummary> faces;
  std::size_t num_named_faces = 0;
  std::size_t num_sharp = 0, num_tangent = 0, num_seam = 0, num_open = 0;  ///< edges
  double sharp_length = 0;  ///< of the sharp edges' polylines
  std::vector<std::string> notes;
};
CadSummary summarize_cad(const CadModel& model, const CadSurface& surface);

/// What the features of the surface are: those by topology alone, since the triangles of a tight
/// fillet meet at angles too.
void use_cad_features(const CadSurface& surface, FeatureOptions& options);

}  // namespace hexwright
