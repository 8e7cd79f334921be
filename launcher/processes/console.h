// Console: who a run is shown to and interrupted by: at first the launcher, later whoever adopts the run after that one
// has died. Lives in the process that supervises the run, whose descriptors 1 and 2 are those of the console, or a file
// in the folder of the run while there is none. Used by that process's one thread.
#pragma once

#include <chrono>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "launcher/processes/console_link.h"

namespace swarmanoid
{

struct ConsoleSetup
{
  std::string experiment;
  std::string folder;  // of the run
  int domain = 0;
  std::chrono::milliseconds orphan_timeout{0};  // that the run goes on without a console
};

class Console
{
public:
  using Clock = std::chrono::steady_clock;

  // `first`: the launcher, whose descriptors 1 and 2 this process has already. Throws std::runtime_error if nobody
  // could adopt the run.
  Console(ConsoleSetup setup, ConsoleLink first, pid_t launcher);
  // The socket goes with it.
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  // Readable when there is something to take.
  int Descriptor() const { return events_.Get(); }
  // A signal that the console had, or SIGHUP, again and again, if nobody has adopted the run in time. To be called now
  // and then: it hears everybody else, too.
  std::optional<int> TakeSignal();
  // Whether the console was there before the call, and has gone by the end of this time: then what is written to
  // descriptors 1 and 2 from now on goes into the file.
  bool HasGone(std::chrono::milliseconds within);

  // Called when descriptors 1 and 2 are others than before: of a console that wants no progress (`quiet`), or none.
  using OnChange = std::function<void(std::optional<bool> quiet)>;
  void SetOnChange(OnChange changed) { changed_ = std::move(changed); }

  // The last that the console hears.
  void End(int exit_code);

private:
  void Watch(int descriptor) const;
  void HearConsole();
  void HearOthers();
  void Answer(ConsoleLink& link, const nlohmann::json& message, std::vector<FileDescriptor>& files, bool& adopted);
  nlohmann::json State() const;
  void Orphan();

  ConsoleSetup setup_;
  std::string path_;
  FileDescriptor events_;
  FileDescriptor listener_;
  std::optional<ConsoleLink> console_;
  pid_t console_process_ = 0;
  std::list<ConsoleLink> others_;  // who asks, or is about to adopt the run
  std::vector<int> signals_;
  std::optional<Clock::time_point> orphaned_;
  std::optional<Clock::time_point> told_end_;  // when SIGHUP was given last
  OnChange changed_;
};

}  // namespace swarmanoid
