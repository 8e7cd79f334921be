#include "common/configuration/configuration_reads.h"

namespace swarmanoid
{

void ConfigurationReads::AskFor(const ConfigurationNode& node, std::string_view name)
{
  const std::lock_guard lock(mutex_);
  asked_[&node].names.emplace(name);
}

void ConfigurationReads::ReadText(const ConfigurationNode& node)
{
  const std::lock_guard lock(mutex_);
  asked_[&node].text = true;
}

void ConfigurationReads::ReadChildren(const ConfigurationNode& node)
{
  const std::lock_guard lock(mutex_);
  asked_[&node].children = true;
}

void ConfigurationReads::ReadAll(const ConfigurationNode& node)
{
  const std::lock_guard lock(mutex_);
  asked_[&node].all = true;
}

std::vector<ConfigurationReads::Unread> ConfigurationReads::UnreadIn(const ConfigurationNode& root) const
{
  const std::lock_guard lock(mutex_);
  std::vector<Unread> unread;
  const auto asked = asked_.find(&root);
  const bool text_read = asked != asked_.end() && (asked->second.text || asked->second.all);
  if (!root.text.empty() && !text_read) unread.push_back({&root, {}, root.location, {}});
  Visit(root, unread);
  return unread;
}

void ConfigurationReads::Visit(const ConfigurationNode& node, std::vector<Unread>& unread) const
{
  static const Asked kNothing;
  const auto found = asked_.find(&node);
  const Asked& asked = found == asked_.end() ? kNothing : found->second;
  if (asked.all) return;
  const std::vector<std::string> names(asked.names.begin(), asked.names.end());

  for (const auto& attribute : node.attributes)
    if (!asked.names.contains(attribute.name)) unread.push_back({&node, attribute.name, attribute.location, names});

  std::set<std::string_view> seen;
  for (const auto& child : node.children)
  {
    // A look-up by name finds only the first of several elements.
    const bool first = seen.insert(child->name).second;
    const bool reached = asked.children || (first && asked.names.contains(child->name));
    const auto reads = asked_.find(child.get());
    const bool text_read = reads != asked_.end() && (reads->second.text || reads->second.all);
    if (!reached || (!child->text.empty() && !text_read))
      unread.push_back({&node, child->name, child->location, names});
    else
      Visit(*child, unread);
  }
}

}  // namespace swarmanoid
