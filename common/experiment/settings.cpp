// A path has steps. Each step is the tag or the id of an element, or a tag with an id or number. The last one may be an
// attribute. Find takes the only child that fits, and refuses a step that fits several. The old tree stays as it is: a
// change copies the nodes on the path, and both trees share all others.
//
// Invariant: all spellings of a path have the same address, so that two settings of one value are recognised.
#include "common/experiment/settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"
#include "common/configuration/xml_writer.h"
#include "common/experiment/schema.h"

namespace swarmanoid
{
namespace
{

using Node = std::shared_ptr<const ConfigurationNode>;

// One step of a path: "tag", "id", "tag[id]" or "tag[number]".
struct Step
{
  std::string name;
  std::string key;
};

std::string IdOf(const ConfigurationNode& node)
{
  return TConfigurationTree(Node(Node(), &node)).Value("id").value_or("");
}

// Returns whether a file can hold the element.
bool CanBeWritten(const ConfigurationNode& element)
{
  try
  {
    const Node read = ReadXml(WriteXml(element), "");
    return read->name == element.name && read->attributes.empty() && read->text == element.text;
  }
  catch (const ConfigurationError&)
  {
    return false;
  }
}

class Setting
{
public:
  Setting(const std::string& path, const std::string& value)
      : path_(path), value_(value), place_{std::make_shared<const std::string>("--set " + path), 0, 0}
  {
    Split();
  }

  Node ApplyTo(const Node& root) const { return Apply(root, 0); }

  // Returns each step as tag and number among the elements of that tag. A missing value gets the number that it would
  // have.
  std::string AddressIn(const Node& root) const
  {
    std::string address;
    Node node = root;
    for (const Step& step : steps_)
    {
      const std::ptrdiff_t child = Find(*node, step);
      auto missing = std::make_shared<ConfigurationNode>();
      missing->name = step.name;
      const Node found = child < 0 ? missing : node->children[static_cast<std::size_t>(child)];
      const bool is_value = &step == &steps_.back() && step.key.empty();
      if (child < 0 && !is_value && !IsAddedOnTheWay(step)) FailToFind(*node, step);
      std::size_t number = 0;
      for (std::ptrdiff_t i = 0; i < child; ++i)
        if (node->children[static_cast<std::size_t>(i)]->name == found->name) ++number;
      address += fmt::format("/{}[{}]", found->name, number);
      node = found;
    }
    return address;
  }

  void CheckValue() const
  {
    ConfigurationNode element;
    element.name = "value";
    element.text = TrimBlanks(value_);
    if (!CanBeWritten(element))
      Fail(fmt::format("{} holds bytes that are not UTF-8 text, or control characters", Quoted(value_)));
  }

private:
  [[noreturn]] void Fail(const std::string& message) const { throw ConfigurationError(place_, message); }

  void Split()
  {
    std::size_t at = 0;
    while (at <= path_.size())
    {
      Step step;
      const std::size_t end = std::min(path_.find_first_of(".[", at), path_.size());
      step.name = path_.substr(at, end - at);
      at = end;
      if (at < path_.size() && path_[at] == '[')
      {
        const std::size_t close = path_.find(']', at);
        if (close == std::string::npos) Fail("a '[' without ']'");
        step.key = path_.substr(at + 1, close - at - 1);
        if (step.key.empty()) Fail("nothing stands between '[' and ']'; write an id or a number");
        at = close + 1;
        if (at < path_.size() && path_[at] != '.') Fail("a '.' must follow ']'");
      }
      if (step.name.empty()) Fail("the path has an empty step; write for example framework.maxclock=100");
      steps_.push_back(std::move(step));
      ++at;
    }
    if (!path_.empty() && path_.back() == '.') Fail("the path ends in '.'");
  }

  bool Fits(const ConfigurationNode& child, const Step& step) const
  {
    if (step.key.empty()) return child.name == step.name || IdOf(child) == step.name;
    return child.name == step.name && IdOf(child) == step.key;
  }

