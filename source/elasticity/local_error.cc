#include <snug/elasticity/local_error.h>
#include <snug/elasticity/pressure_space.h>
#include <snug/elasticity/stress.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>

namespace snug::elasticity {
namespace {
/// The functions b and the Lagrange functions of degree p of one coordinate, with derivatives.
std::array<double, 2> factor(const unsigned int p, const unsigned int i, const double s)
{
  if (i <= p)
    return mesh::lagrange<1, double>(p, i, s);
  if (p == 1)
    return {{s * (1. - s), 1. - 2. * s}};
  return {{s * (1. - s) * (1. - 2. * s), 1. - 6. * s + 6. * s * s}};
}
} // namespace

template <int dim>
HigherFunctions<dim>::HigherFunctions(const unsigned int degree) : degree(degree)
{
  unsigned int n = 1;
  for (int d = 0; d < dim; ++d)
    n *= degree + 2;
  for (unsigned int i = 0; i < n; ++i)
    {
      const auto         of_axes = mesh::node_indices<dim>(degree + 1, i);
      const unsigned int n_b     = std::count(of_axes.begin(), of_axes.end(), degree + 1);
      if (n_b == 1 || (dim == 2 && n_b == 2))
        factors.push_back(of_axes);
    }
}

template <int dim>
std::vector<typename HigherFunctions<dim>::Value>
HigherFunctions<dim>::at(const dealii::Point<dim> &point) const
{
  std::array<std::vector<std::array<double, 2>>, dim> of_axis;
  for (int d = 0; d < dim; ++d)
    for (unsigned int i = 0; i <= degree + 1; ++i)
      of_axis[d].push_back(factor(degree, i, point[d]));
  std::vector<Value> values(size());
  for (unsigned int i = 0; i < size(); ++i)
    {
      values[i].value = 1.;
      for (int d = 0; d < dim; ++d)
        {
          values[i].value *= of_axis[d][factors[i][d]][0];
          values[i].gradient[d] = 1.;
          for (int e = 0; e < dim; ++e)
            values[i].gradient[d] *= of_axis[e][factors[i][e]][d == e ? 1 : 0];
        }
    }
  return values;
}

/// b vanishes at both ends, and of the Lagrange functions all but that of the end.
template <int dim>
bool HigherFunctions<dim>::is_on_face(const unsigned int i, const unsigned int face) const
{
  return factors[i][face / 2] == (face % 2) * degree;
}

namespace {
/// A function of V at a point of a cell in space.
template <int dim>
struct SpaceValue
{
  dealii::Tensor<1, dim> gradient;
  double                 hoop; ///< value / r, or 0
};

/// divergence of function i times the unit vector c
template <int dim>
double divergence(const SpaceValue<dim> &value, const unsigned int c)
{
  return value.gradient[c] + (c == 0 ? value.hoop : 0.);
}

template <int dim>
class CellForm
{
public:
  CellForm(const HigherFunctions<dim>                  &functions,
           const std::vector<mesh::LagrangePoint<dim>> &quadrature,
           const std::vector<dealii::Tensor<1, dim>>   &X,
           const mesh::Idealization                    &idealization)
  {
    for (const auto &shape : quadrature)
      {
        const CellPoint<dim>         point(shape, X, idealization);
        const auto                   inverse = invert(jacobian(shape, X));
        std::vector<SpaceValue<dim>> values;
        for (const auto &f : functions.at(shape.point))
          values.push_back({f.gradient * inverse, f.value * point.inverse_radius});
        at.push_back(values);
        dV.push_back(point.dV);
        xi.push_back(shape.point);
      }
  }

  /// a(e, v), row by row.
  std::vector<double> matrix(const double lambda, const double mu) const
  {
    const unsigned int  n = at[0].size(), size = dim * n;
    std::vector<double> A(size * size, 0.);
    for (unsigned int q = 0; q < at.size(); ++q)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          {
            const auto  &u = at[q][i], &v = at[q][j];
            const double product = u.gradient * v.gradient;
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int d = 0; d < dim; ++d)
                {
                  double value = mu * u.gradient[d] * v.gradient[c] +
                                 lambda * divergence(u, c) * divergence(v, d);
                  if (c == d)
                    value += mu * product;
                  if (c == 0 && d == 0)
                    value += 2. * mu * u.hoop * v.hoop;
                  A[(dim * i + c) * size + dim * j + d] += dV[q] * value;
                }
          }
    return A;
  }

  /// A += factor sum_k c_k c_k', c_k' v = int psi_k div v dV with the functions of a pressure
  /// space.
  void add_projected(const PressureSpace<dim> &pressures,
                     const double              factor,
                     std::vector<double>      &A) const
  {
    const unsigned int n = at[0].size(), size = dim * n;
    for (const auto &psi : pressures.functions())
      {
        std::vector<double> row(size, 0.);
        for (unsigned int q = 0; q < at.size(); ++q)
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int c = 0; c < dim; ++c)
              row[dim * i + c] += psi[q] * dV[q] * divergence(at[q][i], c);
        for (unsigned int i = 0; i < size; ++i)
          for (unsigned int j = 0; j < size; ++j)
            A[i * size + j] += factor * row[i] * row[j];
      }
  }

  std::vector<std::vector<SpaceValue<dim>>> at; ///< [point][function]
  std::vector<double>                       dV;
  std::vector<dealii::Point<dim>>           xi;
};

