#include "visualiser/web/page_files.h"

#include <dlfcn.h>

#include <fstream>
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

}  // namespace

PageFiles::PageFiles(const std::filesystem::path& folder)
{
  std::error_code error;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, error))
  {
    if (!entry.is_regular_file()) continue;
    std::ifstream file(entry.path(), std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    Add("/" + entry.path().lexically_relative(folder).generic_string(), TypeOf(entry.path()), std::move(bytes));
  }
  if (Find("/") == nullptr)
    throw std::runtime_error("web_render: the page is not in '" + folder.string() +
                             "'; install the packages nodejs and npm and build again");
}

void PageFiles::Add(const std::string& path, const std::string& type, std::string bytes)
{
  files_[path] = {type, std::make_shared<const std::string>(std::move(bytes))};
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
  return std::filesystem::path(place.dli_fname).parent_path() / "swarmanoid_web";
}

}  // namespace swarmanoid
