#ifndef snug_tests_elasticity_cells_h
#define snug_tests_elasticity_cells_h

#include <unit/random_field.h>

#include <snug/elasticity/element.h>
#include <snug/elasticity/face_load.h>

#include <deal.II/base/utilities.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace elasticity_cells {
using namespace snug::elasticity;
using snug::mesh::Idealization;

template <int dim>
using Nodes = std::vector<dealii::Tensor<1, dim>>;

const Material material{7., 0.3};

/// Nodes of the cube [0,1]^dim in tensor-product order.
template <int dim>
Nodes<dim> cube(const unsigned int degree)
{
  Nodes<dim> X(dealii::Utilities::pow(degree + 1, dim));
  for (unsigned int a = 0; a < X.size(); ++a)
    for (unsigned int d = 0, k = a; d < dim; ++d, k /= degree + 1)
      X[a][d] = double(k % (degree + 1)) / degree;
  return X;
}

using snug::test::random_field;

template <int dim>
dealii::Tensor<2, dim> random_matrix(const unsigned int seed)
{
  const auto             columns = random_field<dim>(dim, seed);
  dealii::Tensor<2, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = columns[d];
  return result;
}

template <int dim>
dealii::Tensor<2, dim> random_skew(const unsigned int seed)
{
  const auto A = random_matrix<dim>(seed);
  return A - transpose(A);
}

/// field_a <- A field_a.
template <int dim>
Nodes<dim> times(const dealii::Tensor<2, dim> &A, Nodes<dim> field)
{
  for (auto &vector : field)
    vector = A * vector;
  return field;
}

template <int dim>
Nodes<dim> sum(Nodes<dim> x, const double factor, const Nodes<dim> &y)
{
  for (unsigned int a = 0; a < x.size(); ++a)
    x[a] += factor * y[a];
  return x;
}

template <int dim>
double dot(const Nodes<dim> &x, const Nodes<dim> &y)
{
  double result = 0.;
  for (unsigned int a = 0; a < x.size(); ++a)
    result += x[a] * y[a];
  return result;
}

template <int dim>
double norm(const Nodes<dim> &x)
{
  return std::sqrt(dot<dim>(x, x));
}

template <int dim>
double distance(const Nodes<dim> &x, const Nodes<dim> &y)
{
  return norm<dim>(sum<dim>(x, -1., y));
}

/// A skewed, stretched cube whose nodes are all moved: curved faces.
template <int dim>
Nodes<dim> distorted(const unsigned int degree, const unsigned int seed)
{
  dealii::Tensor<2, dim> A = 0.2 * random_matrix<dim>(seed);
  for (unsigned int d = 0; d < dim; ++d)
    A[d][d] += 1. + 0.5 * d;
  const auto X = times<dim>(A, cube<dim>(degree));
  return sum<dim>(X, 0.1 / degree, random_field<dim>(X.size(), seed + 100));
}

/// All idealizations of dimension dim; plane ones 0.3 thick.
template <int dim>
std::vector<Idealization> idealizations()
{
  using Kind = Idealization::Kind;
  if (dim == 3)
    return {{Kind::solid}};
  return {{Kind::plane_strain, 0.3}, {Kind::plane_stress, 0.3}, {Kind::axisymmetric}};
}

/// distorted(), at radii of about 1.5 to 3 where x is the radius.
template <int dim>
Nodes<dim>
distorted(const Idealization &idealization, const unsigned int degree, const unsigned int seed)
{
  auto X = distorted<dim>(degree, seed);
  if (idealization.is_axisymmetric())
    for (auto &x : X)
      x[0] += 1.75;
  return X;
}

/// An element of some idealization and formulation, with a cell for it.
template <int dim>
struct TestElement
{
  Idealization idealization;
  Formulation  formulation;
  Element<dim> element;
  Nodes<dim>   X;

  std::string name() const
  {
    const char *kinds[] = {"solid", "plane strain", "plane stress", "axisymmetric"};
    return std::string(kinds[static_cast<int>(idealization.kind)]) +
           (formulation == Formulation::B_bar ? ", B-bar" : "");
  }

  /// Directions in which the whole body may be moved.
  bool may_translate(const unsigned int direction) const
  {
    return !idealization.is_axisymmetric() || direction == 1;
  }
};

/// All of them for a degree, cells from @p seed.
template <int dim>
std::vector<TestElement<dim>> all_elements(const unsigned int degree, const unsigned int seed)
{
  std::vector<TestElement<dim>> elements;
  for (const auto &idealization : idealizations<dim>())
    for (const auto formulation : {Formulation::standard, Formulation::B_bar})
      if (formulation == Formulation::standard ||
          idealization.kind != Idealization::Kind::plane_stress)
        elements.push_back({idealization, formulation,
                            Element<dim>(degree, idealization, formulation),
                            distorted<dim>(idealization, degree, seed)});
  return elements;
}

