#include "hexwright/base/parallel.h"

#include <cfenv>
#include <chrono>
#include <numeric>
#include <random>
#include <thread>

#include <gtest/gtest.h>

namespace hexwright {
namespace {

TEST(Parallel, ChunksCoverEveryIndexOnce) {
  std::vector<int> hits(10'001, 0);
  parallel_chunks(hits.size(), 7, [&](std::size_t begin, std::size_t end) {
    EXPECT_EQ(begin % 7, 0u);
    for (std::size_t i = begin; i < end; ++i) ++hits[i];
  });
  EXPECT_EQ(std::accumulate(hits.begin(), hits.end(), 0), 10'001);
  EXPECT_EQ(*std::min_element(hits.begin(), hits.end()), 1);
}

TEST(Parallel, SumOfDoublesIsTheSameForAnyThreadCount) {
  std::mt19937 rng(1);
  std::vector<double> values(100'000);
  for (double& v : values) v = std::uniform_real_distribution<>(-1, 1)(rng);
  const auto sum = [&](int threads) {
    ThreadLimit limit(threads);
    return parallel_reduce(
        values.size(), 0.0,
        [&](std::size_t b, std::size_t e) {
          return std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(b),
                                 values.begin() + static_cast<std::ptrdiff_t>(e), 0.0);
        },
        [](double a, double b) { return a + b; }, 100);
  };
  EXPECT_EQ(sum(1), sum(2));
}

// Also after the workers have started in another mode: theirs must not stay.
TEST(Parallel, WorkersRoundAsTheCallerDoes) {
  const ThreadLimit limit(4);
  for (const int mode : {FE_TONEAREST, FE_UPWARD, FE_TONEAREST}) {
    std::fesetround(mode);
    std::vector<int> modes(2000, -1);
    parallel_for(
        modes.size(),
        [&](std::size_t i) {
          modes[i] = std::fegetround();
          std::this_thread::sleep_for(std::chrono::microseconds(5));  // or one thread takes all
        },
        1);
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(modes, std::vector<int>(modes.size(), mode));
  }
}

TEST(Parallel, StableSortKeepsTheOrderOfEqualKeys) {
  std::mt19937 rng(2);
  std::vector<std::pair<int, int>> values(300'000);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = {static_cast<int>(rng() % 100), static_cast<int>(i)};
  auto expected = values;
  const auto less = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::stable_sort(expected.begin(), expected.end(), less);
  parallel_stable_sort(values.begin(), values.end(), less);
  EXPECT_EQ(values, expected);
}

}  // namespace
}  // namespace hexwright
