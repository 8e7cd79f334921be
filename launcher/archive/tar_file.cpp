#include "launcher/archive/tar_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "common/program/usage_error.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kTarPortionBytes = std::size_t{1} << 16U;
constexpr int kGzipWindow = 16 + MAX_WBITS;              // the wrapper of gzip around the stream of zlib
constexpr std::uint64_t kMostMemberBytes = 1ULL << 33U;  // 11 octal digits

// The header of an entry. Numbers are octal digits.
struct TarHeader
{
  char name[100];
  char mode[8];
  char owner[8];
  char group[8];
  char size[12];
  char time[12];
  char checksum[8];
  char kind;
  char link[100];
  char magic[8];  // "ustar", NUL, "00"
  char owner_name[32];
  char group_name[32];
  char device[16];
  char prefix[155];  // the folder of the name, for long names
  char unused[12];
};
static_assert(sizeof(TarHeader) == kTarBlockBytes);

constexpr char kPlainFile = '0';
constexpr std::string_view kUstar{"ustar\00000", 8};

std::uint64_t PaddingOf(std::uint64_t bytes) { return (kTarBlockBytes - bytes % kTarBlockBytes) % kTarBlockBytes; }

// The sum of all bytes of the header, with blanks in place of the checksum itself.
unsigned ChecksumOfHeader(TarHeader header)
{
  std::fill(std::begin(header.checksum), std::end(header.checksum), ' ');
  const auto* bytes = reinterpret_cast<const unsigned char*>(&header);
  unsigned sum = 0;
  for (std::size_t k = 0; k < sizeof header; ++k) sum += bytes[k];
  return sum;
}

template <std::size_t size>
std::string_view TextOfField(const char (&field)[size])
{
  return {field, strnlen(field, size)};
}

template <std::size_t size>
std::optional<std::uint64_t> NumberOfField(const char (&field)[size])
{
  const std::string_view text = TextOfField(field);
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, 8);
  const bool good = error == std::errc() &&
                    std::string_view(end, text.data() + text.size()).find_first_not_of(' ') == std::string_view::npos;
  return good ? std::optional(number) : std::nullopt;
}

}  // namespace

TarWriter::TarWriter(const std::string& option, const std::string& path)
    : path_(path), file_(std::fopen(path.c_str(), "wxe")), compressed_(kTarPortionBytes)
{
  if (file_ == nullptr && errno == EEXIST)
    throw UsageError(fmt::format("{}: the file '{}' is there already; name another one", option, path));
  if (file_ == nullptr) throw UsageError(fmt::format("{}: cannot write '{}': {}", option, path, std::strerror(errno)));
  constexpr int kMemoryLevel = 8;
  if (deflateInit2(&stream_, Z_BEST_COMPRESSION, Z_DEFLATED, kGzipWindow, kMemoryLevel, Z_DEFAULT_STRATEGY) != Z_OK)
    Fail("zlib cannot start");
}

TarWriter::~TarWriter()
{
  deflateEnd(&stream_);
  if (file_ == nullptr) return;
  std::fclose(file_);
  std::remove(path_.c_str());
}

void TarWriter::Fail(const std::string& reason)
{
  throw std::runtime_error(fmt::format("cannot write '{}': {}", path_, reason));
}

void TarWriter::Begin(const std::string& name, std::uint64_t bytes)
{
  TarHeader header{};
  // A long name is cut at a slash into a prefix and the rest.
  std::size_t cut = 0;
  if (name.size() > sizeof header.name)
  {
    const std::size_t slash = name.find('/', name.size() - sizeof header.name - 1);
    if (slash == std::string::npos || slash > sizeof header.prefix)
      Fail(fmt::format("the name '{}' is too long for the archive; give its folders shorter names", name));
    name.copy(header.prefix, slash);
    cut = slash + 1;
  }
  if (bytes >= kMostMemberBytes) Fail(fmt::format("'{}' is longer than 8 GiB", name));
  name.copy(header.name, sizeof header.name, cut);
  const auto put = [](auto& field, const std::string& text) { text.copy(field, sizeof field); };
  put(header.mode, "0000644");
  put(header.owner, "0000000");
  put(header.group, "0000000");
  put(header.size, fmt::format("{:011o}", bytes));
  put(header.time, "00000000000");
  header.kind = kPlainFile;
  kUstar.copy(header.magic, sizeof header.magic);
  put(header.checksum, fmt::format("{:06o}", ChecksumOfHeader(header)));
  header.checksum[7] = ' ';
  Compress({reinterpret_cast<const char*>(&header), sizeof header}, Z_NO_FLUSH);
  left_ = bytes;
  padding_ = PaddingOf(bytes);
}

void TarWriter::Write(std::span<const char> content)
{
  if (content.size() > left_) Fail("a file grew while it was read");
  left_ -= content.size();
  Compress(content, Z_NO_FLUSH);
}

void TarWriter::End()
{
  if (left_ != 0) Fail("a file became shorter while it was read");
  Compress(std::vector<char>(padding_), Z_NO_FLUSH);
}

