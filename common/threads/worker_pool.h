// Threads that do the parts of one piece of work and wait for the next one. A process or one role owns the pool; its
// calls come from one thread. It allocates nothing while it works.
//
// A tick has many pieces in quick succession, and waking a sleeping thread takes some 50 us. So threads spin for about
// that long before they sleep. The threads of one process should be in one pool, since the spinning threads of another
// pool take its cores.
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace swarmanoid
{

class WorkerPool
{
public:
  // `threads`: the number of working threads, including the caller.
  explicit WorkerPool(unsigned threads)
  {
    for (unsigned k = 1; k < threads; ++k) workers_.emplace_back([this, k] { Work(k); });
  }
  ~WorkerPool()
  {
    call_ = nullptr;
    piece_.fetch_add(1);
    piece_.notify_all();
    for (std::thread& worker : workers_) worker.join();
  }
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  unsigned Threads() const { return static_cast<unsigned>(workers_.size()) + 1; }
  // Returns whether code with work for the threads must share it now, or do it alone. (Run does not check.)
  bool Shares() const { return shares_; }
  void Share(bool shares) { shares_ = shares; }
  // Calls part(k) for every k below Threads(), each in its own thread, and returns when all are done. Parts must not
  // throw, and must write to separate memory.
  template <class Part>
  void Run(const Part& part)
  {
    context_ = &part;
    call_ = [](const void* context, unsigned k) { (*static_cast<const Part*>(context))(k); };
    busy_.store(static_cast<unsigned>(workers_.size()));
    piece_.fetch_add(1);
    piece_.notify_all();
    part(0U);
    for (unsigned busy = busy_.load(); busy != 0; busy = busy_.load()) Await(busy_, busy);
  }

private:
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

  void Work(unsigned k)
  {
    for (unsigned done = 0;; ++done)
    {
      Await(piece_, done);
      if (call_ == nullptr) return;
      call_(context_, k);
      if (busy_.fetch_sub(1) == 1) busy_.notify_one();
    }
  }

  bool shares_ = true;
  void (*call_)(const void* context, unsigned k) = nullptr;  // nullptr ends the threads
  const void* context_ = nullptr;
  std::atomic<unsigned> piece_ = 0;  // number of the current piece; its change publishes call_ and context_
  std::atomic<unsigned> busy_ = 0;   // threads that have not finished their part
  std::vector<std::thread> workers_;
};

// Returns the pool if it exists and shares now; else nullptr, as for one thread.
inline WorkerPool* IfItShares(WorkerPool* pool) { return pool != nullptr && pool->Shares() ? pool : nullptr; }

// Does `count` items of work in one part for each thread, or in one part if they are few: work(part, begin, end).
// Borders are multiples of `step`.
template <class Work>
void InParts(WorkerPool* pool, std::size_t count, std::size_t step, const Work& work)
{
  constexpr std::size_t kLeast = 1024;  // with fewer items, waking threads takes longer
  if (pool == nullptr || count < kLeast)
  {
    work(0U, std::size_t{0}, count);
    return;
  }
  const std::size_t threads = pool->Threads();
  const std::size_t steps = (count + step - 1) / step;
  pool->Run(
      [&](unsigned k)
      {
        const std::size_t begin = steps * k / threads * step;
        const std::size_t end = k + 1 == threads ? count : steps * (k + 1) / threads * step;
        work(k, begin, end);
      });
}

}  // namespace swarmanoid
