// The first violation a structure's own check finds.
#pragma once

#include <string>

namespace hexwright {

/// Returned by `find_problem()` functions: what rule is broken, and by which element.
struct Issue {
  std::string message;
};

}  // namespace hexwright
