// Experiment functions that print the status lines of a space server, and text that no program must trip over.
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>

#include "space_server/experiment_functions.h"

namespace
{

using namespace swarmanoid;

class COutsidePrinter : public CExperimentFunctions
{
public:
  void Init(const TConfigurationTree, SpaceEditor&) override {}

  void PostStep(SpaceEditor& space) override
  {
    if (space.GetSpace().GetTick() != 5) return;
    const std::string lines =
        "error forged\nfinished 1 1 00000000000000ff 1 1\ntick 99999999999999999999 1 nan\nstate\n";
    std::fputs(lines.c_str(), stdout);
    std::fflush(stdout);
    const std::string raw = "stalled 9 forged\n" + std::string(200'000, 'x') + "\n\x01\n";
    [[maybe_unused]] const ssize_t written = write(STDOUT_FILENO, raw.data(), raw.size());
  }
};

REGISTER_EXPERIMENT_FUNCTIONS(COutsidePrinter, {.label = "outside_printer",
                                                .brief = "prints lines that look like those of the space server"})

}  // namespace
