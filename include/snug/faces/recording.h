#ifndef snug_faces_recording_h
#define snug_faces_recording_h

#include <snug/faces/differential.h>

#include <deal.II/base/tensor.h>

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
  /// with its derivatives with respect to both.
  static Recorded
  operation(double value, const Recorded &a, double by_a, const Recorded &b, double by_b);

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
  }

  /// Complete the derivatives of all steps.
  void sweep(std::size_t begin = 0)
  {
    for (std::size_t i = steps.size(); i-- > begin;)
      {
        const Step &step = steps[i];
        if (step.derivative != 0.)
          {
            steps[step.a].derivative += step.by_a * step.derivative;
            steps[step.b].derivative += step.by_b * step.derivative;
          }
      }
  }

  /// Remove all steps.
  void clear() { steps.clear(); }

private:
  struct Step
  {
    unsigned int a, b; ///< steps of the operands
    double       by_a, by_b;
    double       derivative = 0.; ///< of the scalar with respect to the result of this step
  };

  std::vector<Step> steps;
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

inline Recorded Recording::variable(const double value)
{
  const unsigned int step = steps.size();
  steps.push_back({step, step, 0., 0.});
  return {value, this, step};
}

inline Recorded Recording::operation(const double    value,
                                     const Recorded &a,
                                     const double    by_a,
                                     const Recorded &b,
                                     const double    by_b)
{
  Recording *const recording = a.recording ? a.recording : b.recording;
  if (!recording)
    return value;
  // A constant counts as the other operand, with the derivative 0.
  recording->steps.push_back({a.recording ? a.step : b.step, b.recording ? b.step : a.step,
                              a.recording ? by_a : 0., b.recording ? by_b : 0.});
  return {value, recording, static_cast<unsigned int>(recording->steps.size() - 1)};
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
