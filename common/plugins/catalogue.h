// PluginCatalogue: the descriptions of all registered plug-ins, of every interface. The reader of experiment files
// checks against it without knowing the interfaces. PluginRegistry fills it before roles start; it is read-only
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

// Returns "controller", "actuator", "sensor", "physics engine", "visualisation", "experiment functions" or "entity
// kind".
std::string_view PluginKindName(PluginKind kind);
// Returns "sensor 'footbot_light' (generic_footbot_light)"; without the parentheses if the plug-in has no
// implementation.
std::string NameOfPlugin(PluginKind kind, const std::string& label, const std::string& implementation);

// `swarmanoid list plugins` and the reference pages show this about a plug-in.
struct PluginDescription
{
  std::string label{};           // the XML tag: type of device, engine, renderer or controller
  std::string implementation{};  // devices only: the text of <implementation>
  std::string brief{};           // one line
  std::vector<ParameterSpec> parameters{};
  std::vector<std::string> robots{};  // devices only: the robot tags that can carry it; empty: all
  // Only specific devices have a channel of values between host and engine, with its count of doubles for each robot.
  // If it is empty, the device is generic.
  std::string channel{};
  int channel_width = 0;
  // The count is for each joint: the channel has room for the most joints of a robot in the experiment.
  bool channel_is_per_joint = false;
  // Only engines have these: the channels and the entity tags that they can serve.
  std::vector<std::string> channels{};
  std::vector<std::string> entity_tags{};
  bool any_kind = false;     // engines only: it also serves the kinds of users, by the rows of the kinds
  bool moves_links = false;  // engines only: it moves robots that stand on links, without wheels or propellers
  bool can_split = false;    // engines only: its world may be cut into regions (CPhysicsEngine::MakeRegion)
  // Engines only: entities may change between it and other engines while the run goes on (CPhysicsEngine::TakeOver).
  bool hands_over = false;
  // Engines only: parameters and tags of entities without effect in it; `swarmanoid check` reports them.
  std::vector<std::string> ignores{};
  // Engines only: adds the bodies that the engine collides for an entity with the current values of its attributes, in
  // the frame of the entity. Sensors, queries and renderers use these bodies. nullptr: the plain body of the kind.
  void (*collision_model)(const EntityConfiguration& entity, std::span<const double> attributes,
                          std::vector<CollisionBody>& bodies) = nullptr;
  // Controllers only: false if only its label was registered. Then `parameters` is empty, and the reads of its Init
  // decide.
  bool declares_parameters = true;
};

class PluginCatalogue
{
public:
  static PluginCatalogue& Instance();

  // Adds a plug-in. Returns false for a second one of the same kind and name: the first one stays. While a library is
  // being loaded, the mistake is kept as a problem of that library, since throwing through dlopen would end the
  // program. Otherwise std::invalid_argument is thrown. A table of parameters that contradicts itself is handled the
  // same way.
  bool Add(PluginKind kind, const PluginDescription& description);
  // Keeps a mistake in a registration as a problem of the library that is being loaded; otherwise throws
  // std::invalid_argument.
  void Refuse(const std::string& problem);

  // Returns nullptr if it does not exist.
  const PluginDescription* Find(PluginKind kind, const std::string& label,
                                const std::string& implementation = "") const;
  // Returns the plug-ins of a kind, ordered by label and implementation.
  std::vector<const PluginDescription*> Of(PluginKind kind) const;
  // Returns the labels of a kind, each once, in alphabetical order.
  std::vector<std::string> Labels(PluginKind kind) const;
  // Returns the implementations of a device type, in alphabetical order.
  std::vector<std::string> Implementations(PluginKind kind, const std::string& label) const;

  // The registrations of a library while it was loaded, for the loader (library.h).
  struct Registrations
  {
    std::vector<std::pair<PluginKind, std::string>> labels;  // including the refused ones
    std::vector<std::string> problems;
  };
  // Start and end the collection of registrations for one library.
  void BeginLibrary();
  Registrations EndLibrary();

private:
  std::map<std::tuple<PluginKind, std::string, std::string>, PluginDescription> plugins_;
  bool loading_ = false;
  Registrations current_;
};

}  // namespace swarmanoid
