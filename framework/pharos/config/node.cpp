#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include <pharos/config/node.h>

namespace pharos {
namespace {

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

/// Returns true for texts that YAML certainly reads back as the same scalar without quotes.
bool is_plain(std::string_view text) {
  constexpr std::array<std::string_view, 4> special{"", "null", "Null", "NULL"};
  if (std::find(special.begin(), special.end(), text) != special.end()) return false;
  const std::size_t sign = text[0] == '-' || text[0] == '+' ? 1 : 0;
  const char first = sign < text.size() ? text[sign] : ' ';
  const bool begins_plain =
      is_letter_or_digit(first) || first == '.' || first == '_' || (sign == 0 && first == '/');
  if (!begins_plain || text.back() == ' ' || text.substr(0, 3) == "...") return false;
  return std::all_of(text.begin(), text.end(), [](char c) {
    return is_letter_or_digit(c) || std::string_view(" _./+-").find(c) != std::string_view::npos;
  });
}

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (c == '\n') {
      out += "\\n";
    } else if (byte < 0x20 || byte == 0x7f) {
      out += fmt::format("\\x{:02x}", byte);
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string scalar_yaml(std::string_view text) {
  return is_plain(text) ? std::string(text) : quoted(text);
}

bool fits_one_line(const ConfigNode& node) {
  if (node.is_mapping()) return node.entries().empty();
  return std::all_of(node.items().begin(), node.items().end(),
                     [](const ConfigNode& item) { return item.is_null() || item.is_scalar(); });
}

void write_block(const ConfigNode& node, std::size_t indent, std::string& out);

/// Writes one `key:` or `- ` with the node that follows it.
void write_block_item(const ConfigNode& item, std::size_t indent, std::string& out) {
  if (fits_one_line(item)) {
    out += std::string(indent, ' ') + "- " + to_flow_yaml(item) + '\n';
  } else {
    const std::size_t start = out.size();
    write_block(item, indent + 2, out);
    out[start + indent] = '-';
  }
}
void write_block_entry(const ConfigNode::Entry& entry, std::size_t indent, std::string& out) {
  out += std::string(indent, ' ') + scalar_yaml(entry.key) + ':';
  if (fits_one_line(entry.value)) {
    out += ' ' + to_flow_yaml(entry.value) + '\n';
  } else {
    out += '\n';
    write_block(entry.value, indent + 2, out);
  }
}
void write_block(const ConfigNode& node, std::size_t indent, std::string& out) {
  for (const ConfigNode& item : node.items()) write_block_item(item, indent, out);
  for (const ConfigNode::Entry& entry : node.entries()) write_block_entry(entry, indent, out);
}

void write_flow(const ConfigNode& node, std::string& out) {
  const char* separator = "";
  switch (node.kind()) {
    case ConfigNode::Kind::null:
      out += "null";
      return;
    case ConfigNode::Kind::scalar:
      out += scalar_yaml(node.text());
      return;
    case ConfigNode::Kind::sequence:
      out += '[';
      for (const ConfigNode& item : node.items()) {
        out += std::exchange(separator, ", ");
        write_flow(item, out);
      }
      out += ']';
      return;
    case ConfigNode::Kind::mapping:
      out += '{';
      for (const ConfigNode::Entry& entry : node.entries()) {
        out += fmt::format("{} {}: ", std::exchange(separator, ","), scalar_yaml(entry.key));
        write_flow(entry.value, out);
      }
      out += node.entries().empty() ? "}" : " }";
  }
}

}  // namespace

ConfigNode merged(ConfigNode base, ConfigNode over) {
  if (!base.is_mapping() || !over.is_mapping()) return over;
  const ConfigNode* base_type = base.find("type");
  const ConfigNode* over_type = over.find("type");
  if (base_type && over_type && base_type->text() != over_type->text()) return over;
  ConfigNode result = ConfigNode::mapping(over.where());
  result.entries() = std::move(base.entries());
  for (ConfigNode::Entry& entry : over.entries()) {
    ConfigNode* inherited = result.find(entry.key);
    ConfigNode value = inherited == nullptr ? std::move(entry.value)
                                            : merged(std::move(*inherited), std::move(entry.value));
    result.set(std::move(entry.key), std::move(value), std::move(entry.key_where));
  }
  return result;
}

namespace {

/// Reads a config and everything that it extends.
class ConfigReader {
 public:
  explicit ConfigReader(std::vector<std::filesystem::path>* files) : files_(files) {}

