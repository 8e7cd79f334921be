#include "common/configuration/trust.h"

#include <atomic>
#include <cstdlib>
#include <string_view>

namespace swarmanoid
{
namespace
{

bool IsSet()
{
  const char* value = std::getenv(kTrustVariable);
  return value != nullptr && std::string_view(value) == "1";
}

std::atomic<bool>& Trusted()
{
  static std::atomic<bool> trusted{IsSet()};
  return trusted;
}

}  // namespace

void TrustExperiments()
{
  if (!Trusted().exchange(true)) setenv(kTrustVariable, "1", 1);
}

bool ExperimentsAreTrusted() { return Trusted(); }

}  // namespace swarmanoid
