#ifndef snug_base_units_h
#define snug_base_units_h

#include <string>
#include <vector>

namespace snug {
/**
 * The names of the units of a scene, for the log, the summary and pictures. All numbers of a scene
 * are in these units. Snug never converts a number.
 */
class Units
{
public:
  /// Construct units without names.
  Units() = default;

  /// Construct units from the names {length, force}; an empty list means units without names.
  explicit Units(const std::vector<std::string> &names);

  bool are_named() const { return !length.empty(); }

  /**
   * Return the name of a unit that is an expression in the words "length" and "force", such as
   * "MPa" for "force/length^2" with mm and N, or "N mm" for "force length". The expression is
   * returned with its words replaced if the unit has no name of its own, and the result is empty if
   * the units have no names.
   */
  std::string name(const std::string &expression) const;

  /// Return @p expression with a blank before it, to follow a number; empty without names.
  std::string after_number(const std::string &expression) const;

private:
  std::string length, force;
};
} // namespace snug

#endif
