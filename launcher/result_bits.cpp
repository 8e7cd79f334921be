#include "launcher/result_bits.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace swarmanoid
{
namespace
{

constexpr const char* kVariable = "GLIBC_TUNABLES";
const std::string kTunable = "glibc.cpu.hwcaps=";
const std::string kWithout = "-FMA";

}  // namespace

std::string ResultBitsTunables(const std::string& current)
{
  if (current.empty()) return kTunable + kWithout;
  const std::size_t tunable = current.find(kTunable);
  if (tunable == std::string::npos) return current + ":" + kTunable + kWithout;
  const std::size_t value = tunable + kTunable.size();
  const std::string features = "," + current.substr(value, current.find(':', value) - value) + ",";
  if (features.find("," + kWithout + ",") != std::string::npos) return current;
  return current.substr(0, value) + kWithout + "," + current.substr(value);
}

void EnsureResultBits()
{
  const char* value = std::getenv(kVariable);
  const std::string current = value == nullptr ? "" : value;
  const std::string wanted = ResultBitsTunables(current);
  if (wanted == current) return;
  setenv(kVariable, wanted.c_str(), 1);
  std::vector<std::string> command = OriginalCommand();
  std::vector<char*> arguments;
  for (std::string& argument : command) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  const std::string program = std::filesystem::read_symlink("/proc/self/exe");
  execv(program.c_str(), arguments.data());
  throw std::runtime_error("cannot start '" + program + "' anew");
}

std::vector<std::string> OriginalCommand()
{
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> command;
  for (std::string argument; std::getline(file, argument, '\0');) command.push_back(argument);
  return command;
}

}  // namespace swarmanoid
