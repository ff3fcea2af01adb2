#include <snug/io/spline_surface.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace snug::io {
namespace {
/// Weight of the second differences of control points, as part of the mean weight of the points of
/// the face. The second differences move the surface by less than this part of their size.
const double smoothing = 1e-9;

const unsigned int n_random     = 10; ///< points per span
const unsigned int closed_spans = 8;  ///< of a closed axis at the beginning

/// Return the breaks of spans that are divided into @p parts.
std::vector<double> divided(const std::vector<double>       &breaks,
                            const std::vector<unsigned int> &parts)
{
  std::vector<double> result = {breaks.front()};
  for (unsigned int i = 0; i + 1 < breaks.size(); ++i)
    for (unsigned int k = 1; k <= parts[i]; ++k)
      result.push_back(k == parts[i] ? breaks[i + 1]
                                     : breaks[i] + (breaks[i + 1] - breaks[i]) * k / parts[i]);
  return result;
}

/// This class fits a surface to a face and measures the deviation of the surface.
template <int dim>
class Fit
{
public:
  using Flat   = dealii::Tensor<1, dim - 1>;
  using Vector = dealii::Tensor<1, dim>;
  using Rows   = typename SplineSurface<dim>::Rows;

  explicit Fit(const CoordinatePoints<dim> &face) : face(face)
  {
    for (unsigned int a = 0; a < dim - 1; ++a)
      {
        std::vector<double> breaks;
        for (unsigned int i = 0; i <= closed_spans; ++i)
          breaks.push_back(double(i) / closed_spans);
        if (!face.closed[a])
          breaks = {0., 1.};
        surface.axes.emplace_back(breaks, surface.degree, face.closed[a]);
      }
  }

  SplineSurface<dim> surface;

  void solve();
  /// Measure the deviation of each span.
  void measure();
  /// Return the surface with the spans that deviate by more than @p tolerance divided into at most
  /// @p most_parts. The control points are points of the surface at the Greville abscissae, from
  /// which solve() starts.
  SplineSurface<dim> refined(double tolerance, unsigned int most_parts) const;

private:
  struct Data
  {
    Rows                rows; ///< values of the functions
    std::vector<Vector> targets;
  };

  const CoordinatePoints<dim> &face;
  std::vector<double>          deviations; ///< per span, the first axis fastest

