// Edits of XML text: each changes what it names and no other byte, and is taken back to the same bytes. Over random
// documents too.
#include "common/configuration/xml_edit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "common/configuration/xml_reader.h"

namespace swarmanoid
{
namespace
{

using Path = std::vector<std::size_t>;

template <class Edit>
std::string After(const std::string& text, const Path& path, Edit edit)
{
  const XmlElement root = OutlineOf(text);
  return WithEdits(text, edit(*ElementAt(root, path)));
}

std::string Set(const std::string& text, const Path& path, const std::string& name, const std::string& value)
{
  return After(text, path, [&](const XmlElement& e) { return SetValue(text, e, name, value); });
}

std::string Drop(const std::string& text, const Path& path, const std::string& name)
{
  return After(text, path, [&](const XmlElement& e) { return DropValue(text, e, name); });
}

std::string Append(const std::string& text, const Path& path, const std::string& child)
{
  return After(text, path, [&](const XmlElement& e) { return AppendChild(text, e, child); });
}

std::string Remove(const std::string& text, const Path& path)
{
  return After(text, path, [&](const XmlElement& e) { return RemoveElement(text, e); });
}

TEST(XmlEdit, SetsAValueWhereItStands)
{
  EXPECT_EQ(Set("<a  x = '1'\n y=\"2\"><!-- x --></a>", {}, "x", "3 < 4"),
            "<a  x = '3 &lt; 4'\n y=\"2\"><!-- x --></a>");
  EXPECT_EQ(Set("<a><x> 1 <!-- m -->\n</x></a>", {}, "x", "2"), "<a><x> 2 <!-- m -->\n</x></a>");
  EXPECT_EQ(Set("<a><x>1<!-- m -->2</x></a>", {}, "x", "3"), "<a><x>3<!-- m --></x></a>");
  EXPECT_EQ(Set("<a><x><![CDATA[1]]></x></a>", {}, "x", "a & b"), "<a><x>a &amp; b</x></a>");
  EXPECT_EQ(Set("<a><x/></a>", {}, "x", "3"), "<a><x>3</x></a>");
  EXPECT_EQ(Set("<a><x></x>/</a>", {}, "x", "3"), "<a><x>3</x>/</a>");
}

TEST(XmlEdit, AddsAValueInTheFormOfTheOthers)
{
  EXPECT_EQ(Set("<a/>", {}, "x", "'\"'"), "<a x=\"&apos;&quot;&apos;\"/>");
  EXPECT_EQ(Set("<a y='1' />", {}, "x", "2"), "<a y='1' x=\"2\" />");
  EXPECT_EQ(Set("<a>\n  <y>1</y> <!-- last -->\n</a>", {}, "x", "2"),
            "<a>\n  <y>1</y> <!-- last -->\n  <x>2</x>\n</a>");
  EXPECT_EQ(Set("<a>\r\n\t<y>1</y>\r\n</a>", {}, "x", "2"), "<a>\r\n\t<y>1</y>\r\n\t<x>2</x>\r\n</a>");
  // Children that hold more than a value are none.
  EXPECT_EQ(Set("<a>\n  <b z='1'/>\n</a>", {}, "x", "2"), "<a x=\"2\">\n  <b z='1'/>\n</a>");
}

TEST(XmlEdit, DropsAValue)
{
  EXPECT_EQ(Drop("<a x='1'\n   y='2'/>", {}, "y"), "<a x='1'/>");
  EXPECT_EQ(Drop("<a>\n  <x>1</x>\n  <y>2</y>\n</a>", {}, "x"), "<a>\n  <y>2</y>\n</a>");
  EXPECT_EQ(Drop("<a x='1'/>", {}, "y"), "<a x='1'/>");
}

TEST(XmlEdit, AppendsAndRemovesWholeLines)
{
  EXPECT_EQ(Append("<a>\n  <b/>\n</a>", {}, "<c/>"), "<a>\n  <b/>\n  <c/>\n</a>");
  EXPECT_EQ(Append("<a>\n    <b/>\n    <!-- b -->\n\n</a>", {}, "<c/>"),
            "<a>\n    <b/>\n    <!-- b -->\n    <c/>\n\n</a>");
  EXPECT_EQ(Append("<a><b/></a>", {}, "<c/>"), "<a><b/><c/></a>");
  EXPECT_EQ(Append("<r>\n  <a/>/\n</r>", {0}, "<c/>"), "<r>\n  <a>\n    <c/>\n  </a>/\n</r>");
  EXPECT_EQ(Append("<r>\n  <a></a>\n</r>", {0}, "<c/>"), "<r>\n  <a>\n    <c/>\n  </a>\n</r>");
  EXPECT_EQ(Append("\xef\xbb\xbf<a/>", {}, "<c/>"), "\xef\xbb\xbf<a>\n  <c/>\n</a>");

  EXPECT_EQ(Remove("<a>\n  <b>\n    <c/>\n  </b>\n  <d/>\n</a>", {0}), "<a>\n  <d/>\n</a>");
  EXPECT_EQ(Remove("<a>\n  <b/> <!-- b -->\n</a>", {0}), "<a>\n   <!-- b -->\n</a>");
  EXPECT_EQ(Remove("<a><b/><c/></a>", {0}), "<a><c/></a>");
}

TEST(XmlEdit, WritesNewElementsInEitherForm)
{
  NewElement robot{"footbot", {{"id", "fb"}, {"position", "1, 2, 0"}}, false};
  EXPECT_EQ(TextOf(robot, "  ", "\n"), R"(<footbot id="fb" position="1, 2, 0"/>)");
  robot.as_elements = true;
  EXPECT_EQ(TextOf(robot, "  ", "\n"), "<footbot id=\"fb\">\n    <position>1, 2, 0</position>\n  </footbot>");
}

TEST(XmlEdit, RefusesEditsThatOverlap)
{
  EXPECT_THROW(WithEdits("abc", {{{0, 2}, ""}, {{1, 3}, ""}}), std::logic_error);
  EXPECT_THROW(WithEdits("abc", {{{2, 4}, ""}}), std::logic_error);
}

TEST(XmlEdit, KeepsAHistory)
{
  EditedText text("<a/>");
  EXPECT_FALSE(text.Undo());
  const std::uint64_t first = text.Revision();
  text.Apply({{{2, 2}, " x='1'"}}, "set x");
  text.Apply({{{5, 6}, "\""}, {{7, 8}, "\""}}, "quote");
  EXPECT_EQ(text.Text(), "<a x=\"1\"/>");
  EXPECT_EQ(*text.UndoName(), "quote");
  EXPECT_TRUE(text.Undo());
  EXPECT_EQ(text.Text(), "<a x='1'/>");
  EXPECT_EQ(*text.RedoName(), "quote");
  EXPECT_TRUE(text.Redo());
  EXPECT_EQ(text.Text(), "<a x=\"1\"/>");
  EXPECT_TRUE(text.Undo());
  EXPECT_TRUE(text.Undo());
  EXPECT_EQ(text.Text(), "<a/>");
  EXPECT_GT(text.Revision(), first);
  // A change in the past is the end of what was taken back; one that changes nothing is none.
  text.Apply({{{2, 2}, ""}}, "nothing");
  EXPECT_NE(text.RedoName(), nullptr);
  text.Apply({{{2, 2}, " y='1'"}}, "set y");
  EXPECT_EQ(text.RedoName(), nullptr);
}

// ---- random documents ----

class RandomDocument
{
public:
  explicit RandomDocument(unsigned seed) : random_(seed) {}