  // Returns the index of the child that a step means, or -1.
  std::ptrdiff_t Find(const ConfigurationNode& node, const Step& step) const
  {
    std::vector<std::ptrdiff_t> fitting;
    std::vector<std::ptrdiff_t> of_that_tag;
    for (std::size_t i = 0; i < node.children.size(); ++i)
    {
      if (Fits(*node.children[i], step)) fitting.push_back(static_cast<std::ptrdiff_t>(i));
      if (node.children[i]->name == step.name) of_that_tag.push_back(static_cast<std::ptrdiff_t>(i));
    }
    if (fitting.size() > 1)
    {
      Fail(fmt::format("{} elements of <{}> fit {}; write tag[id] or, for those without an id, tag[0], tag[1] …",
                       fitting.size(), node.name, Quoted(step.name)));
    }
    if (!fitting.empty()) return fitting.front();
    const auto number = step.key.empty() ? std::nullopt : ParseInteger(step.key);
    if (number && *number >= 0 && *number < static_cast<long long>(of_that_tag.size()))
    {
      return of_that_tag[static_cast<std::size_t>(*number)];
    }
    return -1;
  }

  std::vector<std::string> NamesWithin(const ConfigurationNode& node) const
  {
    std::vector<std::string> names;
    const auto add = [&](std::string name)
    {
      if (names.size() < 20 && std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(std::move(name));
    };
    for (const auto& child : node.children)
    {
      const std::string id = IdOf(*child);
      add(id.empty() ? child->name : id);
    }
    for (const auto& attribute : node.attributes) add(attribute.name);
    return names;
  }

  Node Apply(const Node& node, std::size_t depth) const
  {
    const Step& step = steps_[depth];
    const bool last = depth + 1 == steps_.size();
    auto changed = std::make_shared<ConfigurationNode>(*node);
    const std::ptrdiff_t child = Find(*node, step);
    if (child >= 0)
    {
      auto& slot = changed->children[static_cast<std::size_t>(child)];
      slot = last ? WithText(*slot) : Apply(slot, depth + 1);
      return changed;
    }
    if (last && step.key.empty())
    {
      SetOwnValue(*changed, step.name);
      return changed;
    }
    if (IsAddedOnTheWay(step))
    {
      auto added = std::make_shared<ConfigurationNode>();
      added->name = step.name;
      added->location = place_;
      changed->children.push_back(Apply(added, depth + 1));
      return changed;
    }
    FailToFind(*node, step);
  }

  // Returns whether a missing element, which is not the last of the path, is added together with the rest of the path.
  bool IsAddedOnTheWay(const Step& step) const
  {
    const bool is_section = &step == &steps_.front() && ExperimentSchema().FindChild(step.name) != nullptr;
    return step.key.empty() && (is_section || step.name == "parameters");
  }

  [[noreturn]] void FailToFind(const ConfigurationNode& node, const Step& step) const
  {
    const std::string wanted = step.key.empty() ? step.name : step.name + "[" + step.key + "]";
    const auto names = NamesWithin(node);
    Fail(fmt::format("<{}> holds no {}; it holds: {}{}", node.name, Quoted(wanted), Listed(names),
                     DidYouMean(step.key.empty() ? step.name : step.key, names)));
  }

  Node WithText(const ConfigurationNode& node) const
  {
    if (!node.children.empty())
    {
      Fail(
          fmt::format("<{}> holds elements, not a value; go on with one of: {}", node.name, Listed(NamesWithin(node))));
    }
    auto changed = std::make_shared<ConfigurationNode>(node);
    changed->text = TrimBlanks(value_);
    changed->location = place_;
    return changed;
  }

  void SetOwnValue(ConfigurationNode& node, const std::string& name) const
  {
    for (auto& attribute : node.attributes)
    {
      if (attribute.name != name) continue;
      attribute.value = value_;
      attribute.location = place_;
      return;
    }
    auto added = std::make_shared<ConfigurationNode>();
    added->name = name;
    if (!CanBeWritten(*added)) Fail(fmt::format("{} is no name of a parameter", Quoted(name)));
    added->text = TrimBlanks(value_);
    added->location = place_;
    node.children.push_back(std::move(added));
  }

  std::string path_;
  std::string value_;
  SourceLocation place_;
  std::vector<Step> steps_;
};

}  // namespace

Node WithSetting(const Node& root, const std::string& path, const std::string& value)
{
  return Setting(path, value).ApplyTo(root);
}

std::string SettingAddress(const Node& root, const std::string& path) { return Setting(path, "").AddressIn(root); }

void CheckSettingValue(const std::string& path, const std::string& value) { Setting(path, value).CheckValue(); }

}  // namespace swarmanoid
