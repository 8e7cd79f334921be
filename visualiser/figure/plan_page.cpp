// Problem: lay out one or several plans with legend, scale, axes, captions and an inset on a page of a given width.
//
// Method: all sizes are in millimetres of the page. First everything beside the panels is measured with the fonts of
// the page; the panels get the rest, and one scale. Labels are placed greedily: each tries four corners of its point
// and takes the first that is within the frame and free.
//
// Invariant: the picture depends on the plans and the options alone, so the same run gives the same file.
#include "visualiser/figure/plan_page.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "visualiser/scene/material.h"

namespace swarmanoid
{
namespace
{

struct Destroyed
{
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroyed>;
using Context = std::unique_ptr<cairo_t, Destroyed>;

constexpr double kPointsPerMm = 72 / 25.4;
constexpr double kMargin = 1.5;  // mm, around the page
constexpr double kGap = 3;       // mm, between panels
constexpr double kInsetShare = 0.4;
// These lengths are in heights of the font: the space for the numbers and the name of an axis, and behind the last
// number.
constexpr double kAxisRoom = 2.2;
constexpr double kAxisEnd = 0.8;
constexpr std::uint32_t kRim = 0x5a6068;

// Converts metres of the arena to millimetres of the page, whose y points down.
struct Frame
{
  PlanRegion region;
  double left = 0, top = 0;  // mm, of the region's upper left corner
  double scale = 1;          // mm a metre

