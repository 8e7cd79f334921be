#include "common/run/hash_log.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace swarmanoid
{

HashLog::HashLog(const std::string& path) : path_(path)
{
  if (path.empty()) return;
  file_ = std::fopen(path.c_str(), "we");
  if (file_ == nullptr) Refuse(errno);
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

void HashLog::Close()
{
  if (file_ != nullptr && std::fclose(std::exchange(file_, nullptr)) != 0) Refuse(errno);
}

void HashLog::Refuse(int cause) const
{
  throw std::runtime_error(fmt::format("cannot write the hash log '{}': {}", path_, std::strerror(cause)));
}

}  // namespace swarmanoid
