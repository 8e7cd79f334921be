#include "visualiser/web/page_files.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>

namespace swarmanoid
{
namespace
{

std::string TypeOf(const std::filesystem::path& path)
{
  static const std::map<std::string, std::string> types{{".html", "text/html; charset=utf-8"},
                                                        {".js", "text/javascript; charset=utf-8"},
                                                        {".css", "text/css; charset=utf-8"},
                                                        {".json", "application/json"},
                                                        {".svg", "image/svg+xml"},
                                                        {".txt", "text/plain; charset=utf-8"}};
  const auto found = types.find(path.extension().string());
  return found == types.end() ? "application/octet-stream" : found->second;
}

std::string BytesOf(const std::filesystem::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

PageFiles::PageFiles(const std::filesystem::path& folder)
{
  std::error_code error;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, error))
  {
    if (!entry.is_regular_file() || entry.path().extension() == ".gz") continue;
    const std::filesystem::path compressed = entry.path().string() + ".gz";
    PageFile::Bytes gzipped;
    if (std::filesystem::exists(compressed)) gzipped = std::make_shared<const std::string>(BytesOf(compressed));
    Add("/" + entry.path().lexically_relative(folder).generic_string(), TypeOf(entry.path()), BytesOf(entry.path()),
        std::move(gzipped));
  }
  if (Find("/") == nullptr)
    throw std::runtime_error("web_render: the page is not in '" + folder.string() +
                             "'; install the packages nodejs and npm and build again");
}

void PageFiles::Add(const std::string& path, const std::string& type, std::string bytes, PageFile::Bytes gzipped)
{
  std::string tag = fmt::format("\"{:016x}\"", std::hash<std::string>()(bytes));
  files_[path] = {type, std::move(tag), std::make_shared<const std::string>(std::move(bytes)), std::move(gzipped)};
}

const PageFile* PageFiles::Find(std::string_view path) const
{
  const auto found = files_.find(path == "/" ? std::string_view("/index.html") : path);
  return found == files_.end() ? nullptr : &found->second;
}

std::filesystem::path InstalledPageFolder()
{
  Dl_info place{};
  dladdr(reinterpret_cast<const void*>(&InstalledPageFolder), &place);
  return std::filesystem::path(place.dli_fname).parent_path() / "web";
}

}  // namespace swarmanoid
