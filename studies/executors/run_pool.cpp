// Each worker is a fork of this process with a socket pair. Orders and outcomes are frames (checked_frame.h). A
// worker answers its orders in their sequence, so that the first order of the list is the one in progress. A worker
// that dies gives a failed outcome for that order, and its replacement gets the others.
#include "studies/executors/run_pool.h"

#include <fmt/format.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "common/activity/failure_report.h"
#include "common/activity/signal_stack.h"
#include "common/checkpoint/library_builds.h"
#include "common/errors/exit_codes.h"
#include "common/memory/memory_limit.h"

namespace swarmanoid
{
namespace
{

constexpr double kShortRun_s = 0.5;

// Returns the bytes of memory that are free or can be freed.
std::uint64_t AvailableMemory()
{
  std::ifstream file("/proc/meminfo");
  for (std::string name; file >> name; file.ignore(200, '\n'))
    if (std::uint64_t kib = 0; name == "MemAvailable:" && file >> kib)
      return std::min(kib * 1024, DefaultMemoryLimit());
  return DefaultMemoryLimit();
}

bool SendFrame(int socket, const ByteWriter& content)
{
  const std::vector<char> frame = Framed(content.Bytes());
  return WriteAll(socket, {frame.data(), frame.size()});
}

// Waits for bytes and adds them to the frames. Returns false at the end of the data.
bool Receive(int socket, FrameReader& frames)
{
  std::array<char, 1U << 16U> bytes;
  const ssize_t got = read(socket, bytes.data(), bytes.size());
  if (got > 0) frames.Add({bytes.data(), static_cast<std::size_t>(got)});
  return got > 0 || (got < 0 && errno == EINTR);
}

[[noreturn]] void Work(const Study& study, const std::string& folder, int socket)
{
  // The runs inherit what is computed here, and need not compute it again.
  EnsureSignalStack();
  OwnBuild();
  FrameReader orders;
  while (Receive(socket, orders))
    while (const auto order = orders.Next())
    {
      ByteReader reader(*order);
      ByteWriter answer;
      WriteFields(answer, RunInCopy(study, folder, ReadFields<RunOrder>(reader)));
      if (!SendFrame(socket, answer)) LeaveAtOnce(0);
    }
  LeaveAtOnce(0);
}

void Pin(int core)
{
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<unsigned>(core), &set);
  sched_setaffinity(0, sizeof set, &set);  // if it is forbidden, the kernel chooses the core
}

}  // namespace

std::vector<int> UsableCores()
{
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores;
  if (sched_getaffinity(0, sizeof set, &set) == 0)
    for (int core = 0; core < CPU_SETSIZE; ++core)
      if (CPU_ISSET(static_cast<unsigned>(core), &set)) cores.push_back(core);
  if (cores.empty()) cores.push_back(0);
  return cores;
}

RunPool::RunPool(const Study& study, std::string folder, unsigned jobs)
    : study_(study), folder_(std::move(folder)), memory_bytes_(AvailableMemory()), workers_(jobs)
{
  for (Worker& worker : workers_) Start(worker);
}

RunPool::~RunPool()
{
  for (const Worker& worker : workers_) kill(worker.process, SIGKILL);
  for (const Worker& worker : workers_)
  {
    while (waitpid(worker.process, nullptr, 0) < 0 && errno == EINTR) continue;
    close(worker.socket);
  }
}

void RunPool::Start(Worker& worker)
{
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::runtime_error(fmt::format("cannot start the processes of the study: {}", std::strerror(errno)));
  const pid_t parent = getpid();
  const std::vector<int> cores = UsableCores();
  const std::size_t number = static_cast<std::size_t>(&worker - workers_.data());
  worker.process = fork();
  if (worker.process < 0)
    throw std::runtime_error(fmt::format("cannot start the processes of the study: {}", std::strerror(errno)));
  if (worker.process == 0)
  {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) LeaveAtOnce(0);
    setpgid(0, 0);  // Ctrl-C at a terminal must reach only the supervising process
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
    for (const Worker& other : workers_)
      if (other.socket >= 0) close(other.socket);
    close(ends[0]);
    if (!study_.cluster) Pin(cores[number % cores.size()]);
    Work(study_, folder_, ends[1]);
  }
  close(ends[1]);
  worker.socket = ends[0];
}

