// Metrics of values from elsewhere: attributes of entities, and values that controllers and functions publish.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "common/configuration/wording.h"
#include "common/control_interface/ci_publish.h"
#include "common/space/attributes.h"
#include "common/space/battery_slots.h"
#include "common/space/packet_attribute.h"
#include "common/space/publish.h"
#include "common/space/space.h"
#include "studies/metrics/metric_kinds.h"

namespace swarmanoid
{
namespace
{

using Entities = std::vector<std::uint32_t>;

class AttributeMetric : public Metric
{
public:
  AttributeMetric(Entities entities, std::string name, int element)
      : entities_(std::move(entities)), name_(std::move(name)), element_(element)
  {
  }

  void Measure(CSimulator& simulator, std::vector<double>& values) override
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    for (const std::uint32_t index : entities_)
      if (space.IsPresent(index)) values.push_back(space.GetEntity(index).GetAttribute(name_, element_));
  }

private:
  Entities entities_;
  std::string name_;
  int element_;
};

// The parameter `value` of <battery>.
enum class BatteryValue
{
  kCharge,
  kUsed,
  kCharged,
  kPower,
  kEmpty
};

BatteryValue BatteryValueOf(const std::string& name)
{
  using enum BatteryValue;
  if (name == "used") return kUsed;
  if (name == "charged") return kCharged;
  if (name == "power") return kPower;
  return name == "empty" ? kEmpty : kCharge;
}

class BatteryMetric : public Metric
{
public:
  BatteryMetric(Entities entities, BatteryValue value)
      : entities_(std::move(entities)),
        value_(value),
        last_j_(entities_.size(), kNoValue),
        used_j_(entities_.size(), 0),
        charged_j_(entities_.size(), 0)
  {
  }

  void Look(CSimulator& simulator) override
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    for (std::size_t i = 0; i < entities_.size(); ++i)
    {
      const BatteryView battery = *BatteryView::Of(space, entities_[i]);
      const double charge_j = battery.Charge_J();
      if (last_j_[i] == last_j_[i])
      {
        const double used_j = battery.Power_W() * space.GetTickSeconds();
        used_j_[i] += used_j;
        charged_j_[i] += charge_j - last_j_[i] + used_j;
      }
      last_j_[i] = charge_j;
    }
  }
  void Measure(CSimulator& simulator, std::vector<double>& values) override
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    for (std::size_t i = 0; i < entities_.size(); ++i)
      if (space.IsPresent(entities_[i])) values.push_back(Value(*BatteryView::Of(space, entities_[i]), i));
  }

private:
  double Value(const BatteryView& battery, std::size_t i) const
  {
    using enum BatteryValue;
    switch (value_)
    {
      case kCharge:
        return battery.Charge_J();
      case kUsed:
        return used_j_[i];
      case kCharged:
        return charged_j_[i];
      case kPower:
        return battery.Power_W();
      case kEmpty:
        break;
    }
    return battery.Charge_J() == 0 || battery.IsOff() ? 1 : 0;
  }

  Entities entities_;
  BatteryValue value_;
  std::vector<double> last_j_, used_j_, charged_j_;  // by entity
};

void RequireBatteries(const MetricChoice& choice, const Entities& entities, const Experiment& experiment)
{
  for (const std::uint32_t index : entities)
    if (!BatteryOf(experiment, experiment.entities[index]))
      throw ConfigurationError(
          choice.location, fmt::format("'{}' has no battery that its parts draw from; name robots by 'of', and give "
                                       "their controllers the sensor <battery> with the implementation {}",
                                       experiment.entities[index].id, kEnergyBattery));
}

class PublishedByFunctions : public Metric
{
public:
  PublishedByFunctions(std::string name, SourceLocation place) : name_(std::move(name)), place_(std::move(place)) {}

  void Look(CSimulator& simulator) override
  {
    if (!numbers_) numbers_.emplace(simulator.GetSpace());
  }
  void Measure(CSimulator&, std::vector<double>& values) override
  {
    const auto found = numbers_->Values().find(name_);
    if (found != numbers_->Values().end()) values.push_back(found->second);
  }
  void RequireSeen(std::uint64_t ticks) const override
  {
    std::vector<std::string> names;
    for (const auto& [name, value] : numbers_->Values())
    {
      if (name == name_) return;
      names.push_back(name);
    }
    throw ConfigurationError(
        place_, fmt::format("no experiment function has published {} in the {} ticks of the run; a number that has no "
                            "value yet is published as 0 from the first tick on; published are: {}{}",
                            Quoted(name_), ticks, Listed(names), DidYouMean(name_, names)));
  }

private:
  std::string name_;
  SourceLocation place_;
  std::optional<PublishedNumbers> numbers_;
};

class PublishedByControllers : public Metric
{
public:
  PublishedByControllers(Entities entities, std::string name, SourceLocation place)
      : entities_(std::move(entities)), name_(std::move(name)), place_(std::move(place))
  {
  }

