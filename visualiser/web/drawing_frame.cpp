#include "visualiser/web/drawing_frame.h"

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "common/space/space.h"
#include "visualiser/web/drawn_links.h"

namespace swarmanoid
{
namespace
{

std::uint32_t ColourWord(Colour colour, float opacity)
{
  return colour << 8U | static_cast<std::uint32_t>(std::lround(opacity * 255));
}

void CopyPlace(float* to, const Eigen::Vector3f& place)
{
  for (int k = 0; k < 3; ++k) to[k] = place[k];
}

template <class Value>
char* AppendAll(char* place, const std::vector<Value>& values)
{
  if (!values.empty()) std::memcpy(place, values.data(), values.size() * sizeof(Value));
  return place + values.size() * sizeof(Value);
}

}  // namespace

std::string DrawingBytes(const DrawnState& state, const DrawnLinks* links)
{
  DrawnMarks marks;
  CutDrawing(state, marks);
  if (links != nullptr) links->Add(marks.triangles);
  std::vector<DrawingLine> lines;
  for (const DrawnMarks::Line& line : marks.lines)
  {
    DrawingLine& one = lines.emplace_back();
    CopyPlace(one.from, line.from);
    CopyPlace(one.to, line.to);
    one.colour = ColourWord(line.colour, line.opacity);
    one.width = line.width;
  }
  std::vector<DrawingTriangle> triangles;
  for (const DrawnMarks::Triangle& triangle : marks.triangles)
  {
    DrawingTriangle& one = triangles.emplace_back();
    for (int corner = 0; corner < 3; ++corner) CopyPlace(one.corners + 3 * corner, triangle.corners[corner]);
    one.colour = ColourWord(triangle.colour, triangle.opacity);
  }
  std::vector<DrawingDot> dots;
  for (const DrawnMarks::Dot& dot : marks.dots)
  {
    DrawingDot& one = dots.emplace_back();
    CopyPlace(one.place, dot.place);
    one.colour = ColourWord(dot.colour, dot.opacity);
    one.diameter = dot.diameter;
  }
  nlohmann::json texts = nlohmann::json::array();
  for (const DrawnMarks::Text& text : marks.texts)
    texts.push_back({text.place.x(), text.place.y(), text.place.z(), ColourWord(text.colour, text.opacity), text.text});
  const std::string words = texts.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);

  DrawingHeader header;
  header.lines = static_cast<std::uint32_t>(lines.size());
  header.triangles = static_cast<std::uint32_t>(triangles.size());
  header.dots = static_cast<std::uint32_t>(dots.size());
  header.tick = state.Space().GetTick();
  header.text_bytes = static_cast<std::uint32_t>(words.size());
  std::string bytes(sizeof header + lines.size() * sizeof(DrawingLine) + triangles.size() * sizeof(DrawingTriangle) +
                        dots.size() * sizeof(DrawingDot) + words.size(),
                    '\0');
  std::memcpy(bytes.data(), &header, sizeof header);
  char* place = AppendAll(bytes.data() + sizeof header, lines);
  place = AppendAll(place, triangles);
  place = AppendAll(place, dots);
  std::memcpy(place, words.data(), words.size());
  return bytes;
}

}  // namespace swarmanoid
