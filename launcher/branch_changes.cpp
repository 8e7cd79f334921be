#include "launcher/branch_changes.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"
#include "common/program/usage_error.h"

namespace swarmanoid
{
namespace
{

using Node = ConfigurationNode;

std::string AttributeOf(const Node& node, const std::string& name)
{
  for (const Node::Attribute& attribute : node.attributes)
    if (attribute.name == name) return attribute.value;
  return {};
}

// The position of a change: the tags from the section down, and its name for --set.
struct TreePath
{
  std::vector<std::string> tags;
  std::string path;

  TreePath Below(const std::string& tag, const std::string& name) const
  {
    TreePath below = *this;
    below.tags.push_back(tag);
    below.path += (path.empty() ? "" : ".") + name;
    return below;
  }
  TreePath Below(const Node& node) const
  {
    const std::string id = AttributeOf(node, "id");
    return Below(node.name, id.empty() ? node.name : id);
  }
  std::string Tag(std::size_t depth) const { return depth < tags.size() ? tags[depth] : std::string(); }
};

// Returns why a value must not change once a run has begun; empty if it may. `whole`: an element was added or removed.
std::string ReasonAgainst(const TreePath& at, bool whole)
{
  const std::string section = at.Tag(0), last = at.tags.back();
  if (section == "visualisations") return {};
  if (section == "framework")
  {
    for (const char* free : {"maxclock", "seed", "name", "folder"})
      if (at.Tag(1) == free) return {};
    return "it is the same for a whole run";
  }
  if (section == "controllers")
  {
    if (at.Tag(2) == "parameters") return {};
    const bool device = at.Tag(2) == "sensors" || at.Tag(2) == "actuators";
    if (device && at.tags.size() > 4 && last != "implementation") return {};
    if (device) return "the robots were built with these devices, which have saved what they remember";
    return "which code steps the robots, and how it may fail, is the same for a whole run";
  }
  if (section == "engines") return whole && at.tags.size() <= 2 ? "what an engine remembers is of that engine" : "";
  if (section == "experiment_functions")
    return at.tags.size() > 2 && last != "library" ? "" : "what functions remember is of their code";
  if (section == "arena")
    return "what stands in the arena is part of the state; move, add or remove it by `swarmanoid control` while the "
           "branch runs";
  return "it is the same for a whole run";
}

class Comparison
{
public:
  std::vector<BranchChange> changes;

  void Compare(const Node& before, const Node& after, const TreePath& at)
  {
    if (before.text != after.text) Note(at, fmt::format("{} instead of {}", Shown(after.text), Shown(before.text)));
    for (const Node::Attribute& attribute : before.attributes)
      CompareValues(attribute.value, AttributeOf(after, attribute.name), at.Below(attribute.name, attribute.name));
    for (const Node::Attribute& attribute : after.attributes)
      if (AttributeOf(before, attribute.name).empty())
        CompareValues({}, attribute.value, at.Below(attribute.name, attribute.name));
    CompareChildren(before, after, at);
  }

private:
  static std::string Shown(const std::string& text) { return text.empty() ? "nothing" : text; }

  void CompareValues(const std::string& before, const std::string& after, const TreePath& at)
  {
    if (before != after) Note(at, fmt::format("{} instead of {}", Shown(after), Shown(before)));
  }

  // Compares elements with the same tag and id, in their order.
  void CompareChildren(const Node& before, const Node& after, const TreePath& at)
  {
    std::vector<const Node*> left;
    for (const auto& node : after.children) left.push_back(node.get());
    for (const auto& node : before.children)
    {
      const auto same =
          std::find_if(left.begin(), left.end(),
                       [&](const Node* other)
                       { return other->name == node->name && AttributeOf(*other, "id") == AttributeOf(*node, "id"); });
      if (same == left.end())
      {
        Note(at.Below(*node), "left out", true);
        continue;
      }
      Compare(*node, **same, at.Below(*node));
      left.erase(same);
    }
    for (const Node* node : left) Note(at.Below(*node), "new", true);
  }

  void Note(const TreePath& at, const std::string& value, bool whole = false)
  {
    if (const std::string reason = ReasonAgainst(at, whole); !reason.empty())
      throw UsageError(
          fmt::format("--branch: {} cannot change in the middle of a run ({}): {}", at.path, value, reason));
    const bool outside = at.Tag(0) == "visualisations" || (at.Tag(0) == "framework" && at.Tag(1) != "seed");
    changes.push_back({at.path, value, !outside});
  }
};

// Another seed may have moved entities that cannot move during a run. The saved state does not have their poses.
void RequireSameBodies(const Experiment& before, const Experiment& after)
{
  const auto refuse = [](const std::string& id)
  {
    throw UsageError(
        fmt::format("--branch: with these changes {} is another one, and what cannot move is the same for a whole run; "
                    "keep the seed",
                    Quoted(id)));
  };
  if (before.entities.size() != after.entities.size())
    refuse(before.entities.size() > after.entities.size() ? before.entities[after.entities.size()].id
                                                          : after.entities[before.entities.size()].id);
  for (std::size_t k = 0; k < before.entities.size(); ++k)
  {
    const EntityConfiguration& a = before.entities[k];
    const EntityConfiguration& b = after.entities[k];
    const bool same_place =
        a.movable || (a.pose.position == b.pose.position && a.pose.orientation.coeffs() == b.pose.orientation.coeffs());
    if (a.id != b.id || a.kind != b.kind || a.movable != b.movable || a.size != b.size || a.mass_kg != b.mass_kg ||
        !same_place)
      refuse(b.id);
  }
}

}  // namespace

std::vector<BranchChange> ChangesBetween(const Experiment& before, const Experiment& after)
{
  Comparison comparison;
  comparison.Compare(*ReadXml(before.effective_xml, "before"), *ReadXml(after.effective_xml, "after"), {});
  RequireSameBodies(before, after);
  return std::move(comparison.changes);
}

}  // namespace swarmanoid
