// <argos3_loop_functions> runs loop functions written for ARGoS3 as experiment functions. In a tick, ARGoS3 moves
// bodies, and calls PreStep, the controllers and PostStep. Our tick moves bodies last. So the first tick of a run, in
// which no controller runs yet, corresponds to ARGoS3's work before its first PreStep. Entities have the same positions
// in PreStep and PostStep.
#include <argos3/plugins/robots/e-puck/simulator/epuck_entity.h>
#include <argos3/plugins/robots/eye-bot/simulator/eyebot_entity.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/robots/kheperaiv/simulator/kheperaiv_entity.h>
#include <argos3/plugins/robots/kilobot/simulator/kilobot_entity.h>
#include <argos3/plugins/robots/pi-puck/simulator/pipuck_entity.h>
#include <argos3/plugins/robots/spiri/simulator/spiri_entity.h>
#include <argos3/plugins/simulator/entities/box_entity.h>
#include <argos3/plugins/simulator/entities/cylinder_entity.h>
#include <argos3/plugins/simulator/entities/light_entity.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "argos3/converter/robot_rows.h"
#include "argos3/library/editing.h"
#include "argos3/library/pen.h"
#include "argos3/library/running.h"
#include "argos3/plugin/labels.h"
#include "argos3/plugin/qt_keys.h"
#include "common/space/space.h"

namespace swarmanoid::argos3
{
namespace
{

using enum ParameterType;

class Argos3LoopFunctions : public CExperimentFunctions, private SteppedFunctions
{
public:
  static PluginDescription Description()
  {
    return {
        .label = "argos3_loop_functions",
        .brief = "runs loop functions that were written for ARGoS3",
        .parameters = {
            {"file", kText, "", "", "The library that holds them: a path; empty: there are none, only user functions."},
            {"label", kText, "", "", "The label under which the library registered them."},
            {"user_file", kText, "", "", "The library that holds Qt user functions: a path; empty for none."},
            {"user_label", kText, "", "", "The label under which that library registered them."},
            {"origin", kVector3, "m", std::nullopt, "Where the origin of the ARGoS3 arena is."},
            {"distributed", kText, "", "",
             "Of the distributed entities: prefix of the ids there, number of the first one, id here."},
            {"floor", kText, "", "", "The id of the floor; empty for none."},
            {"controllers", kText, "", "",
             "Libraries of the controllers, which those of loop functions may take for granted: paths with colons "
             "between them."},
            {"length", kInteger, "ticks", "0", "How long a run is, and each that begins again; 0: until maxclock."},
            {"rehearsal", kBoolean, "", "false", "Only to find out what boxes and cylinders Init makes."},
            {"loop_functions", kTree, "", "", "The element of the ARGoS3 file, as it stands there."},
            {"user_functions", kTree, "", "",
             "The element of the Qt user functions in the ARGoS3 file, as it stands there."},
            {"configuration", kTree, "", "",
             "The elements of the ARGoS3 file, for loop functions that ask for them."}}};
  }

  ~Argos3LoopFunctions() override
  {
    Running& running = TheRunning();
    if (running.functions == functions_.get()) running.functions = nullptr;
    running.stepped = nullptr;
    running.editor_for_devices = nullptr;
    running.rehearsal.reset();
    running.given.clear();
    running.taken.clear();
    running.arrivals.clear();
    argos::CSimulator::GetInstance().GetSpace().Clear();
    argos::CSimulator::GetInstance().GetSpace().SetFloor(nullptr);
  }

