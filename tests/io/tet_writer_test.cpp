// Tets are written so that their reader gives the same back.
#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/io/mesh_io.h"

#include "io/temp_folder.h"

namespace hexwright {
namespace {

TEST(TetWriter, WhatIsWrittenIsReadBackToTheBit) {
  TetMesh mesh;
  for (const Vec3& p :
       {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1.0 / 3, 0}, Vec3{0, 0, 1e-300}, Vec3{1, 1, 1}})
    mesh.positions.push_back(p);
  mesh.tets.push_back({VertId(0), VertId(1), VertId(2), VertId(3)});
  mesh.tets.push_back({VertId(1), VertId(2), VertId(3), VertId(4)});
  const test::TempFolder folder;
  for (const char* name : {"tets.mesh", "tets.vtk"}) {
    const auto path = folder / name;
    write_tet_mesh(path, mesh);
    const TetMesh back = read_tet_mesh(path);
    EXPECT_EQ(back.positions, mesh.positions) << name;
    EXPECT_EQ(back.tets, mesh.tets) << name;
  }
}

TEST(TetWriter, OtherFormatsAreRefusedWithThoseThereAre) {
  try {
    write_tet_mesh("tets.vtu", {});
    FAIL() << "written as VTU";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadArgument);
    EXPECT_NE(std::string(error.what()).find(".mesh (MEDIT) or .vtk"), std::string::npos);
  }
}

}  // namespace
}  // namespace hexwright
