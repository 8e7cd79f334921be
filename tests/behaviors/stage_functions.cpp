// Experiment functions of the tests: they paint the floor, move a robot, measure, and end the experiment.
#include <fstream>

#include "space_server/experiment_functions.h"

namespace
{

using namespace swarmanoid;

class CStage : public CExperimentFunctions
{
public:
  void Init(const TConfigurationTree, SpaceEditor& space) override
  {
    metrics_.open(space.GetOutputFolder() + "/stage.csv");
    metrics_ << "tick,x\n";
  }
  void PreStep(SpaceEditor& space) override
  {
    if (space.GetSpace().GetTick() == 5) space.SetAttribute("patch", "colour", 0xff0000);
    if (space.GetSpace().GetTick() == 8) space.MoveEntity("fb", {Vector3(2, 3, 0), Quaternion::Identity()});
  }
  void PostStep(SpaceEditor& space) override
  {
    metrics_ << space.GetSpace().GetTick() << ',' << space.GetSpace().FindEntity("fb")->GetPosition().x() << '\n';
  }
  Outcome IsFinished(const SpaceEditor& space) override
  {
    return space.GetSpace().GetTick() == 12 ? Outcome::kDone : Outcome::kRunning;
  }
  void Destroy(SpaceEditor&) override
  {
    metrics_ << "end\n";
    metrics_.close();
  }

private:
  std::ofstream metrics_;
};

REGISTER_EXPERIMENT_FUNCTIONS(CStage, {.label = "stage", .brief = "paints, moves, measures, ends"})

}  // namespace
