// Reading files that a user names. Devices, pipes and folders are refused before anything is read, since a read of them
// may wait for ever or never end; nothing longer than a limit is read. Used by every reader of files, in any process.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace swarmanoid
{

// The reason without the path: "there is no such file", "it is a pipe, not a file; …".
class FileError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

class RegularFile
{
public:
  // Follows links. Throws FileError if it cannot be read or is no regular file.
  explicit RegularFile(const std::string& path);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  std::uint64_t Size() const { return size_; }  // bytes, when it was opened
  int Descriptor() const { return descriptor_; }
  // Up to `count` bytes from `offset`; fewer at the end of the file. Throws FileError.
  std::vector<char> Read(std::uint64_t offset, std::size_t count) const;

private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

// Why it cannot be read; empty if it can.
std::string FileMistake(const std::string& path);

// The whole of a file. Throws FileError, also if it is longer than `most_bytes`.
std::string ReadRegularFile(const std::string& path, std::uint64_t most_bytes);

}  // namespace swarmanoid
