// The machines that workers may move to, and the messages for impossible requests.
#include "space_server/worker_placement.h"

#include <gmock/gmock.h>

#include <stdexcept>

#include "common/messages/control_verbs.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;

const WorkerPlacement& Places()
{
  static const WorkerPlacement places({"here", "alpha", "beta"},
                                      {"space server=here", "engine 'ground'=alpha", "engine 'a to b'=alpha",
                                       "controller host 0=alpha", "controller host 1=beta", "visualiser 'x=y'=here"});
  return places;
}

std::string MovesOf(const WorkerPlacement& places, const std::vector<std::string>& words)
{
  std::string text;
  const std::string refusal = test::MessageOf<std::invalid_argument>(
      [&]
      {
        const ControlOrder order = ParseOrder(*FindControlVerb(words[0]), {}, {words.begin() + 1, words.end()});
        for (const auto& [worker, machine] : words[0] == "move-host"     ? places.ReadHostMove(order)
                                             : words[0] == "move-engine" ? places.ReadEngineMove(order)
                                                                         : places.ReadDrain(order))
          text += worker + " > " + machine + "; ";
      });
  return refusal.empty() ? text : refusal;
}

std::string MovesOf(const std::vector<std::string>& words) { return MovesOf(Places(), words); }

TEST(WorkerPlacement, FindTheWorkerAndItsMachine)
{
  EXPECT_EQ(MovesOf({"move-host", "1"}), "controller host 1 > beta; ");
  EXPECT_EQ(MovesOf({"move-host", "1", "alpha"}), "controller host 1 > alpha; ");
  EXPECT_EQ(MovesOf({"move-engine", "ground", "here"}), "engine 'ground' > here; ");
  EXPECT_EQ(MovesOf({"move-engine", "a to b"}), "engine 'a to b' > alpha; ");
  EXPECT_EQ(MovesOf({"move-engine", "a to b", "beta"}), "engine 'a to b' > beta; ");
}

TEST(WorkerPlacement, FindTheRegionsOfAnEngine)
{
  const WorkerPlacement places({"here", "beta"}, {"engine 'ground'=here", "region 0 of engine 'ground'=here",
                                                  "region 1 of engine 'ground'=beta", "engine 'a/1'=here"});
  EXPECT_EQ(MovesOf(places, {"move-engine", "ground/1"}), "region 1 of engine 'ground' > beta; ");
  EXPECT_EQ(MovesOf(places, {"move-engine", "ground/0", "beta"}), "region 0 of engine 'ground' > beta; ");
  EXPECT_EQ(MovesOf(places, {"move-engine", "ground", "beta"}), "engine 'ground' > beta; ");
  EXPECT_EQ(MovesOf(places, {"move-engine", "a/1"}), "engine 'a/1' > here; ");
  EXPECT_EQ(MovesOf(places, {"drain", "beta"}), "region 1 of engine 'ground' > here; ");
  EXPECT_THAT(MovesOf(places, {"move-engine", "ground/2"}), HasSubstr("region 1 of engine 'ground'"));
}

TEST(WorkerPlacement, RefuseWhatIsNotThere)
{
  EXPECT_THAT(MovesOf({"move-host", "2"}), AllOf(HasSubstr("no controller host 2"), HasSubstr("controller host 1")));
  EXPECT_THAT(MovesOf({"move-host", "1", "gamma"}), AllOf(HasSubstr("no machine 'gamma'"), HasSubstr("machines = ")));
  EXPECT_THAT(MovesOf({"drain", "bet"}), HasSubstr("did you mean 'beta'?"));
  EXPECT_THAT(MovesOf({"drain", "here"}), HasSubstr("the space server is at 'here'"));
  EXPECT_THAT(MovesOf(WorkerPlacement(), {"move-host", "0"}), HasSubstr("no process of this run can be moved"));
  EXPECT_THROW(WorkerPlacement({}, {"engine"}), std::invalid_argument);
}

