// The files of the bundled page, held in memory. No other file can be requested, whatever the path says.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace swarmanoid
{

struct PageFile
{
  using Bytes = std::shared_ptr<const std::string>;

  std::string type;  // content type
  std::string tag;   // identifies these bytes, for ETag
  Bytes bytes;
  Bytes gzipped;  // the compressed bytes; none if compression gains too little
};

class PageFiles
{
public:
  PageFiles() = default;
  // Reads all files of a folder and its subfolders; FILE.gz is FILE compressed. Throws std::runtime_error if index.html
  // is missing.
  explicit PageFiles(const std::filesystem::path& folder);

  void Add(const std::string& path, const std::string& type, std::string bytes, PageFile::Bytes gzipped = {});
  // Returns a file, or nullptr if it does not exist. "/" means "/index.html".
  const PageFile* Find(std::string_view path) const;

private:
  std::map<std::string, PageFile, std::less<>> files_;
};

// Returns the folder beside the library that contains this code.
std::filesystem::path InstalledPageFolder();

}  // namespace swarmanoid
