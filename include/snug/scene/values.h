#ifndef snug_scene_values_h
#define snug_scene_values_h

#include <snug/scene/scene.h>

#include <deal.II/base/patterns.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace snug::scene {
using NumberMap = std::map<std::string, double>;
using VectorMap = std::map<std::string, std::vector<double>>;
using TextMap   = std::map<std::string, std::string>;
using TextPairs = std::vector<std::pair<std::string, std::string>>;

/// What an entry accepts: for the machine and for people.
struct Form
{
  std::shared_ptr<const dealii::Patterns::PatternBase> pattern;
  std::string                                          allowed; ///< goes on after "must be "
  std::vector<std::string>                             choices; ///< if it is a choice
};

/// @name The form that belongs to a type
/// @{
Form form_of(double);
Form form_of(unsigned int);
Form form_of(bool);
Form form_of(const std::string &);
Form form_of(const std::vector<double> &);
Form form_of(const std::vector<unsigned int> &);
Form form_of(const NumberMap &);
Form form_of(const VectorMap &);
/// @}

/// One of "a|b|c".
Form choice(const std::string &names);

/// Pairs "key: value", separated by @p separator; described by @p allowed.
Form pairs(const std::string &allowed, char separator = ',');

/// Anything; described by @p allowed.
Form anything(const std::string &allowed);

/// @name Values as text that reads back to exactly the same value
/// @{
std::string to_text(double);
std::string to_text(unsigned int);
std::string to_text(bool);
std::string to_text(const std::string &);
std::string to_text(Task);
std::string to_text(const std::vector<double> &);
std::string to_text(const std::vector<unsigned int> &);
std::string to_text(const NumberMap &);
std::string to_text(const VectorMap &);
std::string to_text(const std::vector<std::string> &);
std::string to_text(const TextMap &, char separator = ',');
std::string to_text(const TextPairs &, char separator = ',');
/// @}

bool all_finite(const std::vector<double> &values);

/// The parts of "0 0 -5*max(x, y)": blanks within parentheses do not count.
std::vector<std::string> components(const std::string &text);

/// Components separated by commas or, where there is none, by blanks.
std::vector<std::string> vector_components(const std::string &text);

/// @name Values from text @throws std::exception if it is malformed
/// @{
void from_text(const std::string &, double &);
void from_text(const std::string &, unsigned int &);
void from_text(const std::string &, bool &);
void from_text(const std::string &, std::string &);
void from_text(const std::string &, Task &);
void from_text(const std::string &, std::vector<double> &);
void from_text(const std::string &, std::vector<unsigned int> &);
void from_text(const std::string &, NumberMap &);
void from_text(const std::string &, VectorMap &);
void from_text(const std::string &, TextMap &, char separator = ',');
void from_text(const std::string &, TextPairs &, char separator = ',');
/// @}
} // namespace snug::scene

#endif