std::string TarWriter::Close()
{
  Compress(std::vector<char>(2 * kTarBlockBytes), Z_FINISH);
  if (std::fclose(std::exchange(file_, nullptr)) != 0)
  {
    const std::string reason = std::strerror(errno);
    std::remove(path_.c_str());
    Fail(reason);
  }
  return digest_.Text();
}

void TarWriter::Compress(std::span<const char> bytes, int flush)
{
  // zlib counts in 32 bits.
  do {
    const std::span<const char> portion = bytes.first(std::min(bytes.size(), kTarPortionBytes));
    bytes = bytes.subspan(portion.size());
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(portion.data()));
    stream_.avail_in = static_cast<uInt>(portion.size());
    do {
      stream_.next_out = reinterpret_cast<Bytef*>(compressed_.data());
      stream_.avail_out = static_cast<uInt>(compressed_.size());
      deflate(&stream_, bytes.empty() ? flush : Z_NO_FLUSH);
      const std::size_t count = compressed_.size() - stream_.avail_out;
      if (std::fwrite(compressed_.data(), 1, count, file_) != count) Fail(std::strerror(errno));
      digest_.Add({compressed_.data(), count});
    } while (stream_.avail_out == 0);
  } while (!bytes.empty());
}

TarReader::TarReader(const std::string& path) : file_(path)
{
  if (inflateInit2(&stream_, kGzipWindow) != Z_OK) throw std::runtime_error("zlib cannot start");
}

TarReader::~TarReader() { inflateEnd(&stream_); }

bool TarReader::Fill(std::size_t bytes)
{
  buffer_.resize(bytes);
  stream_.next_out = reinterpret_cast<Bytef*>(buffer_.data());
  stream_.avail_out = static_cast<uInt>(bytes);
  while (stream_.avail_out > 0 && !stream_has_ended_)
  {
    if (stream_.avail_in == 0)
    {
      compressed_ = file_.Read(at_, kTarPortionBytes);
      at_ += compressed_.size();
      stream_.next_in = reinterpret_cast<Bytef*>(compressed_.data());
      stream_.avail_in = static_cast<uInt>(compressed_.size());
    }
    const int result = inflate(&stream_, Z_NO_FLUSH);
    if (result == Z_STREAM_END)
      stream_has_ended_ = true;
    else if (result == Z_BUF_ERROR && compressed_.empty())
      throw std::runtime_error("it is cut short");
    else if (result != Z_OK)
      throw std::runtime_error(at_ <= kTarPortionBytes && stream_.total_out == 0 ? "it is no tar.gz file"
                                                                                 : "its compressed bytes are damaged");
  }
  if (stream_.avail_out == bytes) return false;
  if (stream_.avail_out > 0) throw std::runtime_error("it is cut short");
  return true;
}

std::optional<TarEntry> TarReader::Next()
{
  if (!Fill(kTarBlockBytes)) throw std::runtime_error("it is cut short");
  TarHeader header;
  std::memcpy(&header, buffer_.data(), sizeof header);
  const auto is_zero = [this] { return std::ranges::all_of(buffer_, [](char c) { return c == 0; }); };
  if (is_zero())
  {
    // Two blocks of zeros end the file. Other programs write up to 20 of them.
    constexpr int kMostZeroBlocks = 20;
    int blocks = 1;
    while (blocks < kMostZeroBlocks && Fill(kTarBlockBytes) && is_zero()) ++blocks;
    if (blocks < 2 || !is_zero() || Fill(1) || stream_.avail_in > 0 || at_ < file_.Size())
      throw std::runtime_error("something stands behind its end, or its end is missing");
    return std::nullopt;
  }
  if (std::string_view(header.magic, sizeof header.magic) != kUstar ||
      NumberOfField(header.checksum) != ChecksumOfHeader(header))
    throw std::runtime_error("it has a header that is not of POSIX tar, or is damaged");
  TarEntry entry{std::string(TextOfField(header.name)), NumberOfField(header.size).value_or(kMostMemberBytes)};
  if (const std::string_view prefix = TextOfField(header.prefix); !prefix.empty())
    entry.name = std::string(prefix) + "/" + entry.name;
  if (header.kind != kPlainFile)
    throw std::runtime_error(fmt::format("'{}' in it is no plain file, but a link, folder or device", entry.name));
  if (entry.bytes >= kMostMemberBytes)
    throw std::runtime_error(fmt::format("'{}' in it has no valid size", entry.name));
  left_ = entry.bytes;
  padding_ = PaddingOf(entry.bytes);
  return entry;
}

std::span<const char> TarReader::Read()
{
  if (left_ == 0)
  {
    if (padding_ > 0) Fill(std::exchange(padding_, 0));
    return {};
  }
  const std::size_t count = std::min<std::uint64_t>(left_, kTarPortionBytes);
  if (!Fill(count)) throw std::runtime_error("it is cut short");
  left_ -= count;
  return buffer_;
}

}  // namespace swarmanoid
