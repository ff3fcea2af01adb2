#include <snug/elasticity/local_error.h>
#include <snug/elasticity/pressure_space.h>
#include <snug/elasticity/stress.h>

#include <algorithm>
#include <cmath>

namespace snug::elasticity {
namespace {
/// Return one factor of a coordinate with its derivative: b or a Lagrange function of degree p.
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

/// Return whether the function is nonzero on the face. b vanishes at both ends, and so do all
/// Lagrange functions except that of the end.
template <int dim>
bool HigherFunctions<dim>::is_on_face(const unsigned int i, const unsigned int face) const
{
  return factors[i][face / 2] == (face % 2) * degree;
}

template <int dim>
LocalSpace<dim>::LocalSpace(const unsigned int        degree,
                            const mesh::Idealization &idealization,
                            const Formulation         formulation)
  : degree(degree), idealization(idealization), formulation(formulation), functions(degree)
{
  // The rule is exact for products of functions of degree p + 1 on parallelograms.
  for (const auto &point : mesh::lagrange_gauss_points<dim>(degree + 1))
    {
      quadrature.push_back(mesh::lagrange_point<dim>(degree, point.point));
      quadrature.back().weight = point.weight;
      at_quadrature.push_back(functions.at(point.point));
    }
}

template <int dim>
void add_force(const typename LocalSpace<dim>::Functions &values,
               const dealii::Tensor<1, dim>              &force,
               LocalResidual                             &r)
{
  for (unsigned int i = 0; i < values.size(); ++i)
    for (unsigned int c = 0; c < dim; ++c)
      r[dim * i + c] += values[i].value * force[c];
}

namespace {
/// Return unit vectors orthogonal to @p held, whose vectors are orthonormal.
template <int dim>
std::vector<dealii::Tensor<1, dim>> free_directions(std::vector<dealii::Tensor<1, dim>> held)
{
  std::vector<dealii::Tensor<1, dim>> result;
  // Start from the axis that is farthest from the span of the vectors, so that no small
  // difference occurs.
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
/// Differences of nodes up to this share of the cell size are rounding.
const double congruent = 1e-12;
} // namespace

template <int dim>
LocalError<dim>::LocalError(const LocalSpace<dim> &space,
                            const Nodes           &X,
                            const Material        &material,
                            const HeldFaces<dim>  &held)
  : space(space), X(X), material(material), held(held)
{
  for (unsigned int q = 0; q < space.quadrature.size(); ++q)
    {
      const auto  &shape   = space.quadrature[q];
      const auto   J       = jacobian(shape, X);
      const auto   inverse = invert(J);
      const auto   x       = value(shape, X);
      const double hoop    = space.idealization.is_axisymmetric() ? 1. / x[0] : 0.;
      at.emplace_back();
      at.back().reserve(space.functions.size());
      for (const auto &f : space.at_quadrature[q])
        at.back().push_back({f.gradient * inverse, f.value * hoop});
      dV.push_back(shape.weight * determinant(J) * space.idealization.weight(x));
    }
  find_basis();
  // All functions are held where supports hold all nodes.
  if (basis.empty())
    return;
  const auto         A = matrix();
  const unsigned int n = basis.size(), size = space.size();
  factor.reinit(n);
  // Without held directions the basis is that of V.
  for (unsigned int k = 0; n == size && k < n; ++k)
    for (unsigned int l = 0; l <= k; ++l)
      factor(k, l) = A[k * size + l];
  for (unsigned int k = 0; n < size && k < n; ++k)
    for (unsigned int l = 0; l <= k; ++l)
      {
        const auto &[i, u] = basis[k];
        const auto &[j, v] = basis[l];
        double sum         = 0.;
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            sum += u[c] * v[d] * A[(dim * i + c) * size + dim * j + d];
        factor(k, l) = sum; // Cholesky reads the lower half
      }
  factor.set_property(dealii::LAPACKSupport::symmetric);
  factor.compute_cholesky_factorization();
}

template <int dim>
bool LocalError<dim>::fits(const LocalSpace<dim> &of_space,
                           const Nodes           &other,
                           const Material        &of_other,
                           const HeldFaces<dim>  &held_there) const
{
  if (&of_space != &space || of_other.youngs_modulus != material.youngs_modulus ||
      of_other.poissons_ratio != material.poissons_ratio || held_there != held)
    return false;
  const double size = (X.back() - X.front()).norm();
  if (space.idealization.is_axisymmetric() && std::abs(other[0][0] - X[0][0]) > congruent * size)
    return false;
  for (unsigned int a = 1; a < X.size(); ++a)
    if (((other[a] - other[0]) - (X[a] - X[0])).norm() > congruent * size)
      return false;
  return true;
}

/// Find the basis of V in directions of space along which V is not held.
template <int dim>
void LocalError<dim>::find_basis()
{
  basis.reserve(space.size());
  const auto axes = free_directions<dim>({});
  for (unsigned int i = 0; i < space.functions.size(); ++i)
    {
      std::vector<dealii::Tensor<1, dim>> of_function;
      for (unsigned int f = 0; f < 2 * dim; ++f)
        if (space.functions.is_on_face(i, f))
          for (auto direction : held[f])
            {
              for (const auto &h : of_function)
                direction -= (h * direction) * h;
              if (direction.norm() > 1e-6)
                of_function.push_back(direction / direction.norm());
            }
      for (const auto &direction : of_function.empty() ? axes : free_directions<dim>(of_function))
        basis.emplace_back(i, direction);
    }
}

/// Return the integrals of f_i,c f_j,d.
template <int dim>
dealii::LAPACKFullMatrix<double> LocalError<dim>::gradient_products() const
{
  const unsigned int               n = space.functions.size(), size = space.size();
  dealii::LAPACKFullMatrix<double> gradients(at.size(), size), weighted(at.size(), size);
  for (unsigned int q = 0; q < at.size(); ++q)
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int c = 0; c < dim; ++c)
        {
          gradients(q, dim * i + c) = at[q][i].gradient[c];
          weighted(q, dim * i + c)  = dV[q] * at[q][i].gradient[c];
        }
  dealii::LAPACKFullMatrix<double> result(size);
  weighted.Tmmult(result, gradients);
  return result;
}

/// Return a(e, v), row by row, below the diagonal of functions. For functions f_i and f_j times
/// unit vectors c and d it is the integral of lambda f_i,c f_j,d + mu f_i,d f_j,c, plus mu f_i,e
/// f_j,e if c = d. Divergences include the hoop strain.
template <int dim>
std::vector<double> LocalError<dim>::matrix(const double lambda, const double mu) const
{
  const unsigned int  n = space.functions.size(), size = space.size();
  const auto          products = gradient_products();
  std::vector<double> A(size * size, 0.);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j <= i; ++j)
      {
        double gradients[dim][dim], divergences[dim][dim];
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            gradients[c][d] = products(dim * i + c, dim * j + d);
        std::copy(&gradients[0][0], &gradients[0][0] + dim * dim, &divergences[0][0]);
        double hoops = 0.;
        for (unsigned int q = 0; space.idealization.is_axisymmetric() && q < at.size(); ++q)
          {
            const auto &u = at[q][i], &v = at[q][j];
            for (unsigned int d = 0; d < dim; ++d)
              {
                divergences[0][d] += dV[q] * u.hoop * v.gradient[d];
                divergences[d][0] += dV[q] * u.gradient[d] * v.hoop;
              }
            hoops += dV[q] * u.hoop * v.hoop;
          }
        divergences[0][0] += hoops;
        double product = 0.;
        for (unsigned int c = 0; c < dim; ++c)
          product += gradients[c][c];
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            A[(dim * i + c) * size + dim * j + d] =
              lambda * divergences[c][d] + mu * gradients[d][c] + (c == d ? mu * product : 0.) +
              (c == 0 && d == 0 ? 2. * mu * hoops : 0.);
      }
  return A;
}

/// Compute A += factor sum_k c_k c_k', where c_k' v = int psi_k div v dV with the functions psi_k
/// of the pressure space of one degree more.
template <int dim>
void LocalError<dim>::add_projected(const double factor, std::vector<double> &A)
{
  const unsigned int              n = space.functions.size(), size = space.size();
  std::vector<dealii::Point<dim>> points;
  for (const auto &shape : space.quadrature)
    points.push_back(shape.point);
  const PressureSpace<dim> pressures(space.degree + 1, points, dV);
  const auto   n_known = PressureSpace<dim>(space.degree, points, dV).functions().size();
  const double root    = std::sqrt(factor);
  for (unsigned int k = 0; k < pressures.functions().size(); ++k)
    {
      const auto         &psi = pressures.functions()[k];
      std::vector<double> row(size, 0.), weights;
      for (unsigned int q = 0; q < at.size(); ++q)
        {
          weights.push_back(root * psi[q] * dV[q]);
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int c = 0; c < dim; ++c)
              row[dim * i + c] += weights[q] * at[q][i].divergence(c);
        }
      for (unsigned int i = 0; i < size; ++i)
        for (unsigned int j = 0; j < size; ++j)
          A[i * size + j] += row[i] * row[j];
      if (k < n_known)
        continue;
      missing.push_back(weights);
      missing_rows.push_back(row);
    }
}

