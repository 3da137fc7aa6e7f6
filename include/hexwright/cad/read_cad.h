// Reads CAD files: STEP, IGES and OpenCASCADE's BREP. An optional component (HEXWRIGHT_CAD).
#pragma once

#include <filesystem>
#include <numbers>

#include "hexwright/cad/cad_model.h"

namespace hexwright {

struct CadReadOptions {
  /// How far triangles and polylines may be from the exact shape, a share of the box's diagonal.
  double deflection = 0.0005;
  /// Of two triangles side by side on one face, radians.
  double angular_deflection = 0.2;
  /// Faces whose normals differ by more along their edge meet at an angle, radians.
  double sharp_angle = 15 * std::numbers::pi / 180;
};

/// Whether the name or the first words are those of a CAD file. An unreadable file is none.
bool is_cad_file(const std::filesystem::path& path);

/// Whether the component that reads CAD files was built.
bool can_read_cad();

/// Solids of the file, as triangles that know their faces. Faces that no solid has are sewn into
/// solids where they close.
/// Throws Error{CannotOpen}, Error{BadFile} or Error{BadGeometry} with the file and the remedy;
/// also where the component was not built: the message says how to get it.
CadModel read_cad(const std::filesystem::path& path, const CadReadOptions& options = {});

}  // namespace hexwright
