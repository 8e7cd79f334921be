// The shader programs of GlScene, as texts of GLSL 3.30. Bodies have one light, the sun, with shadows from a depth map,
// and light from the sky and the ground by the direction of the normal. Lines, glows and texts are quadrangles that the
// vertex shader spreads in the plane of the picture, since widths are in pixels.
#include "visualiser/gl/shaders.h"

namespace swarmanoid
{
namespace
{

const std::string kVersion = "#version 330 core\n";

// Colours are squared to be linear in light, and the square root is taken at the end: a gamma of 2.
const std::string kLight = R"(
uniform vec3 u_eye;
uniform vec3 u_sun;           // towards it
uniform vec3 u_fog;
uniform float u_fog_distance; // m, at which half is fog
uniform bool u_shadows;
uniform sampler2DShadow u_shadow_map;
uniform float u_shadow_texel;
uniform float u_shadow_bias;

float Sunlit(vec3 place, float slope)
{
  if (!u_shadows) return 1.0;
  vec3 p = place - vec3(0.0, 0.0, u_shadow_bias * (1.0 + 2.0 * (1.0 - slope)));
  if (any(lessThan(p, vec3(0.0))) || any(greaterThan(p, vec3(1.0)))) return 1.0;
  float d = u_shadow_texel * 0.75;
  return 0.25 * (texture(u_shadow_map, p + vec3(-d, -0.4 * d, 0.0)) + texture(u_shadow_map, p + vec3(0.4 * d, -d, 0.0)) +
                 texture(u_shadow_map, p + vec3(d, 0.4 * d, 0.0)) + texture(u_shadow_map, p + vec3(-0.4 * d, d, 0.0)));
}

vec3 Fogged(vec3 colour, vec3 place)
{
  float part = distance(place, u_eye) / u_fog_distance;
  return mix(colour, u_fog, 1.0 - 1.0 / (1.0 + part * part * part * part));
}
)";

const std::string kTurn = R"(
vec3 Turn(vec4 q, vec3 v)
{
  vec3 t = 2.0 * cross(q.xyz, v);
  return v + q.w * t + cross(q.xyz, t);
}
)";

const std::string kBodyVertex = kVersion + kTurn + R"(
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
layout(location = 2) in vec2 a_material;  // number, shade
layout(location = 3) in vec3 i_place;
layout(location = 4) in vec4 i_orientation;
layout(location = 5) in vec3 i_scale;
layout(location = 6) in vec4 i_tint;
layout(location = 7) in float i_lights;
layout(location = 8) in vec3 a_colour;
uniform mat4 u_view_projection;
uniform mat4 u_shadow;
uniform vec4 u_materials[32];  // linear colour, gloss
uniform vec2 u_kinds[32];      // 1 takes the tint, 2 the vertex's colour; light
uniform samplerBuffer u_lights;
out vec3 v_place;
out vec3 v_normal;
out vec3 v_shadow;
flat out vec4 v_colour;  // linear, opacity
out float v_shade;
flat out vec2 v_look;    // gloss, shines

void main()
{
  int material = int(a_material.x + 0.5);
  v_place = i_place + Turn(i_orientation, a_position * i_scale);
  v_normal = normalize(Turn(i_orientation, a_normal / i_scale));
  vec4 shadow = u_shadow * vec4(v_place, 1.0);
  v_shadow = shadow.xyz;
  vec2 kind = u_kinds[material];
  vec4 look = u_materials[material];
  v_colour = vec4(look.rgb, i_tint.a);
  if (kind.x > 1.5) v_colour.rgb = a_colour * a_colour;
  else if (kind.x > 0.5) v_colour.rgb = i_tint.rgb * i_tint.rgb;
  v_look = vec2(look.a, 0.0);
  if (kind.y >= 0.0 && i_lights >= 0.0)
  {
    vec4 light = texelFetch(u_lights, int(i_lights + kind.y));
    if (light.a > 0.5)
    {
      v_colour.rgb = light.rgb;
      v_look.y = 1.0;
    }
  }
  v_shade = a_material.y / 255.0;
  gl_Position = u_view_projection * vec4(v_place, 1.0);
}
)";

