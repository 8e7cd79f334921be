// Every part of a piece of work is done once, whether the threads still look for it or sleep already.
#include "common/threads/worker_pool.h"

#include <gtest/gtest.h>

#include <chrono>
#include <numeric>

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

TEST(WorkerPool, DoesEachPartOfAPieceOnce)
{
  for (const unsigned threads : {1U, 2U, 5U})
  {
    WorkerPool pool(threads);
    ASSERT_EQ(pool.Threads(), threads);
    std::vector<unsigned> done(threads, 0);
    for (unsigned piece = 1; piece <= 300; ++piece)
    {
      // Now and then all of them have gone to sleep.
      if (piece % 100 == 0) std::this_thread::sleep_for(5ms);
      pool.Run([&](unsigned k) { ++done[k]; });
      ASSERT_EQ(done, std::vector<unsigned>(threads, piece));
    }
  }
}

TEST(WorkerPool, PartsCoverAllThingsOnceWithBordersAtSteps)
{
  WorkerPool pool(3);
  for (const std::size_t count : {0U, 1U, 1023U, 1024U, 5003U})
    for (const std::size_t step : {1U, 16U})
      for (WorkerPool* by : {&pool, static_cast<WorkerPool*>(nullptr)})
      {
        std::vector<int> times(count, 0);
        std::vector<std::size_t> in_part(3, 0);
        InParts(by, count, step,
                [&](unsigned part, std::size_t begin, std::size_t end)
                {
                  EXPECT_EQ(begin % step, 0U);
                  for (std::size_t i = begin; i < end; ++i) ++times[i];
                  in_part[part] = end - begin;
                });
        EXPECT_EQ(times, std::vector<int>(count, 1));
        const bool shared = by != nullptr && count >= 1024;
        EXPECT_EQ(in_part[2] > 0, shared) << count;
        EXPECT_EQ(std::accumulate(in_part.begin(), in_part.end(), std::size_t{0}), count);
      }
}

}  // namespace
}  // namespace swarmanoid
