// The robots of ARGoS3 and of its plug-ins that a file may have, a row each.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "common/math/pose.h"

namespace swarmanoid::argos3
{

// A ring of light sensors, for the sensor <light>.
struct LightRingRow
{
  int sensors = 24;
  double first_angle_deg = 7.5;
  double radius_m = 0.085036758;
  double height_m = 0.06;
};

struct RobotRow
{
  std::string_view tag;   // in ARGoS3
  std::string_view kind;  // ours
  // The robot has the devices of any robot (wheels, led_ring, proximity, ground, light), and a library named as the
  // kind has its row.
  bool is_generic = false;
  std::string_view constructor{};  // its mangled name in users' libraries; empty: loop functions cannot make it
  std::string_view prefix{};       // of the names of the devices that it alone has
  double radio_range_m = 3;
  long long radio_bytes = 10;
  // The attribute of the robot with the range of its messages; empty: it sends none.
  std::string_view radio_range_name = "rab_range";
  bool has_own_messages = false;  // of radio_bytes, whatever the file says
  double antenna_m = 0.1;         // above the base
  // The fastest speed of a wheel that ARGoS3 allows; 0: that of the kind.
  double max_speed_m_s = 0;
  // It flies: in files with engines of both kinds it is in those with three dimensions.
  bool flies = false;
  // Devices of ARGoS3's generic robots that this one does not have, separated by blanks.
  std::string_view lacks{};
  LightRingRow light{};
};

std::span<const RobotRow> RobotRows();
// Return nullptr for an unknown name.
const RobotRow* RobotOfTag(std::string_view tag);
const RobotRow* RobotOfKind(std::string_view kind);
// Returns the robot that alone has a device; nullptr: others may have it, too.
const RobotRow* OwnerOfDevice(std::string_view device);
// Returns the tags of all robots in ARGoS3, with commas between them.
std::string RobotTags();
bool Flies(std::string_view kind);

// The camera of Spiris looks ahead from here (spiri_entity.cpp).
inline constexpr double kSpiriCamera = 0.332340187;  // m, from the axis of the robot, at the height of its base

// The e-puck of argos3-epuck. It has the same tag as ARGoS3's own, and is known by the devices of its controller.
inline constexpr const char* kDemiurgeEPuck = "argos3_demiurge_epuck";
// Its message: 12 emitters with four bytes each, and its heading (argos3/plugin/epuck_devices.cpp).
inline constexpr std::size_t kDemiurgeEPuckBytes = 58;

// Returns the position of a Kilobot's light sensor (m), as in kilobot_measures.h of argos3-kilobot.
Vector3 KilobotEye();

// A message between Kilobots: what the sender does, and its message_t (argos3/plugin/kilobot_devices.cpp).
inline constexpr std::size_t kKilobotBytes = 13;

// The Khepera IV's ultrasound sensors see from 0.25 m before the ring of its infrared sensors on, up to 2 m further, as
// in kheperaiv_entity.cpp of argos3-kheperaiv. The ring measures both here.
inline constexpr double kUltrasoundGap = 0.25;                  // m
inline constexpr double kUltrasoundReach = 2 + kUltrasoundGap;  // m, from the ring
// Its lidar looks from 0.02 m beyond the body on, 4.0704 m far, at the height of kheperaiv_measures.cpp.
inline constexpr double kLidarStart = 0.0704 + 0.02;            // m, from the axis of the robot
inline constexpr double kLidarReach = kLidarStart + 4.0704;     // m
inline constexpr double kLidarHeight = 0.0047 + 0.053 + 0.084;  // m

}  // namespace swarmanoid::argos3
