#include "launcher/editor/edited_experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"
#include "common/experiment/foreign_experiments.h"
#include "common/experiment/schema.h"
#include "common/experiment/source_places.h"
#include "common/math/elementary.h"
#include "launcher/editor/new_element.h"

namespace swarmanoid
{
namespace
{

constexpr double kLeastTurn = 0.05;  // degrees

std::string NameOfElement(const ConfigurationNode& node)
{
  const auto id = TreeOf(node).Value("id");
  return id && !id->empty() ? *id : "<" + node.name + ">";
}

// Returns the vector in a value of an element, or `otherwise` if the value is none.
Vector3 VectorIn(const ConfigurationNode& node, const char* name, const Vector3& otherwise)
{
  const auto text = TreeOf(node).Value(name);
  const auto numbers = text ? ParseNumbers(*text) : std::nullopt;
  return numbers && numbers->size() == 3 ? Vector3((*numbers)[0], (*numbers)[1], (*numbers)[2]) : otherwise;
}

void Append(TextEdits& edits, TextEdits more)
{
  for (TextEdit& edit : more) edits.push_back(std::move(edit));
}

void Sort(TextEdits& edits)
{
  std::ranges::stable_sort(edits, [](const TextEdit& a, const TextEdit& b) { return a.span.begin < b.span.begin; });
}

}  // namespace

void RefuseEdit(const std::string& text) { throw std::invalid_argument(text); }

TConfigurationTree TreeOf(const ConfigurationNode& node)
{
  const std::shared_ptr<const ConfigurationNode> none;
  return TConfigurationTree({none, &node});
}

std::string PathText(const ElementPath& path) { return fmt::format("{}", fmt::join(path, "/")); }

ElementPath ParsePath(const std::string& text)
{
  ElementPath path;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end)
  {
    std::size_t child = 0;
    const auto [next, error] = std::from_chars(at, end, child);
    if (error != std::errc() || (next < end && *next != '/')) RefuseEdit(Quoted(text) + " is no path of an element");
    path.push_back(child);
    at = next < end ? next + 1 : next;
  }
  return path;
}

EditedExperiment::EditedExperiment(const std::string& text, std::string file_name, std::string folder)
    : file_name_(std::move(file_name)),
      folder_(std::move(folder)),
      text_(text),
      known_controllers_(KnownControllers(folder_))
{
  Take(Read(text));
}

EditedExperiment::Reading EditedExperiment::Read(const std::string& text) const
{
  Reading reading;
  reading.tree = ReadXml(text, file_name_);
  if (FindExperimentConverter(reading.tree->name) != nullptr)
    throw ConfigurationError(reading.tree->location,
                             "the experiment is of another simulator; `swarmanoid convert` writes it as one of ours");
  reading.outline = OutlineOf(text, file_name_);
  LoadOptions options;
  options.even_if_wrong = true;
  // Places in the text would name the lines of another file.
  reading.loaded = LoadExperimentText(std::string(WithoutPlaces(text)), file_name_, folder_, options);
  return reading;
}

void EditedExperiment::Take(Reading reading)
{
  tree_ = std::move(reading.tree);
  outline_ = std::move(reading.outline);
  loaded_ = std::move(reading.loaded);

  const std::string& text = text_.Text();
  lines_.assign(1, text.starts_with("\xef\xbb\xbf") ? 3 : 0);
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') lines_.push_back(i + 1);
  entity_paths_.clear();
  if (!loaded_.experiment) return;
  const ConfigurationNode* last = nullptr;
  for (const EntityConfiguration& entity : loaded_.experiment->entities)
  {
    if (last != entity.tree.Node() || last == nullptr)
      entity_paths_.push_back(PathAt(entity.location));
    else
      entity_paths_.push_back(entity_paths_.back());
    last = entity.tree.Node();
  }
}

// ---- what is where ----

const XmlElement& EditedExperiment::At(const ElementPath& path) const
{
  const XmlElement* element = ElementAt(outline_, path);
  if (element == nullptr) RefuseEdit("that element is not there any more");
  return *element;
}

const ConfigurationNode& EditedExperiment::NodeAt(const ElementPath& path) const
{
  At(path);
  const ConfigurationNode* node = tree_.get();
  for (const std::size_t child : path) node = node->children[child].get();
  return *node;
}

