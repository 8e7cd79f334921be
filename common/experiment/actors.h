// The actors of an experiment: those whose code its processes run (common/activity). Roles say by them what they do;
// the launcher finds by them who ran in a process that is dead.
#pragma once

#include "common/activity/activity.h"
#include "common/experiment/experiment.h"

namespace swarmanoid
{

// The experiment outlives the actors.
Actor RobotActor(const Experiment& experiment, std::size_t entity);
Actor FunctionsActor(const Experiment& experiment, std::size_t functions);
Actor EngineActor(const Experiment& experiment, std::size_t engine);
Actor VisualisationActor(const RenderConfiguration& visualisation, std::size_t number);
Actor SensorActor(const Experiment& experiment, std::size_t controller, std::size_t sensor);
Actor ActuatorActor(const Experiment& experiment, std::size_t controller, std::size_t actuator);

// The one of that kind and number, or nobody if the experiment has none.
Actor ActorOf(const Experiment& experiment, Actor::Kind kind, std::uint32_t number);

}  // namespace swarmanoid
