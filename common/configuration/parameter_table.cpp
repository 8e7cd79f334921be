#include "common/configuration/parameter_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <string_view>

#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

using Mistakes = std::vector<ConfigurationError>;

const ParameterSpec* Find(const std::vector<ParameterSpec>& specs, std::string_view name)
{
  const auto found = std::ranges::find_if(specs, [&](const ParameterSpec& spec) { return Matches(spec, name); });
  return found == specs.end() ? nullptr : &*found;
}

std::vector<std::string> NamesOf(const std::vector<ParameterSpec>& specs)
{
  std::vector<std::string> names;
  for (const ParameterSpec& spec : specs) names.push_back(spec.name);
  return names;
}

class TableCheck
{
public:
  TableCheck(const TConfigurationTree& tree, const std::vector<ParameterSpec>& specs, const std::string& owner,
             const std::vector<std::string>& others)
      : node_(*tree.Node()), specs_(specs), owner_(owner), others_(others)
  {
  }

  Mistakes All()
  {
    if (!node_.text.empty())
      Add(node_.location,
          fmt::format("<{}> holds the text {}, where only elements are allowed", node_.name, Quoted(node_.text)));
    for (const auto& attribute : node_.attributes) CheckAttribute(attribute);
    for (const auto& child : node_.children) CheckElement(*child);
    for (const ParameterSpec& spec : specs_)
      if (!spec.default_value && !IsNumbered(spec) && !lines_.contains(spec.name))
        Add(node_.location, fmt::format("the {} lacks the parameter '{}': {}", owner_, spec.name, AllowedText(spec)));
    return std::move(mistakes_);
  }

private:
  void Add(const SourceLocation& place, const std::string& message) { mistakes_.emplace_back(place, message); }

  // Returns the parameter of that name. Reports an unknown name, and a name that occurs twice.
  const ParameterSpec* SpecOf(const std::string& name, const SourceLocation& place)
  {
    if (std::ranges::find(others_, name) != others_.end()) return nullptr;
    const ParameterSpec* spec = Find(specs_, name);
    if (spec == nullptr)
    {
      const std::vector<std::string> names = NamesOf(specs_);
      Add(place, fmt::format("the {} has no parameter {}; it has: {}{}", owner_, Quoted(name), Listed(names),
                             DidYouMean(name, names)));
      return nullptr;
    }
    const auto [first, is_first] = lines_.emplace(name, place.Text());
    if (is_first) return spec;
    Add(place, fmt::format("'{}' of the {} is given a second time; the first is {}", name, owner_, first->second));
    return nullptr;
  }

  void CheckValue(const ParameterSpec& spec, const std::string& name, const std::string& value,
                  const SourceLocation& place)
  {
    const std::string mistake = MistakeIn(spec, value, fmt::format("'{}' of the {}", name, owner_));
    if (!mistake.empty()) Add(place, mistake);
  }

  void CheckAttribute(const ConfigurationNode::Attribute& attribute)
  {
    const ParameterSpec* spec = SpecOf(attribute.name, attribute.location);
    if (spec == nullptr) return;
    if (spec->type == ParameterType::kTree)
      Add(attribute.location, fmt::format("'{0}' must be written as an element, <{0}>…</{0}>", attribute.name));
    else
      CheckValue(*spec, attribute.name, attribute.value, attribute.location);
  }

  void CheckElement(const ConfigurationNode& child)
  {
    const ParameterSpec* spec = SpecOf(child.name, child.location);
    if (spec == nullptr || spec->type == ParameterType::kTree) return;
    if (child.attributes.empty() && child.children.empty())
      return CheckValue(*spec, child.name, child.text, child.location);
    const SourceLocation& place =
        child.attributes.empty() ? child.children.front()->location : child.attributes.front().location;
    Add(place, fmt::format("<{}> holds a value only: {}", child.name, AllowedText(*spec)));
  }

