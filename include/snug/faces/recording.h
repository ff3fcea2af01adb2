#ifndef snug_faces_recording_h
#define snug_faces_recording_h

#include <snug/faces/differential.h>

#include <deal.II/base/tensor.h>

#include <type_traits>
#include <vector>

namespace snug::faces {
struct Recorded;
} // namespace snug::faces

namespace dealii {
/// Allow recorded numbers in tensors.
template <>
struct EnableIfScalar<snug::faces::Recorded>
{
  using type = snug::faces::Recorded;
};
} // namespace dealii

namespace snug::faces {
/**
 * This class records the operations of a computation, for the reverse mode of algorithmic
 * differentiation (Griewank, Walther, Evaluating Derivatives, SIAM, 2008). Functions templated on
 * their number type compute with Recorded numbers. From the derivatives of a scalar with respect to
 * their results, sweep() computes its derivatives with respect to all variables at once, in a time
 * that does not depend on the number of variables.
 */
class Recording
{
public:
  /// Disable copying, because recorded numbers refer to their recording.
  Recording()                             = default;
  Recording(const Recording &)            = delete;
  Recording &operator=(const Recording &) = delete;

  /// Return a new independent variable.
  Recorded variable(double value);

  /// Return the result of an operation on @p a and @p b, constants or numbers of one recording,
  /// with its derivatives with respect to both. This function is not inline, because the rows of
  /// nodal contact would take a sixth longer to compile.
  static Recorded
  operation(double value, const Recorded &a, double by_a, const Recorded &b, double by_b);

  /// Return sum_k factors(k) numbers(k) of @p n numbers, which is one step however many they are.
  template <typename Factors, typename Numbers>
  static Recorded combination(unsigned int n, const Factors &factors, const Numbers &numbers);

  /// Add @p derivative to the derivative of the scalar with respect to @p x.
  void add(const Recorded &x, double derivative);

  template <int dim>
  void add(const dealii::Tensor<1, dim, Recorded> &x, const dealii::Tensor<1, dim> &derivative)
  {
    for (int d = 0; d < dim; ++d)
      add(x[d], derivative[d]);
  }

  /// Return the derivative of the scalar with respect to @p x, as far as it is known.
  double derivative(const Recorded &x) const;

  /// Return the number of steps, for sweep().
  std::size_t size() const { return steps.size(); }

  /// Complete the derivatives of the first @p begin steps by those of all later steps, and remove
  /// the latter. So parts of a sum may be recorded and removed one after the other.
  void sweep_to(std::size_t begin)
  {
    sweep(begin);
    steps.resize(begin);
    operands.resize(first_operand(begin));
  }

  /// Complete the derivatives of all steps.
  void sweep(std::size_t begin = 0)
  {
    for (std::size_t i = steps.size(); i-- > begin;)
      if (const double derivative = steps[i].derivative; derivative != 0.)
        for (std::size_t k = first_operand(i); k < steps[i].last_operand; ++k)
          steps[operands[k].step].derivative += operands[k].factor * derivative;
  }

  /// Remove all steps.
  void clear()
  {
    steps.clear();
    operands.clear();
  }

private:
  struct Step
  {
    unsigned int last_operand; ///< end of the operands of this step, which begin where those of
                               ///< the step before end
    double derivative = 0.;    ///< of the scalar with respect to the result of this step
  };

  /// An operand of a step and the derivative of the step's result with respect to it.
  struct Operand
  {
    unsigned int step;
    double       factor;
  };

  std::vector<Step>    steps;
  std::vector<Operand> operands;

  std::size_t first_operand(std::size_t step) const
  {
    return step == 0 ? 0 : steps[step - 1].last_operand;
  }

  /// Add a step with the operands that have been added since the last one.
  Recorded add_step(double value);
};

/// A number whose operations are recorded, or a constant.
struct Recorded
{
  double       value     = 0.;
  Recording   *recording = nullptr; ///< nullptr: constant
  unsigned int step      = 0;

  Recorded() = default;

  /// Construct a constant.
  Recorded(double value) : value(value) {}

  Recorded(double value, Recording *recording, unsigned int step)
    : value(value), recording(recording), step(step)
  {}

  Recorded &operator+=(const Recorded &b) { return *this = *this + b; }

  Recorded &operator-=(const Recorded &b) { return *this = *this - b; }

  Recorded &operator*=(const Recorded &b) { return *this = *this * b; }

  Recorded &operator/=(const Recorded &b) { return *this = *this / b; }

  friend Recorded operator+(const Recorded &a, const Recorded &b)
  {
    return Recording::operation(a.value + b.value, a, 1., b, 1.);
  }

  friend Recorded operator-(const Recorded &a, const Recorded &b)
  {
    return Recording::operation(a.value - b.value, a, 1., b, -1.);
  }

  friend Recorded operator-(const Recorded &a) { return a * -1.; }

  friend Recorded operator*(const Recorded &a, const Recorded &b)
  {
    return Recording::operation(a.value * b.value, a, b.value, b, a.value);
  }

  friend Recorded operator/(const Recorded &a, const Recorded &b)
  {
    const double ratio = a.value / b.value;
    return Recording::operation(ratio, a, 1. / b.value, b, -ratio / b.value);
  }

  friend Recorded sqrt(const Recorded &a)
  {
    const double root = std::sqrt(a.value);
    return Recording::operation(root, a, 0.5 / root, {}, 0.);
  }
};

inline double value_of(const Recorded &a)
{
  return a.value;
}

template <typename Factors, typename Numbers>
Recorded
Recording::combination(const unsigned int n, const Factors &factors, const Numbers &numbers)
{
  Recording *recording = nullptr;
  double     value     = 0.;
  for (unsigned int k = 0; k < n; ++k)
    {
      const Recorded &number = numbers(k);
      value += factors(k) * number.value;
      if (!number.recording)
        continue;
      recording = number.recording;
      recording->operands.push_back({number.step, factors(k)});
    }
  return recording ? recording->add_step(value) : Recorded(value);
}

/// Return sum_k factors(k) numbers(k) of @p n numbers of a type; numbers(k) must not compute.
template <typename Number, typename Factors, typename Numbers>
Number combination(const unsigned int n, const Factors &factors, const Numbers &numbers)
{
  if constexpr (std::is_same<Number, Recorded>::value)
    return Recording::combination(n, factors, numbers);
  Number sum = 0.;
  for (unsigned int k = 0; k < n; ++k)
    sum += factors(k) * numbers(k);
  return sum;
}

inline void Recording::add(const Recorded &x, const double derivative)
{
  if (x.recording)
    steps[x.step].derivative += derivative;
}

inline double Recording::derivative(const Recorded &x) const
{
  return x.recording ? steps[x.step].derivative : 0.;
}
} // namespace snug::faces

#endif
