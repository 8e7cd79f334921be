// The dark pixels of a plan are covered by rectangles (rectangles.h): once with runs along x and once with runs along
// y, since a wall along y is one rectangle in only one of them. The cover with fewer rectangles is taken.
#include "launcher/worlds/floor_plan.h"

#include <fmt/format.h>

#include <cctype>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/configuration/regular_file.h"
#include "common/configuration/wording.h"
#include "common/space/terrain/jpeg_picture.h"
#include "common/space/terrain/rectangles.h"
#include "launcher/worlds/imported_world.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kMostWalls = 100'000;
constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 26U;
constexpr std::uint64_t kMostPictureBytes = std::uint64_t{1} << 30U;
constexpr std::string_view kPngMagic = "\x89PNG";

bool IsPgm(std::string_view bytes) { return bytes.starts_with("P2") || bytes.starts_with("P5"); }

// Reads the numbers of a PGM, between which stand blanks and comments.
class PgmReader
{
public:
  explicit PgmReader(std::string_view bytes) : rest_(bytes) { rest_.remove_prefix(2); }

  std::uint64_t Number(const char* what, std::uint64_t most)
  {
    SkipBlanks();
    std::uint64_t number = 0;
    std::size_t digits = 0;
    for (; digits < rest_.size() && std::isdigit(static_cast<unsigned char>(rest_[digits])) != 0; ++digits)
    {
      number = 10 * number + static_cast<std::uint64_t>(rest_[digits] - '0');
      if (number > most) throw std::runtime_error(fmt::format("its {} is more than {}", what, most));
    }
    if (digits == 0) throw std::runtime_error(fmt::format("it has no {}", what));
    rest_.remove_prefix(digits);
    return number;
  }

  // Returns the bytes after the blank that ends the header.
  std::string_view Samples()
  {
    rest_.remove_prefix(std::min<std::size_t>(1, rest_.size()));
    return rest_;
  }

private:
  void SkipBlanks()
  {
    while (!rest_.empty())
    {
      if (rest_.front() == '#')
        rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
      else if (std::isspace(static_cast<unsigned char>(rest_.front())) != 0)
        rest_.remove_prefix(1);
      else
        return;
    }
  }

  std::string_view rest_;
};

GreyPicture GreysOf(const ColourPicture& colours)
{
  GreyPicture greys;
  greys.columns = colours.columns;
  greys.rows = colours.rows;
  greys.values.reserve(colours.pixels.size());
  for (const std::uint32_t pixel : colours.pixels)
    greys.values.push_back((0.299 * (pixel >> 16U & 255U) + 0.587 * (pixel >> 8U & 255U) + 0.114 * (pixel & 255U)) /
                           255);
  return greys;
}

std::vector<CellRectangle> FewestRectangles(const GreyPicture& picture, double threshold)
{
  const auto is_wall = [&](int x, int y)
  {
    return picture.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.columns) +
                          static_cast<std::size_t>(x)] < threshold;
  };
  std::vector<CellRectangle> along_x = CoverCells(picture.columns, picture.rows, is_wall);
  std::vector<CellRectangle> along_y =
      CoverCells(picture.rows, picture.columns, [&](int y, int x) { return is_wall(x, y); });
  if (along_x.size() <= along_y.size()) return along_x;
  for (CellRectangle& one : along_y) one = {one.first_y, one.first_x, one.last_y, one.last_x};
  return along_y;
}

}  // namespace

bool IsPicture(std::string_view bytes) { return bytes.starts_with(kPngMagic) || IsJpeg(bytes) || IsPgm(bytes); }

