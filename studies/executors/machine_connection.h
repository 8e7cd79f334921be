// The connection to another machine for a study: a local process, mostly ssh, and its messages. No function waits,
// except the destructor for a short time. One thread.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/program/file_descriptor.h"
#include "common/serialisation/bytes.h"
#include "studies/executors/checked_frame.h"
#include "studies/executors/study_worker.h"

namespace swarmanoid
{

class MachineConnection
{
public:
  // Throws std::runtime_error if the process cannot be started.
  explicit MachineConnection(const std::vector<std::string>& command);
  // Closes the connection, and waits a short time until the other side has ended the runs that it started there.
  ~MachineConnection();
  MachineConnection(const MachineConnection&) = delete;
  MachineConnection& operator=(const MachineConnection&) = delete;

  // Sends a message when the pipe has space.
  void Send(StudyMessage kind, std::span<const char> content = {});
  // Reads and writes without waiting; returns false when the other side has gone.
  bool Exchange();
  // Returns the next message; nothing if it is not complete yet. Throws FrameError.
  std::optional<std::vector<char>> Next() { return frames_.Next(); }

  // Returns the descriptor to wait for.
  int Output() const { return out_.Get(); }
  int InputIfFull() const { return unsent_.empty() ? -1 : in_.Get(); }

  using Clock = std::chrono::steady_clock;
  Clock::time_point Heard() const { return heard_; }
  Clock::time_point Said() const { return said_; }
  // Tells the other side that no more messages come.
  void Close() { in_.Reset(); }
  // Returns why the connection ended or violates the protocol: the end of the process with the last line of its errors.
  std::string End();
  // Returns the last line on standard error, or the output before the first message.
  std::string LastWords() const;

private:
  // Returns false at the end of the file.
  bool ReadSome(int file, std::string* text);
  bool WriteSome();

  pid_t process_ = -1;
  FileDescriptor in_, out_, err_;
  FrameReader frames_;
  std::vector<char> unsent_;
  std::string errors_;
  Clock::time_point heard_ = Clock::now(), said_ = Clock::now();
};

}  // namespace swarmanoid