  const ConfigurationNode& node_;
  const std::vector<ParameterSpec>& specs_;
  const std::string& owner_;
  const std::vector<std::string>& others_;
  Mistakes mistakes_;
  std::map<std::string, std::string> lines_;  // the position of each parameter in the file
};

std::string Absolute(const std::string& path, const std::string& folder)
{
  const std::string trimmed(TrimBlanks(path));
  if (trimmed.empty()) return trimmed;
  return (std::filesystem::path(folder) / trimmed).lexically_normal().string();
}

// Returns whether the default is a value of the parameter's type.
bool IsValue(const ParameterSpec& spec)
{
  if (!spec.default_value || spec.type == ParameterType::kTree || IsNumbered(spec)) return false;
  return !spec.default_value->empty() || spec.type == ParameterType::kText || spec.type == ParameterType::kPath;
}

bool IsName(std::string_view name)
{
  const auto fits = [](char c)
  { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.'; };
  return !name.empty() && std::ranges::all_of(name, fits) &&
         (std::isalpha(static_cast<unsigned char>(name.front())) != 0 || name.front() == '_');
}

}  // namespace

Mistakes MistakesIn(const TConfigurationTree& tree, const std::vector<ParameterSpec>& specs, const std::string& owner,
                    const std::vector<std::string>& others)
{
  return tree.Exists() ? TableCheck(tree, specs, owner, others).All() : Mistakes();
}

TConfigurationTree OrEmpty(const TConfigurationTree& tree, const std::string& name, const SourceLocation& place)
{
  if (tree.Exists()) return tree;
  auto empty = std::make_shared<ConfigurationNode>();
  empty->name = name;
  empty->location = place;
  return TConfigurationTree(std::move(empty));
}

TConfigurationTree WithDefaults(const TConfigurationTree& tree, const std::vector<ParameterSpec>& specs,
                                const std::string& folder)
{
  auto filled = std::make_shared<ConfigurationNode>(*tree.Node());
  for (auto& attribute : filled->attributes)
  {
    const ParameterSpec* spec = Find(specs, attribute.name);
    if (spec != nullptr && spec->type == ParameterType::kPath) attribute.value = Absolute(attribute.value, folder);
  }
  for (auto& child : filled->children)
  {
    const ParameterSpec* spec = Find(specs, child->name);
    if (spec == nullptr || spec->type != ParameterType::kPath) continue;
    auto with_path = std::make_shared<ConfigurationNode>(*child);
    with_path->text = Absolute(child->text, folder);
    child = std::move(with_path);
  }
  for (const ParameterSpec& spec : specs)
  {
    if (!IsValue(spec) || tree.Value(spec.name)) continue;
    auto added = std::make_shared<ConfigurationNode>();
    added->name = spec.name;
    added->text = spec.type == ParameterType::kPath ? Absolute(*spec.default_value, folder) : *spec.default_value;
    added->location = tree.Location();
    filled->children.push_back(std::move(added));
  }
  return TConfigurationTree(std::move(filled));
}

std::vector<ParameterSpec> Joined(std::vector<ParameterSpec> own, const std::vector<ParameterSpec>& more)
{
  own.insert(own.end(), more.begin(), more.end());
  return own;
}

std::string MistakeInTable(const std::vector<ParameterSpec>& specs)
{
  for (const ParameterSpec& spec : specs)
  {
    const std::string subject = "its parameter '" + spec.name + "'";
    if (!IsName(spec.name)) return subject + " has a name that cannot stand in a file";
    if (std::ranges::count(specs, spec.name, &ParameterSpec::name) > 1) return subject + " is declared twice";
    if (spec.type == ParameterType::kChoice && spec.choices.empty()) return subject + " has no choices";
    if (spec.minimum > spec.maximum)
      return fmt::format("{} has the least value {} and the largest {}", subject, spec.minimum, spec.maximum);
    if (!spec.default_value || spec.default_value->empty()) continue;
    const std::string mistake = MistakeIn(spec, *spec.default_value, "the default of " + subject);
    if (!mistake.empty()) return mistake;
  }
  return {};
}

}  // namespace swarmanoid
