// What stands in for the component that reads CAD files where it was not built.
#include "hexwright/base/error.h"
#include "hexwright/cad/read_cad.h"

namespace hexwright {

bool can_read_cad() { return false; }

CadModel read_cad(const std::filesystem::path& path, const CadReadOptions&) {
  throw Error(
      ErrorCode::BadFile,
      "this hexwright was built without its component for CAD files; run 'scripts/setup cad' "
      "and 'scripts/build' (or CMake with -DHEXWRIGHT_CAD=ON), or export the part as STL",
      path.string());
}

}  // namespace hexwright
