// CExperimentFunctions: a user's code around the steps of an experiment. It runs at the space server, and sees and
// changes the whole space. It measures, moves entities, paints the floor, and decides when the experiment is over and
// whether it succeeded. It is a plug-in.
//
//   <experiment_functions>
//     <prey_retrieval id="goal" library="prey_retrieval"><metrics>metrics.csv</metrics></prey_retrieval>
//   </experiment_functions>
#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "common/math/pose.h"
#include "common/math/random.h"
#include "common/messages/drawing.h"
#include "common/plugins/registry.h"
#include "common/space/space_query.h"
#include "common/space/structural_tree.h"
#include "space_server/user_input.h"

#ifndef SWARMANOID_OWN_SOURCES
#include <common/space/space.h>  // for plug-ins, which mostly need it
#endif

namespace swarmanoid
{

class CSwarmanoidSpace;

class SpaceServer;

// It tells what a move does if another body stands at the new position.
enum class EOccupied
{
  kRefuse,
  kOverlap
};

// The changes that experiment functions, and programs around a CSimulator, may make to the space. All processes see a
// change in the state that is sent next, and the state hash covers it. A value that cannot be part of a state is
// refused by std::invalid_argument. This means numbers that are not finite, orientations that are no unit quaternions,
// and positions too far outside the arena.
class SpaceEditor
{
public:
  SpaceEditor(SpaceServer& server, std::string output_folder)
      : server_(server), output_folder_(std::move(output_folder))
  {
  }

  const CSwarmanoidSpace& GetSpace() const;
  // Returns the queries of the space, such as neighbours and lines of sight.
  SpaceQuery& GetQuery();
  // Returns the grips between entities, as the engines last reported them.
  const StructuralTree& GetStructure() const;
  // Moves a movable entity and all entities that are connected to it by grips, as one rigid body. The grips stay.
  // Throws as MoveEntity.
  void MoveCompound(std::string_view id, const Pose& pose, EOccupied occupied = EOccupied::kRefuse);
  // Moves a movable entity alone: all its grips end. Throws std::invalid_argument for an unknown id, for an entity that
  // cannot move or is not in the arena, and for a position where its body would overlap another one of the same engine,
  // unless `occupied` allows it. The engine then pushes the two apart.
  void MoveEntity(std::string_view id, const Pose& pose, EOccupied occupied = EOccupied::kRefuse);
  // Puts an entity into the arena and returns its id. It is the next one of the <reserve> of that id, or a waiting or
  // removed entity of that id. The controller of a robot keeps its state. Throws std::invalid_argument for an unknown
  // id, an empty reserve and an entity that is present. It throws the same if the body would overlap another one of the
  // same engine.
  std::string AddEntity(std::string_view id, const Pose& pose);
  // Returns whether AddEntity would find the place free of bodies. Throws as AddEntity does, except for the place.
  bool IsFree(std::string_view id, const Pose& pose) const;
  // Removes an entity that can move, or is of a <reserve>, from the arena. All its grips end. Throws
  // std::invalid_argument for any other entity, and for one that is not in the arena.
  void RemoveEntity(std::string_view id);
  // Changes an attribute (common/space/attributes.h), such as the colour of a nest. Throws std::invalid_argument for an
  // unknown id, name or element, and for a value outside the attribute's range. The engines set "gripped", so only 0 is
  // accepted, which ends the grip.
  void SetAttribute(std::string_view id, std::string_view attribute, double value, int element = 0);
  // Sets the charge (J) of a robot's energy_battery. A robot that an empty battery has switched off runs again from the
  // charge that its parameter restart gives. Throws std::invalid_argument for an unknown id, a robot without such a
  // battery, and a charge that is not from 0 to the capacity.
  void SetCharge(std::string_view id, double charge_j);
  // Adds an amount to a floor field at a point (m) in the arena, or takes from it if the amount is negative. Throws
  // std::invalid_argument for an unknown field, an amount that is not finite, and a point outside the field.
  void Deposit(std::string_view field, double x, double y, double amount);
  // Sets the value (1/m²) of a cell of a floor field, row · Columns() + column. Throws std::invalid_argument for an
  // unknown field or cell, and for values that are not from 0 to FloorField::kMost.
  void SetFieldCell(std::string_view field, std::size_t cell, double value);
  // Random numbers of noise, robots and functions, and periodic events of engines, count ticks from `first_tick` from
  // now on. So a run whose entities were put back repeats itself. `variation` 0 gives the same numbers, other values
  // give others. The run cannot be saved afterwards. Throws std::logic_error in a cluster.
  void BeginAgain(std::uint64_t first_tick, std::uint32_t variation);
  // Returns the random numbers of these functions in this step: Init, a PreStep, PostStep or IsFinished, Destroy. They
  // continue from call to call and differ between steps. They depend only on the seed, the id of the functions, the
  // step and the tick, so they are equal in every run. The reference is valid during the step only.
  RandomStream& GetRandom() const { return random_; }
  // Returns the folder of the run, in which the functions write their files.
  const std::string& GetOutputFolder() const { return output_folder_; }
  // Makes the file that a parameter of the functions names, below that folder, and returns its path for writing. Throws
  // ConfigurationError, with the cure, if the name leaves the folder, or if a file of that name exists that this run
  // did not make.
  std::string MakeOutputFile(const TConfigurationTree& tree, const std::string& parameter) const;

