// The files of the bundled page, held in memory: what is not among them cannot be asked for, whatever the path says.
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
  std::string tag;   // of these bytes and no others, for ETag
  Bytes bytes;
  Bytes gzipped;  // the same, compressed; none if it is not worth it
};

class PageFiles
{
public:
  PageFiles() = default;
  // Reads all files of a folder and its subfolders; FILE.gz is FILE compressed. Throws std::runtime_error if there is
  // no index.html.
  explicit PageFiles(const std::filesystem::path& folder);

  void Add(const std::string& path, const std::string& type, std::string bytes, PageFile::Bytes gzipped = {});
  // "/" is "/index.html". nullptr if there is none.
  const PageFile* Find(std::string_view path) const;

private:
  std::map<std::string, PageFile, std::less<>> files_;
};

// Beside the library that this code is part of.
std::filesystem::path InstalledPageFolder();

}  // namespace swarmanoid
