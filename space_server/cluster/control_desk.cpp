#include "space_server/cluster/control_desk.h"

#include <fmt/format.h>
#include <cmath>
#include <numbers>

namespace swarmanoid
{

ControlDesk::ControlDesk(ServerSession& session, const Experiment& experiment, bool paused, double real_time_factor)
    : session_(session), experiment_(experiment), paused_(paused), real_time_factor_(real_time_factor)
{
}

void ControlDesk::Ask(const ControlRequestMessage& request)
{
  const std::lock_guard lock(mutex_);
  requests_.push_back(request);
}

void ControlDesk::Start(std::uint64_t tick, Clock::time_point now) { SetPace(tick, now); }

void ControlDesk::SetPace(std::uint64_t tick, Clock::time_point now)
{
  pace_tick_ = tick;
  pace_start_ = now;
  pace_changed_ = false;
}

bool ControlDesk::WantsHold() const
{
  if (stop_ || paused_) return true;
  const std::lock_guard lock(mutex_);
  return !requests_.empty();
}

void ControlDesk::Stop() { stop_ = true; }

void ControlDesk::Work(SpaceServer& server)
{
  const std::uint64_t tick = server.Space().GetTick();
  if (pause_at_ != 0 && tick >= pause_at_)
  {
    pause_at_ = 0;
    paused_ = true;
    if (step_) session_.Reply(*step_, true, tick, fmt::format("paused at tick {}", tick));
    step_.reset();
  }
  std::vector<ControlRequestMessage> requests;
  {
    const std::lock_guard lock(mutex_);
    requests.swap(requests_);
  }
  for (const ControlRequestMessage& request : requests) Carry(request, server);
  if (stop_) server.Finish();
}

void ControlDesk::Carry(const ControlRequestMessage& request, SpaceServer& server)
{
  const std::uint64_t tick = server.Space().GetTick();
  const auto reply = [&](bool ok, const std::string& text) { session_.Reply(request, ok, tick, text); };
  const double number = request.numbers.empty() ? std::nan("") : request.numbers[0];

  if (request.verb == "pause")
  {
    paused_ = true;
    pause_at_ = 0;
    reply(true, fmt::format("paused at tick {}", tick));
  }
  else if (request.verb == "resume")
  {
    paused_ = false;
    pause_at_ = 0;
    pace_changed_ = true;
    reply(true, fmt::format("resumed at tick {}", tick));
  }
  else if (request.verb == "step")
  {
    const double count = request.numbers.empty() ? 1 : number;
    if (!(count >= 1 && count <= 1e15 && count == std::floor(count)))
      return reply(false, "step: the number of ticks must be a whole number from 1 on");
    if (step_) session_.Reply(*step_, false, tick, "another step was asked for");
    step_ = request;
    pause_at_ = tick + static_cast<std::uint64_t>(count);
    paused_ = false;
    pace_changed_ = true;
  }
  else if (request.verb == "speed")
  {
    if (!(number >= 0 && number <= 1e9))
      return reply(false, "speed: the factor must be 0 (as fast as possible) or more");
    real_time_factor_ = number;
    pace_changed_ = true;
    reply(true, number == 0 ? std::string("as fast as possible") : fmt::format("{:g} times real time", number));
  }
  else if (request.verb == "stop")
  {
    stop_ = true;
    reply(true, fmt::format("stopped at tick {}", tick));
  }
  else if (request.verb == "move")
  {
    const std::string error = Move(request, server);
    reply(error.empty(), error.empty() ? fmt::format("moved '{}' at tick {}", request.entity, tick) : error);
  }
  else
    reply(false, fmt::format("unknown request '{}'; known: pause, resume, step, speed, stop, move", request.verb));
}

std::string ControlDesk::Move(const ControlRequestMessage& request, SpaceServer& server) const
{
  const CSwarmanoidSpaceEntity* entity = server.Space().FindEntity(request.entity);
  if (entity == nullptr) return fmt::format("move: there is no entity '{}'", request.entity);
  if (!entity->IsMovable()) return fmt::format("move: '{}' cannot move", request.entity);
  const auto& numbers = request.numbers;
  if (numbers.size() != 3 && numbers.size() != 6) return "move: write X,Y,Z or X,Y,Z,ALPHA,BETA,GAMMA";
  for (const double number : numbers)
    if (!std::isfinite(number)) return "move: the numbers must be finite";

  Pose pose = entity->GetPose();
  pose.position = {numbers[0], numbers[1], numbers[2]};
  const Vector3& size = experiment_.arena_size;
  for (int axis = 0; axis < 3; ++axis)
    if (pose.position[axis] < 0 || pose.position[axis] > size[axis])
      return fmt::format("move: {:g}, {:g}, {:g} is outside the arena, which reaches from 0, 0, 0 to {:g}, {:g}, {:g}",
                         numbers[0], numbers[1], numbers[2], size.x(), size.y(), size.z());
  constexpr double kRadians = std::numbers::pi / 180;
  if (numbers.size() == 6)
    pose.orientation = QuaternionFromEuler({numbers[3] * kRadians, numbers[4] * kRadians, numbers[5] * kRadians});
  server.Move({entity->GetIndex(), pose});
  return {};
}

ControlDesk::Decision ControlDesk::Decide(std::uint64_t tick, Clock::time_point now)
{
  Decision decision;
  if (stop_)
  {
    decision.go = true;
    return decision;
  }
  if (paused_) return decision;
  if (pace_changed_) SetPace(tick, now);
  if (real_time_factor_ > 0)
  {
    const double due_s = static_cast<double>(tick - pace_tick_) * experiment_.TickSeconds() / real_time_factor_;
    const auto due = pace_start_ + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due_s));
    if (due > now)
    {
      decision.due = due;
      return decision;
    }
    decision.until = tick + 1;
  }
  else
    decision.until = pause_at_;
  decision.go = true;
  return decision;
}

void ControlDesk::Ended(std::uint64_t tick)
{
  if (step_) session_.Reply(*step_, true, tick, fmt::format("the run ended at tick {}", tick));
  const std::lock_guard lock(mutex_);
  for (const ControlRequestMessage& request : requests_)
    session_.Reply(request, false, tick, fmt::format("the run ended at tick {}", tick));
  requests_.clear();
}

}  // namespace swarmanoid
