// Every part of a piece of work is done once, whether the threads still look for it or sleep already, and by another
// thread if its own one is late.
#include "common/threads/worker_pool.h"

#include <gtest/gtest.h>

#include <atomic>
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
    for (const unsigned parts : {1U, threads, 3 * threads + 1, 300U})
    {
      WorkerPool pool(threads);
      ASSERT_EQ(pool.Threads(), threads);
      std::vector<unsigned> done(parts, 0);
      for (unsigned piece = 1; piece <= 300; ++piece)
      {
        // Now and then all of them have gone to sleep.
        if (piece % 100 == 0) std::this_thread::sleep_for(5ms);
        pool.Run(parts, [&](unsigned k) { ++done[k]; });
        ASSERT_EQ(done, std::vector<unsigned>(parts, piece));
      }
    }
}

// A pool of one thread cannot share its work, so it divides neither the work nor the sensors of its robots.
TEST(WorkerPool, OneThreadHasOnePart)
{
  EXPECT_EQ(WorkerPool(1).Parts(), 1U);
  EXPECT_EQ(WorkerPool(2).Parts(), 2 * WorkerPool::kPartsOfThread);
}

TEST(WorkerPool, NoPartIsNoWork)
{
  WorkerPool pool(2);
  pool.Run(0, [](unsigned) { FAIL(); });
}

// Each thread of the pool has a number, for what threads keep for themselves.
TEST(WorkerPool, PartsAreToldWhichThreadDoesThem)
{
  WorkerPool pool(3);
  std::vector<std::thread::id> threads(3);
  std::vector<unsigned> by(30);
  for (unsigned piece = 0; piece < 100; ++piece)
  {
    std::vector<std::thread::id> of(30);
    pool.Run(30,
             [&](unsigned k, unsigned thread)
             {
               by[k] = thread;
               of[k] = std::this_thread::get_id();
             });
    for (unsigned k = 0; k < 30; ++k)
    {
      ASSERT_LT(by[k], 3U);
      if (threads[by[k]] == std::thread::id()) threads[by[k]] = of[k];
      ASSERT_EQ(threads[by[k]], of[k]);
    }
  }
  EXPECT_EQ(threads[0], std::this_thread::get_id());
}

// A thread that is held up in a part, as by another program on its core, does not hold up the parts after it.
TEST(WorkerPool, OthersTakeThePartsOfAThreadThatIsLate)
{
  WorkerPool pool(2);
  for (const unsigned late : {0U, 4U})
  {
    std::atomic<unsigned> others = 0;
    bool in_time = false;
    pool.Run(8,
             [&](unsigned k)
             {
               if (k != late)
               {
                 ++others;
                 return;
               }
               const auto end = std::chrono::steady_clock::now() + 30s;
               while (others != 7 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
               in_time = others == 7;
             });
    EXPECT_TRUE(in_time) << late;
  }
}

TEST(WorkerPool, ItemsAreTakenOneByOne)
{
  WorkerPool pool(3);
  for (const std::size_t count : {0U, 1U, 100U})
  {
    std::vector<int> times(count, 0);
    std::atomic<unsigned> wrong = 0;
    OneByOne(pool, count,
             [&](std::size_t item, unsigned taker)
             {
               ++times[item];
               wrong += taker < pool.Threads() ? 0 : 1;
             });
    EXPECT_EQ(times, std::vector<int>(count, 1));
    EXPECT_EQ(wrong, 0U);
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
        std::vector<std::size_t> in_part(pool.Parts(), 0);
        InParts(by, count, step,
                [&](unsigned part, std::size_t begin, std::size_t end)
                {
                  EXPECT_EQ(begin % step, 0U);
                  for (std::size_t i = begin; i < end; ++i) ++times[i];
                  in_part[part] = end - begin;
                });
        EXPECT_EQ(times, std::vector<int>(count, 1));
        const bool shared = by != nullptr && count >= 1024;
        EXPECT_EQ(in_part.back() > 0, shared) << count;
        EXPECT_EQ(std::accumulate(in_part.begin(), in_part.end(), std::size_t{0}), count);
      }
}

}  // namespace
}  // namespace swarmanoid