  int Draw(int below) { return std::uniform_int_distribution<int>(0, below - 1)(random_); }
  const char* One(std::initializer_list<const char*> of) { return of.begin()[Draw(static_cast<int>(of.size()))]; }
  std::string Name() { return One({"a", "b", "size", "x_1", "long.name"}); }
  std::string Value()
  {
    return One(
        {"1", "1, 2, 3", "a < b", "\"q\"", "it's", "&amp", "ä€", "]]>", "x > y", "  inner  blanks", "<!-- no -->"});
  }
  std::string Blank() { return One({"", " ", "\n", "\n  ", "\r\n\t", "\n\n"}); }

  std::string Text()
  {
    return std::string(One({"", "\xef\xbb\xbf", "<?xml version='1.0'?>", "<!-- top -->\n"})) + Element(3) +
           One({"", "\n", "<!-- end -->"});
  }

private:
  std::string Element(int depth)
  {
    const std::string name = Name();
    std::string text = "<" + name;
    for (const char* attribute : {"id", "p", "q"})
      if (Draw(3) == 0)
      {
        const char* const quote = One({"'", "\""});
        text += std::string(One({" ", "\n   ", "  "})) + attribute + One({"=", " = "}) + quote +
                One({"1", "/>", "&lt;x"}) + quote;
      }
    text += One({"", " "});
    if (depth < 3 && Draw(4) == 0) return text + "/>";
    text += ">" + Blank();
    if (depth == 0 || (depth < 3 && Draw(3) == 0))
      text += One({"", "1", "1 <!-- m --> 2", "<!-- m -->", "<![CDATA[<x/>]]>", "&#65;"});
    else
      for (int i = Draw(6); i > 0; --i)
        text += (Draw(4) == 0 ? std::string(One({"<!-- <c> -->", "<?do this?>"})) : Element(depth - 1)) + Blank();
    return text + "</" + name + One({">", " >"});
  }

