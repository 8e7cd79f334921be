// A frame has these passes: the shadow map; solid bodies, ground and floor, with depth; patches and drawings on the
// floor, with a depth offset; the sky; then all see-through things without writing depth; and last the texts. The
// picture is drawn with several samples a pixel and copied to the target at the end.
#include "visualiser/gl/gl_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "visualiser/gl/draw_list.h"
#include "visualiser/gl/label_atlas.h"
#include "visualiser/gl/mesh_store.h"
#include "visualiser/gl/quads.h"
#include "visualiser/gl/shaders.h"
#include "visualiser/gl/targets.h"
#include "visualiser/gl/view_volume.h"
#include "visualiser/scene/enlargement.h"
#include "visualiser/scene/floor_grid.h"

namespace swarmanoid
{
namespace
{

using Eigen::Vector2f;
using Eigen::Vector3f;
using Eigen::Vector4f;

// The sun is to the left behind the default view, rather high.
const Vector3 kTowardsSun = Vector3(-0.58, -0.20, 0.79).normalized();
constexpr GLint kShadowUnit = 0;
constexpr GLint kLightsUnit = 1;
constexpr GLint kAtlasUnit = 2;
constexpr float kCaptionMargin = 12;  // pixels

Vector3f Linear(Colour colour) { return ChannelsOf(colour).cwiseAbs2(); }

// Returns the metres between contour lines: about eight up the highest terrain.
float ContourOf(const Scene& scene)
{
  float height = 0;
  for (const SceneItem& item : scene.Items())
    if (const Model& model = scene.Models()[item.model]; model.is_terrain)
      height = std::max(height, model.box.sizes().z());
  for (const float spacing : {0.005F, 0.01F, 0.02F, 0.05F, 0.1F, 0.2F, 0.5F, 1.0F})
    if (height <= 9 * spacing) return spacing;
  return 2;
}

}  // namespace

struct GlScene::State
{
  explicit State(float scale) : text_scale(scale), labels(scale) {}

  Shaders shaders;
  MeshStore meshes;
  PictureTarget target;
  ShadowMap shadow_map;
  float text_scale;
  LabelAtlas labels;
  Quads<GlLine> lines{3, 3, 4, 3};
  Quads<GlGlow> glows{4, 4, 2};
  Quads<Glyph> glyphs{4, 4, 4};
  PaintedTriangles paint;
  GlObject light_buffer{GlObject::Kind::kBuffer};
  GlObject light_texture{GlObject::Kind::kTexture};

  Frame frame;
  std::vector<std::uint8_t> light_bytes;
  DrawStatistics statistics;

