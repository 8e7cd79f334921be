// The file of --hash-log: one line a tick with the tick and the hash of its state, from the first tick on. CSimulator
// or the space server writes it.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace swarmanoid
{

struct TickHash
{
  std::uint64_t tick = 0;
  std::uint64_t hash = 0;

  bool operator==(const TickHash&) const = default;
};

// Returns the line of the file for a tick, with its end.
std::string HashLogLine(const TickHash& of);
// Reads a whole file. Throws std::runtime_error with path and line if a line is not that of a later tick than the one
// before it.
std::vector<TickHash> ReadHashLog(const std::string& path);

class HashLog
{
public:
  // An empty path writes nothing. Throws std::runtime_error if the file cannot be made. `goes_on_at`: lines of earlier
  // ticks stay.
  explicit HashLog(const std::string& path, std::optional<std::uint64_t> goes_on_at = std::nullopt);
  ~HashLog();
  HashLog(const HashLog&) = delete;
  HashLog& operator=(const HashLog&) = delete;

  bool IsOpen() const { return file_ != nullptr; }
  // Throws std::runtime_error if the line is lost, for example on a full disk. Close throws the same for the last
  // lines.
  void Write(std::uint64_t tick, std::uint64_t hash);
  // Makes the written lines survive a kill of the process.
  void Flush();
  void Close();

private:
  void CutAt(std::uint64_t tick) const;
  [[noreturn]] void Refuse(int cause) const;

  std::string path_;
  std::FILE* file_ = nullptr;
};

}  // namespace swarmanoid