  ConfigNode read(const std::filesystem::path& path) {
    ConfigNode own = read_yaml(path);
    if (files_ != nullptr) files_->push_back(path);
    chain_.push_back({path, canonical(path)});
    if (!own.is_mapping()) own.fail("expected a mapping, found " + own.describe());
    const Location key_where = own.where_key("extends");
    const ConfigNode extends = own.take("extends");
    ConfigNode result = ConfigNode::mapping(own.where());
    if (extends.is_sequence()) {
      for (const ConfigNode& base : extends.items()) {
        result = merged(std::move(result), read_base(base, key_where));
      }
    } else if (!extends.is_null()) {
      result = read_base(extends, key_where);
    }
    chain_.pop_back();
    return merged(std::move(result), std::move(own));
  }

 private:
  static constexpr int kMostFiles = 256;

  struct Link {
    std::filesystem::path shown, canonical;
  };

  static std::filesystem::path canonical(const std::filesystem::path& path) {
    std::error_code failed;
    return std::filesystem::weakly_canonical(path, failed);
  }

  ConfigNode read_base(const ConfigNode& name, const Location& key_where) {
    if (!name.is_scalar() || name.text().empty()) {
      name.fail("expected the path of a config or a list of paths, found " + name.describe());
    }
    const auto path = (chain_.back().shown.parent_path() / name.text()).lexically_normal();
    if (const std::string problem = file_problem(path); !problem.empty()) {
      name.fail(fmt::format("'{}': {}", path.string(), problem));
    }
    check_cycle(path, key_where);
    if (++count_ > kMostFiles) {
      throw InputError(key_where, fmt::format("more than {} files by 'extends'", kMostFiles));
    }
    return read(path);
  }

  void check_cycle(const std::filesystem::path& path, const Location& key_where) const {
    const auto canonical = std::filesystem::weakly_canonical(path);
    const auto first = std::find_if(chain_.begin(), chain_.end(),
                                    [&](const Link& link) { return link.canonical == canonical; });
    if (first == chain_.end()) return;
    std::string circle;
    for (auto i = first; i != chain_.end(); ++i) circle += "'" + i->shown.string() + "' extends ";
    throw InputError(key_where,
                     "'extends' goes in a circle: " + circle + "'" + first->shown.string() + "'");
  }