const std::string kBodyFragment = kVersion + kLight + R"(
in vec3 v_place;
in vec3 v_normal;
in vec3 v_shadow;
flat in vec4 v_colour;
in float v_shade;
flat in vec2 v_look;
uniform float u_contour;  // m between the contour lines of a terrain, 0 for none
out vec4 o_colour;

void main()
{
  if (v_look.y > 0.5)
  {
    o_colour = vec4(v_colour.rgb, 1.0);
    return;
  }
  vec3 n = normalize(v_normal);
  float slope = dot(n, u_sun);
  float sun = 0.0;
  if (slope > 0.0) sun = Sunlit(v_shadow, slope);
  vec3 sky = mix(vec3(0.34, 0.33, 0.32), vec3(0.44, 0.47, 0.52), 0.5 * n.z + 0.5) * v_shade;
  vec3 light = sky + vec3(0.66, 0.62, 0.55) * max(slope, 0.0) * sun;
  vec3 colour = v_colour.rgb * light;
  if (u_contour > 0.0)
  {
    float height = v_place.z / u_contour;
    float width = fwidth(height);
    float line = clamp(1.3 - abs(fract(height - 0.5) - 0.5) / max(width, 0.001), 0.0, 1.0) * clamp(1.5 - 4.0 * width, 0.0, 1.0);
    colour *= 1.0 - 0.22 * line * clamp((1.0 - n.z) * 400.0, 0.0, 1.0);
  }
  vec3 eye = normalize(u_eye - v_place);
  float shine = max(dot(n, normalize(eye + u_sun)), 0.0);
  shine *= shine; shine *= shine; shine *= shine; shine *= shine; shine *= shine;
  float rim = 1.0 - max(dot(n, eye), 0.0);
  rim *= rim * rim;
  colour += v_look.x * (0.45 * shine * sun + 0.10 * rim);
  o_colour = vec4(Fogged(sqrt(min(colour, vec3(1.0))), v_place), v_colour.a);
}
)";

const std::string kCasterVertex = kVersion + kTurn + R"(
layout(location = 0) in vec3 a_position;
layout(location = 3) in vec3 i_place;
layout(location = 4) in vec4 i_orientation;
layout(location = 5) in vec3 i_scale;
uniform mat4 u_view_projection;
void main() { gl_Position = u_view_projection * vec4(i_place + Turn(i_orientation, a_position * i_scale), 1.0); }
)";

const std::string kCasterFragment = kVersion + "void main() {}\n";

const std::string kFloorVertex = kVersion + R"(
layout(location = 0) in vec2 a_corner;
uniform mat4 u_view_projection;
uniform mat4 u_shadow;
uniform vec4 u_rectangle;  // low x, low y, high x, high y
uniform float u_height;
out vec3 v_place;
out vec3 v_shadow;
void main()
{
  v_place = vec3(mix(u_rectangle.xy, u_rectangle.zw, a_corner), u_height);
  v_shadow = (u_shadow * vec4(v_place, 1.0)).xyz;
  gl_Position = u_view_projection * vec4(v_place, 1.0);
}
)";

const std::string kFloorFragment = kVersion + kLight + R"(
in vec3 v_place;
in vec3 v_shadow;
uniform vec3 u_colour;       // linear
uniform vec3 u_line_colour;  // linear
uniform float u_spacing;     // m between lines, 0 for a plain floor
uniform vec4 u_arena;        // as u_rectangle; around it the floor fades
uniform bool u_outside;
out vec4 o_colour;

void main()
{
  vec3 colour = u_colour;
  if (u_spacing > 0.0)
  {
    vec2 cell = v_place.xy / u_spacing;
    vec2 width = fwidth(cell);
    vec2 near = abs(fract(cell - 0.5) - 0.5);
    vec2 line = clamp(1.2 - near / max(width, vec2(0.004)), 0.0, 1.0) * clamp(1.5 - 6.0 * width, 0.0, 1.0);
    vec2 tile = floor(cell);
    float check = mod(tile.x + tile.y, 2.0) * clamp(1.5 - 2.5 * max(width.x, width.y), 0.0, 1.0);
    colour = mix(colour * (1.0 - 0.035 * check), u_line_colour, max(line.x, line.y));
  }
  float sun = Sunlit(v_shadow, u_sun.z);
  colour *= vec3(0.44, 0.47, 0.52) + vec3(0.66, 0.62, 0.55) * u_sun.z * sun;
  colour = sqrt(min(colour, vec3(1.0)));
  if (u_outside)
  {
    vec2 size = u_arena.zw - u_arena.xy;
    vec2 beyond = max(max(u_arena.xy - v_place.xy, v_place.xy - u_arena.zw), vec2(0.0));
    colour = mix(colour, u_fog, smoothstep(0.0, 1.1 * max(size.x, size.y), length(beyond)));
  }
  o_colour = vec4(u_outside ? colour : Fogged(colour, v_place), 1.0);
}
)";

