// Attacks by processes that are not members of a run. Everything that they send is refused and reported, and the run
// ends with the hash of an undisturbed one. The same attacks succeed on a run with --insecure, which shows that they
// are real.
#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>

#include <fmt/format.h>

#include "common/bus/membership/control_client.h"
#include "common/bus/security/derived_key.h"
#include "common/run/access/access_grant.h"
#include "common/run/access/run_directory.h"
#include "test_folders.h"
#include "tests/cluster/cluster_fixture.h"
#include "tests/unit/bus/stranger.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using test::PayloadOf;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr std::uint64_t kTicks = 60;
constexpr const char* kTraceLibrary = SWARMANOID_BUILD_FOLDER "/tests/cluster/controllers/libtrace_library.so";

class AttacksTest : public ClusterTest
{
protected:
  AttacksTest() : trace_(folder_ + "/loaded") { setenv("SWARMANOID_TEST_TRACE", trace_.c_str(), 1); }
  ~AttacksTest() override { unsetenv("SWARMANOID_TEST_TRACE"); }

  // Returns the World of a stranger's space server, for an experiment with a controller in the stranger's library.
  std::string ForgedWorld(const std::string& experiment, const std::string& library)
  {
    WorldMessage world;
    world.run = 4711;
    world.experiment = experiment;
    world.host = "elsewhere";
    world.pid = 1;
    world.file = folder_ + "/forged.xml";
    world.folder = folder_;
    std::ifstream stream(WriteExperiment("forged", 1, 10));
    world.xml.assign(std::istreambuf_iterator<char>(stream), {});
    const std::string ours = "library=\"footbot_diffusion\"";
    world.xml.replace(world.xml.find(ours), ours.size(), "library=\"" + library + "\"");
    return PayloadOf(world);
  }

  bool IsLoaded() const { return fs::exists(trace_); }

  // The world of the run on this bus, once it is heard.
  static WorldMessage WorldOn(Bus& bus, const std::string& experiment)
  {
    std::mutex mutex;
    std::optional<WorldMessage> world;
    const Subscription<WorldMessage> worlds(bus, experiment,
                                            [&](const WorldMessage& heard)
                                            {
                                              const std::lock_guard lock(mutex);
                                              world = heard;
                                            });
    EXPECT_TRUE(Eventually(
        [&]
        {
          const std::lock_guard lock(mutex);
          return world.has_value();
        }));
    return world.value_or(WorldMessage());
  }

  BusOptions Options() const
  {
    BusOptions options;
    options.domain = domain_.Id();
    return options;
  }

  // Starts a stranger's program with another DDS. It writes to all topics if no topic is named, and stays.
  ChildProcess StartCyclone(const std::string& experiment, const ChildProcess& engine,
                            const std::vector<std::string>& topics)
  {
    std::vector<std::string> words{SWARMANOID_BUILD_FOLDER "/bin/tests/cyclone_stranger", DomainText(), experiment,
                                   "12", fmt::format("{}:{}", MachineName(), engine.Id())};
    words.insert(words.end(), topics.begin(), topics.end());
    return ChildProcess(words, folder_ + "/cyclone.log");
  }

  const std::string trace_;
};

TEST_F(AttacksTest, AForgedWorldLoadsALibraryIfAnybodyIsLetIn)
{
  options_ = {"--insecure"};
  ChildProcess host = StartHost("lured", 0);
  test::Stranger stranger(domain_.Id(), "lured");
  ASSERT_TRUE(stranger.Send("World", {ForgedWorld("lured", kTraceLibrary)}));
  EXPECT_TRUE(Eventually([&] { return IsLoaded(); })) << host.Output();
}

