// The processes that execute runs: connections to machines, machines that get lost, Slurm's commands and files.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "common/program/usage_error.h"
#include "studies/executors/machine_connection.h"
#include "studies/executors/machine_pool.h"
#include "studies/executors/run_pool.h"
#include "studies/executors/slurm.h"
#include "studies/executors/slurm_batch.h"
#include "studies/runs/run_files.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

constexpr int kTries = 6000;  // of 10 ms, which no machine needs

// Exchanges until a message has come or the other side has gone.
std::optional<std::vector<char>> AwaitMessage(MachineConnection& connection)
{
  for (int i = 0; i < kTries; ++i)
  {
    const bool is_there = connection.Exchange();
    if (auto message = connection.Next()) return message;
    if (!is_there) return std::nullopt;
    std::this_thread::sleep_for(10ms);
  }
  ADD_FAILURE() << "no message, and no end";
  return std::nullopt;
}

// Returns why a connection to a shell command ended.
std::string EndOfShell(const std::string& command)
{
  MachineConnection connection({"sh", "-c", command});
  connection.Close();
  EXPECT_FALSE(AwaitMessage(connection));
  return connection.End();
}

TEST(MachineConnection, CarriesMessagesBothWays)
{
  MachineConnection connection({"cat"});
  EXPECT_TRUE(connection.Exchange()) << "nothing has come yet";
  EXPECT_FALSE(connection.Next());
  connection.Send(StudyMessage::kStillHere);
  connection.Send(StudyMessage::kRefused, std::vector<char>{'n', 'o'});
  EXPECT_EQ(AwaitMessage(connection), (std::vector<char>{static_cast<char>(StudyMessage::kStillHere)}));
  EXPECT_EQ(AwaitMessage(connection), (std::vector<char>{static_cast<char>(StudyMessage::kRefused), 'n', 'o'}));
  EXPECT_GE(connection.Heard(), connection.Said());
  // A pipe has space for less than this.
  const std::vector<char> large(3'000'000, 'x');
  connection.Send(StudyMessage::kOrder, large);
  EXPECT_NE(connection.InputIfFull(), -1);
  const auto got = AwaitMessage(connection);
  ASSERT_TRUE(got);
  EXPECT_EQ(got->size(), large.size() + 1);
  EXPECT_EQ(connection.InputIfFull(), -1);
  connection.Close();
  EXPECT_FALSE(AwaitMessage(connection));
  EXPECT_EQ(connection.End(), "its connection ended");
}

TEST(MachineConnection, TellsWhyItEnded)
{
  EXPECT_EQ(EndOfShell("echo first >&2; echo '  no such host ' >&2; echo >&2; exit 3"),
            "its connection ended with exit code 3: no such host");
  EXPECT_EQ(EndOfShell("echo welcome; echo 'password expired'; exit 1"),
            "its connection ended with exit code 1: password expired");
  EXPECT_EQ(EndOfShell("echo welcome; echo cause >&2; exit 255"), "its connection ended with exit code 255: cause");
  EXPECT_EQ(EndOfShell("exit 0"), "its connection ended");
  EXPECT_EQ(EndOfShell("kill -9 $$"), "its connection was killed by signal 9 (Killed)");
  // The last words of a long text.
  EXPECT_EQ(EndOfShell("i=0; while [ $i -lt 3000 ]; do echo line $i; i=$((i + 1)); done >&2; exit 2"),
            "its connection ended with exit code 2: line 2999");
  const std::string end = EndOfShell("head -c 1000 /dev/zero | tr '\\0' y >&2; exit 2");
  EXPECT_EQ(end, "its connection ended with exit code 2: " + std::string(500, 'y'));
  EXPECT_THROW(MachineConnection({"/nowhere/program"}), std::runtime_error);
}

TEST(MachineConnection, FramesOfAnotherKindAreErrors)
{
  MachineConnection connection({"sh", "-c", "head -c 70000 /dev/zero"});
  connection.Close();
  EXPECT_THROW(AwaitMessage(connection), FrameError);
}

