#include "trail_chooser.h"

#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>

#include "ci_publish.h"
#include "common/math/elementary.h"

using namespace swarmanoid;

namespace
{

constexpr double kReached_m = 0.15;
constexpr double kStops = 0.6;     // the probability with which a robot waits a tick for one ahead
constexpr double kNearby = 0.1;    // sum of the readings ahead from which another robot is in the way
constexpr double kTurnGain = 2.5;  // 1/s

// Reads "x, y, x, y …".
std::vector<Vector2> Points(const TConfigurationTree& tree, const char* name)
{
  const auto numbers = ParseNumbers(tree.GetText(name));
  if (!numbers || numbers->empty() || numbers->size() % 2 != 0)
    throw ConfigurationError(tree.ValueLocation(name),
                             std::string("'") + name + "' must be pairs of numbers, x, y in m");
  std::vector<Vector2> points;
  for (std::size_t k = 0; k < numbers->size(); k += 2) points.emplace_back((*numbers)[k], (*numbers)[k + 1]);
  return points;
}

}  // namespace

int CTrailChooser::Init(const TConfigurationTree t_tree)
{
  wheels_ = &GetRobot()->Actuator<CCI_FootBotWheelsActuator>("footbot_wheels");
  trail_ = &GetRobot()->Actuator<CCI_FloorFieldActuator>("floor_field");
  place_ = &GetRobot()->Sensor<CCI_PositioningSensor>("positioning");
  smell_ = &GetRobot()->Sensor<CCI_FloorFieldSensor>("floor_field");
  proximity_ = &GetRobot()->Sensor<CCI_FootBotProximitySensor>("footbot_proximity");
  nests_ = Points(t_tree, "nests");
  forks_ = Points(t_tree, "forks");
  bridges_[0] = Points(t_tree, "bridge_left");
  bridges_[1] = Points(t_tree, "bridge_right");
  if (nests_.size() != 2 || forks_.size() != 2 || smell_->PointCount() != 2)
    throw ConfigurationError(t_tree.Location(),
                             "trail_chooser needs two nests, two forks, and two points of its sensor");
  velocity_m_s_ = t_tree.GetNumber("velocity");
  lane_m_ = t_tree.GetNumber("lane");
  threshold_ = t_tree.GetNumber("threshold");
  power_ = t_tree.GetNumber("power");
  rate_ = t_tree.GetNumber("rate");
  departures_m_s_ = t_tree.GetNumber("departures");
  return RETURN_OK;
}

std::vector<Vector2> CTrailChooser::Bridge(unsigned bridge) const
{
  std::vector<Vector2> corners = bridges_[bridge];
  if (is_going_back_) std::reverse(corners.begin(), corners.end());
  return corners;
}

std::vector<Vector2> CTrailChooser::Way() const
{
  std::vector<Vector2> way{nests_[is_going_back_ ? 1 : 0], forks_[is_going_back_ ? 1 : 0]};
  const std::vector<Vector2> bridge = Bridge(bridge_);
  way.insert(way.end(), bridge.begin(), bridge.end());
  way.push_back(forks_[is_going_back_ ? 0 : 1]);
  way.push_back(nests_[is_going_back_ ? 0 : 1]);
  return way;
}

Vector2 CTrailChooser::InLane(const std::vector<Vector2>& way, std::size_t corner) const
{
  Vector2 along = Vector2::Zero();
  if (corner > 0) along += (way[corner] - way[corner - 1]).normalized();
  if (corner + 1 < way.size()) along += (way[corner + 1] - way[corner]).normalized();
  along.normalize();
  return way[corner] + lane_m_ * Vector2(along.y(), -along.x());
}

// The probability of the left bridge is (k + L)^n / ((k + L)^n + (k + R)^n) for the trails L and R at its two points.
unsigned CTrailChooser::Choose()
{
  const auto readings = smell_->GetReadings();
  const double left = std::pow(threshold_ + readings[0].value, power_);
  const double right = std::pow(threshold_ + readings[1].value, power_);
  const bool goes_left = GetRobot()->GetRandom().Uniform(0, 1) * (left + right) < left;
  // What is to the left for a robot that goes back is the bridge on the right of the others.
  return goes_left != is_going_back_ ? 0 : 1;
}

