// The pie camera of the footbot: the blobs of its omnidirectional camera by sector and colour.
#include <array>
#include <stdexcept>

#include "common/control_interface/ci_pie_camera_sensor.h"
#include "common/math/elementary.h"
#include "controller_host/devices/builtin_devices.h"
#include "controller_host/devices/colour_camera.h"
#include "controller_host/devices/device_kit.h"

namespace swarmanoid
{
namespace
{

// At place b - 1 the colour with the bits b of red (4), green (2) and blue (1).
constexpr std::array<std::uint32_t, 7> kColours{CCI_Colour::BLUE, CCI_Colour::GREEN,   CCI_Colour::CYAN,
                                                CCI_Colour::RED,  CCI_Colour::MAGENTA, CCI_Colour::YELLOW,
                                                CCI_Colour::WHITE};

// The place of a colour in kColours, -1 for black.
int ClassOf(std::uint32_t colour)
{
  const std::uint32_t nearest = CCI_Colour::Nearest(colour);
  return static_cast<int>((nearest >> 14 & 4U) + (nearest >> 7 & 2U) + (nearest & 1U)) - 1;
}

class Pie : public CCI_PieCameraSensor
{
public:
  explicit Pie(unsigned sectors) : sectors_(sectors), slices(sectors * kColours.size()) {}
  unsigned GetNumSectors() const override { return sectors_; }
  std::span<const Slice> GetAllSlices(std::uint32_t colour) const override
  {
    const auto found = std::find(kColours.begin(), kColours.end(), colour);
    if (found == kColours.end())
      throw std::invalid_argument("the pie camera tells red, green, blue, yellow, cyan, magenta and white apart");
    return {&slices[static_cast<std::size_t>(found - kColours.begin()) * sectors_], sectors_};
  }

private:
  unsigned sectors_;

public:
  std::vector<Slice> slices;  // colour after colour
};

class PieCamera : public ColourCamera
{
public:
  static std::vector<ParameterSpec> ParameterTable()
  {
    return Joined(Joined({{.name = "sectors",
                           .type = ParameterType::kInteger,
                           .default_value = "12",
                           .description = "Number of equal sectors around the robot.",
                           .minimum = 1,
                           .maximum = 360}},
                         ViewParameters("85", "3")),
                  NoiseParameters("each distance", "m"));
  }
  void Init(const DeviceSetup& setup) override
  {
    // The eye of the omnidirectional camera.
    InitCamera(setup, {CameraModel::View::kDown, {0, 0, 0.2887}, 0, 0});
    noise_ = NoiseFrom(setup.parameters);
    pies_.assign(setup.robots.size(), Pie(static_cast<unsigned>(setup.parameters.Integer("sectors"))));
  }
  CCI_Sensor* Sensor(std::size_t k) override { return &pies_[k]; }

protected:
  void Extract(std::size_t k, std::span<const Seen> seen) override
  {
    Pie& pie = pies_[k];
    const unsigned sectors = pie.GetNumSectors();
    std::fill(pie.slices.begin(), pie.slices.end(), Pie::Slice{});
    RandomStream random = StreamOf(*space_, robots_[k], stream_);
    for (const Seen& blob : seen)
    {
      const int colour = ClassOf(blob.colour);
      if (colour < 0) continue;
      double angle = blob.angle;
      if (angle < 0) angle += 2 * kPi;
      const auto sector = std::min(static_cast<unsigned>(angle * (sectors / (2 * kPi))), sectors - 1);
      double distance = __builtin_sqrt(blob.place.x() * blob.place.x() + blob.place.y() * blob.place.y());
      if (noise_.IsActive()) distance = std::max(distance + noise_.Sample(random), 0.0);
      Pie::Slice& slice = pie.slices[static_cast<std::size_t>(colour) * sectors + sector];
      slice.distance_m = std::min(slice.distance_m, distance);
      ++slice.blobs;
    }
  }

private:
  NoiseModel noise_;
  std::vector<Pie> pies_;
};

}  // namespace

void RegisterPieCamera()
{
  PluginDescription description;
  description.label = "pie_camera";
  description.implementation = "generic_pie_camera";
  description.brief = "nearest blob and number of blobs for each colour in each sector around the robot";
  description.robots = {"footbot"};
  description.parameters = PieCamera::ParameterTable();
  AddSensorPlugin<PieCamera>(description);
}

}  // namespace swarmanoid
