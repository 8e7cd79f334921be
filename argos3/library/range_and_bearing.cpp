// Range and bearing of robots for loop functions. The bytes are an attribute of the sender in our space. Range and size
// are those of the robot's controller.
#include <argos3/core/simulator/simulator.h>
#include <argos3/plugins/simulator/media/rab_medium.h>

#include <algorithm>

#include "argos3/library/running.h"
#include "common/messages/range_and_bearing_message.h"
#include "common/plugin_descriptions/antenna.h"
#include "common/space/attributes.h"
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

// Each number holds five bytes.
int NumbersOf(const CByteArray& data)
{
  return (static_cast<int>(data.Size()) + swarmanoid::kBytesInNumber - 1) / swarmanoid::kBytesInNumber;
}

// Returns the number of the medium and the size of messages; -1 if there is one of them.
SInt64 ChannelOf(const swarmanoid::ControllerConfiguration& controller)
{
  return controller.parameters.Child("argos3").GetInteger("radio_channel", -1);
}

void Send(const std::string& ours, CByteArray data)
{
  const swarmanoid::CSwarmanoidSpace& space = TheRunning().editor->GetSpace();
  const auto* robot = space.FindEntity(ours);
  const auto* controller =
      robot == nullptr ? nullptr : space.GetExperiment().FindController(robot->GetConfiguration().controller);
  if (controller != nullptr && ChannelOf(*controller) >= 0) data << static_cast<UInt8>(ChannelOf(*controller));
  std::vector<double> values(static_cast<std::size_t>(NumbersOf(data)));
  swarmanoid::PackBytes({data.ToCArray(), data.Size()}, values.data());
  TheRunning().editor->SetAttribute(ours, "message", 1, 0);
  for (int i = 0; i < NumbersOf(data); ++i)
    TheRunning().editor->SetAttribute(ours, "message", values[static_cast<std::size_t>(i)], i + 1);
}

// The bytes of a message to which loop functions have a reference, until their function ends.
struct LentMessage
{
  std::shared_ptr<const CByteArray> bytes;
  CByteArray before;
  std::string ours;
};
std::vector<LentMessage>& Lent()
{
  static std::vector<LentMessage> lent;
  return lent;
}

void SendWritten()
{
  for (LentMessage& lent : Lent())
  {
    if (*lent.bytes == lent.before) continue;
    CByteArray data = *lent.bytes;
    data.Resize(lent.before.Size());
    Send(lent.ours, data);
    lent.before = *lent.bytes;
  }
}

// Returns whether it has a controller with range and bearing, which determines the range.
bool Communicates(const CRABEquippedEntity& part)
{
  const auto& ours = OursOf(part);
  const auto* controller =
      TheRunning().editor->GetSpace().GetExperiment().FindController(ours.GetConfiguration().controller);
  return controller != nullptr &&
         std::ranges::find(controller->sensors, "range_and_bearing", &swarmanoid::DeviceConfiguration::type) !=
             controller->sensors.end();
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
  if (receiver == controller.sensors.end())
    THROW_ARGOSEXCEPTION("the range of '" << const_cast<CRABEquippedEntity*>(this)->GetRootEntity().GetId()
                                          << "' is that of its sensor range_and_bearing, which it does not have");
  // The range of a message is its sender's. Without a range of its own, it is that of all receivers.
  const auto sender =
      std::ranges::find(controller.actuators, "range_and_bearing", &swarmanoid::DeviceConfiguration::type);
  if (sender != controller.actuators.end() && sender->tree.Value("range")) return sender->tree.GetNumber("range");
  return receiver->tree.GetNumber("range", 3);
}

void CRABEquippedEntity::SetRange(Real range)
{
  if (range != GetRange())
    THROW_ARGOSEXCEPTION("the range of '" << GetRootEntity().GetId() << "' is " << GetRange()
                                          << " m for the whole run, not " << range
                                          << "; set rab_range in the experiment file");
}

CEmbodiedEntity& CRABEquippedEntity::GetEntityBody() const
{
  return dynamic_cast<CBodyEntity&>(const_cast<CRABEquippedEntity*>(this)->GetRootEntity()).GetEmbodiedEntity();
}

const CVector3& CRABEquippedEntity::GetPosition() const
{
  const SAnchor& body = GetEntityBody().GetOriginAnchor();
  m_cPosition = body.Position + CVector3(0, 0, swarmanoid::kAntennaHeight_m).Rotate(body.Orientation);
  return m_cPosition;
}

const CQuaternion& CRABEquippedEntity::GetOrientation() const { return GetEntityBody().GetOriginAnchor().Orientation; }

const CRABEquippedEntity::TSet& CRABMedium::GetRABsCommunicatingWith(CRABEquippedEntity& receiver) const
{
  CRABEquippedEntity::TSet& heard = heard_[receiver.GetRootEntity().GetId()];
  heard.clear();
  const swarmanoid::ControllerConfiguration& controller = ControllerOf(receiver);
  const auto sensor =
      std::ranges::find(controller.sensors, "range_and_bearing", &swarmanoid::DeviceConfiguration::type);
  const bool needs_sight = sensor == controller.sensors.end() || sensor->tree.GetBoolean("line_of_sight", true);
  for (CEntity* entity : CSimulator::GetInstance().GetSpace().GetRootEntityVector())
  {
    auto* robot = dynamic_cast<CRobotWithController*>(entity);
    if (robot == nullptr || robot == &receiver.GetRootEntity()) continue;
    CRABEquippedEntity& sender = robot->GetRABEquippedEntity();
    const CRay3 line(receiver.GetPosition(), sender.GetPosition());
    if (!Communicates(sender) || sender.GetMsgSize() != receiver.GetMsgSize() ||
        ChannelOf(ControllerOf(sender)) != ChannelOf(controller) || line.GetLength() >= sender.GetRange())
      continue;
    if (!needs_sight)
    {
      heard.insert(&sender);
      continue;
    }
    SEmbodiedEntityIntersectionItem between;
    const bool is_met = GetClosestEmbodiedEntityIntersectedByRay(between, line, receiver.GetEntityBody());
    if (!is_met || between.IntersectedEntity == &sender.GetEntityBody()) heard.insert(&sender);
  }
  return heard;
}

CByteArray& CRABEquippedEntity::GetData()
{
  const auto& ours = OursOf(*this);
  SendWritten();
  *data_ = CByteArray(GetMsgSize());
  if (swarmanoid::argos3::SendsMessage(ours))
  {
    std::vector<double> values;
    for (int i = 0; i < NumbersOf(*data_); ++i) values.push_back(ours.GetAttribute("message", 1 + i));
    swarmanoid::UnpackBytes(values.data(), {data_->ToCArray(), data_->Size()});
  }
  Lent().push_back({data_, *data_, ours.GetId()});
  return *data_;
}

void CRABEquippedEntity::SetData(const CByteArray& data)
{
  if (data.Size() != GetMsgSize())
    THROW_ARGOSEXCEPTION("messages of '" << GetRootEntity().GetId() << "' have " << GetMsgSize() << " bytes, not "
                                         << data.Size());
  Send(OursOf(*this).GetId(), data);
}

}  // namespace argos

namespace swarmanoid::argos3
{

bool SendsMessage(const CSwarmanoidSpaceEntity& entity)
{
  return FindAttribute(entity.GetKind(), "message") != nullptr && entity.GetAttribute("message", 0) != 0;
}

void SendWrittenMessages()
{
  argos::SendWritten();
  argos::Lent().clear();
}

}  // namespace swarmanoid::argos3