/// Unit vectors at right angles to @p held, which are orthonormal.
template <int dim>
std::vector<dealii::Tensor<1, dim>> free_directions(std::vector<dealii::Tensor<1, dim>> held)
{
  std::vector<dealii::Tensor<1, dim>> result;
  // From the axis that is farthest from what is there: never a small difference.
  while (held.size() < dim)
    {
      dealii::Tensor<1, dim> best;
      for (unsigned int d = 0; d < dim; ++d)
        {
          dealii::Tensor<1, dim> v;
          v[d] = 1.;
          for (const auto &h : held)
            v -= (h * v) * h;
          if (v.norm() > best.norm() + 1e-3)
            best = v;
        }
      held.push_back(best / best.norm());
      result.push_back(held.back());
    }
  return result;
}
} // namespace

template <int dim>
LocalError<dim>::LocalError(const unsigned int        degree,
                            const mesh::Idealization &idealization,
                            const Formulation         formulation)
  : degree(degree)
  , idealization(idealization)
  , formulation(formulation)
  , element(degree, idealization, formulation)
  , higher(degree)
{
  // Exact for products of functions of degree p + 1 on parallelograms.
  for (const auto &point : mesh::lagrange_gauss_points<dim>(degree + 1))
    {
      quadrature.push_back(mesh::lagrange_point<dim>(degree, point.point));
      quadrature.back().weight = point.weight;
    }
}

template <int dim>
void LocalError<dim>::add_residual(const Nodes    &X,
                                   const Material &material,
                                   const Nodes    &u,
                                   const Nodes    &b,
                                   double         *r) const
{
  const CellForm<dim> form(higher, quadrature, X, idealization);
  const auto          stresses = element.stresses(X, material, u, quadrature);
  for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      for (unsigned int i = 0; i < higher.size(); ++i)
        for (unsigned int c = 0; c < dim; ++c)
          {
            double flux = c == 0 ? stresses[q][2][2] * form.at[q][i].hoop : 0.;
            for (unsigned int d = 0; d < dim; ++d)
              flux += stresses[q][c][d] * form.at[q][i].gradient[d];
            r[dim * i + c] -= form.dV[q] * flux;
          }
      if (!b.empty())
        add_force(quadrature[q].point, form.dV[q] * b[q], r);
    }
}

template <int dim>
typename LocalError<dim>::Nodes LocalError<dim>::quadrature_points(const Nodes &X) const
{
  Nodes points;
  for (const auto &shape : quadrature)
    points.push_back(value(shape, X));
  return points;
}

template <int dim>
void LocalError<dim>::add_force(const dealii::Point<dim>     &point,
                                const dealii::Tensor<1, dim> &force,
                                double                       *r) const
{
  const auto values = higher.at(point);
  for (unsigned int i = 0; i < values.size(); ++i)
    for (unsigned int c = 0; c < dim; ++c)
      r[dim * i + c] += values[i].value * force[c];
}

template <int dim>
std::vector<double> LocalError<dim>::matrix(const Nodes &X, const Material &material) const
{
  const CellForm<dim> form(higher, quadrature, X, idealization);
  const double        mu = material.lame_mu();
  if (formulation == Formulation::standard)
    return form.matrix(lame_lambda(idealization, material), mu);
  auto A = form.matrix(-2. / 3. * mu, mu);
  form.add_projected(PressureSpace<dim>(degree, form.xi, form.dV), material.bulk_modulus(), A);
  return A;
}

/// In coordinates y of the space along which V is free, v = Q y.
template <int dim>
void LocalError<dim>::solve(const Nodes           &X,
                            const Material        &material,
                            const HeldFaces<dim>  &held,
                            std::vector<Residual> &r) const
{
  const auto                                                   A = matrix(X, material);
  std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>> columns; // function, direction
  for (unsigned int i = 0; i < higher.size(); ++i)
    {
      std::vector<dealii::Tensor<1, dim>> of_function;
      for (unsigned int f = 0; f < 2 * dim; ++f)
        if (higher.is_on_face(i, f))
          for (auto direction : held[f])
            {
              for (const auto &h : of_function)
                direction -= (h * direction) * h;
              if (direction.norm() > 1e-6)
                of_function.push_back(direction / direction.norm());
            }
      for (const auto &direction : free_directions<dim>(of_function))
        columns.emplace_back(i, direction);
    }
  const unsigned int               n = columns.size();
  dealii::LAPACKFullMatrix<double> reduced(n, n);
  for (unsigned int k = 0; k < n; ++k)
    for (unsigned int l = 0; l < n; ++l)
      {
        double sum = 0.;
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            sum += columns[k].second[c] * columns[l].second[d] *
                   A[(dim * columns[k].first + c) * size() + dim * columns[l].first + d];
        reduced(k, l) = sum;
      }
  reduced.set_property(dealii::LAPACKSupport::symmetric);
  reduced.compute_cholesky_factorization();
  for (auto &of_load : r)
    {
      dealii::Vector<double> y(n);
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int c = 0; c < dim; ++c)
          y[k] += columns[k].second[c] * of_load[dim * columns[k].first + c];
      reduced.solve(y);
      of_load.assign(size(), 0.);
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int c = 0; c < dim; ++c)
          of_load[dim * columns[k].first + c] += columns[k].second[c] * y[k];
    }
}

template class HigherFunctions<2>;
template class HigherFunctions<3>;
template class LocalError<2>;
template class LocalError<3>;
} // namespace snug::elasticity
