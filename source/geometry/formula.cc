#include <snug/base/section_check.h>
#include <snug/geometry/formula.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

namespace snug::geometry {
namespace {
/// This class silences std::cerr, because deal.II 9.4 prints each parser error to std::cerr on
/// every rank before throwing the error.
class SilentErrors
{
public:
  SilentErrors() : saved(std::cerr.rdbuf(nullptr)) {}

  ~SilentErrors()
  {
    std::cerr.rdbuf(saved);
    std::cerr.clear();
  }

  SilentErrors(const SilentErrors &)            = delete;
  SilentErrors &operator=(const SilentErrors &) = delete;

private:
  std::streambuf *saved;
};

/// Return the message of muParser within the message of deal.II, in one line.
std::string parser_message(const dealii::ExceptionBase &error)
{
  std::ostringstream stream;
  error.print_info(stream);
  std::string       message = stream.str();
  const std::string mark    = "The parser said: ";
  const auto        found   = message.find(mark);
  if (found == std::string::npos)
    return "not a single formula";
  message = message.substr(found + mark.size());
  return message.substr(0, message.find_last_not_of(" .\n") + 1);
}
/// Return f'(0) by central differences of sixth order,
/// with the weights (45, -9, 1) / 60 h (B. Fornberg, Math. Comp. 51, 1988).
template <typename Function>
double difference(const Function &f, const double h)
{
  const double weights[] = {45., -9., 1.};
  double       sum       = 0.;
  for (unsigned int k = 1; k <= 3; ++k)
    sum += weights[k - 1] * (f(k * h) - f(-(k * h)));
  return sum / (60. * h);
}

/// Return f''(0) by central differences of sixth order,
/// with the weights (-490; 270, -27, 2) / 180 h^2 (ibid.).
template <typename Function>
double second_difference(const Function &f, const double h)
{
  const double weights[] = {270., -27., 2.};
  double       sum       = -490. * f(0.);
  for (unsigned int k = 1; k <= 3; ++k)
    sum += weights[k - 1] * (f(k * h) + f(-(k * h)));
  return sum / (180. * h * h);
}

/// Constants that formulas may contain.
const std::map<std::string, double> constants = {{"pi", dealii::numbers::PI}};

/// Return the identifiers in a formula. The e of a number is none.
std::set<std::string> identifiers(const std::string &text)
{
  const auto is_letter = [](const unsigned char c) { return std::isalpha(c) != 0 || c == '_'; };
  const auto is_part = [&](const unsigned char c) { return is_letter(c) || std::isdigit(c) != 0; };
  std::set<std::string> result;
  for (auto begin = text.begin(); begin != text.end();)
    {
      const auto end = std::find_if_not(begin, text.end(), is_part);
      if (begin != end && is_letter(*begin))
        result.insert({begin, end});
      begin = end == begin ? begin + 1 : end;
    }
  return result;
}

/// Return whether a comma is outside of the parentheses of a function. For muParser, such commas
/// separate expressions, and the value of "0,5" is the last one, 5.
bool has_stray_comma(const std::string &text)
{
  std::vector<bool> is_function(1, false); // one per open parenthesis
  char              before = ' ';
  for (const char c : text)
    {
      if (c == '(')
        is_function.push_back(std::isalnum(static_cast<unsigned char>(before)) != 0 ||
                              before == '_');
      else if (c == ')' && is_function.size() > 1)
        is_function.pop_back();
      else if (c == ',' && !is_function.back())
        return true;
      if (std::isspace(static_cast<unsigned char>(c)) == 0)
        before = c;
    }
  return false;
}

/// Make @p parser the parser of the formula @p text of @p variables, with the time as the last
/// variable if @p has_time. Return what is wrong with the formula, or nothing.
template <int dim>
std::optional<std::string> compile(dealii::FunctionParser<dim> &parser,
                                   const std::string           &variables,
                                   const std::string           &text,
                                   const bool                   has_time = false)
{
  if (has_stray_comma(text))
    return "a comma may only separate the arguments of a function" + decimal_point_hint(text);
  try
    {
      const SilentErrors guard;
      parser.initialize(variables, text, constants, has_time);
      // The formula is evaluated once, because muParser finds unknown names only on evaluation.
      parser.value(dealii::Point<dim>());
      return {};
    }
  catch (const dealii::ExceptionBase &error)
    {
      return parser_message(error);
    }
}

/// Throw if there is an @p error of a formula of @p variables.
void require_compiled(const std::string                &entry,
                      const std::string                &text,
                      const std::string                &variables,
                      const std::optional<std::string> &error)
{
  if (error)
    throw bad_entry(entry, text, "must be a formula of " + variables + " (" + *error + ")");
}

/// For 1/0 or sqrt(-1), muParser returns inf or nan without an error. Values beyond 1e60 would
/// overflow in later computations. @throws InputError
template <int dim>
void require_finite(const std::string            &entry,
                    const std::string            &text,
                    const double                  value,
                    const dealii::Tensor<1, dim> &place)
{
  if (std::abs(value) <= 1e60)
    return;
  std::ostringstream where;
  where << "must be finite everywhere, at most 1e60 in size, but is not at (" << place << ")";
  throw bad_entry(entry, text, where.str());
}
} // namespace

std::optional<double> constant_value(const std::string &text)
{
  dealii::FunctionParser<1> parser;
  // The parser needs a variable. Its name must not occur in users' formulas.
  if (compile(parser, "no_variable", text))
    return std::nullopt;
  const double value = parser.value(dealii::Point<1>());
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

template <int dim>
Formula<dim>::Formula(const std::string &entry, const std::string &text)
  : entry(entry), text(text), parser(std::make_unique<dealii::FunctionParser<dim>>())
{
  const std::string variables = dim == 2 ? "x,y" : "x,y,z";
  require_compiled(entry, text, variables, compile(*parser, variables, text));
}

// The destructor is defined in this file, because dealii::FunctionParser is complete only here.
template <int dim>
Formula<dim>::~Formula() = default;

template <int dim>
Formula<dim>::Formula(Formula &&) noexcept = default;

template <int dim>
double Formula<dim>::value(const dealii::Point<dim> &point) const
{
  const double value = parser->value(point);
  require_finite<dim>(entry, text, value, point);
  return value;
}

template <int dim>
dealii::Tensor<1, dim> Formula<dim>::gradient(const dealii::Point<dim> &point,
                                              const double              step) const
{
  dealii::Tensor<1, dim> result;
  for (unsigned int i = 0; i < dim; ++i)
    result[i] = difference(
      [&](const double t) {
        dealii::Point<dim> p = point;
        p[i] += t;
        return value(p);
      },
      step);
  return result;
}

template <int dim>
dealii::Tensor<2, dim> Formula<dim>::hessian(const dealii::Point<dim> &point,
                                             const double              step) const
{
  dealii::Tensor<2, dim> result;
  for (unsigned int i = 0; i < dim; ++i)
    {
      const auto along = [&](const double t) {
        dealii::Point<dim> p = point;
        p[i] += t;
        return value(p);
      };
      result[i][i] = second_difference(along, step);
      for (unsigned int j = 0; j < i; ++j)
        // The mixed derivative is a difference of differences and takes 36 values.
        result[i][j] = result[j][i] = difference(
          [&](const double s) {
            return difference(
              [&](const double t) {
                dealii::Point<dim> p = point;
                p[i] += s;
                p[j] += t;
                return value(p);
              },
              step);
          },
          step);
    }
  return result;
}

VariableFormula::VariableFormula(const std::string              &entry,
                                 const std::string              &text,
                                 const std::vector<std::string> &variables)
  : entry(entry), text(text), parser(std::make_unique<dealii::FunctionParser<3>>())
{
  const auto found = identifiers(text);
  for (unsigned int i = 0; i < variables.size(); ++i)
    if (found.count(variables[i]) > 0)
      contained.push_back(i);
  // The parser has three coordinates and the time.
  if (contained.size() > 4)
    throw bad_entry(entry, text, "must contain at most 4 of the variables " + to_text(variables));
  std::string names;
  for (unsigned int k = 0; k < 4; ++k)
    names += (k == 0 ? "" : ",") +
             (k < contained.size() ? variables[contained[k]] : "no_variable_" + std::to_string(k));
  require_compiled(entry, text, to_text(variables), compile(*parser, names, text, true));
}

VariableFormula::~VariableFormula() = default;

VariableFormula::VariableFormula(VariableFormula &&) noexcept = default;

bool VariableFormula::contains(const unsigned int variable) const
{
  return std::find(contained.begin(), contained.end(), variable) != contained.end();
}

double VariableFormula::value(const std::vector<double>  &values,
                              const dealii::Tensor<1, 3> &place) const
{
  dealii::Point<3> point;
  for (unsigned int k = 0; k < contained.size() && k < 3; ++k)
    point[k] = values[contained[k]];
  if (contained.size() == 4)
    parser->set_time(values[contained[3]]);
  const double value = parser->value(point);
  require_finite<3>(entry, text, value, place);
  return value;
}

void require_formula(const SectionCheck &section,
                     const std::string  &entry,
                     const std::string  &value,
                     const std::string  &formula)
{
  try
    {
      if (section.dimension == 2)
        Formula<2>(entry, formula);
      else
        Formula<3>(entry, formula);
    }
  catch (const InputError &error)
    {
      const std::string message = error.what();
      throw section.error(entry, value,
                          (formula == value ? "" : "'" + quotable(formula) + "' ") +
                            message.substr(message.find("must be")));
    }
}

template class Formula<2>;
template class Formula<3>;
} // namespace snug::geometry
