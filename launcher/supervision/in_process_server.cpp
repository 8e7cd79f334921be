#include "launcher/supervision/in_process_server.h"

#include <signal.h>

#include "common/activity/activity.h"

namespace swarmanoid
{
namespace
{

// The supervisor repeats SIGKILL every 200 ms. If the server still runs after these, a user's function holds the thread
// of the run for ever.
constexpr int kMostKills = 15;

}  // namespace

bool InProcessServer::IsServer(const SpawnedProcess& process) const { return process.pid == getpid(); }

SpawnedProcess InProcessServer::Start(const ProcessCommand& command)
{
  {
    const std::lock_guard lock(mutex_);
    if (!command_)
    {
      auto [status_read, status_write] = MakePipe();
      auto [end_read, end_write] = MakePipe();
      status_ = std::move(status_write);
      end_ = std::move(end_write);
      command_ = command;
      OwnActivityPage().taken = 1;
      changed_.notify_all();
      return {getpid(),
              std::move(status_read),
              {},
              std::move(end_read),
              std::shared_ptr<const ActivityPage>(&OwnActivityPage(), [](const ActivityPage*) {})};
    }
  }
  return others_.Start(command);
}

ProcessEnd InProcessServer::Collect(const SpawnedProcess& process)
{
  if (!IsServer(process)) return others_.Collect(process);
  const std::lock_guard lock(mutex_);
  return stuck_ ? ProcessEnd{0, SIGKILL} : ProcessEnd{exit_code_, 0};
}

void InProcessServer::Signal(const SpawnedProcess& process, int signal)
{
  if (!IsServer(process)) return others_.Signal(process, signal);
  stop_ = true;
  if (signal != SIGKILL) return;
  abandon_ = true;
  const std::lock_guard lock(mutex_);
  if (++kills_ < kMostKills || stuck_ || !end_.IsOpen()) return;
  stuck_ = true;
  end_.Reset();
}

bool InProcessServer::IsStuck() const
{
  const std::lock_guard lock(mutex_);
  return stuck_;
}

void InProcessServer::Run(const Work& work)
{
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return command_ || cancelled_; });
    if (!command_) return;
  }
  const int code = work(command_->arguments, status_.Get(), stop_, abandon_);
  std::unique_lock lock(mutex_);
  while (stuck_) changed_.wait(lock);  // the process ends meanwhile
  exit_code_ = code;
  status_.Reset();
  end_.Reset();
}

void InProcessServer::Cancel()
{
  const std::lock_guard lock(mutex_);
  cancelled_ = true;
  changed_.notify_all();
}

}  // namespace swarmanoid
