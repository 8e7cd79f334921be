// Problem: execute runs for a study on another machine, and leave nothing there, whatever dies.
//
// Method: two processes. The guard makes a scratch folder and forks the service, which executes runs and answers. If
// the study goes, or the service ends or hangs, the guard kills it, waits for its orphans, and removes the folder. If
// the guard itself is killed, the service removes the folder at its end. Messages carry a lease: each side counts as
// gone if it is silent for longer.
#include "studies/executors/study_worker.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <thread>

#include "common/activity/failure_report.h"
#include "common/configuration/configuration_tree.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/math/reproducible_math.h"
#include "common/program/file_descriptor.h"
#include "common/program/interrupts.h"
#include "launcher/system/scratch_folder.h"
#include "simulation/register_all.h"
#include "studies/executors/checked_frame.h"
#include "studies/executors/run_pool.h"
#include "studies/executors/slurm_batch.h"
#include "studies/runs/run_files.h"
#include "studies/runs/study_setup.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using Seconds = std::chrono::seconds;

constexpr std::uint64_t kMostBytesBack = 1ULL << 28U;  // the limit for the files of a run
constexpr Seconds kFirstLease(120);                    // until the setup has arrived

// The worker's end of the pipes to the study.
class StudyLine
{
public:
  StudyLine(int in, int out) : in_(in), out_(out) {}

  // Returns false if the study did not read the message during the lease, or has gone.
  bool Send(StudyMessage kind, const ByteWriter& content = {})
  {
    const std::vector<char> frame = FramedMessage(kind, content.Bytes());
    // A pipe that is ready accepts this number of bytes without waiting.
    for (std::size_t at = 0; at < frame.size();)
    {
      pollfd ready{out_, POLLOUT, 0};
      const int count = poll(&ready, 1, static_cast<int>(std::chrono::milliseconds(lease).count()));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      const ssize_t written = write(out_, frame.data() + at, std::min<std::size_t>(frame.size() - at, PIPE_BUF));
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) return false;
      at += static_cast<std::size_t>(written);
    }
    said_ = Clock::now();
    return true;
  }

  // Waits for data, at most for `longest`; returns false at the end.
  bool Receive(std::chrono::milliseconds longest)
  {
    pollfd ready{in_, POLLIN, 0};
    const int count = poll(&ready, 1, static_cast<int>(longest.count()));
    if (count <= 0) return Clock::now() - heard_ < lease;
    char bytes[1U << 16U];
    const ssize_t got = read(in_, bytes, sizeof bytes);
    if (got < 0) return errno == EINTR;
    heard_ = Clock::now();
    frames_.Add({bytes, static_cast<std::size_t>(got)});
    return got > 0;
  }

  std::optional<std::vector<char>> Next() { return frames_.Next(); }
  bool IsDue() const { return Clock::now() - said_ > lease / 4; }
  int In() const { return in_; }

  Seconds lease = kFirstLease;

private:
  using Clock = std::chrono::steady_clock;

  int in_, out_;
  FrameReader frames_;
  Clock::time_point heard_ = Clock::now(), said_ = Clock::now();
};

// Removes and returns the kind of a message.
StudyMessage KindOf(ByteReader& bytes) { return bytes.Get<StudyMessage>(); }

std::optional<std::vector<char>> AwaitSetup(StudyLine& line)
{
  for (;;)
  {
    if (auto content = line.Next()) return content;
    if (Interrupted() || !line.Receive(1s)) return std::nullopt;
  }
}

bool SendBack(StudyLine& line, const std::string& folder, const RunOutcome& outcome)
{
  const std::string own = folder + "/runs/" + outcome.name.Text();
  ByteWriter answer;
  WriteFields(answer, outcome);
  WriteFields(answer, RunFiles::Collect(own, kMostBytesBack));
  std::error_code none;
  std::filesystem::remove_all(own, none);
  return line.Send(StudyMessage::kOutcome, answer);
}

void RunWhatComes(StudyLine& line, const Study& study, const std::string& folder, unsigned jobs)
{
  RunPool pool(study, folder, jobs);
  ByteWriter ready;
  ready.Put(static_cast<std::uint32_t>(jobs));
  bool goes_on = line.Send(StudyMessage::kReady, ready);
  std::deque<RunOrder> waiting;
  while (goes_on && !Interrupted())
  {
    for (; !waiting.empty() && pool.HasRoom(); waiting.pop_front()) pool.Give(waiting.front());
    for (const RunOutcome& outcome : pool.Wait(500ms, line.In())) goes_on = goes_on && SendBack(line, folder, outcome);
    goes_on = goes_on && line.Receive(0ms);
    while (auto content = line.Next())
    {
      ByteReader bytes(*content);
      if (KindOf(bytes) == StudyMessage::kOrder) waiting.push_back(ReadFields<RunOrder>(bytes));
    }
    if (goes_on && line.IsDue()) goes_on = line.Send(StudyMessage::kStillHere);
  }
}

