// Elements of an experiment file for ARGoS3's controllers and loop functions, with the interface of its library ticpp.
#pragma once

#include <argos3/core/utility/datatypes/datatypes.h>

#include <exception>
#include <memory>
#include <type_traits>

namespace ticpp
{

class Exception : public std::exception
{
public:
  explicit Exception(std::string message) : text_(std::move(message)) {}
  const char* what() const noexcept override { return text_.c_str(); }

private:
  std::string text_;
};

// Throws Exception if the text is not of the type.
template <class T>
void ReadText(const std::string& text, T& value)
{
  std::istringstream stream(text);
  stream >> value;
  if (stream.fail()) throw Exception("'" + text + "' is not of the type that is asked for");
}
inline void ReadText(const std::string& text, std::string& value) { value = text; }

class Attribute
{
public:
  Attribute() = default;
  Attribute(std::string name, std::string value) : name_(std::move(name)), value_(std::move(value)) {}
  const std::string& Name() const { return name_; }
  const std::string& Value() const { return value_; }
  void GetName(std::string* name) const { *name = name_; }
  template <class T>
  void GetValue(T* value) const
  {
    ReadText(value_, *value);
  }
  void SetValue(std::string value) { value_ = std::move(value); }

private:
  std::string name_;
  std::string value_;
};

// A handle to an element. Copies share the element, as in ARGoS3: a change through one of them is seen by all.
class Element
{
public:
  Element() : content_(std::make_shared<Content>()) {}
  explicit Element(const std::string& name) : Element() { content_->name = name; }

  const std::string& Value() const { return content_->name; }
  void GetValue(std::string* name) const { *name = Value(); }
  void SetValue(const std::string& name) { content_->name = name; }
  // Returns "file:line:column"; empty for an element made by code.
  const std::string& Place() const { return content_->place; }
  void SetPlace(std::string place) { content_->place = std::move(place); }

  bool HasAttribute(const std::string& name) const { return Find(name) != nullptr; }
  // Returns an empty text if the attribute does not exist.
  std::string GetAttribute(const std::string& name) const;
  // Leaves the value unchanged if the attribute does not exist and is not required. Throws Exception with the position.
  template <class T>
  void GetAttribute(const std::string& name, T* value, bool required = true) const
  {
    if (const Attribute* attribute = Find(name)) return Read(*attribute, *value);
    if (required) throw Exception(Where() + "<" + Value() + "> has no attribute '" + name + "'");
  }
  template <class T, class Default>
  void GetAttributeOrDefault(const std::string& name, T* value, const Default& fallback) const
  {
    if (const Attribute* attribute = Find(name)) return Read(*attribute, *value);
    *value = fallback;
  }
  template <class T>
  void SetAttribute(const std::string& name, const T& value)
  {
    std::ostringstream text;
    text << std::boolalpha << value;
    Set(name, text.str());
  }
  void RemoveAttribute(const std::string& name);

  std::string GetText() const { return content_->text; }
  template <class T>
  void GetText(T* value) const
  {
    if (content_->text.empty()) throw Exception(Where() + "<" + Value() + "> has no text");
    ReadText(content_->text, *value);
  }
  template <class T, class Default>
  void GetTextOrDefault(T* value, const Default& fallback) const
  {
    if (content_->text.empty())
      *value = fallback;
    else
      ReadText(content_->text, *value);
  }
  void SetText(const std::string& text) { content_->text = text; }

  // Return the first or next element of that name, or of any if the name is empty. They return nullptr if none exists
  // and it is not required; otherwise they throw Exception.
  Element* FirstChildElement(const std::string& name = "", bool required = true) const;
  Element* FirstChildElement(const char* name, bool required = true) const
  {
    return FirstChildElement(std::string(name), required);
  }
  Element* FirstChildElement(bool required) const { return FirstChildElement(std::string(), required); }
  Element* NextSiblingElement(const std::string& name = "", bool required = true) const;
  Element* NextSiblingElement(const char* name, bool required = true) const
  {
    return NextSiblingElement(std::string(name), required);
  }
  Element* NextSiblingElement(bool required) const { return NextSiblingElement(std::string(), required); }
  // Do the same, since all children are elements here.
  Element* FirstChild(const std::string& name = "", bool required = true) const
  {
    return FirstChildElement(name, required);
  }
  Element* FirstChild(const char* name, bool required = true) const { return FirstChildElement(name, required); }
  Element* FirstChild(bool required) const { return FirstChildElement(required); }
  Element* NextSibling(const std::string& name = "", bool required = true) const
  {
    return NextSiblingElement(name, required);
  }
  Element* NextSibling(const char* name, bool required = true) const { return NextSiblingElement(name, required); }
  Element* NextSibling(bool required) const { return NextSiblingElement(required); }
  Element* ToElement() { return this; }
  // Adds a copy of the element with all that it holds.
  Element& InsertEndChild(const Element& child);
  // Removes a child. Throws Exception for an element that is none.
  void RemoveChild(Element* child);
  bool NoChildren() const { return content_->children.empty(); }