RunOrder OrderNamed(std::uint32_t point, std::uint64_t seed)
{
  return {{point, seed}, "e.xml", {{"framework.maxclock", "3"}}};
}

// A pool of machines that are shell scripts: they send what a file has when they have received `wait` bytes.
class ScriptedMachines : public testing::Test
{
protected:
  static std::string Text(const std::vector<char>& bytes) { return {bytes.begin(), bytes.end()}; }
  static std::string Ready(std::uint32_t slots)
  {
    ByteWriter bytes;
    bytes.Put(slots);
    return Text(FramedMessage(StudyMessage::kReady, bytes.Bytes()));
  }
  static std::string Result(const RunName& name, const RunFiles& files = {}, double wall_s = 10)
  {
    RunOutcome outcome;
    outcome.name = name;
    outcome.wall_s = wall_s;
    outcome.ticks = 3;
    ByteWriter bytes;
    WriteFields(bytes, outcome);
    WriteFields(bytes, files);
    return Text(FramedMessage(StudyMessage::kOutcome, bytes.Bytes()));
  }
  static std::size_t BytesOfOrder()
  {
    ByteWriter bytes;
    WriteFields(bytes, OrderNamed(1, 1));
    return FramedMessage(StudyMessage::kOrder, bytes.Bytes()).size();
  }
  std::size_t BytesOfSetup() const { return FramedMessage(StudyMessage::kSetup, setup).size() + 8; }

  // A machine that sends `first` at once and `second` when `orders` orders have come; then it runs `last`.
  void Machine(const std::string& name, const std::string& first, std::size_t orders, const std::string& second,
               const std::string& last = "cat >/dev/null")
  {
    folder.Write(name + ".first", first);
    folder.Write(name + ".second", second);
    const std::string here = folder.Path() + "/" + name;
    folder.Write(name + ".sh", "cat " + here + ".first\nhead -c " +
                                   std::to_string(BytesOfSetup() + orders * BytesOfOrder()) + " >" + here +
                                   ".received\ncat " + here + ".second\n" + last + "\n");
  }
  MachinePool PoolOf(const std::string& lines)
  {
    return {Machines("hosts.txt", "command = sh " + folder.Path() + "/{host}.sh {shell_command}\n" + lines), setup,
            folder.Path() + "/out"};
  }
  // Waits until so many outcomes have come.
  static std::vector<RunOutcome> Await(Executor& pool, std::size_t count)
  {
    std::vector<RunOutcome> outcomes;
    for (int i = 0; i < kTries && outcomes.size() < count; ++i)
      for (RunOutcome& outcome : pool.Wait(10ms)) outcomes.push_back(std::move(outcome));
    EXPECT_EQ(outcomes.size(), count);
    return outcomes;
  }
  static void AwaitSlots(Executor& pool, unsigned slots)
  {
    for (int i = 0; i < kTries && pool.Slots() < slots; ++i) pool.Wait(10ms);
    EXPECT_EQ(pool.Slots(), slots);
  }

  const std::vector<char> setup{'s', 'e', 't'};
  test::TemporaryFolder folder;
};

