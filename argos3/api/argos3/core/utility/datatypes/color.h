// CColor. In files it is a name ("red", "gray50"), "r,g,b" or "r,g,b,a", each from 0 to 255.
#pragma once

#include <argos3/core/utility/string_utilities.h>

namespace argos
{

class CColor
{
public:
  static const CColor BLACK, WHITE, RED, GREEN, BLUE, MAGENTA, CYAN, YELLOW, ORANGE, BROWN, PURPLE;
  static const CColor GRAY10, GRAY20, GRAY30, GRAY40, GRAY50, GRAY60, GRAY70, GRAY80, GRAY90;

  constexpr CColor() = default;
  constexpr CColor(UInt8 red, UInt8 green, UInt8 blue, UInt8 alpha = 255)
      : red_(red), green_(green), blue_(blue), alpha_(alpha)
  {
  }
  // Makes a colour from `argb`, 0xAARRGGBB.
  constexpr explicit CColor(UInt32 argb)
      : CColor(static_cast<UInt8>(argb >> 16), static_cast<UInt8>(argb >> 8), static_cast<UInt8>(argb),
               static_cast<UInt8>(argb >> 24))
  {
  }

  UInt8 GetRed() const { return red_; }
  UInt8 GetGreen() const { return green_; }
  UInt8 GetBlue() const { return blue_; }
  UInt8 GetAlpha() const { return alpha_; }
  void SetRed(UInt8 red) { red_ = red; }
  void SetGreen(UInt8 green) { green_ = green; }
  void SetBlue(UInt8 blue) { blue_ = blue; }
  void SetAlpha(UInt8 alpha) { alpha_ = alpha; }
  void Set(UInt8 red, UInt8 green, UInt8 blue, UInt8 alpha = 255) { *this = CColor(red, green, blue, alpha); }
  // Reads a colour as in files. Throws CARGoSException for an invalid one.
  void Set(const std::string& name);
  // Returns the brightness 0 to 255, weighted for the eye (ITU-R BT.601).
  Real ToGrayScale() const { return 0.299 * red_ + 0.587 * green_ + 0.114 * blue_; }
  // Returns the colour over a background, weighted by its alpha.
  CColor Blend(const CColor& background) const
  {
    const Real weight = alpha_ / 255.0;
    const auto mix = [weight](UInt8 over, UInt8 under)
    { return static_cast<UInt8>(weight * over + (1 - weight) * under); };
    return CColor(mix(red_, background.red_), mix(green_, background.green_), mix(blue_, background.blue_));
  }
  // Returns 0xAABBGGRR.
  operator UInt32() const
  {
    return static_cast<UInt32>(alpha_) << 24 | static_cast<UInt32>(blue_) << 16 | static_cast<UInt32>(green_) << 8 |
           red_;
  }

  bool operator==(const CColor& other) const
  {
    return red_ == other.red_ && green_ == other.green_ && blue_ == other.blue_ && alpha_ == other.alpha_;
  }
  bool operator!=(const CColor& other) const { return !(*this == other); }
  // Writes its name, or the four numbers if it has none.
  friend std::ostream& operator<<(std::ostream& stream, const CColor& colour);
  friend std::istream& operator>>(std::istream& stream, CColor& colour);

private:
  UInt8 red_ = 0;
  UInt8 green_ = 0;
  UInt8 blue_ = 0;
  UInt8 alpha_ = 255;
};

inline const CColor CColor::BLACK{0, 0, 0};
inline const CColor CColor::WHITE{255, 255, 255};
inline const CColor CColor::RED{255, 0, 0};
inline const CColor CColor::GREEN{0, 255, 0};
inline const CColor CColor::BLUE{0, 0, 255};
inline const CColor CColor::MAGENTA{255, 0, 255};
inline const CColor CColor::CYAN{0, 255, 255};
inline const CColor CColor::YELLOW{255, 255, 0};
inline const CColor CColor::ORANGE{255, 140, 0};
inline const CColor CColor::BROWN{165, 42, 42};
inline const CColor CColor::PURPLE{160, 32, 240};
inline const CColor CColor::GRAY10{26, 26, 26};
inline const CColor CColor::GRAY20{51, 51, 51};
inline const CColor CColor::GRAY30{77, 77, 77};
inline const CColor CColor::GRAY40{102, 102, 102};
inline const CColor CColor::GRAY50{127, 127, 127};
inline const CColor CColor::GRAY60{153, 153, 153};
inline const CColor CColor::GRAY70{179, 179, 179};
inline const CColor CColor::GRAY80{204, 204, 204};
inline const CColor CColor::GRAY90{229, 229, 229};

}  // namespace argos
