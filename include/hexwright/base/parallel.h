// All threads of the library start here. Results never depend on how many there are:
// loops write by index, reductions and sorts work in fixed chunks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "hexwright/base/function_ref.h"

namespace hexwright {

/// Limits the library to `threads` threads (0 = one per core) while the object lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Number of threads a parallel loop may use now.
int num_threads();

/// Calls `body(begin, end)` for consecutive chunks of at most `grain` indices that cover 0 ..
/// count-1, in any order and on any thread. Chunk borders are multiples of `grain`, whatever the
/// number of threads. Ends with Error{Cancelled} between chunks when the caller's flag is set
/// (base/cancel.h).
void parallel_chunks(std::size_t count, std::size_t grain,
                     FunctionRef<void(std::size_t begin, std::size_t end)> body);

/// Calls `body(i)` for every index, in any order. Grain: how many calls are worth one task.
template <class Body>
void parallel_for(std::size_t count, Body&& body, std::size_t grain = 1024) {
  parallel_chunks(count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

/// Combines `map(begin, end)` of fixed chunks from left to right, so that the sum of doubles is
/// always the same.
template <class T, class Map, class Combine>
T parallel_reduce(std::size_t count, T init, Map&& map, Combine&& combine,
                  std::size_t grain = 4096) {
  if (count == 0) return init;
  std::vector<T> partial((count + grain - 1) / grain, init);
  parallel_chunks(count, grain, [&](std::size_t begin, std::size_t end) {
    partial[begin / grain] = map(begin, end);
  });
  T total = init;
  for (T& value : partial) total = combine(std::move(total), value);
  return total;
}

/// Sorts stably; the result is that of std::stable_sort for any number of threads.
template <class Iterator, class Less>
void parallel_stable_sort(Iterator first, Iterator last, Less less) {
  constexpr std::size_t kChunk = 1 << 15;
  const std::size_t count = static_cast<std::size_t>(last - first);
  if (count <= 2 * kChunk) return std::stable_sort(first, last, less);
  const auto at = [&](std::size_t i) {
    return first + static_cast<std::ptrdiff_t>(std::min(i, count));
  };
  parallel_chunks(count, kChunk, [&](std::size_t begin, std::size_t end) {
    std::stable_sort(at(begin), at(end), less);
  });
  using Value = typename std::iterator_traits<Iterator>::value_type;
  std::vector<Value> buffer(count);
  for (std::size_t width = kChunk; width < count; width *= 2) {
    parallel_chunks((count + 2 * width - 1) / (2 * width), 1, [&](std::size_t b, std::size_t e) {
      for (std::size_t k = b; k < e; ++k) {
        const std::size_t lo = 2 * width * k;
        std::merge(std::make_move_iterator(at(lo)), std::make_move_iterator(at(lo + width)),
                   std::make_move_iterator(at(lo + width)),
                   std::make_move_iterator(at(lo + 2 * width)),
                   buffer.begin() + static_cast<std::ptrdiff_t>(lo), less);
      }
    });
    std::move(buffer.begin(), buffer.end(), first);
  }
}

template <class Iterator>
void parallel_stable_sort(Iterator first, Iterator last) {
  parallel_stable_sort(first, last, std::less<>{});
}

}  // namespace hexwright
