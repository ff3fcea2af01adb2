#ifndef snug_base_entries_h
#define snug_base_entries_h

#include <snug/base/choice.h>
#include <snug/base/statements.h>
#include <snug/base/values.h>

#include <functional>
#include <iosfwd>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace snug {
/// Interval of numbers.
struct Interval
{
  double lower     = -std::numeric_limits<double>::infinity();
  double upper     = std::numeric_limits<double>::infinity();
  bool   has_lower = true, has_upper = true; ///< whether the bound is in the interval

  bool contains(double value) const
  {
    return (has_lower ? value >= lower : value > lower) &&
           (has_upper ? value <= upper : value < upper);
  }
};

inline Names names(ValueType)
{
  return {{"a text, a number, true or false"},
          {"a number"},
          {"a whole number"},
          {"true or false"},
          {"a list of numbers"},
          {"a list of whole numbers"},
          {"a list of texts"}};
}

/// Values that an entry accepts.
struct Form
{
  ValueType                type     = ValueType::text;
  std::string              allowed  = {}; ///< completes "must be "; "": follows from the type
  std::vector<std::string> choices  = {}; ///< if the entry is a choice
  TextMap                  renamed  = {}; ///< choices by the names that they had earlier
  Names                    meanings = {}; ///< of values, or of forms of values
  Interval                 interval = {}; ///< contains every number of the value
  std::string              range    = {}; ///< "must be positive", if it does not
  /// "numbers": one per dimension, or an empty list; "": any number of numbers
  std::string per_dimension = {};
};

/// @name Forms of entries
/// @{
/// Return a form described by @p allowed; the from_text() of the value decides.
Form allowed(const std::string &description);

/// Return a form for one of the given names, those of an enum or of a factory table. Tables for
/// 2D and 3D have the same names; the one for 3D is passed.
Form choice(const Names &names);

/// Return a form for "auto", with this meaning, or a value of the enum E.
template <typename E>
Form choice_or_auto(const std::string &meaning)
{
  Names all = names(E());
  all.insert(all.begin(), {"auto", meaning});
  return choice(all);
}

/// Return @p form with the meanings of values, or of forms of values. They are listed below the
/// table of parameters.
Form with_meanings(Form form, const Names &meanings);

/// Return the form "must be positive".
Form positive();
/// Return the form "must be at least 1", or the text @p range.
Form at_least(double lower, const std::string &range = "");
/// Return the form "must be at most 15".
Form at_most(double upper);
/// Return the form "must lie between 1 and 10", inclusively.
Form between(double lower, double upper);
/// Return the form "must be above 0 and at most 0.1", or "must be above 0".
Form above(double lower, double upper = std::numeric_limits<double>::infinity());
/// Return the form "must be above -1 and below 0.5".
Form inside(double lower, double upper);
/// Return the form of lists with one number per dimension of the scene, or without numbers.
Form per_dimension(Form form = {}, const std::string &what = "numbers separated by commas");
/// @}

/// Return the values that an entry of a type accepts, unless its form specifies more.
template <typename T>
const char *allowed_of()
{
  if constexpr (std::is_same_v<T, double>)
    return "a number";
  if constexpr (std::is_same_v<T, unsigned int>)
    return "a whole number";
  if constexpr (std::is_same_v<T, bool>)
    return "true or false";
  if constexpr (std::is_same_v<T, std::vector<double>>)
    return "numbers separated by commas or blanks";
  if constexpr (std::is_same_v<T, std::vector<unsigned int>>)
    return "whole numbers of at least 1 separated by commas or blanks";
  if constexpr (std::is_same_v<T, std::vector<std::string>>)
    return "names separated by commas";
  return "text";
}

