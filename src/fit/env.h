#pragma once
#include <cstdlib>
inline double env(const char* n, double d) {
  const char* e = std::getenv(n);
  return e ? std::atof(e) : d;
}
