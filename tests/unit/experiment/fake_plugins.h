// Descriptions of plug-ins for tests of the reader. They replace the registrations of the real ones.
#pragma once

#include <string>

#include "common/experiment/load_experiment.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid::test
{

inline void AddDevice(PluginKind kind, const char* type, const char* implementation, std::vector<std::string> robots,
                      const char* channel = "")
{
  PluginCatalogue::Instance().Add(kind,
                                  {.label = type,
                                   .implementation = implementation,
                                   .parameters = {{.name = "noise", .default_value = "0", .minimum = 0, .maximum = 1}},
                                   .robots = std::move(robots),
                                   .channel = channel});
}

inline void AddEngine(const char* label, std::vector<std::string> channels, std::vector<std::string> tags)
{
  PluginCatalogue::Instance().Add(PluginKind::kEngine, {.label = label,
                                                        .parameters = {{.name = "perpendicular_axis",
                                                                        .type = ParameterType::kChoice,
                                                                        .default_value = "z",
                                                                        .choices = {"x", "y", "z"}},
                                                                       {.name = "distance", .default_value = "0"}},
                                                        .channels = std::move(channels),
                                                        .entity_tags = std::move(tags)});
}

inline void RegisterFakePlugins()
{
  static const bool once = []
  {
    AddDevice(PluginKind::kActuator, "footbot_wheels", "dummy_footbot_wheels", {"footbot"}, "footbot_wheels");
    AddDevice(PluginKind::kActuator, "footbot_wheels", "dynamic_footbot_wheels", {"footbot"}, "footbot_forces");
    AddDevice(PluginKind::kActuator, "footbot_gripper", "dummy_footbot_gripper", {"footbot"}, "footbot_gripper");
    AddDevice(PluginKind::kSensor, "pie_camera", "generic_pie_camera", {"footbot"});
    AddDevice(PluginKind::kSensor, "footbot_proximity", "generic_footbot_polynomial_proximity", {"footbot"});
    AddDevice(PluginKind::kSensor, "eyebot_altitude", "generic_eyebot_altitude", {"eyebot"});
    AddEngine("dummy_engine", {"footbot_wheels", "footbot_gripper"},
              {"footbot", "eyebot", "handbot", "block", "cylindric_prey", "wall"});

    using Type = ParameterType;
    PluginCatalogue::Instance().Add(
        PluginKind::kRenderer, {.label = "text_render",
                                .parameters = {{.name = "file", .type = Type::kPath, .default_value = ""},
                                               {.name = "precision", .type = Type::kInteger, .default_value = "3"}}});
    PluginCatalogue::Instance().Add(
        PluginKind::kRenderer,
        {.label = "opengl_render",
         .parameters = {{.name = "window_size", .type = Type::kVector2, .default_value = "800, 600"},
                        {.name = "window_title", .type = Type::kText, .default_value = ""},
                        {.name = "camera_view_XYZ_n", .type = Type::kVector3},
                        {.name = "camera_view_HPR_n", .type = Type::kVector3},
                        {.name = "use_textures", .type = Type::kBoolean, .default_value = "true"},
                        {.name = "write_frames", .type = Type::kBoolean, .default_value = "false"},
                        {.name = "frame_directory", .type = Type::kPath, .default_value = "frames"},
                        {.name = "frame_filename", .type = Type::kText, .default_value = "frame"}}});

    for (const char* label : {"footbot_sample_controller", "eyebot_sample_controller"})
      PluginCatalogue::Instance().Add(PluginKind::kController, {.label = label, .declares_parameters = false});
    return true;
  }();
  static_cast<void>(once);
}

// Loads a text as the file "test.xml" of the folder "/experiments", without looking for controller libraries.
inline LoadedExperiment LoadText(const std::string& text, LoadOptions options = {})
{
  RegisterFakePlugins();
  options.check_files = false;
  return LoadExperimentText(text, "test.xml", "/experiments", options);
}

// Returns the errors, one in each line.
inline std::string ErrorsOf(const std::string& text, const LoadOptions& options = {})
{
  const LoadedExperiment loaded = LoadText(text, options);
  std::string errors;
  for (const Diagnostic& error : loaded.errors) errors += error.Text() + "\n";
  return errors;
}

// The listings of chapter 4 of the documentation, with the parts that they leave open.
extern const char* const kChapter4;

}  // namespace swarmanoid::test
