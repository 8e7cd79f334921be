// <argos3_controller> runs a controller written for ARGoS3 as one of ours. The converted file names its library and
// label:
//
//   <argos3_controller id="fdc" library="argos3">
//     <actuators>…</actuators> <sensors>…</sensors>
//     <parameters>
//       <argos3 library="build/libdiffusion.so" label="diffusion" sensors="footbot_proximity" actuators="…" origin="2,
//       2, 0"/> <params velocity="5"/>
//     </parameters>
//   </argos3_controller>

#include "argos3/library/running.h"
#include "argos3/plugin/device_adapters.h"
#include "argos3/plugin/labels.h"
#include "argos3/plugin/lua_controller.h"
#include "argos3/plugin/own_devices.h"

// Both interfaces have a macro of that name.
#undef REGISTER_CONTROLLER
#include "common/control_interface/ci_controller.h"

namespace swarmanoid::argos3
{
namespace
{

class Argos3Controller : public CCI_Controller, private SpareRobot, private ControlledRobot
{
public:
  ~Argos3Controller() override
  {
    Forget();
    if (is_spare_) TheRunning().spares.erase(GetRobot()->GetId());
  }

  int Init(const TConfigurationTree t_tree) override
  {
    const TConfigurationTree options = t_tree.Child("argos3");
    if (!options.Exists())
      throw ConfigurationError(t_tree.Location(), "<parameters> holds no <argos3>; `swarmanoid convert` writes it");
    translation_ = Translation::From(options);
    TheRunning().translation = translation_;
    const std::string id = GetRobot()->GetId();
    const std::string spare = options.GetText("spare", "");
    is_spare_ = !spare.empty() && id.starts_with(spare + "_");
    parameters_ = t_tree;
    if (is_spare_)
      TheRunning().spares[id] = this;
    else
      Start(translation_.Argos3Id(id));
    return RETURN_OK;
  }

  void ControlStep() override
  {
    // ARGoS3 moves robots before the first step of their controllers.
    if (GetRobot()->GetTick() == 0) return;
    if (controller_ == nullptr || !is_enabled_) return;
    const Speaker speaker(*GetRobot());
    for (const auto& sensor : sensors_) sensor->BeforeStep();
    own_devices_.Sense();
    controller_->ControlStep();
    Commit();
    own_devices_.Act();
  }

  void Destroy() override
  {
    if (controller_ == nullptr) return;
    const Speaker speaker(*GetRobot());
    controller_->Destroy();
  }

  // ARGoS3's controllers read their <params> themselves.
  bool ReadsParametersLater() const override { return true; }

private:
  void SetEnabled(bool enabled) override { is_enabled_ = enabled; }
  void Take(const std::string& id) override
  {
    Leave();
    is_enabled_ = true;
    Start(id);
  }
  void Leave() override
  {
    Destroy();
    Forget();
    controller_.reset();
    own_devices_.Clear();
    sensors_.clear();
    actuators_.clear();
  }

  void Forget()
  {
    ++TheRunning().controller_changes;
    TheRunning().controllers.erase(id_);
    TheRunning().controlled.erase(GetRobot()->GetId());
  }
  void Reset() override
  {
    // Generators that are created in it draw the same numbers each time.
    CCI_Robot& robot = *GetRobot();
    robot.BeginStep(
        robot.GetTick(), robot.GetTickSeconds(),
        {argos::CSimulator::GetInstance().GetRandomSeed(), StreamName(robot.GetId()), StreamName("ARGoS3 reset"), 0});
    const Speaker speaker(robot);
    for (const auto& sensor : sensors_) sensor->Sensor().Reset();
    for (const auto& actuator : actuators_) actuator->Actuator().Reset();
    own_devices_.Reset();
    controller_->Reset();
    Commit();
  }

