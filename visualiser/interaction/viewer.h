// Viewer: one user's view of a run: camera, viewpoints, the shown, selected, inspected and plotted values, and requests
// to the run. Every renderer with a window owns one. It knows neither the window nor its graphics library. One thread
// uses it: that of Draw and Idle.
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

  // The content of the screen beside the scene's own options. Panels and keys change it.
  struct Shown
  {
    bool textures = true;
    bool shadows = true;
    bool panels = true;  // false: none of the panels below
    bool help = false;
    bool run = true;
    bool entities = true;
    bool plots = true;
    bool timeline = true;
    SceneOptions scene;
  };

  // A line for the user of the window, shown for some seconds.
  struct Message
  {
    std::string text;
    bool refused = false;
    Clock::time_point until;
  };

  // An entity that is being dragged over the floor, with its new position.
  struct Move
  {
    std::uint32_t entity;
    Pose pose;
  };

  // The size is in pixels. The renderer's parameters hold viewpoints and quality (view_parameters.h).
  Viewer(const RenderSetup& setup, int width, int height);

  // Sets the size of the window in pixels, and the edges that panels hide, which views of the whole arena avoid. If the
  // whole arena is shown, it is fitted again, but not for inspectors at the right: a click moves no picture.
  void SetSize(int width, int height, const HiddenEdges& hidden);

  // Handles the user's input, except keys and buttons that are meant for a panel. Positions are in pixels from the
  // upper left corner.
  void Press(const KeyPress& press);
  // Handles the release of a key.
  void Release(int key);
  // Executes the command of a key or of its button.
  void Do(const KeyCommand& command);
  void MousePress(MouseButton button, double x, double y, bool ctrl, bool shift);
  void MouseMove(double x, double y);
  void MouseRelease(MouseButton button);
  void Wheel(double notches, double x, double y);

  // Handles a new tick of the space, or moved entities.
  void StateCame();
  // Looks for the past in the journal. Returns true if the shown state changed.
  bool FollowPast();
  // Updates the scene and the watched robots to the shown state.
  const Scene& Refresh();

  // Selects an entity. `in_further_window`: its inspector opens beside the others.
  void Select(std::uint32_t entity, bool in_further_window = false);
  void Deselect();
  void CloseInspector(std::uint32_t entity);
  // Moves the camera near to an entity, along its line of sight.
  void Visit(std::uint32_t entity);
  bool IsPlotted(const ValueName& value) const;
  void SetPlotted(const ValueName& value, const std::string& unit, bool plotted);
  // Requests the run to move an entity.
  void MoveEntity(std::uint32_t entity, const Pose& pose);
  void SetSpeed(double real_time_factor);
  void Reset();
  void Say(const std::string& text, bool refused = false);

  // Returns the shown space: at a tick of the past, or the present.
  const CSwarmanoidSpace& Space() const { return past_.IsOn() && past_.Space() ? *past_.Space() : setup_.space; }
  const CSwarmanoidSpace& Present() const { return setup_.space; }
  const PastCursor& GetPast() const { return past_; }
  // Shows the nearest tick of the journal, or a message if it has none.
  void LookBackAt(std::uint64_t tick);
  const Experiment& GetExperiment() const;
  const RunStatus& Status();
  const RobotStatus* Robot(std::uint32_t entity);
  // Returns whether this renderer can send requests to the run.
  bool CanControl() const { return setup_.control != nullptr; }
  // Returns whether entities can be moved; the past cannot be changed.
  bool CanMove() const { return CanControl() && !past_.IsOn(); }
  std::string Owner(std::uint32_t entity) const;
  std::string Host(std::uint32_t entity) const { return HostNameOf(setup_.assignment, entity); }
  // Returns nothing in the past.
  std::optional<EntityMotion> Motion(std::uint32_t entity) const;
  const std::vector<std::uint32_t>& Inspected() const { return inspected_; }
  std::vector<Plot>& Plots() { return plots_; }
  EntityFilter& Filter() { return filter_; }
  const std::optional<Move>& MoveUnderWay() const { return move_; }
  // Returns the messages that are still shown, oldest first.
  const std::deque<Message>& Messages();
  const Viewpoints& GetViewpoints() const { return viewpoints_; }
  // Returns the last stored viewpoint as XML; empty if none was stored.
  const std::string& StoredXml() const { return stored_xml_; }
  // Returns the text for the clipboard, if it was not taken yet.
  std::string TakeCopy() { return std::exchange(copy_, {}); }

  bool WantsToClose() const { return close_; }
  // Returns true once after the key for a picture.
  bool TakePictureRequest() { return std::exchange(picture_, false); }

  Shown shown;
  Camera camera;
  bool follows = false;  // the camera follows the selected entity
  std::string note;      // about the picture, for the panel of the run; empty: none

private:
  enum class Drag
  {
    kNone,
    kClick,  // a pressed left button that has not moved yet
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
  // Returns the point about which the camera turns and zooms.
  Vector3 Pivot() const;
  double MetresPerPixel(const Vector3& at) const;
  // Returns the entities whose status is shown.
  std::vector<std::uint32_t> Watched() const;
  void HearNotes();

  RenderSetup setup_;
  Scene scene_;
  PastCursor past_;
  std::unique_ptr<Scene> past_scene_;  // made at the first look back
  std::uint64_t past_tick_ = 0;        // the tick that it showed last
  bool may_look_back_ = true;
  bool was_past_ = false;
  Clock::time_point followed_{};  // time of the last look at the journal
  std::string copy_;
  Viewpoints viewpoints_;
  EntityFilter filter_;
  int width_, height_;
  HiddenEdges hidden_;                    // by panels
  std::vector<std::uint32_t> inspected_;  // in the order of their windows; the last one follows the selection
  std::vector<Plot> plots_;
  std::map<std::uint32_t, Track> tracks_;  // by entity that is inspected or plotted
  std::vector<std::uint32_t> watched_;
  std::optional<Vector3> followed_place_;
  std::optional<Move> move_;
  Vector3 move_offset_ = Vector3::Zero();  // from the point where the mouse met the floor to the entity
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
  std::vector<int> given_keys_;  // the keys that are held
  bool close_ = false;
  bool picture_ = false;
};

}  // namespace swarmanoid
