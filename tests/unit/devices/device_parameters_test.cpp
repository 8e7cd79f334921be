// Parameters of devices that are right each by itself and make no sense together: refused before anything starts, with
// place and cure. The descriptions of the devices are enough for that.
#include <gtest/gtest.h>

#include <string>

#include "common/experiment/load_experiment.h"
#include "common/plugin_descriptions/describe_builtins.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid
{
namespace
{

// The mistakes of a file whose only sensor (or actuator), in line 2, has these parameters.
std::string MistakesOf(const std::string& type, const std::string& implementation, const std::string& parameters,
                       const std::string& group = "sensors")
{
  DescribeBuiltinDevices();
  const std::string text =
      test::ExperimentText{.controllers = "<any id='c' library='none'><" + group + ">\n<" + type + " implementation='" +
                                          implementation + "' " + parameters + "/></" + group + "></any>",
                           .engines = ""}
          .Text();
  LoadOptions options;
  options.check_files = false;
  std::string mistakes;
  for (const Diagnostic& mistake : LoadExperimentText(text, "test.xml", "/", options).errors)
    mistakes += mistake.Text() + "\n";
  return mistakes;
}

std::string TurretEncoder(const std::string& parameters)
{
  return MistakesOf("footbot_turret_encoder", "generic_footbot_turret_encoder", parameters);
}

TEST(DeviceParameters, NoiseWithoutAKindIsRefused)
{
  EXPECT_EQ(TurretEncoder("noise_range=\"0.1\""),
            "test.xml:3:73: 'noise_range' of <footbot_turret_encoder> has no effect without 'noise_kind'; give that "
            "too: uniform, gaussian or truncated_gaussian, or none to switch the noise off\n");
  EXPECT_EQ(TurretEncoder(""), "");
  EXPECT_EQ(TurretEncoder("noise_kind=\"none\" noise_range=\"0.1\""), "") << "switched off";
}

TEST(DeviceParameters, AKindOfNoiseWithoutItsNumbersIsRefused)
{
  EXPECT_EQ(TurretEncoder("noise_kind=\"gaussian\" noise_range=\"0.1\""),
            "test.xml:3:73: 'noise_kind' of <footbot_turret_encoder> is gaussian, which changes nothing without "
            "'noise_deviation'; give that, or 'noise_mean'\n");
  EXPECT_EQ(TurretEncoder("noise_kind=\"uniform\" noise_deviation=\"0.1\""),
            "test.xml:3:73: 'noise_kind' of <footbot_turret_encoder> is uniform, which changes nothing without "
            "'noise_range'; give that, or 'noise_mean'\n");
  EXPECT_EQ(TurretEncoder("noise_kind=\"uniform\" noise_range=\"0\""), "") << "one end of a series of runs";
  EXPECT_EQ(TurretEncoder("noise_kind=\"gaussian\" noise_mean=\"0.1\""), "") << "a systematic error";
}

TEST(DeviceParameters, EachSetOfNoiseIsJudgedByItself)
{
  EXPECT_EQ(MistakesOf("eyebot_camera", "generic_eyebot_camera",
                       "distance_noise_kind=\"uniform\" distance_noise_range=\"0.1\" angle_noise_deviation=\"0.1\""),
            "test.xml:3:112: 'angle_noise_deviation' of <eyebot_camera> has no effect without 'angle_noise_kind'; give "
            "that too: uniform, gaussian or truncated_gaussian, or none to switch the noise off\n");
}

TEST(DeviceParameters, NoiseOfActuatorsIsJudgedToo)
{
  EXPECT_EQ(
      MistakesOf("footbot_turret", "dummy_footbot_turret", "noise_mean=\"0.1\"", "actuators"),
      "test.xml:3:55: 'noise_mean' of <footbot_turret> has no effect without 'noise_kind'; give that too: uniform, "
      "gaussian or truncated_gaussian, or none to switch the noise off\n");
}

TEST(DeviceParameters, ThePolynomialIsNotUsedBeyondItsFit)
{
  const auto polynomial = [](const std::string& parameters)
  { return MistakesOf("footbot_proximity", "generic_footbot_polynomial_proximity", parameters); };
  EXPECT_EQ(
      polynomial("range=\"0.2\""),
      "test.xml:3:74: 'range' of <footbot_proximity> is 0.2 m, but the default coefficients are a fit up to 0.1 m; "
      "give <coefficients> too, or use generic_footbot_proximity\n");
  EXPECT_EQ(polynomial("range=\"0.05\""), "");
  EXPECT_EQ(polynomial("range=\"0.2\" coefficients=\"1, -5\""), "");
  EXPECT_EQ(polynomial("coefficients=\"1, two\""),
            "test.xml:3:74: <coefficients> '1, two' is not a list of numbers; write \"c0, c1, c2\"\n");
}

TEST(DeviceParameters, ARangeScannerHasNotTooManyBeams)
{
  const auto scanner = [](const std::string& parameters)
  { return MistakesOf("range_scanner", "generic_range_scanner", parameters); };
  EXPECT_EQ(scanner("beams=\"2048\" layers=\"32\""), "");
  EXPECT_EQ(scanner("beams=\"2048\" layers=\"33\""),
            "test.xml:3:68: <range_scanner> has 2048 beams in each of 33 layers; 65536 beams in all are the most\n");
  EXPECT_EQ(scanner("nearest=\"10\""),
            "test.xml:3:55: 'nearest' of <range_scanner> is 10 m and 'range' 10 m; nearest must be less\n");
}

TEST(DeviceParameters, LightSensorsHaveDirections)
{
  const auto light = [](const std::string& parameters) { return MistakesOf("light", "argos3_light", parameters); };
  EXPECT_EQ(light("directions=\"17, 50\""), "");
  EXPECT_EQ(light("directions=\"17, left\""),
            "test.xml:3:38: 'directions' of <light> is '17, left'; it must be 1 to 360 angles in degrees, with commas "
            "between them\n");
}

TEST(DeviceParameters, ADepthCameraSeesSomething)
{
  const auto camera = [](const std::string& parameters)
  { return MistakesOf("depth_camera", "generic_depth_camera", parameters); };
  EXPECT_EQ(camera("nearest=\"0.5\" range=\"0.6\""), "");
  EXPECT_EQ(camera("nearest=\"5\""),
            "test.xml:3:53: 'nearest' of <depth_camera> is 5 m and 'range' 5 m; nearest must "
            "be less\n");
}

}  // namespace
}  // namespace swarmanoid
