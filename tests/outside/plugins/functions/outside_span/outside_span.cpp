// Experiment functions with a table: they end the run after some ticks.
#include "space_server/experiment_functions.h"

using namespace swarmanoid;

class COutsideSpan : public CExperimentFunctions
{
public:
  static PluginDescription Description()
  {
    return {.label = "outside_span",
            .brief = "ends the run",
            .parameters = {{.name = "after",
                            .type = ParameterType::kInteger,
                            .unit = "ticks",
                            .default_value = "7",
                            .description = "Length of the run.",
                            .minimum = 1}}};
  }

  void Init(const TConfigurationTree t_tree, SpaceEditor&) override
  {
    after_ = static_cast<std::uint64_t>(t_tree.GetInteger("after"));
  }
  Outcome IsFinished(const SpaceEditor& space) override
  {
    return space.GetSpace().GetTick() >= after_ ? Outcome::kDone : Outcome::kRunning;
  }

private:
  std::uint64_t after_ = 0;
};

REGISTER_EXPERIMENT_FUNCTIONS(COutsideSpan, COutsideSpan::Description())
