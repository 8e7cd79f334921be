#include "engine_worker/engines/kinematics2d/worker_pool.h"

namespace swarmanoid::kinematics2d
{

WorkerPool::WorkerPool(unsigned threads)
{
  for (unsigned k = 1; k < threads; ++k) workers_.emplace_back([this, k] { Work(k); });
}

WorkerPool::~WorkerPool()
{
  call_ = nullptr;
  piece_.fetch_add(1);
  piece_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void WorkerPool::Run(Call call, const void* context)
{
  call_ = call;
  context_ = context;
  busy_.store(static_cast<unsigned>(workers_.size()));
  piece_.fetch_add(1);
  piece_.notify_all();
  call(context, 0);
  for (unsigned busy = busy_.load(); busy != 0; busy = busy_.load()) busy_.wait(busy);
}

void WorkerPool::Work(unsigned k)
{
  for (unsigned done = 0;; ++done)
  {
    piece_.wait(done);
    if (call_ == nullptr) return;
    call_(context_, k);
    if (busy_.fetch_sub(1) == 1) busy_.notify_one();
  }
}

}  // namespace swarmanoid::kinematics2d
