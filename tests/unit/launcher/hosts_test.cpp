#include "launcher/supervision/hosts.h"

#include <gmock/gmock.h>

#include "launcher/command/sub_command.h"
#include "launcher/supervision/cluster_plan.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

std::string ErrorOf(const std::string& text)
{
  return test::MessageOf<UsageError>([&] { Hosts("hosts.txt", text); });
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

TEST(Hosts, FindsTheHostOfOneProcessThenOfItsRole)
{
  const Hosts hosts("hosts.txt",
                    "# a comment\n\nengine ground = alpha\nengine = beta  # the rest\ncontroller_host 0 = localhost\n"
                    "controller_host = gamma\n");
  EXPECT_EQ(hosts.HostOf("engine", "ground"), "alpha");
  EXPECT_EQ(hosts.HostOf("engine", "sky"), "beta");
  EXPECT_EQ(hosts.HostOf("controller_host", "0"), "");
  EXPECT_EQ(hosts.HostOf("controller_host", "1"), "gamma");
  EXPECT_EQ(hosts.HostOf("space_server", ""), "");
  // Regions are with their engine.
  EXPECT_EQ(hosts.HostOf("region", "ground/1"), "alpha");
  EXPECT_EQ(hosts.HostOf("region", "sky/0"), "beta");
  EXPECT_EQ(Hosts("hosts.txt", "engine = beta\nregion ground/1 = delta\n").HostOf("region", "ground/1"), "delta");
  EXPECT_EQ(Hosts("hosts.txt", "engine = beta\nregion = here\n").HostOf("region", "ground/1"), "");
  EXPECT_FALSE(hosts.AllHere());
  EXPECT_TRUE(Hosts().AllHere());
}

TEST(Hosts, StartsBySshWithOneQuotedWord)
{
  const Hosts hosts("hosts.txt", "engine = alpha");
  EXPECT_THAT(hosts.Placed(Worker(), "alpha").arguments,
              ElementsAre("ssh", "-tt", "-o", "BatchMode=yes", "--", "alpha",
                          "env COLOUR=red /opt/bin/engine_worker --engine 'the ground'"));
}

TEST(Hosts, NamesTheMachinesOfAStudy)
{
  const Hosts hosts("hosts.txt",
                    "runs = alpha here\nruns = beta\ncores alpha = 8\nlease = 5\nswarmanoid = /opt/swarmanoid\n");
  const std::vector<RunHost> machines = hosts.RunHosts();
  ASSERT_EQ(machines.size(), 3U);
  EXPECT_EQ(machines[0].name, "alpha");
  EXPECT_EQ(machines[0].cores, 8U);
  EXPECT_EQ(machines[2].name, "beta");
  EXPECT_EQ(machines[2].cores, 0U);
  EXPECT_EQ(hosts.LeaseSeconds(), 5U);
  // Bytes do not pass a terminal as they are.
  EXPECT_THAT(hosts.WorkerCommand("alpha", {"/bin/swarmanoid", "--work"}),
              ElementsAre("ssh", "-T", "-o", "BatchMode=yes", "--", "alpha", "/opt/swarmanoid --work"));
  EXPECT_THAT(hosts.WorkerCommand("here", {"/bin/swarmanoid", "--work"}), ElementsAre("/bin/swarmanoid", "--work"));
  EXPECT_THAT(Hosts("hosts.txt", "command = ip netns exec {host} {command}").WorkerCommand("a", {"/bin/x", "--work"}),
              ElementsAre("ip", "netns", "exec", "a", "/bin/x", "--work"));
}

TEST(Hosts, StartsByATemplateWithTheWordsOfTheCommand)
{
  const Hosts hosts("hosts.txt", "command = ip netns exec {host} {command}\nprogram_folder = /usr/bin\nengine = left");
  const ProcessCommand placed = hosts.Placed(Worker(), "left");
  EXPECT_THAT(placed.arguments, ElementsAre("ip", "netns", "exec", "left", "env", "COLOUR=red",
                                            "/usr/bin/engine_worker", "--engine", "the ground"));
  EXPECT_TRUE(placed.cores.empty());
}

TEST(Hosts, LeavesCommandsOfThisMachineAlone) { EXPECT_EQ(Hosts().Placed(Worker(), "").arguments, Worker().arguments); }

TEST(Hosts, TakesEnginesFromOptions)
{
  Hosts hosts("hosts.txt", "engine ground = alpha");
  hosts.AddEngine("ground=beta");
  EXPECT_EQ(hosts.HostOf("engine", "ground"), "beta");
  EXPECT_THROW(hosts.AddEngine("ground"), UsageError);
  EXPECT_THROW(hosts.AddEngine("=beta"), UsageError);
}

TEST(Hosts, KnowsAllMachinesThatWorkersMayGoTo)
{
  const Hosts hosts("hosts.txt", "engine ground = beta\ncontroller_host = here\nmachines = gamma alpha localhost\n");
  EXPECT_THAT(hosts.Machines(), ElementsAre("alpha", "beta", "gamma"));
  EXPECT_FALSE(Hosts("hosts.txt", "machines = alpha").AllHere());
  EXPECT_TRUE(Hosts("hosts.txt", "machines = here").AllHere());
}

TEST(Hosts, NamesThatACommandCouldTakeForAnOptionAreRefused)
{
  for (const std::string line : {"engine ground = ", "engine = ", "machines = alpha ", "runs = "})
    for (const std::string name : {"-oProxyCommand=date", "--", "$(date)", "a;b", "a`b", "\x1b[2J"})
      EXPECT_THAT(ErrorOf("\n" + line + name),
                  testing::AllOf(testing::StartsWith("hosts.txt:2: "), HasSubstr("is no name of a machine")))
          << line << name;
  EXPECT_THAT(ErrorOf("engine = alpha beta"), HasSubstr("'alpha beta' is no name of a machine"));
  Hosts hosts;
  EXPECT_THROW(hosts.AddEngine("ground=-oProxyCommand=date"), UsageError);
  EXPECT_TRUE(hosts.AllHere());
  for (const std::string name :
       {"alpha", "alpha.example.org", "me@alpha", "10.0.0.7", "fe80::1%eth0", "node_02", "a-b"})
    EXPECT_EQ(Hosts("hosts.txt", "engine = " + name).HostOf("engine", "ground"), name);
}

TEST(Hosts, ErrorsNamePlaceAndCure)
{
  EXPECT_THAT(ErrorOf("\nengin ground = alpha"),
              testing::AllOf(HasSubstr("hosts.txt:2: "), HasSubstr("did you mean 'engine'?")));
  EXPECT_THAT(ErrorOf("engine ground"), HasSubstr("hosts.txt:1: write NAME = VALUE"));
  EXPECT_THAT(ErrorOf("engine a b = c"), HasSubstr("hosts.txt:1"));
  EXPECT_THAT(ErrorOf("command = ssh alpha"), HasSubstr("{host}"));
  EXPECT_THROW(Hosts::FromFile("/nowhere/hosts.txt"), UsageError);
}

TEST(ControllerHosts, MoreThanPayAreNoted)
{
  EXPECT_EQ(NoteAboutControllerHosts(1000, 10, 2),
            "note: --controller-hosts is 1000, and 10 robots have a controller: 10 controller hosts are started");
  EXPECT_EQ(NoteAboutControllerHosts(2, 1, 2),
            "note: --controller-hosts is 2, and 1 robot has a controller: 1 controller host is started");
  EXPECT_EQ(NoteAboutControllerHosts(17, 1000, 2),
            "note: --controller-hosts is 17, and 2 cores are there for them: fewer start and run faster");
  EXPECT_EQ(NoteAboutControllerHosts(16, 1000, 2), "");
  EXPECT_EQ(NoteAboutControllerHosts(17, 1000, 0), "") << "other machines have cores, too";
  EXPECT_EQ(NoteAboutControllerHosts(1, 0, 2), "") << "one host is always there";
}

}  // namespace
}  // namespace swarmanoid
