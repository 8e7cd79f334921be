#include "visualiser/web/log_follower.h"

#include <fstream>

namespace swarmanoid
{
namespace
{

constexpr std::uintmax_t kMostBytes = 65536;
constexpr std::size_t kLongestLine = 500;

}  // namespace

LogFollower::LogFollower(const std::filesystem::path& folder)
{
  std::error_code error;
  if (std::filesystem::exists(folder / "manifest.json", error)) folder_ = folder;
}

void LogFollower::Read(const OnLine& on_line)
{
  if (folder_.empty()) return;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, error))
  {
    if (entry.path().extension() != ".log") continue;
    const std::uintmax_t size = entry.file_size(error);
    if (!error && size > read_[entry.path()]) ReadFile(entry.path(), size, on_line);
  }
}

void LogFollower::ReadFile(const std::filesystem::path& path, std::uintmax_t size, const OnLine& on_line)
{
  const std::string process = path.stem().string();
  std::uintmax_t& place = read_[path];
  bool skipped = false;
  if (size - place > kMostBytes)
  {
    on_line(process, "(" + std::to_string(size - place - kMostBytes) + " bytes are left out here)");
    place = size - kMostBytes;
    skipped = true;
  }
  std::string text(size - place, '\0');
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(place));
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));

  // A line without an end waits for the next call, unless it fills the buffer.
  std::size_t start = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', start))
  {
    if (!skipped && end > start) on_line(process, text.substr(start, std::min(end - start, kLongestLine)));
    skipped = false;
    start = end + 1;
  }
  place += start == 0 && text.size() == kMostBytes ? text.size() : start;
}

}  // namespace swarmanoid
