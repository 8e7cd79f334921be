// The devices of ARGoS3 are matched to the ones of our robots by the names that users write in <sensors> and
// <actuators>. One device there may need several here, and several there may share one; hence the lists are maps, and a
// device that exists already is extended. A device that is unknown or whose numbers are malformed is a mistake. An
// attribute that was not read has no effect, which is a note.
#include "argos3/converter/device_names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "argos3/converter/battery.h"
#include "argos3/converter/robot_rows.h"
#include "common/configuration/wording.h"

namespace swarmanoid::argos3
{
namespace
{

ConfigurationNode& AddDevice(Devices& devices, const std::string& type, const std::string& implementation,
                             const SourceLocation& location)
{
  Made& device = devices[type];
  if (device == nullptr)
  {
    device = MakeNode(type, location);
    SetValue(*device, "implementation", implementation, location);
  }
  return *device;
}

// The attributes of one device of ARGoS3. Attributes that were not read at the end have no effect, and are reported.
class Attributes
{
public:
  Attributes(const ConfigurationNode& node, const DeviceContext& context) : node_(node), context_(context)
  {
    used_ = {"implementation"};
    if (const auto* shows = FindAttributeOf(node, "show_rays"); shows != nullptr && shows->value == "false")
      used_.insert("show_rays");
  }
  ~Attributes()
  {
    for (const ConfigurationNode::Attribute& attribute : node_.attributes)
      if (!used_.contains(attribute.name))
        context_.note(attribute.location, Quoted(attribute.name) + " of <" + node_.name + "> has no effect here");
    for (const auto& child : node_.children)
      context_.note(child->location, "<" + child->name + "> of <" + node_.name + "> has no effect here");
  }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;

