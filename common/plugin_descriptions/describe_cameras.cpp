// The cameras of all robots.
#include "common/plugin_descriptions/device_tables.h"
#include "common/plugins/noise_parameters.h"

namespace swarmanoid
{
namespace
{

using enum ParameterType;

std::vector<ParameterSpec> ViewParameters(const char* aperture_degrees, const char* range_m)
{
  return {{"aperture", kNumber, "degrees", aperture_degrees,
           "Angle between the axis of the camera and the border of its view.", 0.1, 89.9},
          {"range", kNumber, "m", range_m, "Distance beyond which blobs are too small to be extracted.", 0.001, 1e6}};
}

enum class Elevation
{
  kNone,  // cameras that look down report none
  kReported
};

// Describes the two implementations of a camera: ideal, and with noise in pixels. `other_robots` carry the ideal one,
// too.
void DescribeCamera(const std::string& label, const char* robot, const std::string& what,
                    const std::vector<ParameterSpec>& view, Elevation elevation,
                    const std::vector<std::string>& other_robots = {})
{
  std::vector<std::string> robots{robot};
  robots.insert(robots.end(), other_robots.begin(), other_robots.end());
  std::vector<ParameterSpec> ideal = Joined(Joined(view, NoiseParameters("each distance", "m", "distance_")),
                                            NoiseParameters("each angle", "rad", "angle_"));
  if (elevation == Elevation::kReported)
    ideal = Joined(std::move(ideal), NoiseParameters("each elevation", "rad", "elevation_"));
  DescribeSensor({.label = label,
                  .implementation = "generic_" + label,
                  .brief = what + ": blobs at their exact places, with noise on distance and angles where asked",
                  .parameters = std::move(ideal),
                  .robots = std::move(robots)});
  DescribeSensor(
      {.label = label,
       .implementation = "pixel_noise_" + label,
       .brief = what + ": blobs in whole pixels with noise, some of them missed",
       .parameters = Joined(Joined(view, {{"image_radius", kNumber, "pixels", "240",
                                           "Pixels from the middle of the image to the border of the view.", 1, 1e6},
                                          {"miss_probability", kNumber, "", "0",
                                           "Share of the blobs that are not extracted in a tick.", 0, 1}}),
                            NoiseParameters("each coordinate in the image, before rounding to whole pixels", "pixels")),
       .robots = {robot}});
}

}  // namespace

void DescribeCameras()
{
  // The apertures are those of ARGoS3 for the footbot, and of ARGoS 2 for the eyebot.
  const std::vector<ParameterSpec> omnidirectional =
      Joined(ViewParameters("70", "3"), {{"height", kNumber, "m", "0.2887", "Of the eye above the base.", 0.001, 1e6}});
  DescribeCamera("footbot_omnidirectional_camera", "footbot", "omnidirectional camera", omnidirectional,
                 Elevation::kNone, {"argos3_demiurge_epuck"});
  DescribeSensor({.label = "footbot_omnidirectional_camera",
                  .implementation = "argos3_footbot_omnidirectional_camera",
                  .brief =
                      "omnidirectional camera of ARGoS3: sees in a square around the robot, whatever the height of "
                      "a blob",
                  .parameters = Joined(Joined(omnidirectional, NoiseParameters("each distance", "m", "distance_")),
                                       NoiseParameters("each angle", "rad", "angle_")),
                  .robots = {"footbot"}});
  DescribeCamera("eyebot_camera", "eyebot", "camera that looks down", ViewParameters("30", "3"), Elevation::kNone);
  // Aperture and range are those of the perspective camera of ARGoS3.
  DescribeCamera("eyebot_pan_tilt_camera", "eyebot", "camera that turns with the laser", ViewParameters("30", "2"),
                 Elevation::kReported);
  DescribeCamera("footbot_perspective_camera", "footbot", "camera in the rim that looks ahead",
                 Joined(ViewParameters("30", "2"), {{"position", kVector3, "m", "0.085036758, 0, 0.174",
                                                     "Of the eye, in the frame of the robot.", -1e6, 1e6}}),
                 Elevation::kReported, {"argos3_spiri"});
  DescribeCamera("handbot_camera", "handbot", "camera that looks ahead", ViewParameters("30", "2"),
                 Elevation::kReported);
  DescribeSensor({.label = "pie_camera",
                  .implementation = "generic_pie_camera",
                  .brief = "nearest blob and number of blobs for each colour in each sector around the robot",
                  .parameters = Joined(
                      Joined({{"sectors", kInteger, "", "12", "Number of equal sectors around the robot.", 1, 360}},
                             ViewParameters("85", "3")),
                      NoiseParameters("each distance", "m")),
                  .robots = {"footbot"}});
}

}  // namespace swarmanoid
