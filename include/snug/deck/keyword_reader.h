#ifndef snug_deck_keyword_reader_h
#define snug_deck_keyword_reader_h

#include <snug/deck/amplitudes.h>
#include <snug/deck/deck_model.h>
#include <snug/deck/local_axes.h>

#include <functional>

namespace snug::deck {
/// Options of a keyword.
struct KeywordOptions
{
  std::set<std::string> read;     ///< options that are read
  std::set<std::string> unneeded; ///< options that change no result
};

/// How a keyword is read.
struct KeywordReading
{
  std::function<void(const mesh_file::Keyword &)> read;
  KeywordOptions                                  options     = {};
  bool                                            takes_lines = true; ///< whether data lines follow
};

using KeywordReadings = std::map<std::string, KeywordReading>; ///< by Keyword::name

/// A node and its component: 0, 1, 2 for translations, 3, 4, 5 for rotations.
using Freedom = std::pair<unsigned int, unsigned int>;

/// Return the degrees of freedom of all reference nodes. Keys are those of the deck, where the
/// components 1 to 3 of a ROT NODE are the rotations of its REF NODE. @throws InputError.
std::map<Freedom, Freedom> reference_freedoms(const mesh_file::DeckText &text,
                                              const mesh_file::DeckSets &sets);

/// Return the node that an option, such as REF NODE, names. @throws InputError unless it is one.
unsigned int one_node(const mesh_file::Keyword  &keyword,
                      const std::string         &option,
                      const mesh_file::DeckSets &sets);

/// The deck, and the model that the readers of keywords make from it.
struct Reading
{
  using Keyword = mesh_file::Keyword;

  const mesh_file::DeckText       &text;
  const mesh_file::DeckMesh       &deck;
  DeckBodies                      &bodies;
  Remarks                         &remarks;
  const Amplitudes                 amplitudes;
  const LocalAxes                  axes;
  const std::map<Freedom, Freedom> references = reference_freedoms(text, deck.sets);
  DeckModel                        model      = {};
  unsigned int                     n_steps    = 0;
  bool                             in_step    = false;
  std::vector<std::string>         prefixes   = {""}; ///< of the instances of the current part

  /// Return the supports and loads of the step that is read, or those before the first step.
  DeckModel::Step &current() { return n_steps == 0 ? model.initial : model.steps.back(); }

  /// Return the factor of the loads of a keyword at the end of the step that is read.
  double factor(const Keyword &keyword) const { return amplitudes.at_end(keyword, n_steps); }

  /// Note a part of the model that the translation lacks: "*CLOAD" + @p what.
  void lacks(const Keyword &keyword, const std::string &what, unsigned long line);
  void lacks(const Keyword &keyword, const std::string &what)
  {
    lacks(keyword, what, keyword.line);
  }

  /// Return the numbers of the first data line. Further lines are noted as lacking.
  std::vector<double> first_line(const Keyword &keyword);

  /// Return the name of the surface @p word, which may consist of nodes. @throws InputError at
  /// @p line.
  std::string surface(const std::string &word, unsigned long line) const;

  /// Use a set of faces. Return whether a body has such a face, and note a set without one.
  bool use(const Keyword &keyword, const std::string &set, unsigned long line);
};

/// Throw if a keyword has data lines, which belong to no keyword: one before them is missing or
/// misspelt.
void require_no_lines(const Reading &reading, const mesh_file::Keyword &keyword);

/// Return the title of a keyword, with the name of an included file.
std::string title_of(const mesh_file::Keyword &keyword);

/// Return the readings of *MATERIAL, *ELASTIC, *SOLID SECTION, *ELEMENT and the like.
KeywordReadings material_readings(Reading &reading);

/// Return the readings of *BOUNDARY.
KeywordReadings support_readings(Reading &reading);

/// Return the readings of steps and loads.
KeywordReadings load_readings(Reading &reading);

/// Return the readings of rigid bodies and couplings.
KeywordReadings rigid_readings(Reading &reading);

/// Return whether the surface @p word consists of faces of rigid bodies, or is analytical.
bool is_rigid_surface(const Reading &reading, const std::string &word);

/// Return the obstacle that is the rigid surface @p word, seen from the slave faces, or nothing if
/// no rigid body has this surface. A rigid surface that is no plane, cylinder or sphere is noted as
/// lacking.
std::optional<unsigned int> obstacle_of(Reading                                &reading,
                                        const std::string                      &word,
                                        const std::vector<DeckBodies::Corners> &slave,
                                        unsigned long                           line);

/// Return the readings of *PRE-TENSION SECTION.
KeywordReadings bolt_readings(Reading &reading);

/// Return the readings of contact and friction.
KeywordReadings contact_readings(Reading &reading);
} // namespace snug::deck

#endif
