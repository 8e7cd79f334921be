// PluginCatalogue: the descriptions of all registered plug-ins, of every interface. The reader of experiment files
// checks against it without knowing the interfaces themselves. Filled by PluginRegistry, before roles start; read-only
// afterwards.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "common/configuration/parameter.h"

namespace swarmanoid
{

struct EntityConfiguration;
struct CollisionBody;

enum class PluginKind
{
  kController,
  kActuator,
  kSensor,
  kEngine,
  kRenderer,
  kExperimentFunctions,
  kEntityKind
};

// "controller", "actuator", "sensor", "physics engine", "visualisation", "experiment functions",
// "entity kind".
std::string_view PluginKindName(PluginKind kind);
// "sensor 'footbot_light' (generic_footbot_light)"; without the parentheses where there is no implementation.
std::string NameOfPlugin(PluginKind kind, const std::string& label, const std::string& implementation);

// What `swarmanoid list plugins` and the reference pages show of a plug-in.
struct PluginDescription
{
  std::string label{};           // the XML tag: type of device, engine, renderer or controller
  std::string implementation{};  // devices only: the text of <implementation>
  std::string brief{};           // one line
  std::vector<ParameterSpec> parameters{};
  std::vector<std::string> robots{};  // devices only: the robot tags that can carry it; empty: all
  // Specific devices only: the channel of values between host and engine, and its doubles per robot. Empty: generic.
  std::string channel{};
  int channel_width = 0;
  // Engines only: the channels and the entity tags that it can serve.
  std::vector<std::string> channels{};
  std::vector<std::string> entity_tags{};
  bool any_kind = false;   // engines only: it also serves the kinds of users, by their rows alone
  bool can_split = false;  // engines only: its world may be cut into regions (CPhysicsEngine::MakeRegion)
  // Engines only: parameters and tags of entities that have no effect in it; `swarmanoid check` tells who gives them.
  std::vector<std::string> ignores{};
  // Engines only: the bodies that it collides, of an entity with its attributes as they are now (the values of its
  // slots), in the frame of the entity. Everybody who asks what is in the way goes by them: sensors, queries,
  // renderers. nullptr: the plain body of the kind.
  void (*collision_model)(const EntityConfiguration& entity, std::span<const double> attributes,
                          std::vector<CollisionBody>& bodies) = nullptr;
  // Controllers only: false if it was registered by its label alone. `parameters` says nothing then; what its Init
  // asks for decides.
  bool declares_parameters = true;
};

class PluginCatalogue
{
public:
  static PluginCatalogue& Instance();

  // False for a second plug-in of the same kind and name: the first one stays. While a library is being loaded the name
  // is kept as a problem of that library (throwing through dlopen would end the program), otherwise
  // std::invalid_argument is thrown. Likewise for a table of parameters that contradicts itself.
  bool Add(PluginKind kind, const PluginDescription& description);
  // Keeps what is wrong with a registration as a problem of the library that is being loaded; otherwise throws
  // std::invalid_argument.
  void Refuse(const std::string& problem);

  // nullptr if there is none.
  const PluginDescription* Find(PluginKind kind, const std::string& label,
                                const std::string& implementation = "") const;
  // In alphabetical order of label and implementation.
  std::vector<const PluginDescription*> Of(PluginKind kind) const;
  // The labels of a kind, each once, in alphabetical order.
  std::vector<std::string> Labels(PluginKind kind) const;
  // The implementations of a device type, in alphabetical order.
  std::vector<std::string> Implementations(PluginKind kind, const std::string& label) const;

  // What a library registered while it was loaded, for the loader (library.h).
  struct Registrations
  {
    std::vector<std::pair<PluginKind, std::string>> labels;  // with those refused
    std::vector<std::string> problems;
  };
  void BeginLibrary();
  Registrations EndLibrary();

private:
  std::map<std::tuple<PluginKind, std::string, std::string>, PluginDescription> plugins_;
  bool loading_ = false;
  Registrations current_;
};

}  // namespace swarmanoid
