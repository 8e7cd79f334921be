#include "aloha_sender.h"

#include <array>
#include <istream>
#include <ostream>

#include "ci_publish.h"

using namespace swarmanoid;

int CAlohaSender::Init(const TConfigurationTree t_tree)
{
  sender_ = &GetRobot()->Actuator<CCI_RadioActuator>("radio");
  receiver_ = &GetRobot()->Sensor<CCI_RadioSensor>("radio");
  probability_ = t_tree.GetNumber("probability");
  return RETURN_OK;
}

void CAlohaSender::ControlStep()
{
  heard_ += receiver_->GetAllPackets().size();
  ++steps_;
  if (GetRobot()->GetRandom().Uniform() < probability_) sender_->Send(std::array<std::uint8_t, 1>{1});
  Publish(*GetRobot(), {{"heard", static_cast<double>(heard_) / static_cast<double>(steps_)}});
}

REGISTER_CONTROLLER(CAlohaSender, {.label = "aloha_sender",
                                   .brief = "sends packets at random and counts those that it hears",
                                   .parameters = {{.name = "probability",
                                                   .default_value = "0.05",
                                                   .description = "Of sending a packet in a step.",
                                                   .minimum = 0,
                                                   .maximum = 1}}})
