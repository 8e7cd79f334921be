// Diagram: a behaviour alone, with a robot of fake devices. It tests the decisions for given views of the camera.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "common/control_interface/ci_robot.h"
#include "tests/world/fake_devices.h"

namespace swarmanoid::test
{

template <class State, class Behavior>
class Diagram : public testing::Test
{
protected:
  explicit Diagram(const char* type) : robot_("robot", type) {}

  // Returns the state after so many ticks with these blobs in view.
  unsigned See(const std::vector<CCI_ColourBlob>& blobs, int ticks = 1)
  {
    camera_.blobs = blobs;
    for (int i = 0; i < ticks; ++i)
    {
      robot_.BeginStep(tick_, 0.1, RandomStream(1, 1, 0, static_cast<std::uint32_t>(tick_)));
      ++tick_;
      state_.ReadSensors();
      behavior_.Step(state_);
      state_.WriteActuators();
    }
    return behavior_.GetStateID();
  }

  CCI_Robot robot_;
  FakeCamera camera_;
  State state_{&robot_};
  Behavior behavior_;

private:
  std::uint64_t tick_ = 0;
};

}  // namespace swarmanoid::test
