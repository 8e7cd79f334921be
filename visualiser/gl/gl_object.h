// Owners of OpenGL's names, including shader programs. Their context must be current in every call.
#pragma once

#include <epoxy/gl.h>

#include <string>
#include <utility>

#include <Eigen/Core>

namespace swarmanoid
{

class GlObject
{
public:
  enum class Kind
  {
    kBuffer,
    kVertexArray,
    kTexture,
    kRenderbuffer,
    kFramebuffer
  };

  GlObject() = default;
  explicit GlObject(Kind kind);
  ~GlObject() { Release(); }
  GlObject(GlObject&& other) noexcept : kind_(other.kind_), name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept
  {
    Release();
    kind_ = other.kind_;
    name_ = std::exchange(other.name_, 0);
    return *this;
  }

  GLuint Name() const { return name_; }

private:
  void Release();

  Kind kind_ = Kind::kBuffer;
  GLuint name_ = 0;
};

class GlProgram
{
public:
  // Throws std::runtime_error with the compiler's message.
  GlProgram(const std::string& title, const std::string& vertex_source, const std::string& fragment_source);
  ~GlProgram() { glDeleteProgram(name_); }
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  // Uniforms that are set afterwards belong to the program in use.
  void Use() const { glUseProgram(name_); }
  void Set(const char* uniform, float value) const { glUniform1f(Location(uniform), value); }
  void Set(const char* uniform, int value) const { glUniform1i(Location(uniform), value); }
  void Set(const char* uniform, const Eigen::Vector2f& value) const
  {
    glUniform2fv(Location(uniform), 1, value.data());
  }
  void Set(const char* uniform, const Eigen::Vector3f& value) const
  {
    glUniform3fv(Location(uniform), 1, value.data());
  }
  void Set(const char* uniform, const Eigen::Vector4f& value) const
  {
    glUniform4fv(Location(uniform), 1, value.data());
  }
  void Set(const char* uniform, const Eigen::Matrix4f& value) const
  {
    glUniformMatrix4fv(Location(uniform), 1, GL_FALSE, value.data());
  }
  GLint Location(const char* uniform) const { return glGetUniformLocation(name_, uniform); }

private:
  GLuint name_;
};

}  // namespace swarmanoid