ElementForm EditedExperiment::FormAt(const ElementPath& path) const
{
  At(path);
  std::vector<const ConfigurationNode*> nodes{tree_.get()};
  for (const std::size_t child : path) nodes.push_back(nodes.back()->children[child].get());
  ElementForm form = FormOf(nodes);
  for (const KnownController& known : known_controllers_)
  {
    if (KnownFor(path, known.tag) == nullptr) continue;
    const auto found = std::ranges::find(form.children, known.tag, &ElementForm::Child::tag);
    if (found == form.children.end())
      form.children.push_back({known.tag, "Library " + known.library + ", with devices as in " + known.file + ".", {}});
  }
  return form;
}

const KnownController* EditedExperiment::KnownFor(const ElementPath& parent, const std::string& tag) const
{
  if (parent.size() != 1 || At(parent).name != "controllers") return nullptr;
  const auto found = std::ranges::find(known_controllers_, tag, &KnownController::tag);
  return found == known_controllers_.end() ? nullptr : &*found;
}

std::string EditedExperiment::NameOf(const ElementPath& path) const { return NameOfElement(NodeAt(path)); }

std::size_t EditedExperiment::OffsetOf(const SourceLocation& place) const
{
  const std::string& text = text_.Text();
  const auto line = static_cast<std::size_t>(std::max(place.line, 1));
  if (line > lines_.size()) return text.size();
  std::size_t offset = lines_[line - 1];
  for (int column = 1; column < place.column && offset < text.size(); ++column) do
      ++offset;
    while (offset < text.size() && (static_cast<unsigned char>(text[offset]) & 0xC0U) == 0x80U);
  return offset;
}

ElementPath EditedExperiment::PathAt(const SourceLocation& place) const
{
  const std::size_t offset = OffsetOf(place);
  ElementPath path;
  for (const XmlElement* element = &outline_;;)
  {
    // The first child that ends after the offset contains it if it also begins before it.
    const auto child =
        std::ranges::upper_bound(element->children, offset, {}, [](const XmlElement& each) { return each.whole.end; });
    if (child == element->children.end() || child->whole.begin > offset) return path;
    path.push_back(static_cast<std::size_t>(child - element->children.begin()));
    element = &*child;
  }
}

bool EditedExperiment::IsDistributed(const ElementPath& path) const
{
  if (path.size() < 2) return false;
  const ElementPath above(path.begin(), path.end() - 1);
  const std::string& name = At(above).name;
  return (name == "distribute" || name == "reserve") && KindOfTag(At(path).name).has_value();
}

// ---- changes ----

void EditedExperiment::Change(const TextEdits& edits, const std::string& name)
{
  std::string changed;
  Reading reading;
  try
  {
    changed = WithEdits(text_.Text(), edits);
    reading = Read(changed);
  }
  catch (const std::logic_error&)
  {
    RefuseEdit("these changes do not fit together");
  }
  catch (const ConfigurationError& error)
  {
    RefuseEdit(std::string("nothing is changed: ") + error.what());
  }
  text_.Apply(edits, name);
  Take(std::move(reading));
}

void EditedExperiment::SetValue(const ElementPath& path, const std::string& name,
                                const std::optional<std::string>& value)
{
  const std::string of = fmt::format("{} of {}", name, NameOf(path));
  const XmlElement& element = At(path);
  const ElementForm form = FormAt(path);
  if (form.known && std::ranges::none_of(form.parameters, [&](const auto& spec) { return Matches(spec, name); }))
    RefuseEdit(fmt::format("{} has no parameter {}", NameOf(path), Quoted(name)));
  if (const XmlElement* child = element.FindChild(name); child != nullptr && !child->children.empty())
    RefuseEdit(fmt::format("<{}> holds elements, not a value", name));
  Change(value ? swarmanoid::SetValue(Text(), element, name, *value) : DropValue(Text(), element, name),
         (value ? "set " : "drop ") + of);
}

void EditedExperiment::Place(const std::vector<Placing>& placings)
{
  TextEdits edits;
  for (const auto& [path, position, heading] : placings)
  {
    if (IsDistributed(path))
      RefuseEdit(fmt::format("{} is placed by the <{}> in line {}; change that, or write its entities out one by one",
                             NameOf(path), At({path.begin(), path.end() - 1}).name, NodeAt(path).location.line));
    if (!KindOfTag(At(path).name)) RefuseEdit(NameOf(path) + " has no place");
    const ConfigurationNode& node = NodeAt(path);
    if (position)
      Append(edits, swarmanoid::SetValue(Text(), At(path), "position",
                                         fmt::format("{}, {}, {}", NumberText(position->x()), NumberText(position->y()),
                                                     NumberText(position->z()))));
    if (!heading) continue;
    Vector3 angles = VectorIn(node, "orientation", Vector3::Zero());
    if (std::abs(std::remainder(angles.z() - *heading, 360.0)) < kLeastTurn) continue;
    angles.z() = *heading;
    Append(edits, swarmanoid::SetValue(Text(), At(path), "orientation",
                                       fmt::format("{}, {}, {}", NumberText(angles.x()), NumberText(angles.y()),
                                                   NumberText(angles.z()))));
  }
  if (placings.empty()) return;
  Sort(edits);
  Change(edits, placings.size() == 1 ? "place " + NameOf(placings.front().path)
                                     : fmt::format("place {} entities", placings.size()));
}