TEST_F(ScriptedMachines, ResultsComeBackWithTheirFiles)
{
  Machine("alpha", Ready(1), 1, Result({7, 7}) + Result({1, 2}, {{{"sub/log.txt", {'h', 'i'}}}, {"large.bin"}}));
  MachinePool pool = PoolOf("runs = alpha\ncores alpha = 1\nlease = 40\n");
  EXPECT_EQ(pool.Slots(), 0U);
  EXPECT_FALSE(pool.HasRoom()) << "it is not ready";
  EXPECT_TRUE(pool.IsIdle());
  AwaitSlots(pool, 1);
  EXPECT_TRUE(pool.HasRoom());
  pool.Give(OrderNamed(1, 2));
  EXPECT_FALSE(pool.HasRoom());
  EXPECT_FALSE(pool.IsIdle());
  const auto running = pool.Running();
  ASSERT_EQ(running.size(), 1U);
  EXPECT_EQ(running[0].name, (RunName{1, 2}));
  EXPECT_EQ(running[0].where, "alpha");
  // The result of a run that was not requested does not count.
  const auto outcomes = Await(pool, 1);
  ASSERT_EQ(outcomes.size(), 1U);
  EXPECT_EQ(outcomes[0].name, (RunName{1, 2}));
  EXPECT_EQ(outcomes[0].host, "alpha");
  EXPECT_EQ(folder.Read("out/runs/1-2/sub/log.txt"), "hi");
  EXPECT_THAT(pool.TakeNotes(), ElementsAre("run 1-2: 'large.bin' is too large to come back from alpha"));
  EXPECT_THAT(pool.TakeNotes(), IsEmpty());
  EXPECT_TRUE(pool.IsIdle());
  EXPECT_THAT(pool.Running(), IsEmpty());
  // The machine received the lease, the number of runs at a time, and the setup.
  const std::string received = folder.Read("alpha.received");
  FrameReader reader;
  reader.Add(received);
  ByteWriter expected;
  expected.Put(StudyMessage::kSetup);
  expected.Put(std::uint32_t{40});
  expected.Put(std::uint32_t{1});
  std::vector<char> bytes = expected.Bytes();
  bytes.insert(bytes.end(), setup.begin(), setup.end());
  EXPECT_EQ(reader.Next(), bytes);
  const auto order = reader.Next();
  ASSERT_TRUE(order);
  ByteReader fields(*order);
  EXPECT_EQ(fields.Get<StudyMessage>(), StudyMessage::kOrder);
  EXPECT_EQ(ReadFields<RunOrder>(fields).settings, OrderNamed(1, 2).settings);
}

TEST_F(ScriptedMachines, RunsOfALostMachineGoToAnother)
{
  // The first machine ends when it has two orders; the second one has their results then.
  Machine("alpha", Ready(2), 2, "", "echo gone >&2; exit 3");
  Machine("beta", Ready(1), 2, Result({1, 1}) + Result({1, 2}));
  MachinePool pool = PoolOf("runs = alpha beta\n");
  AwaitSlots(pool, 3);
  // Each order goes to the machine with the fewest orders for a slot: the first one of equal ones.
  pool.Give(OrderNamed(1, 1));
  pool.Give(OrderNamed(1, 2));
  pool.Give(OrderNamed(1, 3));
  std::map<std::string, int> counts;
  for (const RunningRun& run : pool.Running()) ++counts[run.where];
  EXPECT_THAT(counts, ElementsAre(Pair("alpha", 2), Pair("beta", 1)));
  EXPECT_FALSE(pool.HasRoom());
  std::vector<std::string> notes;
  for (int i = 0; i < kTries && notes.empty(); ++i)
  {
    pool.Wait(10ms);
    notes = pool.TakeNotes();
  }
  EXPECT_THAT(notes, ElementsAre("alpha is left out: its connection ended with exit code 3: gone; its runs go to the "
                                 "others"));
  EXPECT_EQ(pool.Slots(), 1U);
}

TEST_F(ScriptedMachines, NoMachineIsLeft)
{
  ByteWriter reason;
  reason.PutText("another version");
  Machine("alpha", Text(FramedMessage(StudyMessage::kRefused, reason.Bytes())), 0, "");
  Machine("beta", "", 0, "", "exit 4");
  MachinePool pool = PoolOf("runs = alpha beta\n");
  std::string told;
  for (int i = 0; i < kTries && told.empty(); ++i) told = test::MessageOf<RunPlaceError>([&] { pool.Wait(10ms); });
  EXPECT_EQ(told, "no machine of --hosts is left: alpha: another version; beta: its connection ended with exit code 4");
  EXPECT_THAT(pool.TakeNotes(),
              testing::UnorderedElementsAre("alpha is left out: another version",
                                            "beta is left out: its connection ended with exit code 4"));
}

