#include "common/run/access/free_domain.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

#include <fmt/format.h>
#include <string>

#include "common/run/access/bus_options.h"
#include "common/run/access/run_directory.h"

namespace swarmanoid
{

namespace
{

// Higher domains use ports that the kernel gives to other programs (32768 and above). Domain 0 is the default of all
// programs.
constexpr int kFirstDomain = 1;
constexpr int kLastDomain = 99;

// The port of RTPS where every participant of a domain listens for others.
bool PortIsFree(int domain)
{
  const int file = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (file < 0) return false;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  address.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * domain));
  const bool free = bind(file, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  close(file);
  return free;
}

}  // namespace

FreeDomain::FreeDomain()
{
  const std::string folder = LockFolder();
  // Callers that start together begin at different places.
  const int start = static_cast<int>(getpid() % (kLastDomain - kFirstDomain + 1));
  for (int k = 0; k <= kLastDomain - kFirstDomain; ++k)
  {
    const int domain = kFirstDomain + (start + k) % (kLastDomain - kFirstDomain + 1);
    if (domain == kDefaultDomain) continue;
    lock_ = open(fmt::format("{}/domain.{}.lock", folder, domain).c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
    if (lock_ < 0) throw BusError("cannot write in '" + folder + "': " + std::strerror(errno));
    if (flock(lock_, LOCK_EX | LOCK_NB) == 0 && PortIsFree(domain))
    {
      id_ = domain;
      return;
    }
    close(lock_);
  }
  throw BusError("all DDS domains from 1 to 99 are in use on this machine; name one with --domain");
}

FreeDomain::~FreeDomain() { close(lock_); }

}  // namespace swarmanoid