template <int dim>
std::vector<double> LocalError<dim>::matrix()
{
  const double mu = material.lame_mu();
  if (space.formulation == Formulation::standard)
    return matrix(lame_lambda(space.idealization, material), mu);
  auto A = matrix(-2. / 3. * mu, mu);
  add_projected(material.bulk_modulus(), A);
  return A;
}

template <int dim>
std::vector<double> LocalError<dim>::missing_dilatation(const Nodes &u) const
{
  std::vector<double> d(missing.size(), 0.);
  for (unsigned int q = 0; !missing.empty() && q < at.size(); ++q)
    {
      const double dilatation =
        trace(CellPoint<dim>(space.quadrature[q], X, space.idealization).gradient(u));
      for (unsigned int k = 0; k < d.size(); ++k)
        d[k] += missing[k][q] * dilatation;
    }
  return d;
}

template <int dim>
double LocalError<dim>::dilatation_work(const std::vector<double> &d, const LocalResidual &e) const
{
  double sum = 0.;
  for (unsigned int k = 0; k < d.size(); ++k)
    for (unsigned int i = 0; i < e.size(); ++i)
      sum += d[k] * missing_rows[k][i] * e[i];
  return sum;
}

template <int dim>
void LocalError<dim>::subtract_dilatation(const std::vector<double> &d, LocalResidual &r) const
{
  for (unsigned int k = 0; k < d.size(); ++k)
    for (unsigned int i = 0; i < r.size(); ++i)
      r[i] -= d[k] * missing_rows[k][i];
}