std::size_t RunPool::FreeWorker() const
{
  const std::uint64_t fitting =
      peak_bytes_ == 0 ? workers_.size() : std::max<std::uint64_t>(1, memory_bytes_ / peak_bytes_);
  std::size_t best = workers_.size();
  for (std::size_t w = 0; w < std::min<std::size_t>(workers_.size(), fitting); ++w)
    if (workers_[w].orders.size() < orders_of_worker_ &&
        (best == workers_.size() || workers_[w].orders.size() < workers_[best].orders.size()))
      best = w;
  return best;
}

void RunPool::Give(RunOrder order)
{
  Worker& worker = workers_[FreeWorker()];
  Send(worker, order);
  worker.orders.push_back(std::move(order));
}

// A dead worker is noticed when its answer is awaited.
void RunPool::Send(Worker& worker, const RunOrder& order)
{
  ByteWriter bytes;
  WriteFields(bytes, order);
  SendFrame(worker.socket, bytes);
}

bool RunPool::IsIdle() const
{
  return std::all_of(workers_.begin(), workers_.end(), [](const Worker& worker) { return worker.orders.empty(); });
}

std::vector<RunningRun> RunPool::Running() const
{
  std::vector<RunningRun> runs;
  for (const Worker& worker : workers_)
    if (!worker.orders.empty()) runs.push_back({worker.orders.front().name, ""});
  return runs;
}

std::vector<RunOutcome> RunPool::Wait(std::chrono::milliseconds longest, int input)
{
  std::vector<pollfd> sockets;
  for (const Worker& worker : workers_) sockets.push_back({worker.socket, POLLIN, 0});
  sockets.push_back({input, POLLIN, 0});
  std::vector<RunOutcome> outcomes;
  if (poll(sockets.data(), sockets.size(), static_cast<int>(longest.count())) <= 0) return outcomes;
  for (std::size_t w = 0; w < workers_.size(); ++w)
  {
    if (sockets[w].revents == 0) continue;
    Worker& worker = workers_[w];
    const bool alive = Receive(worker.socket, worker.received);
    TakeOutcomes(worker, outcomes);
    if (!alive) Bury(worker, outcomes);
  }
  return outcomes;
}

void RunPool::TakeOutcomes(Worker& worker, std::vector<RunOutcome>& outcomes)
{
  while (const auto outcome = worker.received.Next())
  {
    ByteReader reader(*outcome);
    outcomes.push_back(ReadFields<RunOutcome>(reader));
    peak_bytes_ = std::max(peak_bytes_, outcomes.back().peak_bytes);
    orders_of_worker_ = outcomes.back().wall_s < kShortRun_s ? 2 : 1;
    worker.orders.pop_front();
  }
}

// Replaces a process that died while it read an experiment, or was killed.
void RunPool::Bury(Worker& worker, std::vector<RunOutcome>& outcomes)
{
  int status = 0;
  while (waitpid(worker.process, &status, 0) < 0 && errno == EINTR) continue;
  close(worker.socket);
  worker.socket = -1;
  worker.received = {};
  if (!worker.orders.empty())
  {
    RunOutcome& outcome = outcomes.emplace_back();
    outcome.name = worker.orders.front().name;
    outcome.exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : static_cast<int>(kExitProcessFailed);
    outcome.failure = WIFSIGNALED(status) ? fmt::format("its process was killed by signal {} ({})", WTERMSIG(status),
                                                        strsignal(WTERMSIG(status)))
                                          : "its process ended while it read the experiment";
    worker.orders.pop_front();
  }
  Start(worker);
  for (const RunOrder& order : worker.orders) Send(worker, order);
}

}  // namespace swarmanoid
