// The cameras of all robots.
#include "common/plugin_descriptions/device_tables.h"
#include "common/plugins/noise_parameters.h"

namespace swarmanoid
{
namespace
{

std::vector<ParameterSpec> ViewParameters(const char* aperture_degrees, const char* range_m)
{
  return {{.name = "aperture",
           .unit = "degrees",
           .default_value = aperture_degrees,
           .description = "Angle between the axis of the camera and the border of its view.",
           .minimum = 0.1,
           .maximum = 89.9},
          {.name = "range",
           .unit = "m",
           .default_value = range_m,
           .description = "Distance beyond which blobs are too small to be extracted.",
           .minimum = 0.001,
           .maximum = 1e6}};
}

enum class Elevation
{
  kNone,  // cameras that look down report none
  kReported
};

// The two implementations of a camera: ideal, and with noise in pixels.
void DescribeCamera(const std::string& label, const char* robot, const std::string& what,
                    const std::vector<ParameterSpec>& view, Elevation elevation)
{
  std::vector<ParameterSpec> ideal = Joined(Joined(view, NoiseParameters("each distance", "m", "distance_")),
                                            NoiseParameters("each angle", "rad", "angle_"));
  if (elevation == Elevation::kReported)
    ideal = Joined(std::move(ideal), NoiseParameters("each elevation", "rad", "elevation_"));
  DescribeSensor({.label = label,
                  .implementation = "generic_" + label,
                  .brief = what + ": blobs at their exact places, with noise on distance and angles where asked",
                  .parameters = std::move(ideal),
                  .robots = {robot}});
  DescribeSensor(
      {.label = label,
       .implementation = "pixel_noise_" + label,
       .brief = what + ": blobs in whole pixels with noise, some of them missed",
       .parameters = Joined(Joined(view, {{.name = "image_radius",
                                           .unit = "pixels",
                                           .default_value = "240",
                                           .description = "Pixels from the middle of the image to the border of the "
                                                          "view.",
                                           .minimum = 1,
                                           .maximum = 1e6},
                                          {.name = "miss_probability",
                                           .default_value = "0",
                                           .description = "Share of the blobs that are not extracted in a tick.",
                                           .minimum = 0,
                                           .maximum = 1}}),
                            NoiseParameters("each coordinate in the image, before rounding to whole pixels", "pixels")),
       .robots = {robot}});
}

}  // namespace

void DescribeCameras()
{
  // The apertures are those of ARGoS3 for the footbot, and of ARGoS 2 for the eyebot.
  DescribeCamera("footbot_omnidirectional_camera", "footbot", "omnidirectional camera", ViewParameters("70", "3"),
                 Elevation::kNone);
  DescribeCamera("eyebot_camera", "eyebot", "camera that looks down", ViewParameters("30", "3"), Elevation::kNone);
  // Aperture and range are those of the perspective camera of ARGoS3.
  DescribeCamera("eyebot_pan_tilt_camera", "eyebot", "camera that turns with the laser", ViewParameters("30", "2"),
                 Elevation::kReported);
  DescribeCamera("footbot_perspective_camera", "footbot", "camera in the rim that looks ahead",
                 ViewParameters("30", "2"), Elevation::kReported);
  DescribeCamera("handbot_camera", "handbot", "camera that looks ahead", ViewParameters("30", "2"),
                 Elevation::kReported);
  DescribeSensor({.label = "pie_camera",
                  .implementation = "generic_pie_camera",
                  .brief = "nearest blob and number of blobs for each colour in each sector around the robot",
                  .parameters = Joined(Joined({{.name = "sectors",
                                                .type = ParameterType::kInteger,
                                                .default_value = "12",
                                                .description = "Number of equal sectors around the robot.",
                                                .minimum = 1,
                                                .maximum = 360}},
                                              ViewParameters("85", "3")),
                                       NoiseParameters("each distance", "m")),
                  .robots = {"footbot"}});
}

}  // namespace swarmanoid
