// CCI_KilobotController: runs a behaviour in C, which is a program, in a process of its own. The label is
// "kilobot_controller", and <params behavior="build/program"/> names the program.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <unistd.h>

#include <cstring>

#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/utility/math/rng.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_communication_actuator.h>
#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_communication_sensor.h>
#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_led_actuator.h>
#include <argos3/plugins/robots/kilobot/control_interface/ci_kilobot_light_sensor.h>
#include <argos3/plugins/robots/kilobot/control_interface/kilolib.h>

// The macro is for behaviours alone.
#undef main

class CCI_KilobotController : public argos::CCI_Controller
{
public:
  CCI_KilobotController();
  ~CCI_KilobotController() override;
  void Init(argos::TConfigurationNode& params) override;
  // Throws CARGoSException if the process of the behaviour has ended.
  void ControlStep() override;
  // Starts the behaviour again, in another process.
  void Reset() override;
  void Destroy() override;

  pid_t GetBehaviorPID() const { return process_; }
  // Returns the state after the latest step. Changes of sensor values last until the next step.
  kilobot_state_t* GetRobotState() { return &state_; }

  // Returns the debug information of the behaviour (debug.h), all zeros at first.
  template <class Shown>
  Shown* DebugInfoCreate()
  {
    const int file = shm_open(DebugName().c_str(), O_RDWR | O_CREAT, S_IRUSR | S_IWUSR);
    if (file < 0 || ftruncate(file, sizeof(Shown)) != 0)
      THROW_ARGOSEXCEPTION("the debug information of '" << GetId() << "' cannot be shared: " << std::strerror(errno));
    void* shared = mmap(nullptr, sizeof(Shown), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    close(file);
    if (shared == MAP_FAILED)
      THROW_ARGOSEXCEPTION("the debug information of '" << GetId() << "' cannot be shared: " << std::strerror(errno));
    has_debug_info_ = true;
    std::memset(shared, 0, sizeof(Shown));
    return static_cast<Shown*>(shared);
  }
  template <class Shown>
  void DebugInfoDestroy(Shown* shown)
  {
    munmap(shown, sizeof(Shown));
    RemoveDebugInfo();
  }

private:
  void Start();
  void Stop();
  std::string DebugName() const;
  void RemoveDebugInfo();

  kilobot_state_t state_{};
  std::string behavior_;
  argos::CCI_DifferentialSteeringActuator* motors_ = nullptr;
  argos::CCI_KilobotLEDActuator* led_ = nullptr;
  argos::CCI_KilobotLightSensor* light_ = nullptr;
  argos::CCI_KilobotCommunicationActuator* sender_ = nullptr;
  argos::CCI_KilobotCommunicationSensor* receiver_ = nullptr;
  argos::CRandom::CRNG* random_ = nullptr;
  pid_t process_ = -1;
  int socket_ = -1;
  bool has_debug_info_ = false;
};
