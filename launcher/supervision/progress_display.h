// Shows how a run goes on: one status line that is rewritten in place on a terminal, a plain line now and then
// elsewhere. Used by the launcher's main thread.
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
  // Takes the status line away, so that other text can be written.
  void Clear();
  // One line of its own, shown whatever the style.
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

  // The pace of the run, for the time that is left.
  std::optional<Clock::time_point> mark_;
  std::uint64_t mark_tick_ = 0;
  double ticks_per_s_ = 0;
};

// "850 ms", "12 s", "3 min 20 s", "2 h 5 min".
std::string DurationText(double seconds);

}  // namespace swarmanoid
