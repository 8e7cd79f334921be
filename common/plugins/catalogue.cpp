#include "common/plugins/catalogue.h"

#include <stdexcept>
#include <utility>

#include "common/configuration/parameter_table.h"

namespace swarmanoid
{

std::string_view PluginKindName(PluginKind kind)
{
  switch (kind)
  {
    case PluginKind::kController:
      return "controller";
    case PluginKind::kActuator:
      return "actuator";
    case PluginKind::kSensor:
      return "sensor";
    case PluginKind::kEngine:
      return "physics engine";
    case PluginKind::kRenderer:
      return "visualisation";
    case PluginKind::kExperimentFunctions:
      return "experiment functions";
    case PluginKind::kEntityKind:
      return "entity kind";
  }
  return "plug-in";
}

std::string NameOfPlugin(PluginKind kind, const std::string& label, const std::string& implementation)
{
  const std::string name = std::string(PluginKindName(kind)) + " '" + label + "'";
  return implementation.empty() ? name : name + " (" + implementation + ")";
}

PluginCatalogue& PluginCatalogue::Instance()
{
  static PluginCatalogue catalogue;
  return catalogue;
}

bool PluginCatalogue::Add(PluginKind kind, const PluginDescription& description)
{
  const bool added =
      plugins_.emplace(std::tuple{kind, description.label, description.implementation}, description).second;
  if (loading_) current_.labels.emplace_back(kind, description.label);
  const std::string wrong = MistakeInTable(description.parameters);
  if (added && wrong.empty()) return true;

  const std::string name = NameOfPlugin(kind, description.label, description.implementation);
  if (!wrong.empty())
  {
    Refuse("the table of the " + name + " is wrong: " + wrong);
    return added;
  }
  if (!loading_) throw std::invalid_argument("the " + name + " is registered twice");
  current_.problems.push_back("it registers the " + name + ", which exists already; give one of them another name");
  return false;
}

void PluginCatalogue::Refuse(const std::string& problem)
{
  if (!loading_) throw std::invalid_argument(problem);
  current_.problems.push_back(problem);
}

const PluginDescription* PluginCatalogue::Find(PluginKind kind, const std::string& label,
                                               const std::string& implementation) const
{
  const auto found = plugins_.find({kind, label, implementation});
  return found == plugins_.end() ? nullptr : &found->second;
}

std::vector<const PluginDescription*> PluginCatalogue::Of(PluginKind kind) const
{
  std::vector<const PluginDescription*> found;
  for (const auto& [key, description] : plugins_)
  {
    if (std::get<0>(key) == kind) found.push_back(&description);
  }
  return found;
}

std::vector<std::string> PluginCatalogue::Labels(PluginKind kind) const
{
  std::vector<std::string> labels;
  for (const PluginDescription* description : Of(kind))
  {
    if (labels.empty() || labels.back() != description->label) labels.push_back(description->label);
  }
  return labels;
}

std::vector<std::string> PluginCatalogue::Implementations(PluginKind kind, const std::string& label) const
{
  std::vector<std::string> implementations;
  for (const PluginDescription* description : Of(kind))
  {
    if (description->label == label) implementations.push_back(description->implementation);
  }
  return implementations;
}

void PluginCatalogue::BeginLibrary()
{
  loading_ = true;
  current_ = {};
}

PluginCatalogue::Registrations PluginCatalogue::EndLibrary()
{
  loading_ = false;
  return std::exchange(current_, {});
}

}  // namespace swarmanoid
