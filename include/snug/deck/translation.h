#ifndef snug_deck_translation_h
#define snug_deck_translation_h

#include <snug/deck/remarks.h>

namespace snug::deck {
/// A deck as a parameter file, and what the deck has beside it. Texts have their lines, "*NODE FILE
/// (line 17)".
struct Translation
{
  std::string              text;       ///< parameter file, with the lines of the deck as comments
  std::string              not_needed; ///< keywords and options that change no result
  std::vector<std::string> replaced;   ///< parts of the model that others replace
  std::vector<LackingPart> lacking;    ///< parts of the model that the parameter file lacks

  template <class Archive>
  void serialize(Archive &archive, const unsigned int /*version*/)
  {
    archive & text & not_needed & replaced & lacking;
  }
};

/// Return whether @p text is a deck of Abaqus or CalculiX: its first word begins with *.
bool is_deck(const std::string &text);

/**
 * Translate a deck of Abaqus or CalculiX with the content @p text into a parameter file, as
 * doc/mesh-files.md describes. All other parts of the model are listed in Translation::lacking.
 *
 * @param[in] file Name of the deck, to which the entries 'File' refer.
 * @throws InputError with the line if the mesh or a data line cannot be read, or if cells have no
 *   isotropic material.
 */
Translation translate(const std::string &text, const std::string &file);
} // namespace snug::deck

#endif
