// Experiment functions that fail by OUTSIDE_FAULT.
#include "controllers/outside_faults/faults.h"

#include "space_server/experiment_functions.h"

using namespace swarmanoid;

class COutsideFaultyFunctions : public CExperimentFunctions
{
public:
  void Init(const TConfigurationTree, SpaceEditor&) override {}
  void PostStep(SpaceEditor& editor) override { faults::FailIfAsked("functions", editor.GetSpace().GetTick()); }
};

REGISTER_EXPERIMENT_FUNCTIONS(COutsideFaultyFunctions, {.label = "outside_faulty_functions",
                                                        .brief = "functions that fail when they are told to"})
