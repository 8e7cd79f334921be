// Registries of plug-ins: one per interface. A user's plug-in is added, with its description, by the REGISTER_...
// macros when its library is loaded. The simulator's own are described in every process (common/plugin_descriptions);
// the role that runs them binds their code to that (RegisterBuiltin...). Filled before roles start, read-only
// afterwards.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
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
    const PluginDescription& description;  // the catalogue's
    Factory create;
  };

  explicit PluginRegistry(PluginKind kind) : kind_(kind) {}

  static PluginRegistry& Instance();

  // A second plug-in of the same name: see PluginCatalogue::Add.
  void Add(const PluginDescription& description, Factory create)
  {
    if (PluginCatalogue::Instance().Add(kind_, description))
      Bind(description.label, description.implementation, std::move(create));
  }
  // The code of a plug-in that is described already. Throws std::logic_error for one that is not, or has code.
  void Bind(const std::string& label, const std::string& implementation, Factory create)
  {
    const PluginDescription* description = PluginCatalogue::Instance().Find(kind_, label, implementation);
    if (description == nullptr)
      throw std::logic_error(NameOfPlugin(kind_, label, implementation) + " is not described");
    if (!entries_.emplace(std::pair{label, implementation}, Entry{*description, std::move(create)}).second)
      throw std::logic_error(NameOfPlugin(kind_, label, implementation) + " has code already");
  }
  // Throws std::logic_error for a plug-in that is described and has no code.
  void RequireCode() const
  {
    for (const PluginDescription* description : PluginCatalogue::Instance().Of(kind_))
      if (Find(description->label, description->implementation) == nullptr)
        throw std::logic_error(NameOfPlugin(kind_, description->label, description->implementation) + " has no code");
  }

  // nullptr if there is none.
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
