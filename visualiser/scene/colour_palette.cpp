// Problem: a GIF has 256 colours a picture; a drawn arena has some thousand, most of them in few, large areas. Method:
// median cut (P. Heckbert, Color image quantization for frame buffer display, SIGGRAPH 1982). All colours are in one
// box; the box whose pixels differ most, times the root of their number, is cut at the median of its longest side,
// until there are enough boxes; each gives its mean. 27 more colours are evenly spread, for LEDs that shine later.
// Colours are counted in bins of 5 bits a channel. There is no dithering, as areas of one colour should stay so.
//
// Invariant: each used bin has the number of its nearest colour.
#include "visualiser/scene/colour_palette.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace swarmanoid
{
namespace
{

constexpr std::size_t kSpread = 27;
constexpr std::size_t kChosen = 256 - kSpread;
constexpr int kFar = 40;                  // the sum of the differences of red, green and blue
constexpr std::uint64_t kFarShare = 200;  // if one of so many pixels more is far, the colours are chosen again

int Distance(const std::array<int, 3>& a, std::uint32_t colour)
{
  return std::abs(a[0] - static_cast<int>(colour >> 16U & 255U)) +
         std::abs(a[1] - static_cast<int>(colour >> 8U & 255U)) + std::abs(a[2] - static_cast<int>(colour & 255U));
}

}  // namespace

ColourPalette::ColourPalette() : counts_(kBins), numbers_(kBins) { colours_.fill(0xff000000); }

std::array<int, 3> ColourPalette::Count::Mean() const
{
  std::array<int, 3> mean{};
  for (std::size_t k = 0; k < 3; ++k) mean[k] = static_cast<int>((sums[k] + pixels / 2) / pixels);
  return mean;
}

void ColourPalette::Suit(const Picture& picture)
{
  for (const std::uint32_t bin : used_) counts_[bin] = {};
  used_.clear();
  for (std::size_t at = 0; at + 3 < picture.pixels.size(); at += 4)
  {
    const std::uint8_t* pixel = &picture.pixels[at];
    const std::size_t bin = Bin(pixel[0], pixel[1], pixel[2]);
    Count& count = counts_[bin];
    if (count.pixels++ == 0) used_.push_back(static_cast<std::uint32_t>(bin));
    for (std::size_t k = 0; k < 3; ++k) count.sums[k] += pixel[k];
  }
  if (far_ && Assign() <= *far_ + picture.pixels.size() / 4 / kFarShare) return;
  Choose();
  far_ = Assign();
}

std::uint64_t ColourPalette::Assign()
{
  std::uint64_t far = 0;
  for (const std::uint32_t bin : used_)
  {
    const std::array<int, 3> mean = counts_[bin].Mean();
    int nearest = std::numeric_limits<int>::max();
    for (std::size_t number = 0; number < colours_.size(); ++number)
      if (const int distance = Distance(mean, colours_[number]); distance < nearest)
      {
        nearest = distance;
        numbers_[bin] = static_cast<std::uint8_t>(number);
      }
    if (nearest > kFar) far += counts_[bin].pixels;
  }
  return far;
}

void ColourPalette::Choose()
{
  // A box is a part of `used_`.
  struct Box
  {
    std::size_t begin, end;
    std::size_t side = 0;  // the longest one
    double weight = 0;     // its length, times the root of the pixels
  };
  const auto measured = [&](std::size_t begin, std::size_t end)
  {
    Box box{begin, end};
    double pixels = 0;
    for (std::size_t at = begin; at < end; ++at) pixels += static_cast<double>(counts_[used_[at]].pixels);
    for (std::size_t k = 0; k < 3; ++k)
    {
      int low = 255, high = 0;
      for (std::size_t at = begin; at < end; ++at)
      {
        const int value = counts_[used_[at]].Mean()[k];
        low = std::min(low, value);
        high = std::max(high, value);
      }
      if (const double weight = (high - low) * std::sqrt(pixels); weight > box.weight)
        box.side = k, box.weight = weight;
    }
    return box;
  };
  std::vector<Box> boxes{measured(0, used_.size())};
  while (boxes.size() < kChosen)
  {
    const auto widest = std::ranges::max_element(boxes, {}, &Box::weight);
    if (widest->end - widest->begin < 2) break;
    const Box box = *widest;
    const auto of_side = [&](std::uint32_t bin) { return counts_[bin].Mean()[box.side]; };
    const auto first = used_.begin() + static_cast<std::ptrdiff_t>(box.begin);
    const auto last = used_.begin() + static_cast<std::ptrdiff_t>(box.end);
    std::ranges::sort(first, last, {}, of_side);
    // Cuts where half of the pixels are before, with at least one bin on each side.
    std::uint64_t all = 0, before = 0;
    for (auto bin = first; bin != last; ++bin) all += counts_[*bin].pixels;
    auto cut = first;
    while (cut + 1 < last - 1 && 2 * (before += counts_[*cut].pixels) < all) ++cut;
    const auto middle = static_cast<std::size_t>(cut + 1 - used_.begin());
    *widest = measured(box.begin, middle);
    boxes.push_back(measured(middle, box.end));
  }
  colours_.fill(0xff000000);
  for (std::uint32_t k = 0; k < kSpread; ++k)
    colours_[kChosen + k] = 0xff000000U | (k / 9 * 255 / 2) << 16U | (k / 3 % 3 * 255 / 2) << 8U | k % 3 * 255 / 2;
  for (std::size_t number = 0; number < boxes.size(); ++number)
  {
    Count sum;
    for (std::size_t at = boxes[number].begin; at < boxes[number].end; ++at)
    {
      sum.pixels += counts_[used_[at]].pixels;
      for (std::size_t k = 0; k < 3; ++k) sum.sums[k] += counts_[used_[at]].sums[k];
    }
    if (sum.pixels == 0) continue;
    const std::array<int, 3> mean = sum.Mean();
    colours_[number] = 0xff000000U | static_cast<std::uint32_t>(mean[0]) << 16U |
                       static_cast<std::uint32_t>(mean[1]) << 8U | static_cast<std::uint32_t>(mean[2]);
  }
}

}  // namespace swarmanoid
