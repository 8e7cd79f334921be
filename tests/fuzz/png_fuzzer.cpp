// Any bytes are refused as the picture of a height map with a reason that names the file, or are the stated number of
// greys from 0 to 1. The same holds for the bytes with correct checksums of their chunks.
#include <png.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

#include "common/space/terrain/png_picture.h"
#include "tests/fuzz/fuzz_driver.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kSignature = 8;
// Larger ones are slow, not wrong, unless they are refused.
constexpr std::uint64_t kMostPixels = 1U << 20U;
constexpr std::uint64_t kRefusedPixels = 1U << 26U;

std::uint32_t BigEndian(const fuzz::Input& bytes, std::size_t at)
{
  return std::uint32_t{bytes[at]} << 24U | std::uint32_t{bytes[at + 1]} << 16U | std::uint32_t{bytes[at + 2]} << 8U |
         bytes[at + 3];
}

void Seal(fuzz::Input& bytes)
{
  for (std::size_t at = kSignature; at + 12 <= bytes.size();)
  {
    const std::size_t length = BigEndian(bytes, at);
    if (length > bytes.size() - at - 12) return;
    const auto checksum = static_cast<std::uint32_t>(crc32(0, bytes.data() + at + 4, static_cast<uInt>(length + 4)));
    for (unsigned k = 0; k < 4; ++k) bytes[at + 8 + length + k] = static_cast<std::uint8_t>(checksum >> (24 - 8 * k));
    at += 12 + length;
  }
}

void Take(const fuzz::Input& bytes)
{
  if (bytes.size() >= 24)
  {
    const std::uint64_t pixels = std::uint64_t{BigEndian(bytes, 16)} * BigEndian(bytes, 20);
    if (pixels > kMostPixels && pixels <= kRefusedPixels) return;
  }
  const std::string path = "png_fuzzer." + std::to_string(getpid()) + ".png";
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  try
  {
    const GreyPicture picture = ReadGreyPicture(path);
    if (picture.values.size() != static_cast<std::size_t>(picture.columns) * static_cast<std::size_t>(picture.rows))
      std::abort();
    for (const double value : picture.values)
      if (!(value >= 0 && value <= 1.0000001)) std::abort();
  }
  catch (const std::runtime_error& error)
  {
    if (std::string(error.what()).find(path) == std::string::npos) std::abort();
  }
  unlink(path.c_str());
}

fuzz::Input Picture(std::uint32_t format)
{
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 5;
  image.height = 4;
  image.format = format;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
  for (std::size_t k = 0; k < pixels.size(); ++k) pixels[k] = static_cast<std::uint8_t>(37 * k);
  png_alloc_size_t size = 4096;
  fuzz::Input bytes(size);
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr) == 0) std::abort();
  bytes.resize(size);
  return bytes;
}

}  // namespace

std::vector<fuzz::Input> fuzz::FirstInputs()
{
  std::vector<Input> inputs;
  for (const std::uint32_t format : std::array<std::uint32_t, 5>{PNG_FORMAT_GRAY, PNG_FORMAT_GA, PNG_FORMAT_RGB,
                                                                 PNG_FORMAT_RGBA, PNG_FORMAT_LINEAR_Y})
    inputs.push_back(Picture(format));
  // 2^30 by 2^30 pixels.
  Input huge = inputs.front();
  huge[16] = huge[20] = 0x40;
  Seal(huge);
  inputs.push_back(std::move(huge));
  return inputs;
}

}  // namespace swarmanoid

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* input, std::size_t count)
{
  swarmanoid::fuzz::Input bytes(input, input + count);
  swarmanoid::Take(bytes);
  swarmanoid::Seal(bytes);
  swarmanoid::Take(bytes);
  return 0;
}