  void Init(const TConfigurationTree t_tree, SpaceEditor& editor) override
  {
    LoadBefore(t_tree.GetText("controllers"));
    create_ = t_tree.GetText("file").empty() ? []() -> argos::CLoopFunctions* { return new argos::CLoopFunctions; }
                                             : FindLabel(t_tree, "file", "loop functions", LoopFunctionsByLabel);
    if (!t_tree.GetText("user_file").empty())
      create_user_ = FindLabel(t_tree, "user_file", "Qt user functions", UserFunctionsByLabel, "user_label");
    const TConfigurationTree user = t_tree.Child("user_functions");
    user_place_ = user.Exists() ? user.Location() : t_tree.Location();
    if (user.Exists()) CopyElement(*user.Node(), user_element_);
    if (t_tree.GetBoolean("rehearsal")) TheRunning().rehearsal.emplace();
    const TConfigurationTree element = t_tree.Child("loop_functions");
    place_ = element.Exists() ? element.Location() : t_tree.Location();
    if (element.Exists()) CopyElement(*element.Node(), element_);
    translation_ = Translation::From(t_tree);
    TheRunning().translation = translation_;
    const std::string floor = t_tree.GetText("floor");
    if (!floor.empty()) floor_.emplace(nullptr, floor);

    const CSwarmanoidSpace& space = editor.GetSpace();
    const Experiment& experiment = space.GetExperiment();
    argos::CSimulator& simulator = argos::CSimulator::GetInstance();
    simulator.GetSpace().SetSimulationClock(0);
    argos::CPhysicsEngine::SetSimulationClockTick(space.GetTickSeconds());
    length_ = static_cast<std::uint64_t>(t_tree.GetInteger("length"));
    if (TheRunning().is_program && length_ == 0) length_ = TheRunning().program_length;
    TheRunning().step = TheRunning().first_step = 0;
    // ARGoS3's clock does not count our first tick.
    const std::uint64_t ticks = length_ != 0 ? length_ : experiment.max_clock;
    simulator.Start(static_cast<UInt32>(experiment.seed), static_cast<UInt32>(ticks == 0 ? 0 : ticks - 1));
    if (const TConfigurationTree all = t_tree.Child("configuration"); all.Exists())
    {
      CopyElement(*all.Node(), simulator.Configuration());
      simulator.Configuration().SetValue("argos-configuration");
    }
    const Vector3& size = experiment.arena_size;
    simulator.GetSpace().SetArena({size.x(), size.y(), size.z()}, translation_.Argos3Position(size / 2));
    for (std::size_t i = 0; i < space.Size(); ++i) MakeView(space.GetEntity(i));
    if (TheRunning().functions != nullptr) throw std::runtime_error("a process runs one ARGoS3 experiment at a time");
    const Speaker speaker(editor);
    const Changing changing(editor);
    Fill(space);
    functions_.reset(create_());
    TheRunning().functions = functions_.get();
    TheRunning().stepped = this;
    TheRunning().editor_for_devices = &editor;
  }

  void PreStep(SpaceEditor& editor) override
  {
    // In the first tick no controller has run yet. Init follows it, when the controllers exist.
    if (editor.GetSpace().GetTick() != 0 && !TheRunning().is_program) BeginStep(editor);
  }

  void PostStep(SpaceEditor& editor) override
  {
    if (editor.GetSpace().GetTick() == 1)
    {
      Step(editor,
           [&]
           {
             const CSwarmanoidSpace& space = editor.GetSpace();
             for (std::size_t i = 0; i < space.Size(); ++i)
               if (space.IsPresent(i))
                 TheRunning().arrivals[space.GetEntity(i).GetId()] = ArrivalNow(space.GetEntity(i));
             Calling(place_, [&] { functions_->Init(element_); });
             if (const auto& rehearsal = TheRunning().rehearsal)
               WriteMadeBodies(rehearsal->Shapes(), editor.GetOutputFolder());
             if (!TheRunning().is_program) functions_->PreExperiment();
             MakeUserFunctions();
           });
      return;
    }
    const Speaker speaker(editor);
    const Changing changing(editor);
    functions_->PostStep();
    SendWrittenMessages();
    if (TheRunning().is_program) return;
    // Some functions reset the run in IsExperimentFinished, so it is called while changes are allowed.
    ends_ = functions_->IsExperimentFinished() || argos::CSimulator::GetInstance().IsTerminated();
  }

  Outcome IsFinished(const SpaceEditor& asked) override
  {
    const CSwarmanoidSpace& space = asked.GetSpace();
    if (space.GetTick() < 2) return Outcome::kRunning;
    if (TheRunning().is_program) return Outcome::kRunning;
    const bool over = ends_ || (length_ != 0 && space.GetTick() - TheRunning().first_step >= length_);
    const std::uint64_t last = space.GetExperiment().max_clock;
    is_over_ = over || (last != 0 && space.GetTick() >= last);
    return over ? Outcome::kDone : Outcome::kRunning;
  }

  // Draws in the order of ARGoS3: each entity, the floor, the world.
  void Draw(const SpaceEditor& editor, Drawing& drawing) override
  {
    if (user_functions_ == nullptr) return;
    const Speaker speaker(editor);
    Pen pen(drawing, translation_);
    const AtWork at_work(pen);
    const CSwarmanoidSpace& space = editor.GetSpace();
    for (const View& view : views_)
    {
      if (view.entity == nullptr || !space.IsPresent(view.index)) continue;
      pen.InFrameOf(view.index, view.is_box ? space.GetEntity(view.index).GetSize().z() / 2 : 0);
      user_functions_->Call(*view.entity);
    }
    pen.InWorld();
    if (floor_)
    {
      user_functions_->Call(*floor_);
      user_functions_->Draw(*floor_);
    }
    pen.InWorld();
    user_functions_->DrawInWorld();
  }

