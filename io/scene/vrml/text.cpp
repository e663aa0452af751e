// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/vrml/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <utility>

#include "io/base/gzip.h"
#include "io/scene/base/from_file.h"
#include "io/scene/base/words.h"

namespace sunload {

namespace {

/// Words, strings and brackets; blanks, commas and comments are between them.
class Tokens {
 public:
  explicit Tokens(std::string_view text) : text_(text) {}

  /// The next token, empty at the end of the text.
  std::string_view next() {
    skip_blanks();
    if (at_ >= text_.size()) return {};
    const auto begin = at_;
    if (text_[at_] == '"') {
      skip_string();
    } else if (is_bracket(text_[at_])) {
      ++at_;
    } else {
      while (at_ < text_.size() && !is_blank(text_[at_]) && !is_bracket(text_[at_]) &&
             text_[at_] != '"' && text_[at_] != '#')
        ++at_;
    }
    return text_.substr(begin, at_ - begin);
  }

  std::string_view peek() const { return Tokens(*this).next(); }
  std::size_t byte() const { return at_; }
  std::size_t byte_of(std::string_view token) const {
    return token.empty() ? at_ : static_cast<std::size_t>(token.data() - text_.data());
  }

 private:
  static bool is_blank(char c) {
    return c == ',' || static_cast<unsigned char>(c) <= static_cast<unsigned char>(' ');
  }
  static bool is_bracket(char c) { return c == '{' || c == '}' || c == '[' || c == ']'; }

  void skip_blanks() {
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '#') {
        at_ = std::min(text_.find_first_of("\r\n", at_), text_.size() - 1);
      } else if (!is_blank(text_[at_])) {
        return;
      }
    }
  }

  void skip_string() {
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      if (text_[at_] == '\\') ++at_;
    }
    at_ = std::min(at_ + 1, text_.size());
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

bool is_name(std::string_view token) {
  return !token.empty() &&
         (std::isalpha(static_cast<unsigned char>(token[0])) != 0 || token[0] == '_');
}

/// Follows the nesting of a text and counts its nodes.
class Checker {
 public:
  explicit Checker(const VrmlText& file) : file_(file), tokens_(file.text) {}

  std::map<std::string, double> run() {
    for (auto token = tokens_.next(); !token.empty(); token = tokens_.next()) {
      read(token);
      before_ = token;
    }
    if (!frames_.empty()) {
      refuse(frames_.back().begin, std::string("'") + frames_.back().open + "' is never closed",
             "is the file cut off?");
    }
    return std::move(proto_nodes_);
  }

 private:
  struct Frame {
    char open;  ///< '{' or '['
    std::size_t begin;
    std::string_view def, proto;  ///< name, where it has one
    double nodes = 0;             ///< in it, with USEs and PROTOs in their places
    double made = 0;              ///< of these, what is a node of its own in memory: not USEs
    std::size_t height = 0;       ///< levels below it, with USEs and PROTOs in their places
  };

  [[noreturn]] void refuse(std::size_t byte, const std::string& what,
                           const std::string& why) const {
    throw InputError(place_in_text(file_.path, file_.text, byte), what, why);
  }

  void read(std::string_view token) {
    if (token.size() > longest_vrml_word && token[0] != '"') {
      refuse(tokens_.byte_of(token), "a word of " + std::to_string(token.size()) + " characters",
             "at most " + std::to_string(longest_vrml_word) + " can be read");
    }
    if (token == "{" || token == "[") {
      open(token);
    } else if (token == "}" || token == "]") {
      close(token);
    } else if (before_ == "DEF") {
      def_ = token;
    } else if (before_ == "PROTO") {
      proto_ = token;
      proto_depth_ = frames_.size();
    } else if (before_ == "USE") {
      use(token);
    }
  }

  void open(std::string_view token) {
    if (frames_.size() >= deepest_vrml) {
      refuse(tokens_.byte_of(token), "brackets are nested too deep",
             "at most " + std::to_string(deepest_vrml) + " levels can be read");
    }
    Frame frame{token[0], tokens_.byte_of(token), {}, {}};
    if (token == "{") {
      if (!proto_.empty() && frames_.size() == proto_depth_) {
        frame.proto = std::exchange(proto_, {});
      } else {
        count_node(before_);
        frame.def = std::exchange(def_, {});
        if (!frame.def.empty()) latest_def_[frame.def] = frame.begin;
      }
    }
    frames_.push_back(frame);
  }

  void close(std::string_view token) {
    if (frames_.empty() || (frames_.back().open == '{') != (token == "}")) {
      refuse(tokens_.byte_of(token), "'" + std::string(token) + "' closes nothing",
             frames_.empty() ? "no bracket is open" : "another kind of bracket is open");
    }
    const Frame frame = frames_.back();
    frames_.pop_back();
    if (!frame.proto.empty()) {
      proto_nodes_[std::string(frame.proto)] = frame.nodes;
      made_by_[frame.proto] = frame.made;
      height_of_[frame.proto] = frame.height;
      return;
    }
    if (!frame.def.empty()) nodes_of_[frame.def] = frame.nodes;
    put_nodes(frame.nodes);
    put_made(frame.made);
    if (!frame.def.empty()) height_of_[frame.def] = frame.height;
    put_below(frame.height + 1);
  }

