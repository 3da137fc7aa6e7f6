// Which side of a surface is meshed.
#pragma once

namespace hexwright {

enum class Side {
  Inside,
  Outside,  ///< the background around the object; its outer boundary stays in its planes
  Both      ///< all of the background, conforming, with region tags 1 (inside) and 2 (outside)
};

}  // namespace hexwright
