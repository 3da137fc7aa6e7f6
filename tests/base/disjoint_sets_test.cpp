// Disjoint sets against sets that are relabelled one by one.
#include "base/disjoint_sets.h"

#include <random>
#include <set>

#include <gtest/gtest.h>

namespace hexwright {
namespace {

template <class Index>
class DisjointSetsTest : public testing::Test {};
using Indices = testing::Types<int, std::uint32_t, std::size_t>;
TYPED_TEST_SUITE(DisjointSetsTest, Indices);

TYPED_TEST(DisjointSetsTest, AgreeWithRelabelling) {
  constexpr std::size_t kSize = 60;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    BasicDisjointSets<TypeParam> sets(kSize);
    std::vector<std::size_t> label(kSize);
    std::iota(label.begin(), label.end(), std::size_t{0});
    EXPECT_EQ(sets.count(), kSize);
    for (int k = 0; k < 80; ++k) {
      const std::size_t a = random() % kSize, b = random() % kSize;
      sets.unite(static_cast<TypeParam>(a), static_cast<TypeParam>(b));
      const std::size_t low = std::min(label[a], label[b]), high = std::max(label[a], label[b]);
      for (std::size_t& l : label)
        if (l == high) l = low;
      EXPECT_EQ(sets.count(), std::set<std::size_t>(label.begin(), label.end()).size());
    }
    // The least member stands for its set, as it does for the labels.
    for (std::size_t i = 0; i < kSize; ++i)
      EXPECT_EQ(static_cast<std::size_t>(sets.find(static_cast<TypeParam>(i))), label[i]);
  }
}

TYPED_TEST(DisjointSetsTest, GrowByMembersThatStandAlone) {
  BasicDisjointSets<TypeParam> sets(2);
  sets.unite(TypeParam{0}, TypeParam{1});
  EXPECT_EQ(sets.add(), TypeParam{2});
  EXPECT_EQ(sets.find(TypeParam{2}), TypeParam{2});
  EXPECT_EQ(sets.count(), 2u);
  sets.unite(TypeParam{2}, TypeParam{1});
  EXPECT_EQ(sets.find(TypeParam{2}), TypeParam{0});
  sets.clear();
  EXPECT_EQ(sets.count(), 0u);
  EXPECT_EQ(sets.add(), TypeParam{0});
}

}  // namespace
}  // namespace hexwright
