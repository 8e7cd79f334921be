// The connection of a split engine of rigid bodies with its regions: streams of bytes of any length, in both
// directions. A message has a limit, so that a stream is cut into pieces, and each piece is a task of its own.
// RegionStreams is the engine's side, and StreamedRegion is the side of a region. Regions that solve contact groups
// need no other region.
//
// A task has one byte, EStreamStep; whether the stream ends (1) or goes on (0); and the bytes of the piece. An answer
// has whether the result ends, and the bytes of its piece; it is empty until the stream has ended.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "common/messages/regions.h"
#include "common/threads/worker_pool.h"

namespace swarmanoid
{

enum class EStreamStep : std::uint8_t
{
  kGoesOn,
  kBegins,
  kNextOfResult  // the task has no piece; the region sends the next piece of its result
};

class RegionStreams
{
public:
  static constexpr std::size_t kPiece = 1 << 19;  // bytes that go at once
  static constexpr std::size_t kAnswerHead = 9;   // bytes of an answer without a piece

  // `team` outlives it.
  explicit RegionStreams(RegionTeam& team);

  std::size_t Count() const { return streams_.size(); }
  bool AreReady() const { return team_.IsReady(); }

  // Fills in the stream of each region. If `all_data` is true, the regions know nothing. Called again if a process has
  // replaced a region.
  using Write = std::function<void(bool all_data, std::span<ByteWriter> streams)>;
  // Sends the streams and receives the results. Calls meanwhile() once, while the regions work.
  void Run(const Write& write, const std::function<void()>& meanwhile);
  // Returns the result of a region, until the next call of Run.
  std::span<const char> ResultOf(std::size_t region) const { return results_[region]; }

  // These choose the region of a group by loads, such as numbers of bodies. The choice decides no bit.
  void ForgetLoads();
  void AddLoad(std::size_t region, std::size_t load) { loads_[region] += load; }
  std::uint32_t ChooseRegion(std::size_t load);
  std::size_t LoadOf(std::size_t region) const { return loads_[region]; }

private:
  bool WriteTasks(std::size_t piece, std::span<ByteWriter> tasks) const;

  RegionTeam& team_;
  bool know_all_ = false;  // the regions have done all tasks so far
  std::vector<ByteWriter> streams_;
  std::vector<std::vector<char>> answers_, results_;
  std::vector<std::uint8_t> is_result_here_;
  std::vector<std::size_t> loads_;
};

class StreamedRegion : public EngineRegion
{
public:
  void Work(std::span<const char> task, ByteWriter& answer) final;

protected:
  // Executes a stream of the engine and fills in the result. Throws std::runtime_error if it cannot be executed.
  virtual void Execute(std::span<const char> stream, ByteWriter& result) = 0;

private:
  void Answer(ByteWriter& answer);

  std::vector<char> stream_;  // the pieces so far
  ByteWriter result_;
  std::size_t answered_ = 0;  // bytes of result_
};

// Calls work(k) for each k below `count` in all threads of a pool, or in this thread if it is nullptr. Each thread
// takes the next k when it has done its own. If calls throw, throws the exception of the smallest k.
void ShareWork(WorkerPool* pool, std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace swarmanoid
