// The Context and the Error: what reaches the caller.
#include "hexwright/base/context.h"

#include <vector>

#include <gtest/gtest.h>

#include "hexwright/base/function_ref.h"
#include "hexwright/base/parallel.h"

namespace hexwright {
namespace {

TEST(Context, WithoutListenersNothingHappens) {
  const Context context;
  context.progress("stage", 0.5);
  context.warn("a warning");
  context.check_cancelled();
}

TEST(Context, PassesMessagesOnInOrder) {
  std::vector<std::string> said;
  Context context;
  context.on_warning = [&](std::string_view message) { said.emplace_back(message); };
  context.on_progress = [&](std::string_view stage, double share) {
    said.push_back(std::string(stage) + (share < 1 ? " runs" : " done"));
  };
  context.progress("fit", 0);
  context.warn("thin");
  context.progress("fit", 1);
  EXPECT_EQ(said, (std::vector<std::string>{"fit runs", "thin", "fit done"}));
}

TEST(Context, CancellingThrowsAtTheNextCheck) {
  std::atomic<bool> stop{false};
  Context context;
  context.cancel = &stop;
  EXPECT_NO_THROW(context.check_cancelled());
  stop = true;
  try {
    context.check_cancelled();
    ADD_FAILURE() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::Cancelled);
  }
}

TEST(Error, PutsThePlaceBeforeTheMessage) {
  const Error with(ErrorCode::BadFile, "a face has two vertices", "part.obj:12");
  EXPECT_STREQ(with.what(), "part.obj:12: a face has two vertices");
  EXPECT_EQ(with.where(), "part.obj:12");
  const Error without(ErrorCode::BadGeometry, "it is flat");
  EXPECT_STREQ(without.what(), "it is flat");
  EXPECT_TRUE(without.where().empty());
}

TEST(FunctionRef, CallsTheObjectItself) {
  int calls = 0;
  const auto count = [&calls](int by) { return calls += by; };
  const FunctionRef<int(int)> ref(count);
  EXPECT_EQ(ref(2), 2);
  EXPECT_EQ(ref(3), 5);
  EXPECT_EQ(calls, 5);
}

// An exception in one chunk reaches the caller, for one thread and for several.
TEST(Parallel, ErrorsLeaveTheLoop) {
  for (int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    EXPECT_THROW(parallel_for(
                     1000,
                     [](std::size_t i) {
                       if (i == 700) throw Error(ErrorCode::BadArgument, "here");
                     },
                     10),
                 Error);
  }
}

TEST(Parallel, EmptyRangesCallNothing) {
  parallel_chunks(0, 16, [](std::size_t, std::size_t) { ADD_FAILURE(); });
  EXPECT_EQ(
      parallel_reduce(
          0, 42, [](std::size_t, std::size_t) { return 1; }, [](int a, int b) { return a + b; }),
      42);
  std::vector<int> none;
  parallel_stable_sort(none.begin(), none.end());
}

TEST(Parallel, TheLimitEndsWithItsObject) {
  const int before = num_threads();
  {
    const ThreadLimit one(1);
    EXPECT_EQ(num_threads(), 1);
  }
  EXPECT_EQ(num_threads(), before);
}

}  // namespace
}  // namespace hexwright
