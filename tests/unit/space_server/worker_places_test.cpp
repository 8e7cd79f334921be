// Where workers may go, and what is told to those who ask for what cannot be.
#include "space_server/worker_places.h"

#include <gmock/gmock.h>

#include <stdexcept>

namespace swarmanoid
{
namespace
{

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const WorkerPlaces& Places()
{
  static const WorkerPlaces places({"here", "alpha", "beta"},
                                   {"space server=here", "engine 'ground'=alpha", "engine 'a to b'=alpha",
                                    "controller host 0=alpha", "controller host 1=beta", "visualiser 'x=y'=here"});
  return places;
}

ControlRequestMessage Request(const std::string& verb, const std::string& entity)
{
  ControlRequestMessage request;
  request.verb = verb;
  request.entity = entity;
  return request;
}

std::string MovesOf(const WorkerPlaces& places, const std::string& verb, const std::string& entity)
{
  std::string text;
  try
  {
    for (const auto& [worker, machine] : places.Read(Request(verb, entity))) text += worker + " > " + machine + "; ";
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return text;
}

std::string MovesOf(const std::string& verb, const std::string& entity) { return MovesOf(Places(), verb, entity); }

TEST(WorkerPlaces, FindTheWorkerAndItsMachine)
{
  EXPECT_EQ(MovesOf("move-host", "1"), "controller host 1 > beta; ");
  EXPECT_EQ(MovesOf("move-host", "1 to alpha"), "controller host 1 > alpha; ");
  EXPECT_EQ(MovesOf("move-engine", "ground to here"), "engine 'ground' > here; ");
  EXPECT_EQ(MovesOf("move-engine", "a to b"), "engine 'a to b' > alpha; ");
  EXPECT_EQ(MovesOf("move-engine", "a to b to beta"), "engine 'a to b' > beta; ");
}

TEST(WorkerPlaces, FindTheRegionsOfAnEngine)
{
  const WorkerPlaces places({"here", "beta"}, {"engine 'ground'=here", "region 0 of engine 'ground'=here",
                                               "region 1 of engine 'ground'=beta", "engine 'a/1'=here"});
  EXPECT_EQ(MovesOf(places, "move-engine", "ground/1"), "region 1 of engine 'ground' > beta; ");
  EXPECT_EQ(MovesOf(places, "move-engine", "ground/0 to beta"), "region 0 of engine 'ground' > beta; ");
  EXPECT_EQ(MovesOf(places, "move-engine", "ground to beta"), "engine 'ground' > beta; ");
  EXPECT_EQ(MovesOf(places, "move-engine", "a/1"), "engine 'a/1' > here; ");
  EXPECT_EQ(MovesOf(places, "drain", "beta"), "region 1 of engine 'ground' > here; ");
  EXPECT_THAT(MovesOf(places, "move-engine", "ground/2"), HasSubstr("region 1 of engine 'ground'"));
}

TEST(WorkerPlaces, RefuseWhatIsNotThere)
{
  EXPECT_THAT(MovesOf("move-host", "2"), AllOf(HasSubstr("no controller host 2"), HasSubstr("controller host 1")));
  EXPECT_THAT(MovesOf("move-host", "1 to gamma"), AllOf(HasSubstr("no machine 'gamma'"), HasSubstr("machines = ")));
  EXPECT_THAT(MovesOf("drain", "bet"), HasSubstr("did you mean 'beta'?"));
  EXPECT_THAT(MovesOf("drain", "here"), HasSubstr("the space server is at 'here'"));
  EXPECT_THAT(MovesOf(WorkerPlaces(), "move-host", "0"), HasSubstr("no process of this run can be moved"));
  EXPECT_THROW(WorkerPlaces({}, {"engine"}), std::invalid_argument);
}

// The machine of a worker offers itself anew after all processes have started again.
TEST(WorkerPlaces, WorkersOfMachinesThatAreNotHeardAreNamed)
{
  WorkerPlaces places({"here"}, {"space server=here", "controller host 0=beta", "engine 'ground'=here"});
  EXPECT_EQ(places.Text(), "here: engine 'ground', space server; beta (not offered now): controller host 0");
  EXPECT_THAT(MovesOf(places, "drain", "beta"), AllOf(HasSubstr("not offered now"), HasSubstr("in a moment")));
  EXPECT_TRUE(places.Offer("beta", "host:1"));
  EXPECT_EQ(places.Text(), "here: engine 'ground', space server; beta (offered by host:1): controller host 0");
  EXPECT_EQ(MovesOf(places, "drain", "beta"), "controller host 0 > here; ");
}

std::string HostsAfter(const WorkerPlaces& places, double more)
{
  ControlRequestMessage request = Request("hosts", "");
  request.numbers = {more};
  std::string text;
  for (const std::string& machine : places.ReadHosts(request, 10)) text += machine + " ";
  return text;
}

TEST(WorkerPlaces, OfferedMachinesAreUsedUntilTheyGo)
{
  WorkerPlaces places = Places();
  EXPECT_TRUE(places.Offer("gamma", "host:1"));
  EXPECT_FALSE(places.Offer("gamma", "host:1"));
  EXPECT_THROW(places.Offer("gamma", "host:2"), std::invalid_argument);
  EXPECT_THROW(places.Offer("alpha", "host:2"), std::invalid_argument);
  EXPECT_THROW(WorkerPlaces().Offer("gamma", "host:1"), std::invalid_argument);
  EXPECT_EQ(MovesOf(places, "move-host", "1 to gamma"), "controller host 1 > gamma; ");
  EXPECT_EQ(places.Text(),
            "here: space server, visualiser 'x=y'; alpha: controller host 0, engine 'a to b', engine 'ground'; beta: "
            "controller host 1; gamma (offered by host:1): nobody");

  // New controller hosts go where somebody offers a machine.
  EXPECT_TRUE(places.Offer("delta", "host:3"));
  EXPECT_EQ(HostsAfter(places, 3), "alpha beta delta gamma delta ");
  EXPECT_EQ(places.Gone("host:3"), "delta");
  EXPECT_EQ(places.Gone("host:3"), std::nullopt);
  EXPECT_EQ(HostsAfter(places, 1), "alpha beta gamma ");
  EXPECT_THAT(MovesOf(places, "move-host", "1 to delta"), HasSubstr("controller_host --offer NAME"));

  places.Put({"controller host 1", "gamma"});
  EXPECT_THROW(places.Withdraw("gamma", "host:9"), std::invalid_argument);
  const auto moves = places.Withdraw("gamma", "host:1");
  ASSERT_EQ(moves.size(), 1U);
  EXPECT_EQ(moves[0].worker + " > " + moves[0].machine, "controller host 1 > beta");
  EXPECT_EQ(HostsAfter(places, 1), "alpha gamma here ");
  // Asked again of a space server that knows nothing of the offer.
  EXPECT_EQ(places.Withdraw("gamma", "host:1").size(), 1U);
  places.Put(moves[0]);
  EXPECT_THAT(places.Text(), Not(HasSubstr("gamma")));
}

TEST(OfferedMachineName, IsAPlainWord)
{
  for (const char* good : {"beta", "a", "lab-7.example_2"}) EXPECT_EQ(MachineNameMistake(good), "");
  for (const char* bad : {"", "a b", "a=b", "-x", "a/b", "über"})
    EXPECT_THAT(MachineNameMistake(bad), HasSubstr("letters, digits")) << bad;
  EXPECT_THAT(MachineNameMistake(std::string(64, 'a')), HasSubstr("up to 63"));
  for (const char* taken : {"here", "localhost"}) EXPECT_THAT(MachineNameMistake(taken), HasSubstr("launcher's"));
}

// Whoever offers may be a program that did not look at the name.
TEST(WorkerPlaces, TakeNoOtherName)
{
  WorkerPlaces places = Places();
  for (const char* bad : {"", "a b", "a=b", "-x", "a/b", "über", "a\nb", "here", "localhost"})
  {
    std::string said;
    try
    {
      places.Offer(bad, "host:2");
    }
    catch (const std::invalid_argument& error)
    {
      said = error.what();
    }
    EXPECT_THAT(said, AllOf(HasSubstr("is no name of a machine"), HasSubstr(MachineNameMistake(bad)))) << bad;
  }
  EXPECT_THAT(places.Text(), Not(HasSubstr("offered by")));
}

// They write files in the folder of the run.
TEST(WorkerPlaces, VisualisersDoNotGoToOfferedMachines)
{
  WorkerPlaces places({"here", "alpha"}, {"space server=here", "visualiser 'v'=alpha", "controller host 0=alpha"});
  EXPECT_TRUE(places.Offer("gamma", "host:1"));
  EXPECT_EQ(MovesOf(places, "drain", "alpha"), "controller host 0 > gamma; visualiser 'v' > here; ");
}

// Two workers are at beta or here each; those of alpha go where the fewest are.
TEST(WorkerPlaces, DrainGivesToThoseWhoHaveTheFewest)
{
  EXPECT_EQ(MovesOf("drain", "alpha"), "controller host 0 > beta; engine 'a to b' > beta; engine 'ground' > here; ");
  EXPECT_EQ(MovesOf("drain", "beta"), "controller host 1 > here; ");
  WorkerPlaces places = Places();
  places.Put({"controller host 1", "here"});
  EXPECT_EQ(MovesOf(places, "drain", "beta"), "");
  // Of nobody who moves, and of one who does not say where it is.
  places.Put({"controller host 7", "beta"});
  places.Put({"controller host 0", ""});
  EXPECT_EQ(MovesOf(places, "drain", "beta"), "");
}

std::string HostsOf(double more, const std::string& machine = "", std::size_t most = 5)
{
  ControlRequestMessage request = Request("hosts", machine);
  request.numbers = {more};
  std::string text;
  try
  {
    for (const std::string& host : Places().ReadHosts(request, most)) text += host + " ";
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return text;
}

// At first one at alpha, then one at beta.
TEST(WorkerPlaces, HostsComeAndGoAtTheEnd)
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
  EXPECT_THAT(HostsOf(0.5), HasSubstr("write +N or -N"));
  EXPECT_THAT(HostsOf(std::nan("")), HasSubstr("write +N or -N"));
}

TEST(WorkerPlaces, OneHostHasNobodyToShareWith)
{
  ControlRequestMessage request = Request("hosts", "");
  request.numbers = {0};
  const WorkerPlaces places({"here"}, {"space server=here", "controller host 0=here"});
  EXPECT_THAT([&] { places.ReadHosts(request, 9); },
              testing::ThrowsMessage<std::invalid_argument>(HasSubstr("that has all robots")));
}

TEST(WorkerPlaces, HostsNeedASpaceServerThatCanStartAgain)
{
  ControlRequestMessage request = Request("hosts", "");
  request.numbers = {1};
  const WorkerPlaces places({"here", "beta"}, {"space server=beta", "controller host 0=here"});
  EXPECT_THAT([&] { places.ReadHosts(request, 9); },
              testing::ThrowsMessage<std::invalid_argument>(HasSubstr("it is on another machine than the launcher")));
  EXPECT_THROW(WorkerPlaces().ReadHosts(request, 9), std::invalid_argument);
}

TEST(WorkerPlaces, DrainNeedsAnotherMachine)
{
  const WorkerPlaces alone({"alpha"}, {"controller host 0=alpha"});
  EXPECT_THAT(MovesOf(alone, "drain", "alpha"), HasSubstr("nowhere to go"));
}

}  // namespace
}  // namespace swarmanoid