  std::vector<Link> chain_;
  int count_ = 0;
  std::vector<std::filesystem::path>* files_;
};

/// Returns the child of `node` named `step` for an override, and creates it if it is missing. `way`
/// is the path so far.
ConfigNode& child(ConfigNode& node, const std::string& step, const std::string& way,
                  const Location& where) {
  if (node.is_null()) node = ConfigNode::mapping(where);
  if (node.is_mapping()) {
    if (node.find(step) == nullptr) node.set(step, ConfigNode::null(where), where);
    return *node.find(step);
  }
  if (!node.is_sequence()) {
    throw InputError(where, fmt::format("cannot set '{}' inside of '{}', which is {}", step, way,
                                        node.describe()));
  }
  std::size_t index = 0;
  const char* end = step.data() + step.size();
  const auto [rest, failed] = std::from_chars(step.data(), end, index);
  const bool is_index = failed == std::errc() && rest == end;
  if (!is_index || index >= node.items().size()) {
    throw InputError(where, fmt::format("expected the index of one of the {} items of '{}', "
                                        "counted from 0, found '{}'",
                                        node.items().size(), way, step));
  }
  return node.items()[index];
}

}  // namespace

ConfigNode::ConfigNode() = default;
ConfigNode::~ConfigNode() = default;
ConfigNode::ConfigNode(const ConfigNode&) = default;
ConfigNode::ConfigNode(ConfigNode&&) noexcept = default;
ConfigNode& ConfigNode::operator=(const ConfigNode&) = default;
ConfigNode& ConfigNode::operator=(ConfigNode&&) noexcept = default;

ConfigNode ConfigNode::null(Location where) {
  ConfigNode node;
  node.where_ = std::move(where);
  return node;
}

ConfigNode ConfigNode::scalar(std::string text, Location where) {
  ConfigNode node = null(std::move(where));
  node.kind_ = Kind::scalar;
  node.text_ = std::move(text);
  return node;
}

ConfigNode ConfigNode::sequence(Location where) {
  ConfigNode node = null(std::move(where));
  node.kind_ = Kind::sequence;
  return node;
}

ConfigNode ConfigNode::mapping(Location where) {
  ConfigNode node = null(std::move(where));
  node.kind_ = Kind::mapping;
  return node;
}

std::string ConfigNode::describe() const {
  constexpr std::size_t shown = 50;
  if (is_null()) return "nothing";
  if (is_scalar()) return "the scalar '" + one_line(text_, shown) + "'";
  const std::string whole = to_flow_yaml(*this);
  std::string text = one_line(whole, shown);
  if (text != whole) text += is_mapping() ? " }" : "]";
  return (is_mapping() ? "the mapping " : "the list ") + text;
}

const ConfigNode* ConfigNode::find(std::string_view key) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& entry) { return entry.key == key; });
  return found == entries_.end() ? nullptr : &found->value;
}

ConfigNode* ConfigNode::find(std::string_view key) {
  return const_cast<ConfigNode*>(std::as_const(*this).find(key));
}

const Location& ConfigNode::where_key(std::string_view key) const {
  for (const Entry& entry : entries_) {
    if (entry.key == key) return entry.key_where;
  }
  return where_;
}

void ConfigNode::set(std::string key, ConfigNode value, Location key_where) {
  for (Entry& entry : entries_) {
    if (entry.key != key) continue;
    entry.value = std::move(value);
    entry.key_where = std::move(key_where);
    return;
  }
  entries_.push_back({std::move(key), std::move(key_where), std::move(value)});
}

ConfigNode ConfigNode::take(std::string_view key) {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& entry) { return entry.key == key; });
  if (found == entries_.end()) return null(where_);
  ConfigNode value = std::move(found->value);
  entries_.erase(found);
  return value;
}

void ConfigNode::fail(const std::string& message) const {
  throw InputError(where_, message);
}

ConfigNode read_config(const std::filesystem::path& path,
                       std::vector<std::filesystem::path>* files) {
  return ConfigReader(files).read(path);
}

void apply_override(ConfigNode& root, const std::string& assignment) {
  const Location where{"--set " + one_line(assignment, 100)};
  const std::size_t equals = assignment.find('=');
  const std::string keys = assignment.substr(0, equals);
  const bool empty_key = keys.empty() || keys.front() == '.' || keys.back() == '.' ||
                         keys.find("..") != std::string::npos;
  if (equals == std::string::npos || empty_key) {
    throw InputError(where, "expected KEY=VALUE with a key such as 'film.width'");
  }
  ConfigNode value = parse_yaml_at(assignment.substr(equals + 1), where);
  ConfigNode* at = &root;
  for (std::size_t begin = 0, end = 0; begin <= keys.size(); begin = end + 1) {
    end = std::min(keys.find('.', begin), keys.size());
    const std::string way = keys.substr(0, begin == 0 ? 0 : begin - 1);
    at = &child(*at, keys.substr(begin, end - begin), way, where);
  }
  *at = std::move(value);
}

std::string to_yaml(const ConfigNode& node) {
  if (fits_one_line(node)) return to_flow_yaml(node) + '\n';
  std::string out;
  write_block(node, 0, out);
  return out;
}

std::string to_flow_yaml(const ConfigNode& node) {
  std::string out;
  write_flow(node, out);
  return out;
}

}  // namespace pharos
