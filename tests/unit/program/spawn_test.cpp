// A started program inherits only what it is given.
#include "common/program/spawn.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <thread>

#include "common/program/file_descriptor.h"
#include "common/program/process.h"

namespace swarmanoid
{
namespace
{

using testing::MatchesRegex;

// Returns the standard output of a shell script, followed by its exit code.
std::string OutputOf(const std::string& script, SpawnSettings settings = {.words = {}})
{
  Pipe output = MakePipe();
  fcntl(output.read.Get(), F_SETFL, 0);
  settings.words = {"sh", "-c", script};
  settings.output = output.write.Get();
  const pid_t process = Spawn(settings);
  output.write.Reset();
  std::string text;
  char bytes[4096];
  for (ssize_t got = 0; (got = read(output.read.Get(), bytes, sizeof bytes)) > 0;)
    text.append(bytes, static_cast<std::size_t>(got));
  int status = 0;
  EXPECT_EQ(waitpid(process, &status, 0), process);
  return text + std::to_string(WEXITSTATUS(status));
}

TEST(Spawn, ReadsNothingAndWritesWhereItIsTold)
{
  EXPECT_EQ(OutputOf("cat; echo lost >&2; echo said; exit 3"), "said\n3");
  Pipe input = MakePipe();
  fcntl(input.read.Get(), F_SETFL, 0);
  ASSERT_EQ(write(input.write.Get(), "given\n", 6), 6);
  input.write.Reset();
  EXPECT_EQ(OutputOf("cat", {.words = {}, .input = input.read.Get()}), "given\n0");
  EXPECT_EQ(OutputOf("echo $OWN $HOME", {.words = {}, .environment = {{"OWN", "1"}, {"HOME", "/x"}}}), "1 /x\n0");
}

TEST(Spawn, InheritsNoDescriptorButThoseThatAreGiven)
{
  // The file is opened without O_CLOEXEC, as by a library that knows nothing of child processes.
  const FileDescriptor open_file(open("/dev/null", O_RDONLY));
  const FileDescriptor kept(open("/dev/null", O_RDONLY | O_CLOEXEC));
  const std::string is_open = "for f in {} {}; do test -e /proc/self/fd/$f && echo $f; done; true";
  EXPECT_EQ(OutputOf(fmt::format(fmt::runtime(is_open), open_file.Get(), kept.Get())), "0");
  EXPECT_EQ(
      OutputOf(fmt::format(fmt::runtime(is_open), open_file.Get(), kept.Get()), {.words = {}, .kept = kept.Get()}),
      fmt::format("{}\n0", kept.Get()));
}

TEST(Spawn, IgnoresAndBlocksNoSignals)
{
  const auto before = std::signal(SIGUSR1, SIG_IGN);
  sigset_t blocked, mask;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &blocked, &mask);
  EXPECT_THAT(OutputOf("grep -E 'Sig(Blk|Ign)' /proc/self/status"), MatchesRegex("SigBlk:\t0+\nSigIgn:\t0+\n0"));
  pthread_sigmask(SIG_SETMASK, &mask, nullptr);
  std::signal(SIGUSR1, before);
}

TEST(Spawn, RunsOnTheCoresAndInTheGroupThatAreAskedFor)
{
  const int core = AvailableCores().back();
  EXPECT_EQ(OutputOf("grep Cpus_allowed_list /proc/self/status", {.words = {}, .cores = {core}}),
            fmt::format("Cpus_allowed_list:\t{}\n0", core));
  const std::string group = "test $(cut -d' ' -f5 /proc/$$/stat) = $$ && echo own || echo other";
  EXPECT_EQ(OutputOf(group), "other\n0");
  EXPECT_EQ(OutputOf(group, {.words = {}, .leads_group = true}), "own\n0");
}

TEST(Spawn, DiesWithTheThreadThatStartedItIfItIsTo)
{
  pid_t process = 0;
  std::thread([&] { process = Spawn({.words = {"sleep", "1000"}, .signal_at_our_end = SIGKILL}); }).join();
  int status = 0;
  ASSERT_EQ(waitpid(process, &status, 0), process);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

TEST(Spawn, ThrowsIfThereIsNoSuchProgram)
{
  for (const auto& [name, says] : {std::pair("", "cannot start '/nowhere/at_all': No such file or directory"),
                                   std::pair("it", "cannot start it: '/nowhere/at_all': No such file or directory")})
    try
    {
      Spawn({.words = {"/nowhere/at_all"}, .name = name});
      FAIL();
    }
    catch (const std::runtime_error& error)
    {
      EXPECT_STREQ(error.what(), says);
    }
  // No child is left to wait for.
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
}

}  // namespace
}  // namespace swarmanoid
