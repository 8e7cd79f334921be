// TickInputs collects what a worker needs before each of its steps: the state of the space, and one message from each
// of some other processes. Messages may be early, late or repeated. Once a tick is complete, the worker steps in the
// bus thread that brought the last message. If the step waits for others, it has its own thread. engine_worker and
// controller_host use it.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/membership/stall_detector.h"
#include "common/bus/membership/tick_gate.h"
#include "common/bus/membership/worker_session.h"
#include "common/bus/membership/worker_world.h"
#include "common/threads/waiting.h"

namespace swarmanoid
{

template <class Message>
class TickInputs
{
public:
  // It describes one of the other processes. `source`: the number in its messages.
  struct Other
  {
    std::uint32_t source;
    TickGate::Part part;
  };

  // All are called with Mutex() locked. An exception of `step` ends the run.
  struct Calls
  {
    std::function<Message*(std::size_t other, std::uint64_t tick)> place;  // returns the memory for a message
    std::function<void()> step;                                            // the inputs of tick Tick() are complete
    std::function<void()> answer_again;  // a process lacks the answer to the tick before Tick()
    // The step waits for messages of others and unlocks Mutex() meanwhile, so it has its own thread.
    bool step_waits = false;
    // Other processes may lack the last answer when this process has no more steps.
    bool answers_after_end = false;
  };

  // `late`: the worker's messages of a tick are used at the next tick. So the server does not wait for the step, and
  // may be a tick ahead.
  TickInputs(WorkerSession& session, WorkerWorld& replica, const std::vector<Other>& others, bool late = false)
      : session_(session),
        space_(*replica.space),
        limits_(*replica.limits),
        gate_(Parts(others, late), replica.FirstTick())
  {
    for (const Other& other : others)
    {
      sources_.push_back(other.source);
      session.Trust(other.part.name);
    }
  }

  // Receives the states that the server sends only to this process. `name` and `number` identify it, as in LocalState.
  // `apply` brings the space to the tick of such a state. Call it before Open.
  void HearPart(std::string name, std::uint32_t number, std::function<void(const LocalState&)> apply)
  {
    part_ = {std::move(name), number, std::move(apply)};
  }

  // Sets another tick for the first step. Call it before Open.
  void StartAt(std::uint64_t tick) { gate_.StartAt(tick); }

  // Starts to receive messages. `writers`: of all messages of this kind, for any receiver. `capacity`: bytes of the
  // largest.
  void Open(Calls calls, std::size_t capacity, unsigned writers)
  {
    calls_ = std::move(calls);
    if (calls_.step_waits) stepper_ = RunThread("steps", [this] { StepAlways(); });
    writers_ = sources_.empty() ? 0 : writers;
    if (writers_ > 0)
      others_in_.emplace(session_.GetBus(), session_.Scope(capacity, writers),
                         typename HotSubscription<Message>::Handler{
                             [this](const MessageHeader& header) { return PlaceOf(header); },
                             [this](const MessageHeader& header, Message&) { Arrived(header); },
                             [this](const MessageHeader& header, const Message& m) { limits_.Check(header, m); }});
    if (part_)
      Hear(part_in_, session_.Scope(limits_.LocalStateBytes(), 1), part_->name);
    else
      Hear(states_in_, session_.Scope(limits_.StateBytes(), 1), {});
  }

  // Stops messages and calls. It must run before anything that the calls use is destroyed.
  void Close()
  {
    states_in_.reset();
    part_in_.reset();
    others_in_.reset();
    if (!stepper_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      is_closed_ = true;
      wake_.notify_all();
    }
    stepper_.join();
  }

  // Returns whether the last state has come. Other processes may have left already.
  bool Over() const { return over_; }
  // Whether the states of the server can be read, and how many of the other writers have not been found yet.
  bool ServerIsHere() const { return (part_ ? part_in_->Writers() : states_in_->Writers()) >= 1; }
  unsigned MissingWriters() const
  {
    const unsigned here = others_in_ ? others_in_->Writers() : 0;
    return writers_ - std::min(here, writers_);
  }

  // Marks a message as present that this process has from its start, such as restored sensor values. No process sends
  // it.
  void HaveFirst(std::size_t other) { gate_.Arrived(1 + other, gate_.Tick()); }

  // If the tick takes long, returns which processes the worker waits for or, while it works, `busy`. For the main
  // thread.
  std::optional<std::string> Stall(const std::function<std::string()>& busy)
  {
    std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || is_stepping_)
    {
      session_.SetTick(stepping_);
      return stall_.Observe(stepping_, busy(), RunClock::now());
    }
    session_.SetTick(gate_.Tick());
    const bool waits = !sources_.empty() && gate_.Has(0) && !gate_.Complete();
    return stall_.Observe(gate_.Tick(), waits ? "waits for " + Joined(gate_.Missing()) : "", RunClock::now());
  }

  std::mutex& Mutex() { return mutex_; }
  // Returns the state of Tick().
  const SpaceState& State() const { return states_[gate_.Tick() % 2]; }
  // Returns whether the state of the step asks the role to save its state afterwards.
  bool Saves() const { return saves_[stepping_ % 2]; }
  std::uint64_t Tick() const { return gate_.Tick(); }
  // Ends the step of Tick().
  void Next() { gate_.Next(); }

private:
  static std::vector<TickGate::Part> Parts(const std::vector<Other>& others, bool late)
  {
    std::vector<TickGate::Part> parts{{"space server", late}};
    for (const Other& other : others) parts.push_back(other.part);
    return parts;
  }

