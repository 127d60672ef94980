#include "document_reader.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "spectra.h"
#include "transforms.h"
#include "upgrade.h"
#include "values.h"

namespace pharos::mitsuba {
namespace {

constexpr std::size_t kDeepest = 64;

template <std::size_t n>
void append(std::vector<std::string>& to, const std::array<std::string_view, n>& tags) {
  to.insert(to.end(), tags.begin(), tags.end());
}

/// Returns why a tag cannot be inside an object.
std::string misplaced(std::string_view tag) {
  if (tag == "scene") return "<scene> can be the outermost tag only";
  if (is_among(tag, kTransformTags))
    return fmt::format("<{}> can stand in a <transform> only", tag);
  std::vector<std::string> known;
  append(known, kObjectTags);
  append(known, kValueTags);
  append(known, kOtherTags);
  return fmt::format("unknown tag <{}>{}", one_line(tag, 60), suggestion(tag, known));
}

bool is_object(const Element& element) {
  return is_among(element.tag(), kObjectTags) ||
         (element.tag() == "spectrum" && element.has("type"));
}

std::string_view present_tag(std::string_view written) {
  if (written == "luminaire") return "emitter";
  if (written == "camera") return "sensor";
  return written == "spectrum" ? "texture" : written;
}

/// Returns the name of a property; empty if there is none.
std::string property_name(const Element& element, Dialect dialect) {
  const std::string& name = element.text("name");
  return dialect == Dialect::mitsuba_0 ? snake_case(name) : name;
}

Dialect read_version(const Element& root) {
  try {
    return dialect_of(root.text("version"));
  } catch (const InputError& e) {
    root.fail("version", e.what());
  }
}

}  // namespace

DocumentReader::DocumentReader(const std::filesystem::path& file,
                               const std::map<std::string, std::string>& parameters)
    : path_(file), variables_(parameters), folders_(file.parent_path()) {}

Document DocumentReader::read() {
  const Location whole{path_.string()};
  if (const std::string problem = file_problem(path_); !problem.empty()) {
    throw InputError(whole, problem);
  }
  const XmlFile file(path_, budget_);
  open_files_.push_back(std::filesystem::canonical(path_));
  const Element root(file, file.root(), variables_);
  if (root.tag() != "scene") {
    root.fail(fmt::format("expected <scene version=\"…\">, found <{}>", one_line(root.tag(), 60)));
  }
  root.expect({"version"}, {"id", "name", "type"});
  Parent scene{std::make_shared<Object>(Object{"scene", "", root.text("id"), root.where(), {}})};
  const Dialect dialect = read_version(root);
  read_children(file, file.root(), scene, {dialect, 1});
  references_.resolve(*scene.object);
  try {
    variables_.check_use();
  } catch (const InputError& e) {
    throw InputError(whole, e.what());
  }
  return {scene.object, folders_.outermost(), folders_.resources(), dialect, notes_};
}

void DocumentReader::read_children(const XmlFile& file, pugi::xml_node node, Parent& parent,
                                   Context context) {
  ++context.depth;
  for (const pugi::xml_node child : file.elements_in(node)) {
    if (context.depth > kDeepest) {
      throw InputError(file.where(child), "tags and includes are nested more than 64 deep");
    }
    if (is_among(child.name(), kForeignTags)) {
      note(file.where(child), fmt::format("<{}> is no tag of Mitsuba: left out", child.name()));
      continue;
    }
    read_element(Element(file, child, variables_), parent, context);
  }
}

void DocumentReader::read_element(const Element& element, Parent& parent, Context context) {
  const std::string_view tag = element.tag();
  if (is_object(element)) {
    element.expect({"type"}, {"id", "name"});
    return read_object(element, parent, context);
  }
  if (is_among(tag, kValueTags)) return read_value(element, parent, context);
  if (!is_among(tag, kOtherTags)) element.fail(misplaced(tag));
  element.expect_empty();
  if (tag == "ref") return read_reference(element, parent, context);
  if (tag == "include") return read_include(element, parent, context);
  if (tag == "default") return read_default(element);
  if (tag == "path") return folders_.add(element);
  element.expect({"id", "as"});
  references_.define_alias(element.text("as"), element.text("id"), element.where());
}

void DocumentReader::read_object(const Element& element, Parent& parent, Context context) {
  const std::string& type = element.text("type");
  if (type.empty()) element.fail("type", "expected the name of a plugin, found nothing");
  Parent object{std::make_shared<Object>()};
  object.object->tag = present_tag(element.tag());
  object.object->type = context.dialect == Dialect::mitsuba_0 ? lower_case(type) : type;
  object.object->id = element.text("id");
  object.object->where = element.where();
  const std::string& id = object.object->id;
  if (!id.empty()) references_.define(id, object.object, element.where());
  read_children(element.file(), element.node(), object, context);
  upgrade(*object.object, element.tag());
  parent.object->properties.push_back({property_name(element, context.dialect), element.where(),
                                       std::shared_ptr<const Object>(std::move(object.object))});
}

void DocumentReader::read_value(const Element& element, Parent& parent, Context context) {
  const std::string_view tag = element.tag();
  if (tag != "transform" && tag != "animation") element.expect_empty();
  Property::Value value = value_of(element, *parent.object, context.dialect);
  std::string name = property_name(element, context.dialect);
  if (name.empty()) element.fail("name", "expected a name, found nothing");
  Property property{std::move(name), element.where(), std::move(value)};
  std::vector<Property>& all = parent.object->properties;
  const auto [place, is_new] = parent.values.try_emplace(property.name, all.size());
  if (is_new) {
    all.push_back(std::move(property));
    return;
  }
  note(property.where, fmt::format("<{}> has two properties '{}': the last one counts",
                                   parent.object->tag, one_line(property.name, 60)));
  all[place->second] = std::move(property);
}

Property::Value DocumentReader::value_of(const Element& element, const Object& parent,
                                         Dialect dialect) {
  const std::string_view tag = element.tag();
  if (tag == "rgb" || tag == "srgb" || tag == "spectrum" || tag == "blackbody") {
    return read_spectrum(element, parent.tag == "emitter", folders_, budget_);
  }
  if (tag == "point" || tag == "vector") {
    element.expect({"name"}, {"x", "y", "z", "value"});
    return Triple{read_coordinates(element)};
  }
  if (tag == "transform") {
    element.expect({"name"});
    return read_transform(element, variables_, dialect);
  }
  if (tag == "animation") {
    element.expect({"name"});
    note(element.where(),
         "<animation> is not animated: the transform of its earliest time is used");
    return read_animation(element, variables_, dialect);
  }
  element.expect({"name", "value"});
  if (tag == "boolean") return read_boolean(element, "value");
  if (tag == "integer") return read_integer(element, "value");
  if (tag == "float") return read_number(element, "value");
  return element.text("value");
}

void DocumentReader::read_reference(const Element& element, Parent& parent, Context context) {
  element.expect({"id"}, {"name"});
  Object& object = *parent.object;
  references_.refer(object, object.properties.size(), element.text("id"), element.where());
  object.properties.push_back(
      {property_name(element, context.dialect), element.where(), std::shared_ptr<const Object>()});
}

void DocumentReader::read_default(const Element& element) {
  element.expect({"name", "value"});
  try {
    variables_.give_default(element.text("name"), element.text("value"));
  } catch (const InputError& e) {
    element.fail("name", e.what());
  }
}

void DocumentReader::read_include(const Element& element, Parent& parent, Context context) {
  element.expect({"filename"}, {"name"});
  const std::filesystem::path path = folders_.file(element, "filename");
  const std::filesystem::path canonical = std::filesystem::canonical(path);
  if (std::find(open_files_.begin(), open_files_.end(), canonical) != open_files_.end()) {
    element.fail("filename",
                 fmt::format("'{}' includes itself", one_line(element.text("filename"), 200)));
  }
  open_files_.push_back(canonical);
  read_included(element, XmlFile(path, budget_), parent, context);
  open_files_.pop_back();
}

/// Reads the children of an included scene, or a single object. Without a version the file has the
/// dialect of the file that includes it.
void DocumentReader::read_included(const Element& include, const XmlFile& file, Parent& parent,
                                   Context context) {
  const Element root(file, file.root(), variables_);
  if (root.has("version")) context.dialect = read_version(root);
  if (root.tag() == "scene") {
    root.expect({}, {"version", "id", "name", "type"});
    return read_children(file, file.root(), parent, context);
  }
  if (!is_object(root)) {
    root.fail(fmt::format("expected a scene or an object in an included file, found <{}>",
                          one_line(root.tag(), 60)));
  }
  root.expect({"type"}, {"id", "name", "version"});
  read_object(root, parent, {context.dialect, context.depth + 1});
  if (include.has("name")) {
    parent.object->properties.back().name = property_name(include, context.dialect);
  }
}

void DocumentReader::note(const Location& where, const std::string& message) {
  const auto same = std::find_if(notes_.begin(), notes_.end(),
                                 [&](const ImportNote& n) { return n.message == message; });
  if (same == notes_.end()) {
    notes_.push_back({where, message});
  } else {
    ++same->times;
  }
}

}  // namespace pharos::mitsuba
