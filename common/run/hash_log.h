// The file of --hash-log: the tick and the hash of its state, one tick a line, from the first one on. Written by
// whoever keeps the state: CSimulator, or the space server.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

namespace swarmanoid
{

class HashLog
{
public:
  // Empty: nothing is written. Throws std::runtime_error if the file cannot be made.
  // `goes_on_at`: the lines of ticks before it stay.
  explicit HashLog(const std::string& path, std::optional<std::uint64_t> goes_on_at = std::nullopt);
  ~HashLog();
  HashLog(const HashLog&) = delete;
  HashLog& operator=(const HashLog&) = delete;

  bool IsOpen() const { return file_ != nullptr; }
  // Throws std::runtime_error if the line is lost, as on a full disk; so does Close, for the last ones.
  void Write(std::uint64_t tick, std::uint64_t hash);
  // What was written stays when the process is killed.
  void Flush();
  void Close();

private:
  void CutAt(std::uint64_t tick) const;
  [[noreturn]] void Refuse(int cause) const;

  std::string path_;
  std::FILE* file_ = nullptr;
};

}  // namespace swarmanoid
