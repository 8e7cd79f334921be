#include "visualiser/gl/gl_object.h"

#include <array>
#include <stdexcept>

namespace swarmanoid
{
namespace
{

GLuint Compile(const std::string& title, GLenum stage, const std::string& source)
{
  const GLuint shader = glCreateShader(stage);
  const char* const text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint right = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &right);
  if (right != 0) return shader;
  std::array<char, 2000> words{};
  glGetShaderInfoLog(shader, words.size(), nullptr, words.data());
  throw std::runtime_error("OpenGL does not compile the shader '" + title + "': " + words.data());
}

struct Calls
{
  decltype(glGenBuffers) make;
  decltype(glDeleteBuffers) remove;
};
Calls CallsOf(GlObject::Kind kind)
{
  switch (kind)
  {
    case GlObject::Kind::kBuffer:
      return {glGenBuffers, glDeleteBuffers};
    case GlObject::Kind::kVertexArray:
      return {glGenVertexArrays, glDeleteVertexArrays};
    case GlObject::Kind::kTexture:
      return {glGenTextures, glDeleteTextures};
    case GlObject::Kind::kRenderbuffer:
      return {glGenRenderbuffers, glDeleteRenderbuffers};
    case GlObject::Kind::kFramebuffer:
      return {glGenFramebuffers, glDeleteFramebuffers};
  }
  return {};
}

}  // namespace

GlObject::GlObject(Kind kind) : kind_(kind) { CallsOf(kind).make(1, &name_); }

void GlObject::Release()
{
  if (name_ != 0) CallsOf(kind_).remove(1, &name_);
  name_ = 0;
}

GlProgram::GlProgram(const std::string& title, const std::string& vertex_source, const std::string& fragment_source)
    : name_(glCreateProgram())
{
  const GLuint vertex = Compile(title, GL_VERTEX_SHADER, vertex_source);
  const GLuint fragment = Compile(title, GL_FRAGMENT_SHADER, fragment_source);
  glAttachShader(name_, vertex);
  glAttachShader(name_, fragment);
  glLinkProgram(name_);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint right = 0;
  glGetProgramiv(name_, GL_LINK_STATUS, &right);
  if (right != 0) return;
  std::array<char, 2000> words{};
  glGetProgramInfoLog(name_, words.size(), nullptr, words.data());
  throw std::runtime_error("OpenGL does not link the shader '" + title + "': " + words.data());
}

}  // namespace swarmanoid
