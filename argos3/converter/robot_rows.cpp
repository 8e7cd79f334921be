#include "argos3/converter/robot_rows.h"

#include <algorithm>
#include <array>

#include "common/math/elementary.h"

namespace swarmanoid::argos3
{
namespace
{

// ARGoS3's antennas on the top of a body are hidden by bodies of the same height. Here they are a little below it.
constexpr double kBelowTop = 0.001;  // m

// The values are those of footbot_entity.cpp, eyebot_entity.cpp, epuck_entity.cpp and spiri_entity.cpp of ARGoS3, of
// kheperaiv_entity.cpp of argos3-kheperaiv, of kilobot_entity.cpp of argos3-kilobot and of
// epuck_entity.cpp of argos3-epuck.
constexpr std::array kRobots{
    RobotRow{.tag = "foot-bot", .kind = "footbot", .constructor = "14CFootBotEntityC"},
    RobotRow{.tag = "eye-bot", .kind = "eyebot", .constructor = "13CEyeBotEntityC", .flies = true},
    RobotRow{.tag = "e-puck",
             .kind = "argos3_epuck",
             .is_generic = true,
             .constructor = "12CEPuckEntityC",
             .radio_range_m = 0.8,
             .radio_bytes = 2,
             .antenna_m = 0.086 - kBelowTop,
             .light = {8, 22.5, 0.035, 0.06}},
    RobotRow{.tag = "e-puck",
             .kind = kDemiurgeEPuck,
             .is_generic = true,
             .constructor = "12CEPuckEntityC",
             .prefix = "epuck_",
             .radio_range_m = 0.8,
             .radio_bytes = kDemiurgeEPuckBytes,
             .has_own_messages = true,
             .antenna_m = 0.052,
             .lacks = "range_and_bearing battery",
             .light = {8, 11.25, 0.036, 0.032}},
    RobotRow{.tag = "kheperaiv",
             .kind = "argos3_kheperaiv",
             .is_generic = true,
             .constructor = "16CKheperaIVEntityC",
             .prefix = "kheperaiv_",
             .antenna_m = 0.0577 - kBelowTop,
             .light = {8, 0, 0.0704, 0.0145}},
    // The kind is that of user/entities/kilobot.
    RobotRow{.tag = "kilobot",
             .kind = "kilobot",
             .is_generic = true,
             .constructor = "14CKilobotEntityC",
             .prefix = "kilobot_",
             .radio_range_m = 0.1,
             .radio_bytes = kKilobotBytes,
             .radio_range_name = "communication_range",
             .has_own_messages = true,
             .max_speed_m_s = 10,
             .lacks = "range_and_bearing proximity ground light battery"},
    RobotRow{.tag = "pipuck",
             .kind = "argos3_pipuck",
             .is_generic = true,
             .prefix = "pipuck_",
             .radio_range_m = 0,
             .radio_range_name = "",
             .has_own_messages = true,
             .lacks = "differential_steering leds range_and_bearing proximity ground light battery"},
    RobotRow{.tag = "spiri",
             .kind = "argos3_spiri",
             .is_generic = true,
             .antenna_m = 0.045,
             .flies = true,
             .lacks = "differential_steering leds proximity ground light"},
};

const RobotRow* Find(std::string_view name, std::string_view RobotRow::*member)
{
  const auto found = std::ranges::find(kRobots, name, member);
  return found == kRobots.end() ? nullptr : &*found;
}

}  // namespace

std::span<const RobotRow> RobotRows() { return kRobots; }
const RobotRow* RobotOfTag(std::string_view tag) { return Find(tag, &RobotRow::tag); }
const RobotRow* RobotOfKind(std::string_view kind) { return Find(kind, &RobotRow::kind); }

const RobotRow* OwnerOfDevice(std::string_view device)
{
  for (const RobotRow& row : kRobots)
    if (!row.prefix.empty() && device.starts_with(row.prefix) && device != "epuck_proximity") return &row;
  return nullptr;
}

Vector3 KilobotEye()
{
  constexpr double kEccentricity = 0.0092, kFromAxis = 0.0165 - 0.002, kHeight = 0.0217 + 0.0127;
  const SinCos angle = SinCosOf(DegreesToRadians(100));
  return {kEccentricity + kFromAxis * angle.cos, kFromAxis * angle.sin, kHeight};
}

bool Flies(std::string_view kind)
{
  const RobotRow* row = RobotOfKind(kind);
  return row != nullptr && row->flies;
}

std::string RobotTags()
{
  std::string tags;
  for (const RobotRow& row : kRobots)
    if (row.kind != kDemiurgeEPuck) tags += (tags.empty() ? "" : ", ") + std::string(row.tag);
  return tags;
}

}  // namespace swarmanoid::argos3