TEST_F(ScriptedMachines, ShortRunsAreOrderedAhead)
{
  // Runs of 0.1 s: five more than one for each slot.
  Machine("alpha", Ready(2), 1, Result({1, 1}, {}, 0.1));
  MachinePool pool = PoolOf("runs = alpha\n");
  AwaitSlots(pool, 2);
  pool.Give(OrderNamed(1, 1));
  Await(pool, 1);
  int given = 0;
  for (; pool.HasRoom() && given < 100; ++given) pool.Give(OrderNamed(2, static_cast<std::uint64_t>(given)));
  EXPECT_EQ(given, 12);
  EXPECT_EQ(pool.Running().size(), 2U);
}

TEST(RunFiles, AreCollectedWithTheLogFirstAndKept)
{
  const test::TemporaryFolder folder;
  folder.Write("run/a.csv", "1,2");
  folder.Write("run/b/log.txt", "why");
  folder.Write("run/large.bin", std::string(100, 'x'));
  const std::string run = folder.Path() + "/run";
  std::filesystem::create_symlink(run + "/a.csv", run + "/link.csv");
  const RunFiles all = RunFiles::Collect(run, 1000);
  std::vector<std::string> names;
  for (const auto& [name, content] : all.files) names.push_back(name);
  EXPECT_THAT(names, ElementsAre("b/log.txt", "a.csv", "large.bin"));
  EXPECT_THAT(all.left_out, IsEmpty());
  const RunFiles some = RunFiles::Collect(run, 6);
  EXPECT_EQ(some.files.size(), 2U) << "each of both has three bytes";
  EXPECT_THAT(some.left_out, ElementsAre("large.bin"));
  EXPECT_THAT(RunFiles::Collect(run, 5).left_out, ElementsAre("a.csv", "large.bin"));
  EXPECT_THAT(RunFiles::Collect(folder.Path() + "/nothing", 5).files, IsEmpty());

  folder.Write("kept/old.txt", "old");
  ByteWriter bytes;
  WriteFields(bytes, all);
  ByteReader reader(bytes.Bytes());
  RunFiles::Read(reader).Keep(folder.Path() + "/kept");
  EXPECT_EQ(folder.Read("kept/b/log.txt"), "why");
  EXPECT_EQ(folder.Read("kept/large.bin").size(), 100U);
  EXPECT_FALSE(std::filesystem::exists(folder / "kept/old.txt"));
  folder.Write("file", "");
  EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { all.Keep(folder.Path() + "/file/below"); }),
              HasSubstr("cannot write '"));
}

// Slurm's commands, as scripts that note their words.
class FakeSlurm : public testing::Test
{
protected:
  FakeSlurm() : path_(std::getenv("PATH")) { setenv("PATH", (folder.Path() + ":" + path_).c_str(), 1); }
  ~FakeSlurm() override { setenv("PATH", path_.c_str(), 1); }

  void Command(const std::string& name, const std::string& says) const
  {
    const std::string file =
        folder.Write(name, "#!/bin/sh\nfor word; do echo \"$word\"; done >" + folder.Path() + "/words\n" + says + "\n");
    chmod(file.c_str(), 0755);
  }
  std::string Words() const { return folder.Read("words"); }

  test::TemporaryFolder folder;

private:
  const std::string path_;
};

TEST_F(FakeSlurm, ArraysAreSubmitted)
{
  Command("sbatch", "echo 'sbatch: warning of the site' >&2; echo '123 tasks are many'; echo '4711;cluster'");
  EXPECT_EQ(SubmitArray("/s/run.sh", "/s/task-%a.log", 3, 0, {"--time=1"}), "4711");
  EXPECT_EQ(Words(),
            "--parsable\n--job-name=swarmanoid\n--open-mode=append\n--output=/s/task-%a.log\n--array=0-2\n--time=1\n"
            "/s/run.sh\n");
  Command("sbatch", "echo 815");
  EXPECT_EQ(SubmitArray("r", "l", 1, 5, {}), "815");
  EXPECT_THAT(Words(), HasSubstr("--array=0-0%5\n"));
  Command("sbatch", "echo no job today");
  EXPECT_THAT(test::MessageOf<SlurmError>([] { SubmitArray("r", "l", 1, 0, {}); }), HasSubstr("sbatch named no job: "));
  Command("sbatch", "echo ' invalid partition ' >&2; exit 1");
  EXPECT_EQ(test::MessageOf<SlurmError>([] { SubmitArray("r", "l", 1, 0, {}); }), "invalid partition");
  Command("sbatch", "exit 1");
  EXPECT_EQ(test::MessageOf<SlurmError>([] { SubmitArray("r", "l", 1, 0, {}); }), "sbatch failed without a word");
  Command("scancel", "");
  CancelJob("4711");
  EXPECT_EQ(Words(), "4711\n");
}

