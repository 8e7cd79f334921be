#include "common/plugin_descriptions/describe_builtins.h"

#include "common/plugin_descriptions/device_tables.h"
#include "common/plugin_descriptions/engines.h"
#include "common/plugin_descriptions/renderers.h"
#include "common/plugins/catalogue.h"
#include "common/plugins/noise_parameters.h"

namespace swarmanoid
{

void DescribeSensor(const PluginDescription& sensor)
{
  PluginCatalogue::Instance().Add(PluginKind::kSensor, sensor);
  CheckNoiseOf(PluginKind::kSensor, sensor);
}

void DescribeActuator(const PluginDescription& actuator)
{
  PluginCatalogue::Instance().Add(PluginKind::kActuator, actuator);
  CheckNoiseOf(PluginKind::kActuator, actuator);
}

void DescribeBuiltinEngines()
{
  static const bool described = []
  {
    for (const PluginDescription& engine :
         {Kinematics2dDescription("dummy_engine"), Kinematics2dDescription("kinematics2d"), Dynamics2dDescription(),
          Dynamics3dDescription()})
      PluginCatalogue::Instance().Add(PluginKind::kEngine, engine);
    return true;
  }();
  static_cast<void>(described);
}

void DescribeBuiltinDevices()
{
  static const bool described = []
  {
    DescribeFootbotDevices();
    DescribeEyebotDevices();
    DescribeHandbotDevices();
    DescribeCameras();
    DescribeRangeAndBearing();
    DescribeAnyRobotDevices();
    DescribeSurroundingsDevices();
    DescribeFloorFieldDevices();
    return true;
  }();
  static_cast<void>(described);
}

void DescribeBuiltinRenderers()
{
  static const bool described = []
  {
    for (const PluginDescription& renderer :
         {TextRenderDescription(), ImageRenderDescription(), FigureRenderDescription(), OpenGlRenderDescription(),
          OgreRenderDescription(), WebRenderDescription(), PageRenderDescription(), Ros2RenderDescription(),
          FoxgloveRenderDescription()})
      PluginCatalogue::Instance().Add(PluginKind::kRenderer, renderer);
    return true;
  }();
  static_cast<void>(described);
}

void DescribeBuiltins()
{
  DescribeBuiltinEngines();
  DescribeBuiltinDevices();
  DescribeBuiltinRenderers();
}

}  // namespace swarmanoid