  const std::vector<Attribute>& Attributes() const { return content_->attributes; }

  // Writes the element as XML.
  friend std::ostream& operator<<(std::ostream& stream, const Element& element);

private:
  struct Content
  {
    std::string name, text, place;
    std::vector<Attribute> attributes;
    std::vector<std::unique_ptr<Element>> children;
    Content* parent = nullptr;
    std::size_t number = 0;  // index among the children of the parent

    Content() = default;
    Content(const Content&) = delete;
    Content& operator=(const Content&) = delete;
    ~Content()
    {
      for (const auto& child : children) child->content_->parent = nullptr;
    }
  };

  const Attribute* Find(const std::string& name) const;
  void Set(const std::string& name, const std::string& value);
  void Write(std::ostream& stream, int depth) const;
  std::string Where() const { return Place().empty() ? std::string() : Place() + ": "; }
  template <class T>
  void Read(const Attribute& attribute, T& value) const
  {
    try
    {
      ReadText(attribute.Value(), value);
    }
    catch (const std::exception& mistake)
    {
      throw Exception(Where() + "'" + attribute.Name() + "' of <" + Value() + ">: " + mistake.what());
    }
  }

  std::shared_ptr<Content> content_;
};

// A file in memory. A program may change it, save it, and run it by CSimulator::Load. Errors are Exceptions.
class Document : public Element
{
public:
  Document() = default;
  Document(const std::string& file) : Element(file) {}
  Document(const char* file) : Element(file) {}

  void LoadFile() { LoadFile(Value()); }
  void LoadFile(const std::string& file);
  void Parse(const std::string& text);
  void SaveFile() const { SaveFile(Value()); }
  void SaveFile(const std::string& file) const;
};

// Iterates over all children, or over those of one name: for (it = it.begin(&node); it != it.end(); ++it).
template <class T>
class Iterator
{
public:
  Iterator() = default;
  explicit Iterator(std::string name) : name_(std::move(name)) {}

  Iterator begin(T* parent) const
  {
    Iterator first(name_);
    first.current_ = parent->FirstChildElement(name_, false);
    return first;
  }
  Iterator begin(const T* parent) const { return begin(const_cast<T*>(parent)); }
  Iterator end() const { return Iterator(name_); }
  T* Get() const { return current_; }
  T& operator*() const { return *current_; }
  T* operator->() const { return current_; }
  Iterator& operator++()
  {
    current_ = current_->NextSiblingElement(name_, false);
    return *this;
  }
  Iterator operator++(int)
  {
    Iterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const Iterator& other) const { return current_ == other.current_; }
  bool operator!=(const Iterator& other) const { return current_ != other.current_; }
  bool operator==(const T* element) const { return current_ == element; }
  bool operator!=(const T* element) const { return current_ != element; }

private:
  std::string name_;
  T* current_ = nullptr;
};

// Iterates over the attributes of an element.
template <>
class Iterator<Attribute>
{
public:
  Iterator begin(const Element* element) const
  {
    Iterator first;
    first.current_ = element->Attributes().data();
    first.end_ = first.current_ + element->Attributes().size();
    return first.current_ == first.end_ ? Iterator() : first;
  }
  Iterator end() const { return {}; }
  const Attribute* Get() const { return current_; }
  const Attribute& operator*() const { return *current_; }
  const Attribute* operator->() const { return current_; }
  Iterator& operator++()
  {
    if (++current_ == end_) *this = Iterator();
    return *this;
  }
  bool operator==(const Iterator& other) const { return current_ == other.current_; }
  bool operator!=(const Iterator& other) const { return current_ != other.current_; }

private:
  const Attribute* current_ = nullptr;
  const Attribute* end_ = nullptr;
};

}  // namespace ticpp