template <int dim>
void LocalError<dim>::add_residual(const Stresses &sigma, const Nodes &b, LocalResidual &r) const
{
  for (unsigned int q = 0; q < at.size(); ++q)
    {
      dealii::Tensor<2, dim> in_plane;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          in_plane[c][d] = dV[q] * sigma[q][c][d];
      const double hoop = dV[q] * sigma[q][2][2];
      for (unsigned int i = 0; i < at[q].size(); ++i)
        {
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int d = 0; d < dim; ++d)
              r[dim * i + c] -= in_plane[c][d] * at[q][i].gradient[d];
          r[dim * i] -= hoop * at[q][i].hoop;
        }
      if (!b.empty())
        add_force<dim>(space.at_quadrature[q], dV[q] * b[q], r);
    }
}

template <int dim>
void LocalError<dim>::solve(LocalResidual &r) const
{
  if (basis.empty())
    {
      r.assign(space.size(), 0.);
      return;
    }
  dealii::Vector<double> y(basis.size());
  for (unsigned int k = 0; k < basis.size(); ++k)
    for (unsigned int c = 0; c < dim; ++c)
      y[k] += basis[k].second[c] * r[dim * basis[k].first + c];
  factor.solve(y);
  r.assign(space.size(), 0.);
  for (unsigned int k = 0; k < basis.size(); ++k)
    for (unsigned int c = 0; c < dim; ++c)
      r[dim * basis[k].first + c] += basis[k].second[c] * y[k];
}

template void add_force<2>(const typename LocalSpace<2>::Functions &,
                           const dealii::Tensor<1, 2> &,
                           LocalResidual &);
template void add_force<3>(const typename LocalSpace<3>::Functions &,
                           const dealii::Tensor<1, 3> &,
                           LocalResidual &);
template class HigherFunctions<2>;
template class HigherFunctions<3>;
template struct LocalSpace<2>;
template struct LocalSpace<3>;
template class LocalError<2>;
template class LocalError<3>;
} // namespace snug::elasticity