  std::mt19937 random_;
};

// Collects all paths, the root's first.
void Collect(const XmlElement& element, const Path& path, std::vector<Path>& paths)
{
  paths.push_back(path);
  for (std::size_t i = 0; i < element.children.size(); ++i)
  {
    Path next = path;
    next.push_back(i);
    Collect(element.children[i], next, paths);
  }
}

const ConfigurationNode& NodeAt(const ConfigurationNode& root, const Path& path)
{
  const ConfigurationNode* node = &root;
  for (const std::size_t i : path) node = node->children.at(i).get();
  return *node;
}

// Returns the whole text in the order of the file, without the content of the element at `but`.
std::string Rest(const ConfigurationNode& node, const ConfigurationNode* but)
{
  if (&node == but) return "|but|";
  std::string text = "<" + node.name;
  for (const auto& attribute : node.attributes) text += " " + attribute.name + "=" + attribute.value;
  text += ">" + node.text;
  for (const auto& child : node.children) text += Rest(*child, but);
  return text + "</>";
}

std::vector<std::string> CommentsOf(const std::string& text)
{
  std::vector<std::string> comments;
  for (std::size_t at = text.find("<!-- "); at != std::string::npos; at = text.find("<!-- ", at + 1))
    comments.push_back(text.substr(at, text.find("-->", at) - at));
  std::ranges::sort(comments);
  return comments;
}

// Whether a span is another one and blanks of its lines.
bool RestIsBlank(const std::string& text, const TextSpan& span, const TextSpan& inner)
{
  if (span.begin > inner.begin || span.end < inner.end) return false;
  const std::string rest =
      text.substr(span.begin, inner.begin - span.begin) + text.substr(inner.end, span.end - inner.end);
  return rest.find_first_not_of(" \t\r\n") == std::string::npos && std::ranges::count(rest, '\n') <= 1;
}

// Blanks at both ends are not part of a parameter's value, and other elements stay unchanged.
TEST(XmlEdit, ChangesNothingElseInRandomDocuments)
{
  int edits_made = 0, beside_comments = 0;
  for (unsigned seed = 0; seed < 400; ++seed)
  {
    RandomDocument random(seed);
    const std::string start = random.Text();
    EditedText document(start);
    std::vector<std::string> states{start};
    for (int step = 0; step < 6; ++step)
    {
      const std::string before = document.Text();
      SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(step) + ": " + before);
      const XmlElement root = OutlineOf(before);
      const auto tree = ReadXml(before, "f.xml");
      std::vector<Path> paths;
      Collect(root, {}, paths);
      const Path path = paths[static_cast<std::size_t>(random.Draw(static_cast<int>(paths.size())))];
      const XmlElement& element = *ElementAt(root, path);
      ASSERT_EQ(element.name, NodeAt(*tree, path).name);
      ASSERT_EQ(element.attributes.size(), NodeAt(*tree, path).attributes.size());

      const int what = random.Draw(4);
      const auto count = static_cast<int>(element.children.size());
      const std::string name = count > 0 && random.Draw(2) == 0
                                   ? element.children[static_cast<std::size_t>(random.Draw(count))].name
                                   : random.One({"p", "q", "new", "a"});
      const std::string value = random.Value();
      TextEdits edits;
      if (what == 0)
      {
        // A child of that name with elements in it is no value.
        const XmlElement* child = element.FindChild(name);
        if (element.FindAttribute(name) == nullptr && child != nullptr && !child->children.empty()) continue;
        edits = SetValue(before, element, name, value);
        beside_comments += element.FindAttribute(name) == nullptr && child != nullptr && !child->notes.empty();
      }
      else if (what == 1)
        edits = DropValue(before, element, name);
      else if (what == 2)
        edits = AppendChild(before, element,
                            TextOf({"added", {{"id", "n"}, {"v", value}}, random.Draw(2) == 0}, "  ", "\n"));
      else if (!path.empty())
        edits = RemoveElement(before, element);
      for (const TextEdit& edit : edits)
      {
        const bool within = edit.span.begin >= element.whole.begin && edit.span.end <= element.whole.end;
        EXPECT_TRUE(within || (what == 3 && RestIsBlank(before, edit.span, element.whole))) << edit.span.begin;
      }
      document.Apply(edits, "edit");
      if (document.Text() != before) states.push_back(document.Text());
      ++edits_made;

      // The bytes outside the edits are equal by construction. Their meaning must be equal, too.
      const auto after = ReadXml(document.Text(), "f.xml");
      if (what == 3 && !path.empty())
      {
        Path above = path;
        above.pop_back();
        EXPECT_EQ(NodeAt(*after, above).children.size() + 1, NodeAt(*tree, above).children.size());
        EXPECT_EQ(Rest(*after, &NodeAt(*after, above)), Rest(*tree, &NodeAt(*tree, above)));
        continue;
      }
      const ConfigurationNode& now = NodeAt(*after, path);
      EXPECT_EQ(Rest(*after, &now), Rest(*tree, &NodeAt(*tree, path)));
      const TConfigurationTree read(std::make_shared<const ConfigurationNode>(now));
      if (what == 0)
      {
        EXPECT_EQ(TrimBlanks(read.Value(name).value_or("none")), TrimBlanks(value));
        EXPECT_EQ(CommentsOf(document.Text()).size(), CommentsOf(before).size());
      }
      if (what == 2)
      {
        ASSERT_EQ(now.children.size(), element.children.size() + 1);
        EXPECT_EQ(now.children.back()->name, "added");
        EXPECT_EQ(TrimBlanks(*TConfigurationTree(now.children.back()).Value("v")), TrimBlanks(value));
      }
    }
    for (std::size_t i = states.size(); i-- > 0;)
    {
      EXPECT_EQ(document.Text(), states[i]);
      EXPECT_EQ(document.Undo(), i > 0);
    }
    EXPECT_EQ(document.Text(), start);
    for (std::size_t i = 1; i < states.size(); ++i)
    {
      EXPECT_TRUE(document.Redo());
      EXPECT_EQ(document.Text(), states[i]);
    }
  }
  EXPECT_GT(edits_made, 1500);
  EXPECT_GT(beside_comments, 5);
}

}  // namespace
}  // namespace swarmanoid