  double X(double x) const { return left + (x - region.low.x()) * scale; }
  double Y(double y) const { return top + (region.high.y() - y) * scale; }
  double Width() const { return region.Size().x() * scale; }
  double Height() const { return region.Size().y() * scale; }
};

void SetColour(cairo_t* on, std::uint32_t rgb, double opacity = 1)
{
  cairo_set_source_rgba(on, (rgb >> 16 & 0xff) / 255.0, (rgb >> 8 & 0xff) / 255.0, (rgb & 0xff) / 255.0, opacity);
}

void SetDashes(cairo_t* on, bool dashed)
{
  constexpr double kDashes[] = {0.7, 0.5};
  cairo_set_dash(on, kDashes, dashed ? 2 : 0, 0);
}

double TextWidth(cairo_t* on, const std::string& text)
{
  cairo_text_extents_t extents;
  cairo_text_extents(on, text.c_str(), &extents);
  return extents.x_advance;
}

// Draws a text. `y` is the base line of the letters.
void DrawText(cairo_t* on, double x, double y, const std::string& text)
{
  cairo_move_to(on, x, y);
  cairo_show_text(on, text.c_str());
}

void DrawImage(cairo_t* on, const PlanShape& image, const Frame& frame)
{
  const int rows = static_cast<int>(image.pixels.size()) / image.columns;
  const Surface pixels(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.columns, rows));
  cairo_surface_flush(pixels.get());
  unsigned char* const data = cairo_image_surface_get_data(pixels.get());
  if (data == nullptr) throw std::runtime_error("there is not memory enough for a picture of the floor");
  const int stride = cairo_image_surface_get_stride(pixels.get());
  for (int row = 0; row < rows; ++row)
    std::copy_n(image.pixels.data() + static_cast<std::ptrdiff_t>(row) * image.columns, image.columns,
                reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(row) * stride));
  cairo_surface_mark_dirty(pixels.get());
  const auto at = [&](std::size_t corner)
  { return Vector2(frame.X(image.points[corner].x()), frame.Y(image.points[corner].y())); };
  const Vector2 across = (at(1) - at(0)) / image.columns, down = (at(2) - at(0)) / rows;
  cairo_matrix_t matrix;
  cairo_matrix_init(&matrix, across.x(), across.y(), down.x(), down.y(), at(0).x(), at(0).y());
  cairo_save(on);
  cairo_transform(on, &matrix);
  cairo_set_source_surface(on, pixels.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(on), CAIRO_FILTER_NEAREST);
  cairo_paint(on);
  cairo_restore(on);
}

void DrawShape(cairo_t* on, const PlanShape& shape, const Frame& frame)
{
  if (shape.detail_m > 0 && shape.detail_m * frame.scale < 1) return;
  if (shape.form == PlanShape::Form::kImage) return DrawImage(on, shape, frame);
  const double x = frame.X(shape.points[0].x()), y = frame.Y(shape.points[0].y());
  if (shape.form == PlanShape::Form::kText) return;
  cairo_new_path(on);
  if (shape.form == PlanShape::Form::kDisc)
    cairo_arc(on, x, y, std::max(shape.radius * frame.scale, shape.least_radius_mm), 0, 2 * M_PI);
  else
    for (const Vector2& point : shape.points) cairo_line_to(on, frame.X(point.x()), frame.Y(point.y()));
  if (shape.form == PlanShape::Form::kPolygon) cairo_close_path(on);
  if (shape.fill)
  {
    SetColour(on, shape.fill->rgb, shape.fill->opacity);
    cairo_fill_preserve(on);
  }
  if (shape.edge)
  {
    SetColour(on, shape.edge->rgb, shape.edge->opacity);
    cairo_set_line_width(on, shape.edge_mm);
    SetDashes(on, shape.dashed);
    cairo_stroke(on);
  }
}

// Puts labels beside their points, if possible on a side where they are within the frame and overlap no other label.
void DrawLabels(cairo_t* on, const PlanPicture& picture, const Frame& frame)
{
  struct Box
  {
    double left, top, right, bottom;
    bool Meets(const Box& other) const
    {
      return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
  };
  std::vector<Box> taken;
  cairo_font_extents_t font;
  cairo_font_extents(on, &font);
  for (const PlanShape& shape : picture)
  {
    if (shape.form != PlanShape::Form::kText) continue;
    const double x = frame.X(shape.points[0].x()), y = frame.Y(shape.points[0].y());
    const double away = 0.75 * shape.radius * frame.scale + 0.3;
    const double width = TextWidth(on, shape.text);
    std::optional<Box> best;
    for (const auto& [right, up] : {std::pair(true, true), {true, false}, {false, true}, {false, false}})
    {
      const double left = right ? x + away : x - away - width;
      const double bottom = up ? y - away : y + away + font.ascent;
      const Box box{left, bottom - font.ascent, left + width, bottom};
      const bool fits = box.left >= frame.left && box.right <= frame.left + frame.Width() && box.top >= frame.top &&
                        box.bottom <= frame.top + frame.Height();
      if (!best) best = box;
      if (!fits || std::ranges::any_of(taken, [&](const Box& other) { return other.Meets(box); })) continue;
      best = box;
      break;
    }
    taken.push_back(*best);
    // A rim in the colour of the paper keeps the text readable on dark areas.
    cairo_new_path(on);
    cairo_move_to(on, best->left, best->bottom);
    cairo_text_path(on, shape.text.c_str());
    SetColour(on, 0xffffff, 0.8);
    SetDashes(on, false);
    cairo_set_line_width(on, 0.5);
    cairo_set_line_join(on, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke_preserve(on);
    cairo_set_line_join(on, CAIRO_LINE_JOIN_MITER);
    SetColour(on, shape.fill->rgb, shape.fill->opacity);
    cairo_fill(on);
  }
}

void DrawFrame(cairo_t* on, const Frame& frame, double width_mm)
{
  SetColour(on, kRim);
  SetDashes(on, false);
  cairo_set_line_width(on, width_mm);
  cairo_rectangle(on, frame.left, frame.top, frame.Width(), frame.Height());
  cairo_stroke(on);
}

void DrawPicture(cairo_t* on, const PlanPicture& picture, const Frame& frame, const PlanRegion& arena)
{
  cairo_save(on);
  cairo_rectangle(on, frame.left, frame.top, frame.Width(), frame.Height());
  cairo_clip(on);
  SetColour(on, 0xffffff);
  cairo_paint(on);
  for (const PlanShape& shape : picture) DrawShape(on, shape, frame);
  DrawLabels(on, picture, frame);
  // Draws the border of the arena, if it lies within the shown region.
  SetColour(on, kRim);
  SetDashes(on, false);
  cairo_set_line_width(on, 0.2);
  cairo_rectangle(on, frame.X(arena.low.x()), frame.Y(arena.high.y()), arena.Size().x() * frame.scale,
                  arena.Size().y() * frame.scale);
  cairo_stroke(on);
  cairo_restore(on);
  DrawFrame(on, frame, 0.2);
}

// Returns 1, 2 or 5 times a power of ten, at most `most`.
double RoundLength(double most)
{
  const double power = std::pow(10, std::floor(std::log10(most) + 1e-9));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= most * (1 + 1e-9)) return factor * power;
  return power;
}

class Page
{
public:
  Page(const std::vector<PlanPanel>& panels, const std::vector<PlanLegendEntry>& legend, const PlanPageOptions& options)
      : panels_(panels), legend_(legend), options_(options), font_mm_(options.font_pt / kPointsPerMm)
  {
    // Words are measured with the font of the page.
    const Surface nowhere(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
    const Context measure(cairo_create(nowhere.get()));
    cairo_scale(measure.get(), kPointsPerMm, kPointsPerMm);
    SetFont(measure.get());
    columns_ = std::clamp(options.columns, 1, static_cast<int>(std::max<std::size_t>(panels.size(), 1)));
    rows_ = (static_cast<int>(panels.size()) + columns_ - 1) / columns_;
    if (options.axes)
    {
      for (const auto& [y, label] : Ticks(options.region.low.y(), options.region.high.y()))
        axis_left_ = std::max(axis_left_, TextWidth(measure.get(), label) + kAxisRoom * font_mm_);
      axis_right_ = kAxisEnd * font_mm_;
      axis_below_ = 1.3 * kAxisRoom * font_mm_;
    }
    panel_width_ = (options.width_mm - 2 * kMargin - (columns_ - 1) * kGap) / columns_ - axis_left_ - axis_right_;
    scale_ = panel_width_ / options.region.Size().x();
    const bool has_captions =
        std::ranges::any_of(panels, [](const PlanPanel& panel) { return !panel.caption.empty(); });
    caption_mm_ = has_captions ? 1.5 * font_mm_ : 0;
    cell_height_ = caption_mm_ + options.region.Size().y() * scale_ + axis_below_;
    Arrange(measure.get());
  }

  double Width() const { return options_.width_mm; }
  double Height() const
  {
    return 2 * kMargin + rows_ * cell_height_ + (rows_ - 1) * kGap + (lines_ > 0 ? lines_ * Line() + 0.5 * Line() : 0);
  }

  void Draw(cairo_t* on) const
  {
    SetColour(on, 0xffffff);
    cairo_paint(on);
    SetFont(on);
    for (std::size_t i = 0; i < panels_.size(); ++i) DrawPanel(on, i);
    DrawLegend(on);
  }

private:
  double Line() const { return 1.7 * font_mm_; }

  void SetFont(cairo_t* on) const
  {
    cairo_select_font_face(on, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(on, font_mm_);
  }

  // Places the legend from left to right, in as many lines as it needs. The scale is at the right of the first line.
  void Arrange(cairo_t* measure)
  {
    const double right = options_.width_mm - kMargin;
    const double bar = options_.scale_bar ? ScaleBarLength(options_.region.Size().x()) : 0;
    bar_text_ = bar >= 1 ? fmt::format("{:g} m", bar) : fmt::format("{:g} cm", 100 * bar);
    bar_mm_ = bar * scale_;
    lines_ = options_.scale_bar ? 1 : 0;
    if (!options_.legend || legend_.empty()) return;
    lines_ = 1;
    const double bar_room = options_.scale_bar ? bar_mm_ + TextWidth(measure, bar_text_) + 3 * font_mm_ : 0;
    double x = kMargin;
    for (const PlanLegendEntry& entry : legend_)
    {
      texts_.push_back(LegendText(entry, scale_));
      const double width = 2.2 * font_mm_ + TextWidth(measure, texts_.back());
      if (x > kMargin && x + width > right - (lines_ == 1 ? bar_room : 0))
      {
        ++lines_;
        x = kMargin;
      }
      places_.push_back({x, (lines_ - 1) * Line()});
      x += width + font_mm_;
    }
  }

  // Returns the numbers along an axis with their texts.
  std::vector<std::pair<double, std::string>> Ticks(double low, double high) const
  {
    const double step = RoundLength(options_.region.Size().maxCoeff() / 4);
    std::vector<std::pair<double, std::string>> ticks;
    for (double number = std::ceil(low / step - 1e-9); number * step <= high + 1e-9 * step; ++number)
      ticks.emplace_back(number * step, fmt::format("{:g}", number * step + 0.0));
    return ticks;
  }

  void DrawPanel(cairo_t* on, std::size_t i) const
  {
    const int row = static_cast<int>(i) / columns_, column = static_cast<int>(i) % columns_;
    Frame frame;
    frame.region = options_.region;
    frame.scale = scale_;
    frame.left = kMargin + column * (axis_left_ + panel_width_ + axis_right_ + kGap) + axis_left_;
    frame.top = kMargin + row * (cell_height_ + kGap) + caption_mm_;
    SetColour(on, palette::kLabel);
    DrawText(on, frame.left, frame.top - 0.5 * font_mm_, panels_[i].caption);
    DrawPicture(on, panels_[i].picture, frame, options_.arena);
    if (options_.axes) DrawAxes(on, frame);
    if (options_.inset) DrawInset(on, panels_[i].picture, frame);
  }

  void DrawAxes(cairo_t* on, const Frame& frame) const
  {
    const PlanRegion& region = options_.region;
    SetColour(on, palette::kLabel);
    SetDashes(on, false);
    cairo_set_line_width(on, 0.2);
    const double mark = 0.3 * font_mm_;
    const double bottom = frame.top + frame.Height();
    for (const auto& [x, label] : Ticks(region.low.x(), region.high.x()))
    {
      cairo_move_to(on, frame.X(x), bottom);
      cairo_line_to(on, frame.X(x), bottom + mark);
      cairo_stroke(on);
      DrawText(on, frame.X(x) - TextWidth(on, label) / 2, bottom + mark + font_mm_, label);
    }
    for (const auto& [y, label] : Ticks(region.low.y(), region.high.y()))
    {
      cairo_move_to(on, frame.left, frame.Y(y));
      cairo_line_to(on, frame.left - mark, frame.Y(y));
      cairo_stroke(on);
      DrawText(on, frame.left - 1.5 * mark - TextWidth(on, label), frame.Y(y) + 0.35 * font_mm_, label);
    }
    DrawText(on, frame.left + frame.Width() / 2 - TextWidth(on, "x (m)") / 2, bottom + mark + 2.2 * font_mm_, "x (m)");
    cairo_save(on);
    cairo_translate(on, frame.left - axis_left_ + 0.8 * font_mm_, frame.top + frame.Height() / 2);
    cairo_rotate(on, -M_PI / 2);
    DrawText(on, -TextWidth(on, "y (m)") / 2, 0, "y (m)");
    cairo_restore(on);
  }

  void DrawInset(cairo_t* on, const PlanPicture& picture, const Frame& frame) const
  {
    const PlanRegion& region = *options_.inset;
    Frame source = frame;
    source.region = region;
    source.left = frame.X(region.low.x());
    source.top = frame.Y(region.high.y());
    Frame inset;
    inset.region = region;
    inset.scale = kInsetShare * std::min(frame.Width() / region.Size().x(), frame.Height() / region.Size().y());
    const PlanCorner corner = options_.inset_corner;
    const bool at_left = corner == PlanCorner::kTopLeft || corner == PlanCorner::kBottomLeft;
    const bool at_top = corner == PlanCorner::kTopLeft || corner == PlanCorner::kTopRight;
    inset.left = at_left ? frame.left : frame.left + frame.Width() - inset.Width();
    inset.top = at_top ? frame.top : frame.top + frame.Height() - inset.Height();
    // Two lines join the corners, on the sides that do not cross the frames.
    SetColour(on, kRim);
    SetDashes(on, true);
    cairo_set_line_width(on, 0.15);
    const bool slants = at_left == at_top;
    for (const double side : {0.0, 1.0})
    {
      const double other = slants ? 1 - side : side;
      cairo_move_to(on, source.left + side * source.Width(), source.top + other * source.Height());
      cairo_line_to(on, inset.left + side * inset.Width(), inset.top + other * inset.Height());
      cairo_stroke(on);
    }
    DrawPicture(on, picture, inset, options_.arena);
    DrawFrame(on, source, 0.3);
    DrawFrame(on, inset, 0.3);
  }

  void DrawLegend(cairo_t* on) const
  {
    const double top = kMargin + rows_ * cell_height_ + (rows_ - 1) * kGap + Line();
    for (std::size_t i = 0; i < places_.size(); ++i)
    {
      Frame frame;
      frame.region = {{-1, -1}, {1, 1}};
      frame.scale = 0.5 * font_mm_;
      frame.left = places_[i].x() + 0.1 * font_mm_;
      frame.top = top + places_[i].y() - 0.85 * font_mm_;
      for (PlanShape shape : legend_[i].sample)
      {
        shape.detail_m = 0;
        DrawShape(on, shape, frame);
      }
      SetColour(on, palette::kLabel);
      DrawText(on, places_[i].x() + 1.6 * font_mm_, top + places_[i].y(), texts_[i]);
    }
    if (!options_.scale_bar) return;
    const double right = options_.width_mm - kMargin;
    const double text = TextWidth(on, bar_text_);
    SetColour(on, palette::kLabel);
    SetDashes(on, false);
    cairo_rectangle(on, right - text - 0.5 * font_mm_ - bar_mm_, top - 0.55 * font_mm_, bar_mm_, 0.3 * font_mm_);
    cairo_fill(on);
    DrawText(on, right - text, top, bar_text_);
  }

  const std::vector<PlanPanel>& panels_;
  const std::vector<PlanLegendEntry>& legend_;
  const PlanPageOptions& options_;
  const double font_mm_;
  int columns_ = 1, rows_ = 1;
  double axis_left_ = 0, axis_right_ = 0, axis_below_ = 0;  // mm, around a panel
  double panel_width_ = 0, scale_ = 1, caption_mm_ = 0, cell_height_ = 0;
  double bar_mm_ = 0;
  std::string bar_text_;
  int lines_ = 0;
  std::vector<Vector2> places_;     // mm: positions of the legend's entries
  std::vector<std::string> texts_;  // of the legend's entries
};

std::string EndingOf(const std::string& path) { return std::filesystem::path(path).extension().string(); }

[[noreturn]] void FailToWrite(const std::string& path, cairo_status_t status)
{
  throw std::runtime_error(fmt::format("cannot write the plan {}: {}", path, cairo_status_to_string(status)));
}

}  // namespace

double ScaleBarLength(double panel_m) { return RoundLength(panel_m / 3); }

std::string LegendText(const PlanLegendEntry& entry, double mm_per_metre)
{
  const double true_mm = entry.radius * mm_per_metre;
  if (true_mm <= 0 || true_mm >= entry.least_radius_mm) return entry.text;
  const double drawn_mm = entry.least_radius_mm + PlanShape().edge_mm / 2;
  return fmt::format("{}, {:.2g} times as wide", entry.text, drawn_mm / true_mm);
}

void CheckPlanFile(const std::string& path)
{
  const std::string ending = EndingOf(path);
  if (ending != ".svg" && ending != ".pdf" && ending != ".png")
    throw std::invalid_argument(
        fmt::format("'{}' is no plan that can be written; it must end with .svg, .pdf or .png", path));
}

void WritePlan(const std::string& path, const std::vector<PlanPanel>& panels,
               const std::vector<PlanLegendEntry>& legend, const PlanPageOptions& options)
{
  CheckPlanFile(path);
  const Page page(panels, legend, options);
  const double width = page.Width(), height = page.Height();
  const std::string ending = EndingOf(path);
  const double dots = options.dpi / 25.4;  // dots a mm
  const Surface surface(
      ending == ".svg"   ? cairo_svg_surface_create(path.c_str(), width * kPointsPerMm, height * kPointsPerMm)
      : ending == ".pdf" ? cairo_pdf_surface_create(path.c_str(), width * kPointsPerMm, height * kPointsPerMm)
                         : cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(width * dots)),
                                                      static_cast<int>(std::lround(height * dots))));
  const auto check = [&](cairo_status_t status)
  {
    if (status != CAIRO_STATUS_SUCCESS) FailToWrite(path, status);
  };
  check(cairo_surface_status(surface.get()));
  {
    const Context context(cairo_create(surface.get()));
    const double units = ending == ".png" ? dots : kPointsPerMm;
    cairo_scale(context.get(), units, units);
    page.Draw(context.get());
    check(cairo_status(context.get()));
  }
  if (ending == ".png") return check(cairo_surface_write_to_png(surface.get(), path.c_str()));
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()));
}

}  // namespace swarmanoid