  unsigned int              n_spans() const;
  std::vector<unsigned int> indices_of_span(unsigned int span) const;
  Flat                      in_span(unsigned int span, const Flat &part) const;
  Flat                      as_lengths(const Flat &fractions) const;
  Data                      data() const;
  double
  jump(unsigned int span, unsigned int axis, const std::vector<shape::Combination> &thirds) const;
};

template <int dim>
unsigned int Fit<dim>::n_spans() const
{
  unsigned int result = 1;
  for (unsigned int a = 0; a < dim - 1; ++a)
    result *= surface.n_spans(a);
  return result;
}

template <int dim>
std::vector<unsigned int> Fit<dim>::indices_of_span(unsigned int span) const
{
  std::vector<unsigned int> result;
  for (unsigned int a = 0; a < dim - 1; ++a)
    {
      result.push_back(span % surface.n_spans(a));
      span /= surface.n_spans(a);
    }
  return result;
}

/// Return the fractions of a point of a span, given by its part of the span along each axis.
template <int dim>
typename Fit<dim>::Flat Fit<dim>::in_span(const unsigned int span, const Flat &part) const
{
  const auto indices = indices_of_span(span);
  Flat       result;
  for (unsigned int a = 0; a < dim - 1; ++a)
    {
      const auto breaks = surface.axes[a].breaks();
      result[a] = breaks[indices[a]] + part[a] * (breaks[indices[a] + 1] - breaks[indices[a]]);
    }
  return result;
}

template <int dim>
typename Fit<dim>::Flat Fit<dim>::as_lengths(const Flat &fractions) const
{
  Flat result;
  for (unsigned int a = 0; a < dim - 1; ++a)
    result[a] = fractions[a] * face.range[a];
  return result;
}

/// Return the functions and the positions at the Gauss points on the face.
template <int dim>
typename Fit<dim>::Data Fit<dim>::data() const
{
  Data       result;
  const auto gauss = dealii::QGauss<dim - 1>(surface.degree + 1).get_points();
  for (unsigned int span = 0; span < n_spans(); ++span)
    for (const auto &part : gauss)
      {
        const Flat at = in_span(span, part);
        if (const auto x = face.point(as_lengths(at)))
          {
            result.rows.push_back(surface.functions(at));
            result.targets.push_back(*x);
          }
      }
  return result;
}

/// Solve the normal equations (N'N + smoothing R'R) c = N'x by conjugate gradients, which start
/// from the control points of the coarser surface.
template <int dim>
void Fit<dim>::solve()
{
  const Data points = data();
  Vector     centre;
  for (const auto &x : points.targets)
    centre += x / double(points.targets.size());
  surface.points.resize(surface.n_points(), centre); // of a coarser surface: no change
  const auto                     smooth_rows = surface.second_differences();
  const unsigned int             n           = surface.points.size();
  dealii::DynamicSparsityPattern pattern(n);
  for (const Rows *all : {&points.rows, &smooth_rows})
    for (const auto &row : *all)
      for (const auto &i : row)
        for (const auto &j : row)
          pattern.add(i.first, j.first);
  dealii::SparsityPattern compressed;
  compressed.copy_from(pattern);
  dealii::SparseMatrix<double>        A(compressed);
  std::vector<dealii::Vector<double>> b(dim, dealii::Vector<double>(n));
  for (unsigned int r = 0; r < points.rows.size(); ++r)
    for (const auto &[i, value] : points.rows[r])
      {
        for (unsigned int d = 0; d < dim; ++d)
          b[d](i) += value * (points.targets[r][d] - centre[d]);
        for (const auto &[j, other] : points.rows[r])
          A.add(i, j, value * other);
      }
  double weight = 0.;
  for (unsigned int i = 0; i < n; ++i)
    weight += smoothing * A.diag_element(i) / n;
  for (const auto &row : smooth_rows)
    for (const auto &[i, value] : row)
      for (const auto &[j, other] : row)
        A.add(i, j, weight * value * other);
  dealii::PreconditionSSOR<dealii::SparseMatrix<double>> preconditioner;
  preconditioner.initialize(A, 1.2);
  double size = 0.;
  for (const auto &one : b)
    size = std::max(size, one.l2_norm());
  for (unsigned int d = 0; d < dim; ++d)
    {
      dealii::Vector<double> x(n);
      for (unsigned int i = 0; i < n; ++i)
        x(i) = surface.points[i][d] - centre[d];
      // The iterations that remain change control points far from the face.
      dealii::IterationNumberControl control(500, 1e-13 * size);
      dealii::SolverCG<>(control).solve(A, x, b[d], preconditioner);
      for (unsigned int i = 0; i < n; ++i)
        surface.points[i][d] = x(i) + centre[d];
    }
}

template <int dim>
void Fit<dim>::measure()
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> uniform(0., 1.);
  deviations.assign(n_spans(), 0.);
  for (unsigned int span = 0; span < deviations.size(); ++span)
    for (unsigned int k = 0; k < n_random; ++k)
      {
        Flat part;
        for (unsigned int a = 0; a < dim - 1; ++a)
          part[a] = uniform(random);
        const Flat at = in_span(span, part);
        if (const auto x = face.point(as_lengths(at)))
          deviations[span] = std::max(deviations[span], surface.distance(*x, at));
      }
  surface.deviation = *std::max_element(deviations.begin(), deviations.end());
}

