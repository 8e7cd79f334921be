#include "common/run/hash_log.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace swarmanoid
{

HashLog::HashLog(const std::string& path, std::optional<std::uint64_t> goes_on_at) : path_(path)
{
  if (path.empty()) return;
  if (goes_on_at && std::filesystem::exists(path)) CutAt(*goes_on_at);
  file_ = std::fopen(path.c_str(), goes_on_at ? "ae" : "we");
  if (file_ == nullptr) Refuse(errno);
}

void HashLog::CutAt(std::uint64_t tick) const
{
  std::ifstream lines(path_);
  std::uintmax_t kept = 0;
  for (std::string line; std::getline(lines, line) && !lines.eof() && std::strtoull(line.c_str(), nullptr, 10) < tick;)
    kept += line.size() + 1;
  std::filesystem::resize_file(path_, kept);
}

HashLog::~HashLog()
{
  if (file_ != nullptr) std::fclose(file_);
}

void HashLog::Write(std::uint64_t tick, std::uint64_t hash)
{
  if (file_ == nullptr) return;
  const std::string line = fmt::format("{} {:016x}\n", tick, hash);
  if (std::fwrite(line.data(), 1, line.size(), file_) != line.size()) Refuse(errno);
}

void HashLog::Flush()
{
  if (file_ != nullptr && std::fflush(file_) != 0) Refuse(errno);
}

void HashLog::Close()
{
  if (file_ != nullptr && std::fclose(std::exchange(file_, nullptr)) != 0) Refuse(errno);
}

void HashLog::Refuse(int cause) const
{
  throw std::runtime_error(fmt::format("cannot write the hash log '{}': {}", path_, std::strerror(cause)));
}

}  // namespace swarmanoid