/// Return the type of an entry whose variable has the type T.
template <typename T>
ValueType type_of()
{
  if constexpr (std::is_same_v<T, double>)
    return ValueType::number;
  if constexpr (std::is_same_v<T, unsigned int>)
    return ValueType::whole_number;
  if constexpr (std::is_same_v<T, bool>)
    return ValueType::boolean;
  if constexpr (std::is_same_v<T, std::vector<double>>)
    return ValueType::numbers;
  if constexpr (std::is_same_v<T, std::vector<unsigned int>>)
    return ValueType::whole_numbers;
  if constexpr (std::is_same_v<T, std::vector<std::string>>)
    return ValueType::names;
  return ValueType::text;
}

/// Return the range of @p form to be appended to the values of a type: ", at least 1".
std::string range_of(const Form &form);

/// Functions that read, write and check the variable of an entry.
struct Access
{
  std::function<std::string()>             text;
  std::function<void(const std::string &)> assign;
  std::function<std::vector<double>()>     numbers = {}; ///< numbers in the variable; empty: none
};

/// Return the access to a variable with a to_text() and a from_text(); lists may have a separator.
template <typename T, typename... Separator>
Access access(T &value, const Separator... separator)
{
  Access result{[&value, separator...]() { return to_text(value, separator...); },
                [&value, separator...](const std::string &text) {
                  from_text(text, value, separator...);
                }};
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, unsigned int>)
    result.numbers = [&value]() { return std::vector<double>{double(value)}; };
  if constexpr (std::is_same_v<T, std::vector<double>> ||
                std::is_same_v<T, std::vector<unsigned int>>)
    result.numbers = [&value]() { return std::vector<double>(value.begin(), value.end()); };
  if constexpr (std::is_same_v<T, VectorMap>)
    result.numbers = [&value]() {
      std::vector<double> numbers;
      for (const auto &[key, vector] : value)
        numbers.insert(numbers.end(), vector.begin(), vector.end());
      return numbers;
    };
  return result;
}

/// Give access to a whole number, which is 0 for the text "auto".
Access count_or_auto(unsigned int &number);

/**
 * The entries of a parameter file, each bound to the variable that it sets. The class stores the
 * name, default, form, range and meaning of each entry. A parameter is declared only once, by the
 * module that reads it. The variables must outlive this object.
 */
class Entries
{
public:
  struct Description
  {
    std::string section; ///< "" for the top
    std::string name;
    std::string initial; ///< value at the time of declaration
    Form        form;
    std::string meaning;
    Access      access;

    std::string path() const { return section.empty() ? name : section + "/" + name; }
  };

  struct Section
  {
    std::string name, meaning;
  };

  /// Begin a subsection. Entries added after this call belong to it.
  void begin_section(const std::string &name, const std::string &meaning);

  void
  add(const std::string &name, const Access &access, const Form &form, const std::string &meaning);

  template <typename T>
  void add(const std::string &name, T &value, const std::string &meaning)
  {
    if constexpr (std::is_enum_v<T>)
      add(name, value, choice(names(value)), meaning);
    else
      add(name, value, Form(), meaning);
  }

  template <typename T>
  void add(const std::string &name, T &value, Form form, const std::string &meaning)
  {
    if (form.allowed.empty())
      form.allowed = std::string(allowed_of<T>()) + range_of(form);
    form.type = type_of<T>();
    if (std::is_same_v<T, bool>)
      form.choices = {"true", "false"};
    add(name, snug::access(value), form, meaning);
  }

  /// Assign a value, or nothing if the statement only opens a subsection.
  /// @throws InputError, one line, if there is no such entry or subsection, or if the value has
  /// the wrong form.
  void set(const Statement &statement);

  /// Check every value.
  /// @throws InputError unless every value has the form and the range of its entry, in a scene of
  /// @p dimension dimensions.
  void check(const Origins &origins, unsigned int dimension) const;

  /// Write every entry with its value, readable by parse_statements().
  void print(std::ostream &out) const;

  const std::vector<Section> &sections() const { return section_list; }

  const std::vector<Description> &descriptions() const { return list; }

private:
  /// Throw, unless the statement only opens an existing subsection.
  void reject_unknown(const Statement &statement) const;

  std::vector<Section>     section_list = {{"", ""}};
  std::vector<Description> list;
};
} // namespace snug

#endif
