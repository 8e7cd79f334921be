// The file of --hash-log: the tick and the hash of its state, one tick a line, from the first one on. Written by
// whoever keeps the state: CSimulator, or the space server.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

namespace swarmanoid
{

class HashLog
{
public:
  // Empty: nothing is written. Throws std::runtime_error if the file cannot be made.
  explicit HashLog(const std::string& path);
  ~HashLog();
  HashLog(const HashLog&) = delete;
  HashLog& operator=(const HashLog&) = delete;

  bool IsOpen() const { return file_ != nullptr; }
  // Throws std::runtime_error if the line is lost, as on a full disk; so does Close, for the last ones.
  void Write(std::uint64_t tick, std::uint64_t hash);
  void Close();

private:
  [[noreturn]] void Refuse(int cause) const;

  std::string path_;
  std::FILE* file_ = nullptr;
};

}  // namespace swarmanoid
