#include "common/run/access/run_key.h"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/wording.h"
#include "common/run/access/bus_options.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kMostOfAKey = 4096;  // bytes that are read in search of one

// Returns the text up to the end of the first line.
std::string FirstLineFrom(int descriptor)
{
  std::string line;
  char letter = 0;
  while (line.size() < kMostOfAKey)
  {
    const ssize_t count = read(descriptor, &letter, 1);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0 || letter == '\n') break;
    line += letter;
  }
  return line;
}

}  // namespace

RunKey NewRunKey()
{
  RunKey key{};
  if (getrandom(key.data(), key.size(), 0) != static_cast<ssize_t>(key.size()))
    throw BusError("the system gives no random numbers for the key of the run");
  return key;
}

std::string TextOfKey(const RunKey& key)
{
  std::string text;
  for (const unsigned char byte : key) text += fmt::format("{:02x}", byte);
  return text;
}

std::optional<RunKey> KeyOfText(const std::string& text)
{
  constexpr std::string_view kDigits = "0123456789abcdef";
  const std::string_view digits = TrimBlanks(text);
  RunKey key{};
  if (digits.size() != 2 * key.size()) return std::nullopt;
  for (std::size_t k = 0; k < digits.size(); ++k)
  {
    const std::size_t value = kDigits.find(digits[k]);
    if (value == std::string_view::npos) return std::nullopt;
    key[k / 2] = static_cast<unsigned char>(key[k / 2] * 16 + value);
  }
  return key;
}

RunKey KeyOfFile(const std::string& path)
{
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) throw BusError(fmt::format("--key: cannot read '{}': {}", path, std::strerror(errno)));
  struct stat status
  {
  };
  const bool known = fstat(file, &status) == 0;
  const std::string line = known && S_ISREG(status.st_mode) ? FirstLineFrom(file) : std::string();
  close(file);
  if (known && (status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    throw BusError(fmt::format("--key: other users can read '{0}'; `chmod 600 {0}` cures it", path));
  if (const auto key = KeyOfText(line)) return *key;
  throw BusError(
      fmt::format("--key: '{0}' holds no key, which is a line of 64 hexadecimal digits; `(umask 077; openssl rand -hex "
                  "32 > {0})` makes one",
                  path));
}

RunKey KeyOfDescriptor(int descriptor)
{
  struct stat status
  {
  };
  if (fstat(descriptor, &status) == 0 && !S_ISREG(status.st_mode))
  {
    // The input from ssh comes through a terminal, which would echo it into the log.
    termios terminal{};
    if (tcgetattr(descriptor, &terminal) == 0)
    {
      terminal.c_lflag &= ~static_cast<tcflag_t>(ECHO | ECHONL);
      tcsetattr(descriptor, TCSANOW, &terminal);
    }
    fmt::print(stderr, "{}\n", kKeyPrompt);
  }
  if (const auto key = KeyOfText(FirstLineFrom(descriptor))) return *key;
  throw BusError(fmt::format(
      "--key-fd {}: no key comes from it; the program that started this process, by ssh or otherwise, must leave its "
      "standard input open to the launcher",
      descriptor));
}

}  // namespace swarmanoid
