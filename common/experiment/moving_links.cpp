#include "common/experiment/moving_links.h"

#include <algorithm>

#include "common/math/elementary.h"

namespace swarmanoid
{
namespace
{

// Returns the motion of a link against the one that carries it.
Pose MotionOf(const MovingLink& link, double position)
{
  if (link.slides) return {link.axis * position, Quaternion::Identity()};
  const SinCos half = SinCosOf(position / 2);
  const Vector3 vector = link.axis * half.sin;
  const Quaternion turn(half.cos, vector.x(), vector.y(), vector.z());
  return {link.anchor - turn * link.anchor, turn};
}

}  // namespace

double MovingLink::Within(double position) const { return std::clamp(position, lowest, highest); }

std::vector<Pose> MotionsOfLinks(std::span<const MovingLink> links, std::span<const double> positions)
{
  std::vector<Pose> motions;
  motions.reserve(links.size());
  for (std::size_t k = 0; k < links.size(); ++k)
  {
    const Pose own = MotionOf(links[k], positions[k]);
    const int parent = links[k].parent;
    motions.push_back(parent == MovingLink::kBase ? own : motions[static_cast<std::size_t>(parent)].Compose(own));
  }
  return motions;
}

JointCommand JointCommand::From(std::span<const double> numbers)
{
  if (numbers[0] > 1.5) return {Mode::kVelocity, numbers[1]};
  if (numbers[0] > 0.5) return {Mode::kPosition, numbers[1]};
  return {};
}

double NextReference(const MovingLink& link, const JointCommand& command, double reference, double seconds)
{
  switch (command.mode)
  {
    case JointCommand::Mode::kVelocity:
      return link.Within(reference + std::clamp(command.value, -link.max_speed, link.max_speed) * seconds);
    case JointCommand::Mode::kPosition:
    {
      const double way =
          link.IsEndless() ? WrapAngle(command.value - reference) : link.Within(command.value) - reference;
      const double most = link.max_speed * seconds;
      return link.Within(reference + std::clamp(way, -most, most));
    }
    case JointCommand::Mode::kNone:
      break;
  }
  return reference;
}

}  // namespace swarmanoid
