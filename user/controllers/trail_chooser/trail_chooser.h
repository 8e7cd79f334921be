// Goes to and fro between two nests. At the fork of two bridges it chooses one by the trails on them, with the function
// that Deneubourg et al. found for Argentine ants (Journal of Insect Behavior 3, 159, 1990), and leaves a trail itself.
#pragma once

#include <vector>

#include "ci_controller.h"
#include "ci_floor_field.h"
#include "ci_positioning_sensor.h"
#include "footbot/ci_footbot_proximity_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"

class CTrailChooser : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlStep() override;

  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override;
  void LoadState(std::istream& state) override;
  std::string StatusText() const override;

private:
  using Vector2 = swarmanoid::Vector2;

  // Returns the corners of the way from fork to fork, in the robot's direction.
  std::vector<Vector2> Bridge(unsigned bridge) const;
  // Returns the corners of the whole way to the next nest.
  std::vector<Vector2> Way() const;
  // Returns a corner of a way, moved to the lane on the right.
  Vector2 InLane(const std::vector<Vector2>& way, std::size_t corner) const;
  unsigned Choose();
  void DriveTo(const Vector2& target);

  CCI_FootBotWheelsActuator* wheels_ = nullptr;
  CCI_FloorFieldActuator* trail_ = nullptr;
  CCI_PositioningSensor* place_ = nullptr;
  CCI_FloorFieldSensor* smell_ = nullptr;
  CCI_FootBotProximitySensor* proximity_ = nullptr;
  std::vector<Vector2> nests_, forks_, bridges_[2];  // from the first nest to the second one
  double velocity_m_s_ = 0, lane_m_ = 0, threshold_ = 0, power_ = 0, rate_ = 0, departures_m_s_ = 0;

  bool is_on_the_way_ = false;
  bool is_going_back_ = false;  // to the first nest
  unsigned bridge_ = 0;
  unsigned next_ = 0;  // corner of the way
  unsigned crossings_[2] = {0, 0};
};
