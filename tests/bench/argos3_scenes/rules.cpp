#include "rules.h"

#include <algorithm>
#include <cmath>

using namespace argos;

namespace
{

constexpr Real kPi = 3.14159265358979323846;
constexpr Real kNear = 0.04;  // the length of the mean of the proximity readings at which robots turn away

}  // namespace

void CDriver::Init(TConfigurationNode& node)
{
  wheels_ = GetActuator<CCI_DifferentialSteeringActuator>("differential_steering");
  if (HasSensor("footbot_proximity")) proximity_ = GetSensor<CCI_FootBotProximitySensor>("footbot_proximity");
  if (HasSensor("footbot_light")) light_ = GetSensor<CCI_FootBotLightSensor>("footbot_light");
  random_ = CRandom::CreateRNG("argos");
  GetNodeAttributeOrDefault(node, "speed", speed_, speed_);
}

CVector2 CDriver::Obstacle() const
{
  CVector2 sum;
  for (const auto& reading : proximity_->GetReadings()) sum += CVector2(reading.Value, reading.Angle);
  return sum / static_cast<Real>(proximity_->GetReadings().size());
}

CVector2 CDriver::Light() const
{
  CVector2 sum;
  for (const auto& reading : light_->GetReadings()) sum += CVector2(reading.Value, reading.Angle);
  return sum.Length() > 0 ? sum / sum.Length() : sum;
}

void CDriver::Steer(const CVector2& direction)
{
  const Real angle = std::atan2(direction.GetY(), direction.GetX());
  if (std::abs(angle) > kPi / 2)
  {
    wheels_->SetLinearVelocity(angle > 0 ? -speed_ : speed_, angle > 0 ? speed_ : -speed_);
    return;
  }
  const Real slow = speed_ * (1 - 2 * std::abs(angle) / kPi);
  wheels_->SetLinearVelocity(angle > 0 ? slow : speed_, angle > 0 ? speed_ : slow);
}

void CDriver::SteerAround(const CVector2& direction)
{
  const CVector2 obstacle = Obstacle();
  Steer(obstacle.Length() > kNear ? CVector2() - obstacle : direction);
}

void CDiffusion::Init(TConfigurationNode& node)
{
  CDriver::Init(node);
  GetNodeAttributeOrDefault(node, "delta", delta_, delta_);
}

void CDiffusion::ControlStep()
{
  const CVector2 obstacle = Obstacle();
  const Real angle = std::atan2(obstacle.GetY(), obstacle.GetX());
  if (std::abs(angle) <= 7.5 * kPi / 180 && obstacle.Length() < delta_)
    wheels_->SetLinearVelocity(speed_, speed_);
  else
    wheels_->SetLinearVelocity(angle > 0 ? speed_ : 0, angle > 0 ? 0 : speed_);
}

void CForager::Init(TConfigurationNode& node)
{
  CDriver::Init(node);
  ground_ = GetSensor<CCI_FootBotMotorGroundSensor>("footbot_motor_ground");
}

void CForager::ControlStep()
{
  const auto& ground = ground_->GetReadings();
  const bool in_nest = std::all_of(ground.begin(), ground.end(), [](const auto& one) { return one.Value < 0.75; });
  if (carries_)
    SteerAround(Light());
  else if (in_nest)
    SteerAround(CVector2() - Light());
  else
    SteerAround(CVector2(1, 0));
}

void CFlocker::Init(TConfigurationNode& node)
{
  CDriver::Init(node);
  camera_ = GetSensor<CCI_ColoredBlobOmnidirectionalCameraSensor>("colored_blob_omnidirectional_camera");
  camera_->Enable();
  GetActuator<CCI_LEDsActuator>("leds")->SetSingleColor(12, CColor::RED);
  GetNodeAttributeOrDefault(node, "distance", distance_, distance_);
}