  void UploadLights(const Scene& scene);
  void DrawShadowMap(const SunVolume& sun);
  void SetLight(const GlProgram& program, const Scene& scene, const Camera& camera, const SunVolume& sun,
                const DrawOptions& options) const;
  void DrawFloor(const Scene& scene, const ViewVolume& view, const DrawOptions& options);
  void DrawSky(const ViewVolume& view);
  void DrawLines(const ViewVolume& view, int width, int height, std::span<const GlLine> some, bool depth);
  void DrawGlows(const ViewVolume& view, const Camera& camera, std::span<const GlGlow> some);
  void DrawPaint(const ViewVolume& view, std::span<const GlPaint> corners);
};

GlScene::GlScene(float text_scale)
{
  if (epoxy_gl_version() < 33 || !epoxy_is_desktop_gl())
    throw std::runtime_error("OpenGL 3.3 is needed; this machine offers " + ContextDescription());
  state_ = std::make_unique<State>(text_scale);
}

GlScene::~GlScene() = default;

std::string GlScene::ContextDescription()
{
  const auto text = [](GLenum name)
  {
    const GLubyte* words = glGetString(name);
    return words == nullptr ? std::string("unknown") : std::string(reinterpret_cast<const char*>(words));
  };
  return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

const DrawStatistics& GlScene::Statistics() const { return state_->statistics; }

void GlScene::Draw(const Scene& scene, const Camera& camera, unsigned framebuffer, int width, int height,
                   const DrawOptions& options)
{
  State& s = *state_;
  s.target.Resize(width, height, options.samples);
  s.meshes.SetModels(scene.Models());
  s.statistics = {};

  Vector3 low, high;
  scene.Bounds(low, high);
  const ViewVolume view(camera, width, height, low, high);
  const SunVolume sun(kTowardsSun, view.seen_low, view.seen_high);
  s.frame.Sort(scene, view, sun, options, s.text_scale);
  s.statistics.instances = s.frame.instances;
  s.statistics.points = s.frame.points.size();
  s.statistics.enlargement = s.frame.enlargement;
  s.frame.SortMarks(scene, s.labels, camera, width, height);
  std::string caption = options.caption;
  if (const std::string larger = EnlargementText(s.frame.enlargement); options.says_enlargement && !larger.empty())
    caption += (caption.empty() ? "" : ", ") + larger;
  if (!caption.empty())
  {
    const float margin = kCaptionMargin * s.text_scale;
    s.labels.AppendFrom(caption, margin, static_cast<float>(height) - margin, s.frame.glyphs);
  }
  s.UploadLights(scene);

  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glEnable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  if (options.shadows) s.DrawShadowMap(sun);

  glBindFramebuffer(GL_FRAMEBUFFER, s.target.Framebuffer());
  glViewport(0, 0, width, height);
  glClear(GL_DEPTH_BUFFER_BIT);
  glActiveTexture(GL_TEXTURE0 + kShadowUnit);
  glBindTexture(GL_TEXTURE_2D, s.shadow_map.Texture());
  glActiveTexture(GL_TEXTURE0 + kLightsUnit);
  glBindTexture(GL_TEXTURE_BUFFER, s.light_texture.Name());

  // Solid things come first, roughly by distance: the floor covers most of the picture and comes after the bodies.
  const GlProgram& body = s.shaders.body;
  body.Use();
  s.SetLight(body, scene, camera, sun, options);
  body.Set("u_view_projection", view.view_projection);
  body.Set("u_lights", kLightsUnit);
  body.Set("u_contour", 0.0F);
  s.statistics.triangles += s.meshes.Draw(s.frame.solid);
  body.Set("u_contour", options.textures ? ContourOf(scene) : 0.0F);
  s.statistics.triangles += s.meshes.Draw(s.frame.ground);
  body.Set("u_contour", 0.0F);
  s.shaders.floor.Use();
  s.SetLight(s.shaders.floor, scene, camera, sun, options);
  s.DrawFloor(scene, view, options);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(-1, -2);
  body.Use();
  s.statistics.triangles += s.meshes.Draw(s.frame.patches);
  glPolygonOffset(-2, -4);
  s.DrawPaint(view, s.frame.paint);
  glEnable(GL_CULL_FACE);
  glDisable(GL_POLYGON_OFFSET_FILL);
  s.DrawSky(view);

  // See-through things are drawn over the solid ones.
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  s.DrawGlows(view, camera, s.frame.soft);
  s.DrawGlows(view, camera, s.frame.points);
  s.DrawLines(view, width, height, s.frame.under, true);
  glDisable(GL_CULL_FACE);
  body.Use();
  s.statistics.triangles += s.meshes.Draw(s.frame.glass);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(-2, -4);
  s.DrawPaint(view, s.frame.clear_paint);
  glDisable(GL_POLYGON_OFFSET_FILL);
  s.DrawGlows(view, camera, s.frame.bright);
  s.DrawLines(view, width, height, s.frame.over, false);
  if (!s.frame.glyphs.empty())
  {
    glDisable(GL_DEPTH_TEST);
    s.shaders.text.Use();
    s.shaders.text.Set("u_size", Vector2f(static_cast<float>(width), static_cast<float>(height)));
    s.shaders.text.Set("u_atlas", kAtlasUnit);
    glActiveTexture(GL_TEXTURE0 + kAtlasUnit);
    glBindTexture(GL_TEXTURE_2D, s.labels.Texture());
    s.glyphs.Draw(s.frame.glyphs);
    glBindTexture(GL_TEXTURE_2D, 0);
  }

  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glActiveTexture(GL_TEXTURE0 + kLightsUnit);
  glBindTexture(GL_TEXTURE_BUFFER, 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, 0);
  glUseProgram(0);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, s.target.Framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

void GlScene::State::UploadLights(const Scene& scene)
{
  light_bytes.clear();
  for (const Colour light : scene.Lights())
    for (const std::uint32_t byte : {light >> 16, light >> 8, light, light == 0 ? 0U : 255U})
      light_bytes.push_back(static_cast<std::uint8_t>(byte & 0xff));
  if (light_bytes.empty()) light_bytes.assign(4, 0);
  glBindBuffer(GL_TEXTURE_BUFFER, light_buffer.Name());
  glBufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(light_bytes.size()), light_bytes.data(), GL_STREAM_DRAW);
  glBindBuffer(GL_TEXTURE_BUFFER, 0);
  glBindTexture(GL_TEXTURE_BUFFER, light_texture.Name());
  glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA8, light_buffer.Name());
  glBindTexture(GL_TEXTURE_BUFFER, 0);
}

void GlScene::State::DrawShadowMap(const SunVolume& sun)
{
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_map.Framebuffer());
  glViewport(0, 0, ShadowMap::kSide, ShadowMap::kSide);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5F, 3);
  glDisable(GL_CULL_FACE);
  shaders.caster.Use();
  shaders.caster.Set("u_view_projection", sun.view_projection);
  statistics.triangles += meshes.Draw(frame.casters);
  glEnable(GL_CULL_FACE);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void GlScene::State::SetLight(const GlProgram& program, const Scene& scene, const Camera& camera, const SunVolume& sun,
                              const DrawOptions& options) const
{
  const auto size = static_cast<float>(scene.ArenaSize().head<2>().norm());
  program.Set("u_eye", Vector3f(camera.position.cast<float>()));
  program.Set("u_sun", Vector3f(kTowardsSun.cast<float>()));
  program.Set("u_fog", ChannelsOf(palette::kSky));
  program.Set("u_fog_distance", 5 * size + 10);
  program.Set("u_shadows", options.shadows ? 1 : 0);
  program.Set("u_shadow_map", kShadowUnit);
  program.Set("u_shadow_texel", 1.0F / ShadowMap::kSide);
  program.Set("u_shadow_bias", 0.8F * sun.width / static_cast<float>(ShadowMap::kSide) / sun.depth);
  program.Set("u_shadow", sun.to_texture);
  if (&program != &shaders.body) return;
  std::array<Vector4f, 32> looks;
  std::array<Vector2f, 32> kinds;
  for (std::size_t m = 0; m < static_cast<std::size_t>(Material::kEnd); ++m)
  {
    const MaterialLook& look = LookOf(static_cast<Material>(m));
    looks[m] << Linear(look.colour), look.gloss;
    kinds[m] = Vector2f(look.is_painted ? 2 : look.takes_tint ? 1 : 0, static_cast<float>(look.led));
  }
  constexpr auto kMaterials = static_cast<GLsizei>(Material::kEnd);
  glUniform4fv(program.Location("u_materials"), kMaterials, looks[0].data());
  glUniform2fv(program.Location("u_kinds"), kMaterials, kinds[0].data());
}

