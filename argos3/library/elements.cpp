// Elements and documents of ticpp. The simulator's readers read documents, so that a program reads what a run reads.
#include <argos3/core/utility/configuration/argos_configuration.h>

#include <algorithm>
#include <fstream>

#include "argos3/converter/tiny_xml.h"
#include "argos3/library/running.h"
#include "common/configuration/xml_reader.h"

namespace ticpp
{
namespace
{

std::string Escaped(const std::string& text)
{
  std::string escaped;
  for (const char c : text)
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  return escaped;
}

}  // namespace

std::string Element::GetAttribute(const std::string& name) const
{
  const Attribute* attribute = Find(name);
  return attribute != nullptr ? attribute->Value() : std::string();
}

const Attribute* Element::Find(const std::string& name) const
{
  const auto found = std::find_if(content_->attributes.begin(), content_->attributes.end(),
                                  [&](const Attribute& attribute) { return attribute.Name() == name; });
  return found == content_->attributes.end() ? nullptr : &*found;
}

void Element::Set(const std::string& name, const std::string& value)
{
  if (const Attribute* attribute = Find(name))
    const_cast<Attribute*>(attribute)->SetValue(value);
  else
    content_->attributes.emplace_back(name, value);
}

void Element::RemoveAttribute(const std::string& name)
{
  std::erase_if(content_->attributes, [&](const Attribute& attribute) { return attribute.Name() == name; });
}

Element* Element::FirstChildElement(const std::string& name, bool required) const
{
  for (const auto& child : content_->children)
    if (name.empty() || child->Value() == name) return child.get();
  if (required) throw Exception(Where() + "<" + Value() + "> has no <" + name + ">");
  return nullptr;
}

Element* Element::NextSiblingElement(const std::string& name, bool required) const
{
  const Content* parent = content_->parent;
  for (std::size_t i = content_->number + 1; parent != nullptr && i < parent->children.size(); ++i)
    if (name.empty() || parent->children[i]->Value() == name) return parent->children[i].get();
  if (required) throw Exception(Where() + "no <" + name + "> follows <" + Value() + ">");
  return nullptr;
}

Element& Element::InsertEndChild(const Element& child)
{
  auto added = std::make_unique<Element>(child.Value());
  Content& content = *added->content_;
  content.text = child.content_->text;
  content.place = child.content_->place;
  content.attributes = child.content_->attributes;
  content.parent = content_.get();
  content.number = content_->children.size();
  for (const auto& grandchild : child.content_->children) added->InsertEndChild(*grandchild);
  content_->children.push_back(std::move(added));
  return *content_->children.back();
}

void Element::RemoveChild(Element* child)
{
  auto& children = content_->children;
  const auto found =
      std::find_if(children.begin(), children.end(), [&](const auto& one) { return one->content_ == child->content_; });
  if (found == children.end()) throw Exception(Where() + "<" + child->Value() + "> is no child of <" + Value() + ">");
  (*found)->content_->parent = nullptr;
  for (auto behind = children.erase(found); behind != children.end(); ++behind) --(*behind)->content_->number;
}

void Element::Write(std::ostream& stream, int depth) const
{
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  stream << indent << "<" << Value();
  for (const Attribute& attribute : content_->attributes)
    stream << " " << attribute.Name() << "=\"" << Escaped(attribute.Value()) << "\"";
  if (content_->children.empty() && content_->text.empty())
  {
    stream << "/>";
    return;
  }
  stream << ">" << Escaped(content_->text);
  for (const auto& child : content_->children)
  {
    stream << "\n";
    child->Write(stream, depth + 1);
  }
  stream << (content_->children.empty() ? "" : "\n" + indent) << "</" << Value() << ">";
}

std::ostream& operator<<(std::ostream& stream, const Element& element)
{
  element.Write(stream, 0);
  return stream;
}

void Document::LoadFile(const std::string& file)
{
  SetValue(file);
  try
  {
    Parse(swarmanoid::ReadTextFile(file));
  }
  catch (const swarmanoid::ConfigurationError& mistake)
  {
    throw Exception(mistake.what());
  }
}

void Document::Parse(const std::string& text)
{
  while (!NoChildren()) RemoveChild(FirstChildElement());
  std::shared_ptr<const swarmanoid::ConfigurationNode> root;
  try
  {
    root = swarmanoid::ReadXml(text, Value());
  }
  catch (const swarmanoid::ConfigurationError& mistake)
  {
    std::vector<swarmanoid::Diagnostic> notes;
    root = swarmanoid::argos3::ReadTinyXml(text, Value(), notes);
    if (root == nullptr) throw Exception(mistake.what());
  }
  swarmanoid::argos3::CopyElement(*root, InsertEndChild(Element()));
}

void Document::SaveFile(const std::string& file) const
{
  std::ofstream stream(file);
  for (const Element* child = FirstChildElement(false); child != nullptr; child = child->NextSiblingElement(false))
    stream << *child << "\n";
  if (!stream.flush()) throw Exception("the file '" + file + "' cannot be written");
}

}  // namespace ticpp
