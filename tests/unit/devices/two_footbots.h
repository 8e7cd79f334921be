// Two footbots 'a' and 'b' with wheels and LEDs, whose controller 'c' a test brings along.
#pragma once

#include <string>

#include "common/experiment/experiment.h"
#include "controller_host/device.h"

namespace swarmanoid
{

inline Experiment TwoFootbots(const std::string& controller_tag)
{
  RegisterBuiltinDevices();
  Experiment experiment;
  experiment.arena_size = {10, 10, 2};
  ControllerConfiguration& controller = experiment.controllers.emplace_back();
  controller.tag = controller_tag;
  controller.id = "c";
  for (const std::string type : {"wheels", "led_ring"})
  {
    DeviceConfiguration& device = controller.actuators.emplace_back();
    device.type = type;
    device.implementation = "generic_" + type;
  }
  experiment.engines.resize(1);
  for (const std::uint32_t k : {0U, 1U})
  {
    EntityConfiguration& entity = experiment.entities.emplace_back();
    entity.kind = EntityKind::kFootbot;
    entity.id = k == 0 ? "a" : "b";
    entity.controller = "c";
    entity.movable = true;
    experiment.engines[0].entities.push_back(k);
  }
  return experiment;
}

}  // namespace swarmanoid
