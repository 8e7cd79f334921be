// ExportFile: the output of `swarmanoid export`: a new file, or standard output.
#pragma once

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/program/usage_error.h"

namespace swarmanoid
{

class ExportFile
{
public:
  // `option`: the name of the option that gives the path, for errors; "-" is standard output. Throws UsageError if the
  // file exists or cannot be made.
  ExportFile(const std::string& option, const std::string& path)
      : path_(path), file_(path == "-" ? stdout : std::fopen(path.c_str(), "wxe"))
  {
    if (file_ != nullptr) return;
    if (errno == EEXIST)
      throw UsageError(fmt::format("{}: the file '{}' is there already; name another one", option, path));
    throw UsageError(fmt::format("{}: cannot write '{}': {}", option, path, std::strerror(errno)));
  }
  ~ExportFile()
  {
    if (file_ != nullptr && file_ != stdout) std::fclose(file_);
  }
  ExportFile(const ExportFile&) = delete;
  ExportFile& operator=(const ExportFile&) = delete;

  // Both throw std::runtime_error with the path.
  void Write(std::string_view text)
  {
    if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) Fail();
  }
  void Close()
  {
    const bool good = file_ == stdout ? std::fflush(file_) == 0 : std::fclose(file_) == 0;
    file_ = nullptr;
    if (!good) Fail();
  }

private:
  [[noreturn]] void Fail() const
  {
    throw std::runtime_error(fmt::format("cannot write '{}': {}", path_, std::strerror(errno)));
  }

  std::string path_;
  std::FILE* file_;
};

}  // namespace swarmanoid
