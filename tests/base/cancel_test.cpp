// How loops learn that the caller wants them to end.
#include "hexwright/base/cancel.h"

#include <atomic>

#include <gtest/gtest.h>

#include "hexwright/base/context.h"
#include "hexwright/base/parallel.h"

namespace hexwright {
namespace {

/// The code of what is thrown; fails when nothing is.
template <class Action>
void expect_cancelled(Action&& action) {
  try {
    action();
    ADD_FAILURE() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::Cancelled);
  }
}

TEST(Cancel, OnlyTheInnermostScopeCounts) {
  const std::atomic<bool> set{true}, unset{false};
  check_cancelled();
  {
    const CancelScope outer(&set);
    expect_cancelled([] { check_cancelled(); });
    {
      const CancelScope inner(&unset);
      check_cancelled();
      const CancelScope none(nullptr);
      check_cancelled();
    }
    expect_cancelled([] { check_cancelled(); });
  }
  check_cancelled();
}

TEST(Cancel, AContextWithoutAFlagKeepsThatOfTheCaller) {
  const std::atomic<bool> set{true}, unset{false};
  const CancelScope outer(&set);
  Context context;
  {
    const auto watch = context.watch();
    expect_cancelled([] { check_cancelled(); });
  }
  context.cancel = &unset;
  const auto watch = context.watch();
  check_cancelled();
}

// A flag set while a loop runs ends it long before its last index, whoever runs the chunk.
TEST(Cancel, EndsParallelLoopsBetweenChunks) {
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    std::atomic<bool> stop{false};
    std::atomic<std::size_t> num_run{0};
    const CancelScope scope(&stop);
    constexpr std::size_t kCount = 1'000'000;
    expect_cancelled([&] {
      parallel_for(
          kCount,
          [&](std::size_t) {
            if (++num_run == 1000) stop = true;
          },
          10);
    });
    EXPECT_LT(num_run, kCount / 2);
  }
}

// Loops that are started by workers look at the flag too.
TEST(Cancel, ReachesNestedLoops) {
  const ThreadLimit limit(4);
  std::atomic<bool> stop{false};
  const CancelScope scope(&stop);
  expect_cancelled([&] {
    parallel_for(
        64,
        [&](std::size_t i) {
          if (i == 5) stop = true;
          parallel_for(
              64, [](std::size_t) {}, 1);
        },
        1);
  });
}

TEST(Cancel, ChecksOfShortStepsLookNowAndThen) {
  const std::atomic<bool> set{true};
  const CancelScope scope(&set);
  CancelCheck check;
  expect_cancelled([&] {
    for (int i = 0; i < 1024; ++i) check();
  });
}

}  // namespace
}  // namespace hexwright
