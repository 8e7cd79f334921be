#include "common/run/hash_log.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "common/configuration/wording.h"

namespace swarmanoid
{

namespace
{

// Reads "tick hash"; returns nothing for any other line.
std::optional<TickHash> ReadLine(const std::string& line)
{
  constexpr std::size_t kHashDigits = 16;
  TickHash read;
  const char* const end = line.data() + line.size();
  const auto number = std::from_chars(line.data(), end, read.tick);
  if (number.ec != std::errc() || number.ptr == end || *number.ptr != ' ') return std::nullopt;
  const char* const digits = number.ptr + 1;
  const auto last = std::from_chars(digits, end, read.hash, 16);
  if (last.ec != std::errc() || last.ptr != end || end - digits != kHashDigits) return std::nullopt;
  return read;
}

}  // namespace

std::string HashLogLine(const TickHash& of) { return fmt::format("{} {:016x}\n", of.tick, of.hash); }

std::vector<TickHash> ReadHashLog(const std::string& path)
{
  std::ifstream lines(path);
  if (!lines) throw std::runtime_error(fmt::format("cannot read the hash log '{}': {}", path, std::strerror(errno)));
  std::vector<TickHash> hashes;
  for (std::string line; std::getline(lines, line);)
  {
    const auto read = ReadLine(line);
    if (!read || (!hashes.empty() && read->tick <= hashes.back().tick))
      throw std::runtime_error(fmt::format("{}:{}: the hash log is damaged: {} is not the line of a later tick", path,
                                           hashes.size() + 1, Quoted(line)));
    hashes.push_back(*read);
  }
  return hashes;
}

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
  std::optional<std::uint64_t> before;
  std::string line;
  for (int number = 1; std::getline(lines, line) && !lines.eof(); ++number)
  {
    const auto at = ReadLine(line);
    if (!at || (before && at->tick != *before + 1))
      throw std::runtime_error(fmt::format(
          "{}:{}: the hash log is damaged: {} is not the line of the next tick; delete the file to go on without it",
          path_, number, Quoted(line)));
    if (at->tick >= tick) break;
    before = at->tick;
    kept += line.size() + 1;
  }
  std::filesystem::resize_file(path_, kept);
}

HashLog::~HashLog()
{
  if (file_ != nullptr) std::fclose(file_);
}

void HashLog::Write(std::uint64_t tick, std::uint64_t hash)
{
  if (file_ == nullptr) return;
  const std::string line = HashLogLine({tick, hash});
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
