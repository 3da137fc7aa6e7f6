// One rule for patterns of names.
#include "hexwright/base/name_pattern.h"

#include <gtest/gtest.h>

#include "hexwright/base/error.h"

namespace hexwright {
namespace {

TEST(NamePattern, IsAGlobOrARegularExpression) {
  EXPECT_TRUE(matches_pattern("*", "anything"));
  EXPECT_TRUE(matches_pattern("wall*", "wall.2"));
  EXPECT_TRUE(matches_pattern("wall?", "wall1"));
  EXPECT_FALSE(matches_pattern("wall", "wall.2"));
  EXPECT_FALSE(matches_pattern("wall?", "wall12"));
  EXPECT_TRUE(matches_pattern("*a*b*", "xxayybzz"));
  EXPECT_TRUE(matches_pattern("wing|flap", "flap"));
  EXPECT_TRUE(matches_pattern("wall[0-9]+", "wall12"));
  EXPECT_FALSE(matches_pattern("wing|flap", "flaps"));
  EXPECT_TRUE(matches_pattern("a.b", "a.b"));
  EXPECT_FALSE(matches_pattern("a.b", "axb"));
  EXPECT_NO_THROW(check_pattern("wall.*"));
  EXPECT_THROW(check_pattern("wall("), Error);
}

}  // namespace
}  // namespace hexwright
