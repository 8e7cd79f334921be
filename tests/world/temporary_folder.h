// TemporaryFolder: a folder for one test, which is removed with its content.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace swarmanoid::test
{

// Returns the whole text of a file, or nothing if it cannot be read.
inline std::string TextOf(const std::filesystem::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Other tests, and the same test in another process, have other folders.
class TemporaryFolder
{
public:
  // `name`: a part of its name. `parent`: the folder that contains it.
  explicit TemporaryFolder(const std::string& name = "test",
                           const std::filesystem::path& parent = std::filesystem::temp_directory_path())
  {
    std::string path = (parent / ("swarmanoid_" + name + "_XXXXXX")).string();
    if (mkdtemp(path.data()) == nullptr) throw std::runtime_error("cannot make the folder " + path);
    path_ = path;
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& Path() const { return path_; }
  std::filesystem::path operator/(const std::filesystem::path& name) const
  {
    return std::filesystem::path(path_) / name;
  }
  operator std::filesystem::path() const { return path_; }

  // Writes a file, and the folders above it. Returns its path.
  std::string Write(const std::filesystem::path& name, const std::string& text) const
  {
    const std::filesystem::path file = *this / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
  }
  std::string Read(const std::filesystem::path& name) const { return TextOf(*this / name); }

private:
  std::string path_;
};

}  // namespace swarmanoid::test