  // The server sets the random numbers before it calls functions, and takes them back afterwards.
  void BeginStep(RandomStream random) { random_ = std::move(random); }
  RandomStream LeaveStep() { return std::move(random_); }

private:
  SpaceServer& server_;
  std::string output_folder_;
  std::unique_ptr<SpaceQuery> query_;
  mutable RandomStream random_{0, 0, 0, 0};  // mutable, since IsFinished may draw random numbers, too
};

class CExperimentFunctions
{
public:
  enum class Outcome
  {
    kRunning,
    kDone,   // the experiment reached its goal: it ends with exit code 0
    kFailed  // it cannot reach its goal any more: it ends with exit code 1
  };

  virtual ~CExperimentFunctions() = default;

  // The server calls Init once, before the first tick. A user's mistake throws ConfigurationError. Any exception of
  // this function and of those below stops the run and is shown with the id of the functions.
  virtual void Init(const TConfigurationTree t_tree, SpaceEditor& space) = 0;
  // The server calls PreStep before the controllers of each tick.
  virtual void PreStep(SpaceEditor&) {}
  // The server calls PostStep after the physics of each tick.
  virtual void PostStep(SpaceEditor&) {}
  // Decides whether the experiment is over. The server calls it after Init and after each PostStep.
  virtual Outcome IsFinished(const SpaceEditor&) { return Outcome::kRunning; }
  // The server calls Destroy once, at the end.
  virtual void Destroy(SpaceEditor&) {}

  // Draws into the pictures of the tick. If the run waits for visualisers, it is called before each tick. Otherwise it
  // is called when a picture is due. It must not change anything that later steps depend on.
  virtual void Draw(const SpaceEditor&, Drawing&) {}
  // Handles the input of a user in a window, on a page or by `swarmanoid control`: a key is pressed or released, or an
  // entity is selected. The server calls it between two ticks. It may change the space as PreStep may, and is repeated
  // with the other events of a run. References in the input are valid during the call.
  virtual void Input(const UserInput&, SpaceEditor&) {}

  // Returns false if the functions cannot be saved; checkpoints of the run are then refused. Runs that continue from a
  // checkpoint need the state between ticks. Functions without state override only HasState.
  virtual bool HasState() const { return false; }
  // Saves the state between ticks.
  virtual void SaveState(std::ostream&) const {}
  // Loads what SaveState has saved.
  virtual void LoadState(std::istream&) {}

  // Returns the reason that Failed was given last; empty before.
  const std::string& FailureReason() const { return failure_reason_; }

protected:
  // For IsFinished: `return Failed("3 of 10 preys are in the nest");` ends the experiment as kFailed does. The console
  // and manifest.json show the reason, one line, behind the id of the functions.
  Outcome Failed(std::string reason)
  {
    failure_reason_ = std::move(reason);
    return Outcome::kFailed;
  }

private:
  std::string failure_reason_;
};

template <>
PluginRegistry<CExperimentFunctions>& PluginRegistry<CExperimentFunctions>::Instance();
extern template class PluginRegistry<CExperimentFunctions>;

// The macro REGISTER_EXPERIMENT_FUNCTIONS makes one of these for each class.
struct ExperimentFunctionsRegistration
{
  ExperimentFunctionsRegistration(const PluginDescription& description,
                                  std::unique_ptr<CExperimentFunctions> (*create)())
  {
    PluginRegistry<CExperimentFunctions>::Instance().Add(description, create);
  }
};

}  // namespace swarmanoid

using swarmanoid::CExperimentFunctions;

// REGISTER_EXPERIMENT_FUNCTIONS(CMyFunctions, description) registers the class; the description is a PluginDescription.
#define REGISTER_EXPERIMENT_FUNCTIONS(CLASS, ...)                                                                      \
  namespace                                                                                                            \
  {                                                                                                                    \
  const ::swarmanoid::ExperimentFunctionsRegistration registration_of_##CLASS(                                         \
      __VA_ARGS__, []() -> std::unique_ptr<::swarmanoid::CExperimentFunctions> { return std::make_unique<CLASS>(); }); \
  }
