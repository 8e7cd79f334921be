// The regions of an engine of rigid bodies in one process, for tests and benchmarks. Messages are passed in memory.
#pragma once

#include <algorithm>
#include <ctime>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine_worker/engines/rigid_bodies/region_streams.h"

namespace swarmanoid
{

// The regions of an engine in the thread of the caller.
class LocalTeam : public RegionTeam
{
public:
  // `make` makes a region before its first task.
  LocalTeam(unsigned regions, std::function<std::unique_ptr<EngineRegion>()> make)
      : make_(std::move(make)), regions_(regions), result_bytes_(regions), seconds_(regions)
  {
    for (unsigned region = 0; region < regions; ++region) Replace(region);
  }
  unsigned RegionCount() const override { return static_cast<unsigned>(regions_.size()); }
  bool IsReady() const override { return is_ready_; }
  void SetReady(bool is_ready) { is_ready_ = is_ready; }
  // Replaces a region by one without any state.
  void Replace(unsigned region)
  {
    regions_[region] = nullptr;
    begins_again_ = true;
  }
  // A region that has done the n-th task dies before the engine has its result.
  void ReplaceAt(unsigned work, unsigned region) { replaced_ = {work, region}; }

  void Work(bool all_data, const WriteTasks& write, std::span<std::vector<char>> results,
            const std::function<void()>& meanwhile) override
  {
    ++works_;
    std::vector<ByteWriter> tasks(regions_.size());
    write(std::exchange(begins_again_, false) || all_data, tasks);
    const double start = ThreadSeconds();
    meanwhile();
    meanwhile_seconds_ += ThreadSeconds() - start;
    Do(tasks, results);
    if (replaced_ && replaced_->first <= works_)
    {
      Replace(replaced_->second);
      replaced_.reset();
      begins_again_ = false;
      for (ByteWriter& task : tasks) task.Clear();
      write(true, tasks);
      Do(tasks, results);
    }
  }
  unsigned Works() const { return works_; }
  std::size_t LongestTask() const { return longest_; }
  // Returns how many regions had bodies.
  std::size_t BusyRegions() const
  {
    return static_cast<std::size_t>(std::ranges::count_if(result_bytes_, [](std::size_t bytes) { return bytes > 0; }));
  }

  // Returns the processor time that each region took so far.
  std::span<const double> Seconds() const { return seconds_; }
  // Returns the processor time of the engine while the regions work.
  double MeanwhileSeconds() const { return meanwhile_seconds_; }
  static double ThreadSeconds()
  {
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }
  // Returns the bytes of all tasks and results so far.
  std::size_t Bytes() const { return bytes_; }

private:
  void Do(std::span<const ByteWriter> tasks, std::span<std::vector<char>> results)
  {
    for (std::size_t region = 0; region < regions_.size(); ++region)
    {
      if (regions_[region] == nullptr) regions_[region] = make_();
      const double start = ThreadSeconds();
      ByteWriter result;
      regions_[region]->Work(tasks[region].Bytes(), result);
      results[region] = result.Bytes();
      result_bytes_[region] += result.Bytes().size() - RegionStreams::kAnswerHead;
      bytes_ += tasks[region].Bytes().size() + result.Bytes().size();
      seconds_[region] += ThreadSeconds() - start;
      longest_ = std::max(longest_, tasks[region].Bytes().size());
    }
  }

  std::function<std::unique_ptr<EngineRegion>()> make_;
  std::vector<std::unique_ptr<EngineRegion>> regions_;
  std::vector<std::size_t> result_bytes_;
  std::vector<double> seconds_;
  double meanwhile_seconds_ = 0;
  std::optional<std::pair<unsigned, unsigned>> replaced_;
  unsigned works_ = 0;
  std::size_t longest_ = 0, bytes_ = 0;
  bool begins_again_ = false;
  bool is_ready_ = true;
};

}  // namespace swarmanoid
