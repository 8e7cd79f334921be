// Experiment functions that draw in each of their steps and append the numbers to a file: step, tick, numbers.
#include <cstdio>
#include <memory>
#include <string>

#include "space_server/experiment_functions.h"

using namespace swarmanoid;

class COutsideRandomFunctions : public CExperimentFunctions
{
public:
  void Init(const TConfigurationTree tree, SpaceEditor& space) override
  {
    path_ = tree.GetText("file");
    tree.GetNumber("any", 0);
    Draw("Init", space);
  }
  void PreStep(SpaceEditor& space) override { Draw("PreStep", space); }
  void PostStep(SpaceEditor& space) override { Draw("PostStep", space); }
  Outcome IsFinished(const SpaceEditor& space) override
  {
    Draw("IsFinished", space);
    return Outcome::kRunning;
  }
  void Destroy(SpaceEditor& space) override { Draw("Destroy", space); }
  bool HasState() const override { return true; }

private:
  void Draw(const char* step, const SpaceEditor& space) const
  {
    const double first = space.GetRandom().Uniform();
    const double second = space.GetRandom().Uniform();
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path_.c_str(), "a"), &std::fclose);
    std::fprintf(file.get(), "%s %llu %a %a\n", step, static_cast<unsigned long long>(space.GetSpace().GetTick()),
                 first, second);
  }
  std::string path_;
};

REGISTER_EXPERIMENT_FUNCTIONS(
    COutsideRandomFunctions,
    {.label = "outside_random_functions",
     .brief = "draws random numbers in each step",
     .parameters = {{.name = "file", .type = ParameterType::kText, .description = "Where they are written."},
                    {.name = "any", .default_value = "0", .description = "Nothing depends on it."}}})
