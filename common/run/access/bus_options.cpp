#include "common/run/access/bus_options.h"

#include <pwd.h>
#include <unistd.h>

#include "common/configuration/shown_text.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kLongestUser = 100;  // bytes

}  // namespace

std::optional<RunKey> GivenKey(const BusOptions& options)
{
  if (options.insecure || options.key) return options.key;
  if (options.key_fd >= 0) return KeyOfDescriptor(options.key_fd);
  if (!options.key_file.empty()) return KeyOfFile(options.key_file);
  return std::nullopt;
}

std::string UserName()
{
  const passwd* const user = getpwuid(geteuid());
  return user != nullptr ? ShowableLine(user->pw_name, kLongestUser) : std::to_string(geteuid());
}

}  // namespace swarmanoid
