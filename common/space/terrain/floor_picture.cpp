#include "common/space/terrain/floor_picture.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>

namespace swarmanoid
{

std::uint32_t Tinted(std::uint32_t colour, std::uint32_t tint)
{
  std::uint32_t product = 0;
  for (const unsigned shift : {16U, 8U, 0U})
    product |= ((colour >> shift & 0xff) * (tint >> shift & 0xff) + 127) / 255 << shift;
  return product;
}

std::uint32_t FloorPicture::ColourAt(double across, double up) const
{
  const auto cell = [](double share, int count) { return std::clamp(static_cast<int>(share * count), 0, count - 1); };
  return Pixel(cell(across, Columns()), Rows() - 1 - cell(up, Rows()));
}

std::shared_ptr<const FloorPicture> LoadFloorPicture(const EntityConfiguration& configuration,
                                                     const std::string& experiment_folder)
{
  const std::string file = configuration.tree.GetText("picture", "");
  if (file.empty()) return nullptr;
  const std::string path = (std::filesystem::path(experiment_folder) / file).lexically_normal().string();

  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const FloorPicture>> loaded;
  const std::lock_guard lock(mutex);
  if (auto picture = loaded[path].lock()) return picture;
  try
  {
    auto picture = std::make_shared<const FloorPicture>(ReadColourPicture(path));
    loaded[path] = picture;
    return picture;
  }
  catch (const std::exception& error)
  {
    throw ConfigurationError(configuration.tree.ValueLocation("picture"),
                             "patch '" + configuration.id + "': " + error.what());
  }
}

}  // namespace swarmanoid