ElementPath EditedExperiment::Add(const ElementPath& parent, const std::string& tag, const std::optional<Vector2>& at)
{
  const ElementForm form = FormAt(parent);
  // Kinds have aliases: <nest> is a patch of the ground.
  const auto kind = KindOfTag(tag);
  const auto child =
      std::ranges::find(form.children, kind ? std::string(TagName(*kind)) : tag, &ElementForm::Child::tag);
  if (child == form.children.end() || !child->may_be_added)
    RefuseEdit(fmt::format("{} takes no{} <{}>", NameOf(parent), child == form.children.end() ? "" : " further", tag));
  const XmlElement& above = At(parent);
  if (const KnownController* known = KnownFor(parent, tag))
  {
    const std::string id = ValuesForNew(tag, {{.name = "id"}}, *this, parent, at).front().second;
    Change(AppendChild(Text(), above,
                       WithEdits(known->xml, swarmanoid::SetValue(known->xml, OutlineOf(known->xml), "id", id))),
           "add " + id);
    ElementPath path = parent;
    path.push_back(At(parent).children.size() - 1);
    return path;
  }
  NewElement element{tag, ValuesForNew(tag, child->required, *this, parent, at), false};
  // The new element is written in the form of its siblings.
  for (const XmlElement& other : above.children) element.as_elements |= HasValuesAsElements(other);
  const InsertionPlace place = PlaceForChild(Text(), above);
  const bool has_id = !element.values.empty() && element.values.front().first == "id";
  Change(AppendChild(Text(), above, TextOf(element, place.indent, place.line_end)),
         "add " + (has_id ? element.values.front().second : "<" + tag + ">"));
  ElementPath path = parent;
  path.push_back(At(parent).children.size() - 1);
  return path;
}

void EditedExperiment::Remove(const std::vector<ElementPath>& paths)
{
  TextEdits edits;
  for (const ElementPath& path : paths)
  {
    if (path.empty() || FormAt(path).required) RefuseEdit(NameOf(path) + " cannot be removed");
    if (IsDistributed(path))
      RefuseEdit(fmt::format("{} is one of many; remove the <{}> in line {}, or write its entities out one by one",
                             NameOf(path), At({path.begin(), path.end() - 1}).name, NodeAt(path).location.line));
    Append(edits, RemoveElement(Text(), At(path)));
  }
  if (paths.empty()) return;
  Sort(edits);
  Change(edits,
         paths.size() == 1 ? "remove " + NameOf(paths.front()) : fmt::format("remove {} elements", paths.size()));
}

void EditedExperiment::Rewrite(const ElementPath& path, const std::string& xml)
{
  const std::string wanted(TrimBlanks(xml));
  try
  {
    // The text must be exactly one element. Otherwise it could close an element around it.
    const XmlElement element = OutlineOf(wanted, "the new text");
    if (element.whole.begin != 0 || element.whole.end != wanted.size() ||
        (path.empty() && element.name != outline_.name))
      RefuseEdit(fmt::format("the new text must be one element{}", path.empty() ? ", <" + outline_.name + ">" : ""));
  }
  catch (const ConfigurationError& error)
  {
    RefuseEdit(error.what());
  }
  Change({{At(path).whole, wanted}}, "rewrite " + NameOf(path));
}

void EditedExperiment::WriteOut(const ElementPath& path)
{
  const XmlElement& distribution = At(path);
  if (distribution.name != "distribute" || !loaded_.errors.empty())
    RefuseEdit(loaded_.errors.empty() ? "only the entities of a <distribute> can be written out"
                                      : "the experiment has mistakes: the places are not known");
  Change({{distribution.whole, EntitiesOneByOne(*this, path)}}, "write out " + NameOf(path));
}

void EditedExperiment::Replace(const std::string& text) { Change({{{0, Text().size()}, text}}, "read the file again"); }

bool EditedExperiment::Undo()
{
  const bool done = text_.Undo();
  if (done) Take(Read(text_.Text()));
  return done;
}

bool EditedExperiment::Redo()
{
  const bool done = text_.Redo();
  if (done) Take(Read(text_.Text()));
  return done;
}

}  // namespace swarmanoid
