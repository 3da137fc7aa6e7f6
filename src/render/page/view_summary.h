// The part of a page that is JSON: names, counts, measures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/page/view_scene.h"

namespace hexwright {

/// The tags of a mesh's regions, ascending; 0 alone without any.
std::vector<std::int32_t> region_tags(const HexMesh& mesh);

/// On one line, safe inside a script element.
std::string view_summary(const HexMesh& mesh, const ViewScene& scene, const ViewOptions& options,
                         const std::vector<std::int32_t>& regions);

}  // namespace hexwright
