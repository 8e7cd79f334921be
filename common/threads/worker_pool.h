// Threads that do the parts of one piece of work and wait for the next one. A process or one role owns the pool; its
// calls come from one thread. It allocates nothing while it works.
//
// A tick has many pieces in quick succession, and waking a sleeping thread takes some 50 us. So threads spin for about
// that long before they sleep. The threads of one process should be in one pool, since the spinning threads of another
// pool take its cores.
//
// Each thread begins with parts of its own, the same in each piece, whose data its core may still have. A thread that
// has done its own takes parts of others (work stealing), so a thread that is late, or whose core another program uses,
// delays a piece by one part at most.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <type_traits>
#include <vector>

namespace swarmanoid
{

class WorkerPool
{
public:
  static constexpr unsigned kPartsOfThread = 4;

  // `threads`: the number of working threads, including the caller.
  explicit WorkerPool(unsigned threads) : own_(threads)
  {
    for (unsigned k = 1; k < threads; ++k) workers_.emplace_back([this, k] { Work(k); });
  }
  ~WorkerPool()
  {
    ends_.store(true);
    piece_.fetch_add(1);
    piece_.notify_all();
    for (std::thread& worker : workers_) worker.join();
  }
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  unsigned Threads() const { return static_cast<unsigned>(own_.size()); }
  // Returns the number of parts into which work of many equal items should be divided.
  unsigned Parts() const { return Threads() == 1 ? 1 : Threads() * kPartsOfThread; }
  // Returns whether code with work for the threads must share it now, or do it alone. (Run does not check.)
  bool Shares() const { return shares_; }
  void Share(bool shares) { shares_ = shares; }
  // Calls part(k), or part(k, thread), for every k below `parts` (below 65,536) in one of the threads, and returns when
  // all are done. Parts must not throw, and must write to separate memory.
  template <class Part>
  void Run(unsigned parts, const Part& part)
  {
    context_ = &part;
    call_ = [](const void* context, unsigned k, unsigned thread)
    {
      const Part& act = *static_cast<const Part*>(context);
      if constexpr (std::is_invocable_v<const Part&, unsigned, unsigned>)
        act(k, thread);
      else
        act(k);
    };
    left_.store(parts);
    const unsigned threads = Threads();
    for (unsigned k = 0; k < threads; ++k) own_[k].parts.store(parts * k / threads << 16 | parts * (k + 1) / threads);
    piece_.fetch_add(1);
    piece_.notify_all();
    TakeParts(0);
    for (unsigned left = left_.load(); left != 0; left = left_.load()) Await(left_, left);
  }

private:
  // Names the parts of a thread that no thread has taken. The upper 16 bits are the number of the first one, and the
  // lower 16 bits are the number behind the last one. Each object has a cache line of its own.
  struct alignas(64) Own
  {
    std::atomic<std::uint32_t> parts = 0;
  };

  // Waits until the number has another value.
  static void Await(const std::atomic<unsigned>& number, unsigned value)
  {
    constexpr unsigned kLooks = 2000;
    for (unsigned look = 0; look < kLooks; ++look)
    {
      if (number.load() != value) return;
#if defined(__x86_64__) || defined(__i386__)
      __builtin_ia32_pause();
#endif
    }
    number.wait(value);
  }

  // Takes parts until there are none, first those of the thread itself. A part that is taken belongs to the present
  // piece, even if the thread has slept through others, and the piece does not end before it is done.
  void TakeParts(unsigned thread)
  {
    for (unsigned k = 0; k < Threads(); ++k)
    {
      std::atomic<std::uint32_t>& parts = own_[(thread + k) % Threads()].parts;
      for (std::uint32_t open = parts.load(); (open >> 16) < (open & 0xffffU);)
      {
        // The owner goes up from the first, others go down from the last.
        const bool is_owner = k == 0;
        if (!parts.compare_exchange_weak(open, is_owner ? open + 0x10000U : open - 1)) continue;
        call_(context_, is_owner ? open >> 16 : (open & 0xffffU) - 1, thread);
        if (left_.fetch_sub(1) == 1) left_.notify_one();
        open = parts.load();
      }
    }
  }

  void Work(unsigned thread)
  {
    for (unsigned seen = 0; !ends_.load();)
    {
      Await(piece_, seen);
      seen = piece_.load();
      TakeParts(thread);
    }
  }

  bool shares_ = true;
  void (*call_)(const void* context, unsigned k, unsigned thread) = nullptr;
  const void* context_ = nullptr;
  std::vector<Own> own_;             // of each thread; what is stored there publishes call_ and context_
  std::atomic<unsigned> piece_ = 0;  // number of the present piece
  std::atomic<unsigned> left_ = 0;   // parts that are not done
  std::atomic<bool> ends_ = false;
  std::vector<std::thread> workers_;
};

// Returns the pool if it exists and shares now; else nullptr, as for one thread.
inline WorkerPool* IfItShares(WorkerPool* pool) { return pool != nullptr && pool->Shares() ? pool : nullptr; }

// Does `count` items of work in WorkerPool::Parts, or in one part if they are few: work(part, begin, end). Borders are
// multiples of `step`. With fewer than `least` items, waking threads takes longer than they do.
template <class Work>
void InParts(WorkerPool* pool, std::size_t count, std::size_t step, const Work& work, std::size_t least = 1024)
{
  if (pool == nullptr || count < least)
  {
    work(0U, std::size_t{0}, count);
    return;
  }
  const std::size_t parts = pool->Parts();
  const std::size_t steps = (count + step - 1) / step;
  pool->Run(pool->Parts(),
            [&](unsigned k)
            {
              const std::size_t begin = steps * k / parts * step;
              const std::size_t end = k + 1 == parts ? count : steps * (k + 1) / parts * step;
              work(k, begin, end);
            });
}

// Does `count` items of work in turn: work(item, taker). Each of the WorkerPool::Threads takers takes the next item
// when it has done its own.
template <class Work>
void OneByOne(WorkerPool& pool, std::size_t count, const Work& work)
{
  std::atomic<std::size_t> next = 0;
  pool.Run(pool.Threads(),
           [&](unsigned taker)
           {
             for (std::size_t item = next.fetch_add(1); item < count; item = next.fetch_add(1)) work(item, taker);
           });
}

}  // namespace swarmanoid
