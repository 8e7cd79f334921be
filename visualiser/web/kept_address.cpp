#include "visualiser/web/kept_address.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace swarmanoid
{
namespace
{

constexpr std::size_t kTokenDigits = 32;

bool IsToken(std::string_view text)
{
  return text.size() == kTokenDigits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

}  // namespace

KeptAddress::KeptAddress(const std::filesystem::path& folder, std::string_view experiment)
{
  if (folder.empty())
  {
    trouble_ = "neither XDG_STATE_HOME nor HOME is set";
    return;
  }
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::string path =
      (folder / fmt::format("{:016x}", XXH3_64bits(experiment.data(), experiment.size()))).string();
  file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  struct stat status
  {
  };
  if (file_ < 0 || fstat(file_, &status) != 0)
    trouble_ = fmt::format("cannot open '{}': {}", path, std::strerror(errno));
  else if (!S_ISREG(status.st_mode) || status.st_uid != geteuid() || (status.st_mode & 077) != 0)
    trouble_ = fmt::format("'{}' is not a file of this user alone; remove it", path);
  else if (flock(file_, LOCK_EX | LOCK_NB) != 0)
    trouble_ = "another page shows this experiment now";
  if (trouble_.empty())
  {
    Read();
    return;
  }
  if (file_ >= 0) close(file_);
  file_ = -1;
}

KeptAddress::~KeptAddress()
{
  if (file_ >= 0) close(file_);
}

// Reads "PORT TOKEN", or "PORT" if there was no token. Any other content is ignored.
void KeptAddress::Read()
{
  std::array<char, 64> text{};
  const ssize_t length = pread(file_, text.data(), text.size(), 0);
  if (length <= 0) return;
  std::string_view line(text.data(), static_cast<std::size_t>(length));
  line = line.substr(0, line.find('\n'));
  const std::string_view port = line.substr(0, line.find(' '));
  const std::string_view token = port.size() < line.size() ? line.substr(port.size() + 1) : std::string_view();
  std::uint16_t number = 0;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (error != std::errc() || end != port.data() + port.size() || (!token.empty() && !IsToken(token))) return;
  port_ = number;
  token_ = token;
}

bool KeptAddress::Keep(std::uint16_t port, const std::string& token)
{
  if (file_ < 0) return false;
  const std::string line = token.empty() ? fmt::format("{}\n", port) : fmt::format("{} {}\n", port, token);
  if (ftruncate(file_, 0) == 0 && pwrite(file_, line.data(), line.size(), 0) == static_cast<ssize_t>(line.size()))
  {
    port_ = port;
    token_ = token;
    return true;
  }
  trouble_ = fmt::format("cannot write it: {}", std::strerror(errno));
  return false;
}

std::filesystem::path StateFolder()
{
  if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state == '/')
    return std::filesystem::path(state) / "swarmanoid/web";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/')
    return std::filesystem::path(home) / ".local/state/swarmanoid/web";
  return {};
}

}  // namespace swarmanoid
