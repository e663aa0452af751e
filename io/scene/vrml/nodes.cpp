// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/vrml/nodes.h"

#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/VRMLnodes/SoVRMLInline.h>
#include <Inventor/actions/SoSearchAction.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/nodes/SoWWWInline.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "geo/base/pattern.h"

namespace sunload {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_message = 400;  ///< characters kept of one of Coin
constexpr int most_repairs = 200;             ///< kinds of unknown fields; each reads anew

}  // namespace

VrmlFiles::VrmlFiles(NoteCounter& notes) : notes_(notes) {
  SoDB::init();
  SoVRMLInline::setReadAsSoFile(FALSE);
  SoVRMLInline::setFetchURLCallBack([](const SbString&, void*, SoVRMLInline*) {}, nullptr);
  SoWWWInline::setReadAsSoFile(FALSE);
  SoWWWInline::setFetchURLCallBack([](const SbString&, void*, SoWWWInline*) {}, nullptr);
  SoReadError::setHandlerCallback(&note_error, this);
  SoDebugError::setHandlerCallback(&note_error, this);
  SoProto::setFetchExternProtoCallback(&fetch_proto, this);
}

VrmlFiles::~VrmlFiles() {
  SoReadError::setHandlerCallback(SoError::getHandlerCallback(), nullptr);
  SoDebugError::setHandlerCallback(SoError::getHandlerCallback(), nullptr);
  SoProto::setFetchExternProtoCallback(nullptr, nullptr);
}
const VrmlFiles::File& VrmlFiles::read(const std::string& path, const std::string& asker) {
  if (asker.empty()) return read_once(path);
  try {
    return read_once(path);
  } catch (const InputError& error) {
    std::vector<std::string> problems = error.problems();
    for (auto& problem : problems) problem += "; it is wanted by the " + asker;
    throw InputError(std::move(problems));
  }
}

const VrmlFiles::File& VrmlFiles::read_once(const std::string& path) {
  std::error_code no_matter;
  const auto key = fs::weakly_canonical(path, no_matter).string();
  if (const auto known = files_.find(key); known != files_.end()) return known->second;
  if (std::find(being_read_.begin(), being_read_.end(), key) != being_read_.end() ||
      being_read_.size() >= deepest_inline) {
    throw InputError({path}, "contains itself", "its EXTERNPROTOs lead back to it");
  }
  being_read_.push_back(key);
  File file{read_vrml_text(path)};
  bytes_ += file.text.text.size();
  check_vrml(file.text);
  prepare(file.text);
  file.root = parse(file.text);
  being_read_.pop_back();
  return files_.emplace(key, std::move(file)).first->second;
}

std::vector<std::string> VrmlFiles::paths() const {
  std::vector<std::string> paths;
  for (const auto& [path, file] : files_) paths.push_back(path);
  return paths;
}

const VrmlFiles::File* VrmlFiles::home_of(const SoNode* node) const {
  if (node == nullptr || home_.empty()) return nullptr;
  // Coin leaves the instance of a PROTO in its place, or the node that it stands for.
  const auto* instance = node->isOfType(SoProtoInstance::getClassTypeId())
                             ? static_cast<const SoProtoInstance*>(node)
                             : SoProtoInstance::findProtoInstance(node);
  if (instance == nullptr) return nullptr;
  const auto home = home_.find(instance->getProtoDefinition());
  return home == home_.end() ? nullptr : home->second;
}

std::string VrmlFiles::beside(const std::string& file, const std::string& url) {
  return (fs::path(file).parent_path() / url).lexically_normal().string();
}

void VrmlFiles::note_error(const SoError* error, void* files) {
  const std::string text = error->getDebugString().getString();
  auto& list = static_cast<VrmlFiles*>(files)->errors_;
  const std::string mark = "at line ";
  const auto place = text.rfind(mark);
  const int line = place == text.npos ? 0 : std::atoi(text.c_str() + place + mark.size());
  // Names in it may be of any length, which regular expressions do not bear.
  std::string what = text.substr(0, std::min(text.find('\n'), longest_message));
  for (const std::string prefix : {"Coin read error: ", "Coin warning in ", "Coin error in "}) {
    if (what.starts_with(prefix)) what.erase(0, prefix.size());
  }
  list.push_back({what, line});
}

SoProto* VrmlFiles::fetch_proto(SoInput*, const SbString* urls, const int count, void* files) {
  auto& self = *static_cast<VrmlFiles*>(files);
  try {
    return self.proto_of(urls, count);
  } catch (...) {  // must not pass through Coin: thrown again behind it
    self.failure_ = std::current_exception();
    return nullptr;
  }
}

