// The names of Qt that user functions need: keys, fonts, texts. Qt itself is not used. The headers in the folder qt
// (<QKeyEvent> …) include this file.
#pragma once

#include <string>

namespace Qt
{

// The constants have the values of Qt.
enum Key
{
  Key_Space = 0x20,
  Key_Exclam,
  Key_QuoteDbl,
  Key_NumberSign,
  Key_Dollar,
  Key_Percent,
  Key_Ampersand,
  Key_Apostrophe,
  Key_ParenLeft,
  Key_ParenRight,
  Key_Asterisk,
  Key_Plus,
  Key_Comma,
  Key_Minus,
  Key_Period,
  Key_Slash,
  Key_0 = 0x30,
  Key_1,
  Key_2,
  Key_3,
  Key_4,
  Key_5,
  Key_6,
  Key_7,
  Key_8,
  Key_9,
  Key_Colon,
  Key_Semicolon,
  Key_Less,
  Key_Equal,
  Key_Greater,
  Key_Question,
  Key_At,
  Key_A = 0x41,
  Key_B,
  Key_C,
  Key_D,
  Key_E,
  Key_F,
  Key_G,
  Key_H,
  Key_I,
  Key_J,
  Key_K,
  Key_L,
  Key_M,
  Key_N,
  Key_O,
  Key_P,
  Key_Q,
  Key_R,
  Key_S,
  Key_T,
  Key_U,
  Key_V,
  Key_W,
  Key_X,
  Key_Y,
  Key_Z,
  Key_BracketLeft = 0x5b,
  Key_Backslash,
  Key_BracketRight,
  Key_AsciiCircum,
  Key_Underscore,
  Key_QuoteLeft,
  Key_BraceLeft = 0x7b,
  Key_Bar,
  Key_BraceRight,
  Key_AsciiTilde,
  Key_Escape = 0x01000000,
  Key_Tab,
  Key_Backtab,
  Key_Backspace,
  Key_Return,
  Key_Enter,
  Key_Insert,
  Key_Delete,
  Key_Pause,
  Key_Print,
  Key_Home = 0x01000010,
  Key_End,
  Key_Left,
  Key_Up,
  Key_Right,
  Key_Down,
  Key_PageUp,
  Key_PageDown,
  Key_Shift = 0x01000020,
  Key_Control,
  Key_Meta,
  Key_Alt,
  Key_F1 = 0x01000030,
  Key_F2,
  Key_F3,
  Key_F4,
  Key_F5,
  Key_F6,
  Key_F7,
  Key_F8,
  Key_F9,
  Key_F10,
  Key_F11,
  Key_F12,
  Key_unknown = 0x01ffffff
};

enum KeyboardModifier
{
  NoModifier = 0,
  ShiftModifier = 0x02000000,
  ControlModifier = 0x04000000,
  AltModifier = 0x08000000
};

enum MouseButton
{
  NoButton = 0,
  LeftButton = 1,
  RightButton = 2,
  MiddleButton = 4
};

}  // namespace Qt

class QString
{
public:
  QString() = default;
  QString(const char* text) : text_(text) {}
  QString(const std::string& text) : text_(text) {}
  static QString fromStdString(const std::string& text) { return QString(text); }
  static QString number(long long value) { return QString(std::to_string(value)); }
  std::string toStdString() const { return text_; }

private:
  std::string text_;
};

// Texts have the font of the visualiser, whatever font is requested.
class QFont
{
public:
  enum Weight
  {
    Light = 25,
    Normal = 50,
    DemiBold = 63,
    Bold = 75,
    Black = 87
  };

  QFont() = default;
  QFont(const QString& /*family*/, int /*points*/ = -1, int /*weight*/ = -1, bool /*italic*/ = false) {}
  void setFamily(const QString&) {}
  void setPointSize(int) {}
  void setPixelSize(int) {}
  void setWeight(int) {}
  void setBold(bool) {}
  void setItalic(bool) {}
};

class QKeyEvent
{
public:
  QKeyEvent(int key, int modifiers, const std::string& text) : key_(key), modifiers_(modifiers), text_(text) {}
  int key() const { return key_; }
  int modifiers() const { return modifiers_; }
  // Returns the character of the key, or an empty text.
  QString text() const { return text_; }
  bool isAutoRepeat() const { return false; }
  void accept() {}
  void ignore() {}

private:
  int key_;
  int modifiers_;
  std::string text_;
};

// The mouse is never sent, since windows and pages handle it themselves.
class QMouseEvent
{
public:
  int x() const { return 0; }
  int y() const { return 0; }
  int button() const { return Qt::NoButton; }
  int buttons() const { return Qt::NoButton; }
  int modifiers() const { return Qt::NoModifier; }
};
