// Registries of plug-ins: one per interface. Built-in plug-ins are added by explicit functions (RegisterBuiltin...),
// a user's by the REGISTER_... macros when the library is loaded. Filled before roles start, read-only afterwards.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/configuration/parameter.h"

namespace swarmanoid
{

// What `swarmanoid list plugins` and the reference pages show of a plug-in.
struct PluginDescription
{
  std::string label;           // the XML tag: type of device, engine, renderer or controller
  std::string implementation;  // devices only: the text of <implementation>
  std::string brief;           // one line
  std::vector<ParameterSpec> parameters;
  std::vector<std::string> robots;  // devices only: the robot tags that can carry it
  // Specific devices only: the channel of values between host and engine, and its doubles per robot. Empty: generic.
  std::string channel;
  int channel_width = 0;
  // Engines only: the channels and the entity tags that it can serve.
  std::vector<std::string> channels;
  std::vector<std::string> entity_tags;
};

// All plug-ins of one interface, by (label, implementation).
template <class Interface>
class PluginRegistry
{
public:
  using Factory = std::function<std::unique_ptr<Interface>()>;
  struct Entry
  {
    PluginDescription description;
    Factory create;
  };

  static PluginRegistry& Instance();

  // Throws std::invalid_argument for a second plug-in of the same name.
  void Add(PluginDescription description, Factory create)
  {
    std::pair<std::string, std::string> key{description.label, description.implementation};
    if (entries_.contains(key)) throw std::invalid_argument("two plug-ins are registered as '" + key.first + "' " + key.second);
    entries_.emplace(std::move(key), Entry{std::move(description), std::move(create)});
  }

  // nullptr where there is none.
  const Entry* Find(const std::string& label, const std::string& implementation = "") const
  {
    const auto found = entries_.find({label, implementation});
    return found == entries_.end() ? nullptr : &found->second;
  }

  const std::map<std::pair<std::string, std::string>, Entry>& Entries() const { return entries_; }

private:
  std::map<std::pair<std::string, std::string>, Entry> entries_;
};

}  // namespace swarmanoid
