// Descriptions of plug-ins for tests of the reader: what the real ones would register, and nothing else.
#pragma once

#include <string>

#include "common/experiment/load_experiment.h"
#include "common/plugins/catalogue.h"

namespace swarmanoid::test
{

inline ParameterSpec Parameter(std::string name, ParameterType type, std::optional<std::string> fallback)
{
  ParameterSpec spec;
  spec.name = std::move(name);
  spec.type = type;
  spec.default_value = std::move(fallback);
  return spec;
}

inline void AddDevice(PluginKind kind, const char* type, const char* implementation, std::vector<std::string> robots,
                      const char* channel = "")
{
  PluginDescription description;
  description.label = type;
  description.implementation = implementation;
  description.robots = std::move(robots);
  description.channel = channel;
  ParameterSpec noise = Parameter("noise", ParameterType::kNumber, "0");
  noise.minimum = 0;
  noise.maximum = 1;
  description.parameters = {noise};
  PluginCatalogue::Instance().Add(kind, description);
}

inline void AddEngine(const char* label, std::vector<std::string> channels, std::vector<std::string> tags)
{
  PluginDescription description;
  description.label = label;
  description.channels = std::move(channels);
  description.entity_tags = std::move(tags);
  ParameterSpec axis = Parameter("perpendicular_axis", ParameterType::kChoice, "z");
  axis.choices = {"x", "y", "z"};
  description.parameters = {axis, Parameter("distance", ParameterType::kNumber, "0")};
  PluginCatalogue::Instance().Add(PluginKind::kEngine, description);
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

    PluginDescription text;
    text.label = "text_render";
    text.parameters = {Parameter("file", ParameterType::kPath, ""),
                       Parameter("precision", ParameterType::kInteger, "3")};
    PluginCatalogue::Instance().Add(PluginKind::kRenderer, text);

    PluginDescription opengl;
    opengl.label = "opengl_render";
    opengl.parameters = {Parameter("window_size", ParameterType::kVector2, "800, 600"),
                         Parameter("window_title", ParameterType::kText, ""),
                         Parameter("camera_view_XYZ_n", ParameterType::kVector3, std::nullopt),
                         Parameter("camera_view_HPR_n", ParameterType::kVector3, std::nullopt),
                         Parameter("use_textures", ParameterType::kBoolean, "true"),
                         Parameter("write_frames", ParameterType::kBoolean, "false"),
                         Parameter("frame_directory", ParameterType::kPath, "frames"),
                         Parameter("frame_filename", ParameterType::kText, "frame")};
    PluginCatalogue::Instance().Add(PluginKind::kRenderer, opengl);

    for (const char* label : {"footbot_sample_controller", "eyebot_sample_controller"})
    {
      PluginDescription controller;
      controller.label = label;
      controller.declares_parameters = false;
      PluginCatalogue::Instance().Add(PluginKind::kController, controller);
    }
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

// The errors, one a line.
inline std::string ErrorsOf(const std::string& text, const LoadOptions& options = {})
{
  const LoadedExperiment loaded = LoadText(text, options);
  std::string errors;
  for (const Diagnostic& error : loaded.errors) errors += error.Text() + "\n";
  return errors;
}

// The listings of chapter 4 of the documentation, completed where they are left open.
extern const char* const kChapter4;

}  // namespace swarmanoid::test