TEST(WorkerPlacement, TheTextNamesEachMachineAndItsWorkers)
{
  EXPECT_EQ(Places().Text(),
            "here: space server, visualiser 'x=y'; alpha: controller host 0, engine 'a to b', engine 'ground'; beta: "
            "controller host 1");
  WorkerPlacement places = Places();
  places.Put({"controller host 1", "alpha"});
  EXPECT_THAT(places.Text(), EndsWith("; beta: no process"));
}

// Two workers are at beta or here each; those of alpha go where the fewest are.
TEST(WorkerPlacement, DrainGivesToThoseWhoHaveTheFewest)
{
  EXPECT_EQ(MovesOf({"drain", "alpha"}), "controller host 0 > beta; engine 'a to b' > beta; engine 'ground' > here; ");
  EXPECT_EQ(MovesOf({"drain", "beta"}), "controller host 1 > here; ");
  WorkerPlacement places = Places();
  places.Put({"controller host 1", "here"});
  EXPECT_EQ(MovesOf(places, {"drain", "beta"}), "");
  // The worker cannot be moved, has no machine, or names a machine that the run does not have.
  places.Put({"controller host 7", "beta"});
  places.Put({"controller host 0", ""});
  places.Put({"controller host 0", "gamma"});
  EXPECT_EQ(MovesOf(places, {"drain", "beta"}), "");
}

std::string HostsOf(std::int64_t more, const std::string& machine = "", std::size_t most = 5)
{
  ControlOrder order{"hosts", {{"change", more}}};
  if (!machine.empty()) order.Set("machine", machine);
  std::string text;
  const std::string refusal = test::MessageOf<std::invalid_argument>(
      [&]
      {
        for (const std::string& host : Places().ReadHosts(order, most)) text += host + " ";
      });
  return refusal.empty() ? text : refusal;
}

// At first one is at alpha, then one at beta.
TEST(WorkerPlacement, HostsComeAndGoAtTheEnd)
{
  EXPECT_EQ(HostsOf(1), "alpha beta here ");
  EXPECT_EQ(HostsOf(3, "beta"), "alpha beta beta beta beta ");
  EXPECT_EQ(HostsOf(-1), "alpha ");
  EXPECT_EQ(HostsOf(-1, "alpha"), "beta ");
  EXPECT_THAT(HostsOf(-2), HasSubstr("the run has 2 controller hosts, and one must remain"));
  EXPECT_THAT(HostsOf(-1, "here"), HasSubstr("so many controller hosts are not at 'here'; they are at alpha, beta"));
  EXPECT_THAT(HostsOf(4), HasSubstr("the run has 2 controller hosts, and can have 5"));
  EXPECT_THAT(HostsOf(1, "gamma"), HasSubstr("no machine 'gamma'"));
  EXPECT_EQ(HostsOf(0), "alpha beta ");
}

TEST(WorkerPlacement, OneHostHasNobodyToShareWith)
{
  const ControlOrder request{"hosts", {{"change", std::int64_t{0}}}};
  const WorkerPlacement places({"here"}, {"space server=here", "controller host 0=here"});
  EXPECT_THAT([&] { places.ReadHosts(request, 9); },
              testing::ThrowsMessage<std::invalid_argument>(HasSubstr("that has all robots")));
}

TEST(WorkerPlacement, HostsNeedASpaceServerThatCanStartAgain)
{
  const ControlOrder request{"hosts", {{"change", std::int64_t{1}}}};
  const WorkerPlacement places({"here", "beta"}, {"space server=beta", "controller host 0=here"});
  EXPECT_THAT([&] { places.ReadHosts(request, 9); },
              testing::ThrowsMessage<std::invalid_argument>(HasSubstr("it is on another machine than the launcher")));
  EXPECT_THROW(WorkerPlacement().ReadHosts(request, 9), std::invalid_argument);
}

TEST(WorkerPlacement, DrainNeedsAnotherMachine)
{
  const WorkerPlacement alone({"alpha"}, {"controller host 0=alpha"});
  EXPECT_THAT(MovesOf(alone, {"drain", "alpha"}), HasSubstr("nowhere to go"));
}

}  // namespace
}  // namespace swarmanoid
