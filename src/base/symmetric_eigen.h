// The eigenproblem of symmetric matrices of order three, which planes of least squares are found
// by.
//
// Based on: Golub, Van Loan, "Matrix Computations", 4th edition, 2013, section 8.5 (the cyclic
// Jacobi method).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "hexwright/base/vec3.h"

namespace hexwright {

/// Unit eigenvector of the least eigenvalue of the matrix with the entries xx, xy, xz, yy, yz, zz;
/// one of them where several share it. Accurate to rounding relative to the largest entry.
inline Vec3 least_eigenvector(const std::array<double, 6>& entries) {
  constexpr int kMaxSweeps = 12;  // four or five are the rule: convergence is quadratic
  constexpr double kRounding = 1e-17;
  double m[3][3] = {{entries[0], entries[1], entries[2]},
                    {entries[1], entries[3], entries[4]},
                    {entries[2], entries[4], entries[5]}};
  double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    const double off = std::abs(m[0][1]) + std::abs(m[0][2]) + std::abs(m[1][2]);
    const double on = std::abs(m[0][0]) + std::abs(m[1][1]) + std::abs(m[2][2]);
    if (!(off > kRounding * on)) break;
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (m[p][q] == 0) continue;
        // The rotation in the plane of axes p and q that makes this entry zero.
        const double tau = (m[q][q] - m[p][p]) / (2 * m[p][q]);
        const double t = std::copysign(1 / (std::abs(tau) + std::sqrt(1 + tau * tau)), tau);
        const double c = 1 / std::sqrt(1 + t * t), s = t * c;
        for (auto& row : m) {
          const double x = row[p], y = row[q];
          row[p] = c * x - s * y;
          row[q] = s * x + c * y;
        }
        for (int k = 0; k < 3; ++k) {
          const double x = m[p][k], y = m[q][k];
          m[p][k] = c * x - s * y;
          m[q][k] = s * x + c * y;
        }
        for (auto& row : v) {
          const double x = row[p], y = row[q];
          row[p] = c * x - s * y;
          row[q] = s * x + c * y;
        }
      }
  }
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (m[k][k] < m[least][least]) least = k;
  return {v[0][least], v[1][least], v[2][least]};
}

}  // namespace hexwright
