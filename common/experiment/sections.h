// The readers of the sections of an experiment file, in the order in which they are called. Used by LoadExperimentText.
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

// The entities of a <distribute>, whose places are still open (see PlaceDistributed).
struct Distribution
{
  TConfigurationTree tree;
  std::size_t first = 0;  // index of its first entity
  std::size_t count = 0;
  long long max_trials = 0;
  bool by_place = false;  // the order in which they stand in the end
};

// What the readers share.
struct Reading
{
  Experiment& experiment;
  Diagnostics& diagnostics;
  const LoadOptions& options;
  std::vector<Distribution> distributions{};
  std::map<std::string, std::shared_ptr<const ConvexHull>> hulls{};  // that were made, by what they are made of
};

void ReadFramework(const TConfigurationTree& tree, Reading& reading);
void ReadEntityKinds(const TConfigurationTree& tree, Reading& reading);
void ReadControllers(const TConfigurationTree& tree, Reading& reading);
void ReadArena(const TConfigurationTree& tree, Reading& reading);
void ReadEngines(const TConfigurationTree& tree, Reading& reading);
void ReadArenaPhysics(const TConfigurationTree& tree, Reading& reading);
void ReadVisualisations(const TConfigurationTree& tree, Reading& reading);
void ReadExperimentFunctions(const TConfigurationTree& tree, Reading& reading);

// Mistakes that only the whole experiment shows.
void CheckControllersOfRobots(Reading& reading);
void CheckDevicesOfEngines(Reading& reading);
void CheckPlanes(Reading& reading);
void CheckOverlaps(Reading& reading);

// Reports an id of other than letters, digits and _ . : -, or longer than 64. `place`: of the id.
bool IsIdCharacter(char c);
bool CheckId(const std::string& id, const SourceLocation& place, Diagnostics& diagnostics);

// The description of a plug-in that an element stands for, its library loaded first if `library` names one. nullptr,
// and a report naming those that exist, if there is none.
const PluginDescription* FindPlugin(PluginKind kind, const TConfigurationTree& tree, Reading& reading);

// Whether an engine moves things on one plane: it takes the parameters that place the plane.
bool MovesOnPlane(const EngineConfiguration& engine);

// Lost (Diagnostics::Lose) if the map of a terrain could not be read: where bodies would stand on it is unknown.
inline constexpr const char* kTerrainMap = "<map of a terrain>";

// Gives the entities of all <distribute> elements their poses, around all entities that have theirs already and in the
// terrain of their engines: after ReadArena and ReadArenaPhysics.
void PlaceDistributed(Reading& reading);

}  // namespace swarmanoid
