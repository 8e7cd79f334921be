// figure_render: the arena seen from above as vector graphics for papers, with one or several ticks on a page. It draws
// when it has all ticks, or when the run ends.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>

#include "common/errors/print_error.h"
#include "common/space/space.h"
#include "visualiser/figure/plan_page.h"
#include "visualiser/figure/plan_scene.h"
#include "visualiser/render.h"
#include "visualiser/renderer_library.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kMostPanels = 100;

// Reads numbers separated by commas; throws ConfigurationError.
template <class Number>
std::vector<Number> NumbersOf(const Parameters& parameters, const char* name)
{
  const std::string text = parameters.Text(name);
  std::vector<Number> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end)
  {
    Number number{};
    at = std::find_if(at, end, [](char c) { return c != ' '; });
    const auto [next, error] = std::from_chars(at, end, number);
    const char* const comma = std::find_if(next, end, [](char c) { return c != ' '; });
    if (error != std::errc() || (comma != end && *comma != ',') || (comma != end && comma + 1 == end))
      throw ConfigurationError(parameters.Tree().ValueLocation(name),
                               fmt::format("{} is '{}'; it must be numbers with commas between them", name, text));
    numbers.push_back(number);
    at = comma == end ? end : comma + 1;
  }
  return numbers;
}

std::optional<PlanRegion> RegionOf(const Parameters& parameters, const char* name)
{
  const std::vector<double> numbers = NumbersOf<double>(parameters, name);
  if (numbers.empty()) return std::nullopt;
  const bool is_whole = numbers.size() == 4 && std::ranges::all_of(numbers, [](double n) { return std::isfinite(n); });
  if (!is_whole || !(numbers[0] < numbers[2] && numbers[1] < numbers[3]))
    throw ConfigurationError(parameters.Tree().ValueLocation(name),
                             fmt::format("{} is '{}'; it must be x0, y0, x1, y1 in metres, with x0 < x1 and y0 < y1",
                                         name, parameters.Text(name)));
  return PlanRegion{{numbers[0], numbers[1]}, {numbers[2], numbers[3]}};
}

PlanCorner CornerOf(const std::string& word)
{
  return word == "top_left"      ? PlanCorner::kTopLeft
         : word == "bottom_left" ? PlanCorner::kBottomLeft
         : word == "top_right"   ? PlanCorner::kTopRight
                                 : PlanCorner::kBottomRight;
}

class CFigureRender : public CRender
{
public:
  void Init(const RenderSetup& setup) override
  {
    const Parameters& parameters = setup.parameters;
    space_ = &setup.space;
    const std::string file = parameters.Text("file");
    try
    {
      CheckPlanFile(file);
    }
    catch (const std::invalid_argument& error)
    {
      throw ConfigurationError(parameters.Tree().ValueLocation("file"), error.what());
    }
    setup.CheckFile("file", file);
    file_ = file;
    files_ = setup.Files();
    ticks_ = NumbersOf<std::uint64_t>(parameters, "ticks");
    if (!std::ranges::is_sorted(ticks_, std::less_equal{}) || ticks_.size() > kMostPanels)
      throw ConfigurationError(
          parameters.Tree().ValueLocation("ticks"),
          fmt::format("ticks is '{}'; it must be at most {} ticks that ascend", parameters.Text("ticks"), kMostPanels));
    stop_ = parameters.Boolean("stop");
    const Vector3& arena = space_->GetExperiment().arena_size;
    page_.arena = {{0, 0}, {arena.x(), arena.y()}};
    page_.region = RegionOf(parameters, "region").value_or(page_.arena);
    page_.inset = RegionOf(parameters, "inset");
    page_.inset_corner = CornerOf(parameters.Text("inset_corner"));
    page_.width_mm = parameters.Number("width");
    page_.font_pt = parameters.Number("font");
    page_.dpi = parameters.Number("dpi");
    page_.legend = parameters.Boolean("show_legend");
    page_.scale_bar = parameters.Boolean("show_scale");
    page_.axes = parameters.Boolean("show_axes");
    const long long columns = parameters.Integer("columns");
    page_.columns =
        static_cast<int>(columns > 0 ? columns : std::min<long long>(3, static_cast<long long>(ticks_.size())));
    scene_.emplace(*space_, PlanOptions{parameters.Boolean("show_ids"), parameters.Boolean("show_trails")});
  }

  void Draw() override
  {
    if (done_) return;
    scene_->Track();
    // An attached visualiser may miss some ticks; then the next tick is drawn.
    if (panels_.size() < ticks_.size() && space_->GetTick() >= ticks_[panels_.size()]) AddPanel();
    if (!ticks_.empty() && panels_.size() == ticks_.size()) Write();
  }

  void Finish() override
  {
    if (done_) return;
    if (ticks_.empty()) AddPanel();
    if (panels_.size() < ticks_.size())
      PrintError("figure_render: {} has {} of {} ticks: the run ended at tick {}, before tick {}\n", file_,
                 panels_.size(), ticks_.size(), space_->GetTick(), ticks_[panels_.size()]);
    if (!panels_.empty()) Write();
  }

  bool Terminate() override { return stop_ && done_; }

private:
  void AddPanel()
  {
    std::string caption;
    if (!ticks_.empty())
      caption = fmt::format("{}{:g} s", ticks_.size() > 1 ? Letter(panels_.size()) + "  " : "", space_->GetTime());
    panels_.push_back({std::move(caption), scene_->Draw()});
  }

  // Returns (a) … (z), then (27) …
  static std::string Letter(std::size_t number)
  {
    return number < 26 ? fmt::format("({})", static_cast<char>('a' + number)) : fmt::format("({})", number + 1);
  }

  void Write()
  {
    WritePlan(files_.Claim(file_), panels_, scene_->Legend(), page_);
    done_ = true;
  }

  const CSwarmanoidSpace* space_ = nullptr;
  std::optional<PlanScene> scene_;
  OutputFiles files_;
  std::string file_;  // the name that the user gave
  std::vector<std::uint64_t> ticks_;
  PlanPageOptions page_;
  std::vector<PlanPanel> panels_;
  bool stop_ = false;
  bool done_ = false;
};

}  // namespace
}  // namespace swarmanoid

EXPORT_RENDERER(::swarmanoid::CFigureRender)