  void Input(const UserInput& input, SpaceEditor& editor) override
  {
    if (user_functions_ == nullptr) return;
    const Speaker speaker(editor);
    const Changing changing(editor);
    using Kind = UserInput::Kind;
    if (input.kind == Kind::kKeyPressed || input.kind == Kind::kKeyReleased)
    {
      const bool pressed = input.kind == Kind::kKeyPressed;
      QKeyEvent event = keyboard_.EventOf(input.key, pressed);
      if (pressed)
        user_functions_->KeyPressed(&event);
      else
        user_functions_->KeyReleased(&event);
      return;
    }
    const auto view = std::find_if(views_.begin(), views_.end(),
                                   [&](const View& one) { return one.index == input.entity->GetIndex(); });
    if (view == views_.end() || view->entity == nullptr) return;
    if (input.kind == Kind::kSelected)
      user_functions_->SelectEntity(*view->entity);
    else if (user_functions_->GetSelectedEntity() == view->entity)
      user_functions_->DeselectEntity();
  }

  void Destroy(SpaceEditor& editor) override
  {
    const Speaker speaker(editor);
    const Changing changing(editor);
    if (user_functions_ != nullptr) user_functions_->Destroy();
    // PostExperiment may change entities, so it is called here and not where the end is detected.
    if (is_over_) functions_->PostExperiment();
    is_over_ = false;
    if (editor.GetSpace().GetTick() >= 1) functions_->Destroy();
  }

private:
  // While the object lives, changes of loop functions go to the space.
  class Changing
  {
  public:
    explicit Changing(SpaceEditor& editor) : before_(std::exchange(TheRunning().editor, &editor)) {}
    ~Changing() { TheRunning().editor = before_; }
    Changing(const Changing&) = delete;
    Changing& operator=(const Changing&) = delete;

  private:
    SpaceEditor* before_;
  };

  // While the object lives, user functions draw with a pen.
  class AtWork
  {
  public:
    explicit AtWork(Pen& pen) { TheRunning().pen = &pen; }
    ~AtWork() { TheRunning().pen = nullptr; }
    AtWork(const AtWork&) = delete;
    AtWork& operator=(const AtWork&) = delete;
  };

  // A rehearsal or a program shows nothing, and has no user functions.
  void MakeUserFunctions()
  {
    if (create_user_ == nullptr || TheRunning().is_program || TheRunning().rehearsal) return;
    Calling(user_place_,
            [&]
            {
              user_functions_.reset(create_user_());
              user_functions_->Init(user_element_);
            });
  }

  void BeginStep(SpaceEditor& editor) override
  {
    Running& running = TheRunning();
    running.step = editor.GetSpace().GetTick();
    argos::CSimulator::GetInstance().GetSpace().SetSimulationClock(
        static_cast<UInt32>(running.step - running.first_step));
    Step(editor, [&] { functions_->PreStep(); });
  }
  bool IsOver() override
  {
    const argos::CSimulator& simulator = argos::CSimulator::GetInstance();
    const UInt32 most = simulator.GetMaxSimulationClock();
    return functions_->IsExperimentFinished() || simulator.IsTerminated() ||
           (most != 0 && argos::CSimulator::GetInstance().GetSpace().GetSimulationClock() >= most);
  }

  struct View
  {
    std::uint32_t index = 0;
    bool is_box = false;
    std::unique_ptr<argos::CEntity> made;
    // The entity of the file, or one that loop functions gave.
    argos::CEntity* entity = nullptr;
    argos::CEmbodiedEntity* body = nullptr;

    void Show(argos::CEntity* shown)
    {
      entity = shown;
      auto* with_body = dynamic_cast<argos::CBodyEntity*>(shown);
      body = with_body == nullptr ? nullptr : &with_body->GetEmbodiedEntity();
    }
  };

  template <class Call>
  void Step(SpaceEditor& editor, Call call)
  {
    const Speaker speaker(editor);
    const Changing changing(editor);
    Follow(editor.GetSpace());
    call();
    SendWrittenMessages();
  }