TEST_F(AttacksTest, AForgedWorldIsNotBelievedAndTheRightOneIs)
{
  ChildProcess host = StartHost("lured", 0);
  test::Stranger stranger(domain_.Id(), "lured");
  ASSERT_TRUE(stranger.Send("World", {ForgedWorld("lured", kTraceLibrary)}));
  ASSERT_TRUE(host.WaitForOutput("dropped a bad World message of an unknown process")) << host.Output();
  EXPECT_THAT(host.Output(), HasSubstr("it is not sealed by the key of this run"));
  const std::string file = WriteExperiment("lured", 1, static_cast<int>(kTicks));
  ChildProcess server = StartServer(file, {"--hash-log", folder_ + "/hashes.txt"});
  ChildProcess engine = StartEngine("lured", 0);
  EXPECT_EQ(server.Wait(), 0) << server.Output();
  EXPECT_EQ(host.Wait(), 0) << host.Output();
  EXPECT_EQ(Read("hashes.txt"), HashesOfSingleProcess(file));
  EXPECT_FALSE(IsLoaded());
}

// A library that differs from the space server's is not loaded, in any folder of the search.
TEST_F(AttacksTest, ALibraryThatTheWorldDoesNotNameByItsDigestIsNotLoaded)
{
  const std::string library = folder_ + "/libfootbot_diffusion.so";
  fs::copy_file(SWARMANOID_BUILD_FOLDER "/lib/swarmanoid/libfootbot_diffusion.so", library);
  const std::string file = WriteExperiment("swapped", 1, 10);
  std::string text = Read("swapped.xml");
  text.replace(text.find("library=\"footbot_diffusion\""), 27, "library=\"" + library + "\"");
  std::ofstream(file) << text;
  ChildProcess server = StartServer(file);
  ASSERT_TRUE(server.WaitForOutput("waiting for")) << server.Output();
  fs::remove(library);
  fs::copy_file(kTraceLibrary, library);
  ChildProcess host = StartHost("swapped", 0);
  EXPECT_EQ(host.Wait(), 3) << host.Output();
  EXPECT_THAT(host.Output(), HasSubstr("it is another file than that of the space server"));
  EXPECT_FALSE(IsLoaded());
}

TEST_F(AttacksTest, WellFormedMessagesOfStrangersChangeNothing)
{
  const std::string file = WriteExperiment("besieged", 1, static_cast<int>(kTicks));
  const std::string output = folder_ + "/run";
  ChildProcess server = StartServer(file, {"--paused", "--hash-log", folder_ + "/hashes.txt", "--output", output});
  std::vector<ChildProcess> workers = StartWorkers("besieged", 1, 1);
  ASSERT_TRUE(server.WaitForOutput("paused at tick 0")) << server.Output();
  Bus bus(Options(), "test");
  const std::uint64_t run = WorldOn(bus, "besieged").run;
  const std::string engine_process = fmt::format("{}:{}", MachineName(), workers[0].Id());

  test::Stranger stranger(domain_.Id(), "besieged");
  const auto send = [&](const std::string& topic, const std::vector<std::string>& payloads)
  { EXPECT_TRUE(stranger.Send(topic, payloads)) << topic; };
  send("ControlRequest", {PayloadOf(ControlRequestMessage{{"stop"}, "host:1", 1, "root"}),
                          PayloadOf(ControlRequestMessage{OrderOf("move robots0_0 1,1,0"), "host:1", 2, "root"})});
  send("Join", {PayloadOf(JoinMessage{"host:1", kProtocolVersion, run, "engine 'e0'", true, 1}),
                PayloadOf(JoinMessage{engine_process, kProtocolVersion + 1, run, "engine 'e0'", true, 0})});
  send("Leave", {PayloadOf(LeaveMessage{run, 0, "engine 'e0'", engine_process, "forged"}),
                 PayloadOf(LeaveMessage{run, 0, "space server", "", "forged"}),
                 PayloadOf(LeaveMessage{run, 0, "space server", engine_process, "forged"})});
  send("Status", {PayloadOf(StatusMessage{run, 0, "engine 'e0'", "forged"})});
  send("RecoveryRequest", {PayloadOf(RecoveryRequestMessage{run, engine_process, "engine 'e0'", 0})});
  send("SavedState", {PayloadOf(SavedStateMessage{run, 0, "engine 'e0'", {'x'}})});
  send("ViewRequest", {PayloadOf(ViewRequestMessage{"host:1", run, 30, true, {5}})});
  send("World", {ForgedWorld("besieged", kTraceLibrary)});

  // A process joins with the name and number of the engine, and ends.
  {
    BusOptions other = Options();
    other.key.emplace().fill(1);
    Bus impostor(other, "engine 'e0'");
    Publisher<LeaveMessage> leave(impostor, "besieged");
    ASSERT_TRUE(Eventually([&] { return leave.Readers() >= 2; }));
    leave.Write({run, 0, "engine 'e0'", engine_process, "forged"});
    leave.WaitUntilRead(1);
  }
  // The messages of a tick do not come by the network at all.
  SpaceState state;
  state.poses.assign(7 * 12, 0.5);
  EngineUpdate update;
  update.poses.assign(7 * 12, 0.5);
  test::Stranger second(domain_.Id(), "besieged");
  EXPECT_TRUE(second.Send("SpaceState", {PayloadOf(MessageHeader{run, 0, 0, false}, state)}, 2));
  EXPECT_TRUE(second.Send("EngineUpdate", {PayloadOf(MessageHeader{run, 1, 0, false}, update)}));

  ControlClient client(bus, "besieged");
  const auto reply = client.Ask({"resume"}, kGenerous_s);
  ASSERT_TRUE(reply && reply->ok) << server.Output();
  EXPECT_EQ(server.Wait(), 0) << server.Output();
  for (ChildProcess& worker : workers) EXPECT_EQ(worker.Wait(), 0) << worker.Output();
  EXPECT_EQ(Read("hashes.txt"), HashesOfSingleProcess(file));
  EXPECT_FALSE(IsLoaded());
  for (const char* topic : {"ControlRequest", "Join", "Leave", "Status", "RecoveryRequest", "SavedState"})
    EXPECT_THAT(server.Output(), HasSubstr(fmt::format("dropped a bad {} message of an unknown process", topic)));
  const std::string events = Read("run/events.csv");
  EXPECT_THAT(events, AllOf(HasSubstr(",refused,"), HasSubstr(",refused,ControlRequest,,an unknown process"),
                            HasSubstr(fmt::format("resume,,,{}@{}", UserName(), ProcessId()))));
  EXPECT_THAT(events, Not(HasSubstr(",stop,")));
}

