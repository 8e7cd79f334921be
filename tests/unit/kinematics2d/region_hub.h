// The regions of a kinematic world in one process, for tests and benchmarks. Each does its tasks in a separate thread,
// and messages are passed in memory.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <ctime>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "engine_worker/engines/kinematics2d/kinematic_world.h"
#include "engine_worker/engines/kinematics2d/plane_region.h"

namespace swarmanoid::kinematics2d
{

// Hub: passes messages between the regions of one process, each of which has a thread of its own.
class Hub
{
public:
  explicit Hub(unsigned regions) : left_(regions), taken_(regions) {}

  unsigned RegionCount() const { return static_cast<unsigned>(left_.size()); }
  // Return the number of calls of Swap so far, which is equal for each region, and the bytes of all messages.
  std::uint64_t Rounds() const { return rounds_; }
  std::uint64_t Bytes() const { return bytes_; }
  // Excludes one region, so that the others do not wait for it.
  void Break()
  {
    const std::lock_guard lock(mutex_);
    is_broken_ = true;
    changed_.notify_all();
  }
  void Swap(unsigned region, std::span<const ByteWriter> out, std::span<std::vector<char>> in)
  {
    std::unique_lock lock(mutex_);
    left_[region].clear();
    for (const ByteWriter& message : out)
    {
      left_[region].push_back(message.Bytes());
      bytes_ += message.Bytes().size();
    }
    const std::uint64_t round = rounds_;
    if (++here_ == RegionCount())
    {
      here_ = 0;
      ++rounds_;
      left_.swap(taken_);
      changed_.notify_all();
    }
    changed_.wait(lock, [&] { return rounds_ != round || is_broken_; });
    if (rounds_ == round) throw std::runtime_error("another region has ended");
    for (unsigned k = 0; k < RegionCount(); ++k) in[k] = taken_[k][region];
  }

private:
  // Guards the members below.
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::vector<std::vector<char>>> left_, taken_;  // messages by sender and receiver
  unsigned here_ = 0;
  std::uint64_t rounds_ = 0;
  std::uint64_t bytes_ = 0;
  bool is_broken_ = false;
};

class HubExchange : public RegionExchange
{
public:
  HubExchange(Hub& hub, unsigned region) : hub_(hub), region_(region) {}
  unsigned RegionCount() const override { return hub_.RegionCount(); }
  void Swap(std::span<const ByteWriter> out, std::span<std::vector<char>> in) override { hub_.Swap(region_, out, in); }

private:
  Hub& hub_;
  unsigned region_;
};

class HubTeam : public RegionTeam
{
public:
  explicit HubTeam(unsigned regions, unsigned halo = PlaneRegion::kHalo)
      : halo_(halo), hub_(std::make_unique<Hub>(regions)), places_(regions), seconds_(regions)
  {
    for (unsigned region = 0; region < regions; ++region) Replace(region);
  }

  unsigned RegionCount() const override { return static_cast<unsigned>(places_.size()); }
  bool IsReady() const override { return is_ready_; }
  void SetReady(bool is_ready) { is_ready_ = is_ready; }
  void Work(bool all_data, const WriteTasks& write, std::span<std::vector<char>> results,
            const std::function<void()>& meanwhile) override
  {
    ++works_;
    if (replaced_ && replaced_->first == works_) Replace(replaced_->second);
    all_data = std::exchange(begins_again_, false) || all_data;
    tasks_.resize(RegionCount());
    results_.resize(RegionCount());
    for (ByteWriter& task : tasks_) task.Clear();
    write(all_data, tasks_);
    meanwhile();
    std::vector<std::string> errors(RegionCount());
    std::vector<std::thread> threads;
    for (unsigned region = 0; region < RegionCount(); ++region)
      threads.emplace_back(
          [&, region]
          {
            const double start = ThreadSeconds();
            try
            {
              results_[region].Clear();
              places_[region].region->Work(tasks_[region].Bytes(), results_[region]);
              results[region] = results_[region].Bytes();
            }
            catch (const std::exception& error)
            {
              errors[region] = error.what();
              hub_->Break();
            }
            seconds_[region] = ThreadSeconds() - start;
          });
    for (std::thread& thread : threads) thread.join();
    for (const std::string& error : errors)
      if (!error.empty() && error != "another region has ended") throw std::runtime_error(error);
  }

  // Returns the number of tasks that the world has given.
  unsigned Works() const { return works_; }
  // Calls Replace when a task is done for the n-th time.
  void ReplaceAt(unsigned work, unsigned region) { replaced_.emplace(work, region); }
  // Replaces a region by a new one without any state.
  void Replace(unsigned region)
  {
    Place& place = places_[region];
    place.region.reset();
    place.exchange = std::make_unique<HubExchange>(*hub_, region);
    place.region = std::make_unique<PlaneRegion>(region, *place.exchange, halo_);
    begins_again_ = true;
  }
  const PlaneRegion& Region(unsigned region) const { return *places_[region].region; }
  const Hub& Exchanges() const { return *hub_; }
  // Returns the processor time of the calling thread.
  static double ThreadSeconds()
  {
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }

  // Returns the bytes of the last tasks.
  std::size_t TaskBytes() const
  {
    std::size_t bytes = 0;
    for (const ByteWriter& task : tasks_) bytes += task.Bytes().size();
    return bytes;
  }
  // Returns the processor time of all regions for the last tasks.
  double Seconds() const
  {
    double all = 0;
    for (const double of_one : seconds_) all += of_one;
    return all;
  }

  // Returns the seconds of the slowest region.
  double SlowestSeconds() const { return *std::max_element(seconds_.begin(), seconds_.end()); }

private:
  struct Place
  {
    std::unique_ptr<HubExchange> exchange;
    std::unique_ptr<PlaneRegion> region;
  };

  unsigned halo_;
  std::unique_ptr<Hub> hub_;
  std::vector<Place> places_;
  std::vector<double> seconds_;
  std::vector<ByteWriter> tasks_, results_;
  unsigned works_ = 0;
  std::optional<std::pair<unsigned, unsigned>> replaced_;
  bool begins_again_ = false;
  bool is_ready_ = true;
};

}  // namespace swarmanoid::kinematics2d
