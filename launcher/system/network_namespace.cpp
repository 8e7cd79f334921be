#include "launcher/system/network_namespace.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "common/program/file_descriptor.h"
#include "common/program/usage_error.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

[[noreturn]] void RefuseIsolation(const char* step)
{
  throw UsageError(
      fmt::format("--isolated: this system allows no network of its own to the run ({}: {}); without it the run is "
                  "still protected by its key (docs/security.md)",
                  step, std::strerror(errno)));
}

void WriteOnce(const char* file, const std::string& text)
{
  const FileDescriptor descriptor(open(file, O_WRONLY | O_CLOEXEC));
  if (!descriptor.IsOpen() || write(descriptor.Get(), text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    RefuseIsolation(file);
}

// Returns the namespace of a process, or an empty text if this user may not know it.
std::string NamespaceOf(const std::string& process, const char* kind)
{
  std::error_code none;
  return fs::read_symlink(fmt::format("/proc/{}/ns/{}", process, kind), none).string();
}

void Enter(pid_t process, const char* kind, int type)
{
  const std::string file = fmt::format("/proc/{}/ns/{}", process, kind);
  const FileDescriptor descriptor(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!descriptor.IsOpen() || setns(descriptor.Get(), type) != 0)
    throw UsageError(
        fmt::format("cannot enter the network of the run (process {}): {}", process, std::strerror(errno)));
}

}  // namespace

void IsolateNetwork()
{
  // Root keeps its rights over other users' files only without a user namespace.
  if (geteuid() != 0 || unshare(CLONE_NEWNET) != 0)
  {
    const uid_t user = geteuid();
    const gid_t group = getegid();
    if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) RefuseIsolation("unshare");
    WriteOnce("/proc/self/setgroups", "deny");
    WriteOnce("/proc/self/uid_map", fmt::format("{0} {0} 1", user));
    WriteOnce("/proc/self/gid_map", fmt::format("{0} {0} 1", group));
  }
  const FileDescriptor any(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  ifreq loopback{};
  std::strcpy(loopback.ifr_name, "lo");
  loopback.ifr_flags = IFF_UP | IFF_RUNNING | IFF_LOOPBACK | IFF_MULTICAST;
  if (!any.IsOpen() || ioctl(any.Get(), SIOCSIFFLAGS, &loopback) != 0) RefuseIsolation("lo");
}

bool IsInAnotherNetwork(pid_t process)
{
  const std::string theirs = NamespaceOf(std::to_string(process), "net");
  return !theirs.empty() && theirs != NamespaceOf("self", "net");
}

void EnterNetworkOf(pid_t process)
{
  if (!IsInAnotherNetwork(process)) return;
  if (NamespaceOf(std::to_string(process), "user") != NamespaceOf("self", "user"))
    Enter(process, "user", CLONE_NEWUSER);
  Enter(process, "net", CLONE_NEWNET);
}

}  // namespace swarmanoid