const std::string kSkyVertex = kVersion + R"(
layout(location = 0) in vec2 a_corner;
uniform mat4 u_inverse;
out vec3 v_direction;
void main()
{
  vec2 place = 2.0 * a_corner - 1.0;
  vec4 far = u_inverse * vec4(place, 1.0, 1.0);
  vec4 near = u_inverse * vec4(place, -1.0, 1.0);
  v_direction = far.xyz / far.w - near.xyz / near.w;
  gl_Position = vec4(place, 1.0, 1.0);
}
)";

const std::string kSkyFragment = kVersion + R"(
in vec3 v_direction;
uniform vec3 u_fog;
out vec4 o_colour;
void main()
{
  float height = normalize(v_direction).z;
  o_colour = vec4(mix(u_fog, vec3(0.70, 0.80, 0.91), smoothstep(0.0, 0.7, height)), 1.0);
}
)";

// A line is a quadrangle across the picture. Parts behind the camera are cut off. A line of length 0 is a dot.
const std::string kLineVertex = kVersion + R"(
layout(location = 0) in vec2 a_corner;
layout(location = 1) in vec3 i_from;
layout(location = 2) in vec3 i_to;
layout(location = 3) in vec4 i_colour;
layout(location = 4) in vec3 i_width;  // pixels, opacity at both ends
uniform mat4 u_view_projection;
uniform vec2 u_size;
uniform float u_near;
out vec4 v_colour;
out float v_side;
out vec2 v_dot;
void main()
{
  bool dot_only = i_from == i_to;
  v_dot = dot_only ? 2.0 * a_corner - 1.0 : vec2(0.0);
  vec4 a = u_view_projection * vec4(i_from, 1.0);
  vec4 b = u_view_projection * vec4(i_to, 1.0);
  if (a.w < u_near && b.w < u_near)
  {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  if (a.w < u_near) a = mix(a, b, (u_near - a.w) / (b.w - a.w));
  if (b.w < u_near) b = mix(b, a, (u_near - b.w) / (a.w - b.w));
  vec2 along = (b.xy / b.w - a.xy / a.w) * u_size;
  float len = length(along);
  vec2 across = len > 0.0 ? vec2(-along.y, along.x) / len : vec2(0.0, 1.0);
  vec4 place = a_corner.x < 0.5 ? a : b;
  v_side = 2.0 * a_corner.y - 1.0;
  if (dot_only) place.xy += v_dot * i_width.x / u_size * place.w;
  else place.xy += across * v_side * (i_width.x + 1.0) / u_size * place.w;
  v_colour = vec4(i_colour.rgb, mix(i_width.y, i_width.z, a_corner.x));
  v_side *= i_width.x + 1.0;
  v_colour.a *= 1.0;
  // A dot as a ball would be: what it stands on hides no half of it.
  float nearer = dot_only ? 2.0 * u_near * i_width.x / u_size.y : 0.0;
  gl_Position = place - vec4(0.0, 0.0, 0.0005 * place.w + nearer, 0.0);
}
)";

const std::string kLineFragment = kVersion + R"(
in vec4 v_colour;
in float v_side;
in vec2 v_dot;
uniform float u_opacity;
out vec4 o_colour;
void main()
{
  if (dot(v_dot, v_dot) > 1.0) discard;
  o_colour = vec4(v_colour.rgb, v_colour.a * u_opacity);
}
)";

const std::string kPaintVertex = kVersion + R"(
layout(location = 0) in vec3 a_place;
layout(location = 1) in vec4 a_colour;
uniform mat4 u_view_projection;
out vec4 v_colour;
void main()
{
  v_colour = a_colour;
  gl_Position = u_view_projection * vec4(a_place, 1.0);
}
)";