// Holders of grants use programs of their own. A watcher asks for what only operators may, and an operator for what
// only members may. Both send messages of members and of the server, on the topics of their grant and on those of
// members.
TEST_F(AttacksTest, HoldersOfSharesDoNoMoreThanTheyMay)
{
  const std::string file = WriteExperiment("shared", 1, static_cast<int>(kTicks));
  ChildProcess server =
      StartServer(file, {"--paused", "--hash-log", folder_ + "/hashes.txt", "--output", folder_ + "/run"});
  std::vector<ChildProcess> workers = StartWorkers("shared", 1, 1);
  ASSERT_TRUE(server.WaitForOutput("paused at tick 0")) << server.Output();
  Bus bus(Options(), "test");
  const WorldMessage world = WorldOn(bus, "shared");
  ControlClient member(bus, "shared");
  const RunKey key = *FindLocalRuns().at(0).key;
  const std::string engine_process = fmt::format("{}:{}", MachineName(), workers[0].Id());
  const AccessGrant watcher{"00000001", GrantRole::kWatcher, 0};
  const AccessGrant steerer{"00000002", GrantRole::kOperator, 0};
  for (const AccessGrant& grant : {watcher, steerer})
  {
    const auto made = member.Ask(OrderOf(fmt::format("share {} {} 0", grant.id, RoleWord(grant.role))), kGenerous_s);
    ASSERT_TRUE(made && made->ok) << server.Output();
    const GrantChannel channel = ChannelOf(key, grant);

    BusOptions of_grant = Options();
    of_grant.key = channel.key;
    of_grant.grant = channel;
    Bus side(of_grant, "engine 'e0'");
    ControlClient client(side, "shared", world.run);
    std::vector<std::string> forbidden{"share 00000003 operate 0", "revoke 00000001", "shares"};
    if (grant.role == GrantRole::kWatcher) forbidden.insert(forbidden.end(), {"stop", "resume", "move fb 1,1,0"});
    for (const std::string& words : forbidden)
    {
      const auto reply = client.Ask(OrderOf(words), kGenerous_s);
      ASSERT_TRUE(reply.has_value()) << words;
      EXPECT_FALSE(reply->ok) << words;
    }
    Publisher<LeaveMessage> leave(side, "shared");
    ASSERT_TRUE(Eventually([&] { return leave.Readers() > 0; }));
    leave.Write({world.run, 0, "engine 'e0'", engine_process, "forged"});
    leave.Write({world.run, 0, "space server", "", "forged"});
    leave.WaitUntilRead(1);

    // The holder writes to the topics of the members with the key of the grant.
    of_grant.grant.reset();
    Bus impostor(of_grant, "engine 'e0'");
    Publisher<LeaveMessage> members_leave(impostor, "shared");
    Publisher<ControlRequestMessage> requests(impostor, "shared");
    ASSERT_TRUE(Eventually([&] { return members_leave.Readers() >= 2 && requests.Readers() >= 1; }));
    members_leave.Write({world.run, 0, "engine 'e0'", engine_process, "forged"});
    members_leave.Write({world.run, 0, "space server", "", "forged"});
    requests.Write({{"stop"}, "host:1", 1, "root", world.run});
    members_leave.WaitUntilRead(1);
    requests.WaitUntilRead(1);
  }
  const auto reply = member.Ask({"resume"}, kGenerous_s);
  ASSERT_TRUE(reply && reply->ok) << server.Output();
  EXPECT_EQ(server.Wait(), 0) << server.Output();
  for (ChildProcess& worker : workers) EXPECT_EQ(worker.Wait(), 0) << worker.Output();
  EXPECT_EQ(Read("hashes.txt"), HashesOfSingleProcess(file));
  const std::string events = Read("run/events.csv");
  EXPECT_THAT(events, AllOf(HasSubstr("by watcher grant 00000001"), HasSubstr("by operator grant 00000002"),
                            Not(HasSubstr(",stop,")), Not(HasSubstr(",revoke,"))));
  EXPECT_THAT(server.Output(), HasSubstr("dropped a bad Leave message of 'engine 'e0''"));
}

