// Labelling files: one direction per triangle.
#include "hexwright/io/labelling_io.h"

#include <fstream>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"

#include "io/temp_folder.h"

namespace hexwright {
namespace {

class LabellingIo : public ::testing::Test {
 protected:
  std::vector<std::uint8_t> read(const std::string& text, std::size_t num_triangles) {
    std::ofstream(path_) << text;
    return read_labelling(path_, num_triangles);
  }
  std::string message(const std::string& text, std::size_t num_triangles) {
    try {
      read(text, num_triangles);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::BadFile);
      return error.what();
    }
    return "";
  }

  test::TempFolder folder_;
  std::filesystem::path path_ = folder_ / "labels.txt";
};

TEST_F(LabellingIo, ReadsLinesBlanksAndComments) {
  EXPECT_EQ(read("0\n1\n2\n3\n4\n5\n", 6), (std::vector<std::uint8_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(read("# six\n5 4\r\n\n3", 3), (std::vector<std::uint8_t>{5, 4, 3}));
}

TEST_F(LabellingIo, NamesTheLineOfWhatIsNoLabel) {
  const std::string beyond = message("0\n1\n6\n", 3);
  EXPECT_NE(beyond.find("labels.txt:3"), std::string::npos) << beyond;
  EXPECT_NE(beyond.find("label 6 is none of 0 to 5"), std::string::npos) << beyond;
  EXPECT_NE(message("0\n-1\n", 2).find("labels.txt:2"), std::string::npos);
  EXPECT_NE(message("0\n+x\n", 2).find("labels.txt:2"), std::string::npos);
  EXPECT_NE(message("0 1 2.5\n", 3).find("labels.txt:1"), std::string::npos);
}

TEST_F(LabellingIo, CountsMustAgree) {
  const std::string few = message("0\n1\n", 3);
  EXPECT_NE(few.find("2 labels, but the surface has 3 triangles"), std::string::npos) << few;
  EXPECT_NE(message("0\n1\n2\n", 2).find("3 labels"), std::string::npos);
  EXPECT_NE(message("", 2).find("0 labels"), std::string::npos);
}

}  // namespace
}  // namespace hexwright
