// The state of the ARGoS3 experiment in this process. It connects the API, whose headers do not know the simulator,
// with the plug-in that drives it. One experiment in a process, one thread.
#pragma once

#include <argos3/core/simulator/actuator.h>
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/core/simulator/sensor.h>
#include <argos3/plugins/robots/kilobot/control_interface/message.h>
#include <argos3/plugins/simulator/visualizations/qt-opengl/qtopengl_user_functions.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "argos3/library/made_bodies.h"
#include "common/configuration/configuration_tree.h"
#include "common/control_interface/ci_robot.h"
#include "common/math/pose.h"
#include "space_server/experiment_functions.h"

namespace swarmanoid::argos3
{

// Return the factories of ARGoS3's classes by label, from the loaded libraries.
std::map<std::string, argos::CCI_Controller* (*)()>& ControllersByLabel();
std::map<std::string, argos::CLoopFunctions* (*)()>& LoopFunctionsByLabel();
std::map<std::string, argos::CQTOpenGLUserFunctions* (*)()>& UserFunctionsByLabel();
// The labels are those that the macros write: "argos3 sensor TAG (IMPLEMENTATION)".
std::map<std::string, argos::SMadeSensor (*)()>& SensorsByLabel();
std::map<std::string, argos::SMadeActuator (*)()>& ActuatorsByLabel();

// Converts between the arena and ids of an ARGoS3 experiment and ours.
struct Translation
{
  // The position of ARGoS3's origin in our space, m.
  Vector3 origin = Vector3::Zero();
  // The entities of a <distribute>: "fb10", "fb11" … in ARGoS3 are "fb_0", "fb_1" … here.
  struct Distributed
  {
    std::string theirs;
    long long first = 0;
    std::string ours;
  };
  std::vector<Distributed> distributed;
  std::map<std::string, std::string> ours_of_single, single_of_ours;  // ids of the other entities

