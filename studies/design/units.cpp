#include "studies/design/units.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "common/experiment/element_form.h"
#include "common/experiment/settings.h"

namespace swarmanoid
{
namespace
{

using Node = std::shared_ptr<const ConfigurationNode>;

const ConfigurationNode* ChildOf(const ConfigurationNode& node, const std::string& tag, std::size_t number)
{
  for (const Node& child : node.children)
    if (child->name == tag && number-- == 0) return child.get();
  return nullptr;
}

// Returns the unit of the value at an address such as "/controllers[0]/diffusion[1]/parameters[0]/velocity[0]".
std::string UnitAt(const ConfigurationNode& root, const std::string& address)
{
  std::vector<const ConfigurationNode*> path{&root};
  for (std::size_t at = 1; at < address.size();)
  {
    const std::size_t end = std::min(address.find('/', at), address.size());
    const std::size_t bracket = address.find('[', at);
    const std::string tag = address.substr(at, bracket - at);
    if (end == address.size())
    {
      for (const ParameterSpec& parameter : FormOf(path).parameters)
        if (Matches(parameter, tag)) return parameter.unit;
      return "";
    }
    path.push_back(ChildOf(*path.back(), tag, std::stoul(address.substr(bracket + 1))));
    if (path.back() == nullptr) return "";
    at = end + 1;
  }
  return "";
}

std::string UnitOf(const Factor& factor, const Node& root)
{
  if (factor.levels.empty() || factor.levels.front().changes.empty() || !factor.is_numeric) return "";
  try
  {
    return UnitAt(*root, SettingAddress(root, factor.levels.front().changes.front().path));
  }
  catch (const ConfigurationError&)
  {
    return "";  // another experiment of a variant has the setting
  }
}

}  // namespace

std::map<std::string, std::string> UnitsOf(const Study& study, const Design& design)
{
  std::map<std::string, std::string> units;
  const auto add = [&](const std::string& name, const std::string& unit)
  {
    if (!unit.empty()) units[name] = unit;
  };
  if (const Node root = ReadExperimentTree(design.ExperimentOf(0)))
    for (const Factor* factor : study.Factors()) add(factor->id, UnitOf(*factor, root));
  for (const MetricChoice& choice : study.metrics)
  {
    if (choice.aggregates.empty()) add(choice.id, MetricUnit(choice));
    for (const std::string& aggregate : choice.aggregates)
      if (aggregate != "count") add(choice.id + "." + aggregate, MetricUnit(choice));
  }
  return units;
}

}  // namespace swarmanoid