  /// What stands here is `height` levels high: nodes are released level by level, too.
  void put_below(std::size_t height) {
    if (height > deepest_vrml) {
      refuse(tokens_.byte(), "nodes are nested too deep",
             "with every USE in its place at most " + std::to_string(deepest_vrml) +
                 " levels can be read");
    }
    if (!frames_.empty()) frames_.back().height = std::max(frames_.back().height, height);
  }

  /// A node of that type begins in the innermost frame.
  void count_node(std::string_view type) {
    for (const auto& frame : frames_) {
      if (!frame.proto.empty() && frame.proto == type) {
        refuse(tokens_.byte_of(type), "PROTO '" + shortened(type) + "' contains itself",
               "it would never end");
      }
    }
    put_nodes(1);
    put_made(1);
    if (const auto known = proto_nodes_.find(std::string(type)); known != proto_nodes_.end()) {
      put_nodes(known->second);
      put_made(made_by_[type]);
      put_below(height_of_[type] + 1);
    }
  }

  void put_nodes(double count) {
    double& sum = frames_.empty() ? nodes_ : frames_.back().nodes;
    sum += count;
    if (sum > most_vrml_nodes) {
      refuse(tokens_.byte(), "has too many nodes",
             "with its PROTOs and USEs put in their places they are more than 5 million");
    }
  }

  void put_made(double count) {
    double& sum = frames_.empty() ? made_ : frames_.back().made;
    sum += count;
    const double most =
        vrml_nodes_at_least + vrml_nodes_per_byte * static_cast<double>(file_.text.size());
    if (sum > most) {
      refuse(tokens_.byte(), "has too many nodes",
             "its PROTOs make more than fit into memory for a file of its size");
    }
  }

  void use(std::string_view name) {
    if (const auto known = height_of_.find(name); known != height_of_.end()) {
      put_below(known->second + 1);
      put_nodes(nodes_of_[name]);
    }
    const auto latest = latest_def_.find(name);
    if (latest == latest_def_.end()) return;
    for (const auto& frame : frames_) {
      if (frame.begin == latest->second) {
        refuse(tokens_.byte_of(name), "node '" + shortened(name) + "' contains itself",
               "USE stands within its own DEF");
      }
    }
  }

  const VrmlText& file_;
  Tokens tokens_;
  std::vector<Frame> frames_;
  std::string_view before_, def_, proto_;
  std::size_t proto_depth_ = 0;
  double nodes_ = 0, made_ = 0;
  std::map<std::string, double> proto_nodes_;
  std::map<std::string_view, std::size_t> latest_def_, height_of_;
  std::map<std::string_view, double> nodes_of_, made_by_;
};

void skip_block(Tokens& tokens) {
  std::size_t depth = 0;
  for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
    if (token == "{" || token == "[") ++depth;
    if ((token == "}" || token == "]") && --depth == 0) return;
  }
}

/// Moves behind the value of a field whose type nobody knows.
void skip_value(Tokens& tokens) {
  bool has_some = false;
  for (auto token = tokens.peek(); !token.empty(); token = tokens.peek()) {
    if (token == "[" || token == "{") return skip_block(tokens);
    if (token == "}" || token == "]") return;
    if (token == "USE" || token == "IS") {
      tokens.next();
      tokens.next();
      return;
    }
    if (is_name(token) && token != "DEF") {
      Tokens ahead = tokens;
      ahead.next();
      const bool is_node = ahead.peek() == "{";
      if (!is_node && has_some) return;  // the next field
      tokens.next();
      if (is_node) return skip_block(tokens);
      return;  // TRUE, FALSE, NULL or a word of an enumeration
    }
    tokens.next();
    if (token == "DEF") {
      tokens.next();
    } else {
      has_some = true;
    }
  }
}

struct Span {
  std::size_t begin, end;
};

/// Blanks out the spans and puts `word` at their begin; lines stay where they are.
VrmlDropped replace_all(VrmlText& file, const std::vector<Span>& spans, std::string_view word) {
  if (spans.empty()) return {};
  VrmlDropped dropped{spans.size(), place_in_text(file.path, file.text, spans.front().begin)};
  for (auto span = spans.rbegin(); span != spans.rend(); ++span) {
    for (auto at = span->begin; at < span->end; ++at) {
      if (file.text[at] != '\n' && file.text[at] != '\r') file.text[at] = ' ';
    }
    const auto room = file.text.find_first_not_of(' ', span->begin) - span->begin;
    file.text.replace(span->begin, std::min(room, word.size()), word);
  }
  return dropped;
}

