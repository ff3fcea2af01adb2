#ifndef snug_deck_translation_h
#define snug_deck_translation_h

#include <string>
#include <vector>

namespace snug::deck {
/// A deck as a parameter file.
struct Translation
{
  std::string              text;     ///< parameter file, with the lines of the deck as comments
  std::vector<std::string> left_out; ///< keywords that are not translated, "*NODE FILE (line 17)"
};

/// Return whether @p text is a deck of Abaqus or CalculiX: its first word begins with *.
bool is_deck(const std::string &text);

/**
 * Translate a deck of Abaqus or CalculiX with the content @p text into a parameter file:
 *
 * - Each body consists of connected cells. It is called like the first instance or element set that
 *   consists of these cells.
 * - *ELASTIC, *DENSITY and *SOLID SECTION become materials; the family of the elements (CPS, CPE,
 *   CAX) determines the model.
 * - *BOUNDARY becomes supports and prescribed displacements, *DSLOAD and *DLOAD pressures,
 *   tractions and gravity, *CONTACT PAIR, *SURFACE INTERACTION and *FRICTION contact pairs. Node
 *   sets stand for the faces whose nodes are all in the set.
 * - *CLOAD of up to 20 nodes on boundaries becomes point forces. Forces of a node are added.
 * - The elements have degree 2 if all cells are of second order.
 * - The loads are those of the first step.
 *
 * All other keywords, and lines that have no counterpart, are listed in left_out.
 *
 * @param[in] file Name of the deck, to which the entries 'File' refer.
 * @throws InputError with the line if the mesh or a data line cannot be read, or if cells have no
 *   isotropic material.
 */
Translation translate(const std::string &text, const std::string &file);
} // namespace snug::deck

#endif