GreyPicture PgmPicture(std::string_view bytes)
{
  if (!IsPgm(bytes)) throw std::runtime_error("it is no PGM");
  const bool is_plain = bytes[1] == '2';
  PgmReader reader(bytes);
  constexpr std::uint64_t kMostOfRow = 1U << 16U;
  const std::uint64_t columns = reader.Number("width", kMostOfRow);
  const std::uint64_t rows = reader.Number("height", kMostOfRow);
  const std::uint64_t white = reader.Number("largest grey", 65535);
  if (columns == 0 || rows == 0 || white == 0) throw std::runtime_error("its width, height or largest grey is 0");
  const std::uint64_t pixels = columns * rows;
  if (pixels > kMostPixels) throw std::runtime_error(fmt::format("it has more than {} pixels", kMostPixels));
  GreyPicture picture;
  picture.columns = static_cast<int>(columns);
  picture.rows = static_cast<int>(rows);
  const auto take = [&](std::uint64_t grey)
  {
    if (grey > white) throw std::runtime_error(fmt::format("a grey of {} is more than its largest, {}", grey, white));
    picture.values.push_back(static_cast<double>(grey) / static_cast<double>(white));
  };
  if (is_plain)
  {
    // Each pixel takes two bytes at least, so a short file cannot ask for much memory.
    if (bytes.size() < 2 * pixels) throw std::runtime_error("it is cut short");
    picture.values.reserve(pixels);
    for (std::uint64_t k = 0; k < pixels; ++k) take(reader.Number("grey", 65535));
    return picture;
  }
  const std::string_view samples = reader.Samples();
  const std::uint64_t width = white > 255 ? 2 : 1;
  if (samples.size() < width * pixels) throw std::runtime_error("it is cut short");
  picture.values.reserve(pixels);
  for (std::uint64_t k = 0; k < pixels; ++k)
  {
    const auto byte = [&](std::uint64_t at) { return std::uint64_t{static_cast<unsigned char>(samples[at])}; };
    take(width == 1 ? byte(k) : 256 * byte(2 * k) + byte(2 * k + 1));
  }
  return picture;
}

GreyPicture ReadPlanPicture(const std::string& path)
{
  std::string bytes;
  try
  {
    bytes = ReadRegularFile(path, kMostPictureBytes);
    if (IsPgm(bytes)) return PgmPicture(bytes);
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(fmt::format("cannot read the picture {}: {}", Quoted(path), error.what()));
  }
  return IsJpeg(bytes) ? GreysOf(ReadColourPicture(path)) : ReadGreyPicture(path);
}

FloorPlan PlanFromPicture(const GreyPicture& picture, const FloorPlanOptions& options, const std::string& source)
{
  const std::vector<CellRectangle> walls = FewestRectangles(picture, options.threshold);
  if (walls.empty())
    throw std::runtime_error(fmt::format("no pixel of {} is darker than the threshold {}; raise --threshold",
                                         Quoted(source), options.threshold));
  if (walls.size() > kMostWalls)
    throw std::runtime_error(
        fmt::format("the dark pixels of {} make {} walls; at most {} are made. Choose another "
                    "--threshold, or remove noise from the picture",
                    Quoted(source), walls.size(), kMostWalls));
  const double pixel = options.resolution_m;
  // Ten digits keep positions exact to a micrometre, without the rounding errors of products.
  const auto number = [](double metres) { return fmt::format("{:.10g}", metres); };
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  text += ConvertedComment(
      source, fmt::format(": {} x {} pixels of {} m.{}", picture.columns, picture.rows, number(pixel), options.remark));
  text += "<ahss-config>\n  <framework clocktick=\"100\" maxclock=\"600\" seed=\"1\"/>\n";
  text += fmt::format("  <arena size=\"{}, {}, {}\" optimization=\"2D\">\n", number(picture.columns * pixel),
                      number(picture.rows * pixel), number(std::max(1.0, options.height_m)));
  for (std::size_t k = 0; k < walls.size(); ++k)
  {
    const CellRectangle& wall = walls[k];
    const double x = (wall.first_x + wall.last_x + 1) * pixel / 2;
    const double y = (2 * picture.rows - wall.first_y - wall.last_y - 1) * pixel / 2;
    text += fmt::format("    <wall id=\"wall_{}\" position=\"{}, {}, {}\" size=\"{}, {}, {}\"/>\n", k, number(x),
                        number(y), number(options.height_m / 2), number((wall.last_x - wall.first_x + 1) * pixel),
                        number((wall.last_y - wall.first_y + 1) * pixel), number(options.height_m));
  }
  text +=
      "  </arena>\n  <engines>\n    <kinematics2d id=\"physics\"/>\n  </engines>\n  <arena_physics>\n    <engine "
      "id=\"physics\">\n      <all/>\n    </engine>\n  </arena_physics>\n</ahss-config>\n";
  return {std::move(text), picture.columns, picture.rows, walls.size()};
}

}  // namespace swarmanoid
