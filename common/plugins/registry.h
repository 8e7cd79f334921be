// Registries of plug-ins: one per interface. Built-in plug-ins are added by explicit functions (RegisterBuiltin...),
// a user's by the REGISTER_... macros when the library is loaded. Filled before roles start, read-only afterwards.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "common/plugins/catalogue.h"

namespace swarmanoid
{

// All plug-ins of one interface, by (label, implementation). Their descriptions are in the PluginCatalogue too.
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

  explicit PluginRegistry(PluginKind kind) : kind_(kind) {}

  static PluginRegistry& Instance();

  // A second plug-in of the same name: see PluginCatalogue::Add.
  void Add(PluginDescription description, Factory create)
  {
    if (!PluginCatalogue::Instance().Add(kind_, description)) return;
    std::pair<std::string, std::string> key{description.label, description.implementation};
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
  PluginKind kind_;
  std::map<std::pair<std::string, std::string>, Entry> entries_;
};

}  // namespace swarmanoid