// Plug-ins print to standard error, since standard output belongs to the study.
int ServeStudy(const std::string& folder)
{
  CatchInterrupts();
  const FileDescriptor out(fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3));
  dup2(STDERR_FILENO, STDOUT_FILENO);
  StudyLine line(STDIN_FILENO, out.Get());
  try
  {
    const auto setup = AwaitSetup(line);
    if (!setup) return kExitUsage;
    ByteReader bytes(*setup);
    KindOf(bytes);
    line.lease = Seconds(bytes.Get<std::uint32_t>());
    const auto asked = bytes.Get<std::uint32_t>();
    RequireReproducibleMath();
    RegisterBuiltins();
    const std::size_t head = sizeof(StudyMessage) + 2 * sizeof(std::uint32_t);
    const std::unique_ptr<Study> study = TakeUp(std::span(*setup).subspan(head));
    RunWhatComes(line, *study, folder,
                 asked != 0       ? asked
                 : study->cluster ? 1
                                  : static_cast<unsigned>(UsableCores().size()));
  }
  catch (const std::exception& error)
  {
    ByteWriter reason;
    reason.PutText(error.what());
    line.Send(StudyMessage::kRefused, reason);
    return kExitProcessFailed;
  }
  return kExitDone;
}

// Runs end with the process that made them. Afterwards no process writes into the folder while it is removed.
void AwaitOrphans()
{
  for (int wait = 0; wait < 500 && waitpid(-1, nullptr, WNOHANG) >= 0; ++wait) std::this_thread::sleep_for(10ms);
}

// Guards the serving process, which may be killed or hang. When it has ended, or the study has gone, the guard removes
// all that is left of it.
int GuardService()
{
  constexpr auto kPatience = 3s;  // for an orderly end
  const ScratchFolder folder;
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  const pid_t own = getpid();
  const pid_t service = fork();
  if (service == 0)
  {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    if (getppid() != own) LeaveAtOnce(0);
    const int code = ServeStudy(folder.Path());
    // The guard may have been killed.
    AwaitOrphans();
    std::error_code none;
    if (getppid() != own) std::filesystem::remove_all(folder.Path(), none);
    LeaveAtOnce(code);
  }
  if (service < 0) throw std::runtime_error(fmt::format("cannot start a process: {}", std::strerror(errno)));
  close(STDOUT_FILENO);
  const FileDescriptor end(static_cast<int>(syscall(SYS_pidfd_open, service, 0)));
  pollfd watched[2] = {{end.Get(), POLLIN, 0}, {STDIN_FILENO, POLLRDHUP, 0}};
  while (poll(watched, 2, -1) < 0 && errno == EINTR) continue;
  if (watched[0].revents == 0)
  {
    poll(watched, 1, static_cast<int>(std::chrono::milliseconds(kPatience).count()));
    kill(service, SIGKILL);
  }
  int status = 0;
  while (waitpid(service, &status, 0) < 0 && errno == EINTR) continue;
  AwaitOrphans();
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

unsigned CoresOfTask()
{
  const char* given = std::getenv("SLURM_CPUS_PER_TASK");
  const auto cores = given == nullptr ? std::nullopt : ParseInteger(given);
  return cores && *cores > 0 ? static_cast<unsigned>(*cores) : 1;
}

// Executes a task of Slurm. The files of its runs are in the study's folder, as if they had run on the machine that
// began the study.
int RunTask(const std::string& folder, std::size_t task)
{
  RequireReproducibleMath();
  RegisterBuiltins();
  const std::unique_ptr<Study> study = TakeUp(SlurmBatch::ReadSetup(folder));
  const std::string study_folder = std::filesystem::path(folder).parent_path().parent_path();
  const std::vector<RunOrder> orders = SlurmBatch::ReadOrders(folder, task);
  RunPool pool(*study, study_folder, study->cluster ? 1 : CoresOfTask());
  for (std::size_t next = 0; next < orders.size() || !pool.IsIdle();)
  {
    for (; next < orders.size() && pool.HasRoom(); ++next)
      if (!SlurmBatch::HasResult(folder, orders[next].name)) pool.Give(orders[next]);
    for (RunOutcome& outcome : pool.Wait(1s))
    {
      outcome.host = NameOfThisHost();
      SlurmBatch::WriteResult(folder, outcome);
    }
  }
  return kExitDone;
}

}  // namespace

std::vector<char> FramedMessage(StudyMessage kind, std::span<const char> content)
{
  std::vector<char> message(1 + content.size());
  message.front() = static_cast<char>(kind);
  std::ranges::copy(content, message.begin() + 1);
  return Framed(message);
}

int RunStudyWorker(const std::vector<std::string>& words)
{
  try
  {
    if (words.empty()) return GuardService();
    const auto task = words.size() == 2 ? ParseInteger(words[1]) : std::nullopt;
    if (!task) throw std::runtime_error("a task has two words: the folder of its jobs, and its number");
    return RunTask(words[0], static_cast<std::size_t>(*task));
  }
  catch (const std::exception& error)
  {
    PrintError("{}\n", error.what());
    return kExitProcessFailed;
  }
}

}  // namespace swarmanoid
