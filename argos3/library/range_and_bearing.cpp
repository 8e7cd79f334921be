// Range and bearing of robots, for loop functions: the bytes are an attribute of the sender in our space, range and
// size what the controller of the robot has.
#include <argos3/plugins/simulator/entities/rab_equipped_entity.h>

#include <algorithm>

#include "argos3/library/running.h"
#include "common/messages/range_and_bearing_message.h"
#include "common/space/space.h"

namespace argos
{
namespace
{

using swarmanoid::argos3::TheRunning;

const swarmanoid::CSwarmanoidSpaceEntity& OursOf(const CRABEquippedEntity& part)
{
  auto& robot = const_cast<CRABEquippedEntity&>(part).GetRootEntity();
  const swarmanoid::argos3::Running& running = TheRunning();
  const auto* ours =
      running.editor == nullptr ? nullptr : running.editor->GetSpace().FindEntity(running.OurId(robot.GetId()));
  if (ours == nullptr)
    THROW_ARGOSEXCEPTION("range and bearing of '" << robot.GetId() << "' is for loop functions alone, while it is in "
                                                  << "the arena");
  return *ours;
}

const swarmanoid::ControllerConfiguration& ControllerOf(const CRABEquippedEntity& part)
{
  const auto& ours = OursOf(part);
  const auto* controller =
      TheRunning().editor->GetSpace().GetExperiment().FindController(ours.GetConfiguration().controller);
  if (controller == nullptr) THROW_ARGOSEXCEPTION("robot '" << ours.GetId() << "' has no controller");
  return *controller;
}

// Five bytes each.
int NumbersOf(const CByteArray& data)
{
  return (static_cast<int>(data.Size()) + swarmanoid::kBytesInNumber - 1) / swarmanoid::kBytesInNumber;
}

}  // namespace

size_t CRABEquippedEntity::GetMsgSize() const
{
  const auto size = ControllerOf(*this).parameters.Child("argos3").GetInteger("rab_data_size", 10);
  return static_cast<size_t>(size);
}

Real CRABEquippedEntity::GetRange() const
{
  const swarmanoid::ControllerConfiguration& controller = ControllerOf(*this);
  const auto receiver =
      std::ranges::find(controller.sensors, "range_and_bearing", &swarmanoid::DeviceConfiguration::type);
  // Here it is a matter of who hears.
  if (receiver == controller.sensors.end())
    THROW_ARGOSEXCEPTION("the range of '" << const_cast<CRABEquippedEntity*>(this)->GetRootEntity().GetId()
                                          << "' is that of its sensor range_and_bearing, which it does not have");
  return receiver->tree.GetNumber("range", 3);
}

void CRABEquippedEntity::SetRange(Real range)
{
  if (range != GetRange())
    THROW_ARGOSEXCEPTION("the range of '" << GetRootEntity().GetId() << "' is " << GetRange()
                                          << " m for the whole run, not " << range
                                          << "; set rab_range in the experiment file");
}

const CByteArray& CRABEquippedEntity::GetData()
{
  const auto& ours = OursOf(*this);
  data_ = CByteArray(GetMsgSize());
  if (ours.GetAttribute("message", 0) == 0) return data_;
  std::vector<double> values;
  for (int i = 0; i < NumbersOf(data_); ++i) values.push_back(ours.GetAttribute("message", 1 + i));
  swarmanoid::UnpackBytes(values.data(), {data_.ToCArray(), data_.Size()});
  return data_;
}

void CRABEquippedEntity::SetData(const CByteArray& data)
{
  if (data.Size() != GetMsgSize())
    THROW_ARGOSEXCEPTION("messages of '" << GetRootEntity().GetId() << "' have " << GetMsgSize() << " bytes, not "
                                         << data.Size());
  std::vector<double> values(static_cast<std::size_t>(NumbersOf(data)));
  swarmanoid::PackBytes({data.ToCArray(), data.Size()}, values.data());
  const std::string id = OursOf(*this).GetId();
  TheRunning().editor->SetAttribute(id, "message", 1, 0);
  for (int i = 0; i < NumbersOf(data); ++i)
    TheRunning().editor->SetAttribute(id, "message", values[static_cast<std::size_t>(i)], i + 1);
}

}  // namespace argos
