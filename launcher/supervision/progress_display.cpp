#include "launcher/supervision/progress_display.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <utility>

#include "common/configuration/shown_text.h"
#include "common/program/standard_output.h"

namespace swarmanoid
{
std::string DurationText(double seconds)
{
  if (seconds < 1) return fmt::format("{:.0f} ms", seconds * 1000);
  if (seconds < 60) return fmt::format("{:.0f} s", seconds);
  const auto whole = static_cast<long long>(seconds);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

ProgressDisplay::Style ProgressDisplay::StyleFor(int descriptor, bool quiet)
{
  if (quiet) return Style::kQuiet;
  return isatty(descriptor) != 0 ? Style::kTerminal : Style::kPlain;
}

void ProgressDisplay::Show(const RunProgress& progress, Clock::time_point now)
{
  if (style_ == Style::kQuiet) return;
  Follow(progress, now);
  const std::string text = Showable(Text(progress));
  if (style_ == Style::kTerminal)
  {
    Write(fmt::format("\r{}\x1b[K", text.substr(0, TerminalWidth(descriptor_).value_or(80) - 1)));
    line_shown_ = true;
    return;
  }
  const std::string phase = progress.waiting_for.empty() ? progress.phase : "waiting for " + progress.waiting_for;
  if (phase == last_phase_ && last_plain_ && now - *last_plain_ < plain_period) return;
  last_phase_ = phase;
  last_plain_ = now;
  Write(text + "\n");
}

void ProgressDisplay::Clear()
{
  if (line_shown_) Write("\r\x1b[K");
  line_shown_ = false;
}

void ProgressDisplay::Note(std::string_view line)
{
  Clear();
  Write(fmt::format("{}\n", Showable(line)));
}

void ProgressDisplay::Follow(const RunProgress& progress, Clock::time_point now)
{
  if (!mark_ || progress.tick < mark_tick_)
  {
    mark_ = now;
    mark_tick_ = progress.tick;
    return;
  }
  const double elapsed_s = std::chrono::duration<double>(now - *mark_).count();
  if (elapsed_s < 0.5) return;
  const double pace = static_cast<double>(progress.tick - mark_tick_) / elapsed_s;
  ticks_per_s_ = ticks_per_s_ == 0 ? pace : 0.7 * ticks_per_s_ + 0.3 * pace;
  mark_ = now;
  mark_tick_ = progress.tick;
}

std::string ProgressDisplay::Text(const RunProgress& progress) const
{
  std::string text = progress.phase;
  if (!progress.waiting_for.empty())
    text = fmt::format("waiting for {} ({})", progress.waiting_for, DurationText(progress.waited_s));
  const double percent =
      progress.max > 0 ? std::floor(100 * static_cast<double>(progress.tick) / static_cast<double>(progress.max)) : 0;
  const std::string left =
      progress.max > progress.tick && ticks_per_s_ > 0
          ? fmt::format(", {} left", DurationText(static_cast<double>(progress.max - progress.tick) / ticks_per_s_))
          : "";
  if (!progress.is_run) return fmt::format("{}: {:.0f} %{}", progress.phase, percent, left);
  if (progress.tick > 0 || progress.max > 0)
  {
    text += fmt::format(": tick {}", progress.tick);
    if (progress.max > 0) text += fmt::format(" of {} ({:.0f} %)", progress.max, percent);
    text += fmt::format(", {:.1f}x real time", progress.real_time_factor);
    if (progress.phase == "running" && progress.waiting_for.empty()) text += left;
  }
  if (progress.processes > 0) text += fmt::format(", {} processes", progress.processes);
  return text;
}

void ProgressDisplay::Write(std::string_view text) const
{
  while (!text.empty())
  {
    const ssize_t written = write(descriptor_, text.data(), text.size());
    if (written < 0 && errno != EINTR) return;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
}

WorkProgress::WorkProgress(std::string work, std::uint64_t all)
    : display_(isatty(STDERR_FILENO) == 0 ? ProgressDisplay::Style::kQuiet : ProgressDisplay::Style::kTerminal,
               STDERR_FILENO),
      next_(ProgressDisplay::Clock::now())
{
  progress_.phase = std::move(work);
  progress_.max = all;
  progress_.is_run = false;
}

void WorkProgress::At(std::uint64_t step)
{
  const auto now = ProgressDisplay::Clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(200);
  progress_.tick = step;
  display_.Show(progress_, now);
}

}  // namespace swarmanoid
