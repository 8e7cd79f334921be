// ConsoleLink: one end of the connection between the process that supervises a run and the one that a user sits at
// (`swarmanoid run`, `adopt`, `list`). A message is a small JSON object; one may carry open files. The supervising
// process is met by a socket of its own in the folder of locks, which only processes of the same user can reach.
#pragma once

#include <sys/types.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/program/file_descriptor.h"

namespace swarmanoid
{

class ConsoleLink
{
public:
  explicit ConsoleLink(FileDescriptor socket) : socket_(std::move(socket)) {}

  // Both ends, for a process and the one that it is about to start.
  static std::pair<ConsoleLink, ConsoleLink> MakePair();
  // To a supervising process; nothing, and errno, if none listens there.
  static std::optional<ConsoleLink> To(const std::string& path);

  int Descriptor() const { return socket_.Get(); }
  // Whose process is at the other end, as the kernel says.
  struct Peer
  {
    pid_t process = 0;
    uid_t user = 0;
  };
  Peer GetPeer() const;

  // False if nobody reads it any more. Does not wait.
  bool Send(const nlohmann::json& message, const std::vector<int>& files = {}) const;

  struct Received
  {
    std::optional<nlohmann::json> message;  // an object; none if what came is no message
    std::vector<FileDescriptor> files;
    bool ended = false;  // the other end is closed
  };
  // What came; nothing if there is nothing yet. Does not wait.
  std::optional<Received> Receive();
  // Waits until there is something to receive. False if there was not within the time.
  bool Wait(int milliseconds) const;

private:
  FileDescriptor socket_;
};

// The sockets of supervising processes of this user, by which ConsoleLink::To meets them. Throws BusError.
std::string ConsoleSocketOf(pid_t process);
std::vector<std::string> ConsoleSockets();
// Those of processes that were killed.
void RemoveDeadConsoles();

}  // namespace swarmanoid
