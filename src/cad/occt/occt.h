// Small steps between OpenCASCADE's types and ours.
#pragma once

#include <gp_Dir.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include "hexwright/base/vec3.h"

namespace hexwright::cad {

inline Vec3 to_vec3(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }
inline Vec3 to_vec3(const gp_Vec& v) { return {v.X(), v.Y(), v.Z()}; }
inline Vec3 to_vec3(const gp_Dir& d) { return {d.X(), d.Y(), d.Z()}; }
inline gp_Pnt to_point(const Vec3& p) { return {p.x, p.y, p.z}; }

}  // namespace hexwright::cad
