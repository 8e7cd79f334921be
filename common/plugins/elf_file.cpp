#include "common/plugins/elf_file.h"

#include <elf.h>
#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "common/configuration/regular_file.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kMostNoteBytes = 1U << 20U;

template <class T>
T At(const std::vector<char>& bytes, std::size_t offset)
{
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

Elf64_Ehdr HeaderOf(const RegularFile& file)
{
  const std::vector<char> start = file.Read(0, sizeof(Elf64_Ehdr));
  if (start.size() < SELFMAG || std::memcmp(start.data(), ELFMAG, SELFMAG) != 0)
    throw FileError("it is not a shared library");
  if (start.size() < sizeof(Elf64_Ehdr)) throw FileError("it is cut short: its header is not whole");
  const auto header = At<Elf64_Ehdr>(start, 0);
  const bool of_this_machine = header.e_ident[EI_CLASS] == ELFCLASS64 && header.e_ident[EI_DATA] == ELFDATA2LSB;
  if (!of_this_machine || header.e_type != ET_DYN || header.e_phentsize != sizeof(Elf64_Phdr))
    throw FileError("it is not a shared library of 64 bits");
  return header;
}

void CheckWithin(const RegularFile& file, std::uint64_t offset, std::uint64_t count, std::string_view what)
{
  if (offset > file.Size() || count > file.Size() - offset)
    throw FileError(fmt::format("it is cut short: {} should end at byte {}, the file at {}; build or copy it again",
                                what, offset + count, file.Size()));
}

std::vector<Elf64_Phdr> SegmentsOf(const RegularFile& file, const Elf64_Ehdr& header)
{
  const std::uint64_t size = std::uint64_t{header.e_phnum} * sizeof(Elf64_Phdr);
  CheckWithin(file, header.e_phoff, size, "its table of segments");
  const std::vector<char> bytes = file.Read(header.e_phoff, size);
  if (bytes.size() != size) throw FileError("it changed while it was read");
  std::vector<Elf64_Phdr> segments;
  for (std::size_t k = 0; k < header.e_phnum; ++k) segments.push_back(At<Elf64_Phdr>(bytes, k * sizeof(Elf64_Phdr)));
  return segments;
}

// Returns the build-id in the notes of one segment; empty if none of them is one.
std::string BuildIdIn(const std::vector<char>& notes)
{
  const auto padded = [](std::size_t count) { return (count + 3) / 4 * 4; };
  for (std::size_t at = 0; at + sizeof(Elf64_Nhdr) <= notes.size();)
  {
    const auto note = At<Elf64_Nhdr>(notes, at);
    const std::size_t name = at + sizeof(Elf64_Nhdr);
    const std::size_t content = name + padded(note.n_namesz);
    const std::size_t end = content + padded(note.n_descsz);
    if (end > notes.size()) return {};
    if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 && std::memcmp(notes.data() + name, "GNU", 4) == 0)
    {
      std::string digits;
      for (std::size_t k = 0; k < note.n_descsz; ++k)
        digits += fmt::format("{:02x}", static_cast<unsigned char>(notes[content + k]));
      return digits;
    }
    at = end;
  }
  return {};
}

std::string DigestOf(const RegularFile& file)
{
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), &XXH3_freeState);
  XXH3_128bits_reset(state.get());
  constexpr std::size_t kBlock = 1U << 20U;
  for (std::uint64_t at = 0; at < file.Size(); at += kBlock)
  {
    const std::vector<char> block = file.Read(at, kBlock);
    XXH3_128bits_update(state.get(), block.data(), block.size());
  }
  const XXH128_hash_t digest = XXH3_128bits_digest(state.get());
  return fmt::format("{:016x}{:016x}", digest.high64, digest.low64);
}

}  // namespace

std::string MistakeInLibrary(const std::string& path)
{
  try
  {
    const RegularFile file(path);
    const Elf64_Ehdr header = HeaderOf(file);
    for (const Elf64_Phdr& segment : SegmentsOf(file, header))
      if (segment.p_type != PT_NULL) CheckWithin(file, segment.p_offset, segment.p_filesz, "a segment");
    // The linker puts the table of sections last, so a file without it is cut short.
    CheckWithin(file, header.e_shoff, std::uint64_t{header.e_shnum} * header.e_shentsize, "its table of sections");
    return {};
  }
  catch (const FileError& error)
  {
    return error.what();
  }
}

std::string BuildOfLibrary(const std::string& path)
{
  const RegularFile file(path);
  for (const Elf64_Phdr& segment : SegmentsOf(file, HeaderOf(file)))
  {
    if (segment.p_type != PT_NOTE || segment.p_filesz > kMostNoteBytes) continue;
    const std::string id = BuildIdIn(file.Read(segment.p_offset, segment.p_filesz));
    if (!id.empty()) return id;
  }
  return DigestOf(file);
}

}  // namespace swarmanoid
