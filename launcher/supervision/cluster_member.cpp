#include "launcher/supervision/cluster_member.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

#include "common/run/access/run_key.h"

namespace swarmanoid
{
namespace
{

// Reads bytes without waiting. Closes the descriptor at its end.
std::string_view ReadSome(FileDescriptor& descriptor, std::array<char, 4096>& buffer, std::size_t limit)
{
  if (!descriptor.IsOpen()) return {};
  const ssize_t count = read(descriptor.Get(), buffer.data(), std::min(limit, buffer.size()));
  if (count > 0) return {buffer.data(), static_cast<std::size_t>(count)};
  if (count == 0 || (errno != EAGAIN && errno != EINTR)) descriptor.Reset();
  return {};
}

}  // namespace

ClusterMember::ClusterMember(PlannedProcess planned, const ProcessCommand& command, ProcessSpawner& spawner,
                             Incarnation incarnation)
    : planned_(std::move(planned)),
      incarnation_(std::move(incarnation)),
      input_(command.input),
      log_(planned_.log_path, incarnation_.number > 0),
      process_(spawner.Start(command))
{
}

bool ClusterMember::Answers(std::string_view line)
{
  if (!process_.input.IsOpen() || line.find(kKeyPrompt) == std::string_view::npos) return false;
  // The input is far smaller than the buffer of a pipe, so the write is never partial.
  [[maybe_unused]] const ssize_t written = write(process_.input.Get(), input_.data(), input_.size());
  process_.input.Reset();
  return true;
}

void ClusterMember::ReadOutput(const OnLine& on_line, std::size_t limit)
{
  const bool is_shown = planned_.role == ProcessRole::kSpaceServer || planned_.role == ProcessRole::kVisualiser;
  const OnLine take = [&](std::string_view line)
  {
    if (Answers(line)) return;
    if (is_shown)
      on_line(line);
    else
      log_.Add(line);
  };
  std::array<char, 4096> buffer;
  while (limit > 0)
  {
    const std::string_view bytes = ReadSome(process_.output, buffer, limit);
    if (bytes.empty()) break;
    limit -= bytes.size();
    output_lines_.Add(bytes, take);
  }
  // A process that has ended may have left the descriptor to a child, so only the output that is there now counts.
  if (limit > 0 && end_) process_.output.Reset();
  if (!OutputClosed() || !end_ || std::exchange(output_taken_, true)) return;
  // The last line of a killed process may be incomplete.
  if (end_->signal == 0) output_lines_.Finish(take);
}

void ClusterMember::ReadErrors()
{
  std::array<char, 4096> buffer;
  for (int rounds = 0; rounds < 16; ++rounds)
  {
    const std::string_view bytes = ReadSome(process_.errors, buffer, buffer.size());
    if (bytes.empty()) break;
    error_lines_.Add(bytes,
                     [this](std::string_view line)
                     {
                       if (!Answers(line)) log_.Add(line);
                     });
  }
}

void ClusterMember::Collect(ProcessSpawner& spawner)
{
  end_ = spawner.Collect(process_);
  ReadErrors();
  process_.errors.Reset();
  error_lines_.Finish([this](std::string_view line) { log_.Add(line); });
}

}  // namespace swarmanoid
