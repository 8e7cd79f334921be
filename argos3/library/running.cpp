// Code that was written for ARGoS3 reaches its surroundings through globals: registries that static constructors fill,
// one simulator, one log. They exist once in a process here. The robot or the functions on whose behalf code runs at
// the moment is kept for each thread and stacked by Speaker; it determines whose random numbers are drawn and to which
// log lines belong.
//
// Ids differ in distributed groups: the robot "fb7" of ARGoS3 is "fb_3" here if its group starts with number 4. The
// characters of single ids may differ.
#include "argos3/library/running.h"

#include <argos3/core/utility/string_utilities.h>

#include <algorithm>
#include <iostream>

#include "argos3/converter/our_ids.h"

namespace swarmanoid::argos3
{
namespace
{

thread_local Speaker::Speaking speaking;

bool IsNumber(std::string_view text)
{
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Returns the number behind the prefix, if the rest is a number.
std::optional<long long> NumberBehind(const std::string& id, const std::string& prefix)
{
  if (!id.starts_with(prefix) || !IsNumber(std::string_view(id).substr(prefix.size()))) return std::nullopt;
  return ParseInteger(id.substr(prefix.size()));
}

}  // namespace

std::map<std::string, argos::CCI_Controller* (*)()>& ControllersByLabel()
{
  static std::map<std::string, argos::CCI_Controller* (*)()> controllers;
  return controllers;
}

std::map<std::string, argos::CLoopFunctions* (*)()>& LoopFunctionsByLabel()
{
  static std::map<std::string, argos::CLoopFunctions* (*)()> functions;
  return functions;
}

std::map<std::string, argos::CQTOpenGLUserFunctions* (*)()>& UserFunctionsByLabel()
{
  static std::map<std::string, argos::CQTOpenGLUserFunctions* (*)()> functions;
  return functions;
}

std::map<std::string, argos::SMadeSensor (*)()>& SensorsByLabel()
{
  static std::map<std::string, argos::SMadeSensor (*)()> sensors;
  return sensors;
}

std::map<std::string, argos::SMadeActuator (*)()>& ActuatorsByLabel()
{
  static std::map<std::string, argos::SMadeActuator (*)()> actuators;
  return actuators;
}

Translation Translation::From(const TConfigurationTree& tree)
{
  Translation translation;
  translation.origin = tree.GetVector3("origin");
  std::istringstream entries(tree.GetText("distributed", ""));
  for (std::string entry; entries >> entry;)
  {
    const std::size_t second = entry.rfind(':');
    const std::size_t first = second == 0 ? std::string::npos : entry.rfind(':', second - 1);
    if (second == std::string::npos || first == std::string::npos)
      throw ConfigurationError(tree.ValueLocation("distributed"), "'" + entry + "' is no prefix:number:id");
    const std::string theirs = Decoded(std::string_view(entry).substr(0, first)), ours = entry.substr(second + 1);
    if (second == first + 1)
    {
      translation.ours_of_single[theirs] = ours;
      translation.single_of_ours[ours] = theirs;
      continue;
    }
    translation.distributed.push_back(
        {theirs, ParseInteger(entry.substr(first + 1, second - first - 1)).value_or(0), ours});
  }
  return translation;
}

std::string Translation::Argos3Id(const std::string& id) const
{
  if (const auto single = single_of_ours.find(id); single != single_of_ours.end()) return single->second;
  for (const Distributed& group : distributed)
    if (const auto number = NumberBehind(id, group.ours + "_"))
      return group.theirs + std::to_string(*number + group.first);
  return id;
}

std::string Translation::OurId(const std::string& id) const
{
  if (const auto single = ours_of_single.find(id); single != ours_of_single.end()) return single->second;
  // Groups of one prefix have consecutive numbers.
  const Distributed* found = nullptr;
  long long number = 0;
  for (const Distributed& group : distributed)
  {
    const auto behind = NumberBehind(id, group.theirs);
    if (!behind || *behind < group.first || (found != nullptr && group.first < found->first)) continue;
    found = &group;
    number = *behind - group.first;
  }
  return found == nullptr ? id : found->ours + "_" + std::to_string(number);
}

std::string Running::OurId(const std::string& id) const
{
  const auto found = taken.find(id);
  return found != taken.end() ? found->second : translation.OurId(id);
}

void CopyElement(const ConfigurationNode& from, argos::TConfigurationNode& to)
{
  to.SetValue(from.name);
  to.SetText(from.text);
  to.SetPlace(from.location.Text());
  for (const ConfigurationNode::Attribute& attribute : from.attributes)
    to.SetAttribute(attribute.name, attribute.value);
  for (const auto& child : from.children) CopyElement(*child, to.InsertEndChild(argos::TConfigurationNode()));
}

Running& TheRunning()
{
  static Running running;
  return running;
}

Speaker::Speaker(const Speaking& now) : place_(speaking), before_(std::exchange(place_, now)) {}

bool Speaker::Speaks() { return speaking.robot != nullptr || speaking.functions != nullptr; }

std::uint64_t Speaker::RandomBits()
{
  if (!Speaks())
    throw argos::CARGoSException(
        "a random generator is created before Init; create it in Init, where the robot is known whose numbers it "
        "draws");
  RandomStream& random = speaking.robot != nullptr ? speaking.robot->GetRandom() : speaking.functions->GetRandom();
  const std::uint64_t high = random.Bits();
  return high << 32U | random.Bits();
}

void Speaker::Say(const std::string& line)
{
  if (speaking.robot != nullptr)
    speaking.robot->Log(line);
  else
    std::cerr << line << '\n';
}

}  // namespace swarmanoid::argos3

namespace argos
{

SControllerRegistration::SControllerRegistration(const char* label, CCI_Controller* (*create)())
{
  swarmanoid::argos3::ControllersByLabel().emplace(label, create);
}

SLoopFunctionsRegistration::SLoopFunctionsRegistration(const char* label, CLoopFunctions* (*create)())
{
  swarmanoid::argos3::LoopFunctionsByLabel().emplace(label, create);
}

SSensorRegistration::SSensorRegistration(const char* label, SMadeSensor (*make)())
{
  swarmanoid::argos3::SensorsByLabel().emplace(label, make);
}

SActuatorRegistration::SActuatorRegistration(const char* label, SMadeActuator (*make)())
{
  swarmanoid::argos3::ActuatorsByLabel().emplace(label, make);
}

SUserFunctionsRegistration::SUserFunctionsRegistration(const char* label, CQTOpenGLUserFunctions* (*create)())
{
  swarmanoid::argos3::UserFunctionsByLabel().emplace(label, create);
}

}  // namespace argos
