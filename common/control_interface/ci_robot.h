// CCI_Robot: the container of a robot's sensors and actuators. The only way from a controller to its devices.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/control_interface/ci_device.h"
#include "common/math/random.h"

namespace swarmanoid
{

// A controller asked for a device that its configuration does not list.
class CCI_DeviceError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// The steps of a controller that draw random numbers. The runtime names the streams of GetRandom by them.
inline constexpr std::uint64_t kInitStream = StreamName("controller Init");
inline constexpr std::uint64_t kControlStepStream = StreamName("controller ControlStep");
inline constexpr std::uint64_t kDestroyStream = StreamName("controller Destroy");

class CCI_Robot
{
public:
  CCI_Robot(std::string id, const std::string& kind) : id_(std::move(id)), kind_(Shared(kind)) {}

  const std::string& GetId() const { return id_; }
  // Returns the tag of the robot's kind, such as "footbot", "eyebot" or "handbot".
  const std::string& GetKind() const { return *kind_; }

  // Returns the device registered under a type label ("footbot_wheels"), valid as long as the controller. Throws
  // CCI_DeviceError, which names the listed devices, if the configuration does not list the label.
  CCI_Actuator* GetActuator(const std::string& type) const;
  CCI_Sensor* GetSensor(const std::string& type) const;
  bool HasActuator(const std::string& type) const { return Find(actuators_, type) != nullptr; }
  bool HasSensor(const std::string& type) const { return Find(sensors_, type) != nullptr; }
  // Return the labels of all devices that the configuration lists, in ascending order.
  std::vector<std::string> ActuatorTypes() const;
  std::vector<std::string> SensorTypes() const;

  // Returns the same, checked: throws CCI_DeviceError if the device is of another interface.
  template <class Interface>
  Interface& Actuator(const std::string& type) const
  {
    return Checked<Interface>(GetActuator(type), type);
  }
  template <class Interface>
  Interface& Sensor(const std::string& type) const
  {
    return Checked<Interface>(GetSensor(type), type);
  }

  // The clock: ticks since the start, the seconds of one tick, and the seconds since the start.
  std::uint64_t GetTick() const { return tick_; }
  double GetTickSeconds() const { return tick_seconds_; }
  double GetTime() const { return static_cast<double>(tick_) * tick_seconds_; }

  // Returns the random numbers of this robot in this step: Init, a ControlStep or Destroy. They continue from call to
  // call and differ between steps. They depend only on the seed, the id of the robot, the step and its tick, so they
  // are equal in every run. The reference is valid during the step only.
  RandomStream& GetRandom()
  {
    if (!has_random_) BeginRandom();
    return random_;
  }

  // Writes a line into the log of the process that runs the controller, with the id of the robot and the tick. In a run
  // the log is in the run's folder; on a robot it is that of the robot's program. The log is for people; results belong
  // into reports and files.
  void Log(std::string_view text) const { log_(*this, text); }

  // The functions below are for the runtime that owns the robot.
  using LogSink = void (*)(const CCI_Robot& robot, std::string_view text);
  void SetLog(LogSink log) { log_ = log; }
  void AddActuator(const std::string& type, CCI_Actuator* actuator) { Add(actuators_, type, actuator); }
  void AddSensor(const std::string& type, CCI_Sensor* sensor) { Add(sensors_, type, sensor); }
  void BeginStep(std::uint64_t tick, double tick_seconds, RandomStream random)
  {
    tick_ = tick;
    tick_seconds_ = tick_seconds;
    random_ = std::move(random);
    has_random_ = true;
  }
  // Begins a control step with random numbers of that key and of `random_tick`, which are made on first use, since most
  // steps draw none. The duration of a tick stays as it was.
  void SetControlStepKey(const StreamKey& key) { control_step_key_ = key; }
  void BeginControlStep(std::uint64_t tick, std::uint64_t random_tick)
  {
    tick_ = tick;
    random_tick_ = random_tick;
    has_random_ = false;
  }

private:
  // The lists are short and in ascending order of their types. They are vectors of pointers, since each of a million
  // robots has them.
  template <class Device>
  using Devices = std::vector<std::pair<const std::string*, Device*>>;

  // Returns a text that all robots of a process share.
  static const std::string* Shared(const std::string& text);
  template <class Device>
  static void Add(Devices<Device>& devices, const std::string& type, Device* device);
  // Returns nullptr if the device is not listed.
  template <class Device>
  static Device* Find(const Devices<Device>& devices, const std::string& type);
  // Returns the device. If it is not listed, throws an error with the cure: to list it, to ask for the other kind of
  // device, or to spell it as listed.
  template <class Device, class Other>
  Device* Listed(const Devices<Device>& devices, const Devices<Other>& others, const std::string& type,
                 const std::string& what, const std::string& other) const;

  void BeginRandom()
  {
    random_ = {control_step_key_, random_tick_};
    has_random_ = true;
  }
  // Writes to standard error, for robots without a runtime that has a log.
  static void WriteLog(const CCI_Robot& robot, std::string_view text);

  template <class Interface, class Device>
  Interface& Checked(Device* device, const std::string& type) const
  {
    if (auto* typed = dynamic_cast<Interface*>(device)) return *typed;
    throw CCI_DeviceError("robot '" + id_ + "': device '" + type + "' is not of the interface asked for");
  }

  // Members that each step writes are next to each other.
  std::uint64_t tick_ = 0, random_tick_ = 0;
  bool has_random_ = true;
  double tick_seconds_ = 0.1;
  RandomStream random_{0, 0, 0, 0};
  StreamKey control_step_key_{0, 0, kControlStepStream};
  std::string id_;
  const std::string* kind_;
  Devices<CCI_Actuator> actuators_;
  Devices<CCI_Sensor> sensors_;
  LogSink log_ = WriteLog;
};

}  // namespace swarmanoid

using swarmanoid::CCI_DeviceError;
using swarmanoid::CCI_Robot;
