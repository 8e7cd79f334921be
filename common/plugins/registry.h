// Registries of plug-ins, one per interface. The REGISTER_... macros add a user's plug-in, with its description, when
// its library is loaded. The simulator's own plug-ins are described in every process (common/plugin_descriptions); the
// role that runs them binds their code (RegisterBuiltin...). Registries are filled before roles start, and are
// read-only afterwards.
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

// The registry has all plug-ins of one interface, by (label, implementation). Their descriptions are in the
// PluginCatalogue too.
template <class Interface>
class PluginRegistry
{
public:
  using Factory = std::function<std::unique_ptr<Interface>()>;
  struct Entry
  {
    const PluginDescription& description;  // owned by the catalogue
    Factory create;
  };

  explicit PluginRegistry(PluginKind kind) : kind_(kind) {}

  static PluginRegistry& Instance();

  // Adds a plug-in. A second one of the same name is handled as in PluginCatalogue::Add.
  void Add(const PluginDescription& description, Factory create)
  {
    if (PluginCatalogue::Instance().Add(kind_, description))
      Bind(description.label, description.implementation, std::move(create));
  }
  // Binds code to a described plug-in. Throws std::logic_error if it is not described or already has code.
  void Bind(const std::string& label, const std::string& implementation, Factory create)
  {
    const PluginDescription* description = PluginCatalogue::Instance().Find(kind_, label, implementation);
    if (description == nullptr)
      throw std::logic_error(NameOfPlugin(kind_, label, implementation) + " is not described");
    if (!entries_.emplace(std::pair{label, implementation}, Entry{*description, std::move(create)}).second)
      throw std::logic_error(NameOfPlugin(kind_, label, implementation) + " has code already");
  }
  // Throws std::logic_error if a plug-in is described but has no code.
  void RequireCode() const
  {
    for (const PluginDescription* description : PluginCatalogue::Instance().Of(kind_))
      if (Find(description->label, description->implementation) == nullptr)
        throw std::logic_error(NameOfPlugin(kind_, description->label, description->implementation) + " has no code");
  }

  // Returns nullptr if it does not exist.
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
