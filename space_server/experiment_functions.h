// CExperimentFunctions: a user's code around the steps of an experiment. It runs at the space server and sees and
// changes the whole space: it measures, moves entities, paints the floor, and decides when the experiment is over and
// whether it succeeded. A plug-in.
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
#include "common/space/query.h"
#include "common/space/structure/structural_tree.h"
#include "space_server/user_input.h"

#ifndef SWARMANOID_OWN_SOURCES
#include <common/space/space.h>  // for plug-ins, which mostly need it
#endif

namespace swarmanoid
{

class CSwarmanoidSpace;

class SpaceServer;

// What experiment functions, and programs around a CSimulator, may do to the space: every change is seen by all
// processes in the state that goes out next, and is part of the experiment: the state hash covers it. What cannot be
// part of a state is refused by std::invalid_argument: numbers that are not finite, orientations that are no unit
// quaternions, places farther outside the arena than its limit.
class SpaceEditor
{
public:
  SpaceEditor(SpaceServer& server, std::string output_folder)
      : server_(server), output_folder_(std::move(output_folder))
  {
  }

  const CSwarmanoidSpace& GetSpace() const;
  // Questions about the space: who is near, what is between.
  SpaceQuery& GetQuery();
  // Who holds whom, as the engines last told.
  const StructuralTree& GetStructure() const;
  // Puts a movable entity elsewhere, and all that are connected to it by grips along with it, as one rigid body: they
  // go on to hold one another. Throws as MoveEntity.
  void MoveCompound(std::string_view id, const Pose& pose);
  // Puts a movable entity elsewhere, alone: it lets go and is let go. Throws std::invalid_argument for an unknown id
  // and an entity that cannot move or is not in the arena.
  void MoveEntity(std::string_view id, const Pose& pose);
  // Puts an entity into the arena: the next one of the <reserve> of that id, or the entity of that id, which waits or
  // was removed. Returns its id. A robot's controller goes on with what it remembers. Throws std::invalid_argument for
  // an unknown id, a reserve that is used up, an entity that is there already, and a place where its body would overlap
  // another one of the same engine.
  std::string AddEntity(std::string_view id, const Pose& pose);
  // Whether AddEntity would find the place free of bodies. Throws as AddEntity does, except for the place.
  bool IsFree(std::string_view id, const Pose& pose) const;
  // Takes an entity that can move, or is of a <reserve>, out of the arena; it lets go of what it holds and is let go.
  // Throws std::invalid_argument for any other, and for one that is not there.
  void RemoveEntity(std::string_view id);
  // Changes an attribute (common/space/attributes.h), such as the colour of a nest. Throws std::invalid_argument for an
  // unknown id or name, an element that the attribute does not have, and a value that it cannot have. "gripped" is told
  // by the engines: 0 makes the gripper let go, all else is refused.
  void SetAttribute(std::string_view id, std::string_view attribute, double value, int element = 0);
  // From now on ticks count from `first_tick` for random numbers of all (noise, robots, functions) and for what engines
  // forget from time to time, so that a run whose entities were put back repeats itself; `variation`: 0 for the same
  // numbers, others for others. It is no part of the state: throws
  // std::logic_error if the run is a cluster, and such a run cannot be saved.
  void BeginAgain(std::uint64_t first_tick, std::uint32_t variation);
  // Random numbers of these functions in this step: Init, a PreStep, PostStep or IsFinished, Destroy. They go on from
  // call to call, are others in the next step, and depend on the seed, the id of the functions, the step and the tick
  // alone, so that they are equal in every run. Keep no reference beyond the step.
  RandomStream& GetRandom() const { return random_; }
  // The folder of the run: files of the functions go there.
  const std::string& GetOutputFolder() const { return output_folder_; }
  // Makes the file that a parameter of the functions names, below that folder, and returns its path for writing. Throws
  // ConfigurationError, with the cure, if the name leaves the folder, or a file is there that this run did not make.
  std::string MakeOutputFile(const TConfigurationTree& tree, const std::string& parameter) const;

  // For the server, before it calls functions, and to go on with the random numbers of who was called before.
  void BeginStep(RandomStream random) { random_ = std::move(random); }
  RandomStream LeaveStep() { return std::move(random_); }

private:
  SpaceServer& server_;
  std::string output_folder_;
  std::unique_ptr<SpaceQuery> query_;
  mutable RandomStream random_{0, 0, 0, 0};  // IsFinished, which changes nothing, may draw too
};

class CExperimentFunctions
{
public:
  enum class Outcome
  {
    kRunning,
    kDone,   // the experiment reached its goal: it ends, exit code 0
    kFailed  // it can no longer reach it: it ends, exit code 1
  };

  virtual ~CExperimentFunctions() = default;

  // In this order: Init once, then PreStep before the controllers of each tick and PostStep after its physics, at the
  // end Destroy. A user's mistake throws ConfigurationError; any exception stops the run and is shown with the id of
  // the functions.
  virtual void Init(const TConfigurationTree t_tree, SpaceEditor& space) = 0;
  virtual void PreStep(SpaceEditor&) {}
  virtual void PostStep(SpaceEditor&) {}
  // Asked after Init and after each PostStep.
  virtual Outcome IsFinished(const SpaceEditor&) { return Outcome::kRunning; }
  virtual void Destroy(SpaceEditor&) {}

  // Draws into the pictures of the tick. Called only if somebody looks: before each tick if the run has visualisers
  // that are waited for, otherwise when a picture is due. So it must change nothing that later steps depend on.
  virtual void Draw(const SpaceEditor&, Drawing&) {}
  // A user pressed or released a key for the functions, or selected an entity, in a window, on a page or by `swarmanoid
  // control`. Called between two ticks; it may change the space as PreStep may, and is repeated with the other events
  // of a run. References in the input are valid during the call.
  virtual void Input(const UserInput&, SpaceEditor&) {}

  // Optional: all that the functions remember between ticks, so that a run can go on from a checkpoint. Functions that
  // remember nothing override HasState alone; if it is left false, checkpoints of the run are refused.
  virtual bool HasState() const { return false; }
  virtual void SaveState(std::ostream&) const {}
  virtual void LoadState(std::istream&) {}
};

template <>
PluginRegistry<CExperimentFunctions>& PluginRegistry<CExperimentFunctions>::Instance();
extern template class PluginRegistry<CExperimentFunctions>;

// Used by REGISTER_EXPERIMENT_FUNCTIONS.
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

// REGISTER_EXPERIMENT_FUNCTIONS(CMyFunctions, description): description is a PluginDescription expression.
#define REGISTER_EXPERIMENT_FUNCTIONS(CLASS, ...)                                                                      \
  namespace                                                                                                            \
  {                                                                                                                    \
  const ::swarmanoid::ExperimentFunctionsRegistration registration_of_##CLASS(                                         \
      __VA_ARGS__, []() -> std::unique_ptr<::swarmanoid::CExperimentFunctions> { return std::make_unique<CLASS>(); }); \
  }
