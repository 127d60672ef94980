#include <array>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <pharos/config/node.h>

/// This file is the only one that uses yaml-cpp. Documents are processed as a stream of events, so
/// that limits hold during reading and nothing is expanded before it is counted.
namespace pharos {
namespace {

constexpr std::size_t kDeepest = 64;
constexpr std::size_t kMostNodes = 1'000'000;
constexpr std::size_t kMostBytes = std::size_t{32} << 20;
/// A scalar counts as one more node per this number of bytes, so that aliases of long texts are
/// limited, too.
constexpr std::size_t kBytesPerNode = 64;

/// A finished node with its cost.
struct Measured {
  ConfigNode node;
  std::size_t nodes = 1;   ///< this node and all nodes below it, see kBytesPerNode
  std::size_t height = 1;  ///< levels, including its own
};

/// Builds the nodes of one document from the parser's events.
class Builder : public YAML::EventHandler {
 public:
  /// Locates nodes by line and column in `name`, or all nodes at `fixed`.
  Builder(std::string name, std::optional<Location> fixed)
      : name_(std::move(name)), fixed_(std::move(fixed)) {}

  Location place(const YAML::Mark& mark) const {
    if (fixed_) return *fixed_;
    return mark.is_null() ? Location{name_} : Location{name_, mark.line + 1, mark.column + 1};
  }
  /// Empty if the stream held no document.
  std::optional<ConfigNode>& result() { return result_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (result_) throw InputError(place(mark), "expected one YAML document, found a second one");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    leaf(mark, anchor, ConfigNode::null(place_of_null(mark)));
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    check_tag(mark, tag);
    leaf(mark, anchor, ConfigNode::scalar(text, place(mark)));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) {
      throw InputError(place(mark), "an alias may not stand inside the node that it names");
    }
    check_depth(mark, found->second.height);
    count(mark, found->second.nodes);
    add(mark, Measured(found->second));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, ConfigNode::sequence(place(mark)));
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, ConfigNode::mapping(place(mark)));
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  /// A sequence or mapping whose end has not been reached yet.
  struct Open {
    Measured built;
    YAML::Mark mark;
    YAML::anchor_t anchor;
    bool has_key = false;                            ///< a key was read, its value is next
    std::unordered_map<std::string, int> keys = {};  ///< the keys so far, with their lines
  };

  /// Returns the location of a null. yaml-cpp locates an omitted value at the next token, so the
  /// location of its key is returned instead if the key is on an earlier line.
  Location place_of_null(const YAML::Mark& mark) const {
    if (open_.empty() || !open_.back().has_key) return place(mark);
    const Location& key = open_.back().built.node.entries().back().key_where;
    return key.line < mark.line + 1 ? key : place(mark);
  }
  void check_tag(const YAML::Mark& mark, const std::string& tag) const {
    const bool plain = tag.empty() || tag == "?" || tag == "!";
    if (!plain) throw InputError(place(mark), "YAML tags are not supported, found '" + tag + "'");
  }
  void check_depth(const YAML::Mark& mark, std::size_t height) const {
    if (open_.size() + height <= kDeepest) return;
    throw InputError(place(mark), fmt::format("nesting is deeper than {} levels", kDeepest));
  }
  void count(const YAML::Mark& mark, std::size_t nodes) {
    nodes_ += nodes;
    if (nodes_ <= kMostNodes) return;
    throw InputError(place(mark), fmt::format("the document has more than {} nodes", kMostNodes));
  }

