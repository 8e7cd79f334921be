#include "launcher/command/doctor.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "common/errors/exit_codes.h"
#include "common/plugins/own_library.h"
#include "common/program/file_descriptor.h"
#include "common/run/access/dds_environment.h"
#include "common/run/access/run_directory.h"
#include "engine_worker/engines/rigid_bodies/fused_libraries.h"
#include "launcher/showing.h"
#include "launcher/system/command_process.h"
#include "launcher/system/installation.h"
#include "simulation/run_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr double kMiB = 1024.0 * 1024.0;
constexpr double kSharedMemory_MiB = 128;  // a run of 10,000 robots takes less
constexpr double kDisk_MiB = 500;
constexpr rlim_t kOpenFiles = 512;
constexpr const char* kSample = "sample_footbot";
constexpr const char* kMulticastGroup = "239.255.0.1";  // the group of DDS discovery (RTPS 2.2, 9.6.1.4.1)

double FreeMiB(const std::string& folder)
{
  struct statvfs space
  {
  };
  if (statvfs(folder.c_str(), &space) != 0) return 0;
  return static_cast<double>(space.f_bavail) * static_cast<double>(space.f_frsize) / kMiB;
}

// A short run of a sample: its hash, or the first line of its complaint.
struct Trial
{
  std::string hash;
  std::string complaint;
};

Trial TryRun(const fs::path& folder, const std::string& name, const std::vector<std::string>& options)
{
  const fs::path output = folder / name, errors = folder / (name + ".log");
  std::vector<std::string> words{OwnProgram(), "run", SampleFile(kSample), "--quiet", "--no-visualisers",
                                 "--ticks",    "50",  "--output",          output};
  words.insert(words.end(), options.begin(), options.end());
  Trial trial;
  if (CommandProcess(words, errors).Wait() == kExitDone) trial.hash = ReadManifest(output).value("state_hash", "");
  if (trial.hash.empty()) trial.complaint = FirstLineOf(errors);
  if (trial.hash.empty() && trial.complaint.empty()) trial.complaint = "it ended without a word";
  return trial;
}

Finding OneProcess(const Trial& trial)
{
  if (trial.hash.empty())
    return {"run", Verdict::kBad, "in one process: " + trial.complaint, "install Swarmanoid again, or build it again"};
  return {"run", Verdict::kGood, "50 ticks in one process, hash " + trial.hash};
}

Finding Cluster(const Trial& here, const Trial& cluster)
{
  if (cluster.hash.empty())
    return {"DDS", Verdict::kBad, "a cluster on this machine: " + cluster.complaint,
            "look at shared memory and ports below; a firewall must let UDP to 127.0.0.1 pass"};
  if (cluster.hash != here.hash)
    return {"DDS", Verdict::kBad,
            fmt::format("a cluster ends with hash {}, one process with {}", cluster.hash, here.hash),
            "this is a defect: report it with the output of `swarmanoid doctor --json`"};
  return {"DDS", Verdict::kGood, "the processes of a cluster meet, and end with the same hash"};
}

Finding Rounding()
{
  std::vector<std::string> fused;
  try
  {
    reinterpret_cast<decltype(&FindFusedLibraries)>(FunctionOfOwnLibrary("rigid_bodies", "FindFusedLibraries"))(fused);
  }
  catch (const std::runtime_error& error)
  {
    return {"physics", Verdict::kBad, fmt::format("the engines with Box2D and ODE cannot be loaded: {}", error.what()),
            "install Swarmanoid again"};
  }
  if (fused.empty()) return {"physics", Verdict::kGood, "Box2D and ODE round as on other machines"};
  return {"physics", Verdict::kLimited,
          fmt::format("{} use fused multiply-add: experiments with their engines have other results than on x86-64",
                      fmt::join(fused, " and ")),
          "build the libraries again without it (docs/installing.md, Systems)"};
}