/// Return the maximum jump of the third derivative along an axis at the ends of a span, times the
/// third power of the length of the span: the size of the error that the span adds along the axis.
/// An axis of one span has an infinite jump. @p thirds are the third derivatives of the spans.
template <int dim>
double Fit<dim>::jump(const unsigned int                     span,
                      const unsigned int                     axis,
                      const std::vector<shape::Combination> &thirds) const
{
  const auto        &spline  = surface.axes[axis];
  const auto         breaks  = spline.breaks();
  const auto         indices = indices_of_span(span);
  const unsigned int own = indices[axis], n = breaks.size() - 1;
  if (n == 1)
    return std::numeric_limits<double>::infinity();
  Flat middle;
  for (unsigned int a = 0; a < dim - 1; ++a)
    middle[a] = 0.5;
  const Flat at = in_span(span, middle);
  // The functions of the other axis at the middle of the span, with the strides of both axes.
  const unsigned int                           other  = dim - 2 - axis;
  unsigned int                                 stride = 1, other_stride = 1;
  std::vector<std::pair<unsigned int, double>> across = {{0, 1.}};
  if (dim == 3)
    {
      (axis == 0 ? other_stride : stride) = surface.axes[0].n();
      across.clear();
      const auto values = surface.axes[other].values(at[other]);
      for (unsigned int k = 0; k < values.second.size(); ++k)
        across.emplace_back((values.first + k) % surface.axes[other].n() * other_stride,
                            values.second[k]);
    }
  const auto third = [&](const unsigned int i) {
    Vector result;
    for (const auto &[point, weight] : thirds[i % n])
      for (const auto &[place, value] : across)
        result += weight * value * surface.points[point * stride + place];
    return result;
  };
  double result = 0.;
  if (own > 0 || spline.is_closed())
    result = std::max(result, (third(own) - third(own + n - 1)).norm());
  if (own + 1 < n || spline.is_closed())
    result = std::max(result, (third(own + 1) - third(own)).norm());
  return result * std::pow(breaks[own + 1] - breaks[own], 3);
}

template <int dim>
SplineSurface<dim> Fit<dim>::refined(const double tolerance, const unsigned int most_parts) const
{
  std::vector<std::vector<unsigned int>>       parts;
  std::vector<std::vector<shape::Combination>> thirds;
  for (const auto &axis : surface.axes)
    {
      parts.emplace_back(axis.breaks().size() - 1, 1);
      thirds.push_back(axis.derivative(surface.degree));
    }
  for (unsigned int span = 0; span < deviations.size(); ++span)
    {
      if (deviations[span] <= tolerance)
        continue;
      // The error of a smooth curve decreases with the fourth power of the length of the span.
      const unsigned int wanted =
        std::clamp(std::ceil(std::pow(1.5 * deviations[span] / tolerance, 0.25)), 2.,
                   double(most_parts));
      std::vector<double> jumps;
      for (unsigned int a = 0; a < dim - 1; ++a)
        jumps.push_back(jump(span, a, thirds[a]));
      const double most    = *std::max_element(jumps.begin(), jumps.end());
      const auto   indices = indices_of_span(span);
      for (unsigned int a = 0; a < dim - 1; ++a)
        if (jumps[a] >= 0.1 * most)
          parts[a][indices[a]] = std::max(parts[a][indices[a]], wanted);
    }
  SplineSurface<dim> finer;
  for (unsigned int a = 0; a < dim - 1; ++a)
    finer.axes.emplace_back(divided(surface.axes[a].breaks(), parts[a]), surface.degree,
                            face.closed[a]);
  for (unsigned int i = 0; i < finer.n_points(); ++i)
    {
      Flat         at;
      unsigned int rest = i;
      for (unsigned int a = 0; a < dim - 1; rest /= finer.axes[a].n(), ++a)
        at[a] = std::clamp(finer.axes[a].greville(rest % finer.axes[a].n()), 0., 1.);
      finer.points.push_back(surface.value(at));
    }
  return finer;
}
} // namespace

template <int dim>
SplineSurface<dim> fit_splines(const CoordinatePoints<dim> &face,
                               const double                 tolerance,
                               const unsigned int           most_points)
{
  Fit<dim>           fit(face);
  SplineSurface<dim> best;
  while (true)
    {
      fit.solve();
      fit.measure();
      if (best.points.empty() || fit.surface.deviation < best.deviation)
        best = fit.surface;
      if (fit.surface.deviation <= tolerance)
        return best;
      auto finer = fit.refined(tolerance, 4);
      if (finer.points.size() > most_points)
        finer = fit.refined(tolerance, 2);
      if (finer.points.size() > most_points)
        return best;
      fit.surface = finer;
    }
}

template SplineSurface<2> fit_splines(const CoordinatePoints<2> &, double, unsigned int);
template SplineSurface<3> fit_splines(const CoordinatePoints<3> &, double, unsigned int);
} // namespace snug::io
