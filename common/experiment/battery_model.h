// BatteryModel: what the parts of a robot draw from its battery, by the parameters of its sensor <battery> with the
// implementation energy_battery (docs/batteries.md). The space server computes the charge, the controller host tells it
// what wheels, receivers and own devices draw.
#pragma once

#include <optional>
#include <vector>

#include "common/configuration/parameter.h"
#include "common/experiment/experiment.h"

namespace swarmanoid
{

inline constexpr const char* kEnergyBattery = "energy_battery";  // the implementation

// Energies are in J and powers in W. docs/constants.md has the sources of the defaults.
struct BatteryModel
{
  double capacity_j = 136'800;        // 38 Wh
  double start = 1;                   // share of the capacity
  double idle_w = 3;                  // computer and sensors, always
  double wheels_j_per_m = 6;          // for each metre that the wheels roll, as the mean of both
  double led_w = 0.06;                // each LED or beacon that is lit
  double gripper_w = 1;               // each gripper or hand that holds something
  double sent_j_per_byte = 1.9e-6;    // radio, range and bearing
  double received_j_per_byte = 5e-7;  // radio, range and bearing
  bool stops = true;                  // an empty battery switches the robot off
  double restart = 0.05;              // share of the capacity at which it is switched on again

  bool operator==(const BatteryModel&) const = default;
};

// Returns the parameters of the sensor, with the defaults of the model.
std::vector<ParameterSpec> BatteryParameters();
// Returns the model of a robot's battery, or nullopt if its controller has no such sensor.
std::optional<BatteryModel> BatteryOf(const Experiment& experiment, const EntityConfiguration& entity);

// A charging station is an area of the floor whose kind has these attributes, which experiment functions may change.
inline constexpr const char* kChargingPower = "charging_power";  // W for each robot on it
inline constexpr const char* kChargingLimit = "charging_limit";  // W for all robots on it together; 0: none

}  // namespace swarmanoid