Finding DdsVariables()
{
  std::string set;
  for (const std::string& name : DdsVariablesThatAreSet())
    if (name != "SKIP_DEFAULT_XML") set += (set.empty() ? "" : ", ") + name;
  const char* kept = std::getenv(kKeepDdsVariables);
  const bool keeps = kept != nullptr && std::string_view(kept) == "1";
  if (set.empty()) return {"variables of DDS", Verdict::kGood, "none is set"};
  if (!keeps)
    return {"variables of DDS", Verdict::kGood,
            fmt::format("{}: the processes of a run ignore them ({}=1 keeps them)", set, kKeepDdsVariables)};
  return {"variables of DDS", Verdict::kLimited,
          fmt::format("{}: the processes of a run obey them, as {} is 1", set, kKeepDdsVariables),
          fmt::format("unset {} if processes do not meet", kKeepDdsVariables)};
}

Finding SharedMemory()
{
  const std::string folder = fs::path(SharedFolder()).parent_path();
  const std::string cure =
      "mount a larger tmpfs at /dev/shm (in a container: --shm-size=1g), or name another folder in memory by "
      "SWARMANOID_SHARED_FOLDER";
  std::string probe = folder + "/swarmanoid-XXXXXX";
  if (mkdtemp(probe.data()) == nullptr)
    return {"shared memory", Verdict::kBad, fmt::format("{}: {}", folder, std::strerror(errno)), cure};
  rmdir(probe.c_str());
  const double free = FreeMiB(folder);
  const std::string what = fmt::format("{} has {:.0f} MiB free", folder, free);
  if (free < kSharedMemory_MiB) return {"shared memory", Verdict::kLimited, what, cure};
  return {"shared memory", Verdict::kGood, what};
}

