// Viewer: one person's view of a run: camera, viewpoints, what is shown, selected, inspected and plotted, and what is
// asked of the run. Every renderer with a window holds one; it knows neither the window nor its graphics library. One
// thread, that of Draw and Idle.
#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "visualiser/interaction/entity_filter.h"
#include "visualiser/interaction/entity_values.h"
#include "visualiser/interaction/keys.h"
#include "visualiser/interaction/past_cursor.h"
#include "visualiser/interaction/value_history.h"
#include "visualiser/render.h"
#include "visualiser/scene/scene.h"
#include "visualiser/scene/viewpoints.h"

namespace swarmanoid
{

enum class MouseButton
{
  kLeft,
  kRight,
  kMiddle
};

struct Plot
{
  ValueName value;
  std::string title;  // "fb_3 speed"
  std::string unit;
  ValueHistory history;
};

class Viewer
{
public:
  using Clock = std::chrono::steady_clock;

  // What is on the screen beside the scene's own options; panels and keys change it.
  struct Shown
  {
    bool textures = true;
    bool shadows = true;
    bool panels = true;  // false: none of those below
    bool help = false;
    bool run = true;
    bool entities = true;
    bool plots = true;
    bool timeline = true;
    SceneOptions scene;
  };

  // A line for the person at the window, for some seconds.
  struct Message
  {
    std::string text;
    bool refused = false;
    Clock::time_point until;
  };

  // An entity that is being dragged over the floor, and where it would come to stand.
  struct Move
  {
    std::uint32_t entity;
    Pose pose;
  };

  // Size in pixels. The renderer's parameters hold viewpoints and quality (view_parameters.h).
  Viewer(const RenderSetup& setup, int width, int height);

  // The window. left: pixels that a panel hides, so that views of the whole arena keep clear of them.
  void SetSize(int width, int height, int left);

  // What the person does; places in pixels from the upper left corner. Not for keys and buttons meant for a panel.
  void Press(const KeyPress& press);
  // A key is let go.
  void Release(int key);
  void Do(const KeyCommand& command);
  void MousePress(MouseButton button, double x, double y, bool ctrl, bool shift);
  void MouseMove(double x, double y);
  void MouseRelease(MouseButton button);
  void Wheel(double notches, double x, double y);

  // The space is at a new tick, or entities have been moved.
  void StateCame();
  // Looks for what the journal has of the past. True if there is something else to show.
  bool FollowPast();
  // Brings the scene, and what is watched, to what is to be shown now.
  const Scene& Refresh();

  void Select(std::uint32_t entity, bool in_further_window = false);
  void Deselect();
  void CloseInspector(std::uint32_t entity);
  // Brings the camera near to an entity, along its line of sight.
  void Visit(std::uint32_t entity);
  bool IsPlotted(const ValueName& value) const;
  void SetPlotted(const ValueName& value, const std::string& unit, bool plotted);
  // Asks the run to put an entity somewhere.
  void MoveEntity(std::uint32_t entity, const Pose& pose);
  void SetSpeed(double real_time_factor);
  void Reset();
  void Say(const std::string& text, bool refused = false);

