// Looks back at the past of the run.
#include "visualiser/interaction/viewer.h"

#include <fmt/format.h>

#include "common/program/shell_word.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr auto kFollowPeriod = std::chrono::milliseconds(500);

}  // namespace

bool Viewer::MayLookBack()
{
  if (past_.IsThere()) return true;
  Say(may_look_back_ ? "there is nothing to look back at: the run keeps no journal here"
                     : "a window that writes frames shows the present alone",
      true);
  return false;
}

void Viewer::LookBackAt(std::uint64_t tick)
{
  if (!MayLookBack()) return;
  if (!past_.IsOn()) followed_place_.reset();
  move_.reset();
  past_.Look(tick);
}

void Viewer::LookBackBy(int ticks)
{
  const std::uint64_t from = past_.Wanted().value_or(past_.Last());
  LookBackAt(ticks < 0 && from == 0 ? 0 : from + static_cast<std::uint64_t>(ticks));
}

void Viewer::LookBackAtEvent(bool forward)
{
  if (!MayLookBack()) return;
  if (const auto tick = past_.Neighbour(forward))
    LookBackAt(*tick);
  else
    Say(forward ? "there is no event after this" : "there is no event before this");
}

void Viewer::CopyBranchCommand()
{
  if (!MayLookBack()) return;
  const std::uint64_t tick = past_.Wanted().value_or(past_.Last());
  copy_ = fmt::format("swarmanoid run --branch {}", ShellWord(fmt::format("{}@{}", past_.RunFolder(), tick)));
  Say(fmt::format("a new run from tick {}: {}", tick, copy_));
}

// Copies the command that computes what the journal lacks: the status of the selected robot.
void Viewer::CopyInspectCommand()
{
  const auto& selected = shown.scene.selected;
  if (!past_.IsOn() || !selected || Present().GetEntity(*selected).GetConfiguration().controller.empty())
    return Say("look back and select a robot with a controller first");
  const std::string& id = Present().GetEntity(*selected).GetId();
  copy_ = fmt::format("swarmanoid inspect {} {}", ShellWord(fmt::format("{}@{}", past_.RunFolder(), *past_.Wanted())),
                      ShellWord(id));
  Say(fmt::format("what '{}' sensed at tick {}: {}", id, *past_.Wanted(), copy_));
}

bool Viewer::FollowPast()
{
  const Clock::time_point now = Clock::now();
  if (may_look_back_ && now - followed_ >= kFollowPeriod)
  {
    followed_ = now;
    past_.Follow(RunFolderOf(setup_.output_folder, setup_.monitor));
  }
  const bool changed = past_.Advance(now);
  past_.Inspect(inspected_);
  if (const auto refusal = past_.TakeRefusal()) Say(*refusal, true);
  if (past_.IsOn() != was_past_) Say(past_.IsOn() ? "looking back: Q goes to the present" : "the present again");
  was_past_ = past_.IsOn();
  if (changed && past_.Space() != nullptr) FollowSelected();
  return changed;
}

}  // namespace swarmanoid
