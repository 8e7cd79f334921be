// ProgressDisplay: shows the progress of a run. On a terminal it rewrites one status line; elsewhere it prints a plain
// line from time to time. The launcher's main thread uses it.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace swarmanoid
{

// The values of the display.
struct RunProgress
{
  std::string phase;  // "starting", "waiting for engine_worker ground", "running", "paused", "stopping"
  std::uint64_t tick = 0;
  std::uint64_t max = 0;  // 0: without end
  double real_time_factor = 0;
  int processes = 0;        // alive; 0: not shown
  std::string waiting_for;  // the process that the run waits for; may be empty
  double waited_s = 0;
  bool is_run = true;  // false: work of another kind, whose steps are counted instead of ticks
};

class ProgressDisplay
{
public:
  enum class Style
  {
    kQuiet,
    kPlain,    // a line at each change of phase and at most every `plain_period`
    kTerminal  // one line, rewritten
  };

  using Clock = std::chrono::steady_clock;

  ProgressDisplay(Style style, int descriptor) : style_(style), descriptor_(descriptor) {}
  ~ProgressDisplay() { Clear(); }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  // Returns kTerminal if the descriptor is a terminal.
  static Style StyleFor(int descriptor, bool quiet);

  void Show(const RunProgress& progress, Clock::time_point now);
  // Removes the status line, so that other text can be written.
  void Clear();
  // Prints a line of its own in every style.
  void Note(std::string_view line);

  std::chrono::milliseconds plain_period{5000};

private:
  void Follow(const RunProgress& progress, Clock::time_point now);
  std::string Text(const RunProgress& progress) const;
  void Write(std::string_view text) const;

  Style style_;
  int descriptor_;
  bool line_shown_ = false;
  std::string last_phase_;
  std::optional<Clock::time_point> last_plain_;

  // The pace of the run, for an estimate of the remaining time.
  std::optional<Clock::time_point> mark_;
  std::uint64_t mark_tick_ = 0;
  double ticks_per_s_ = 0;
};

// The progress of long work that is no run, such as reading a journal: its share and the time that is left. It is shown
// on a terminal only, since a pipe gets the result.
class WorkProgress
{
public:
  // `work`: "reading the journal". `all`: its steps.
  WorkProgress(std::string work, std::uint64_t all);
  void At(std::uint64_t step);
  // Takes the line away; so does the destructor.
  void Clear() { display_.Clear(); }

private:
  RunProgress progress_;
  ProgressDisplay display_;
  ProgressDisplay::Clock::time_point next_;
};

// Returns a text such as "850 ms", "12 s", "3 min 20 s" or "2 h 5 min".
std::string DurationText(double seconds);

}  // namespace swarmanoid
