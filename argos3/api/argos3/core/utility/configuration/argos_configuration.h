// Reads elements of the experiment file. All functions throw CARGoSException with the position in the file.
#pragma once

#include <argos3/core/utility/configuration/argos_exception.h>
#include <argos3/core/utility/configuration/tinyxml/ticpp.h>
#include <argos3/core/utility/datatypes/datatypes.h>

namespace argos
{

using TConfigurationNode = ticpp::Element;
using TConfigurationNodeIterator = ticpp::Iterator<ticpp::Element>;
using TConfigurationAttributeIterator = ticpp::Iterator<ticpp::Attribute>;

inline bool NodeExists(TConfigurationNode& node, const std::string& tag)
{
  return node.FirstChildElement(tag, false) != nullptr;
}
inline TConfigurationNode& GetNode(TConfigurationNode& node, const std::string& tag)
{
  try
  {
    return *node.FirstChildElement(tag);
  }
  catch (const ticpp::Exception& mistake)
  {
    throw CARGoSException(mistake.what());
  }
}
inline void AddChildNode(TConfigurationNode& parent, TConfigurationNode& child) { parent.InsertEndChild(child); }
inline bool NodeAttributeExists(TConfigurationNode& node, const std::string& name) { return node.HasAttribute(name); }

// Keeps a parameter out of the deduction of types.
template <class T>
struct SameType
{
  using Type = T;
};

// Read a value of a type. Booleans are written true and false, bytes as numbers.
inline void ReadValue(const std::string& text, bool& value)
{
  if (text != "true" && text != "false") throw ticpp::Exception("'" + text + "' is neither true nor false");
  value = text == "true";
}
inline void ReadValue(const std::string& text, UInt8& value)
{
  int number = 0;
  ticpp::ReadText(text, number);
  value = static_cast<UInt8>(number);
}
inline void ReadValue(const std::string& text, SInt8& value)
{
  int number = 0;
  ticpp::ReadText(text, number);
  value = static_cast<SInt8>(number);
}
template <class T>
void ReadValue(const std::string& text, T& value)
{
  ticpp::ReadText(text, value);
}

template <class T>
void GetNodeText(TConfigurationNode& node, T& value)
{
  try
  {
    std::string text;
    node.GetText(&text);
    ReadValue(text, value);
  }
  catch (const std::exception& mistake)
  {
    THROW_ARGOSEXCEPTION(node.Place() << ": the text of <" << node.Value() << ">: " << mistake.what());
  }
}
template <class T>
void GetNodeTextOrDefault(TConfigurationNode& node, T& value, const typename SameType<T>::Type& fallback)
{
  value = fallback;
  if (!node.GetText().empty()) GetNodeText(node, value);
}
template <class T>
void GetNodeAttribute(TConfigurationNode& node, const std::string& name, T& value)
{
  try
  {
    std::string text;
    node.GetAttribute(name, &text);
    ReadValue(text, value);
  }
  catch (const ticpp::Exception& mistake)
  {
    THROW_ARGOSEXCEPTION((node.HasAttribute(name) ? node.Place() + ": '" + name + "' of <" + node.Value() + ">: " : "")
                         << mistake.what());
  }
}
template <class T>
void GetNodeAttributeOrDefault(TConfigurationNode& node, const std::string& name, T& value,
                               const typename SameType<T>::Type& fallback)
{
  value = fallback;
  if (node.HasAttribute(name)) GetNodeAttribute(node, name, value);
}
template <class T>
void SetNodeAttribute(TConfigurationNode& node, const std::string& name, const T& value)
{
  node.SetAttribute(name, value);
}

}  // namespace argos
