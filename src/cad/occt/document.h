// A CAD file as OpenCASCADE reads it: the shape, and what the file says of its parts.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <TopoDS_Shape.hxx>

#include "hexwright/cad/cad_model.h"

namespace hexwright::cad {

struct PartInfo {
  std::string name, layer;
  std::optional<CadColor> color;
};

struct Document {
  TopoDS_Shape shape;        ///< everything, placed
  std::string format, unit;  ///< see CadModel
  /// By the shape without its place: instances of a part share it. The keys keep it: the address of
  /// one that is gone could be that of another.
  std::map<Handle(TopoDS_TShape), PartInfo> info;

  PartInfo info_of(const TopoDS_Shape& part) const {
    const auto found = info.find(part.TShape());
    return found == info.end() ? PartInfo{} : found->second;
  }
};

/// Lengths in millimetres. Throws Error{BadFile} where the content is damaged or holds no shape.
Document read_document(const std::filesystem::path& path);

}  // namespace hexwright::cad