  // The search ends once one robot has published the value.
  void Look(CSimulator& simulator) override
  {
    for (std::size_t i = 0; i < entities_.size() && !is_seen_; ++i)
      is_seen_ = NumberOf(simulator.GetSpace(), entities_[i]).has_value();
  }
  void Measure(CSimulator& simulator, std::vector<double>& values) override
  {
    const CSwarmanoidSpace& space = simulator.GetSpace();
    for (const std::uint32_t index : entities_)
      if (space.IsPresent(index)) values.push_back(NumberOf(space, index).value_or(kNoValue));
  }
  // A report has only 16 bits of each name, so that the message cannot list the published names.
  void RequireSeen(std::uint64_t ticks) const override
  {
    if (!is_seen_)
      throw ConfigurationError(
          place_, fmt::format("no controller of {} has published {} in the {} ticks of the run; compare the name "
                              "with those that the controllers give to Publish: a number that has no value yet is "
                              "published as 0 from the first step on",
                              entities_.size() == 1 ? "the entity" : fmt::format("the {} entities", entities_.size()),
                              Quoted(name_), ticks));
  }

private:
  std::optional<double> NumberOf(const CSwarmanoidSpace& space, std::uint32_t index) const
  {
    if (!space.IsPresent(index)) return std::nullopt;
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(index);
    double slots[kPacketSlots - 1];
    for (std::size_t i = 0; i < kPacketSlots - 1; ++i)
      slots[i] = entity.GetAttribute("report", static_cast<int>(i) + 1);
    const AttributePacket packet = UnpackedPacket(slots);
    return PublishedNumberIn(packet.Bytes(), name_);
  }

  Entities entities_;
  std::string name_;
  SourceLocation place_;
  bool is_seen_ = false;
};

void RequireAttribute(const MetricChoice& choice, const Entities& entities, const Experiment& experiment)
{
  const std::string name = *choice.tree.Value("name");
  const long long element = choice.tree.GetInteger("element", 0);
  for (const std::uint32_t index : entities)
  {
    const EntityConfiguration& entity = experiment.entities[index];
    std::vector<std::string> names;
    const AttributeSpec* found = nullptr;
    for (const AttributeSpec& attribute : AttributesOf(entity.kind))
    {
      names.emplace_back(attribute.name);
      if (attribute.name == name) found = &attribute;
    }
    if (found == nullptr)
      throw ConfigurationError(choice.tree.ValueLocation("name"),
                               fmt::format("{} '{}' has no attribute {}; it has: {}{}", TagName(entity.kind), entity.id,
                                           Quoted(name), Listed(names), DidYouMean(name, names)));
    if (element >= found->count)
      throw ConfigurationError(choice.tree.ValueLocation("element"),
                               fmt::format("the attribute {} of {} has the elements 0 to {}", Quoted(name),
                                           TagName(entity.kind), found->count - 1));
  }
}

void RequireReports(const MetricChoice& choice, const Entities& entities, const Experiment& experiment)
{
  for (const std::uint32_t index : entities)
  {
    const EntityConfiguration& entity = experiment.entities[index];
    const ControllerConfiguration* controller = experiment.FindController(entity.controller);
    const auto lists = [](const DeviceConfiguration& device) { return device.type == "report"; };
    if (controller == nullptr || std::none_of(controller->actuators.begin(), controller->actuators.end(), lists))
      throw ConfigurationError(
          choice.location, fmt::format("the controller {} of '{}' publishes nothing: Publish needs the actuator "
                                       "<report><implementation>generic_report</implementation></report> in its list",
                                       Quoted(entity.controller), entity.id));
  }
}

}  // namespace

bool IsPublishedByFunctions(const MetricChoice& choice)
{
  return choice.kind == "published" && choice.tree.Value("by").value_or("functions") == "functions";
}

std::unique_ptr<Metric> MakeFunctionMetric(const MetricChoice& choice, const Experiment& experiment)
{
  if (!choice.of.empty())
    throw ConfigurationError(choice.tree.ValueLocation("of"),
                             "what functions publish is one value, not of entities; leave 'of' out");
  if (experiment.functions.empty())
    throw ConfigurationError(choice.location, "the experiment has no <experiment_functions> that could publish it");
  return std::make_unique<PublishedByFunctions>(*choice.tree.Value("name"), choice.tree.ValueLocation("name"));
}

std::unique_ptr<Metric> MakeValueMetric(const MetricChoice& choice, const std::vector<std::uint32_t>& entities,
                                        const Experiment& experiment)
{
  const std::string name = choice.tree.Value("name").value_or("");
  if (choice.kind == "published")
  {
    RequireReports(choice, entities, experiment);
    return std::make_unique<PublishedByControllers>(entities, name, choice.tree.ValueLocation("name"));
  }
  if (choice.kind == "battery")
  {
    RequireBatteries(choice, entities, experiment);
    return std::make_unique<BatteryMetric>(entities, BatteryValueOf(choice.tree.Value("value").value_or("charge")));
  }
  if (choice.kind != "attribute") return nullptr;
  RequireAttribute(choice, entities, experiment);
  return std::make_unique<AttributeMetric>(entities, name, static_cast<int>(choice.tree.GetInteger("element", 0)));
}

}  // namespace swarmanoid
