// Reads files that a user names. Devices, pipes and folders are refused before reading, since reading them may block
// for ever or never end. Files over a limit are refused. All readers of files use it, in any process.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace swarmanoid
{

// what() is the reason without the path: "there is no such file", "it is a pipe, not a file; …".
class FileError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

class RegularFile
{
public:
  // Follows links. Throws FileError if the file cannot be read or is not regular.
  explicit RegularFile(const std::string& path);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  std::uint64_t Size() const { return size_; }  // bytes at the time of opening
  int Descriptor() const { return descriptor_; }
  // Reads up to `count` bytes from `offset`; fewer at the end of the file. Throws FileError.
  std::vector<char> Read(std::uint64_t offset, std::size_t count) const;

private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

// Returns why the file cannot be read; empty if it can.
std::string FileMistake(const std::string& path);

// Reads a whole file. Throws FileError if it cannot be read or is longer than `most_bytes`.
std::string ReadRegularFile(const std::string& path, std::uint64_t most_bytes);

}  // namespace swarmanoid