// Returns true if a packet that one socket sends to the group reaches another socket of the same interface.
bool MulticastArrives(const in_addr& interface)
{
  const FileDescriptor receiver(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  const FileDescriptor sender(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  socklen_t size = sizeof address;
  auto* const plain = reinterpret_cast<sockaddr*>(&address);
  ip_mreq membership{};
  inet_pton(AF_INET, kMulticastGroup, &membership.imr_multiaddr);
  membership.imr_interface = interface;
  if (bind(receiver.Get(), plain, sizeof address) != 0 || getsockname(receiver.Get(), plain, &size) != 0 ||
      setsockopt(receiver.Get(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) != 0 ||
      setsockopt(sender.Get(), IPPROTO_IP, IP_MULTICAST_IF, &interface, sizeof interface) != 0)
    return false;
  address.sin_addr = membership.imr_multiaddr;
  constexpr char kWord = '?';
  if (sendto(sender.Get(), &kWord, 1, 0, plain, sizeof address) != 1) return false;
  pollfd arrival{receiver.Get(), POLLIN, 0};
  return poll(&arrival, 1, 500) == 1;
}

Finding Multicast()
{
  std::string able, unable;
  ifaddrs* interfaces = nullptr;
  if (getifaddrs(&interfaces) != 0) interfaces = nullptr;
  for (const ifaddrs* each = interfaces; each != nullptr; each = each->ifa_next)
  {
    if (each->ifa_addr == nullptr || each->ifa_addr->sa_family != AF_INET) continue;
    if ((each->ifa_flags & IFF_UP) == 0 || (each->ifa_flags & IFF_LOOPBACK) != 0) continue;
    const in_addr address = reinterpret_cast<const sockaddr_in*>(each->ifa_addr)->sin_addr;
    std::string& list = MulticastArrives(address) ? able : unable;
    list += (list.empty() ? "" : ", ") + std::string(each->ifa_name);
  }
  if (interfaces != nullptr) freeifaddrs(interfaces);
  const std::string cure =
      "for runs on several machines give --peers or --discovery-server (docs/running_a_cluster.md)";
  if (able.empty() && unable.empty())
    return {"multicast", Verdict::kLimited, "there is no network beside this machine's own",
            "runs on this machine need none"};
  if (!unable.empty()) return {"multicast", Verdict::kLimited, "not on " + unable, cure};
  return {"multicast", Verdict::kGood, "on " + able};
}

Finding Ports()
{
  const FileDescriptor server(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (bind(server.Get(), reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 || listen(server.Get(), 1) != 0)
    return {"ports", Verdict::kLimited, fmt::format("no server may listen on 127.0.0.1: {}", std::strerror(errno)),
            "the page needs one; allow it, or look on by `swarmanoid attach text`"};
  return {"ports", Verdict::kGood, "a page can listen on 127.0.0.1"};
}

Finding Graphics(const fs::path& folder)
{
  const fs::path experiment = folder / "drawn.xml", output = folder / "drawn", errors = folder / "drawn.log";
  std::ifstream sample(SampleFile(kSample));
  const std::string text(std::istreambuf_iterator<char>(sample), {});
  std::ofstream(experiment) << WithVisualisation(text,
                                                 R"(<image_render id="drawn" size="64, 64" at="0" file="drawn.png"/>)");
  const int exit_code =
      CommandProcess(
          {OwnProgram(), "run", experiment, "--quiet", "--single-process", "--ticks", "1", "--output", output}, errors)
          .Wait();
  if (exit_code == kExitDone && fs::exists(output / "drawn.png"))
    return {"pictures", Verdict::kGood, "OpenGL draws without a window"};
  return {"pictures", Verdict::kLimited, FirstLineOf(errors),
          "for pictures, films and windows: the package swarmanoid, and apt-get install libegl1 libgl1-mesa-dri"};
}

Finding Display()
{
  if (KindForSession() == ShowingKind::kPage) return {"display", Verdict::kGood, "this session has one"};
  return {"display", Verdict::kLimited, "this session has none: no windows, and no browser is opened",
          "look on by the page from another machine (ssh -L), or in films"};
}

Finding Fonts()
{
  for (const char* path : {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
                           "/usr/share/fonts/dejavu/DejaVuSans.ttf"})
    if (fs::exists(path)) return {"fonts", Verdict::kGood, path};
  return {"fonts", Verdict::kLimited, "there is no DejaVuSans.ttf: pictures have no labels",
          "apt-get install fonts-dejavu-core"};
}

Finding Ssh()
{
  const char* path = std::getenv("PATH");
  std::string_view folders = path == nullptr ? "" : path;
  while (!folders.empty())
  {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    const std::string file = std::string(folders.substr(0, end)) + "/ssh";
    if (access(file.c_str(), X_OK) == 0) return {"ssh", Verdict::kGood, file, ""};
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  return {"ssh", Verdict::kLimited, "there is none, which --hosts needs", "apt-get install openssh-client"};
}

Finding Disk()
{
  const std::string folder = fs::current_path();
  const double free = FreeMiB(folder);
  if (access(folder.c_str(), W_OK) != 0)
    return {"disk", Verdict::kLimited, fmt::format("{} cannot be written to", folder),
            "go to another folder, or give runs a place by --output"};
  if (free < kDisk_MiB)
    return {"disk", Verdict::kLimited, fmt::format("{} has {:.0f} MiB free", folder, free),
            "make room for films and logs"};
  return {"disk", Verdict::kGood, fmt::format("{} has {:.0f} GiB free", folder, free / 1024)};
}

Finding OpenFiles()
{
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  const std::string what = fmt::format("a process may open {} files", limit.rlim_cur);
  if (limit.rlim_cur < kOpenFiles) return {"open files", Verdict::kLimited, what, "ulimit -n 1024"};
  return {"open files", Verdict::kGood, what};
}

}  // namespace

std::vector<Finding> Examine(const std::string& folder)
{
  const Trial here = TryRun(folder, "here", {"--single-process"});
  const Trial cluster = TryRun(folder, "cluster", {});
  return {OneProcess(here), Cluster(here, cluster), Rounding(), DdsVariables(), SharedMemory(), Multicast(),
          Ports(),          Graphics(folder),       Display(),  Fonts(),        Ssh(),          Disk(),
          OpenFiles()};
}

}  // namespace swarmanoid
