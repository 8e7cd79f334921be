// Drivers of a footbot that give a controller the readings that one of a simulated robot recorded (outside_senses.cpp),
// and write the commands that it gives, in the same form.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "footbot/ci_footbot_encoders_sensor.h"
#include "footbot/ci_footbot_leds_actuator.h"
#include "footbot/ci_footbot_omnidirectional_camera_sensor.h"
#include "footbot/ci_footbot_proximity_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"
#include "real_robot/driver.h"

namespace
{

swarmanoid::ParameterSpec File(const char* description)
{
  return {.name = "file", .type = swarmanoid::ParameterType::kPath, .description = description};
}

// The file gets a line of numbers for each step.
class CRecordedSensor : public CSensorDriver
{
public:
  void Init(const swarmanoid::DriverSetup& setup) override
  {
    const std::string path = setup.parameters.Text("file");
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);)
    {
      std::istringstream words(line);
      std::vector<double>& step = steps_.emplace_back();
      for (std::string word; words >> word;) step.push_back(std::strtod(word.c_str(), nullptr));
    }
    if (steps_.empty()) throw swarmanoid::DriverError("nothing is recorded in " + path);
  }
  void Poll() override
  {
    // The first time is before the robot starts.
    if (polls_++ > 1) ++step_;
    if (step_ >= steps_.size()) throw swarmanoid::DriverError("the record has " + std::to_string(step_) + " steps");
    Take(steps_[step_]);
  }

private:
  virtual void Take(const std::vector<double>& numbers) = 0;

  std::vector<std::vector<double>> steps_;
  std::size_t polls_ = 0;
  std::size_t step_ = 0;
};

template <class Interface, std::size_t kSize>
class CRecordedReadings : public CRecordedSensor, public Interface
{
public:
  CCI_Sensor* Sensor() override { return this; }
  std::span<const double, kSize> GetAllSensorReadings() const override { return readings_; }

private:
  void Take(const std::vector<double>& numbers) override
  {
    for (std::size_t i = 0; i < kSize; ++i) readings_[i] = numbers.at(i);
  }
  std::array<double, kSize> readings_{};
};

class CRecordedProximity : public CRecordedReadings<CCI_FootBotProximitySensor, CCI_FootBotProximitySensor::NUM_SENSORS>
{
};

class CRecordedEncoders : public CRecordedReadings<CCI_FootBotEncodersSensor, 2>
{
};

class CRecordedCamera : public CRecordedSensor, public CCI_FootBotOmnidirectionalCameraSensor
{
public:
  CCI_Sensor* Sensor() override { return this; }
  std::span<const CCI_ColourBlob> GetAllBlobs() const override { return blobs_; }

private:
  void Take(const std::vector<double>& numbers) override
  {
    blobs_.clear();
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
      blobs_.push_back({static_cast<std::uint32_t>(numbers[i]), numbers[i + 1], numbers[i + 2], 0});
  }
  std::vector<CCI_ColourBlob> blobs_;
};

class CRecordingActuator : public CActuatorDriver
{
public:
  void Init(const swarmanoid::DriverSetup& setup) override { path_ = setup.parameters.Text("file"); }
  void Push() override
  {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path_.c_str(), "a"), &std::fclose);
    if (!file) throw swarmanoid::DriverError("cannot write " + path_);
    for (const double number : commands_) std::fprintf(file.get(), "%a ", number);
    std::fprintf(file.get(), "\n");
  }
  void Stop() override {}

protected:
  std::vector<double> commands_;

private:
  std::string path_;
};

class CRecordingWheels : public CRecordingActuator, public CCI_FootBotWheelsActuator
{
public:
  CCI_Actuator* Actuator() override { return this; }
  void SetFootBotWheelsAngularVelocity(double left, double right) override { commands_ = {left, right}; }
};

class CRecordingLeds : public CRecordingActuator, public CCI_FootBotLedsActuator
{
public:
  CRecordingLeds() { commands_.resize(NUM_LEDS); }
  CCI_Actuator* Actuator() override { return this; }
  void SetAllColours(std::uint32_t colour) override { commands_.assign(NUM_LEDS, colour); }
  void SetColour(unsigned led, std::uint32_t colour) override { commands_.at(led) = colour; }
};

constexpr const char* kGives = "gives what was recorded";
constexpr const char* kWrites = "writes what it is told";

REGISTER_SENSOR_DRIVER(CRecordedProximity,
                       DescribeDriver("footbot_proximity", "recorded", kGives, {"footbot"}, {File("A line a step.")}))
REGISTER_SENSOR_DRIVER(CRecordedEncoders,
                       DescribeDriver("footbot_encoders", "recorded", kGives, {"footbot"}, {File("A line a step.")}))
REGISTER_SENSOR_DRIVER(CRecordedCamera, DescribeDriver("footbot_omnidirectional_camera", "recorded", kGives,
                                                       {"footbot"}, {File("A line a step.")}))
REGISTER_ACTUATOR_DRIVER(CRecordingWheels,
                         DescribeDriver("footbot_wheels", "recorded", kWrites, {"footbot"}, {File("A line a step.")}))
REGISTER_ACTUATOR_DRIVER(CRecordingLeds,
                         DescribeDriver("footbot_leds", "recorded", kWrites, {"footbot"}, {File("A line a step.")}))

}  // namespace
