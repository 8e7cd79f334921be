// The readers of the sections of an experiment file, in the order in which they are called. LoadExperimentText uses
// them.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/experiment/diagnostics.h"
#include "common/experiment/experiment.h"
#include "common/experiment/load_experiment.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid
{

struct ElementSpec;

// The entities of a <distribute>, whose positions are not chosen yet (see PlaceDistributed).
struct Distribution
{
  TConfigurationTree tree;
  std::size_t first = 0;  // index of its first entity
  std::size_t count = 0;
  long long max_trials = 0;
  bool by_place = false;  // the entities are sorted by position at the end
};

// The state that the readers share.
struct Reading
{
  Experiment& experiment;
  Diagnostics& diagnostics;
  const LoadOptions& options;
  std::vector<Distribution> distributions{};
  std::map<std::string, std::shared_ptr<const ConvexHull>> hulls{};  // the hulls made so far, by their source
};

void ReadFramework(const TConfigurationTree& tree, Reading& reading);
void ReadEntityKinds(const TConfigurationTree& tree, Reading& reading);
void ReadControllers(const TConfigurationTree& tree, Reading& reading);
void ReadArena(const TConfigurationTree& tree, Reading& reading);
// Reads one <floor_field> of the arena, whose size must be known.
void ReadFloorField(const TConfigurationTree& tree, const ElementSpec& spec, Reading& reading);
void ReadEngines(const TConfigurationTree& tree, Reading& reading);
void ReadArenaPhysics(const TConfigurationTree& tree, Reading& reading);
void ReadVisualisations(const TConfigurationTree& tree, Reading& reading);
void ReadExperimentFunctions(const TConfigurationTree& tree, Reading& reading);
// Finds the robots of each fault, so it is called after PlaceDistributed, which may sort the entities.
void ReadFaults(const TConfigurationTree& tree, Reading& reading);

// Reports mistakes that only the whole experiment shows.
void CheckControllersOfRobots(Reading& reading);
void CheckFloorFieldDevices(Reading& reading);
void CheckDevicesOfEngines(Reading& reading);
void CheckPlanes(Reading& reading);
void CheckVolumes(Reading& reading);
void CheckOverlaps(Reading& reading);

// Reports an id longer than 64, or with other characters than letters, digits and _ . : -. `place`: the position of the
// id.
bool IsIdCharacter(char c);
bool CheckId(const std::string& id, const SourceLocation& place, Diagnostics& diagnostics);

// Returns the description of a plug-in that an element stands for. If `library` names a library, it is loaded first.
// Returns nullptr, after a report of the existing plug-ins, if the plug-in does not exist.
const PluginDescription* FindPlugin(PluginKind kind, const TConfigurationTree& tree, Reading& reading);

// Returns whether an id fits a pattern with * for any characters and ? for one.
bool FitsPattern(const std::string& id, const std::string& pattern);

// Returns whether an engine moves entities on one plane, that is, has the parameters of the plane.
bool MovesOnPlane(const EngineConfiguration& engine);

// This name is lost (Diagnostics::Lose) if the map of a terrain could not be read, since it is then unknown where
// bodies stand on it.
inline constexpr const char* kTerrainMap = "<map of a terrain>";

// Gives the entities of all <distribute> elements their poses, around all placed entities and in the terrain of their
// engines. Call it after ReadArena and ReadArenaPhysics.
void PlaceDistributed(Reading& reading);

}  // namespace swarmanoid
