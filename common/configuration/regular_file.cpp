#include "common/configuration/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace swarmanoid
{
namespace
{

std::string KindOf(mode_t mode)
{
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  if (S_ISCHR(mode) || S_ISBLK(mode)) return "a device";
  return "something else";
}

}  // namespace

RegularFile::RegularFile(const std::string& path)
    // Without O_NONBLOCK, opening a pipe would wait for its other end.
    : descriptor_(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC))
{
  if (descriptor_ < 0) throw FileError(errno == ENOENT ? "there is no such file" : std::strerror(errno));
  struct stat status
  {
  };
  const bool known = fstat(descriptor_, &status) == 0;
  if (known && S_ISREG(status.st_mode))
  {
    size_ = static_cast<std::uint64_t>(status.st_size);
    return;
  }
  const std::string reason =
      known ? "it is " + KindOf(status.st_mode) + ", not a file; copy what it holds into a file" : std::strerror(errno);
  close(descriptor_);
  throw FileError(reason);
}

RegularFile::~RegularFile() { close(descriptor_); }

std::vector<char> RegularFile::Read(std::uint64_t offset, std::size_t count) const
{
  std::vector<char> bytes(offset < size_ ? std::min<std::uint64_t>(count, size_ - offset) : 0);
  std::size_t done = 0;
  while (done < bytes.size())
  {
    const ssize_t part =
        pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (part < 0 && errno == EINTR) continue;
    if (part < 0) throw FileError(std::strerror(errno));
    if (part == 0) break;
    done += static_cast<std::size_t>(part);
  }
  bytes.resize(done);
  return bytes;
}

std::string FileMistake(const std::string& path)
{
  try
  {
    RegularFile{path};
    return {};
  }
  catch (const FileError& error)
  {
    return error.what();
  }
}

std::string ReadRegularFile(const std::string& path, std::uint64_t most_bytes)
{
  const RegularFile file(path);
  const auto too_long = [&]
  { return FileError("it is longer than " + std::to_string(most_bytes) + " bytes, the most that is read"); };
  if (file.Size() > most_bytes) throw too_long();
  // Files of the kernel state a size of 0, so they are read until they end.
  std::string text;
  std::vector<char> block(std::min<std::uint64_t>(file.Size(), most_bytes) + 4096);
  while (true)
  {
    const ssize_t part = pread(file.Descriptor(), block.data(), block.size(), static_cast<off_t>(text.size()));
    if (part < 0 && errno == EINTR) continue;
    if (part < 0) throw FileError(std::strerror(errno));
    if (part == 0) return text;
    text.append(block.data(), static_cast<std::size_t>(part));
    if (text.size() > most_bytes) throw too_long();
  }
}

}  // namespace swarmanoid
