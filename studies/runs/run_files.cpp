#include "studies/runs/run_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

bool StaysInside(const fs::path& path)
{
  return !path.empty() && path.is_relative() &&
         std::none_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
}

}  // namespace

RunFiles RunFiles::Collect(const std::string& folder, std::uint64_t most_bytes)
{
  RunFiles all;
  std::error_code none;
  std::vector<fs::path> found;
  for (fs::recursive_directory_iterator entry(folder, none), end; entry != end; entry.increment(none))
    if (entry->is_regular_file(none) && !entry->is_symlink(none)) found.push_back(entry->path());
  // The log, which explains a failure, comes first.
  std::sort(found.begin(), found.end());
  std::stable_partition(found.begin(), found.end(), [](const fs::path& path) { return path.extension() == ".txt"; });
  for (const fs::path& path : found)
  {
    const std::string name = path.lexically_relative(folder).string();
    const std::uint64_t size = fs::file_size(path, none);
    if (none || size > most_bytes)
    {
      all.left_out.push_back(name);
      continue;
    }
    most_bytes -= size;
    std::vector<char> content(size);
    std::ifstream(path, std::ios::binary).read(content.data(), static_cast<std::streamsize>(size));
    all.files.emplace_back(name, std::move(content));
  }
  return all;
}

void RunFiles::Keep(const std::string& folder) const
{
  std::error_code error;
  fs::remove_all(folder, error);
  for (const auto& [name, content] : files)
  {
    const fs::path path = fs::path(folder) / name;
    fs::create_directories(path.parent_path(), error);
    errno = 0;
    std::ofstream file(path, std::ios::binary);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file) throw std::runtime_error(fmt::format("cannot write '{}': {}", path.string(), std::strerror(errno)));
  }
}

RunFiles RunFiles::Read(ByteReader& bytes)
{
  RunFiles all = ReadFields<RunFiles>(bytes);
  for (const auto& [name, content] : all.files)
    if (!StaysInside(name)) throw std::runtime_error(fmt::format("a file of a run would be outside: '{}'", name));
  return all;
}

}  // namespace swarmanoid
