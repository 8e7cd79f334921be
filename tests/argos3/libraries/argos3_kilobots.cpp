// A controller of Kilobots in C++ that speaks in each step, and loop functions that watch Kilobots.
#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/core/simulator/simulator.h>
#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_controller.h>
#include <argos3/plugins/robots/kilobot/simulator/kilobot_communication_medium.h>
#include <argos3/plugins/robots/kilobot/simulator/kilobot_entity.h>

using namespace argos;

class CKiloSpeaker : public CCI_Controller
{
public:
  void Init(TConfigurationNode&) override
  {
    motors_ = GetActuator<CCI_DifferentialSteeringActuator>("differential_steering");
    led_ = GetActuator<CCI_KilobotLEDActuator>("kilobot_led");
    sender_ = GetActuator<CCI_KilobotCommunicationActuator>("kilobot_communication");
    receiver_ = GetSensor<CCI_KilobotCommunicationSensor>("kilobot_communication");
    light_ = GetSensor<CCI_KilobotLightSensor>("kilobot_light");
  }
  void ControlStep() override
  {
    motors_->SetLinearVelocity(0, 0);
    led_->SetColor(CColor::GREEN);
    if (receiver_->MessageSent()) ++sent_;
    for (const auto& packet : receiver_->GetPackets())
    {
      ++heard_;
      if (packet.Message->data[3] != 42) LOG << "wrong data" << std::endl;
      distance_ = packet.Distance.high_gain;
    }
    message_.data[3] = 42;
    sender_->SetMessage(&message_);
    if (++steps_ % 100 == 0)
      LOG << "sent " << sent_ << " heard " << heard_ << " from " << distance_ << " light " << light_->GetReading()
          << std::endl;
  }

private:
  CCI_DifferentialSteeringActuator* motors_ = nullptr;
  CCI_KilobotLEDActuator* led_ = nullptr;
  CCI_KilobotCommunicationActuator* sender_ = nullptr;
  CCI_KilobotCommunicationSensor* receiver_ = nullptr;
  CCI_KilobotLightSensor* light_ = nullptr;
  message_t message_{};
  int steps_ = 0, sent_ = 0, heard_ = 0, distance_ = 0;
};

class CKilobotWatch : public CLoopFunctions
{
public:
  struct SShown
  {
    UInt8 hops;
    SInt16 nearest;
  };
  void PostStep() override
  {
    const UInt32 clock = GetSpace().GetSimulationClock();
    for (auto& [id, any] : GetSpace().GetEntitiesByType("kilobot"))
    {
      auto& kilobot = *any_cast<CKilobotEntity*>(any);
      auto* controller = dynamic_cast<CCI_KilobotController*>(&kilobot.GetControllableEntity().GetController());
      if (controller == nullptr) continue;
      CRadians heading, pitch, roll;
      kilobot.GetEmbodiedEntity().GetOriginAnchor().Orientation.ToEulerAngles(heading, pitch, roll);
      LOG << "kilobot " << id << " at " << kilobot.GetEmbodiedEntity().GetOriginAnchor().Position << " "
          << ToDegrees(heading).GetValue() << " colour " << kilobot.GetLEDEquippedEntity().GetLED(0).GetColor()
          << " state " << +controller->GetRobotState()->color << std::endl;
      if (clock == 2 && controller->GetRobotState()->left_motor == 0)
        shown_[id] = controller->DebugInfoCreate<SShown>();
      if (clock == 100 && shown_.count(id) != 0) LOG << "shown " << id << " " << +shown_[id]->hops << std::endl;
      if (clock != 40 && clock != 42) continue;
      message_t message{};
      message.type = 1;
      message.data[8] = 77;
      if (id == "kb3")
        GetSimulator().GetMedium<CKilobotCommunicationMedium>("air").SendOHCMessageTo(kilobot,
                                                                                      clock == 40 ? &message : nullptr);
    }
  }

private:
  std::map<std::string, SShown*> shown_;
};

REGISTER_CONTROLLER(CKiloSpeaker, "kilo_speaker")
REGISTER_LOOP_FUNCTIONS(CKilobotWatch, "kilobot_watch")
