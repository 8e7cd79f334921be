// What of an ARGoS3 experiment runs in this process, and who is running now: between the API, whose headers know
// nothing of the simulator, and the plug-in that drives it. One experiment a process, one thread.
#pragma once

#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/simulator/visualizations/qt-opengl/qtopengl_user_functions.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "argos3/library/made_bodies.h"
#include "common/configuration/configuration_tree.h"
#include "common/control_interface/ci_robot.h"
#include "common/math/pose.h"
#include "space_server/experiment_functions.h"

namespace swarmanoid::argos3
{

// What ARGoS3's classes are made by: the labels of the libraries that were loaded.
std::map<std::string, argos::CCI_Controller* (*)()>& ControllersByLabel();
std::map<std::string, argos::CLoopFunctions* (*)()>& LoopFunctionsByLabel();
std::map<std::string, argos::CQTOpenGLUserFunctions* (*)()>& UserFunctionsByLabel();

// The arena and the ids of an ARGoS3 experiment beside ours.
struct Translation
{
  // Where ARGoS3's origin is in our space, m.
  Vector3 origin = Vector3::Zero();
  // Entities of a <distribute>: "fb10", "fb11" … there are "fb_0", "fb_1" … here.
  struct Distributed
  {
    std::string theirs;
    long long first = 0;
    std::string ours;
  };
  std::vector<Distributed> distributed;

  // From the attributes origin and distributed ("fb:10:fb eb:0:eb") that the converted file has.
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
// One of zeros, which ARGoS3 takes for no rotation, is none.
inline Quaternion OurOrientation(const argos::CQuaternion& q)
{
  if (q.SquareLength() == 0) return Quaternion::Identity();
  return Quaternion(q.GetW(), q.GetX(), q.GetY(), q.GetZ()).normalized();
}

// The element as ARGoS3's controllers see it, with its places.
void CopyElement(const ConfigurationNode& from, argos::TConfigurationNode& to);

// A robot of a <reserve> that waits for loop functions to add it: it has no controller until then.
class SpareRobot
{
public:
  virtual ~SpareRobot() = default;
  // Makes its controller, for the robot of that id of theirs, and calls its Init.
  virtual void Take(const std::string& id) = 0;
  // It leaves the arena; its controller is destroyed.
  virtual void Leave() = 0;
};

// A robot with a controller in this process.
class ControlledRobot
{
public:
  virtual ~ControlledRobot() = default;
  // Reset of its devices and its controller.
  virtual void Reset() = 0;
  virtual void SetEnabled(bool enabled) = 0;
};

// How an entity came into the arena, or was when Init of the loop functions was called.
struct Arrival
{
  Pose pose;
  double colour = 0;  // 0xRRGGBB; of one that has the attribute
  double turret = 0;  // rad; likewise
};
Arrival ArrivalNow(const CSwarmanoidSpaceEntity& entity);

struct BatteryCharge
{
  double available = 1;
  double full = 1;
  double start = 1;
};

// Of a robot, as it was told them, cm/s.
struct WheelSpeeds
{
  double left = 0, right = 0;
};

// The loop functions, for a program of a user that steps the run itself.
class SteppedFunctions
{
public:
  virtual ~SteppedFunctions() = default;
  // Their PreStep.
  virtual void BeginStep(SpaceEditor& editor) = 0;
  // Whether their experiment is over.
  virtual bool IsOver() = 0;
};
// A run that a program of a user loaded (argos3/program).
class ProgramRun
{
public:
  virtual ~ProgramRun() = default;
  virtual SpaceEditor& Editor() = 0;
  virtual void Step() = 0;
  virtual void Finish() = 0;
};

class Pen;

struct Running
{
  // Of the robots whose controller host is this process, by ARGoS3's id.
  std::map<std::string, argos::CCI_Controller*> controllers;
  argos::CLoopFunctions* functions = nullptr;
  // While functions run: what carries out their changes.
  SpaceEditor* editor = nullptr;
  // While user functions draw.
  Pen* pen = nullptr;
  Translation translation;
  // Those of this process, by our id.
  std::map<std::string, SpareRobot*> spares;
  // Likewise, with those that have a controller now.
  std::map<std::string, ControlledRobot*> controlled;
  // Of the robots of this process that have the sensor <battery>, by our id.
  std::map<std::string, BatteryCharge*> batteries;
  // Likewise, that have the actuator <differential_steering>.
  std::map<std::string, const WheelSpeeds*> wheels;
  // What loop functions added and did not remove, and robots that they made whose controller they had: ours by their
  // id; and the objects that they gave by our id.
  std::map<std::string, std::string> taken;
  std::map<std::string, argos::CEntity*> given;
  // By our id, of all that Reset puts back.
  std::map<std::string, Arrival> arrivals;
  // The tick of the step that functions are called in, and that at which the clock of theirs was 0.
  std::uint64_t step = 0;
  std::uint64_t first_step = 0;
  // Only in a rehearsal of Init: boxes and cylinders that the file does not declare.
  std::optional<DryRun> rehearsal;
  // Whether something was added or removed since this was set to false.
  bool presence_changed = false;

  // In a program of a user: what loads its runs, how long the file says that one is (ticks), and who is stepped.
  bool is_program = false;
  std::unique_ptr<ProgramRun> (*load)(const std::string& file) = nullptr;
  std::uint64_t program_length = 0;
  SteppedFunctions* stepped = nullptr;

  bool Rehearsed(const std::string& id) const { return rehearsal && rehearsal->Has(id); }
  // Of the entity of that id of theirs, there or not.
  std::string OurId(const std::string& id) const;
};
Running& TheRunning();
// What loop functions wrote into the messages of robots (CRABEquippedEntity::GetData) since the last call.
void SendWrittenMessages();

// For as long as it lives, LOG and new random generators are those of a robot, or of the loop functions.
class Speaker
{
public:
  explicit Speaker(CCI_Robot& robot);
  explicit Speaker(const SpaceEditor& editor);
  ~Speaker();
  Speaker(const Speaker&) = delete;
  Speaker& operator=(const Speaker&) = delete;

  static bool Speaks();
  // 64 random bits of who speaks; throws CARGoSException if nobody does.
  static std::uint64_t RandomBits();
  static void Say(const std::string& line);

private:
  CCI_Robot* robot_before_;
  const SpaceEditor* editor_before_;
};

}  // namespace swarmanoid::argos3