TEST_F(FakeSlurm, TasksAreReadFromItsQueue)
{
  Command(
      "squeue",
      "echo '7_0|RUNNING|node1|None'; echo '7_12|PENDING||Priority'; echo 'a warning'; echo '7_3|COMPLETED|node2|'");
  const auto tasks = TasksOf("7");
  EXPECT_THAT(Words(), HasSubstr("--jobs=7\n"));
  ASSERT_EQ(tasks.size(), 3U);
  EXPECT_EQ(tasks.at(0).state, "RUNNING");
  EXPECT_EQ(tasks.at(0).nodes, "node1");
  EXPECT_EQ(tasks.at(12).state, "PENDING");
  EXPECT_EQ(tasks.at(12).nodes, "");
  EXPECT_EQ(tasks.at(12).reason, "Priority");
  EXPECT_TRUE(tasks.at(3).HasEnded());
  Command("squeue", "echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1");
  EXPECT_THAT(TasksOf("7"), IsEmpty());
  Command("squeue", "echo 'Unable to contact slurm controller' >&2; exit 1");
  EXPECT_THROW(TasksOf("7"), SlurmError);
  for (const char* state : {"COMPLETED", "CANCELLED", "FAILED", "TIMEOUT", "NODE_FAIL", "PREEMPTED", "BOOT_FAIL",
                            "DEADLINE", "OUT_OF_MEMORY", "REVOKED"})
    EXPECT_TRUE((SlurmTask{state, "", ""}).HasEnded()) << state;
  for (const char* state : {"RUNNING", "PENDING", "COMPLETING", "SUSPENDED", "CONFIGURING", ""})
    EXPECT_FALSE((SlurmTask{state, "", ""}).HasEnded()) << state;
}