const std::string kPaintFragment = kVersion + R"(
in vec4 v_colour;
out vec4 o_colour;
void main() { o_colour = v_colour; }
)";

const std::string kGlowVertex = kVersion + R"(
layout(location = 0) in vec2 a_corner;
layout(location = 1) in vec4 i_place;   // and radius
layout(location = 2) in vec4 i_colour;
layout(location = 3) in vec2 i_kind;    // flat, strength
uniform mat4 u_view_projection;
uniform vec3 u_right;
uniform vec3 u_up;
out vec2 v_place;
out vec4 v_colour;
flat out float v_strength;
void main()
{
  v_place = 2.0 * a_corner - 1.0;
  vec3 right = i_kind.x > 0.5 ? vec3(1.0, 0.0, 0.0) : u_right;
  vec3 up = i_kind.x > 0.5 ? vec3(0.0, 1.0, 0.0) : u_up;
  vec3 place = i_place.xyz + i_place.w * (v_place.x * right + v_place.y * up);
  if (i_kind.x > 0.5) place.z += 0.004;
  v_colour = i_colour;
  v_strength = i_kind.y;
  gl_Position = u_view_projection * vec4(place, 1.0);
  gl_Position.z -= 0.0003 * gl_Position.w;
}
)";

// Strength 0 is a dark spot, the soft shadow under a body; 1 is a lamp; 2 is the spot of a laser; 3 is a disc with a
// dark rim, a distant robot.
const std::string kGlowFragment = kVersion + R"(
in vec2 v_place;
in vec4 v_colour;
flat in float v_strength;
out vec4 o_colour;
void main()
{
  float r2 = dot(v_place, v_place);
  float soft = max(1.0 - r2, 0.0);
  soft *= soft;
  if (v_strength > 2.5)
  {
    float r = sqrt(r2);
    float pixel = max(fwidth(r), 1e-4);
    float rim = smoothstep(-0.5, 0.5, (r - 1.0 + max(1.4 * pixel, 0.26)) / pixel);
    o_colour = vec4(mix(v_colour.rgb, 0.42 * v_colour.rgb, rim), v_colour.a * clamp((1.0 - r) / pixel, 0.0, 1.0));
  }
  else if (v_strength > 1.5)
  {
    float core = 1.0 - smoothstep(0.03, 0.06, r2);
    o_colour = vec4(mix(v_colour.rgb, vec3(1.0), 0.55 * (1.0 - smoothstep(0.0, 0.03, r2))), max(core, 0.55 * soft));
  }
  else
    o_colour = vec4(v_colour.rgb, v_colour.a * soft);
}
)";

const std::string kTextVertex = kVersion + R"(
layout(location = 0) in vec2 a_corner;
layout(location = 1) in vec4 i_place;    // pixels from the upper left: left, top, right, bottom
layout(location = 2) in vec4 i_texture;  // the same within the atlas, 0..1
layout(location = 3) in vec4 i_colour;
uniform vec2 u_size;
out vec2 v_texture;
out vec4 v_colour;
void main()
{
  vec2 place = mix(i_place.xy, i_place.zw, a_corner);
  v_texture = mix(i_texture.xy, i_texture.zw, a_corner);
  v_colour = i_colour;
  gl_Position = vec4(2.0 * place.x / u_size.x - 1.0, 1.0 - 2.0 * place.y / u_size.y, 0.0, 1.0);
}
)";

const std::string kTextFragment = kVersion + R"(
in vec2 v_texture;
in vec4 v_colour;
uniform sampler2D u_atlas;
out vec4 o_colour;
void main() { o_colour = vec4(v_colour.rgb, v_colour.a * texture(u_atlas, v_texture).r); }
)";

}  // namespace

Shaders::Shaders()
    : body("body", kBodyVertex, kBodyFragment),
      caster("caster", kCasterVertex, kCasterFragment),
      floor("floor", kFloorVertex, kFloorFragment),
      sky("sky", kSkyVertex, kSkyFragment),
      line("line", kLineVertex, kLineFragment),
      glow("glow", kGlowVertex, kGlowFragment),
      text("text", kTextVertex, kTextFragment),
      paint("paint", kPaintVertex, kPaintFragment)
{
}

}  // namespace swarmanoid
