// The process of this machine through which a study speaks to another one, mostly ssh, and what goes to and fro.
// Nothing here waits. One thread.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/program/file_descriptor.h"
#include "common/serialisation/bytes.h"
#include "studies/checked_frame.h"
#include "studies/study_worker.h"

namespace swarmanoid
{

class HostConnection
{
public:
  // Throws std::runtime_error if no process can be started.
  explicit HostConnection(const std::vector<std::string>& command);
  // Ends it, and waits until the other side has ended what it started there, but not for long.
  ~HostConnection();
  HostConnection(const HostConnection&) = delete;
  HostConnection& operator=(const HostConnection&) = delete;

  // Sent when there is room.
  void Send(StudyMessage kind, std::span<const char> content = {});
  // Reads and writes what can be; false when the other side has gone.
  bool Exchange();
  // The next message; nothing if it is not whole yet. Throws FrameError.
  std::optional<std::vector<char>> Next() { return frames_.Next(); }

  // What to wait for.
  int Output() const { return out_.Get(); }
  int InputIfFull() const { return unsent_.empty() ? -1 : in_.Get(); }

  using Clock = std::chrono::steady_clock;
  Clock::time_point Heard() const { return heard_; }
  Clock::time_point Said() const { return said_; }
  // Tells the other side that nothing more comes.
  void Close() { in_.Reset(); }
  // How it ended, or why it does not speak as it should: the end of the process with the last line of its errors.
  std::string End();
  // What it said last on standard error, or before it spoke as it should.
  std::string LastWords() const;

private:
  // False when it is at its end.
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
