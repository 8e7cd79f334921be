#include "common/experiment/element_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/configuration/wording.h"

namespace swarmanoid
{

ElementReader::ElementReader(const TConfigurationTree& tree, const ElementSpec& spec, Diagnostics& diagnostics,
                             const std::vector<ParameterSpec>* plugin, bool open)
    : tree_(tree), spec_(spec), diagnostics_(diagnostics), plugin_(plugin), open_(open)
{
  if (!tree_.Exists()) return;
  if (!tree_.Text().empty())
  {
    diagnostics_.Add(tree_.Location(), fmt::format("<{}> holds the text {}, where only elements are allowed",
                                                   tree_.Name(), Quoted(tree_.Text())));
  }
  CheckAttributes();
  CheckChildren();
  CheckValues(spec_.parameters);
  if (plugin_ != nullptr) CheckValues(*plugin_);
  CheckRequiredChildren();
}

const ParameterSpec* ElementReader::Find(std::string_view name) const
{
  for (const ParameterSpec& parameter : spec_.parameters)
  {
    if (Matches(parameter, name)) return &parameter;
  }
  if (plugin_ == nullptr) return nullptr;
  for (const ParameterSpec& parameter : *plugin_)
  {
    if (Matches(parameter, name)) return &parameter;
  }
  return nullptr;
}

std::vector<std::string> ElementReader::ParameterNames() const
{
  std::vector<std::string> names;
  for (const ParameterSpec& parameter : spec_.parameters) names.push_back(parameter.name);
  if (plugin_ == nullptr) return names;
  for (const ParameterSpec& parameter : *plugin_)
  {
    if (std::find(names.begin(), names.end(), parameter.name) == names.end()) names.push_back(parameter.name);
  }
  return names;
}

std::vector<std::string> ElementReader::ChildNames() const
{
  std::vector<std::string> names;
  for (const ElementSpec& child : spec_.children) names.push_back(child.Name());
  for (const std::string& name : ParameterNames()) names.push_back(name);
  if (spec_.plugins)
  {
    for (const std::string& label : PluginCatalogue::Instance().Labels(*spec_.plugins)) names.push_back(label);
  }
  return names;
}

void ElementReader::CheckAttributes()
{
  for (const auto& attribute : tree_.Node()->attributes)
  {
    const ParameterSpec* parameter = Find(attribute.name);
    if (parameter != nullptr && parameter->type != ParameterType::kTree) continue;
    if (parameter != nullptr)
    {
      diagnostics_.Add(attribute.location,
                       fmt::format("'{0}' must be written as an element, <{0}>…</{0}>", attribute.name));
      continue;
    }
    if (open_) continue;
    diagnostics_.Add(attribute.location,
                     fmt::format("<{}> has no attribute {}; allowed: {}{}", tree_.Name(), Quoted(attribute.name),
                                 Listed(ParameterNames()), DidYouMean(attribute.name, ParameterNames())));
  }
}

void ElementReader::CheckChildren()
{
  const auto& children = tree_.Node()->children;
  for (const auto& child : children)
  {
    if (const ElementSpec* element = spec_.FindChild(child->name))
    {
      if (element->repeatable) continue;
      const auto first = std::find_if(children.begin(), children.end(),
                                      [&](const auto& other) { return element->HasTag(other->name); });
      if (*first == child) continue;
      diagnostics_.Add(child->location, fmt::format("<{}> holds a second <{}>; the first is in line {}", tree_.Name(),
                                                    child->name, (*first)->location.line));
      continue;
    }
    if (const ParameterSpec* parameter = Find(child->name))
    {
      CheckParameterElement(*child, *parameter);
      continue;
    }
    if (spec_.plugins || open_ || diagnostics_.IsLost(child->name)) continue;
    diagnostics_.Add(child->location, fmt::format("<{}> has no element <{}>; allowed: {}{}", tree_.Name(), child->name,
                                                  Listed(ChildNames()), DidYouMean(child->name, ChildNames())));
  }
}

void ElementReader::CheckParameterElement(const ConfigurationNode& child, const ParameterSpec& parameter)
{
  const auto& children = tree_.Node()->children;
  const auto first =
      std::find_if(children.begin(), children.end(), [&](const auto& other) { return other->name == child.name; });
  if (first->get() != &child)
  {
    diagnostics_.Add(child.location, fmt::format("<{}> gives {} a second time; the first is in line {}", tree_.Name(),
                                                 Quoted(child.name), (*first)->location.line));
    return;
  }
  if (tree_.HasAttribute(child.name))
  {
    diagnostics_.Add(child.location, fmt::format("<{}> gives {} both as an attribute and as an element; keep one",
                                                 tree_.Name(), Quoted(child.name)));
  }
  if (parameter.type == ParameterType::kTree) return;
  if (!child.attributes.empty() || !child.children.empty())
  {
    const SourceLocation& place =
        child.attributes.empty() ? child.children.front()->location : child.attributes.front().location;
    diagnostics_.Add(place, fmt::format("<{}> holds a value only: {}", child.name, AllowedText(parameter)));
  }
}

void ElementReader::CheckValues(const std::vector<ParameterSpec>& parameters)
{
  const auto check =
      [&](const ParameterSpec& parameter, const std::string& name, std::string_view value, const SourceLocation& place)
  {
    std::string mistake = MistakeIn(parameter, value, "'" + name + "' of <" + tree_.Name() + ">");
    if (mistake.empty()) return;
    wrong_.push_back(&parameter);
    diagnostics_.Add(place, std::move(mistake));
  };
  for (const ParameterSpec& parameter : parameters)
  {
    const bool ours_too = &parameters != &spec_.parameters && Find(parameter.name) != &parameter;
    if (parameter.type == ParameterType::kTree || ours_too) continue;
    if (IsNumbered(parameter))
    {
      for (const auto& attribute : tree_.Node()->attributes)
      {
        if (Matches(parameter, attribute.name)) check(parameter, attribute.name, attribute.value, attribute.location);
      }
      for (const auto& child : tree_.Node()->children)
      {
        if (Matches(parameter, child->name)) check(parameter, child->name, child->text, child->location);
      }
    }
    else if (const auto value = tree_.Value(parameter.name))
    {
      check(parameter, parameter.name, *value, tree_.ValueLocation(parameter.name));
    }
    else if (!parameter.default_value)
    {
      diagnostics_.Add(tree_.Location(),
                       fmt::format("<{}> lacks '{}': {}", tree_.Name(), parameter.name, AllowedText(parameter)));
    }
  }
}

void ElementReader::CheckRequiredChildren()
{
  for (const ElementSpec& child : spec_.children)
  {
    if (!child.required) continue;
    const auto& children = tree_.Node()->children;
    const bool found =
        std::any_of(children.begin(), children.end(), [&](const auto& one) { return child.HasTag(one->name); });
    if (!found) diagnostics_.Add(tree_.Location(), fmt::format("<{}> lacks <{}>", tree_.Name(), child.Name()));
  }
}

bool ElementReader::IsGood(std::string_view name) const
{
  return IsGiven(name) && std::find(wrong_.begin(), wrong_.end(), Find(name)) == wrong_.end();
}

std::string ElementReader::ValueOf(std::string_view name) const
{
  if (IsGood(name)) return *tree_.Value(name);
  const ParameterSpec* parameter = Find(name);
  return parameter != nullptr ? parameter->default_value.value_or("") : std::string();
}

std::string ElementReader::Text(std::string_view name) const { return std::string(TrimBlanks(ValueOf(name))); }

double ElementReader::Number(std::string_view name) const { return ParseNumber(ValueOf(name)).value_or(0); }

long long ElementReader::Integer(std::string_view name) const { return ParseInteger(ValueOf(name)).value_or(0); }

bool ElementReader::Boolean(std::string_view name) const { return ParseBoolean(ValueOf(name)).value_or(false); }

Vector3 ElementReader::Vector(std::string_view name) const
{
  const auto numbers = ParseNumbers(ValueOf(name)).value_or(std::vector<double>{});
  Vector3 vector = Vector3::Zero();
  for (std::size_t i = 0; i < std::min<std::size_t>(numbers.size(), 3); ++i)
  {
    vector[static_cast<Eigen::Index>(i)] = numbers[i];
  }
  return vector;
}

std::uint32_t ElementReader::Colour(std::string_view name) const { return ParseColour(ValueOf(name)).value_or(0); }

}  // namespace swarmanoid