/// Calls `act(tokens, type, token)` for every word that stands directly in a node.
template <class Act>
void in_nodes(std::string_view text, Act act) {
  Tokens tokens(text);
  std::vector<std::string_view> types;
  std::string_view before;
  for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
    if (token == "{") {
      types.push_back(before);
    } else if (token == "[") {
      types.push_back("[");
    } else if (token == "}" || token == "]") {
      if (!types.empty()) types.pop_back();
    } else if (!types.empty() && before != "DEF" && before != "USE" && before != "IS") {
      act(tokens, types.back(), token);
    }
    before = token;
  }
}

bool begins_with_any(std::string_view text, std::initializer_list<std::string_view> starts) {
  return std::any_of(starts.begin(), starts.end(),
                     [&](std::string_view start) { return text.starts_with(start); });
}

}  // namespace

VrmlText read_vrml_text(const std::string& path) {
  VrmlText file{path, read_whole_file(path)};
  if (is_gzip(file.text)) file.text = unpack_gzip(file.text, path);
  file.text.erase(0, file.text.size() - without_byte_order_mark(file.text).size());
  file.is_vrml97 = file.text.starts_with("#VRML V2.0");
  const auto first_line = file.text.substr(0, file.text.find_first_of("\r\n"));
  if (!file.is_vrml97 && !begins_with_any(first_line, {"#VRML V1.0", "#Inventor V"})) {
    throw InputError(
        {path, 1, 1}, "is no VRML file",
        "its first line is not '#VRML V2.0 utf8', '#VRML V1.0 ascii' or '#Inventor V…'");
  }
  if (first_line.find("binary") != first_line.npos) {
    throw InputError({path, 1, 1}, "is a binary Inventor file", "only the text form is read",
                     "convert it with ivcat");
  }
  if (const auto zero = file.text.find('\0'); zero != file.text.npos) {
    throw InputError(place_in_text(path, file.text, zero), "is no VRML text",
                     "it has a zero byte here");
  }
  return file;
}

std::map<std::string, double> check_vrml(const VrmlText& file) { return Checker(file).run(); }

VrmlDropped drop_vrml_fields(VrmlText& file, std::string_view node, std::string_view field) {
  std::vector<Span> spans;
  in_nodes(file.text, [&](Tokens& tokens, std::string_view type, std::string_view token) {
    if (type != node || token != field) return;
    skip_value(tokens);
    spans.push_back({tokens.byte_of(token), tokens.byte()});
  });
  return replace_all(file, spans, {});
}

VrmlDropped drop_vrml_nodes(VrmlText& file, std::string_view node) {
  std::vector<Span> spans;
  Tokens tokens(file.text);
  for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
    if (token != node || tokens.peek() != "{") continue;
    skip_block(tokens);
    spans.push_back({tokens.byte_of(token), tokens.byte()});
  }
  return replace_all(file, spans, "Group{}");
}

VrmlDropped rename_vrml_nodes(VrmlText& file, std::string_view from, std::string_view to) {
  std::vector<Span> spans;
  Tokens tokens(file.text);
  for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
    if (token != from || tokens.peek() != "{") continue;
    spans.push_back({tokens.byte_of(token), tokens.byte_of(token) + from.size()});
  }
  return replace_all(file, spans, to);
}

VrmlDropped drop_vrml_events(VrmlText& file) {
  std::vector<Span> spans;
  std::set<std::string_view> events;
  Tokens tokens(file.text);
  std::array<std::string_view, 4> last;  // the latest one first
  for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
    const bool declares = last[1] == "eventIn" || last[1] == "eventOut";
    if (last[2] == "PROTO" && token == "[") events.clear();
    if (declares && tokens.peek() != "IS") events.insert(token);
    if (last[0] == "IS" && events.contains(token) && last[3] != "eventIn" &&
        last[3] != "eventOut" && last[3] != "field") {
      spans.push_back({tokens.byte_of(last[1]), tokens.byte()});
    }
    last = {token, last[0], last[1], last[2]};
  }
  return replace_all(file, spans, {});
}

std::optional<std::string> node_with_field(const VrmlText& file, std::string_view field, int line) {
  std::optional<std::string> node;
  in_nodes(file.text, [&](Tokens& tokens, std::string_view type, std::string_view token) {
    if (token != field || node) return;
    if (place_in_text(file.path, file.text, tokens.byte_of(token)).line == line) node = type;
  });
  return node;
}

std::optional<Where> place_of_def(const VrmlText& file, std::string_view name) {
  Tokens tokens(file.text);
  std::string_view before;
  for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
    if (before == "DEF" && token == name) {
      return place_in_text(file.path, file.text, tokens.byte_of(token));
    }
    before = token;
  }
  return std::nullopt;
}

}  // namespace sunload