/// The PROTO that the first url with a file names; without a name the first of that file
/// (ISO/IEC 14772-1, 4.8.3).
SoProto* VrmlFiles::proto_of(const SbString* urls, int count) {
  for (int i = 0; i < count; ++i) {
    const std::string url = urls[i].getString();
    const auto hash = url.find('#');
    const auto path = beside(texts_.back()->path, url.substr(0, hash));
    std::error_code no_matter;
    if (!fs::is_regular_file(path, no_matter)) continue;
    const auto outer_errors = std::exchange(errors_, {});
    SoSearchAction search;
    search.setType(SoProto::getClassTypeId());
    search.setSearchingAll(TRUE);
    search.setInterest(SoSearchAction::ALL);
    const File& file = read(path, "EXTERNPROTO of " + texts_.back()->path);
    search.apply(file.root);
    errors_ = outer_errors;
    const auto& paths = search.getPaths();
    for (int p = 0; p < paths.getLength(); ++p) {
      auto* proto = static_cast<SoProto*>(paths[p]->getTail());
      if (hash == url.npos ? p == 0
                           : url.substr(hash + 1) == coin::text_of(proto->getProtoName())) {
        home_[proto] = &file;
        return proto;
      }
    }
    throw InputError({path}, "has no PROTO '" + url + "'",
                     "an EXTERNPROTO of " + texts_.back()->path + " asks for it");
  }
  throw InputError({texts_.back()->path}, "EXTERNPROTO without a file that is there",
                   count > 0 ? std::string("url ") + urls[0].getString() : "it names none");
}

void VrmlFiles::note(const VrmlDropped& dropped, const std::string& what) {
  if (dropped.count == 0) return;
  notes_.count(fmt::format("{} (first at {}:{})", what,
                           fs::path(dropped.first.file).filename().string(), dropped.first.line),
               dropped.count);
}

/// Nodes that Coin lacks or would follow to other files by itself.
void VrmlFiles::prepare(VrmlText& text) {
  // An Inline with one more switch (ISO/IEC 14772-1 amendment 1).
  rename_vrml_nodes(text, "InlineLoadControl", "Inline");
  drop_vrml_fields(text, "Inline", "load");
  drop_vrml_events(text);
  // Neither pictures nor sounds are asked for; Coin would open them.
  for (const char* node : {"ImageTexture", "MovieTexture", "AudioClip", "Script"})
    drop_vrml_fields(text, node, "url");
  if (text.is_vrml97) return;
  for (const char* node : {"Texture2", "Texture3"}) drop_vrml_fields(text, node, "filename");
  drop_vrml_nodes(text, "Info");  // remarks, in strings that Coin misreads
  note(drop_vrml_nodes(text, "File"), "Inventor File nodes left out");
}

SoSeparator* VrmlFiles::parse(VrmlText& text) {
  for (int attempt = 0; attempt < most_repairs; ++attempt) {
    errors_.clear();
    texts_.push_back(&text);
    SoInput input;
    input.setBuffer(text.text.data(), text.text.size());
    SoSeparator* root = SoDB::readAll(&input);
    texts_.pop_back();
    if (root != nullptr) nodes_.keep(root);
    if (failure_) std::rethrow_exception(std::exchange(failure_, {}));
    if (root != nullptr && errors_.empty()) return root;
    if (!errors_.empty() && repair(text, errors_.front())) continue;
    if (root == nullptr) refuse(text);
    for (const auto& error : errors_) {
      notes_.say(fmt::format("{}:{}: {}", fs::path(text.path).filename().string(), error.line,
                             error.text));
    }
    return root;
  }
  throw InputError({text.path}, "has too many kinds of unknown fields",
                   fmt::format("{} were left out", most_repairs));
}

void VrmlFiles::refuse(const VrmlText& text) const {
  if (errors_.empty()) throw InputError({text.path}, "cannot be parsed", "Coin gives no reason");
  throw InputError({text.path, errors_.front().line}, "cannot be parsed", errors_.front().text,
                   "is the file cut off?");
}

/// Takes away what Coin does not know. False where that is not the trouble.
bool VrmlFiles::repair(VrmlText& text, const CoinError& error) {
  static const Pattern field(R"re(Unknown field "([^"]*)" in "(?:VRML)?([^"]*)")re");
  static const Pattern node(R"re(Node type ``([^']*)'' not recognized)re");
  VrmlDropped dropped;
  if (const auto of_field = field.first(error.text)) {
    const std::string name = (*of_field)[1].text;
    // Coin calls all instances of PROTOs by one name.
    const auto type = (*of_field)[2].text == "ProtoInstance"
                          ? node_with_field(text, name, error.line).value_or("")
                          : (*of_field)[2].text;
    dropped = drop_vrml_fields(text, type, name);
    note(dropped, fmt::format("fields '{}' of {} are unknown and left out", name, type));
  } else if (const auto of_node = node.first(error.text)) {
    const std::string name = (*of_node)[1].text;
    dropped = drop_vrml_nodes(text, name);
    note(dropped, fmt::format("nodes '{}' are unknown and left out", name));
  }
  return dropped.count > 0;
}

}  // namespace sunload
