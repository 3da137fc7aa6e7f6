// Four floats or two doubles at once, with the compiler's own vector types (GCC, Clang): the same
// results as one by one, on any processor.
#pragma once

namespace hexwright {

using Float4 = float __attribute__((vector_size(16)));
using Double2 = double __attribute__((vector_size(16)));

inline Float4 splat(float x) { return Float4{x, x, x, x}; }
inline Double2 splat(double x) { return Double2{x, x}; }
inline Float4 min(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max(Float4 a, Float4 b) { return a > b ? a : b; }

}  // namespace hexwright