TEST(SlurmBatch, HasOrdersAndResultsInFiles)
{
  const test::TemporaryFolder folder;
  const std::vector<RunOrder> orders = {OrderNamed(0, 1), OrderNamed(0, 2), OrderNamed(1, 1), OrderNamed(1, 2),
                                        OrderNamed(2, 1)};
  const std::vector<char> setup{'x', 'y'};
  SlurmBatch batch = SlurmBatch::Create(folder.Path(), setup, orders, 2);
  const std::string own = folder.Path() + "/slurm/1";
  EXPECT_EQ(batch.Script(), own + "/run.sh");
  EXPECT_EQ(batch.LogPattern(), own + "/task-%a.log");
  EXPECT_THAT(folder.Read("slurm/1/run.sh"), testing::MatchesRegex("#!/bin/sh\nexec .*unit_studies.* --study-worker " +
                                                                   own + " \"\\$SLURM_ARRAY_TASK_ID\"\n"));
  EXPECT_THAT(batch.Outstanding(),
              ElementsAre(Pair(0, ElementsAre(RunName{0, 1}, RunName{0, 2})),
                          Pair(1, ElementsAre(RunName{1, 1}, RunName{1, 2})), Pair(2, ElementsAre(RunName{2, 1}))));
  EXPECT_EQ(SlurmBatch::ReadSetup(own), setup);
  const std::vector<RunOrder> of_task = SlurmBatch::ReadOrders(own, 1);
  ASSERT_EQ(of_task.size(), 2U);
  EXPECT_EQ(of_task[1].name, (RunName{1, 2}));
  EXPECT_EQ(SlurmBatch::ReadOrders(own, 2).size(), 1U);
  EXPECT_THROW(SlurmBatch::ReadOrders(own, 3), std::runtime_error);
  // A batch that was not submitted has no results to take.
  EXPECT_THAT(SlurmBatch::FindAll(folder.Path()), IsEmpty());
  batch.SetJob("4711");
  EXPECT_EQ(SlurmBatch::FindAll(folder.Path()).at(0).Job(), "4711");

  EXPECT_FALSE(SlurmBatch::HasResult(own, {1, 2}));
  RunOutcome outcome;
  outcome.name = {1, 2};
  outcome.ticks = 77;
  SlurmBatch::WriteResult(own, outcome);
  EXPECT_TRUE(SlurmBatch::HasResult(own, {1, 2}));
  folder.Write("slurm/1/results/0-1", "torn");
  folder.Write("slurm/1/results/9-9", "of another batch");
  folder.Write("slurm/1/results/notes", "");
  auto taken = batch.TakeResults();
  ASSERT_EQ(taken.size(), 2U);
  std::ranges::sort(taken, {}, &RunOutcome::name);
  EXPECT_EQ(taken[0].name, (RunName{0, 1}));
  EXPECT_EQ(taken[0].exit_code, 4);
  EXPECT_THAT(taken[0].failure, HasSubstr("its result is damaged: "));
  EXPECT_EQ(taken[1].ticks, 77U);
  EXPECT_TRUE(taken[1].IsDone());
  EXPECT_THAT(batch.TakeResults(), IsEmpty());
  EXPECT_THAT(batch.Outstanding().at(1), ElementsAre(RunName{1, 1}));
  batch.RemoveTaken();
  EXPECT_TRUE(SlurmBatch::HasResult(own, {1, 2})) << "taken ones stay known";
  SlurmBatch found = std::move(SlurmBatch::FindAll(folder.Path()).at(0));
  EXPECT_EQ(found.Outstanding(), batch.Outstanding());
  EXPECT_THAT(found.TakeResults(), IsEmpty());

  EXPECT_EQ(batch.LastLineOfTask(0), "");
  folder.Write("slurm/1/task-0.log", "one\nthe cause\n\n");
  EXPECT_EQ(batch.LastLineOfTask(0), "the cause");
  batch.KeepLogOfTask(0, {0, 2});
  batch.KeepLogOfTask(1, {1, 1});
  EXPECT_EQ(folder.Read("runs/0-2/slurm.log"), "one\nthe cause\n\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "runs/1-1"));
  SlurmBatch second = SlurmBatch::Create(folder.Path(), setup, orders, 9);
  EXPECT_EQ(second.Script(), folder.Path() + "/slurm/2/run.sh");
  EXPECT_EQ(second.Outstanding().size(), 1U);
  batch.Remove();
  EXPECT_FALSE(std::filesystem::exists(own));
  second.Remove();
  EXPECT_FALSE(std::filesystem::exists(folder / "slurm"));
}

TEST(SlurmOptions, AQuoteMustBeClosed)
{
  EXPECT_THAT(test::MessageOf<UsageError>([] { SlurmOptions("--comment='two"); }), HasSubstr("a quote is not closed"));
  EXPECT_THAT(SlurmOptions("--comment=\"it's\" -n\t2\n-A x"), ElementsAre("--comment=it's", "-n", "2", "-A", "x"));
  for (const char* own : {"--error=x", "-e", "--job-name", "-Jx", "--chdir=/", "-D/", "--wait", "-W", "--wrap=x"})
    EXPECT_THROW(SlurmOptions(own), UsageError) << own;
  EXPECT_THAT(test::MessageOf<UsageError>([] { SlurmOptions("--array=1-3"); }), HasSubstr("--jobs N is the number"));
  EXPECT_THAT(SlurmOptions("--wait-all-nodes=1 --errors"), ElementsAre("--wait-all-nodes=1", "--errors"));
}

TEST(RunPool, CoresAreThoseOfThisProcess)
{
  const std::vector<int> cores = UsableCores();
  EXPECT_FALSE(cores.empty());
  EXPECT_TRUE(std::ranges::is_sorted(cores));
  EXPECT_GE(cores.front(), 0);
}

}  // namespace
}  // namespace swarmanoid