// Fast DDS counts them one by one, and hears no other process meanwhile.
TEST_F(AttacksTest, WhoSaysThatWhatHeSaidIsLostIsNotWaitedFor)
{
  ChildProcess server = StartServer(WriteExperiment("counting", 1, 0), {"--paused"});
  std::vector<ChildProcess> workers = StartWorkers("counting", 1, 1);
  ASSERT_TRUE(server.WaitForOutput("paused at tick 0")) << server.Output();
  test::Stranger stranger(domain_.Id(), "counting");
  ASSERT_TRUE(stranger.Met("ControlRequest", 1));
  const WriterId writer = stranger.Writer("ControlRequest");
  // From its writer to any reader: all messages from 1 to 2⁴⁸ are lost.
  std::string gap("RTPS\2\3\1\17", 8);
  gap.append(writer.data(), 12).append("\x08\1\x20\0\0\0\0\0", 8).append(writer.data() + 12, 4);
  gap.append("\0\0\0\0\1\0\0\0\0\0\1\0\0\0\0\0\0\0\0\0", 20).append(4, '\0');
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  for (int participant = 0; participant < 20; ++participant)
  {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(7411 + 250 * domain_.Id() + 2 * participant));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    sendto(socket, gap.data(), gap.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }
  close(socket);
  ASSERT_TRUE(stranger.Send("ControlRequest", {PayloadOf(ControlRequestMessage{{"stop"}, "host:1", 1, "root"})}));
  ASSERT_TRUE(Ask("counting", "stop")) << server.Output();
  EXPECT_EQ(server.Wait(), 0) << server.Output();
}

// A request to one run is not executed in another run with the same key.
TEST_F(AttacksTest, ARequestToAnotherRunOfTheKeyIsRefused)
{
  std::ofstream(folder_ + "/key") << std::string(64, '1') << "\n";
  fs::permissions(folder_ + "/key", fs::perms(0600));
  ChildProcess server = StartServer(WriteExperiment("again", 1, 0), {"--paused", "--key", folder_ + "/key"});
  BusOptions options = Options();
  options.key = KeyOfFile(folder_ + "/key");
  Bus bus(options, "test");
  const WorldMessage world = WorldOn(bus, "again");
  Publisher<ControlRequestMessage> requests(bus, "again");
  ASSERT_TRUE(Eventually([&] { return requests.Readers() == 1; }));
  requests.Write({{"stop"}, "host:1", 1, "root", world.run + 1});
  EXPECT_TRUE(server.WaitForOutput("it was asked of another run")) << server.Output();
}

