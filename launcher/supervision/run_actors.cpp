#include "launcher/supervision/run_actors.h"

#include <map>

namespace swarmanoid
{

RunActors::RunActors(const Experiment& experiment)
{
  without_entities_.controllers = experiment.controllers;
  without_entities_.functions = experiment.functions;
  without_entities_.visualisations = experiment.visualisations;
  for (const EngineConfiguration& engine : experiment.engines)
  {
    EngineConfiguration& kept = without_entities_.engines.emplace_back();
    kept.id = engine.id;
    kept.tag = engine.tag;
  }
  std::map<std::string, std::uint32_t> numbers;
  for (const ControllerConfiguration& controller : experiment.controllers)
    numbers.emplace(controller.id, static_cast<std::uint32_t>(numbers.size()));
  id_starts_.reserve(experiment.entities.size());
  controllers_.reserve(experiment.entities.size());
  for (const EntityConfiguration& entity : experiment.entities)
  {
    id_starts_.push_back(static_cast<std::uint32_t>(ids_.size()));
    ids_.append(entity.id).push_back('\0');
    const auto number = numbers.find(entity.controller);
    controllers_.push_back(number == numbers.end() ? kNoController : number->second);
  }
}

const ControllerConfiguration* RunActors::ControllerOf(std::uint32_t entity) const
{
  if (entity >= controllers_.size() || controllers_[entity] == kNoController) return nullptr;
  return &without_entities_.controllers[controllers_[entity]];
}

Actor RunActors::Of(Actor::Kind kind, std::uint32_t number) const
{
  if (kind != Actor::kRobot) return ActorOf(without_entities_, kind, number);
  if (number >= id_starts_.size()) return {};
  const ControllerConfiguration* const controller = ControllerOf(number);
  return {kind, number, &ids_[id_starts_[number]], controller == nullptr ? "" : controller->id.c_str()};
}

bool RunActors::MayFail(std::uint32_t robot) const
{
  const ControllerConfiguration* const controller = ControllerOf(robot);
  return controller != nullptr && controller->MayFail();
}

}  // namespace swarmanoid
