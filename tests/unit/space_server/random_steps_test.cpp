// Experiment functions draw other numbers in each step, and consecutive ones within a step.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "space_server/space_server.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

// The map has the drawn numbers by id, step and tick.
std::map<std::string, std::vector<double>> drawn;

class CDrawingFunctions : public CExperimentFunctions
{
public:
  void Init(const TConfigurationTree tree, SpaceEditor& space) override
  {
    id_ = tree.GetText("id");
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
  void Draw(const std::string& step, const SpaceEditor& space) const
  {
    std::vector<double>& numbers = drawn[id_ + " " + step + " " + std::to_string(space.GetSpace().GetTick())];
    for (int call = 0; call < 3; ++call) numbers.push_back(space.GetRandom().Uniform());
  }
  std::string id_;
};

REGISTER_EXPERIMENT_FUNCTIONS(CDrawingFunctions, {.label = "drawing_functions"})

FunctionsConfiguration Named(const std::string& id)
{
  return {"drawing_functions", id, test::TreeOf({{"id", id}}), {}};
}

Experiment WithFunctions(const std::vector<std::string>& ids, std::uint64_t seed = 1)
{
  Experiment experiment;
  experiment.arena_size = {10, 10, 1};
  experiment.seed = seed;
  for (const std::string& id : ids) experiment.functions.push_back(Named(id));
  return experiment;
}

std::map<std::string, std::vector<double>> DrawnBy(const Experiment& experiment)
{
  drawn.clear();
  const Assignment assignment = MakeAssignment(experiment, 1);
  SpaceServer server(experiment, assignment, ".");
  for (int tick = 0; tick < 3; ++tick) server.Advance({}, {});
  server.Destroy();
  return drawn;
}

TEST(RandomSteps, NoTwoStepsAndNoTwoFunctionsDrawTheSame)
{
  const auto all = DrawnBy(WithFunctions({"a", "b"}));
  EXPECT_EQ(all.size(), 2U * (1 + 4 + 3 + 4 + 1));  // Init, PreStep, PostStep, IsFinished, Destroy
  std::vector<double> numbers;
  for (const auto& [name, of_step] : all)
  {
    EXPECT_EQ(of_step.size(), 3U) << name;
    numbers.insert(numbers.end(), of_step.begin(), of_step.end());
  }
  const std::size_t count = numbers.size();
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  EXPECT_EQ(numbers.size(), count);
}

TEST(RandomSteps, OtherFunctionsAndTheirOrderChangeNothing)
{
  const auto alone = DrawnBy(WithFunctions({"a"}));
  for (const auto& others : {std::vector<std::string>{"a", "b"}, {"b", "a"}, {"c", "b", "a"}})
  {
    const auto all = DrawnBy(WithFunctions(others));
    for (const auto& [name, numbers] : alone) EXPECT_EQ(all.at(name), numbers) << name;
  }
  const auto other_seed = DrawnBy(WithFunctions({"a"}, 2));
  for (const auto& [name, numbers] : alone) EXPECT_NE(other_seed.at(name), numbers) << name;
}

TEST(RandomSteps, ARestoredServerDrawsWhatTheFirstOneDrew)
{
  const Experiment experiment = WithFunctions({"a", "b"});
  const auto expected = DrawnBy(experiment);
  const Assignment assignment = MakeAssignment(experiment, 1);
  SpaceServer first(experiment, assignment, ".");
  first.Advance({}, {});
  SpaceSnapshot snapshot;
  first.WriteSnapshot(snapshot);
  ByteWriter written;
  first.SaveState(written);

  SpaceServer restored(experiment, assignment, ".");
  ByteReader state(written.Bytes());
  restored.LoadState(snapshot, state);
  drawn.clear();
  restored.Advance({}, {});
  restored.Advance({}, {});
  restored.Destroy();
  for (const auto& [name, numbers] : drawn) EXPECT_EQ(numbers, expected.at(name)) << name;
  EXPECT_EQ(drawn.size(), 2U * (2 + 2 + 2 + 1));
}

}  // namespace
}  // namespace swarmanoid
