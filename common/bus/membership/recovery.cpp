// The new process repeats the steps of the dead one from the newest saved state, with the inputs that the journal has.
// Its own results are not sent, since the others have them. Blocks are requested one by one, so a lost message is asked
// for again. docs/recovery.md describes the method and its costs.
//
// Invariants: ticks follow each other without a gap, otherwise the recovery fails. A step begins only when the record
// after it is known or the blocks have ended, since some steps are compared with it.
#include "common/bus/membership/recovery.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "common/journal/journal_format.h"
#include "common/program/interrupts.h"
#include "common/space/space.h"
#include "common/space/state_checks.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using Clock = RunClock;

constexpr auto kAskAgain = 200ms;

// Requests the blocks from the server, one after the other.
class BlockReader
{
public:
  explicit BlockReader(WorkerSession& session)
      : session_(session),
        requests_(session.GetBus(), session.World().experiment),
        blocks_(std::make_unique<Subscription<RecoveryBlockMessage>>(session.GetBus(), session.World().experiment,
                                                                     [this](const RecoveryBlockMessage& message)
                                                                     {
                                                                       if (message.run != session_.World().run ||
                                                                           message.process != ProcessId())
                                                                         return;
                                                                       {
                                                                         const std::lock_guard lock(mutex_);
                                                                         if (message.number != wanted_ || here_) return;
                                                                         block_ = message;
                                                                         here_ = true;
                                                                       }
                                                                       session_.Notify();
                                                                     }))
  {
  }
  ~BlockReader() { blocks_.reset(); }

  // Returns the next block; empty after the last one.
  std::vector<char> Next()
  {
    {
      const std::lock_guard lock(mutex_);
      if (wanted_ > 0 && wanted_ == block_.count) return {};
    }
    std::optional<Clock::time_point> asked;
    session_.WaitUntil(
        [&]
        {
          {
            const std::lock_guard lock(mutex_);
            if (here_) return true;
          }
          if (requests_.Readers() == 0 || (asked && Clock::now() - *asked < kAskAgain)) return false;
          asked = Clock::now();
          requests_.Write({session_.World().run, ProcessId(), session_.Name(), wanted_});
          return false;
        },
        [] { return std::string("the journal of the space server"); });
    const std::lock_guard lock(mutex_);
    here_ = false;
    ++wanted_;
    return std::move(block_.block);
  }

private:
  WorkerSession& session_;
  Publisher<RecoveryRequestMessage> requests_;
  std::mutex mutex_;  // protects the following members
  std::uint32_t wanted_ = 0;
  bool here_ = false;
  RecoveryBlockMessage block_;
  std::unique_ptr<Subscription<RecoveryBlockMessage>> blocks_;
};

}  // namespace

std::uint64_t Recover(WorkerSession& session, WorkerWorld& replica, const RecoverySteps& steps)
{
  BlockReader blocks(session);
  std::uint64_t tick = replica.FirstTick();
  bool begun = false;
  const auto begin = [&]
  {
    if (!std::exchange(begun, true)) steps.begin();
  };
  std::array<TickRecord, 2> records;  // one block is kept until the next one has arrived
  TickRecord* held = nullptr;
  const auto step = [&](const TickRecord* next)
  {
    if (held == nullptr) return;
    replica.space->Apply(held->state);
    session.SetTick(tick);
    if (steps.step) steps.step(*held, next);
    held = nullptr;
    ++tick;
  };
  for (std::vector<char> block = blocks.Next(); !block.empty(); block = blocks.Next())
  {
    const auto header = JournalBlockAt(block, block.size());
    if (!header) throw BusError("the journal of the space server has another version, or is damaged");
    const std::vector<char> content = JournalContent(block);
    if (header->kind == JournalBlockKind::kSnapshot)
    {
      const SpaceSnapshot snapshot = ReadSnapshot(content);
      CheckSnapshot(*replica.space, snapshot);
      replica.space->Apply(snapshot);
      tick = snapshot.tick;
    }
    else if (header->kind == JournalBlockKind::kPart)
    {
      const SavedPart part = ReadPart(content);
      ByteReader state(part.state);
      steps.load(state);
      begun = true;
    }
    else if (header->kind == JournalBlockKind::kTicks)
    {
      begin();
      TickRecordReader reader(content, header->ticks);
      for (TickRecord* record = &records[held == &records[0] ? 1 : 0]; reader.Next(*record);)
      {
        const std::uint64_t wanted = held == nullptr ? tick : tick + 1;
        if (record->state.tick < wanted) continue;
        if (record->state.tick > wanted) throw BusError(fmt::format("the journal lacks tick {}", wanted));
        step(record);
        held = record;
        record = &records[held == &records[0] ? 1 : 0];
      }
      if (Interrupted()) throw BusError("interrupted by a signal");
    }
    else if (header->kind == JournalBlockKind::kFrames)
    {
      begin();
      step(nullptr);
      if (tick != header->first_tick)
        throw BusError(fmt::format("the journal ends at tick {}, the run is at {}", tick, header->first_tick));
      if (steps.frames) steps.frames(ReadFrames(content));
    }
  }
  step(nullptr);
  return tick;
}

void RefuseRecovery(const std::string& name, std::uint64_t tick, const std::string& what)
{
  throw BusError(fmt::format(
      "{} cannot be replaced: at tick {} the new process computed {} than the one before it; what it runs is not "
      "deterministic (docs/determinism.md)",
      name, tick, what));
}

}  // namespace swarmanoid
