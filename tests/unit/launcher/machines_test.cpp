#include "launcher/supervision/machines.h"

#include <gmock/gmock.h>

#include "common/program/usage_error.h"
#include "space_server/worker_placement.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

std::string ErrorOf(const std::string& text)
{
  try
  {
    Machines("hosts.txt", text);
  }
  catch (const UsageError& error)
  {
    return error.what();
  }
  return "";
}

ProcessCommand Worker()
{
  ProcessCommand command;
  command.name = "engine 'ground'";
  command.arguments = {"/opt/bin/engine_worker", "--engine", "the ground"};
  command.environment = {{"COLOUR", "red"}};
  command.cores = {1};
  return command;
}

TEST(Machines, FindsTheHostOfOneProcessThenOfItsRole)
{
  const Machines machines(
      "hosts.txt",
      "# a comment\n\nengine ground = alpha\nengine = beta  # the rest\ncontroller_host 0 = localhost\n"
      "controller_host = gamma\n");
  EXPECT_EQ(machines.MachineOf("engine", "ground"), "alpha");
  EXPECT_EQ(machines.MachineOf("engine", "sky"), "beta");
  EXPECT_EQ(machines.MachineOf("controller_host", "0"), kHere);
  EXPECT_EQ(machines.MachineOf("controller_host", "1"), "gamma");
  EXPECT_EQ(machines.MachineOf("space_server", ""), kHere);
  // Regions are with their engine.
  EXPECT_EQ(machines.MachineOf("region", "ground/1"), "alpha");
  EXPECT_EQ(machines.MachineOf("region", "sky/0"), "beta");
  EXPECT_EQ(Machines("hosts.txt", "engine = beta\nregion ground/1 = delta\n").MachineOf("region", "ground/1"), "delta");
  EXPECT_EQ(Machines("hosts.txt", "engine = beta\nregion = here\n").MachineOf("region", "ground/1"), kHere);
  EXPECT_FALSE(machines.AllHere());
  EXPECT_TRUE(Machines().AllHere());
}

TEST(Machines, StartsBySshWithOneQuotedWord)
{
  const Machines machines("hosts.txt", "engine = alpha");
  EXPECT_THAT(machines.CommandOn(Worker(), "alpha").arguments,
              ElementsAre("ssh", "-tt", "-o", "BatchMode=yes", "--", "alpha",
                          "env COLOUR=red /opt/bin/engine_worker --engine 'the ground'"));
}

TEST(Machines, NamesTheMachinesOfAStudy)
{
  const Machines machines("hosts.txt",
                          "runs = alpha here\nruns = beta\ncores alpha = 8\nlease = 5\nswarmanoid = /opt/swarmanoid\n");
  const std::vector<RunMachine> for_runs = machines.ForRuns();
  ASSERT_EQ(for_runs.size(), 3U);
  EXPECT_EQ(for_runs[0].name, "alpha");
  EXPECT_EQ(for_runs[0].cores, 8U);
  EXPECT_EQ(for_runs[2].name, "beta");
  EXPECT_EQ(for_runs[2].cores, 0U);
  EXPECT_EQ(machines.LeaseSeconds(), 5U);
  // Bytes do not pass a terminal as they are.
  EXPECT_THAT(machines.WorkerCommand("alpha", {"/bin/swarmanoid", "--work"}),
              ElementsAre("ssh", "-T", "-o", "BatchMode=yes", "--", "alpha", "/opt/swarmanoid --work"));
  EXPECT_THAT(machines.WorkerCommand("here", {"/bin/swarmanoid", "--work"}), ElementsAre("/bin/swarmanoid", "--work"));
  EXPECT_THAT(
      Machines("hosts.txt", "command = ip netns exec {host} {command}").WorkerCommand("a", {"/bin/x", "--work"}),
      ElementsAre("ip", "netns", "exec", "a", "/bin/x", "--work"));
}

TEST(Machines, StartsByATemplateWithTheWordsOfTheCommand)
{
  const Machines machines("hosts.txt",
                          "command = ip netns exec {host} {command}\nprogram_folder = /usr/bin\nengine = left");
  const ProcessCommand placed = machines.CommandOn(Worker(), "left");
  EXPECT_THAT(placed.arguments, ElementsAre("ip", "netns", "exec", "left", "env", "COLOUR=red",
                                            "/usr/bin/engine_worker", "--engine", "the ground"));
  EXPECT_TRUE(placed.cores.empty());
}

TEST(Machines, LeavesCommandsOfThisMachineAlone)
{
  EXPECT_EQ(Machines().CommandOn(Worker(), kHere).arguments, Worker().arguments);
}

TEST(Machines, TakesEnginesFromOptions)
{
  Machines machines("hosts.txt", "engine ground = alpha");
  machines.AddEngine("ground=beta");
  EXPECT_EQ(machines.MachineOf("engine", "ground"), "beta");
  EXPECT_THROW(machines.AddEngine("ground"), UsageError);
  EXPECT_THROW(machines.AddEngine("=beta"), UsageError);
}

TEST(Machines, KnowsAllMachinesThatWorkersMayGoTo)
{
  const Machines machines("hosts.txt",
                          "engine ground = beta\ncontroller_host = here\nmachines = gamma alpha localhost\n");
  EXPECT_THAT(machines.Names(), ElementsAre("alpha", "beta", "gamma"));
  EXPECT_FALSE(Machines("hosts.txt", "machines = alpha").AllHere());
  EXPECT_TRUE(Machines("hosts.txt", "machines = here").AllHere());
}

TEST(Machines, NamesThatACommandCouldTakeForAnOptionAreRefused)
{
  for (const std::string line : {"engine ground = ", "engine = ", "machines = alpha ", "runs = "})
    for (const std::string name : {"-oProxyCommand=date", "--", "$(date)", "a;b", "a`b", "\x1b[2J"})
      EXPECT_THAT(ErrorOf("\n" + line + name),
                  testing::AllOf(testing::StartsWith("hosts.txt:2: "), HasSubstr("is no name of a machine")))
          << line << name;
  EXPECT_THAT(ErrorOf("engine = alpha beta"), HasSubstr("'alpha beta' is no name of a machine"));
  Machines machines;
  EXPECT_THROW(machines.AddEngine("ground=-oProxyCommand=date"), UsageError);
  EXPECT_TRUE(machines.AllHere());
  for (const std::string name :
       {"alpha", "alpha.example.org", "me@alpha", "10.0.0.7", "fe80::1%eth0", "node_02", "a-b"})
    EXPECT_EQ(Machines("hosts.txt", "engine = " + name).MachineOf("engine", "ground"), name);
}

TEST(Machines, ErrorsNamePlaceAndCure)
{
  EXPECT_THAT(ErrorOf("\nengin ground = alpha"),
              testing::AllOf(HasSubstr("hosts.txt:2: "), HasSubstr("did you mean 'engine'?")));
  EXPECT_THAT(ErrorOf("engine ground"), HasSubstr("hosts.txt:1: write NAME = VALUE"));
  EXPECT_THAT(ErrorOf("engine a b = c"), HasSubstr("hosts.txt:1"));
  EXPECT_THAT(ErrorOf("command = ssh alpha"), HasSubstr("{host}"));
  EXPECT_THROW(Machines::FromFile("/nowhere/hosts.txt"), UsageError);
}

}  // namespace
}  // namespace swarmanoid
