#include "common/experiment/battery_model.h"

#include <fmt/format.h>

#include <algorithm>

namespace swarmanoid
{
namespace
{

using enum ParameterType;

constexpr double kMostEnergy = 1e9;  // J, W: the largest number of an attribute

// A number of the model with the name of its parameter.
struct NumberOfModel
{
  const char* name;
  double BatteryModel::*member;
  const char* unit;
  const char* description;
  double minimum;
  double maximum;
};

constexpr NumberOfModel kNumbersOfModel[] = {
    {"capacity", &BatteryModel::capacity_j, "J", "Energy of the full battery.", 1e-9, kMostEnergy},
    {"start", &BatteryModel::start, "", "Charge at the start; 1 is full.", 0, 1},
    {"idle", &BatteryModel::idle_w, "W", "Power that is always drawn: computer, sensors.", 0, 1e6},
    {"wheels", &BatteryModel::wheels_j_per_m, "J/m", "Energy for each metre that the wheels roll, mean of both.", 0,
     1e6},
    {"led", &BatteryModel::led_w, "W", "Power of each LED or beacon that is lit.", 0, 1e6},
    {"gripper", &BatteryModel::gripper_w, "W", "Power of each gripper or hand that holds something.", 0, 1e6},
    {"sent", &BatteryModel::sent_j_per_byte, "J", "Energy for each byte sent by radio or range and bearing.", 0, 1e6},
    {"received", &BatteryModel::received_j_per_byte, "J", "Energy for each byte received.", 0, 1e6},
    {"restart", &BatteryModel::restart, "",
     "Share of the capacity at which a robot that an empty battery has switched off runs again.", 0, 1},
};

}  // namespace

std::vector<ParameterSpec> BatteryParameters()
{
  const BatteryModel defaults;
  std::vector<ParameterSpec> parameters;
  for (const NumberOfModel& number : kNumbersOfModel)
    parameters.push_back({number.name, kNumber, number.unit, fmt::format("{}", defaults.*number.member),
                          number.description, number.minimum, number.maximum});
  ParameterSpec empty{"empty", kChoice, "", "stop",
                      "stop: an empty battery switches the robot off, as a fault of the kind off; ignore: it goes on."};
  empty.choices = {"stop", "ignore"};
  parameters.push_back(std::move(empty));
  return parameters;
}

std::optional<BatteryModel> BatteryOf(const Experiment& experiment, const EntityConfiguration& entity)
{
  const ControllerConfiguration* controller =
      entity.controller.empty() ? nullptr : experiment.FindController(entity.controller);
  if (controller == nullptr) return std::nullopt;
  const auto sensor =
      std::ranges::find_if(controller->sensors, [](const DeviceConfiguration& device)
                           { return device.type == "battery" && device.implementation == kEnergyBattery; });
  if (sensor == controller->sensors.end()) return std::nullopt;
  BatteryModel model;
  for (const NumberOfModel& number : kNumbersOfModel)
    model.*number.member = sensor->tree.GetNumber(number.name, model.*number.member);
  model.stops = sensor->tree.GetText("empty", "stop") != "ignore";
  return model;
}

}  // namespace swarmanoid
