// The names of OpenGL with which user functions draw. The visualisers show lines, points and areas between glBegin and
// glEnd. Light, textures and lists do not exist. The functions are members of CQTOpenGLUserFunctions.
#pragma once

#ifndef GL_VERSION_1_1

using GLenum = unsigned int;
using GLbitfield = unsigned int;
using GLint = int;
using GLuint = unsigned int;
using GLubyte = unsigned char;
using GLfloat = float;
using GLdouble = double;

// The constants have the values of OpenGL.
enum : GLenum
{
  GL_POINTS = 0x0000,
  GL_LINES = 0x0001,
  GL_LINE_LOOP = 0x0002,
  GL_LINE_STRIP = 0x0003,
  GL_TRIANGLES = 0x0004,
  GL_TRIANGLE_STRIP = 0x0005,
  GL_TRIANGLE_FAN = 0x0006,
  GL_QUADS = 0x0007,
  GL_QUAD_STRIP = 0x0008,
  GL_POLYGON = 0x0009,
  GL_FRONT = 0x0404,
  GL_BACK = 0x0405,
  GL_FRONT_AND_BACK = 0x0408,
  GL_POINT_SMOOTH = 0x0b10,
  GL_LINE_SMOOTH = 0x0b20,
  GL_POLYGON_SMOOTH = 0x0b41,
  GL_CULL_FACE = 0x0b44,
  GL_LIGHTING = 0x0b50,
  GL_COLOR_MATERIAL = 0x0b57,
  GL_DEPTH_TEST = 0x0b71,
  GL_BLEND = 0x0be2,
  GL_AMBIENT = 0x1200,
  GL_DIFFUSE = 0x1201,
  GL_SPECULAR = 0x1202,
  GL_EMISSION = 0x1600,
  GL_SHININESS = 0x1601,
  GL_AMBIENT_AND_DIFFUSE = 0x1602,
  GL_POINT = 0x1b00,
  GL_LINE = 0x1b01,
  GL_FILL = 0x1b02,
  GL_CURRENT_BIT = 0x0001,
  GL_POINT_BIT = 0x0002,
  GL_LINE_BIT = 0x0004,
  GL_POLYGON_BIT = 0x0008,
  GL_LIGHTING_BIT = 0x0040,
  GL_ENABLE_BIT = 0x2000
};

#endif
