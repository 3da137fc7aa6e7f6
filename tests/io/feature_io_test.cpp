// Feature files: both forms give the same segments, and what is wrong is named with its line.
#include "hexwright/io/feature_io.h"

#include <gtest/gtest.h>

#include "hexwright/base/error.h"

#include "helpers.h"
#include "io/temp_folder.h"

namespace hexwright {
namespace {

using Segments = std::vector<std::array<Vec3, 2>>;

Segments read(const std::string& name, const std::string& content) {
  const test::TempFolder folder;
  return read_feature_edges(folder.write(name, content), test::unit_cube_surface());
}

TEST(FeatureFile, PairsOfNumbersAndPolylinesAreTheSame) {
  const TriMesh cube = test::unit_cube_surface();
  const auto at = [&](int v) { return cube.positions[VertId(v)]; };
  const Segments expected = {{at(0), at(1)}, {at(1), at(3)}};
  EXPECT_EQ(read("a.txt", "# a corner\n0 1\n\n1 3  # the end\n"), expected);

  std::string obj = "o part\n";
  for (int v : {0, 1, 3}) {
    const Vec3 p = at(v);
    obj +=
        "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  }
  EXPECT_EQ(read("a.obj", obj + "l 1 2 3\n"), expected);
  EXPECT_EQ(read("b.obj", obj + "f 1 2 3\nl 1/1 2/2\nl -2 -1\n"), expected);
}

TEST(FeatureFile, WhatIsWrongIsNamedWithItsLine) {
  struct Broken {
    const char* content;
    const char* where;
  };
  for (const Broken& file :
       {Broken{"0 1\n2\n", "a:2"}, Broken{"0 8\n", "a:1"}, Broken{"0 -1\n", "a:1"},
        Broken{"0 1 2\n", "a:1"}, Broken{"zero one\n", "a:1"}, Broken{"v 0 0 0\nl 1 2\n", "a:2"},
        Broken{"v 0 0 0\nl 0 1\n", "a:2"}, Broken{"v 0 0\n", "a:1"},
        Broken{"0 1\n1 99999999999999999999\n", "a:2"}, Broken{"# none\n", "a"},
        Broken{"v 0 0 0\nf 1 1 1\n", "a"}})
    try {
      read("a", file.content);
      ADD_FAILURE() << "accepted: " << file.content;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::BadFile);
      EXPECT_TRUE(error.where().ends_with(file.where)) << error.what();
    }
}

}  // namespace
}  // namespace hexwright