  // What is shown: at a tick of the past, or the present.
  const CSwarmanoidSpace& Space() const { return past_.IsOn() && past_.Space() ? *past_.Space() : setup_.space; }
  const CSwarmanoidSpace& Present() const { return setup_.space; }
  const PastCursor& GetPast() const { return past_; }
  // At the nearest tick that the journal has; says why if there is none.
  void LookBackAt(std::uint64_t tick);
  const Experiment& GetExperiment() const;
  const RunStatus& Status();
  const RobotStatus* Robot(std::uint32_t entity);
  // Whether the run can be asked for anything here.
  bool CanControl() const { return setup_.control != nullptr; }
  // Whether entities can be moved: nobody changes the past.
  bool CanMove() const { return CanControl() && !past_.IsOn(); }
  std::string Owner(std::uint32_t entity) const { return OwnerName(GetExperiment(), setup_.assignment, entity); }
  std::string Host(std::uint32_t entity) const { return HostNameOf(setup_.assignment, entity); }
  // Nothing of the past.
  std::optional<EntityMotion> Motion(std::uint32_t entity) const;
  const std::vector<std::uint32_t>& Inspected() const { return inspected_; }
  std::vector<Plot>& Plots() { return plots_; }
  EntityFilter& Filter() { return filter_; }
  const std::optional<Move>& MoveUnderWay() const { return move_; }
  // Those that are still to be seen, oldest first.
  const std::deque<Message>& Messages();
  const Viewpoints& GetViewpoints() const { return viewpoints_; }
  // What was stored last, as XML; empty if nothing was.
  const std::string& StoredXml() const { return stored_xml_; }
  // What is for the clipboard, and was not taken yet.
  std::string TakeCopy() { return std::exchange(copy_, {}); }

  bool WantsToClose() const { return close_; }
  // True once after the key for it.
  bool TakePictureRequest() { return std::exchange(picture_, false); }

  Shown shown;
  Camera camera;
  bool follows = false;  // the selected entity

private:
  enum class Drag
  {
    kNone,
    kClick,  // a left button that has not moved yet
    kOrbit,
    kPan,
    kEntity
  };
  struct Track
  {
    double time = 0;
    Pose pose;
    EntityMotion motion;
  };

  void ShowWholeArena(bool from_above);
  void StoreViewpoint(int number);
  void StartMove(std::uint32_t entity);
  void ChangeSpeed(int steps);
  void ToggleKeys();
  void TogglePause();
  bool MayLookBack();
  void LookBackBy(int ticks);
  void LookBackAtEvent(bool forward);
  void CopyBranchCommand();
  void CopyInspectCommand();
  void SayWhyNotMoved();
  void FollowSelected();
  EntityMotion MotionNow(std::uint32_t entity) const;
  void Toggle(bool& option, const std::string& what);
  void Click(double x, double y, bool ctrl);
  // Where turning and zooming is about.
  Vector3 Pivot() const;
  double MetresPerPixel(const Vector3& at) const;
  // Entities whose inside is on the screen.
  std::vector<std::uint32_t> Watched() const;
  void HearNotes();

  RenderSetup setup_;
  Scene scene_;
  PastCursor past_;
  std::unique_ptr<Scene> past_scene_;  // once somebody looked back
  std::uint64_t past_tick_ = 0;        // that it showed last
  bool may_look_back_ = true;
  bool was_past_ = false;
  Clock::time_point followed_{};  // when the journal was
  std::string copy_;
  Viewpoints viewpoints_;
  EntityFilter filter_;
  int width_, height_;
  int left_ = 0;
  std::vector<std::uint32_t> inspected_;  // in the order of their windows; the last one follows the selection
  std::vector<Plot> plots_;
  std::map<std::uint32_t, Track> tracks_;  // of the entities inspected or plotted
  std::vector<std::uint32_t> watched_;
  std::optional<Vector3> followed_place_;
  std::optional<Move> move_;
  Vector3 move_offset_ = Vector3::Zero();  // from where the mouse met the floor to the entity
  std::deque<Message> messages_;
  std::string last_note_;
  std::size_t notes_heard_ = 0;
  std::string stored_xml_;
  RunStatus no_status_;
  Drag drag_ = Drag::kNone;
  MouseButton drag_button_ = MouseButton::kLeft;
  bool drag_ctrl_ = false;
  double drag_x_ = 0, drag_y_ = 0;
  bool whole_arena_ = false;  // the camera is as ShowWholeArena left it
  bool gives_keys_ = false;
  std::vector<int> given_keys_;  // that are held
  bool close_ = false;
  bool picture_ = false;
};

}  // namespace swarmanoid
