#include "kilobot_gradient.h"

#include <algorithm>
#include <array>
#include <istream>
#include <ostream>

using namespace swarmanoid;

namespace
{

constexpr unsigned kUnknown = 255;
constexpr unsigned kLeastWay = 10, kMostWay = 40;  // ticks
constexpr std::array<std::uint32_t, 7> kColours{0xffffff, 0xff0000, 0xff8000, 0xffff00, 0x00ff00, 0x00ffff, 0x3060ff};
constexpr std::uint32_t kFar = 0xff00ff;

}  // namespace

int CKilobotGradient::Init(const TConfigurationTree t_tree)
{
  wheels_ = &GetRobot()->Actuator<CCI_WheelsActuator>("wheels");
  leds_ = &GetRobot()->Actuator<CCI_LedRingActuator>("led_ring");
  sender_ = &GetRobot()->Actuator<CCI_RangeAndBearingActuator>("range_and_bearing");
  receiver_ = &GetRobot()->Sensor<CCI_RangeAndBearingSensor>("range_and_bearing");
  is_seed_ = t_tree.GetText("seed") == GetRobot()->GetId();
  velocity_m_s_ = t_tree.GetNumber("velocity");
  hops_ = is_seed_ ? 0 : kUnknown;
  return RETURN_OK;
}

void CKilobotGradient::ControlStep()
{
  hops_ = is_seed_ ? 0 : Hops();
  CCI_RangeAndBearingActuator::Message message{};
  message[0] = 1;  // distinguishes the message from silence
  message[1] = static_cast<std::uint8_t>(hops_);
  sender_->SetMessage(message);
  leds_->SetAllColours(hops_ == kUnknown ? 0 : hops_ < kColours.size() ? kColours[hops_] : kFar);
  if (hops_ == kUnknown)
    Wander();
  else
    wheels_->SetLinearVelocity(0, 0);
}

unsigned CKilobotGradient::Hops() const
{
  unsigned least = kUnknown;
  for (const auto& packet : receiver_->GetAllPackets())
    if (packet.message[0] == 1) least = std::min<unsigned>(least, packet.message[1]);
  // Without their seed, numbers that depend only on each other grow until they are unknown.
  return least >= kUnknown - 1 ? kUnknown : least + 1;
}

// The robot goes straight on with both motors, or around one leg with one motor.
void CKilobotGradient::Wander()
{
  if (until_change_ == 0)
  {
    auto& random = GetRobot()->GetRandom();
    until_change_ = kLeastWay + static_cast<unsigned>(random.Uniform(0, kMostWay - kLeastWay));
    turn_ = static_cast<int>(random.Uniform(0, 3)) - 1;
  }
  --until_change_;
  wheels_->SetLinearVelocity(turn_ > 0 ? 0 : velocity_m_s_, turn_ < 0 ? 0 : velocity_m_s_);
}

void CKilobotGradient::SaveState(std::ostream& state) const { state << hops_ << ' ' << turn_ << ' ' << until_change_; }

void CKilobotGradient::LoadState(std::istream& state) { state >> hops_ >> turn_ >> until_change_; }

std::string CKilobotGradient::StatusText() const
{
  return hops_ == kUnknown ? "wanders" : std::to_string(hops_) + " hops from the seed";
}

REGISTER_CONTROLLER(
    CKilobotGradient,
    {.label = "kilobot_gradient",
     .brief =
         "tells its neighbours how many hops it is from a seed, shows it by its LED, and wanders while it is alone",
     .parameters = {{.name = "seed", .type = ParameterType::kText, .description = "The id of the robot that says 0."},
                    {.name = "velocity",
                     .unit = "m/s",
                     .default_value = "0.01",
                     .description = "Of a robot that wanders.",
                     .minimum = 0,
                     .maximum = 1000}}})
