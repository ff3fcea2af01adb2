#ifndef snug_mesh_file_deck_parts_h
#define snug_mesh_file_deck_parts_h

#include <snug/mesh_file/deck_text.h>

#include <set>

namespace snug::mesh_file {
/// The parts and instances of a deck.
struct DeckParts
{
  /// @p deck must outlive this object. @throws InputError for a part or an instance without an end.
  explicit DeckParts(const DeckText &deck);

  /// Return the index of the keyword that closes the part or the instance of keyword @p k.
  std::size_t end_of(std::size_t k) const;

  const std::vector<Keyword>        &keywords;
  bool                               has_instances = false;
  std::map<std::string, std::size_t> keyword_of; ///< part in upper case -> index of *PART
  /// names in upper case of sets that occur in the assembly or in several instances
  std::set<std::string> qualified_names;
};

/// Throw an error for a keyword that places or generates nodes and elements, because it changes the
/// mesh.
void refuse_generation(const Keyword &keyword);
} // namespace snug::mesh_file

#endif
