#include "visualiser/control_by_requests.h"

#include "common/math/elementary.h"

namespace swarmanoid
{

void ControlByRequests::AskWithPose(const std::string& verb, const std::string& entity, const Pose& pose)
{
  const EulerAngles angles = EulerFromQuaternion(pose.orientation);
  Ask(verb, entity,
      {pose.position.x(), pose.position.y(), pose.position.z(), RadiansToDegrees(angles.alpha),
       RadiansToDegrees(angles.beta), RadiansToDegrees(angles.gamma)});
}

void ControlByRequests::Ask(const std::string& verb, const std::string& entity, const std::vector<double>& numbers)
{
  ControlRequestMessage request;
  request.verb = verb;
  request.entity = entity;
  request.numbers = numbers;
  send_(request);
}

}  // namespace swarmanoid
