// Each robot draws random numbers of its own in Init, in each control step and in Destroy, by its id and the seed.
#include <gmock/gmock.h>

#include <map>

#include "common/control_interface/ci_controller.h"
#include "controller_host/controller_host.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using Drawn = std::map<std::string, std::vector<double>>;  // by robot, in the order in which it drew
Drawn* drawn = nullptr;

class Drawer : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override
  {
    Draw();
    return RETURN_OK;
  }
  void ControlStep() override { Draw(); }
  void Destroy() override { Draw(); }

private:
  void Draw() { (*drawn)[GetRobot()->GetId()].push_back(GetRobot()->GetRandom().Uniform()); }
};

REGISTER_CONTROLLER(Drawer, "controller_random_numbers_test")

Drawn DrawnBy(const std::vector<std::string>& robots, std::uint64_t seed)
{
  Drawn all;
  drawn = &all;
  Experiment experiment = test::RobotsOf("controller_random_numbers_test", robots);
  experiment.seed = seed;
  const Assignment assignment = MakeAssignment(experiment, 1);
  CSwarmanoidSpace space(experiment);
  ControllerHost host(space, assignment, 0);
  for (const std::uint64_t tick : {0U, 1U, 7U})
  {
    space.SetTick(tick);
    host.Tick({});
  }
  host.Destroy();
  return all;
}

TEST(ControllerRandomNumbers, AreOnesOfTheRobotTheSeedAndTheStep)
{
  const Drawn two = DrawnBy({"a", "b"}, 7);
  for (const std::string id : {"a", "b"})
  {
    const std::uint64_t name = StreamName(id);
    const std::vector<double> expected{
        RandomStream(7, name, kInitStream, 0).Uniform(), RandomStream(7, name, kControlStepStream, 0).Uniform(),
        RandomStream(7, name, kControlStepStream, 1).Uniform(), RandomStream(7, name, kControlStepStream, 7).Uniform(),
        RandomStream(7, name, kDestroyStream, 7).Uniform()};
    EXPECT_EQ(two.at(id), expected) << id;
  }
}

TEST(ControllerRandomNumbers, NoTwoAreAlike)
{
  std::set<double> numbers;
  std::size_t count = 0;
  for (const std::uint64_t seed : {7U, 8U})
    for (const auto& [id, values] : DrawnBy({"a", "b", "c"}, seed))
    {
      numbers.insert(values.begin(), values.end());
      count += values.size();
    }
  EXPECT_EQ(numbers.size(), count);
  EXPECT_EQ(count, 2U * 3 * 5);
}

TEST(ControllerRandomNumbers, DoNotDependOnWhoElseIsThere)
{
  EXPECT_EQ(DrawnBy({"b"}, 7).at("b"), DrawnBy({"a", "b", "c"}, 7).at("b"));
}

}  // namespace
}  // namespace swarmanoid
