// The pie camera of the footbot: the blobs of its omnidirectional camera by sector and colour.
#include <array>
#include <bit>
#include <stdexcept>

#include "common/control_interface/ci_pie_camera_sensor.h"
#include "common/math/elementary.h"
#include "controller_host/devices/cameras/colour_camera.h"
#include "controller_host/devices/device_plugins.h"

namespace swarmanoid
{
namespace
{

// Entry b - 1 is the colour with the bits b of red (4), green (2) and blue (1).
constexpr std::array<std::uint32_t, 7> kColours{CCI_Colour::BLUE, CCI_Colour::GREEN,   CCI_Colour::CYAN,
                                                CCI_Colour::RED,  CCI_Colour::MAGENTA, CCI_Colour::YELLOW,
                                                CCI_Colour::WHITE};

class Pie : public CCI_PieCameraSensor
{
public:
  Pie(OnDemandSensor& batch, std::size_t k, unsigned sectors)
      : batch_(batch), k_(k), sectors_(sectors), slices_(sectors * kColours.size())
  {
  }
  unsigned GetNumSectors() const override { return sectors_; }
  std::span<const Slice> GetAllSlices(std::uint32_t colour) const override
  {
    const auto found = std::find(kColours.begin(), kColours.end(), colour);
    if (found == kColours.end())
      throw std::invalid_argument("the pie camera tells red, green, blue, yellow, cyan, magenta and white apart");
    batch_.Want(k_);
    return {&slices_[static_cast<std::size_t>(found - kColours.begin()) * sectors_], sectors_};
  }

  // Forgets all blobs. Only colours that were seen take time: most robots see few.
  void Clear()
  {
    for (; colours_ != 0; colours_ &= colours_ - 1)
    {
      const auto colour = static_cast<std::size_t>(std::countr_zero(colours_));
      std::fill_n(&slices_[colour * sectors_], sectors_, Slice{});
    }
  }
  // Returns the slices, to be filled; `colours` has a bit for each colour put into them.
  Slice* Slices() { return slices_.data(); }
  void SetColours(unsigned colours) { colours_ = colours; }

private:
  OnDemandSensor& batch_;
  std::size_t k_;
  unsigned sectors_;
  unsigned colours_ = 0;       // a bit for each colour seen
  std::vector<Slice> slices_;  // colour after colour
};

class PieCamera : public ColourCamera
{
public:
  void Init(const DeviceSetup& setup) override
  {
    // Returns the eye of the omnidirectional camera.
    InitCamera(setup, {CameraModel::View::kDown, {0, 0, 0.2887}, 0, 0});
    noise_ = NoiseFrom(setup.parameters);
    streams_ = DeviceStreams(setup);
    sectors_ = static_cast<unsigned>(setup.parameters.Integer("sectors"));
    pies_.reserve(setup.robots.size());
    for (std::size_t k = 0; k < setup.robots.size(); ++k) pies_.emplace_back(*this, k, sectors_);
  }
  Pie* Sensor(std::size_t k) override { return &pies_[k]; }
  void Expose(std::size_t k, ExposedValues& values) override
  {
    values.SetList(sectors_ * kColours.size(), &pies_[k],
                   [](void* of, std::span<const std::uint8_t> kept)
                   {
                     for (std::size_t i = 0; i < kept.size(); ++i)
                       if (kept[i] == 0) static_cast<Pie*>(of)->Slices()[i] = {};
                   });
  }

protected:
  void Measure(const Seen& seen) override
  {
    if (sector_.size() < seen.angle.size()) sector_.resize(seen.angle.size());
    const double* const angle = seen.angle.data();
    std::int32_t* const sector = sector_.data();
    const auto last = static_cast<std::int32_t>(sectors_ - 1);
    const double per_radian = sectors_ / (2 * kPi);
    const std::size_t whole = (seen.count + kLanes - 1) / kLanes * kLanes;
#pragma GCC ivdep
    for (std::size_t i = 0; i < whole; ++i)
    {
      const double turn = angle[i] < 0 ? angle[i] + 2 * kPi : angle[i];
      sector[i] = std::min(static_cast<std::int32_t>(turn * per_radian), last);
    }
  }

  void Extract(std::size_t k, const Seen& seen, std::size_t first, std::size_t behind) override
  {
    Pie& pie = pies_[k];
    pie.Clear();
    // Local copies let the compiler keep the pointers in registers.
    Pie::Slice* const slices = pie.Slices();
    const std::uint32_t* const source = seen.source.data();
    const double* const distances = seen.distance.data();
    const std::int32_t* const sector = sector_.data();
    const std::uint8_t* const hues = Sources().Hues();
    const std::size_t sectors = sectors_;
    const bool is_noisy = noise_.IsActive();
    unsigned colours = 0;
    for (std::size_t i = first; i < behind; ++i)
    {
      const std::size_t hue = hues[source[i]];
      if (hue == 0) continue;
      double distance = distances[i];
      if (is_noisy) distance = std::max(distance + noise_.Sample(streams_.Of(k, Sources().NameOf(source[i]))), 0.0);
      Pie::Slice& slice = slices[(hue - 1) * sectors + static_cast<std::size_t>(sector[i])];
      slice.distance_m = std::min(slice.distance_m, distance);
      ++slice.blobs;
      colours |= 1U << (hue - 1);
    }
    pie.SetColours(colours);
  }

private:
  unsigned sectors_ = 1;
  std::vector<std::int32_t> sector_;  // of each blob seen
  NoiseModel noise_;
  DeviceStreams streams_;
  std::vector<Pie> pies_;
};

}  // namespace

const DeviceCode kPieCameraCode([] { BindSensor<PieCamera>("pie_camera", "generic_pie_camera"); });

}  // namespace swarmanoid