  // Returns the index of the sender among the other processes, or their number if it is none of them.
  std::size_t OtherOf(const MessageHeader& header) const
  {
    return static_cast<std::size_t>(std::find(sources_.begin(), sources_.end(), header.source) - sources_.begin());
  }

  template <class State>
  void Hear(std::optional<HotSubscription<State>>& states_in, HotScope scope, const std::string& listener)
  {
    scope.listener = listener;
    states_in.emplace(session_.GetBus(), scope,
                      typename HotSubscription<State>::Handler{
                          [this](const MessageHeader& header) -> State* { return PlaceOfState(header); },
                          [this](const MessageHeader& header, State& state) { StateArrived(header, state); },
                          [this](const MessageHeader& header, const State& s) { limits_.Check(header, s); }});
  }

  LocalState* PlaceOfState(const MessageHeader& header)
  {
    if (header.run != session_.World().run) return nullptr;
    if (part_ && header.source != part_->number) throw BadMessage("source: it is for another process");
    const std::lock_guard lock(mutex_);
    const auto verdict = gate_.Offer(0, header.tick);
    // A repeated state is read too: it may say that the run ends here.
    return verdict == TickGate::Verdict::kExpected ? &states_[header.tick % 2] : &repeated_;
  }

  void StateArrived(const MessageHeader& header, SpaceState& state)
  {
    const std::lock_guard lock(mutex_);
    if (&state != &repeated_)
    {
      saves_[header.tick % 2] = header.save;
      gate_.Arrived(0, header.tick);
      if (header.tick == gate_.Tick() && Enter() && gate_.Complete()) Go();
    }
    else if (state.last)
    {
      if (header.tick > gate_.Tick())
        states_[header.tick % 2].last = true;  // after the step that is still lacking
      else if (header.tick + 1 >= gate_.Tick())
      {
        Finish(header.tick);
        if (calls_.answers_after_end) calls_.answer_again();
      }
    }
    else if (header.tick + 1 == gate_.Tick() || header.tick == gate_.Tick())
      // The server, or another process that this one waits for, lacks the answer to the previous tick.
      calls_.answer_again();
  }

  Message* PlaceOf(const MessageHeader& header)
  {
    if (header.run != session_.World().run) return nullptr;
    limits_.template CheckSource<Message>(header);
    const std::size_t other = OtherOf(header);
    if (other == sources_.size()) return nullptr;
    const std::lock_guard lock(mutex_);
    if (gate_.IsReplaced(1 + other, header.incarnation)) return nullptr;
    return gate_.Offer(1 + other, header.tick) == TickGate::Verdict::kExpected ? calls_.place(other, header.tick)
                                                                               : nullptr;
  }

  void Arrived(const MessageHeader& header)
  {
    const std::lock_guard lock(mutex_);
    // Once it is over, the main thread may be at the end of the role.
    if (gate_.Arrived(1 + OtherOf(header), header.tick) && !over_) Go();
  }

  // Takes the state of the tick. Returns false if it is the last one.
  bool Enter()
  {
    const LocalState& state = states_[gate_.Tick() % 2];
    if (state.last)
      Finish(state.tick);
    else if (part_)
      part_->apply(state);
    else
      space_.Apply(state);
    return !state.last;
  }

  void Finish(std::uint64_t tick)
  {
    over_ = true;
    session_.Finish(tick);
  }

  // The tick is complete.
  void Go()
  {
    if (is_stepping_) return;  // it looks again after the step
    if (!calls_.step_waits) return RunTick();
    is_here_ = true;
    wake_.notify_all();
  }

  void StepAlways()
  {
    std::unique_lock lock(mutex_);
    while (true)
    {
      wake_.wait(lock, [this] { return is_here_ || is_closed_; });
      if (is_closed_) return;
      is_here_ = false;
      RunTick();
    }
  }

  void RunTick()
  {
    try
    {
      do {
        stepping_ = gate_.Tick();
        is_stepping_ = true;
        calls_.step();
        is_stepping_ = false;
        // The next state may have come while other messages were lacking.
      } while (gate_.Has(0) && Enter() && gate_.Complete());
    }
    catch (const ActivityError& error)
    {
      session_.Fail(gate_.Tick(), error.what(), true);
    }
    catch (const std::exception& error)
    {
      session_.Fail(gate_.Tick(), error.what());
    }
  }

  WorkerSession& session_;
  CSwarmanoidSpace& space_;
  const TickLimits& limits_;
  std::vector<std::uint32_t> sources_;
  unsigned writers_ = 0;
  Calls calls_;
  std::mutex mutex_;  // protects the gate, the states and all that the calls touch
  TickGate gate_;
  std::array<LocalState, 2> states_;  // for even and odd ticks; all entities, unless this process gets a part
  std::array<bool, 2> saves_{};
  LocalState repeated_;
  struct Part
  {
    std::string name;
    std::uint32_t number;
    std::function<void(const LocalState&)> apply;
  };
  std::optional<Part> part_;  // set if the states are for this process alone
  std::atomic<std::uint64_t> stepping_ = 0;
  std::atomic<bool> over_ = false;
  bool is_stepping_ = false;
  bool is_here_ = false;    // the tick is complete; read by the stepper
  bool is_closed_ = false;  // read by the stepper
  RunCondition wake_;
  RunThread stepper_;
  StallDetector stall_;  // used by the main thread
  std::optional<HotSubscription<Message>> others_in_;
  std::optional<HotSubscription<SpaceState>> states_in_;
  std::optional<HotSubscription<LocalState>> part_in_;
};

}  // namespace swarmanoid