void CTrailChooser::DriveTo(const Vector2& target)
{
  const Vector2 to = target - place_->GetPosition().head<2>();
  const double error = WrapAngle(Atan2(to.y(), to.x()) - place_->GetHeading());
  double ahead = 0;
  for (unsigned i = 0; i < CCI_FootBotProximitySensor::NUM_SENSORS; ++i)
    ahead += proximity_->GetProximitySensorReading(i) * std::max(0.0, Cos(CCI_FootBotProximitySensor::AngleOf(i)));
  if (ahead > kNearby && GetRobot()->GetRandom().Uniform(0, 1) < kStops)
    return wheels_->SetFootBotWheelsLinearVelocity(0, 0);
  const double turn = std::clamp(kTurnGain * error * 0.07, -velocity_m_s_, velocity_m_s_);
  const double forward = velocity_m_s_ * std::max(0.0, Cos(std::clamp(error, -kPi / 2, kPi / 2)));
  wheels_->SetFootBotWheelsLinearVelocity(forward - turn, forward + turn);
}

void CTrailChooser::ControlStep()
{
  const Vector2 at = place_->GetPosition().head<2>();
  if (!is_on_the_way_)
  {
    // Those that are nearer to the nest leave first, so that none is in the way.
    is_on_the_way_ = (at - nests_[0]).norm() <= 0.3 + departures_m_s_ * GetRobot()->GetTime();
    return;
  }
  std::vector<Vector2> way = Way();
  if ((InLane(way, next_) - at).norm() < kReached_m)
  {
    if (next_ == 1)
    {
      bridge_ = Choose();
      way = Way();
    }
    if (++next_ == way.size())
    {
      ++crossings_[bridge_];
      is_going_back_ = !is_going_back_;
      next_ = 0;
      way = Way();
    }
  }
  // It leaves a trail on the bridges alone.
  trail_->SetRate(next_ >= 2 && next_ + 1 < way.size() ? rate_ : 0);
  DriveTo(InLane(way, next_));
  Publish(*GetRobot(), {{"left", crossings_[0]}, {"right", crossings_[1]}});
}

void CTrailChooser::SaveState(std::ostream& state) const
{
  state << is_on_the_way_ << ' ' << is_going_back_ << ' ' << bridge_ << ' ' << next_ << ' ' << crossings_[0] << ' '
        << crossings_[1];
}

void CTrailChooser::LoadState(std::istream& state)
{
  state >> is_on_the_way_ >> is_going_back_ >> bridge_ >> next_ >> crossings_[0] >> crossings_[1];
}

std::string CTrailChooser::StatusText() const
{
  return !is_on_the_way_ ? "waits" : std::string("on its way ") + (is_going_back_ ? "back" : "there");
}

REGISTER_CONTROLLER(
    CTrailChooser,
    {.label = "trail_chooser",
     .brief = "goes to and fro between two nests, and chooses one of two bridges by the trails on them",
     .parameters = {
         {.name = "nests", .type = ParameterType::kText, .unit = "m", .description = "Both nests: x, y, x, y."},
         {.name = "forks",
          .type = ParameterType::kText,
          .unit = "m",
          .description = "Both ends of the bridges, as nests."},
         {.name = "bridge_left",
          .type = ParameterType::kText,
          .unit = "m",
          .description = "Corners of the bridge on the left of a robot that leaves the first nest."},
         {.name = "bridge_right",
          .type = ParameterType::kText,
          .unit = "m",
          .description = "Corners of the other bridge."},
         {.name = "velocity",
          .unit = "m/s",
          .default_value = "0.2",
          .description = "Of the robot.",
          .minimum = 0,
          .maximum = 10},
         {.name = "lane",
          .unit = "m",
          .default_value = "0.13",
          .description = "Distance of its lane from the middle of the way, to the right.",
          .minimum = 0,
          .maximum = 10},
         {.name = "threshold",
          .unit = "1/m²",
          .default_value = "300",
          .description = "Trail beside which a fainter one counts little; k of the choice function.",
          .minimum = 1e-6,
          .maximum = 1e12},
         {.name = "power",
          .default_value = "2",
          .description = "n of the choice function.",
          .minimum = 0,
          .maximum = 20},
         {.name = "rate",
          .unit = "1/s",
          .default_value = "1",
          .description = "Deposit on a bridge.",
          .minimum = 0,
          .maximum = 1e6},
         {.name = "departures",
          .unit = "m/s",
          .default_value = "0.02",
          .description = "Speed of the circle around the first nest from within which robots leave.",
          .minimum = 1e-6,
          .maximum = 1e6}}})