  // Returns nullopt if it is missing, or if it is no number, which is reported.
  std::optional<double> Number(const std::string& name)
  {
    used_.insert(name);
    const ConfigurationNode::Attribute* attribute = FindAttributeOf(node_, name);
    if (attribute == nullptr) return std::nullopt;
    if (const std::optional<double> number = ParseNumber(attribute->value)) return number;
    const std::optional<double> number = Argos3Number(attribute->value);
    if (number)
      context_.note(attribute->location, Quoted(name) + " of <" + node_.name + "> is '" + attribute->value +
                                             "', which is read as " + TextOf(*number) + ", as in ARGoS3");
    else
      context_.mistake(attribute->location, Quoted(name) + " is '" + attribute->value + "', no number");
    return number;
  }
  // Reads "min:max".
  std::optional<std::pair<double, double>> Range(const std::string& name)
  {
    used_.insert(name);
    const ConfigurationNode::Attribute* attribute = FindAttributeOf(node_, name);
    if (attribute == nullptr) return std::nullopt;
    const std::size_t colon = attribute->value.find(':');
    const auto low = ParseNumber(std::string_view(attribute->value).substr(0, colon));
    const auto high =
        colon == std::string::npos ? std::nullopt : ParseNumber(std::string_view(attribute->value).substr(colon + 1));
    if (low && high && *low <= *high) return std::pair{*low, *high};
    context_.mistake(attribute->location, Quoted(name) + " is '" + attribute->value + "'; write min:max");
    return std::nullopt;
  }
  // Reads the medium of a device; empty if there is none.
  std::string Medium(const std::string& type)
  {
    const std::string medium = Text("medium", "");
    if (!medium.empty() && !context_.media.contains({type, medium}))
      context_.note(FindAttributeOf(node_, "medium")->location, MissingMedium(node_.name, type, medium));
    return medium;
  }
  std::string Text(const std::string& name, const std::string& fallback)
  {
    used_.insert(name);
    const ConfigurationNode::Attribute* attribute = FindAttributeOf(node_, name);
    return attribute == nullptr ? fallback : attribute->value;
  }
  // Copies an attribute to our parameter of the same meaning and unit.
  void Copy(const std::string& name, const std::string& ours, ConfigurationNode& device)
  {
    if (const auto number = Number(name)) SetValue(device, ours, TextOf(*number), node_.location);
  }
  // Copies uniform noise of plus and minus a level.
  void CopyLevel(ConfigurationNode& device)
  {
    const auto level = Number("noise_level");
    if (level && *level > 0) CopyUniform(device, "", -*level, *level);
  }
  void CopyUniform(ConfigurationNode& device, const std::string& prefix, double low, double high)
  {
    if (low == 0 && high == 0) return;
    SetValue(device, prefix + "noise_kind", "uniform", node_.location);
    SetValue(device, prefix + "noise_mean", TextOf((low + high) / 2), node_.location);
    SetValue(device, prefix + "noise_range", TextOf((high - low) / 2), node_.location);
  }

private:
  const ConfigurationNode& node_;
  const DeviceContext& context_;
  std::set<std::string> used_;
};

// Returns the row of the generic robots that have the controller; nullptr: other robots have it.
const RobotRow* GenericRobot(const DeviceContext& context)
{
  for (const std::string& kind : context.bearers.kinds)
    if (const RobotRow* row = RobotOfKind(kind); row != nullptr && row->is_generic) return row;
  return nullptr;
}

// Returns false, after a mistake, for a device that the robot does not have in ARGoS3.
bool IsOnItsRobot(const ConfigurationNode& node, const DeviceContext& context)
{
  if (const RobotRow* row = GenericRobot(context);
      row != nullptr && (" " + std::string(row->lacks) + " ").find(" " + node.name + " ") != std::string::npos)
  {
    context.mistake(node.location, "<" + node.name + "> is no device of <" + std::string(row->tag) +
                                       ">, also in ARGoS3; leave it out");
    return false;
  }
  const RobotRow* owner = OwnerOfDevice(node.name);
  if (owner == nullptr) return true;
  for (const std::string& kind : context.bearers.kinds)
    if (kind != owner->kind)
    {
      context.mistake(node.location, "<" + node.name + "> is a device of <" + std::string(owner->tag) +
                                         ">, and other robots have this controller; give them one without it");
      return false;
    }
  return true;
}

// Reports a second sensor for light, since a controller of ours has one.
void RefuseSecondLight(const ConfigurationNode& node, const DeviceContext& context, const DeviceLists& ours)
{
  if (ours.sensors.contains("light"))
    context.mistake(node.location, "a controller has one sensor for light here; leave out <light>, or the other one");
}

void ConvertWheels(Attributes& attributes, ConfigurationNode& device)
{
  for (const char* name : kWheelNoise)
    for (const char* side : {"_left", "_right"})
    {
      const std::string both(name);
      const auto number = attributes.Number(both);
      const auto own = attributes.Number(both + side);
      if (own || number) SetValue(device, both + side, TextOf(own ? *own : *number), device.location);
    }
}

constexpr std::array<const char*, 32> kSensors{"differential_steering",
                                               "light",
                                               "footbot_distance_scanner",
                                               "proximity",
                                               "ground",
                                               "epuck_proximity",
                                               "eyebot_proximity",
                                               "footbot_proximity",
                                               "footbot_light",
                                               "eyebot_light",
                                               "footbot_motor_ground",
                                               "footbot_base_ground",
                                               "positioning",
                                               "battery",
                                               "colored_blob_omnidirectional_camera",
                                               "colored_blob_perspective_camera",
                                               "footbot_turret_encoder",
                                               "kheperaiv_proximity",
                                               "kheperaiv_ultrasound",
                                               "kheperaiv_light",
                                               "kheperaiv_ground",
                                               "kheperaiv_lidar",
                                               "kilobot_light",
                                               "kilobot_communication",
                                               "epuck_light",
                                               "epuck_ground",
                                               "epuck_omnidirectional_camera",
                                               "epuck_range_and_bearing",
                                               "pipuck_differential_drive",
                                               "pipuck_rangefinders",
                                               "pipuck_ground",
                                               "pipuck_system"};
constexpr const char* kScanner = "footbot_distance_scanner";

constexpr std::array<const char*, 16> kActuators{kScanner,
                                                 "differential_steering",
                                                 "leds",
                                                 "footbot_gripper",
                                                 "footbot_turret",
                                                 "range_and_bearing",
                                                 "quadrotor_position",
                                                 "quadrotor_speed",
                                                 "kilobot_led",
                                                 "kilobot_communication",
                                                 "epuck_wheels",
                                                 "epuck_rgb_leds",
                                                 "epuck_base_leds",
                                                 "epuck_range_and_bearing",
                                                 "pipuck_differential_drive",
                                                 "pipuck_leds"};

// Each device of ARGoS3 has one implementation.
void CheckImplementation(const ConfigurationNode& node, const std::string& needed, const DeviceContext& context)
{
  const ConfigurationNode::Attribute* attribute = FindAttributeOf(node, "implementation");
  if (attribute != nullptr && attribute->value != needed)
    context.mistake(attribute->location, "<" + node.name + "> has no implementation " + Quoted(attribute->value) +
                                             "; it has " + Quoted(needed));
}

std::string ImplementationOfSensor(const std::string& tag)
{
  constexpr std::array<std::string_view, 12> kRotZOnly{"colored_blob_omnidirectional_camera",
                                                       "eyebot_light",
                                                       "footbot_base_ground",
                                                       kScanner,
                                                       "footbot_light",
                                                       "footbot_motor_ground",
                                                       "ground",
                                                       "kheperaiv_ground",
                                                       "kheperaiv_light",
                                                       "kilobot_light",
                                                       "epuck_ground",
                                                       "epuck_omnidirectional_camera"};
  if (tag == "range_and_bearing" || tag == "epuck_range_and_bearing") return "medium";
  return std::ranges::find(kRotZOnly, tag) != kRotZOnly.end() ? "rot_z_only" : "default";
}

template <class Names>
void RefuseUnknown(const ConfigurationNode& node, const char* what, const Names& names, const DeviceContext& context)
{
  std::vector<std::string> known(names.begin(), names.end());
  if (std::string_view(what) == "sensor") known.emplace_back("range_and_bearing");
  context.mistake(node.location, std::string("the ARGoS3 ") + what + " <" + node.name +
                                     "> has no counterpart; those that have: " + Listed(known) +
                                     DidYouMean(node.name, known));
}

// Without <battery> the battery is not discharged.
void ConvertBattery(const DeviceContext& context, ConfigurationNode& device)
{
  double per_second = 0, per_metre = 0, per_radian = 0;
  if (const ConfigurationNode* node = context.bearers.battery)
  {
    Attributes attributes(*node, context);
    const double full = attributes.Number("full_charge").value_or(1);
    attributes.Number("start_charge");
    if (full <= 0) context.mistake(node->location, "'full_charge' of <battery> is more than 0");
    const std::string model = attributes.Text("discharge_model", "time");
    if (model != "time" && model != "motion" && model != "time_motion")
      context.mistake(node->location, Quoted(model) + " is no discharge_model; time, motion and time_motion are");
    const double scale = 1 / (full * kBatteries);
    if (model != "motion")
      per_second = attributes.Number(model == "time" ? "delta" : "time_factor").value_or(1e-5) *
                   context.ticks_per_second * scale;
    if (model != "time")
    {
      const bool is_motion = model == "motion";
      per_metre = attributes.Number(is_motion ? "pos_delta" : "pos_factor").value_or(1e-3) * scale;
      per_radian = attributes.Number(is_motion ? "orient_delta" : "orient_factor").value_or(1e-3) * scale;
    }
  }
  SetValue(device, "per_second", TextOf(per_second), device.location);
  SetValue(device, "per_metre", TextOf(per_metre), device.location);
  SetValue(device, "per_radian", TextOf(per_radian), device.location);
}

// The sensors of Khepera IVs alone. Returns false for other tags.
bool ConvertKheperaSensor(const ConfigurationNode& node, const DeviceContext& context, Attributes& attributes,
                          DeviceLists& ours)
{
  const SourceLocation& at = node.location;
  const std::string& tag = node.name;
  // The plug-in adds the noise to the responses (argos3/plugin/khepera_devices.cpp).
  if (tag == "kheperaiv_proximity")
  {
    AddDevice(ours.sensors, "proximity", "generic_proximity", at);
    attributes.Number("noise_level");
  }
  else if (tag == "kheperaiv_ultrasound")
  {
    SetValue(AddDevice(ours.sensors, "proximity", "generic_proximity", at), "range", TextOf(kUltrasoundReach), at);
    attributes.Number("noise_level");
  }
  else if (tag == "kheperaiv_light")
  {
    RefuseSecondLight(node, context, ours);
    ConfigurationNode& device = AddDevice(ours.sensors, "light", "argos3_light", at);
    // ARGoS3 finds the five sensors that a light reaches by steps of 15 degrees, although the sensors are 45 degrees
    // apart (kheperaiv_light_rotzonly_sensor.cpp).
    SetValue(device, "index_step", "15", at);
    attributes.CopyLevel(device);
  }
  else if (tag == "kheperaiv_lidar")
  {
    ConfigurationNode& device = AddDevice(ours.sensors, "range_scanner", "generic_range_scanner", at);
    constexpr double kUsual = 682, kMost = 8192;
    const double beams = attributes.Number("num_readings").value_or(kUsual);
    if (!(beams >= 2 && beams <= kMost && beams == std::floor(beams)))
      context.mistake(at, "'num_readings' of <kheperaiv_lidar> is " + TextOf(beams) + "; it must be from 2 to 8192");
    SetValue(device, "beams", TextOf(beams), at);
    SetValue(device, "field_of_view", "210", at);
    SetValue(device, "position", TextOf(Vector3(0, 0, kLidarHeight)), at);
    SetValue(device, "nearest", TextOf(kLidarStart), at);
    SetValue(device, "range", TextOf(kLidarReach), at);
    attributes.Number("noise_level");
  }
  else if (tag == "kheperaiv_encoder" || tag == "kheperaiv_camera")
    context.mistake(at, "<" + tag + "> exists on the real robot alone, also in ARGoS3; " +
                            (tag == "kheperaiv_encoder" ? "take differential_steering" : "leave it out"));
  else
    return false;
  return true;
}

// The sensors of e-pucks of argos3-epuck alone. Returns false for other tags.
bool ConvertEPuckSensor(const ConfigurationNode& node, const DeviceContext& context, Attributes& attributes,
                        DeviceLists& ours)
{
  const SourceLocation& at = node.location;
  const std::string& tag = node.name;
  if (tag == "epuck_light")
  {
    RefuseSecondLight(node, context, ours);
    ConfigurationNode& device = AddDevice(ours.sensors, "light", "argos3_light", at);
    // ci_epuck_light_sensor.cpp has the angles as parts of pi.
    std::string directions;
    for (const double divisor : {10.5884, 3.5999, 2.0, 1.2, 0.8571, 0.6667, 0.5806, 0.5247})
      directions += (directions.empty() ? "" : ", ") + TextOf(180 / divisor);
    SetValue(device, "directions", directions, at);
    attributes.CopyLevel(device);
  }
  else if (tag == "epuck_omnidirectional_camera")
  {
    // It sees what is nearer to the eye than the border on the floor. Here the range is along the floor, for the
    // coloured LEDs of e-pucks.
    constexpr double kEye = 0.122, kLeds = 0.0765;
    const double far = kEye * std::tan(context.bearers.camera_aperture * kRadians);
    ConfigurationNode& device =
        AddDevice(ours.sensors, "footbot_omnidirectional_camera", "generic_footbot_omnidirectional_camera", at);
    SetValue(device, "height", TextOf(kEye), at);
    SetValue(device, "aperture", "89.9", at);
    constexpr double kLeast = 1e-6;
    SetValue(device, "range", TextOf(std::sqrt(std::max(far * far - (kEye - kLeds) * (kEye - kLeds), kLeast))), at);
    attributes.Number("noise_std_dev");
    attributes.Medium("led");
  }
  else if (tag == "epuck_range_and_bearing")
  {
    ConfigurationNode& device = AddDevice(ours.sensors, "range_and_bearing", "generic_range_and_bearing", at);
    SetValue(device, "range", TextOf(context.largest_radio_range), at);
    if (!context.checks_occlusions(attributes.Medium("range_and_bearing")))
      SetValue(device, "line_of_sight", "false", at);
    if (const RobotRow* row = GenericRobot(context)) SetValue(device, "antenna", TextOf(row->antenna_m), at);
    AddDevice(ours.sensors, "positioning", "generic_positioning", at);
    // The plug-in adds these to the packets (argos3/plugin/epuck_devices.cpp).
    for (const char* name : {"noise_std_dev", "loss_probability", "max_packets", "data_size"}) attributes.Number(name);
    attributes.Text("real_range_noise", "");
  }
  else
    return false;
  return true;
}

// The sensors of Pi-Pucks alone. Returns false for other tags.
bool ConvertPiPuckSensor(const ConfigurationNode& node, const DeviceContext& context, DeviceLists& ours)
{
  const SourceLocation& at = node.location;
  const std::string& tag = node.name;
  if (tag == "pipuck_rangefinders")
    AddDevice(ours.sensors, "proximity", "generic_proximity", at);
  else if (tag == "pipuck_ground" && context.floor_is_painted)
    AddDevice(ours.sensors, "positioning", "generic_positioning", at);
  else if (tag == "pipuck_ground")
    AddDevice(ours.sensors, "ground", "generic_ground", at);
  else if (tag == "pipuck_imu")
    context.mistake(at, "<pipuck_imu> has no counterpart here, and reads 0 in ARGoS3; leave it out");
  else if (tag == "pipuck_front_camera")
    context.mistake(at,
                    "<pipuck_front_camera> has no counterpart here; leave it out, or take robots with "
                    "colored_blob_perspective_camera");
  else
    return tag == "pipuck_differential_drive" || tag == "pipuck_system";
  return true;
}

// Refuses devices of argos3-epuck that are not simulated here. Returns false for other tags.
bool RefuseEPuckDevice(const ConfigurationNode& node, const DeviceContext& context)
{
  constexpr std::pair<std::string_view, std::string_view> kMissing[]{
      {"epuck_ircom", "take epuck_range_and_bearing"},
      {"epuck_virtual_camrab", "take epuck_range_and_bearing and epuck_omnidirectional_camera"},
      {"epuck_encoder", "take differential_steering"},
      {"epuck_battery", "leave it out"},
      {"epuck_accelerometer", "leave it out"},
      {"epuck_micro", "leave it out"},
      {"epuck_camera", "take epuck_omnidirectional_camera"},
      {"epuck_front_camera", "take epuck_omnidirectional_camera"}};
  const auto* missing = std::ranges::find(kMissing, node.name, &std::pair<std::string_view, std::string_view>::first);
  if (missing == std::end(kMissing)) return false;
  context.mistake(node.location, "<" + node.name + "> has no counterpart here; " + std::string(missing->second));
  return true;
}

// The sensors of Kilobots alone. Returns false for other tags.
bool ConvertKilobotSensor(const ConfigurationNode& node, const DeviceContext& context, Attributes& attributes,
                          DeviceLists& ours)
{
  const SourceLocation& at = node.location;
  if (node.name == "kilobot_light")
  {
    ConfigurationNode& device = AddDevice(ours.sensors, "light", "argos3_light", at);
    SetValue(device, "directions", "100", at);
    SetValue(device, "half_angle", "180", at);
    SetValue(device, "position", TextOf(KilobotEye()), at);
    attributes.CopyLevel(device);
  }
  else if (node.name == "kilobot_communication")
  {
    // The plug-in draws losses and adds the noise (argos3/plugin/kilobot_devices.cpp).
    ConfigurationNode& device = AddDevice(ours.sensors, "range_and_bearing", "generic_range_and_bearing", at);
    SetValue(device, "range", TextOf(context.largest_radio_range), at);
    SetValue(device, "line_of_sight", "false", at);
    attributes.Medium("kilobot_communication");
    attributes.Number("noise_std_dev");
  }
  else
    return false;
  return true;
}

}  // namespace

void ConvertSensor(const ConfigurationNode& node, const DeviceContext& context, DeviceLists& ours)
{
  const SourceLocation& at = node.location;
  const std::string& tag = node.name;
  CheckImplementation(node, ImplementationOfSensor(tag), context);
  if (!IsOnItsRobot(node, context)) return;
  Attributes attributes(node, context);
  const RobotRow* generic = GenericRobot(context);
  if (RefuseEPuckDevice(node, context) || ConvertKheperaSensor(node, context, attributes, ours) ||
      ConvertKilobotSensor(node, context, attributes, ours) || ConvertEPuckSensor(node, context, attributes, ours) ||
      ConvertPiPuckSensor(node, context, ours))
    return;
  if (tag == "differential_steering")
  {
    // The encoders of generic robots read the wheel commands (argos3/plugin/generic_devices.cpp).
    if (generic == nullptr) AddDevice(ours.sensors, "footbot_encoders", "engine_footbot_encoders", at);
    // The plug-in adds this noise, and that of the camera and of range and bearing, to the readings
    // (argos3/plugin/device_noise.h).
    attributes.Range("vel_noise_range");
    attributes.Range("dist_noise_range");
  }
  else if (tag == "footbot_proximity")
    attributes.CopyLevel(AddDevice(ours.sensors, tag, "generic_footbot_proximity", at));
  else if (tag == "proximity" || tag == "epuck_proximity" || tag == "eyebot_proximity")
  {
    // The plug-in adds the noise to the response of ARGoS3 (argos3/plugin/device_adapters.cpp).
    AddDevice(ours.sensors, "proximity", "generic_proximity", at);
    attributes.Number("noise_level");
  }
  else if (tag == "footbot_light" || tag == "eyebot_light")
    attributes.CopyLevel(AddDevice(ours.sensors, tag, "argos3_" + tag, at));
  else if (tag == "light" && context.bearers.kinds.contains("eyebot"))
    context.mistake(at, "<light> has no counterpart here on eye-bots; take eyebot_light");
  else if (tag == "light")
  {
    RefuseSecondLight(node, context, ours);
    ConfigurationNode& device = AddDevice(ours.sensors, tag, "generic_light", at);
    const LightRingRow ring = generic == nullptr ? LightRingRow{} : generic->light;
    SetValue(device, "sensors", std::to_string(ring.sensors), at);
    SetValue(device, "first_angle", TextOf(ring.first_angle_deg), at);
    SetValue(device, "radius", TextOf(ring.radius_m), at);
    SetValue(device, "height", TextOf(ring.height_m), at);
    attributes.CopyLevel(device);
  }
  else if (tag == "ground" && generic == nullptr)
    context.mistake(at,
                    "<ground> has no counterpart here on foot-bots and eye-bots; take footbot_motor_ground or "
                    "footbot_base_ground");
  else if ((tag == "footbot_motor_ground" || tag == "footbot_base_ground" || tag == "ground" ||
            tag == "kheperaiv_ground" || tag == "epuck_ground") &&
           context.floor_is_painted)
  {
    AddDevice(ours.sensors, "positioning", "generic_positioning", at);
    attributes.Number("noise_level");
  }
  else if (tag == "kheperaiv_ground" || tag == "epuck_ground")
    attributes.CopyLevel(AddDevice(ours.sensors, "ground", "generic_ground", at));
  else if (tag == "footbot_motor_ground" || tag == "footbot_base_ground" || tag == "ground")
    attributes.CopyLevel(AddDevice(ours.sensors, tag, "generic_" + tag, at));
  else if (tag == "positioning")
  {
    ConfigurationNode& device = AddDevice(ours.sensors, tag, "generic_positioning", at);
    if (const auto range = attributes.Range("pos_noise_range"))
      attributes.CopyUniform(device, "position_", range->first, range->second);
    if (const auto range = attributes.Range("angle_noise_range"))
      attributes.CopyUniform(device, "heading_", range->first * kRadians, range->second * kRadians);
    // The plug-in adds the noise to the reading (argos3/plugin/device_adapters.cpp).
    attributes.Range("axis_noise_range");
  }
  else if (tag == "battery")
  {
    ConvertBattery(context, AddDevice(ours.sensors, tag, "generic_battery", at));
    attributes.Range("noise_range");
  }
  else if (tag.starts_with("colored_blob_") && generic != nullptr &&
           (!generic->flies || tag != "colored_blob_perspective_camera"))
    context.mistake(at, "<" + tag + "> is no sensor of <" + std::string(generic->tag) + ">; leave it out");
  else if (tag == "colored_blob_omnidirectional_camera")
  {
    ConfigurationNode& device =
        AddDevice(ours.sensors, "footbot_omnidirectional_camera", "argos3_footbot_omnidirectional_camera", at);
    SetValue(device, "aperture", TextOf(context.bearers.camera_aperture), at);
    // The height of the eye limits the view. This border is beyond, also on a floor that is 1 m higher.
    SetValue(device, "range", TextOf(1.3 * std::tan(context.bearers.camera_aperture * kRadians)), at);
    attributes.Number("noise_std_dev");
    attributes.Medium("led");
  }
  else if (tag == "colored_blob_perspective_camera")
  {
    const std::string type =
        context.bearers.kinds.contains("eyebot") ? "eyebot_pan_tilt_camera" : "footbot_perspective_camera";
    ConfigurationNode& device = AddDevice(ours.sensors, type, "generic_" + type, at);
    SetValue(device, "aperture", TextOf(context.bearers.perspective_aperture), at);
    SetValue(device, "range", TextOf(context.bearers.perspective_range), at);
    if (generic != nullptr) SetValue(device, "position", TextOf(Vector3(kSpiriCamera, 0, 0)), at);
    attributes.Medium("led");
  }
  else if (tag == kScanner)
  {
    ConfigurationNode& device = AddDevice(ours.sensors, tag, "argos3_footbot_distance_scanner", at);
    // The noise is that of readings in cm.
    if (const auto range = attributes.Range("noise_range"))
      attributes.CopyUniform(device, "", range->first / 100, range->second / 100);
  }
  else if (tag == "footbot_turret_encoder")
    AddDevice(ours.sensors, tag, "generic_footbot_turret_encoder", at);
  else if (tag == "range_and_bearing")
  {
    ConfigurationNode& device = AddDevice(ours.sensors, tag, "generic_range_and_bearing", at);
    // In ARGoS3 the range of a message is its sender's.
    SetValue(device, "range", TextOf(context.largest_radio_range), at);
    if (!context.checks_occlusions(attributes.Medium("range_and_bearing")))
      SetValue(device, "line_of_sight", "false", at);
    if (generic != nullptr) SetValue(device, "antenna", TextOf(generic->antenna_m), at);
    attributes.Copy("packet_drop_prob", "loss_probability", device);
    attributes.Number("noise_std_dev");
  }
  else
    RefuseUnknown(node, "sensor", kSensors, context);
}

void ConvertActuator(const ConfigurationNode& node, const DeviceContext& context, DeviceLists& ours)
{
  const SourceLocation& at = node.location;
  const std::string& tag = node.name;
  CheckImplementation(node, tag == "epuck_range_and_bearing" ? "medium" : "default", context);
  if (!IsOnItsRobot(node, context) || RefuseEPuckDevice(node, context)) return;
  Attributes attributes(node, context);
  if (tag == "leds" || tag == "epuck_rgb_leds" || tag == "epuck_base_leds") attributes.Medium("led");
  const bool is_sender =
      tag == "range_and_bearing" || tag == "kilobot_communication" || tag == "epuck_range_and_bearing";
  // Cameras of ARGoS3 see each LED, and bodies hide LEDs, also those of their own robot.
  const auto add_leds = [&](const char* type)
  {
    ConfigurationNode& device = AddDevice(ours.actuators, type, std::string("generic_") + type, at);
    if (FindAttributeOf(device, "separate") == nullptr) SetValue(device, "separate", "true", at);
  };
  const RobotRow* generic = GenericRobot(context);
  if (tag == "differential_steering" && generic != nullptr)
  {
    ConfigurationNode& wheels = AddDevice(ours.actuators, "wheels", "generic_wheels", at);
    if (generic->max_speed_m_s > 0) SetValue(wheels, "max_speed", TextOf(generic->max_speed_m_s), at);
    // The plug-in computes ARGoS3's noise in argos3/plugin/generic_devices.cpp.
    for (const char* name : kWheelNoise)
      for (const char* side : {"", "_left", "_right"}) attributes.Number(std::string(name) + side);
  }
  else if (tag == "differential_steering")
    ConvertWheels(attributes, AddDevice(ours.actuators, "footbot_wheels", "argos3_footbot_wheels", at));
  else if (tag == "leds" && context.bearers.kinds.contains("eyebot"))
    add_leds("eyebot_leds");
  else if (tag == "pipuck_differential_drive")
    AddDevice(ours.actuators, "wheels", "generic_wheels", at);
  else if (tag == "epuck_wheels")
  {
    AddDevice(ours.actuators, "wheels", "generic_wheels", at);
    attributes.Number("noise_std_dev");
  }
  else if ((tag == "leds" && generic != nullptr) || tag == "kilobot_led" || tag == "epuck_rgb_leds" ||
           tag == "epuck_base_leds")
    add_leds("led_ring");
  else if (tag == "pipuck_leds")
  {
    // They are in a medium of ARGoS3 that none of the cameras here sees. So they look straight up, in no cone.
    ConfigurationNode& device = AddDevice(ours.actuators, "directional_leds", "generic_directional_leds", at);
    SetValue(device, "observable_angle", "0", at);
    SetValue(device, "elevation", "90", at);
  }
  else if (tag == "leds")
  {
    add_leds("footbot_leds");
    AddDevice(ours.actuators, "footbot_beacon", "generic_footbot_beacon", at);
  }
  else if (tag == "footbot_gripper")
    AddDevice(ours.actuators, tag, "dummy_footbot_gripper", at);
  else if (tag == kScanner)
    AddDevice(ours.sensors, tag, "argos3_footbot_distance_scanner", at);
  else if (tag == "footbot_turret")
  {
    AddDevice(ours.actuators, tag, "dummy_footbot_turret", at);
    AddDevice(ours.sensors, "footbot_turret_encoder", "generic_footbot_turret_encoder", at);
  }
  else if (is_sender && !context.hears)
    context.note(at, "without the sensor <" + tag + "> the robots are in no medium, and no robot hears them");
  else if (is_sender)
  {
    AddSender(at, context, ours);
    if (tag != "epuck_range_and_bearing") return;
    AddDevice(ours.sensors, "positioning", "generic_positioning", at);
    attributes.Number("range");  // the arena's (convert_arena.cpp)
  }
  else if (tag == "quadrotor_position" || tag == "quadrotor_speed")
  {
    AddDevice(ours.actuators, "eyebot_propellers", "position_eyebot_propellers", at);
    AddDevice(ours.sensors, "positioning", "generic_positioning", at);
  }
  else
    RefuseUnknown(node, "actuator", kActuators, context);
}

void AddSender(const SourceLocation& location, const DeviceContext& context, DeviceLists& ours)
{
  ConfigurationNode& device = AddDevice(ours.actuators, "range_and_bearing", "generic_range_and_bearing", location);
  constexpr long long kUsual = 10;
  const long long bytes = context.bearers.radio_bytes + (context.has_radio_channels ? 1 : 0);
  if (bytes > kUsual && FindAttributeOf(device, "bytes") == nullptr)
    SetValue(device, "bytes", std::to_string(bytes), location);
  if (context.bearers.radio_range < context.largest_radio_range && FindAttributeOf(device, "range") == nullptr)
    SetValue(device, "range", TextOf(context.bearers.radio_range), location);
}

}  // namespace swarmanoid::argos3