  void MakeView(const CSwarmanoidSpaceEntity& entity)
  {
    const std::string id = translation_.Argos3Id(entity.GetId());
    const std::string_view tag = TagName(entity.GetKind());
    const EntityConfiguration& configuration = entity.GetConfiguration();
    const Vector3& size = entity.GetSize();
    const argos::CVector3 at = translation_.Argos3Position(entity.GetPosition());
    View view{entity.GetIndex(), IsBox(entity), nullptr, nullptr, nullptr};
    if (tag == "footbot")
      view.made = std::make_unique<argos::CFootBotEntity>(id);
    else if (tag == "eyebot")
      view.made = std::make_unique<argos::CEyeBotEntity>(id);
    else if (tag == "argos3_epuck")
      view.made = std::make_unique<argos::CEPuckEntity>(id);
    else if (tag == kDemiurgeEPuck)
      view.made = std::make_unique<argos::CEPuckEntity>(id, 11U);
    else if (tag == "kilobot")
      view.made = std::make_unique<argos::CKilobotEntity>(id);
    else if (tag == "argos3_kheperaiv")
      view.made = std::make_unique<argos::CKheperaIVEntity>(id);
    else if (tag == "argos3_pipuck")
      view.made = std::make_unique<argos::CPiPuckEntity>(id);
    else if (tag == "argos3_spiri")
      view.made = std::make_unique<argos::CSpiriEntity>(id);
    else if (view.is_box)
      view.made =
          std::make_unique<argos::CBoxEntity>(id, entity.IsMovable(), tag == "block" ? 0U : 1U,
                                              argos::CVector3(size.x(), size.y(), size.z()), configuration.mass_kg);
    else if (tag == "cylindric_prey")
      view.made = std::make_unique<argos::CCylinderEntity>(id, entity.IsMovable(), 1U, size.x(), size.z(),
                                                           configuration.mass_kg);
    else if (tag == "light_bulb")
      view.made = std::make_unique<argos::CLightEntity>(id, at, argos::CColor(0xff000000U | configuration.colour),
                                                        configuration.intensity);
    else
      return;
    view.Show(view.made.get());
    views_.push_back(std::move(view));
  }

  // Adds the entities that are in the arena.
  void Fill(const CSwarmanoidSpace& space)
  {
    argos::CSpace& theirs = argos::CSimulator::GetInstance().GetSpace();
    theirs.Clear();
    moving_.clear();
    absent_.assign(space.Absent().begin(), space.Absent().end());
    if (floor_)
    {
      theirs.Insert(*floor_);
      theirs.SetFloor(&*floor_);
    }
    const Running& running = TheRunning();
    for (View& view : views_)
    {
      if (!space.IsPresent(view.index)) continue;
      const auto given = running.given.find(space.GetEntity(view.index).GetId());
      view.Show(given != running.given.end() ? given->second : view.made.get());
      if (view.body != nullptr)
      {
        const Moving body{view.index,
                          IsBox(space.GetEntity(view.index)) ? space.GetEntity(view.index).GetSize().z() / 2 : 0,
                          view.body};
        Place(space.GetPose(view.index), body.half_height, *body.body);
        if (view.body->IsMovable()) moving_.push_back(body);
      }
      theirs.InsertAny(*view.entity);
    }
  }

  void Follow(const CSwarmanoidSpace& space)
  {
    const bool is_same = std::equal(absent_.begin(), absent_.end(), space.Absent().begin(), space.Absent().end());
    if (!is_same || TheRunning().presence_changed) Fill(space);
    TheRunning().presence_changed = false;
    const PoseArrays& poses = space.Poses();
    for (const Moving& moving : moving_)
    {
      const std::uint32_t i = moving.index;
      Place({{poses.x[i], poses.y[i], poses.z[i]}, {poses.qw[i], poses.qx[i], poses.qy[i], poses.qz[i]}},
            moving.half_height, *moving.body);
    }
  }

  // Our position is `half_height` above the one that ARGoS3's code sees.
  void Place(const Pose& pose, double half_height, argos::CEmbodiedEntity& body) const
  {
    argos::SAnchor& origin = body.GetOriginAnchor();
    const Vector3 position =
        half_height == 0 ? pose.position : Vector3(pose.position - pose.orientation * Vector3(0, 0, half_height));
    origin.Position = translation_.Argos3Position(position);
    origin.Orientation = Argos3Orientation(pose.orientation);
    body.UpdateAnchors();
  }

  argos::CLoopFunctions* (*create_)() = nullptr;
  SourceLocation place_;
  Translation translation_;
  argos::TConfigurationNode element_;
  // A movable body in the arena. Its position is updated in each step.
  struct Moving
  {
    std::uint32_t index = 0;
    double half_height = 0;  // m, of a box, whose position is its middle here
    argos::CEmbodiedEntity* body = nullptr;
  };
  std::vector<View> views_;
  std::vector<Moving> moving_;
  std::vector<std::uint32_t> absent_;
  std::uint64_t length_ = 0;  // ticks
  bool ends_ = false;
  bool is_over_ = false;
  std::optional<argos::CFloorEntity> floor_;
  std::unique_ptr<argos::CLoopFunctions> functions_;
  argos::CQTOpenGLUserFunctions* (*create_user_)() = nullptr;
  SourceLocation user_place_;
  argos::TConfigurationNode user_element_;
  Keyboard keyboard_;
  std::unique_ptr<argos::CQTOpenGLUserFunctions> user_functions_;
};

const ExperimentFunctionsRegistration registration_of_functions(Argos3LoopFunctions::Description(),
                                                                []() -> std::unique_ptr<CExperimentFunctions>
                                                                { return std::make_unique<Argos3LoopFunctions>(); });

}  // namespace
}  // namespace swarmanoid::argos3