// The same requests are executed if every process is let in.
TEST_F(AttacksTest, AStrangerStopsARunThatLetsAnybodyIn)
{
  options_ = {"--insecure"};
  ChildProcess server = StartServer(WriteExperiment("open", 1, 0), {"--paused"});
  std::vector<ChildProcess> workers = StartWorkers("open", 1, 1);
  ASSERT_TRUE(server.WaitForOutput("paused at tick 0")) << server.Output();
  test::Stranger stranger(domain_.Id(), "open");
  ASSERT_TRUE(stranger.Send("ControlRequest", {PayloadOf(ControlRequestMessage{{"stop"}, "host:1", 1})}));
  EXPECT_EQ(server.Wait(), 0) << server.Output();
  EXPECT_THAT(server.Output(), HasSubstr("finished: 0 ticks"));
}

// Does the same with a program of another DDS: its messages affect a run that lets every process in.
TEST_F(AttacksTest, AProgramOfAnotherDdsIsObeyedIfAnybodyIsLetIn)
{
  options_ = {"--insecure", "--lease", "600"};  // the engine may sleep
  const std::string file = WriteExperiment("open", 1, static_cast<int>(kTicks));
  BusOptions options = Options();
  options.insecure = true;
  // Runs `meanwhile` on a paused run, to whose topic the stranger writes.
  const auto run = [&](const std::string& topic, const auto& meanwhile)
  {
    ChildProcess server = StartServer(file, {"--paused", "--hash-log", folder_ + "/hashes.txt"});
    std::vector<ChildProcess> workers = StartWorkers("open", 1, 1);
    ASSERT_TRUE(server.WaitForOutput("paused at tick 0")) << server.Output();
    ChildProcess stranger = StartCyclone("open", workers[0], {topic});
    ASSERT_TRUE(stranger.WaitForOutput("done, run known")) << stranger.Output();
    meanwhile(server, workers[0]);
  };
  run("ControlRequest",
      [](ChildProcess& server, const ChildProcess&)
      {
        EXPECT_EQ(server.Wait(), 0) << server.Output();
        EXPECT_THAT(server.Output(), HasSubstr("finished: 0 ticks"));
      });
  run("Leave",
      [](ChildProcess& server, const ChildProcess&)
      {
        EXPECT_NE(server.Wait(), 0);
        EXPECT_THAT(server.Output(), HasSubstr("engine 'e0' failed at tick 0: forged"));
      });
  run("EngineUpdate",
      [&](const ChildProcess& server, const ChildProcess& engine)
      {
        // A sleeping engine has not answered tick 0.
        ASSERT_TRUE(engine.StopAsleep());
        Bus bus(options, "test");
        ControlClient client(bus, "open");
        EXPECT_TRUE(client.Ask({"resume"}, kGenerous_s).has_value());
        EXPECT_TRUE(server.WaitForOutput("tick 1: waiting for engine 'e0'")) << server.Output();
      });
}

TEST_F(AttacksTest, AProgramOfAnotherDdsIsRefused)
{
  const std::string file = WriteExperiment("closed", 1, static_cast<int>(kTicks));
  ChildProcess server =
      StartServer(file, {"--paused", "--hash-log", folder_ + "/hashes.txt", "--output", folder_ + "/run"});
  std::vector<ChildProcess> workers = StartWorkers("closed", 1, 1);
  ASSERT_TRUE(server.WaitForOutput("paused at tick 0")) << server.Output();
  ChildProcess stranger = StartCyclone("closed", workers[0], {});
  ASSERT_TRUE(stranger.WaitForOutput("done, run unknown")) << stranger.Output();
  for (const char* topic :
       {"ControlRequest", "Join", "Leave", "Status", "RecoveryRequest", "SavedState", "ViewRequest"})
  {
    EXPECT_THAT(stranger.Output(), HasSubstr(fmt::format("{} written", topic)));
    EXPECT_TRUE(server.WaitForOutput(fmt::format("dropped a bad {} message of an unknown process", topic)))
        << server.Output();
  }
  ASSERT_TRUE(Ask("closed", "resume")) << server.Output();
  EXPECT_EQ(server.Wait(), 0) << server.Output();
  for (ChildProcess& worker : workers) EXPECT_EQ(worker.Wait(), 0) << worker.Output();
  stranger.Signal(SIGKILL);
  stranger.Wait();
  EXPECT_EQ(Read("hashes.txt"), HashesOfSingleProcess(file));
  EXPECT_THAT(Read("run/events.csv"), HasSubstr(",refused,ControlRequest,,an unknown process"));
}

