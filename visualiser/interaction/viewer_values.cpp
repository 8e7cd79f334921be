// The motions of inspected entities, and plots of their values.
#include "visualiser/interaction/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"
#include "common/space/space.h"

namespace swarmanoid
{

bool Viewer::IsPlotted(const ValueName& value) const
{
  return std::any_of(plots_.begin(), plots_.end(), [&](const Plot& plot) { return plot.value == value; });
}

void Viewer::SetPlotted(const ValueName& value, const std::string& unit, bool plotted)
{
  if (plotted == IsPlotted(value)) return;
  if (!plotted)
  {
    std::erase_if(plots_, [&](const Plot& plot) { return plot.value == value; });
    return;
  }
  const bool device = value.source == ValueGroup::Source::kSensor || value.source == ValueGroup::Source::kActuator;
  plots_.push_back(
      {value,
       fmt::format("{} {}{}", Space().GetEntity(value.entity).GetId(), device ? value.group + " " : "", value.name),
       unit,
       {}});
  shown.plots = true;
}

std::optional<EntityMotion> Viewer::Motion(std::uint32_t entity) const
{
  if (past_.Space() != nullptr) return std::nullopt;
  return MotionNow(entity);
}

EntityMotion Viewer::MotionNow(std::uint32_t entity) const
{
  const auto found = tracks_.find(entity);
  return found == tracks_.end() ? EntityMotion{} : found->second.motion;
}

std::vector<std::uint32_t> Viewer::Watched() const
{
  std::vector<std::uint32_t> watched = inspected_;
  for (const Plot& plot : plots_) watched.push_back(plot.value.entity);
  std::sort(watched.begin(), watched.end());
  watched.erase(std::unique(watched.begin(), watched.end()), watched.end());
  return watched;
}

void Viewer::StateCame()
{
  const double time = Present().GetTime();
  for (const std::uint32_t entity : Watched())
  {
    const Pose pose = Present().GetPose(entity);
    Track& track = tracks_.try_emplace(entity, Track{time, pose, {}}).first->second;
    if (const double passed = time - track.time; passed > 0)
    {
      track.motion.speed = (pose.position - track.pose.position).norm() / passed;
      track.motion.turn = RadiansToDegrees(WrapAngle(YawOf(pose.orientation) - YawOf(track.pose.orientation))) / passed;
    }
    track.time = time;
    track.pose = pose;
  }
  for (Plot& plot : plots_)
  {
    const std::uint32_t entity = plot.value.entity;
    const RobotStatus* robot = setup_.monitor == nullptr ? nullptr : setup_.monitor->Robot(entity);
    const auto value = FindValue(ValuesOf(Present(), entity, MotionNow(entity), robot), plot.value);
    if (value && std::isfinite(value->value)) plot.history.Add(time, value->value);
  }

  if (past_.Space() == nullptr) FollowSelected();
}

}  // namespace swarmanoid
