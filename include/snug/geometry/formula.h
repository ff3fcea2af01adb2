#ifndef snug_geometry_formula_h
#define snug_geometry_formula_h

#include <deal.II/base/point.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace snug {
class SectionCheck;
}

namespace dealii {
template <int dim>
class FunctionParser;
}

namespace snug::geometry {
/**
 * A muParser formula of the coordinates x, y (2D) or x, y, z (3D), as
 * users write it in an entry of the parameter file.
 */
template <int dim>
class Formula
{
public:
  /**
   * Parse @p text, found in the entry called @p entry.
   * @throws InputError naming entry, formula and the error message of the parser.
   */
  Formula(const std::string &entry, const std::string &text);
  ~Formula();
  Formula(Formula &&) noexcept;

  /// Return the value at @p point. @throws InputError if the value is not finite.
  double value(const dealii::Point<dim> &point) const;

  /// Return the first and second derivatives by central differences of sixth order
  /// over distances up to 3 @p step. The error of a first derivative is about
  /// step^6/140 times the seventh derivative plus eps/step times the value. The error of a second
  /// derivative is about step^6/560 times the eighth derivative plus 4 eps/step^2 times the value.
  dealii::Tensor<1, dim> gradient(const dealii::Point<dim> &point, double step) const;
  dealii::Tensor<2, dim> hessian(const dealii::Point<dim> &point, double step) const;

private:
  std::string                                  entry, text;
  std::unique_ptr<dealii::FunctionParser<dim>> parser;
};

/// A muParser formula of named variables, of which it may contain at most four.
class VariableFormula
{
public:
  /// Parse @p text, found in the entry called @p entry. @throws InputError as Formula does.
  VariableFormula(const std::string              &entry,
                  const std::string              &text,
                  const std::vector<std::string> &variables);
  ~VariableFormula();
  VariableFormula(VariableFormula &&) noexcept;

  /// Return whether the formula contains a variable, given by its index.
  bool contains(unsigned int variable) const;

  /// Return the value for the values of all variables. @throws InputError naming the @p place if
  /// the value is not finite.
  double value(const std::vector<double> &values, const dealii::Tensor<1, 3> &place) const;

private:
  std::string                                entry, text;
  std::vector<unsigned int>                  contained; ///< indices of the variables
  std::unique_ptr<dealii::FunctionParser<3>> parser;
};

/// Return the value of a formula without variables, or nothing if @p text is no such formula or its
/// value is not finite.
std::optional<double> constant_value(const std::string &text);

/// Check that @p formula is a formula of the coordinates of the scene. @p formula is @p value or a
/// part of @p value. @throws InputError
void require_formula(const SectionCheck &section,
                     const std::string  &entry,
                     const std::string  &value,
                     const std::string  &formula);
} // namespace snug::geometry

#endif