TEST_F(AttacksTest, OnlyTheUserOfARunCanOpenItsKeyAndItsMemory)
{
  ChildProcess server = StartServer(WriteExperiment("private", 1, 0), {"--paused"});
  std::vector<ChildProcess> workers = StartWorkers("private", 1, 1);
  ASSERT_TRUE(server.WaitForOutput("paused at tick 0")) << server.Output();
  const std::vector<LocalRun> runs = FindLocalRuns();
  ASSERT_EQ(runs.size(), 1U);
  ASSERT_TRUE(runs[0].key.has_value());
  EXPECT_EQ(fs::status(runs[0].directory).permissions(), fs::perms::owner_all);
  EXPECT_EQ(fs::status(runs[0].directory + "/key").permissions(), fs::perms(0600));
  for (const ChildProcess& process : workers)
  {
    std::ifstream words(fmt::format("/proc/{}/cmdline", process.Id()));
    std::ifstream environment(fmt::format("/proc/{}/environ", process.Id()));
    const std::string all{std::istreambuf_iterator<char>(words), {}};
    const std::string more{std::istreambuf_iterator<char>(environment), {}};
    EXPECT_THAT(all + more, Not(HasSubstr(TextOfKey(*runs[0].key))));
  }
  if (getuid() != 0) GTEST_SKIP() << "only root can be another user";
  const std::vector<std::string> nobody{"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "cat"};
  for (const char* name : {"key", "server"})
  {
    std::vector<std::string> words = nobody;
    words.push_back(runs[0].directory + "/" + name);
    ChildProcess cat(words, folder_ + "/cat.log");
    EXPECT_NE(cat.Wait(), 0);
    EXPECT_THAT(cat.Output(), HasSubstr("Permission denied"));
  }
}

// A user without the key sends a request with the simulator's own command. The reason of the refusal is printed to that
// user and in the run.
TEST_F(AttacksTest, WhoHasAnotherKeyIsToldAndTheRunGoesOn)
{
  const std::string file = WriteExperiment("keyed", 1, static_cast<int>(kTicks));
  std::ofstream(folder_ + "/right") << std::string(64, '1') << "\n";
  std::ofstream(folder_ + "/wrong") << std::string(64, '2') << "\n";
  for (const char* name : {"/right", "/wrong"}) fs::permissions(folder_ + name, fs::perms(0600));
  ChildProcess server =
      StartServer(file, {"--hash-log", folder_ + "/hashes.txt", "--key", folder_ + "/right", "--output", folder_});
  ChildProcess wrong = Start("engine_worker", {"--experiment", "keyed", "--engine", "e0", "--key", folder_ + "/wrong"});
  ASSERT_TRUE(wrong.WaitForOutput("dropped a bad World message of 'space server'")) << wrong.Output();
  EXPECT_TRUE(wrong.WaitForOutput("waiting for the space server of 'keyed'")) << wrong.Output();
  ChildProcess engine =
      Start("engine_worker", {"--experiment", "keyed", "--engine", "e0", "--key", folder_ + "/right"});
  ChildProcess host = Start("controller_host", {"--experiment", "keyed", "--key", folder_ + "/right"});
  EXPECT_EQ(server.Wait(), 0) << server.Output();
  EXPECT_EQ(engine.Wait(), 0) << engine.Output();
  EXPECT_EQ(host.Wait(), 0) << host.Output();
  EXPECT_EQ(Read("hashes.txt"), HashesOfSingleProcess(file));
}

}  // namespace
}  // namespace swarmanoid
