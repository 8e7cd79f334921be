// CCI_RobotState: the base of the robot states. A robot state is a copyable snapshot of a robot. Its sensor readings
// are read once a tick before the first behaviour, and its actuator values are written once after the last one.
// Behaviours see nothing else, so a change of a copied state does not change the robot.
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/ci_robot.h"

namespace swarmanoid
{

// An actuator value: the last one set, and whether it must still be written to the robot.
template <class T>
class PendingValue
{
public:
  void Set(const T& value)
  {
    value_ = value;
    pending_ = true;
  }
  const T& Get() const { return value_; }
  // Returns true if the value was set since the last write. Combiners use it to see which of two copies set the value.
  bool IsPending() const { return pending_; }
  // Hands the value to `write` if it is pending.
  template <class Write>
  void Flush(Write write)
  {
    if (pending_) write(value_);
    pending_ = false;
  }

  // Drops the pending write.
  void Forget() { pending_ = false; }

private:
  T value_{};
  bool pending_ = false;
};

class CCI_RobotState
{
public:
  explicit CCI_RobotState(CCI_Robot* robot) : robot_(robot) {}

  const std::string& GetId() const { return robot_->GetId(); }
  std::uint64_t GetTick() const { return robot_->GetTick(); }
  double GetTickSeconds() const { return robot_->GetTickSeconds(); }
  double GetTime() const { return robot_->GetTime(); }
  // Returns the random numbers of the robot in this tick; shared by all copies, drawn in the order of the calls.
  RandomStream& GetRandom() { return robot_->GetRandom(); }

  // All robots can have range and bearing. The functions throw CCI_DeviceError if the controller does not list the
  // device.
  const std::vector<CCI_RangeAndBearingSensor::Packet>& GetRangeAndBearingPackets() const;
  void SetRangeAndBearingMessage(const CCI_RangeAndBearingActuator::Message& message);
  void StopRangeAndBearing();

protected:
  // Each robot's state calls these in its own functions of similar names, for the devices that all robots have.
  void InitCommon();
  void ReadCommonSensors();
  void WriteCommonActuators();

  // Returns the device that a type label names, or nullptr if the controller does not list it.
  template <class Interface>
  Interface* FindSensor(const std::string& type) const
  {
    return robot_->HasSensor(type) ? &robot_->Sensor<Interface>(type) : nullptr;
  }
  template <class Interface>
  Interface* FindActuator(const std::string& type) const
  {
    return robot_->HasActuator(type) ? &robot_->Actuator<Interface>(type) : nullptr;
  }
  // Throws CCI_DeviceError, which names the device and the listed ones, if `device` is nullptr.
  void RequireSensor(const void* device, const char* type) const
  {
    if (device == nullptr) robot_->GetSensor(type);
  }
  void RequireActuator(const void* device, const char* type) const
  {
    if (device == nullptr) robot_->GetActuator(type);
  }
  // Returns a value of a sensor that the controller lists.
  template <class T>
  const T& ReadingOf(const void* sensor, const char* type, const T& value) const
  {
    RequireSensor(sensor, type);
    return value;
  }
  // Sets a value of an actuator that the controller lists.
  template <class T>
  void Command(const void* actuator, const char* type, PendingValue<T>& pending, const std::type_identity_t<T>& value)
  {
    RequireActuator(actuator, type);
    pending.Set(value);
  }

private:
  struct Message
  {
    bool sending = false;
    CCI_RangeAndBearingActuator::Message bytes{};
  };

  CCI_Robot* robot_;
  CCI_RangeAndBearingSensor* receiver_ = nullptr;
  CCI_RangeAndBearingActuator* sender_ = nullptr;
  std::vector<CCI_RangeAndBearingSensor::Packet> packets_;
  PendingValue<Message> message_;
};

}  // namespace swarmanoid

using swarmanoid::CCI_RobotState;