  // Reads the attributes origin and distributed ("fb:10:fb eb:0:eb my%20wall::my_wall") of the converted file.
  static Translation From(const TConfigurationTree& tree);
  std::string Argos3Id(const std::string& id) const;
  std::string OurId(const std::string& id) const;
  argos::CVector3 Argos3Position(const Vector3& position) const
  {
    return {position.x() - origin.x(), position.y() - origin.y(), position.z() - origin.z()};
  }
  Vector3 OurPosition(const argos::CVector3& position) const
  {
    return Vector3(position.GetX(), position.GetY(), position.GetZ()) + origin;
  }
};

inline argos::CQuaternion Argos3Orientation(const Quaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }
// A quaternion of zeros, which ARGoS3 treats as the identity, becomes the identity.
inline Quaternion OurOrientation(const argos::CQuaternion& q)
{
  if (q.SquareLength() == 0) return Quaternion::Identity();
  return Quaternion(q.GetW(), q.GetX(), q.GetY(), q.GetZ()).normalized();
}

// Copies an element for ARGoS3's controllers, with its positions in the file.
void CopyElement(const ConfigurationNode& from, argos::TConfigurationNode& to);

// A robot of a <reserve> that waits for loop functions to add it. It has no controller until then.
class SpareRobot
{
public:
  virtual ~SpareRobot() = default;
  // Makes its controller, for the robot with that id in ARGoS3, and calls its Init.
  virtual void Take(const std::string& id) = 0;
  // Removes it from the arena; its controller is destroyed.
  virtual void Leave() = 0;
};

// A robot with a controller in this process.
class ControlledRobot
{
public:
  virtual ~ControlledRobot() = default;
  // Resets its devices and its controller.
  virtual void Reset() = 0;
  // Enables or disables its control steps.
  virtual void SetEnabled(bool enabled) = 0;
};

// The state of an entity when it was added to the arena, or at Init of the loop functions.
struct Arrival
{
  Pose pose;
  double colour = 0;  // 0xRRGGBB, for an entity with that attribute
  double turret = 0;  // rad, for an entity with that attribute
};
Arrival ArrivalNow(const CSwarmanoidSpaceEntity& entity);

struct BatteryCharge
{
  double available = 1;
  double full = 1;
  double start = 1;
};

// The commanded speeds of a robot's wheels, cm/s.
struct WheelSpeeds
{
  double left = 0, right = 0;
};

// The loop functions, for a user's program that steps the run itself.
class SteppedFunctions
{
public:
  virtual ~SteppedFunctions() = default;
  // Calls their PreStep.
  virtual void BeginStep(SpaceEditor& editor) = 0;
  // Returns whether their experiment is over.
  virtual bool IsOver() = 0;
};
// A run that a user's program loaded (argos3/program).
class ProgramRun
{
public:
  virtual ~ProgramRun() = default;
  // Returns the editor for changes between the steps.
  virtual SpaceEditor& Editor() = 0;
  // Runs one step.
  virtual void Step() = 0;
  // Ends the run.
  virtual void Finish() = 0;
};

class Pen;

struct Running
{
  // The controllers of the robots whose controller host is this process, by ARGoS3's id.
  std::map<std::string, argos::CCI_Controller*> controllers;
  // Counts the changes of `controllers`.
  std::uint64_t controller_changes = 0;
  argos::CLoopFunctions* functions = nullptr;
  // Carries out the changes of functions; set while they run.
  SpaceEditor* editor = nullptr;
  // The editor of the experiment, for sensors and actuators of users; nullptr if loop functions are in another process.
  SpaceEditor* editor_for_devices = nullptr;
  // The pen is set while user functions draw.
  Pen* pen = nullptr;
  Translation translation;
  // The spare robots of this process, by our id.
  std::map<std::string, SpareRobot*> spares;
  // All robots of this process that have a controller now, by our id.
  std::map<std::string, ControlledRobot*> controlled;
  // The batteries of the robots of this process that have the sensor <battery>, by our id.
  std::map<std::string, BatteryCharge*> batteries;
  // The messages of the overhead controller to Kilobots, by our id.
  std::map<std::string, message_t> overhead_messages;
  // The wheel speeds of the robots of this process that have the actuator <differential_steering>, by our id.
  std::map<std::string, const WheelSpeeds*> wheels;
  // The first map has our ids of entities that loop functions added and did not remove, and of robots whose controller
  // they requested, by ARGoS3's id. The second map has the objects that they gave, by our id.
  std::map<std::string, std::string> taken;
  std::map<std::string, argos::CEntity*> given;
  // The initial states of all entities that Reset restores, by our id.
  std::map<std::string, Arrival> arrivals;
  // The tick of the current step, and the tick at which the clock of the functions was 0.
  std::uint64_t step = 0;
  std::uint64_t first_step = 0;
  // The list is set in a rehearsal of Init: boxes and cylinders that the file does not declare.
  std::optional<DryRun> rehearsal;
  // The flag is true if an entity was added or removed since it was set to false.
  bool presence_changed = false;

  // These members are for a user's program: the loader of its runs, the length of a run in the file (ticks), and the
  // stepped functions.
  bool is_program = false;
  std::unique_ptr<ProgramRun> (*load)(const std::string& file, const std::string* text) = nullptr;
  std::uint64_t program_length = 0;
  SteppedFunctions* stepped = nullptr;

  bool Rehearsed(const std::string& id) const { return rehearsal && rehearsal->Has(id); }
  // Returns our id for an id of ARGoS3, whether the entity exists or not.
  std::string OurId(const std::string& id) const;
};
Running& TheRunning();
// Sends the bytes that loop functions wrote into the messages of robots (CRABEquippedEntity::GetData) since the last
// call.
void SendWrittenMessages();
// Returns whether the entity sends a message by range and bearing. Some kinds cannot.
bool SendsMessage(const CSwarmanoidSpaceEntity& entity);

// While the object lives, LOG and new random generators belong to a robot, or to the loop functions.
class Speaker
{
public:
  // One of the two, or none.
  struct Speaking
  {
    CCI_Robot* robot = nullptr;
    const SpaceEditor* functions = nullptr;
  };
  explicit Speaker(CCI_Robot& robot) : Speaker(Speaking{&robot, nullptr}) {}
  explicit Speaker(const SpaceEditor& editor) : Speaker(Speaking{nullptr, &editor}) {}
  ~Speaker() { place_ = before_; }
  Speaker(const Speaker&) = delete;
  Speaker& operator=(const Speaker&) = delete;

  static bool Speaks();
  // Returns 64 random bits of the current speaker; throws CARGoSException if none exists.
  static std::uint64_t RandomBits();
  static void Say(const std::string& line);

private:
  explicit Speaker(const Speaking& now);

  Speaking& place_;  // of this thread
  Speaking before_;
};

}  // namespace swarmanoid::argos3
