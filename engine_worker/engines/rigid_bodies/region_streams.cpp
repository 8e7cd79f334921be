#include "engine_worker/engines/rigid_bodies/region_streams.h"

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <utility>

namespace swarmanoid
{

RegionStreams::RegionStreams(RegionTeam& team)
    : team_(team),
      streams_(team.RegionCount()),
      answers_(team.RegionCount()),
      results_(team.RegionCount()),
      is_result_here_(team.RegionCount()),
      loads_(team.RegionCount())
{
}

void RegionStreams::ForgetLoads() { std::ranges::fill(loads_, 0); }

std::uint32_t RegionStreams::ChooseRegion(std::size_t load)
{
  const auto least = std::ranges::min_element(loads_);
  *least += load;
  return static_cast<std::uint32_t>(least - loads_.begin());
}

void RegionStreams::Run(const Write& write, const std::function<void()>& meanwhile)
{
  bool is_first = true;
  bool is_sent = false;
  bool is_done = false;
  for (std::size_t piece = 0; !is_done; ++piece)
  {
    team_.Work(
        !know_all_ && piece == 0,
        [&](bool all_data, std::span<ByteWriter> tasks)
        {
          if (all_data) piece = 0;
          if (piece == 0)
          {
            for (ByteWriter& stream : streams_) stream.Clear();
            write(all_data || !know_all_, streams_);
            for (std::vector<char>& result : results_) result.clear();
            std::ranges::fill(is_result_here_, 0);
          }
          is_sent = WriteTasks(piece, tasks);
        },
        answers_,
        [&]
        {
          if (std::exchange(is_first, false)) meanwhile();
        });
    is_done = is_sent;
    for (std::size_t region = 0; is_sent && region < answers_.size(); ++region)
    {
      ByteReader answer(answers_[region]);
      const bool is_last = answer.Get<std::uint8_t>() != 0;
      const std::span<const char> part = answer.GetImage<char>();
      if (is_result_here_[region] == 0) results_[region].insert(results_[region].end(), part.begin(), part.end());
      is_result_here_[region] = is_last ? 1 : 0;
      is_done = is_done && is_last;
    }
  }
  know_all_ = true;
}

// Writes the tasks of one piece. Returns true if all streams have ended.
bool RegionStreams::WriteTasks(std::size_t piece, std::span<ByteWriter> tasks) const
{
  std::size_t longest = 0;
  for (const ByteWriter& stream : streams_) longest = std::max(longest, stream.Bytes().size());
  const std::size_t pieces = std::max<std::size_t>(1, (longest + kPiece - 1) / kPiece);
  for (std::size_t region = 0; region < tasks.size(); ++region)
  {
    const std::span<const char> bytes(streams_[region].Bytes());
    const std::span<const char> rest = bytes.subspan(std::min(piece * kPiece, bytes.size()));
    tasks[region].Put(piece == 0       ? EStreamStep::kBegins
                      : piece < pieces ? EStreamStep::kGoesOn
                                       : EStreamStep::kNextOfResult);
    tasks[region].Put(static_cast<std::uint8_t>(piece + 1 >= pieces ? 1 : 0));
    tasks[region].PutArray(rest.first(std::min(rest.size(), kPiece)));
  }
  return piece + 1 >= pieces;
}

void StreamedRegion::Work(std::span<const char> task, ByteWriter& answer)
{
  ByteReader reader(task);
  const auto step = reader.Get<EStreamStep>();
  const bool ends = reader.Get<std::uint8_t>() != 0;
  const std::span<const char> part = reader.GetImage<char>();
  if (step == EStreamStep::kNextOfResult) return Answer(answer);
  if (step == EStreamStep::kBegins) stream_.clear();
  result_.Clear();
  answered_ = 0;
  stream_.insert(stream_.end(), part.begin(), part.end());
  if (ends) Execute(stream_, result_);
  Answer(answer);
}

void StreamedRegion::Answer(ByteWriter& answer)
{
  const std::span<const char> rest = std::span<const char>(result_.Bytes()).subspan(answered_);
  const std::size_t part = std::min(rest.size(), RegionStreams::kPiece);
  answer.Put(static_cast<std::uint8_t>(part == rest.size() ? 1 : 0));
  answer.PutArray(rest.first(part));
  answered_ += part;
}

void ShareWork(WorkerPool* pool, std::size_t count, const std::function<void(std::size_t)>& work)
{
  std::vector<std::exception_ptr> errors(count);
  const auto item = [&](std::size_t k, unsigned)
  {
    try
    {
      work(k);
    }
    catch (...)
    {
      errors[k] = std::current_exception();
    }
  };
  if (pool != nullptr && count > 1)
    OneByOne(*pool, count, item);
  else
    for (std::size_t k = 0; k < count; ++k) item(k, 0);
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace swarmanoid
