#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "common/experiment/builtin_kinds.h"
#include "common/experiment/entity_kind.h"
#include "common/math/elementary.h"
#include "common/mesh/convex_hull.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kOwnKinds = static_cast<std::size_t>(EntityKind::kChargingStation) + 1;
constexpr std::size_t kMostKinds = 256;
constexpr std::size_t kMostLeds = 16;
constexpr std::size_t kMostProximitySensors = 64;
constexpr int kMostSlots = 1000;
constexpr double kMostMetresOfRow = 100;
constexpr double kStandOut = 0.01;  // m
constexpr int kMostRotors = 16;
constexpr std::size_t kMostLinks = 64;
constexpr double kMostOfPropellers = 1e6;  // in the unit of the value
constexpr double kGravity = 9.81;          // m/s²

using Row = EntityKindDescription;

// Rows never move in memory, since entities and attributes refer to them.
std::vector<std::unique_ptr<const Row>>& Rows()
{
  static std::vector<std::unique_ptr<const Row>> rows = []
  {
    std::vector<std::unique_ptr<const Row>> own;
    for (const Row& row : OwnKinds()) own.push_back(std::make_unique<const Row>(row));
    return own;
  }();
  return rows;
}

bool IsName(const std::string& tag)
{
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !tag.empty() && tag.size() <= 64 && letter(tag.front()) &&
         std::all_of(tag.begin(), tag.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

// Returns whether the tag is an element of <arena> that is no entity, or a word with another meaning for parameters.
bool IsTaken(const std::string& tag)
{
  return KindOfTag(tag).has_value() || tag == "distribute" || tag == "reserve" || tag == "size" ||
         tag == "optimization" || tag == "limit" || tag == "beyond_limit";
}

bool IsLength(double metres) { return metres > 0 && metres <= kMostMetresOfRow; }

bool IsPlace(const Vector2& place) { return place.allFinite() && place.norm() <= kMostMetresOfRow; }

std::string MistakeInBody(const Row& row)
{
  const bool solid = row.role == EntityRole::kRobot || row.role == EntityRole::kObject;
  if (row.role == EntityRole::kTerrain) return "terrain is read by the simulator's own kind alone";
  if (solid && row.form == BodyForm::kNone) return "a robot or object needs a body: form is kNone";
  if (!solid && (row.form != BodyForm::kNone || row.mobility != Mobility::kNever))
    return "lights, sounds, patches and holes have form kNone and mobility kNever";
  if (row.role == EntityRole::kRobot && (row.size.isZero() || row.mobility != Mobility::kAlways))
    return "a robot has a size, the same for all, and mobility kAlways";
  if (row.origin == BodyOrigin::kCentre && (row.role == EntityRole::kRobot || row.form != BodyForm::kBox))
    return "origin kCentre is for objects of form kBox";
  const bool sized = IsLength(row.size.x()) && IsLength(row.size.y()) && IsLength(row.size.z());
  if (!row.size.isZero() && !sized)
    return fmt::format("size is {}, {}, {}; each must be more than 0 and at most {} m, or all of them 0", row.size.x(),
                       row.size.y(), row.size.z(), kMostMetresOfRow);
  if (row.form == BodyForm::kCylinder && row.size.x() != row.size.y())
    return fmt::format("the size of a cylinder is radius, radius, height; it is {}, {}, {}", row.size.x(), row.size.y(),
                       row.size.z());
  if (!(row.mass_kg >= 0 && row.mass_kg <= 1e9)) return fmt::format("mass_kg is {}; it must be 0 to 1e9", row.mass_kg);
  if (row.mechanism != Mechanism::kNone || row.grippers != 0)
    return "mechanisms and grippers are for the simulator's own kinds";
  return {};
}

bool IsPositive(double value) { return value > 0 && value <= kMostOfPropellers; }

bool IsLimited(double value) { return value >= 0 && value <= kMostOfPropellers; }

bool IsPlace3(const Vector3& place) { return place.allFinite() && place.norm() <= kMostMetresOfRow; }

bool IsDrag(const Vector3& drag) { return (drag.array() >= 0).all() && (drag.array() <= kMostOfPropellers).all(); }

std::string MistakeInRotors(const Rotors& rotors, double mass_kg)
{
  if (rotors.count < 4 || rotors.count > kMostRotors || rotors.count % 2 != 0)
    return fmt::format("{} rotors; there may be 4 to {}, an even number", rotors.count, kMostRotors);
  if (!IsLength(rotors.reach_m) || !IsPositive(rotors.torque_m) || !IsLimited(rotors.spin_up_s) ||
      !IsLimited(rotors.spin_down_s))
    return "rotors need a reach_m and a torque_m of more than 0, and spin_up_s and spin_down_s of 0 or more";
  const Vector3& curve = rotors.thrust_of_speed;
  if (!curve.allFinite() || !(curve.z() > 0) || curve.x() > 0 || !IsLimited(curve.y()))
    return "thrust_of_speed needs a first number of 0 or less, a second of 0 or more, and a third of more than 0";
  if (!IsDrag(rotors.drag)) return "the drag of rotors is 0 or more along each axis";
  if (!IsPositive(rotors.max_thrust_n) || rotors.count * rotors.max_thrust_n <= mass_kg * kGravity)
    return fmt::format("{} rotors of {} N do not lift {} kg", rotors.count, rotors.max_thrust_n, mass_kg);
  return {};
}

std::string MistakeInPropellers(const Row& row)
{
  if (!row.propellers) return row.solids.empty() ? "" : "solids are for robots with propellers";
  const Propellers& flight = *row.propellers;
  if (row.wheels) return "a robot has either wheels or propellers";
  if (!IsPositive(row.mass_kg)) return "a robot with propellers needs a mass_kg";
  if (!(flight.inertia_kg_m2.array() > 0).all() || !(flight.inertia_kg_m2.array() <= kMostOfPropellers).all() ||
      2 * flight.inertia_kg_m2.maxCoeff() > flight.inertia_kg_m2.sum())
    return "inertia_kg_m2 needs three numbers of more than 0, none larger than the other two together";
  if (!(flight.centre_of_mass_m >= 0 && flight.centre_of_mass_m <= row.size.z()))
    return fmt::format("centre_of_mass_m is {}; it must be within the height of {} m", flight.centre_of_mass_m,
                       row.size.z());
  for (const double value :
       {flight.max_speed_m_s, flight.max_yaw_rate_rad_s, flight.max_across_m_s2, flight.max_upward_m_s2,
        flight.max_angular_rad_s2, flight.furthest_reference_m, flight.place_rad_s, flight.tilt_rad_s, flight.yaw_rad_s,
        flight.plane_force_n, flight.plane_torque_n_m})
    if (!IsPositive(value)) return "speeds, limits and frequencies of propellers, and their plane forces, are above 0";
  if (!IsLimited(flight.magnet_reach_m)) return "magnet_reach_m is 0 or more";
  if (!IsDrag(flight.drag_in_wind)) return "drag_in_wind is 0 or more along each axis";
  if (flight.rotors && !flight.drag_in_wind.isZero()) return "drag_in_wind is for propellers without rotors";
  if (flight.rotors && flight.max_thrust_n != 0) return "max_thrust_n is for propellers without rotors";
  if (!flight.rotors && !(flight.max_thrust_n > row.mass_kg * kGravity && IsLimited(flight.max_thrust_n)))
    return fmt::format("propellers of {} N do not lift {} kg", flight.max_thrust_n, row.mass_kg);
  for (const SolidPart& solid : row.solids)
    if (!solid.centre.allFinite() || !IsLength(solid.size.x()) || !IsLength(solid.size.y()) ||
        !IsLength(solid.size.z()))
      return fmt::format("a solid needs a size of more than 0 and at most {} m", kMostMetresOfRow);
  return flight.rotors ? MistakeInRotors(*flight.rotors, row.mass_kg) : std::string();
}

bool IsBody(const LinkBody& body)
{
  if (!IsPositive(body.mass_kg) || !IsPlace3(body.centre_of_mass) || !body.inertia.allFinite()) return false;
  if (!body.inertia.isApprox(body.inertia.transpose(), 1e-9)) return false;
  const Eigen::Vector3d moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(body.inertia).eigenvalues();
  return moments.minCoeff() > 0 && 2 * moments.maxCoeff() <= moments.sum() * 1.05;
}

std::string MistakeInLinks(const Row& row)
{
  if (row.links.empty()) return row.base ? "a base is for robots with links" : "";
  if (row.propellers) return "a robot with propellers has no links";
  if (row.wheels && row.base) return "a robot with wheels has no base";
  if (!row.wheels && !row.base) return "links need a base, or wheels";
  if (row.links.size() > kMostLinks)
    return fmt::format("{} links that move; there may be {}", row.links.size(), kMostLinks);
  if (row.base && !IsBody(*row.base)) return "the base needs a mass and an inertia of a body";
  for (std::size_t k = 0; k < row.links.size(); ++k)
  {
    const MovingLink& link = row.links[k];
    const auto same = [&](const MovingLink& other) { return other.joint == link.joint; };
    if (link.joint.empty() || link.attribute.empty() || std::ranges::count_if(row.links, same) > 1)
      return fmt::format("the joint '{}' needs a name of its own and an attribute", link.joint);
    if (link.parent < MovingLink::kBase || link.parent >= static_cast<int>(k))
      return fmt::format("the joint '{}' hangs on link {}; it must be one before it, or the base", link.joint,
                         link.parent);
    if (!IsPlace3(link.anchor) || !(std::abs(link.axis.norm() - 1) < 1e-9))
      return fmt::format("the joint '{}' needs a finite anchor and an axis of length 1", link.joint);
    if (!(link.lowest <= link.highest) || !IsLimited(link.max_speed) || !IsLimited(link.effort) ||
        !IsLimited(link.damping) || !IsLimited(link.friction) || (link.effort > 0 && link.max_speed == 0))
      return fmt::format("the joint '{}' needs a range, and speed, effort, damping and friction of 0 or more",
                         link.joint);
    if (!IsBody(link.body))
      return fmt::format("the joint '{}' needs a link with the mass and the inertia of a body", link.joint);
  }
  return {};
}

std::string MistakeInParts(const Row& row)
{
  if (const std::string wrong = MistakeInLinks(row); !wrong.empty()) return wrong;
  if (row.role != EntityRole::kRobot && (row.wheels || row.propellers || !row.links.empty() || row.leds ||
                                         row.beacon_height_m || row.proximity || !row.ground_points.empty()))
    return "wheels, propellers, links, LEDs and sensors are for robots";
  if (const std::string wrong = MistakeInPropellers(row); !wrong.empty()) return wrong;
  if (row.wheels &&
      !(IsLength(row.wheels->axle_m) && IsLength(row.wheels->radius_m) && IsLength(row.wheels->max_speed_m_s)))
    return fmt::format(
        "wheels with an axle of {} m, a radius of {} m and {} m/s: each must be more than 0 and at most {}",
        row.wheels->axle_m, row.wheels->radius_m, row.wheels->max_speed_m_s, kMostMetresOfRow);
  if (row.leds && (row.leds->places.empty() || row.leds->places.size() > kMostLeds || row.leds->on_turret ||
                   !std::all_of(row.leds->places.begin(), row.leds->places.end(), IsPlace)))
    return fmt::format("{} LEDs; there may be 1 to {}, at finite places, and on no turret", row.leds->places.size(),
                       kMostLeds);
  if (row.leds && !row.leds->directions.empty())
  {
    const auto is_direction = [](const Vector3& direction)
    { return direction.allFinite() && direction.norm() > 1e-6 && direction.norm() <= kMostMetresOfRow; };
    if (row.leds->directions.size() != row.leds->places.size() ||
        !std::all_of(row.leds->directions.begin(), row.leds->directions.end(), is_direction))
      return fmt::format("{} directions of {} LEDs; there must be one for each, finite and not 0, or none",
                         row.leds->directions.size(), row.leds->places.size());
  }
  if (row.beacon_height_m && !row.leds) return "a beacon is for robots with LEDs";
  if (row.leds)
  {
    // Cameras test whether whole bodies hide an LED, so LEDs must be part of the body.
    const Vector2 half = row.form == BodyForm::kBox ? Vector2(row.size.head<2>() / 2) : Vector2(row.size.head<2>());
    const auto stands_out = [&](const Vector2& place)
    {
      const bool beside = place.x() > half.x() + kStandOut || place.x() < -half.x() - kStandOut ||
                          place.y() > half.y() + kStandOut || place.y() < -half.y() - kStandOut;
      return row.form == BodyForm::kBox ? beside : place.norm() > half.x() + kStandOut;
    };
    if (std::any_of(row.leds->places.begin(), row.leds->places.end(), stands_out))
      return fmt::format("an LED stands out of the body by more than {} m", kStandOut);
  }
  if (row.proximity)
  {
    const ProximityRing& ring = *row.proximity;
    const bool good = !ring.sensors.empty() && ring.sensors.size() <= kMostProximitySensors && IsLength(ring.range_m) &&
                      std::all_of(ring.sensors.begin(), ring.sensors.end(),
                                  [](const ProximityRing::Sensor& sensor)
                                  { return IsPlace(sensor.place) && std::abs(sensor.direction) <= 1e3; });
    if (!good)
      return fmt::format(
          "{} proximity sensors with a range of {} m; there may be 1 to {}, at finite places, with a "
          "range of more than 0 and at most {} m",
          ring.sensors.size(), ring.range_m, kMostProximitySensors, kMostMetresOfRow);
  }
  if (!row.corners.empty())
  {
    const Vector3 low(-row.size.x() / 2, -row.size.y() / 2, row.origin == BodyOrigin::kBase ? 0 : -row.size.z() / 2);
    const Eigen::AlignedBox3d box(low - Vector3::Constant(1e-6), low + row.size + Vector3::Constant(1e-6));
    if (row.form != BodyForm::kBox ||
        !std::all_of(row.corners.begin(), row.corners.end(), [&](const Vector3& c) { return box.contains(c); }))
      return "it has corners that are not within a box of its size";
    try
    {
      HullOf(row.corners);
    }
    catch (const std::invalid_argument& mistake)
    {
      return mistake.what();
    }
  }
  if (!std::all_of(row.ground_points.begin(), row.ground_points.end(), IsPlace))
    return "a ground sensor is at no finite place";
  for (const MeshPart& part : row.mesh)
  {
    if (part.link < MovingLink::kBase || part.link >= static_cast<int>(row.links.size()))
      return fmt::format("a part of the mesh is on link {}, and there are {}", part.link, row.links.size());
    const std::size_t leds = row.leds ? row.leds->places.size() : 0;
    if (part.paint == MeshPart::Paint::kLed && (part.led < 0 || static_cast<std::size_t>(part.led) >= leds))
      return fmt::format("a part of the mesh has the colour of LED {}, and there are {}", part.led, leds);
    if (!part.from.allFinite() || !part.to.allFinite() || !(part.radius >= 0 && part.radius <= kMostMetresOfRow))
      return "a part of the mesh is at no finite place";
    if (part.form != MeshPart::Form::kFile) continue;
    if (part.file.empty() || !part.scale.allFinite() || (part.scale.array() == 0).any() ||
        !(std::abs(part.orientation.norm() - 1) < 1e-6))
      return fmt::format("the part '{}' of the mesh needs a file, a scale other than 0 and an orientation of length 1",
                         part.file);
  }
  return {};
}

// Attributes that follow from the rest of a row, or that the simulator's own mechanisms read.
constexpr std::array<std::string_view, 9> kReservedAttributes{
    "led", "beacon", "intensity", "gripped", "turret_angle", "gripper_aperture", "attached", "laser", "rope_attached"};

bool IsMessage(const AttributeSpec& spec)
{
  return spec.name == "message" && spec.count == 3 && spec.value == AttributeValue::kBytes;
}

std::string MistakeInNames(const std::vector<AttributeSpec>& own)
{
  for (const AttributeSpec& spec : own)
  {
    if (std::find(kReservedAttributes.begin(), kReservedAttributes.end(), spec.name) != kReservedAttributes.end())
      return fmt::format("the attribute '{}' has a name that the simulator gives", spec.name);
    if (spec.name == "message" && !IsMessage(spec))
      return "the attribute 'message' is that of range and bearing: 3 slots of kBytes";
  }
  return {};
}

std::string MistakeInAttributes(const Row& row)
{
  int slots = 0;
  for (std::size_t i = 0; i < row.attributes.size(); ++i)
  {
    const AttributeSpec& spec = row.attributes[i];
    const auto same = [&](const AttributeSpec& other) { return other.name == spec.name; };
    if (spec.name.empty() || spec.count < 1 || !std::isfinite(spec.initial) || std::abs(spec.initial) > 1e9)
      return fmt::format("the attribute '{}' has {} slots that start at {}", spec.name, spec.count, spec.initial);
    if (spec.value == AttributeValue::kPresence) return fmt::format("the attribute '{}' is a presence", spec.name);
    if (std::count_if(row.attributes.begin(), row.attributes.end(), same) > 1)
      return fmt::format("the attribute '{}' is there twice", spec.name);
    slots = std::min(slots, kMostSlots) + std::min(spec.count, kMostSlots);
  }
  return slots > kMostSlots ? fmt::format("more than {} slots of attributes", kMostSlots) : std::string();
}

// Adds the parameters that follow from the rest of the row, in front of the row's own.
void AddParameters(Row& row)
{
  std::vector<ParameterSpec> all;
  const auto add = [&](ParameterSpec parameter) { all.push_back(std::move(parameter)); };
  const std::string colour = fmt::format("#{:06x}", row.colour & 0xffffff);
  switch (row.role)
  {
    case EntityRole::kRobot:
      add(ControllerParameter());
      break;
    case EntityRole::kObject:
    {
      if (row.size.isZero() && row.form == BodyForm::kCylinder)
      {
        add(RadiusParameter());
        add(HeightParameter());
      }
      if (row.size.isZero() && row.form == BodyForm::kBox) add(BoxSizeParameter());
      if (row.mobility == Mobility::kIfAsked) add(MovableParameter());
      const bool movable = row.mobility != Mobility::kNever;
      if (movable) add(MassParameter());
      add(FrictionParameter());
      add(RestitutionParameter());
      if (movable) add(GroundFrictionParameter());
      if (movable) add(GroundTorqueParameter());
      add(ColourParameter(colour));
      add(MeshParameter());
      add(MeshOrientationParameter());
      if (row.form == BodyForm::kBox && row.corners.empty())
      {
        add(ConvexParameter());
        add(CornersParameter());
      }
      break;
    }
    case EntityRole::kLight:
      add(IntensityParameter());
      add(ColourParameter(colour));
      break;
    case EntityRole::kSound:
      add(IntensityParameter());
      break;
    case EntityRole::kPatch:
    case EntityRole::kHole:
      add(AreaSizeParameter());
      add(AreaRadiusParameter());
      if (row.role != EntityRole::kPatch) break;
      add(ColourParameter(colour));
      add(PictureParameter());
      break;
    case EntityRole::kTerrain:
      break;
  }
  for (ParameterSpec& parameter : row.parameters)
  {
    std::erase_if(all, [&](const ParameterSpec& other) { return other.name == parameter.name; });
    all.push_back(std::move(parameter));
  }
  row.parameters = std::move(all);
}

void AddAttributes(Row& row)
{
  std::vector<AttributeSpec> all;
  if (row.leds)
    all.push_back(
        {"led", static_cast<int>(row.leds->places.size()), 0, "colours of the LEDs", AttributeValue::kColour});
  if (row.beacon_height_m) all.push_back({"beacon", 1, 0, "colour of the beacon", AttributeValue::kColour});
  if (row.propellers && row.propellers->magnet_reach_m > 0)
    all.push_back({"attached", 1, 0, "1 while attached to the ceiling", AttributeValue::kSwitch});
  if (row.role == EntityRole::kObject || row.role == EntityRole::kPatch)
    all.push_back({"colour", 1, static_cast<double>(row.colour), "colour of the surface", AttributeValue::kColour});
  if (row.role == EntityRole::kLight || row.role == EntityRole::kSound)
  {
    all.push_back({"colour", 1, static_cast<double>(row.colour), "colour of the light", AttributeValue::kColour});
    all.push_back({"intensity", 1, 1, "intensity of the light"});
  }
  // The row keeps the names.
  for (const MovingLink& link : row.links)
    all.push_back({link.attribute, 1, link.Start(),
                   link.slides ? "position of the joint in metres" : "position of the joint in radians"});
  all.insert(all.end(), row.attributes.begin(), row.attributes.end());
  row.attributes = std::move(all);
}

}  // namespace

std::vector<Vector2> PlacesOnCircle(int count, double radius_m, double first_angle)
{
  std::vector<Vector2> places;
  for (int i = 0; i < count; ++i)
  {
    const SinCos angle = SinCosOf(first_angle + i * (2 * kPi / count));
    places.emplace_back(radius_m * angle.cos, radius_m * angle.sin);
  }
  return places;
}

const EntityKindDescription& DescriptionOf(EntityKind kind) { return *Rows().at(static_cast<std::size_t>(kind)); }

std::size_t EntityKindCount() { return Rows().size(); }

bool IsBuiltIn(EntityKind kind) { return static_cast<std::size_t>(kind) < kOwnKinds; }

std::optional<EntityKind> KindOfTag(std::string_view tag)
{
  const auto& rows = Rows();
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (rows[k]->tag == tag ||
        std::find(rows[k]->further_tags.begin(), rows[k]->further_tags.end(), tag) != rows[k]->further_tags.end())
      return static_cast<EntityKind>(k);
  return std::nullopt;
}

void RegisterEntityKind(EntityKindDescription row)
{
  PluginCatalogue& catalogue = PluginCatalogue::Instance();
  const std::string name = "the entity kind '" + row.tag + "'";
  if (!IsName(row.tag))
    return catalogue.Refuse(name + " has no good tag: letters, digits and '_', the first one no digit");
  PluginDescription description;
  description.label = row.tag;
  description.brief = row.description;
  if (const std::string wrong = MistakeInNames(row.attributes); !wrong.empty())
    return catalogue.Refuse(name + " is wrong: " + wrong);
  AddParameters(row);
  AddAttributes(row);
  description.parameters = row.parameters;
  if (catalogue.Find(PluginKind::kEntityKind, row.tag) == nullptr && IsTaken(row.tag))
    return catalogue.Refuse(name + " has the name of an element that the simulator knows already");
  if (Rows().size() >= kMostKinds)
    return catalogue.Refuse(fmt::format("{} is one too many: there may be {}", name, kMostKinds));
  for (const auto mistake : {MistakeInBody, MistakeInParts, MistakeInAttributes})
    if (const std::string wrong = mistake(row); !wrong.empty()) return catalogue.Refuse(name + " is wrong: " + wrong);
  for (const std::string& tag : row.further_tags)
    if (!IsName(tag) || IsTaken(tag)) return catalogue.Refuse(name + " cannot also be called '" + tag + "'");
  if (!catalogue.Add(PluginKind::kEntityKind, description)) return;
  if (row.word.empty()) row.word = row.tag;
  if (row.short_word.empty()) row.short_word = row.tag;
  Rows().push_back(std::make_unique<const Row>(std::move(row)));
}

bool IsRobot(EntityKind kind) { return DescriptionOf(kind).role == EntityRole::kRobot; }

bool IsBodiless(EntityKind kind)
{
  const EntityRole role = DescriptionOf(kind).role;
  return role == EntityRole::kLight || role == EntityRole::kSound || role == EntityRole::kPatch;
}

bool HasBody(EntityKind kind) { return DescriptionOf(kind).form != BodyForm::kNone; }

bool IsFreeBox(EntityKind kind)
{
  const EntityKindDescription& row = DescriptionOf(kind);
  return row.form == BodyForm::kBox && row.origin == BodyOrigin::kCentre;
}

bool StandsOnLinks(EntityKind kind) { return DescriptionOf(kind).base.has_value(); }

bool Carries(EntityKind kind, std::string_view device_type)
{
  const EntityKindDescription& row = DescriptionOf(kind);
  if (device_type == "wheels") return row.wheels.has_value();
  if (device_type == "joints") return !row.links.empty();
  if (device_type == "led_ring" || device_type == "directional_leds") return row.leds.has_value();
  if (device_type == "proximity") return row.proximity.has_value();
  if (device_type == "ground") return !row.ground_points.empty();
  if (device_type == "eyebot_propellers" || device_type == "eyebot_altitude" || device_type == "eyebot_camera")
    return row.propellers.has_value();
  if (device_type == "eyebot_attachment") return row.propellers && row.propellers->magnet_reach_m > 0;
  if (device_type == "range_and_bearing") return std::ranges::any_of(row.attributes, IsMessage);
  return std::find(row.devices.begin(), row.devices.end(), device_type) != row.devices.end();
}

bool CanWait(EntityKind kind)
{
  const EntityKindDescription& row = DescriptionOf(kind);
  if (row.role == EntityRole::kHole || row.role == EntityRole::kTerrain) return false;
  return row.form == BodyForm::kNone || row.mobility != Mobility::kNever;
}

std::string_view TableName(EntityKind kind) { return DescriptionOf(kind).word; }

std::string_view TagName(EntityKind kind) { return DescriptionOf(kind).tag; }

}  // namespace swarmanoid