void GlScene::State::DrawFloor(const Scene& scene, const ViewVolume& view, const DrawOptions& options)
{
  const GlProgram& floor = shaders.floor;
  const Vector2f size = scene.ArenaSize().head<2>().cast<float>();
  const Vector4f arena(0, 0, size.x(), size.y());
  floor.Set("u_view_projection", view.view_projection);
  floor.Set("u_arena", arena);
  floor.Set("u_outside", 0);
  floor.Set("u_rectangle", arena);
  floor.Set("u_height", 0.0F);
  floor.Set("u_colour", Linear(palette::kFloor));
  floor.Set("u_line_colour", Linear(palette::kFloorLine));
  floor.Set("u_spacing", options.textures ? static_cast<float>(FloorSpacing(scene.ArenaSize())) : 0.0F);
  // The offset makes flat things on the floor win over it.
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1, 2);
  lines.DrawOne();

  // The ground around the floor is a little lower, so that bodies beyond the edge stand on something.
  const float reach = 1.2F * std::max(size.x(), size.y());
  floor.Set("u_outside", 1);
  floor.Set("u_spacing", 0.0F);
  floor.Set("u_colour", Linear(palette::kOutside));
  floor.Set("u_rectangle", Vector4f(-reach, -reach, size.x() + reach, size.y() + reach));
  glPolygonOffset(2, 8);
  lines.DrawOne();
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void GlScene::State::DrawSky(const ViewVolume& view)
{
  shaders.sky.Use();
  shaders.sky.Set("u_inverse", Eigen::Matrix4f(view.view_projection.inverse()));
  shaders.sky.Set("u_fog", ChannelsOf(palette::kSky));
  glDisable(GL_CULL_FACE);
  lines.DrawOne();
  glEnable(GL_CULL_FACE);
}

void GlScene::State::DrawLines(const ViewVolume& view, int width, int height, std::span<const GlLine> some, bool depth)
{
  if (some.empty()) return;
  const GlProgram& line = shaders.line;
  line.Use();
  line.Set("u_view_projection", view.view_projection);
  line.Set("u_size", Vector2f(static_cast<float>(width), static_cast<float>(height)));
  line.Set("u_near", static_cast<float>(view.near));
  line.Set("u_opacity", 1.0F);
  glDisable(GL_CULL_FACE);
  if (!depth) glDisable(GL_DEPTH_TEST);
  lines.Draw(some);
  glEnable(GL_DEPTH_TEST);
}

void GlScene::State::DrawPaint(const ViewVolume& view, std::span<const GlPaint> corners)
{
  if (corners.empty()) return;
  shaders.paint.Use();
  shaders.paint.Set("u_view_projection", view.view_projection);
  glDisable(GL_CULL_FACE);
  paint.Draw(corners);
}

void GlScene::State::DrawGlows(const ViewVolume& view, const Camera& camera, std::span<const GlGlow> some)
{
  if (some.empty()) return;
  const GlProgram& glow = shaders.glow;
  glow.Use();
  glow.Set("u_view_projection", view.view_projection);
  glow.Set("u_right", Vector3f(camera.Right().cast<float>()));
  glow.Set("u_up", Vector3f(camera.Up().cast<float>()));
  glDisable(GL_CULL_FACE);
  glows.Draw(some);
}

Picture ReadPicture(unsigned framebuffer, int width, int height)
{
  Picture picture{width, height, {}};
  const std::size_t row = 4 * static_cast<std::size_t>(width);
  std::vector<std::uint8_t> pixels(row * static_cast<std::size_t>(height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  picture.pixels.resize(pixels.size());
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y)
    std::memcpy(&picture.pixels[y * row], &pixels[(static_cast<std::size_t>(height) - 1 - y) * row], row);
  return picture;
}

}  // namespace swarmanoid
