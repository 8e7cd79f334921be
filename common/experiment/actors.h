// The actors of an experiment: the plug-ins whose code its processes run (common/activity). Roles note which actor
// runs. The launcher finds by the numbers which actor ran in a dead process.
#pragma once

#include "common/activity/activity.h"
#include "common/experiment/experiment.h"

namespace swarmanoid
{

// Return the actors of an experiment, which must outlive them.
Actor RobotActor(const Experiment& experiment, std::size_t entity);
Actor FunctionsActor(const Experiment& experiment, std::size_t functions);
Actor EngineActor(const Experiment& experiment, std::size_t engine);
Actor VisualisationActor(const RenderConfiguration& visualisation, std::size_t number);
Actor SensorActor(const Experiment& experiment, std::size_t controller, std::size_t sensor);
Actor ActuatorActor(const Experiment& experiment, std::size_t controller, std::size_t actuator);

// Returns the actor of that kind and number, or an actor of kind kNobody if the experiment has none.
Actor ActorOf(const Experiment& experiment, Actor::Kind kind, std::uint32_t number);

}  // namespace swarmanoid
