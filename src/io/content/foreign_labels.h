// Labels of other programs' files, brought to what a hex mesh promises.
#pragma once

#include "io/content/volume_file.h"

namespace hexwright::io {

/// Quads that are no face of a hex, and edges and corners off the hexes, are counted and left out;
/// quads on the boundary are turned outwards; vertices that no element uses go. Files without hexes
/// stay as they are.
void settle_labels(VolumeFile& file);

}  // namespace hexwright::io