  // Starts the controller. `id` is the id in ARGoS3.
  void Start(const std::string& id)
  {
    const TConfigurationTree options = parameters_.Child("argos3");
    id_ = id;
    const Speaker speaker(*GetRobot());
    controller_ = MakeController(options);
    controller_->SetId(id_);
    MakeDevices(options);
    own_devices_.Make(parameters_, GetRobot()->GetId(), *controller_);
    ++TheRunning().controller_changes;
    if (!TheRunning().controllers.emplace(id_, controller_.get()).second)
      throw std::runtime_error("a process runs one ARGoS3 experiment at a time; another one has a robot '" + id_ + "'");

    TheRunning().controlled[GetRobot()->GetId()] = this;
    const TConfigurationTree params = parameters_.Child("params");
    params_ = argos::TConfigurationNode();
    if (params.Exists()) CopyElement(*params.Node(), params_);
    for (const auto& sensor : sensors_) sensor->BeforeInit();
    Calling(params.Exists() ? params.Location() : parameters_.Location(), [&] { controller_->Init(params_); });
    Commit();
  }

  std::unique_ptr<argos::CCI_Controller> MakeController(const TConfigurationTree& options) const
  {
    if (options.HasAttribute("script_name"))
    {
      std::string script = options.GetText("script", "");
      if (script.empty()) return std::make_unique<argos::CCI_Controller>();
      LuaScript lua{
          {options.GetText("script_name"), std::move(script), [robot = GetRobot()] { return robot->GetTime(); }}};
      for (const std::string& type : SplitWords(options.GetText("own_sensors", "")))
        lua.sensors.try_emplace(type, *GetRobot()->GetSensor(type));
      for (const std::string& type : SplitWords(options.GetText("own_actuators", "")))
        lua.actuators[type] = GetRobot()->GetActuator(type);
      return MakeLuaController(std::move(lua));
    }
    // Files need not name a library for the controllers of this library.
    const auto& known = ControllersByLabel();
    const auto own = known.find(options.GetText("label"));
    if (!options.HasAttribute("library") && own != known.end())
      return std::unique_ptr<argos::CCI_Controller>(own->second());
    return std::unique_ptr<argos::CCI_Controller>(FindLabel(options, "library", "controller", ControllersByLabel)());
  }

  void MakeDevices(const TConfigurationTree& options)
  {
    const DeviceSetup setup{.robot = *GetRobot(), .translation = translation_, .options = options};
    for (const std::string& tag : SplitWords(options.GetText("sensors", "")))
    {
      sensors_.push_back(MakeSensor(tag, setup));
      if (sensors_.back() == nullptr) throw Unknown(options, "sensor", tag);
      controller_->AddSensor(tag, &sensors_.back()->Sensor());
    }
    for (const std::string& tag : SplitWords(options.GetText("actuators", "")))
    {
      actuators_.push_back(MakeActuator(tag, setup));
      if (actuators_.back() == nullptr) throw Unknown(options, "actuator", tag);
      // A device that is listed only for other robots, such as a sender of zeros, works too.
      controller_->AddActuator(tag, &actuators_.back()->Actuator());
    }
  }

  static ConfigurationError Unknown(const TConfigurationTree& options, const char* what, const std::string& tag)
  {
    return {options.Location(), std::string("the ") + what + " '" + tag + "' of ARGoS3 has no counterpart"};
  }

  void Commit()
  {
    for (const auto& actuator : actuators_) actuator->Commit();
  }

  Translation translation_;
  TConfigurationTree parameters_;
  bool is_enabled_ = true;
  bool is_spare_ = false;
  std::string id_;  // the id in ARGoS3
  std::vector<std::unique_ptr<SensorBridge>> sensors_;
  std::vector<std::unique_ptr<ActuatorBridge>> actuators_;
  OwnDevices own_devices_;
  argos::TConfigurationNode params_;
  std::unique_ptr<argos::CCI_Controller> controller_;
};

const ControllerRegistration registration([]() -> std::unique_ptr<CCI_Controller>
                                          { return std::make_unique<Argos3Controller>(); },
                                          "Argos3Controller", "argos3_controller",
                                          "runs a controller that was written for ARGoS3");

}  // namespace
}  // namespace swarmanoid::argos3
