#include "hexwright/layers/layer_spec.h"

#include <gtest/gtest.h>

#include "hexwright/base/error.h"

namespace hexwright {
namespace {

std::string refusal(const std::string& text) {
  try {
    parse_layer_spec(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadArgument);
    return error.what();
  }
  return "";
}

void expect_refused(const std::string& text, const std::vector<std::string>& words) {
  const std::string message = refusal(text);
  EXPECT_FALSE(message.empty()) << text;
  for (const std::string& word : words)
    EXPECT_NE(message.find(word), std::string::npos) << text << ": " << message;
}

TEST(LayerSpec, AnyThreeMakeTheFourth) {
  const LayerSpec wanted = parse_layer_spec("wall=first:0.1,growth:1.2,count:8");
  EXPECT_EQ(wanted.pattern, "wall");
  EXPECT_NEAR(wanted.total(), 0.1 * 16.49908, 1e-5);
  for (const char* text :
       {"wall=first:0.1,growth:1.2,total:1.649908", "wall=first:0.1,count:8,total:1.649908",
        "wall=growth:1.2,count:8,total:1.649908",
        "wall=first:0.1,growth:1.2,count:8,total:1.649908"}) {
    const LayerSpec spec = parse_layer_spec(text);
    EXPECT_EQ(spec.count, 8) << text;
    EXPECT_NEAR(spec.growth, 1.2, 1e-5) << text;
    EXPECT_NEAR(spec.first.value, 0.1, 1e-6) << text;
  }
}

TEST(LayerSpec, SharesAreThoseOfTheHeights) {
  const LayerSpec spec = parse_layer_spec("*=first:1,growth:2,count:3");
  EXPECT_DOUBLE_EQ(spec.share_of(0), 0);
  EXPECT_DOUBLE_EQ(spec.share_of(1), 1.0 / 7);
  EXPECT_DOUBLE_EQ(spec.share_of(2), 3.0 / 7);
  EXPECT_DOUBLE_EQ(spec.share_of(3), 1);
}

TEST(LayerSpec, LengthsHaveThreeUnits) {
  EXPECT_EQ(parse_layer_spec("a=first:2e-3,growth:1,count:1").first,
            (LayerLength{2e-3, LayerLength::Unit::World}));
  EXPECT_EQ(parse_layer_spec("a=first:0.5%,growth:1,count:1").first,
            (LayerLength{0.005, LayerLength::Unit::Diagonal}));
  EXPECT_EQ(parse_layer_spec("a=first:0.05h,growth:1,count:1").first,
            (LayerLength{0.05, LayerLength::Unit::Edge}));
}

TEST(LayerSpec, EqualsSignsMayBePartOfThePattern) {
  EXPECT_EQ(parse_layer_spec("a=b=first:1,growth:1,count:1").pattern, "a=b");
}

TEST(LayerSpec, ContradictionsNameBoth) {
  expect_refused("a=first:1,growth:1.2,count:8,total:5", {"first:1", "count:8", "total:5"});
  expect_refused("a=first:1,count:8,total:5", {"first:1", "count:8", "total:5"});
  expect_refused("a=first:6,growth:1.2,total:5", {"first:6", "total:5"});
  expect_refused("a=first:1%,growth:1.2,total:5", {"first:1%", "total:5", "units"});
  expect_refused("a=first:1e-9,count:2,total:1", {"first:1e-09", "count:2", "total:1"});
  expect_refused("a=first:1e-3,growth:1,total:1", {"first:0.001", "growth:1", "total:1"});
}

TEST(LayerSpec, WhatIsMissingOrUnknownIsNamed) {
  expect_refused("a=first:1,growth:1.2", {"count, total"});
  expect_refused("a=first:1", {"growth, count, total"});
  expect_refused("a=first:1,growth:1.2,number:3", {"number:3"});
  expect_refused("a=first:1,first:2,count:3", {"first is given twice"});
  expect_refused("a=first:-1,growth:1.2,count:3", {"-1", "first"});
  expect_refused("a=first:1,growth:0.9,count:3", {"growth:0.9"});
  expect_refused("a=first:1,growth:1.2,count:2.5", {"count:2.5"});
  expect_refused("a=first:1,growth:1.2,count:1000", {"count:1000"});
  expect_refused("a=first:nan,growth:1.2,count:3", {"nan"});
  expect_refused("first:1,growth:1.2,count:3", {"PATTERN="});
  expect_refused("a(=first:1,growth:1.2,count:3", {"a(", "regular expression"});
}

}  // namespace
}  // namespace hexwright
