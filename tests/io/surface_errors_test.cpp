// One small broken file per rule of each surface format: refused, with the place.
#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/io/surface_io.h"

#include "io/temp_folder.h"

namespace hexwright {
namespace {

struct Broken {
  const char* name;
  std::string content;
  const char* where;  // the end of the place that is named
};

void expect_refused(const std::vector<Broken>& files) {
  const test::TempFolder folder;
  for (const Broken& file : files) {
    try {
      read_surface(folder.write(file.name, file.content));
      ADD_FAILURE() << file.name << " was accepted:\n" << file.content;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::BadFile) << error.what();
      EXPECT_TRUE(error.where().ends_with(file.where)) << error.what() << "\n" << file.content;
      // The message is a sentence about what is wrong, beyond the place.
      EXPECT_GT(std::string(error.what()).size(), error.where().size() + 15) << error.what();
    }
  }
}

TEST(BrokenSurfaces, Obj) {
  const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expect_refused({{"a.obj", "v 0 0\nf 1 1 1\n", "a.obj:1"},
                  {"b.obj", "v 0 0 1e400\nf 1 1 1\n", "b.obj:1"},
                  {"c.obj", head + "f 1 2\n", "c.obj:4"},
                  {"d.obj", head + "f 1 2 4\n", "d.obj:4"},
                  {"e.obj", head + "f 1 2 0\n", "e.obj:4"},
                  {"f.obj", head + "f -1 -2 -4\n", "f.obj:4"},
                  {"g.obj", head + "f 1 2 three\n", "g.obj:4"},
                  {"h.obj", head + "f 1 2 99999999999999999999\n", "h.obj:4"},
                  {"i.obj", head, "i.obj"},
                  {"j.obj", "v 0 0 inf\n" + head + "f 1 2 3\n", "j.obj:1"}});
}

TEST(BrokenSurfaces, Off) {
  expect_refused({{"a.off", "OFF\n", "a.off:2"},
                  {"b.off", "OFF\n3 1\n0 0 0\n", "b.off:4"},
                  {"c.off", "OFF\n-3 1 0\n", "c.off:2"},
                  {"d.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "d.off:6"},
                  {"e.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "e.off:6"},
                  {"f.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n", "f.off:5"},
                  {"g.off", "OFF\n999999999 1 0\n0 0 0\n", "g.off:4"},
                  {"h.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "h.off:7"}});
}

TEST(BrokenSurfaces, TextStl) {
  const std::string begin = "solid s\nfacet normal 0 0 1\nouter loop\n";
  const std::string three = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
  expect_refused({{"a.stl", begin + "vertex 0 0 0\nvertex 1 0\n", "a.stl:5"},
                  {"b.stl", begin + three, "b.stl:7"},
                  {"c.stl", begin + "vertex 0 0 x\n" + three, "c.stl:4"}});
}

TEST(BrokenSurfaces, Ply) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  expect_refused({{"a.ply", "ply\nformat ascii 2.0\nend_header\n", "a.ply:2"},
                  {"b.ply", head + points + "3 0 1 3\n", "b.ply:13"},
                  {"c.ply", head + points + "3 0 1\n", "c.ply:14"},
                  {"d.ply", head + "0 0 0\n1 0 0\n0 inf 0\n3 0 1 2\n", "d.ply:12"},
                  {"e.ply", head + points, "e.ply:13"},
                  {"f.ply", head.substr(0, head.find("end_header")), "f.ply:9"}});
}

}  // namespace
}  // namespace hexwright
