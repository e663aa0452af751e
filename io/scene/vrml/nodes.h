// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// VRML files as the nodes that Coin makes of them. With vrml_faces and scene_vrml.cpp all that
/// knows Coin.
#pragma once

#include <Inventor/SbMatrix.h>
#include <Inventor/SbVec3f.h>
#include <Inventor/misc/SoProto.h>
#include <Inventor/misc/SoProtoInstance.h>
#include <Inventor/nodes/SoSeparator.h>

#include <exception>
#include <map>
#include <string>
#include <vector>

#include "geo/mesh/affine.h"
#include "io/scene/base/from_file.h"
#include "io/scene/vrml/text.h"

class SoError;

namespace sunload {

inline constexpr std::size_t deepest_inline = 64;  ///< files within files

/// Coin's nodes and values, as ours.
namespace coin {

inline std::string text_of(const SbName& name) { return name.getString(); }
inline Vec3 vec(const SbVec3f& v) { return {v[0], v[1], v[2]}; }

/// Coin's matrices act on row vectors.
inline Affine affine(const SbMatrix& m) {
  const auto row = [&](int i) { return Vec3{m[i][0], m[i][1], m[i][2]}; };
  return {{row(0), row(1), row(2)}, row(3)};
}

/// PROTOs stand for the root of what they make.
inline SoNode* plain(SoNode* node) {
  while (node != nullptr && node->isOfType(SoProtoInstance::getClassTypeId()))
    node = static_cast<SoProtoInstance*>(node)->getRootNode();
  return node;
}

template <class Node>
Node* as(SoNode* node) {
  node = plain(node);
  return node != nullptr && node->isOfType(Node::getClassTypeId()) ? static_cast<Node*>(node)
                                                                   : nullptr;
}

}  // namespace coin

/// Keeps Coin's nodes alive as long as it lives.
class KeptNodes {
 public:
  KeptNodes() = default;
  KeptNodes(const KeptNodes&) = delete;
  KeptNodes& operator=(const KeptNodes&) = delete;
  ~KeptNodes() {
    for (auto* node : nodes_) node->unref();
  }
  template <class Node>
  Node* keep(Node* node) {
    node->ref();
    nodes_.push_back(node);
    return node;
  }

 private:
  std::vector<SoNode*> nodes_;
};

/// Reads files through Coin: repairs what Coin does not know, follows EXTERNPROTO; Inlines are
/// left to the caller. Coin's handlers are set as long as it lives: one at a time.
class VrmlFiles {
 public:
  explicit VrmlFiles(NoteCounter& notes);
  ~VrmlFiles();
  VrmlFiles(const VrmlFiles&) = delete;
  VrmlFiles& operator=(const VrmlFiles&) = delete;

  /// A file as text, and the root of its nodes.
  struct File {
    VrmlText text;
    SoSeparator* root = nullptr;
  };

  /// A file's nodes; the same path again is not read again. Throws InputError.
  /// `asker` is named where the file is refused: who wants it; empty for the scene itself.
  const File& read(const std::string& path, const std::string& asker = {});

  /// Length of the texts that were read.
  std::size_t bytes() const { return bytes_; }

  /// Of the files that were read, each once.
  std::vector<std::string> paths() const;

  /// The file of which an EXTERNPROTO has taken the node's PROTO; null of all other nodes.
  const File* home_of(const SoNode* node) const;

  /// Where a relative url of a file lies.
  static std::string beside(const std::string& file, const std::string& url);

 private:
  /// A message of Coin with the line that it names.
  struct CoinError {
    std::string text;
    int line = 0;
  };

  static void note_error(const SoError* error, void* files);
  const File& read_once(const std::string& path);
  static SoProto* fetch_proto(SoInput*, const SbString* urls, int count, void* files);
  SoProto* proto_of(const SbString* urls, int count);
  void note(const VrmlDropped& dropped, const std::string& what);
  void prepare(VrmlText& text);
  SoSeparator* parse(VrmlText& text);
  [[noreturn]] void refuse(const VrmlText& text) const;
  bool repair(VrmlText& text, const CoinError& error);

  NoteCounter& notes_;
  std::size_t bytes_ = 0;
  KeptNodes nodes_;
  std::map<std::string, File> files_;
  std::map<const SoProto*, const File*> home_;  ///< of those that EXTERNPROTOs have taken
  std::vector<std::string> being_read_;
  std::vector<const VrmlText*> texts_;
  std::vector<CoinError> errors_;
  std::exception_ptr failure_;
};

}  // namespace sunload
