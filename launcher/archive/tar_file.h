// Files of the form .tar.gz: POSIX ustar, compressed by zlib. The writer gives equal content equal bytes: times are 0,
// and owners and modes are fixed. The reader takes plain files only. It refuses links, folders and every other kind of
// entry, so nothing that it returns can lead outside the folder of its caller. One thread.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/configuration/regular_file.h"
#include "common/run/access/digest.h"

namespace swarmanoid
{

inline constexpr std::size_t kTarBlockBytes = 512;

class TarWriter
{
public:
  // Makes the file, which must not exist. Throws UsageError, which names the option. The other functions throw
  // std::runtime_error with the path.
  TarWriter(const std::string& option, const std::string& path);
  // Removes the file unless Close returned.
  ~TarWriter();
  TarWriter(const TarWriter&) = delete;
  TarWriter& operator=(const TarWriter&) = delete;

  // Begins a file, whose content must follow in `bytes` bytes.
  void Begin(const std::string& name, std::uint64_t bytes);
  void Write(std::span<const char> content);
  void End();
  // Returns the SHA-256 of the whole file.
  std::string Close();

private:
  void Compress(std::span<const char> bytes, int flush);
  [[noreturn]] void Fail(const std::string& reason);

  std::string path_;
  std::FILE* file_;
  z_stream stream_{};
  std::vector<char> compressed_;
  Sha256 digest_;
  std::uint64_t left_ = 0;     // bytes of the current file
  std::uint64_t padding_ = 0;  // bytes after it
};

struct TarEntry
{
  std::string name;
  std::uint64_t bytes = 0;
};

class TarReader
{
public:
  // The file must exist. All functions throw std::runtime_error with the reason, without the path, if the file is no
  // tar.gz file, is damaged, or has an entry that is no plain file.
  explicit TarReader(const std::string& path);
  ~TarReader();
  TarReader(const TarReader&) = delete;
  TarReader& operator=(const TarReader&) = delete;

  // Moves to the next file. The content of the one before must have been read. Returns nothing at the end.
  std::optional<TarEntry> Next();
  // Reads the next part of the content; returns an empty span at its end. The span is valid until the next call.
  std::span<const char> Read();

private:
  // Decompresses exactly that many bytes into buffer_. Returns false if the file ends before the first one.
  bool Fill(std::size_t bytes);

  RegularFile file_;
  std::uint64_t at_ = 0;  // in the compressed file
  std::vector<char> compressed_;
  z_stream stream_{};
  bool stream_has_ended_ = false;
  std::vector<char> buffer_;
  std::uint64_t left_ = 0;
  std::uint64_t padding_ = 0;
};

}  // namespace swarmanoid
