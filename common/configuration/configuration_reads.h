// ConfigurationReads: records which parts of a configuration tree were read, so that unused parts can be reported. The
// handles that TConfigurationTree::RecordedIn returns, and those made from them, share the record and may be used from
// several threads. The recorded nodes must outlive it.
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
  // TConfigurationTree calls it. `name`: an attribute or a child element.
  void AskFor(const ConfigurationNode& node, std::string_view name);  // an attribute or a child element
  void ReadText(const ConfigurationNode& node);
  void ReadChildren(const ConfigurationNode& node);  // the list of the children; each child has still to be read
  void ReadAll(const ConfigurationNode& node);       // the node with all its content

  // An attribute, an element or a text that no code has read.
  struct Unread
  {
    const ConfigurationNode* holder = nullptr;  // the element that contains it
    std::string name;                           // empty: the text of the holder
    SourceLocation location;
    std::vector<std::string> asked;  // the names that were read in the holder instead, in alphabetical order
  };
  // Returns the unread parts in the order of the file, attributes first. The content of an unread element is not
  // listed.
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

  mutable std::mutex mutex_;  // guards asked_
  std::unordered_map<const ConfigurationNode*, Asked> asked_;
};

}  // namespace swarmanoid
