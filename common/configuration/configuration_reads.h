// ConfigurationReads: what has been asked of a configuration tree, so that what nobody asked for can be named. The
// handles that TConfigurationTree::RecordedIn yields, and those made from them, share it and may be used from several
// threads. The recorded nodes must outlive it.
#pragma once

#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "common/configuration/configuration_tree.h"

namespace swarmanoid
{

class ConfigurationReads
{
public:
  // For TConfigurationTree.
  void AskFor(const ConfigurationNode& node, std::string_view name);  // an attribute or a child element
  void ReadText(const ConfigurationNode& node);
  void ReadChildren(const ConfigurationNode& node);  // the list of them; each has still to be read itself
  void ReadAll(const ConfigurationNode& node);       // with all that it holds

  // An attribute, an element or a text that nobody asked for.
  struct Unread
  {
    const ConfigurationNode* holder = nullptr;  // the element that it stands in
    std::string name;                           // empty: the text of the holder
    SourceLocation location;
    std::vector<std::string> asked;  // what the holder was asked for instead, in alphabetical order
  };
  // In the order of the file, attributes first; of an element that nobody asked for, not what it holds.
  std::vector<Unread> UnreadIn(const ConfigurationNode& root) const;

private:
  struct Asked
  {
    std::set<std::string, std::less<>> names;
    bool text = false;
    bool children = false;
    bool all = false;
  };

  void Visit(const ConfigurationNode& node, std::vector<Unread>& unread) const;

  mutable std::mutex mutex_;
  std::unordered_map<const ConfigurationNode*, Asked> asked_;
};

}  // namespace swarmanoid