/// r = K u with the matrix of Element::stiffness.
template <int dim>
Nodes<dim> multiply(const std::vector<double> &K, const Nodes<dim> &u)
{
  Nodes<dim> r(u.size());
  for (unsigned int i = 0; i < dim * u.size(); ++i)
    for (unsigned int j = 0; j < dim * u.size(); ++j)
      r[i / dim][i % dim] += K[i * dim * u.size() + j] * u[j / dim][j % dim];
  return r;
}

/// Largest entry: the scale that round-off in K refers to.
inline double largest(const std::vector<double> &K)
{
  double result = 0.;
  for (const double entry : K)
    result = std::max(result, std::abs(entry));
  return result;
}

/// Derivative of f(t) at 0 by fourth-order central differences with step
/// 5e-4: truncation 2e-15 |f^(5)|, round-off 4e-13 |f|.
template <typename Value>
Value derivative(const std::function<Value(double)> &f)
{
  const double h = 5e-4;
  return (8. * (f(h) - f(-h)) - (f(2. * h) - f(-2. * h))) / (12. * h);
}

/// The same for a field that depends on positions, along V.
template <int dim>
Nodes<dim> derivative(const std::function<Nodes<dim>(const Nodes<dim> &)> &f,
                      const Nodes<dim>                                    &X,
                      const Nodes<dim>                                    &V)
{
  const double h      = 5e-4;
  Nodes<dim>   result = f(sum<dim>(X, h, V));
  result              = sum<dim>(result, -1., f(sum<dim>(X, -h, V)));
  for (auto &vector : result)
    vector *= 8.;
  result = sum<dim>(result, -1., f(sum<dim>(X, 2. * h, V)));
  result = sum<dim>(result, 1., f(sum<dim>(X, -2. * h, V)));
  for (auto &vector : result)
    vector /= 12. * h;
  return result;
}

/// Cell nodes of the face normal to axis @p d at its lower or upper side,
/// oriented outwards as BodyMesh::Face says.
template <int dim>
std::vector<unsigned int>
face_nodes(const unsigned int degree, const unsigned int d, const bool upper)
{
  const unsigned int            n = degree + 1;
  std::array<unsigned int, dim> stride;
  for (unsigned int e = 0; e < dim; ++e)
    stride[e] = dealii::Utilities::pow(n, e);

  std::vector<unsigned int> result;
  const unsigned int        first = upper ? degree * stride[d] : 0;
  if (dim == 2)
    for (unsigned int i = 0; i < n; ++i)
      {
        // tangent +y on the right and -x on the top face, else opposite
        const bool forward = (d == 0) == upper;
        result.push_back(first + (forward ? i : degree - i) * stride[1 - d]);
      }
  else
    {
      const unsigned int t1 = stride[(d + (upper ? 1 : 2)) % dim];
      const unsigned int t2 = stride[(d + (upper ? 2 : 1)) % dim];
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i)
          result.push_back(first + i * t1 + j * t2);
    }
  return result;
}

/// All 2 dim faces of a cell.
template <int dim>
std::vector<std::vector<unsigned int>> all_faces(const unsigned int degree)
{
  std::vector<std::vector<unsigned int>> faces;
  for (unsigned int d = 0; d < dim; ++d)
    for (const bool upper : {false, true})
      faces.push_back(face_nodes<dim>(degree, d, upper));
  return faces;
}

template <int dim>
Nodes<dim> extract(const Nodes<dim> &X, const std::vector<unsigned int> &indices)
{
  Nodes<dim> result;
  for (const unsigned int a : indices)
    result.push_back(X[a]);
  return result;
}

/// sum over the faces of int N_a n dA, n pointing out of the cell.
template <int dim>
Nodes<dim> boundary_normals(const unsigned int  degree,
                            const Nodes<dim>   &X,
                            const Idealization &idealization = Idealization::natural(dim))
{
  const FaceLoad<dim> load(degree, idealization);
  Nodes<dim>          result(X.size()), f;
  for (const auto &face : all_faces<dim>(degree))
    {
      load.force(extract<dim>(X, face), {std::vector<double>(face.size(), -1.), {}, {}}, f);
      for (unsigned int i = 0; i < face.size(); ++i)
        result[face[i]] += f[i];
    }
  return result;
}

template <int dim_, unsigned int degree_>
struct Case
{
  static constexpr int          dim    = dim_;
  static constexpr unsigned int degree = degree_;
};

using AllCases = ::testing::Types<Case<2, 1>, Case<2, 2>, Case<3, 1>, Case<3, 2>>;
} // namespace elasticity_cells

#endif
