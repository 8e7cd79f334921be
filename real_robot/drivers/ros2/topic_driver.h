// Base classes of the drivers of this folder: a sensor that reads one topic, a ring of 24 such sensors, joints, and an
// actuator that writes one topic.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "real_robot/drivers/ros2/ros2_messages.h"

namespace swarmanoid::ros2
{

// A sensor whose readings follow from the latest message of a topic, named by the parameter "topic".
template <class Interface, class Message>
class TopicSensor : public CSensorDriver, public Interface
{
public:
  void Init(const DriverSetup& setup) override
  {
    subscriber_.emplace(setup, setup.parameters.Text("topic"));
    Configure(setup.parameters);
  }
  CCI_Sensor* Sensor() override { return this; }
  void Poll() override
  {
    if (subscriber_->TakeLatest()) Read(subscriber_->Latest());
  }
  std::vector<DriverSource> Sources() const override { return {subscriber_->Source()}; }

private:
  // Reads further parameters; called in Init.
  virtual void Configure(const Parameters&) {}
  // Converts a message to the readings of the sensor.
  virtual void Read(const Message& message) = 0;

  std::optional<Subscriber<Message>> subscriber_;
};

// A sensor with readings numbered from 0. Each reading has its own topic: the parameter "topic", then _0, _1 …
template <class Interface, class Message>
class RingSensor : public CSensorDriver, public Interface
{
public:
  void Init(const DriverSetup& setup) override
  {
    for (unsigned i = 0; i < Interface::NUM_SENSORS; ++i)
      subscribers_[i].emplace(setup, setup.parameters.Text("topic") + "_" + std::to_string(i));
    Configure(setup.parameters);
  }
  CCI_Sensor* Sensor() override { return this; }
  std::span<const double, Interface::NUM_SENSORS> GetAllSensorReadings() const override { return readings_; }
  void Poll() override
  {
    for (unsigned i = 0; i < Interface::NUM_SENSORS; ++i)
      if (subscribers_[i]->TakeLatest()) readings_[i] = ReadingOf(subscribers_[i]->Latest());
  }
  std::vector<DriverSource> Sources() const override
  {
    std::vector<DriverSource> sources;
    for (const auto& subscriber : subscribers_) sources.push_back(subscriber->Source());
    return sources;
  }

private:
  // Reads further parameters; called in Init.
  virtual void Configure(const Parameters& parameters) = 0;
  // Converts the message of one sensor to its reading.
  virtual double ReadingOf(const Message& message) const = 0;

  std::array<std::optional<Subscriber<Message>>, Interface::NUM_SENSORS> subscribers_;
  std::array<double, Interface::NUM_SENSORS> readings_{};
};

// A sensor of joints, and of switches beside them.
template <class Interface>
class JointSensor : public CSensorDriver, public Interface
{
public:
  CCI_Sensor* Sensor() override { return this; }
  void Poll() override
  {
    joints_->Poll();
    for (Switch& each : switches_)
      if (each.subscriber->TakeLatest()) each.on = each.subscriber->Latest().data();
    Update();
  }
  std::vector<DriverSource> Sources() const override
  {
    std::vector<DriverSource> sources;
    for (const Switch& each : switches_) sources.push_back(each.subscriber->Source());
    joints_->AddSources(sources);
    return sources;
  }

protected:
  void Listen(const DriverSetup& setup, std::vector<std::string> joints, const std::vector<std::string>& switches = {})
  {
    joints_.emplace(setup, setup.parameters.Text("topic"), std::move(joints));
    for (const std::string& topic : switches)
      switches_.push_back({std::make_unique<Subscriber<Bool>>(setup, topic), false});
  }
  double Position(std::size_t joint) const { return joints_->Position(joint); }
  double Velocity(std::size_t joint) const { return joints_->Velocity(joint); }
  bool IsOn(std::size_t number) const { return switches_[number].on; }

private:
  // Called after new messages may have come.
  virtual void Update() {}

  struct Switch
  {
    std::unique_ptr<Subscriber<Bool>> subscriber;
    bool on;
  };
  std::optional<JointReader> joints_;
  std::vector<Switch> switches_;
};

// An actuator with one topic. `Output` publishes on it; it is made with the setup and further arguments of the driver.
template <class Interface, class Output>
class TopicActuator : public CActuatorDriver, public Interface
{
public:
  CCI_Actuator* Actuator() override { return this; }
  std::vector<std::string> Sinks() const override { return {output_->Name()}; }

protected:
  std::optional<Output> output_;
};

}  // namespace swarmanoid::ros2
