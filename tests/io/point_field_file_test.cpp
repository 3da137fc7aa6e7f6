// Point data of images: what may be missing, and what is refused.
#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/io/point_field.h"

#include "io/temp_folder.h"

namespace hexwright {
namespace {

using test::TempFolder;

/// A lattice of 2 x 2 x 2 points with a size at each.
std::string image(const std::string& attributes, const std::string& extent) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<ImageData WholeExtent=\"0 1 0 1 0 1\" " +
         attributes + "><Piece Extent=\"" + extent +
         "\"><PointData><DataArray type=\"Float32\" Name=\"size\" format=\"ascii\">"
         "1 2 3 4 5 6 7 8</DataArray></PointData></Piece></ImageData></VTKFile>\n";
}

std::string refusal(const std::string& attributes, const std::string& extent = "0 1 0 1 0 1") {
  const TempFolder folder;
  try {
    read_point_field(folder.write("a.vti", image(attributes, extent)));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadFile);
    return error.what();
  }
  return "accepted";
}

void expect_in(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(PointFieldFiles, ImagesBeginAtTheOriginInStepsOfOneUnlessTheySay) {
  const TempFolder folder;
  const auto last_value = [&](const std::string& attributes, const Vec3& place) {
    const PointField field =
        read_point_field(folder.write("a.vti", image(attributes, "0 1 0 1 0 1")));
    double value = 0;
    field.between(std::array{place}, std::span(&value, 1));
    return value;
  };
  EXPECT_EQ(last_value("Origin=\"2 0 0\" Spacing=\"2 1 1\"", {4, 1, 1}), 8);
  EXPECT_EQ(last_value("Spacing=\"2 1 1\"", {2, 1, 1}), 8);
  EXPECT_EQ(last_value("Origin=\"2 0 0\"", {3, 1, 1}), 8);
}

TEST(PointFieldFiles, WhatIsWrongOfAnImageIsNamed) {
  expect_in(refusal("Origin=\"0 0\""), "'Origin' has 2 numbers instead of 3");
  expect_in(refusal("", "0 1 0 1 1 0"), "the image's extent ends before it begins");
  expect_in(refusal("", "0 1 0 1 0 5e9"), "the image's extent is too large");
  const TempFolder folder;
  std::string text = image("", "");
  text.replace(text.find(" Extent=\"\""), 10, "");
  try {
    read_point_field(folder.write("a.vti", text));
    FAIL() << "accepted";
  } catch (const Error& error) {
    expect_in(error.what(), "'Extent' has 0 numbers instead of 6");
  }
}

}  // namespace
}  // namespace hexwright
