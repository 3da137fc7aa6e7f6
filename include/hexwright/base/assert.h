// Internal invariants, checked when the build has HEXWRIGHT_ASSERTS=ON (presets dev, checked,
// asan-ubsan).
#pragma once

#if defined(HEXWRIGHT_ASSERTS) && HEXWRIGHT_ASSERTS
#include <cstdio>
#include <cstdlib>
#define HEXWRIGHT_ASSERT(condition)                                                          \
  do {                                                                                       \
    if (!(condition)) {                                                                      \
      std::fprintf(stderr, "%s:%d: broken invariant: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                          \
    }                                                                                        \
  } while (false)
#else
#define HEXWRIGHT_ASSERT(condition) static_cast<void>(sizeof(!(condition)))
#endif
