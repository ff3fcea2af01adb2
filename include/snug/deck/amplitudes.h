#ifndef snug_deck_amplitudes_h
#define snug_deck_amplitudes_h

#include <snug/deck/remarks.h>
#include <snug/mesh_file/deck_text.h>

namespace snug::deck {
/// The values of *AMPLITUDE at the ends of the steps. A load is its number times this value.
class Amplitudes
{
public:
  /// @throws InputError for an amplitude that is no table, or of the total time of several steps.
  explicit Amplitudes(const mesh_file::DeckText &text);

  /// Return the value of the amplitude @p name at the end of step @p step, counted from 1.
  /// @throws InputError of @p keyword, which names the amplitude, if there is none.
  double at_end(const mesh_file::Keyword &keyword, unsigned int step) const;

private:
  struct Table
  {
    std::vector<std::pair<double, double>> points;    ///< time, value
    bool                                   is_smooth; ///< DEFINITION = SMOOTH STEP
  };

  std::map<std::string, Table> tables;  ///< by name in upper case
  std::vector<double>          periods; ///< of the steps
};
} // namespace snug::deck

#endif