void CFlocker::ControlStep()
{
  CVector2 force;
  int seen = 0;
  for (const auto* blob : camera_->GetReadings().BlobList)
  {
    if (!(blob->Color == CColor::RED) || blob->Distance > 1.8 * distance_) continue;
    const Real ratio = distance_ * distance_ / (blob->Distance * blob->Distance);
    force += CVector2(-1000 / blob->Distance * (ratio * ratio - ratio), blob->Angle);
    ++seen;
  }
  if (seen > 0) force /= seen;
  if (force.Length() > speed_) force *= speed_ / force.Length();
  Steer(force + Light() * (0.25 * speed_));
}

void CFirefly::Init(TConfigurationNode&)
{
  leds_ = GetActuator<CCI_LEDsActuator>("leds");
  camera_ = GetSensor<CCI_ColoredBlobOmnidirectionalCameraSensor>("colored_blob_omnidirectional_camera");
  camera_->Enable();
  phase_ = CRandom::CreateRNG("argos")->Uniform(CRange<UInt32>(0, 100));
}

void CFirefly::ControlStep()
{
  const auto& blobs = camera_->GetReadings().BlobList;
  const bool sees_flash =
      std::any_of(blobs.begin(), blobs.end(), [](auto* blob) { return blob->Color == CColor::RED; });
  phase_ += sees_flash ? phase_ / 10 : 1;
  flashes_ = phase_ > 100;
  if (flashes_) phase_ = 0;
  leds_->SetAllColors(flashes_ ? CColor::RED : CColor::BLACK);
}

void CPuller::Init(TConfigurationNode& node)
{
  CDriver::Init(node);
  gripper_ = GetActuator<CCI_FootBotGripperActuator>("footbot_gripper");
}

void CPuller::ControlStep()
{
  ++step_;
  if (step_ == 60) gripper_->LockPositive();
  if (step_ == 200) gripper_->Unlock();
  const Real speed = step_ < 60 ? speed_ : step_ < 65 ? 0 : -speed_;
  wheels_->SetLinearVelocity(speed, speed);
}

void CAggregator::Init(TConfigurationNode& node)
{
  CDriver::Init(node);
  ears_ = GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing");
}

void CAggregator::ControlStep()
{
  const auto neighbours = static_cast<Real>(ears_->GetReadings().size());
  if (rests_ && random_->Bernoulli(0.05 * std::exp(-0.8 * neighbours)))
    rests_ = false;
  else if (!rests_ && neighbours > 0 && random_->Bernoulli(0.05 + 0.1 * (1 - std::exp(-0.5 * neighbours))))
    rests_ = true;
  if (rests_)
    wheels_->SetLinearVelocity(0, 0);
  else
    SteerAround(CVector2(1, 0));
}

void CPhototaxis::ControlStep() { SteerAround(Light()); }

void CChainLink::Init(TConfigurationNode& node)
{
  CDriver::Init(node);
  voice_ = GetActuator<CCI_RangeAndBearingActuator>("range_and_bearing");
  ears_ = GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing");
  GetNodeAttributeOrDefault(node, "nest", is_nest_, is_nest_);
  place_ = is_nest_ ? 1 : 0;
}

void CChainLink::ControlStep()
{
  Real nearest = 1000;  // cm
  int last = 0;
  for (const auto& packet : ears_->GetReadings())
  {
    const int place = packet.Data[0];
    if (place == 0) continue;
    nearest = std::min(nearest, packet.Range);
    last = std::max(last, place);
  }
  // A link joins beyond 60 cm from the others, and the last one may leave.
  if (place_ == 0 && last != 0 && nearest > 60 && random_->Bernoulli(0.05))
    place_ = last + 1;
  else if (place_ > 1 && last < place_ && random_->Bernoulli(0.004))
    place_ = 0;
  voice_->SetData(0, static_cast<UInt8>(place_));
  if (place_ != 0)
    wheels_->SetLinearVelocity(0, 0);
  else
    SteerAround(CVector2(1, 0));
}

void CHopCounter::Init(TConfigurationNode& node)
{
  CDriver::Init(node);
  voice_ = GetActuator<CCI_RangeAndBearingActuator>("range_and_bearing");
  ears_ = GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing");
  GetNodeAttributeOrDefault(node, "source", is_source_, is_source_);
  voice_->SetData(0, kFar);
}

