#include "common/math/elementary.h"
#include "idl/control_request_message.h"
#include "visualiser/render.h"

namespace swarmanoid
{
namespace
{

std::vector<double> NumbersOf(const Pose& pose)
{
  const EulerAngles angles = EulerFromQuaternion(pose.orientation);
  return {pose.position.x(),
          pose.position.y(),
          pose.position.z(),
          RadiansToDegrees(angles.alpha),
          RadiansToDegrees(angles.beta),
          RadiansToDegrees(angles.gamma)};
}

}  // namespace

void ExperimentControl::Pause() { Ask({"pause"}); }

void ExperimentControl::Resume() { Ask({"resume"}); }

void ExperimentControl::Step(unsigned ticks) { Ask({"step", {{"ticks", std::int64_t{ticks}}}}); }

void ExperimentControl::SetSpeed(double real_time_factor) { Ask({"speed", {{"factor", real_time_factor}}}); }

void ExperimentControl::MoveEntity(const std::string& id, const Pose& pose)
{
  Ask({"move", {{"entity", id}, {"pose", NumbersOf(pose)}}});
}

void ExperimentControl::AddEntity(const std::string& id, const Pose& pose)
{
  Ask({"add", {{"entity", id}, {"pose", NumbersOf(pose)}}});
}

void ExperimentControl::RemoveEntity(const std::string& id) { Ask({"remove", {{"entity", id}}}); }

void ExperimentControl::PressKey(const std::string& key, bool pressed)
{
  Ask({pressed ? "press" : "release", {{"key", key}}});
}

void ExperimentControl::SelectEntity(const std::string& id)
{
  if (id.empty())
    Ask({"deselect"});
  else
    Ask({"select", {{"entity", id}}});
}

void ExperimentControl::Stop() { Ask({"stop"}); }

void ExperimentControl::Reset() { Ask({"reset"}); }

}  // namespace swarmanoid
