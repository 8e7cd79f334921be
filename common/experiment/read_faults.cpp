#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "common/configuration/wording.h"
#include "common/experiment/element_reader.h"
#include "common/experiment/sections.h"
#include "common/experiment/unique_ids.h"
#include "common/math/random.h"

namespace swarmanoid
{
namespace
{

constexpr double kLongestDelay = 10'000;  // ticks

DeviceFaultKind KindOf(const std::string& name)
{
  using enum DeviceFaultKind;
  static const std::map<std::string, DeviceFaultKind> kinds{{"dead", kDead}, {"stuck", kStuck}, {"scale", kScale},
                                                            {"bias", kBias}, {"noise", kNoise}, {"delay", kDelay},
                                                            {"drop", kDrop}, {"off", kOff}};
  const auto found = kinds.find(name);
  return found == kinds.end() ? kDead : found->second;
}

// Returns the mistake in the value of a fault, or an empty text.
std::string ValueMistake(const FaultConfiguration& fault, bool is_given)
{
  using enum DeviceFaultKind;
  const bool takes_value = fault.kind != kDead && fault.kind != kStuck && fault.kind != kOff;
  if (!takes_value)
    return is_given ? fmt::format("the kind '{}' takes no value; leave 'value' out", fault.kind_name) : std::string();
  if (!is_given) return fmt::format("the kind '{}' needs a 'value'", fault.kind_name);
  const auto whole = static_cast<double>(static_cast<long long>(fault.value));
  if (fault.kind == kDelay && (fault.value < 1 || fault.value > kLongestDelay || fault.value != whole))
    return fmt::format("the delay is {:g}; it must be a whole number of ticks, 1 to {:g}", fault.value, kLongestDelay);
  if (fault.kind == kDrop && (fault.value < 0 || fault.value > 1))
    return fmt::format("the probability is {:g}; it must be 0 to 1", fault.value);
  if (fault.kind == kNoise && fault.value < 0)
    return fmt::format("the deviation is {:g}; it must be at least 0", fault.value);
  return {};
}

// Calls use(type) for each device of a controller that the fault may concern.
template <class Use>
void ForEachDevice(const FaultConfiguration& fault, const ControllerConfiguration& controller, Use use)
{
  if (fault.of_sensors)
    for (const DeviceConfiguration& device : controller.sensors) use(device.type);
  if (fault.of_actuators)
    for (const DeviceConfiguration& device : controller.actuators) use(device.type);
}

bool HasDevice(const FaultConfiguration& fault, const ControllerConfiguration& controller)
{
  if (fault.device.empty()) return true;
  bool has = false;
  ForEachDevice(fault, controller, [&](const std::string& type) { has |= type == fault.device; });
  return has;
}

// Finds the robots with the device among those that fit the pattern.
void FindRobots(FaultConfiguration& fault, const ElementReader& reader, Reading& reading)
{
  const Experiment& experiment = reading.experiment;
  const std::string pattern = reader.Text("entities");
  const auto fits_lost = [&](const std::string& lost)
  { return FitsPattern(lost, pattern) || FitsPattern(lost + "_0", pattern); };
  std::vector<std::string> ids;  // of robots; a message lists only some of a large arena
  std::set<std::string> known;   // devices of robots that fit
  bool fits = false, is_known = true;
  std::map<std::string, bool> has_device;  // by controller
  for (std::uint32_t e = 0; e < experiment.entities.size(); ++e)
  {
    const EntityConfiguration& entity = experiment.entities[e];
    if (entity.controller.empty()) continue;
    if (ids.size() < 1000) ids.push_back(entity.id);
    if (!FitsPattern(entity.id, pattern)) continue;
    fits = true;
    const auto [has, is_new] = has_device.try_emplace(entity.controller, false);
    if (is_new)
    {
      const ControllerConfiguration* controller = experiment.FindController(entity.controller);
      is_known &= controller != nullptr;
      if (controller == nullptr) continue;
      has->second = HasDevice(fault, *controller);
      ForEachDevice(fault, *controller, [&](const std::string& type) { known.insert(type); });
    }
    if (has->second) fault.entities.push_back(e);
  }
  if (!fits && !reading.diagnostics.HasLost(fits_lost))
    reading.diagnostics.Add(
        reader.Place("entities"),
        fmt::format("no robot with a controller fits {}{}{}", Quoted(pattern),
                    ids.size() <= 20 ? "; there are: " + Listed(ids) : "", DidYouMean(pattern, ids)));
  if (!fits || !is_known || !fault.entities.empty()) return;
  const std::vector<std::string> types(known.begin(), known.end());
  const char* side = !fault.of_actuators ? "sensor" : !fault.of_sensors ? "actuator" : "device";
  reading.diagnostics.Add(reader.Place("device"),
                          fmt::format("no robot that fits {} has the {} {}; they have: {}{}", Quoted(pattern), side,
                                      Quoted(fault.device), Listed(types), DidYouMean(fault.device, types)));
}

// Each robot draws one number, and those with the lowest ones have the fault. So a larger share includes a smaller one,
// and another robot changes no number.
void DrawShare(FaultConfiguration& fault, double share, const Experiment& experiment)
{
  const auto count = static_cast<std::size_t>(share * static_cast<double>(fault.entities.size()) + 0.5);
  if (count >= fault.entities.size()) return;
  const std::uint64_t purpose = StreamName("fault share " + fault.id);
  std::vector<std::pair<double, std::uint32_t>> drawn;
  for (const std::uint32_t e : fault.entities)
    drawn.emplace_back(RandomStream(experiment.seed, StreamName(experiment.entities[e].id), purpose, 0).Uniform(), e);
  std::sort(drawn.begin(), drawn.end());
  fault.entities.clear();
  for (std::size_t k = 0; k < count; ++k) fault.entities.push_back(drawn[k].second);
  std::sort(fault.entities.begin(), fault.entities.end());
}

FaultConfiguration ReadFault(const ElementReader& reader, Reading& reading)
{
  FaultConfiguration fault;
  fault.location = reader.Tree().Location();
  fault.id = reader.Text("id");
  if (reader.IsGiven("id")) CheckId(fault.id, reader.Place("id"), reading.diagnostics);
  fault.kind_name = reader.Text("kind");
  fault.kind = KindOf(fault.kind_name);
  fault.value = reader.Number("value");
  fault.device = reader.Text("device");
  if (fault.device == "all") fault.device.clear();
  const std::string side = reader.Text("side");
  fault.of_sensors = side != "actuator";
  fault.of_actuators = side != "sensor";
  fault.from = static_cast<std::uint64_t>(reader.Integer("from"));
  fault.to = static_cast<std::uint64_t>(reader.Integer("to"));
  if (fault.to != 0 && fault.to <= fault.from)
    reading.diagnostics.Add(reader.Place("to"),
                            fmt::format("the fault ends at tick {}, but begins at tick {}; 'to' must be greater than "
                                        "'from', or 0 for the end of the run",
                                        fault.to, fault.from));
  if (reader.IsGood("kind"))
    if (const std::string mistake = ValueMistake(fault, reader.IsGiven("value")); !mistake.empty())
      reading.diagnostics.Add(reader.Place("value"), mistake);
  if (fault.kind != DeviceFaultKind::kOff) return fault;
  if (!fault.device.empty() || side != "both")
    reading.diagnostics.Add(reader.Place(fault.device.empty() ? "side" : "device"),
                            "the kind 'off' switches the whole robot off; leave 'device' and 'side' out, or choose the "
                            "kind 'dead'");
  fault.device.clear();
  fault.of_sensors = fault.of_actuators = true;
  return fault;
}

}  // namespace

void ReadFaults(const TConfigurationTree& tree, Reading& reading)
{
  if (!tree.Exists()) return;
  const ElementSpec& spec = ExperimentSchema().Child("faults");
  const ElementReader list(tree, spec, reading.diagnostics);
  UniqueIds ids("faults");
  for (const TConfigurationTree& child : tree.Children())
  {
    if (!spec.Child("fault").HasTag(child.Name())) continue;
    const ElementReader reader(child, spec.Child("fault"), reading.diagnostics);
    FaultConfiguration fault = ReadFault(reader, reading);
    if (const std::string mistake = ids.Add(fault.id, child.Location().line); !mistake.empty())
      reading.diagnostics.Add(reader.Place("id"), mistake);
    FindRobots(fault, reader, reading);
    DrawShare(fault, reader.Number("share"), reading.experiment);
    reading.experiment.faults.push_back(std::move(fault));
  }
}

}  // namespace swarmanoid
