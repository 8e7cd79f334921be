// File descriptors with an owner that closes them.
#pragma once

#include <unistd.h>

#include <utility>

namespace swarmanoid
{

class FileDescriptor
{
public:
  FileDescriptor() = default;
  explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
  FileDescriptor(FileDescriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept
  {
    if (this != &other) Reset(std::exchange(other.descriptor_, -1));
    return *this;
  }
  ~FileDescriptor() { Reset(); }

  int Get() const { return descriptor_; }
  bool IsOpen() const { return descriptor_ >= 0; }
  void Reset(int descriptor = -1)
  {
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = descriptor;
  }

private:
  int descriptor_ = -1;
};

struct Pipe
{
  FileDescriptor read;  // non-blocking
  FileDescriptor write;
};

// The pipe is not inherited by programs that are started later. Throws std::runtime_error.
Pipe MakePipe();

}  // namespace swarmanoid
