// Ids and the containers indexed by them.
#include "hexwright/base/ids.h"

#include <type_traits>
#include <unordered_set>

#include <gtest/gtest.h>

namespace hexwright {
namespace {

using Apple = Id<struct AppleTag>;
using Pear = Id<struct PearTag>;

template <class A, class B>
concept Comparable = requires(A a, B b) {
  a == b;
};
template <class Container, class Index>
concept Indexable = requires(Container c, Index i) {
  c[i];
};

// What must not compile, said in a way that does.
static_assert(Comparable<Apple, Apple> && !Comparable<Apple, Pear> && !Comparable<Apple, int>);
static_assert(Indexable<IdVector<Apple, int>, Apple>);
static_assert(!Indexable<IdVector<Apple, int>, Pear> && !Indexable<IdVector<Apple, int>, int>);
static_assert(!Indexable<IdSpan<Apple, int>, Pear>);
static_assert(!std::is_convertible_v<int, Apple> && !std::is_convertible_v<Apple, int>);
static_assert(sizeof(Apple) == 4);

TEST(Ids, TheDefaultIsInvalidAndBelowAllOthers) {
  EXPECT_FALSE(Apple().is_valid());
  EXPECT_EQ(Apple().value(), -1);
  EXPECT_TRUE(Apple(0).is_valid());
  EXPECT_LT(Apple(), Apple(0));
  EXPECT_LT(Apple(3), Apple(4));
}

TEST(Ids, RangesVisitEveryIdInOrder) {
  std::vector<int> seen;
  for (Apple a : id_range<Apple>(4)) seen.push_back(a.value());
  EXPECT_EQ(seen, (std::vector<int>{0, 1, 2, 3}));
  for (Apple a : id_range<Apple>(0)) ADD_FAILURE() << a.value();
}

TEST(Ids, PushBackReturnsTheIdThatFindsTheValue) {
  IdVector<Apple, std::string> names;
  for (int i = 0; i < 100; ++i) {
    const Apple id = names.push_back(std::to_string(i));
    EXPECT_EQ(id.value(), i);
    EXPECT_EQ(names[id], std::to_string(i));
  }
  for (Apple a : names.ids()) EXPECT_EQ(names[a], std::to_string(a.value()));
}

TEST(Ids, SpansShareTheVectorsMemory) {
  IdVector<Apple, int> values(3, 7);
  const IdSpan<Apple, int> span(values);
  span[Apple(1)] = 9;
  EXPECT_EQ(values, (IdVector<Apple, int>{7, 9, 7}));
  const IdVector<Apple, int>& fixed = values;
  const IdSpan<Apple, const int> view(fixed);
  EXPECT_EQ(view.size(), 3u);
  EXPECT_EQ(view[Apple(1)], 9);
}

TEST(Ids, HashTellsIdsApart) {
  std::unordered_set<Apple> set;
  for (int i = 0; i < 1000; ++i) set.insert(Apple(i % 500));
  EXPECT_EQ(set.size(), 500u);
}

}  // namespace
}  // namespace hexwright
