#include "launcher/processes/console_link.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "common/bus/run_directory.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kReadBytes = 64 * 1024;
constexpr std::size_t kMostFiles = 4;
constexpr const char* kPrefix = "run.";
constexpr const char* kSuffix = ".socket";

void TakeFiles(msghdr& header, std::vector<FileDescriptor>& files)
{
  for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part))
  {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_RIGHTS) continue;
    const std::size_t count = (part->cmsg_len - CMSG_LEN(0)) / sizeof(int);
    for (std::size_t k = 0; k < count; ++k)
    {
      int file = -1;
      std::memcpy(&file, CMSG_DATA(part) + k * sizeof(int), sizeof file);
      files.emplace_back(file);
    }
  }
}

}  // namespace

std::pair<ConsoleLink, ConsoleLink> ConsoleLink::MakePair()
{
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends) != 0)
    throw std::runtime_error(fmt::format("cannot make a pair of sockets: {}", std::strerror(errno)));
  return {ConsoleLink(FileDescriptor(ends[0])), ConsoleLink(FileDescriptor(ends[1]))};
}

std::optional<ConsoleLink> ConsoleLink::To(const std::string& path)
{
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) return std::nullopt;
  path.copy(address.sun_path, path.size());
  FileDescriptor socket(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket.IsOpen()) return std::nullopt;
  if (connect(socket.Get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
  {
    const int reason = errno;
    socket.Reset(-1);
    errno = reason;
    return std::nullopt;
  }
  return ConsoleLink(std::move(socket));
}

ConsoleLink::Peer ConsoleLink::GetPeer() const
{
  ucred peer{};
  socklen_t size = sizeof peer;
  if (getsockopt(socket_.Get(), SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return {0, static_cast<uid_t>(-1)};
  return {peer.pid, peer.uid};
}

bool ConsoleLink::Send(const nlohmann::json& message, const std::vector<int>& files) const
{
  std::string text = message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  iovec part{text.data(), text.size()};
  msghdr header{};
  header.msg_iov = &part;
  header.msg_iovlen = 1;
  alignas(cmsghdr) std::array<char, CMSG_SPACE(kMostFiles * sizeof(int))> room{};
  if (!files.empty())
  {
    header.msg_control = room.data();
    header.msg_controllen = CMSG_SPACE(files.size() * sizeof(int));
    cmsghdr* control = CMSG_FIRSTHDR(&header);
    control->cmsg_level = SOL_SOCKET;
    control->cmsg_type = SCM_RIGHTS;
    control->cmsg_len = CMSG_LEN(files.size() * sizeof(int));
    std::memcpy(CMSG_DATA(control), files.data(), files.size() * sizeof(int));
  }
  return sendmsg(socket_.Get(), &header, MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
}

std::optional<ConsoleLink::Received> ConsoleLink::Receive()
{
  std::string text(kReadBytes, '\0');
  iovec part{text.data(), text.size()};
  msghdr header{};
  header.msg_iov = &part;
  header.msg_iovlen = 1;
  alignas(cmsghdr) std::array<char, CMSG_SPACE(kMostFiles * sizeof(int))> room{};
  header.msg_control = room.data();
  header.msg_controllen = room.size();
  const ssize_t count = recvmsg(socket_.Get(), &header, MSG_CMSG_CLOEXEC);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return std::nullopt;
  Received received;
  received.ended = count <= 0;
  if (received.ended) return received;
  TakeFiles(header, received.files);
  text.resize(static_cast<std::size_t>(count));
  auto message = nlohmann::json::parse(text, nullptr, false);
  if ((header.msg_flags & MSG_TRUNC) == 0 && message.is_object()) received.message = std::move(message);
  return received;
}

bool ConsoleLink::Wait(int milliseconds) const
{
  pollfd entry{socket_.Get(), POLLIN, 0};
  return poll(&entry, 1, milliseconds) > 0;
}

std::string ConsoleSocketOf(pid_t process) { return fmt::format("{}/{}{}{}", LockFolder(), kPrefix, process, kSuffix); }

void RemoveDeadConsoles()
{
  for (const std::string& path : ConsoleSockets())
    if (!ConsoleLink::To(path) && errno == ECONNREFUSED) unlink(path.c_str());
}

std::vector<std::string> ConsoleSockets()
{
  std::vector<std::string> paths;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(LockFolder(), none))
    if (const std::string name = entry.path().filename(); name.starts_with(kPrefix) && name.ends_with(kSuffix))
      paths.push_back(entry.path());
  return paths;
}

}  // namespace swarmanoid