  void leaf(const YAML::Mark& mark, YAML::anchor_t anchor, ConfigNode node) {
    const std::size_t nodes = 1 + node.text().size() / kBytesPerNode;
    check_depth(mark, 1);
    count(mark, nodes);
    finish(mark, anchor, {std::move(node), nodes, 1});
  }
  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
            ConfigNode node) {
    check_tag(mark, tag);
    check_depth(mark, 1);
    count(mark, 1);
    open_.push_back({{std::move(node)}, mark, anchor});
  }
  void close() {
    Open done = std::move(open_.back());
    open_.pop_back();
    finish(done.mark, done.anchor, std::move(done.built));
  }
  void finish(const YAML::Mark& mark, YAML::anchor_t anchor, Measured node) {
    if (anchor != YAML::NullAnchor) anchors_[anchor] = node;
    add(mark, std::move(node));
  }

  /// Stores a finished node where it belongs: as root, item, key or value.
  void add(const YAML::Mark& mark, Measured node) {
    if (open_.empty()) {
      result_ = std::move(node.node);
      return;
    }
    Open& parent = open_.back();
    parent.built.nodes += node.nodes;
    parent.built.height = std::max(parent.built.height, node.height + 1);
    ConfigNode& into = parent.built.node;
    if (into.is_sequence()) {
      into.items().push_back(std::move(node.node));
    } else if (parent.has_key) {
      into.entries().back().value = std::move(node.node);
      parent.has_key = false;
    } else {
      begin_entry(parent, node.node, place(mark));
    }
  }
  void begin_entry(Open& parent, const ConfigNode& node, Location where) const {
    if (!node.is_scalar()) throw InputError(where, "expected a key, found " + node.describe());
    const std::string& key = node.text();
    if (key == "<<") throw InputError(where, "YAML merge keys are not supported: use 'extends'");
    const auto [first, is_new] = parent.keys.emplace(key, where.line);
    if (!is_new) {
      const std::string line =
          first->second > 0 ? fmt::format(", first given in line {}", first->second) : "";
      throw InputError(where, fmt::format("duplicate key '{}'{}", one_line(key, 60), line));
    }
    parent.built.node.entries().push_back({key, std::move(where), {}});
    parent.has_key = true;
  }

  std::string name_;
  std::optional<Location> fixed_;
  std::optional<ConfigNode> result_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Measured> anchors_;
  std::size_t nodes_ = 0;
};

/// Returns the length of the UTF-8 character that starts at `i`, or 0 if the character is
/// malformed, overlong or not printable.
std::size_t character_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned first = byte(i);
  if (first < 0x80) {
    const bool is_break = first == '\t' || first == '\n' || first == '\r';
    return is_break || (first >= 0x20 && first != 0x7f) ? 1 : 0;
  }
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || i + length > text.size()) return 0;
  unsigned code = first & (0xff >> (length + 1));
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(i + k) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i + k) & 0x3f);
  }
  constexpr std::array<unsigned, 5> lowest{0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xd800 && code < 0xe000;
  return code < lowest[length] || code > 0x10ffff || is_surrogate ? 0 : length;
}

void check_text(std::string_view text, const Builder& builder) {
  YAML::Mark mark;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    if (length == 0) {
      const int byte = static_cast<unsigned char>(text[i]);
      throw InputError(builder.place(mark), fmt::format("not UTF-8 text (byte 0x{:02x})", byte));
    }
    mark.line += text[i] == '\n' ? 1 : 0;
    mark.column = text[i] == '\n' ? 0 : mark.column + 1;
    i += length;
  }
}

/// Returns the root of the document, or nothing if there is no document.
std::optional<ConfigNode> parse(std::string_view text, Builder builder) {
  check_text(text, builder);
  // If a text ends with a line break, yaml-cpp accepts the end of the text as the end of a quoted
  // scalar. An appended comment with opening quotes makes such a scalar the error that it is.
  const bool ends_line = !text.empty() && text.back() == '\n';
  try {
    std::istringstream stream(std::string(text) + (ends_line ? "# '\" '" : ""));
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& e) {
    throw InputError(builder.place(e.mark), "YAML: " + one_line(e.msg));
  }
  return std::move(builder.result());
}

std::string read_text(const std::filesystem::path& path) {
  const Location where{path.string()};
  const std::string problem = file_problem(path);
  if (!problem.empty()) throw InputError(where, problem);
  std::ifstream stream(path, std::ios::binary);
  std::string text;
  std::array<char, 4096> part;
  while (stream && text.size() <= kMostBytes) {
    stream.read(part.data(), part.size());
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (text.size() > kMostBytes) throw InputError(where, "the file is larger than 32 MiB");
  if (!stream.eof()) throw InputError(where, "the file cannot be read");
  return text;
}

}  // namespace

ConfigNode read_yaml(const std::filesystem::path& path) {
  return parse_yaml(read_text(path), path.string());
}

ConfigNode parse_yaml(std::string_view text, const std::string& name) {
  std::optional<ConfigNode> root = parse(text, Builder(name, std::nullopt));
  if (!root) throw InputError(Location{name}, "expected YAML, found an empty document");
  return std::move(*root);
}

ConfigNode parse_yaml_at(std::string_view text, const Location& where) {
  return parse(text, Builder(where.file, where)).value_or(ConfigNode::null(where));
}

}  // namespace pharos