void CHopCounter::ControlStep()
{
  int least = kFar - 1;
  for (const auto& packet : ears_->GetReadings()) least = std::min<int>(least, packet.Data[0]);
  hops_ = is_source_ ? 0 : least + 1;
  voice_->SetData(0, static_cast<UInt8>(hops_));
  if (is_source_)
    wheels_->SetLinearVelocity(0, 0);
  else
    SteerAround(CVector2(1, 0));
}

void CPowered::Init(TConfigurationNode& node)
{
  CDriver::Init(node);
  battery_ = GetSensor<CCI_BatterySensor>("battery");
}

void CPowered::ControlStep()
{
  charge_ = battery_->GetReading().AvailableCharge;
  if (charge_ < 0.3) wants_charge_ = true;
  if (charge_ > 0.9) wants_charge_ = false;
  if (charge_ <= 0)
    wheels_->SetLinearVelocity(0, 0);
  else
    SteerAround(wants_charge_ ? Light() : CVector2(1, 0));
}

void CAllDevices::Init(TConfigurationNode& node)
{
  CDiffusion::Init(node);
  ground_ = GetSensor<CCI_FootBotMotorGroundSensor>("footbot_motor_ground");
  camera_ = GetSensor<CCI_ColoredBlobOmnidirectionalCameraSensor>("colored_blob_omnidirectional_camera");
  camera_->Enable();
  voice_ = GetActuator<CCI_RangeAndBearingActuator>("range_and_bearing");
  ears_ = GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing");
  GetActuator<CCI_LEDsActuator>("leds")->SetAllColors(CColor::RED);
}

void CAllDevices::ControlStep()
{
  // A sum over all readings, so that none of them can be left out.
  Real sum = Light().GetX();
  for (const auto& reading : ground_->GetReadings()) sum += reading.Value;
  for (const auto* blob : camera_->GetReadings().BlobList) sum += blob->Distance;
  for (const auto& packet : ears_->GetReadings()) sum += packet.Range + packet.Data[0];
  voice_->SetData(0, ++step_);
  CDiffusion::ControlStep();
  // Never so; the compiler does not know it.
  if (sum < -1e9) wheels_->SetLinearVelocity(0, 0);
}

void CEPuckAvoider::Init(TConfigurationNode&)
{
  wheels_ = GetActuator<CCI_DifferentialSteeringActuator>("differential_steering");
  proximity_ = GetSensor<CCI_ProximitySensor>("proximity");
}

void CEPuckAvoider::ControlStep()
{
  // The two sensors ahead on each side see at most 10 cm.
  const auto& readings = proximity_->GetReadings();
  const bool is_free = readings[0] + readings[1] + readings[6] + readings[7] == 0;
  constexpr Real kSpeed = 8;  // cm/s
  wheels_->SetLinearVelocity(is_free ? kSpeed : -kSpeed / 2, is_free ? kSpeed : kSpeed / 2);
}

REGISTER_CONTROLLER(CDiffusion, "scene_diffusion")
REGISTER_CONTROLLER(CForager, "scene_forager")
REGISTER_CONTROLLER(CFlocker, "scene_flocker")
REGISTER_CONTROLLER(CFirefly, "scene_firefly")
REGISTER_CONTROLLER(CPuller, "scene_puller")
REGISTER_CONTROLLER(CAggregator, "scene_aggregator")
REGISTER_CONTROLLER(CPhototaxis, "scene_phototaxis")
REGISTER_CONTROLLER(CChainLink, "scene_chain_link")
REGISTER_CONTROLLER(CHopCounter, "scene_hop_counter")
REGISTER_CONTROLLER(CPowered, "scene_powered")
REGISTER_CONTROLLER(CAllDevices, "scene_all_devices")
REGISTER_CONTROLLER(CEPuckAvoider, "scene_epuck_avoider")
