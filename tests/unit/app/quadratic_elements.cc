#include <snug/mesh_file/mesh_file.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>

#include "solved_scene.h"

using namespace snug;
using namespace snug::test;

namespace {
constexpr double E = 1000., nu = 0.3, pressure = 2., density = 5.;

/**
 * The quadratic elements of simplices with straight edges, without cells: nodes at the corners and
 * in the middles of the edges, functions lambda_i (2 lambda_i - 1) and 4 lambda_i lambda_j, exact
 * integrals. The material is isotropic (plane strain in 2D).
 */
template <int dim>
class Simplices
{
public:
  using Vector = dealii::Tensor<1, dim>;

  explicit Simplices(const mesh_file::MeshFile &file, const std::string &region)
  {
    for (const auto &element : file.elements)
      if (element.corners.size() == dim + 1 && mesh_file::dimension(element.shape) == dim &&
          (region.empty() || element.groups.back() == region))
        elements.push_back(numbered(file, element.corners));
    for (const auto &element : file.elements)
      if (element.corners.size() == dim && mesh_file::dimension(element.shape) == dim - 1 &&
          !element.groups.empty() && is_known(element.corners))
        faces[element.groups.back()].push_back(numbered(file, element.corners));
  }

  std::vector<Vector> positions;

  /// Add K u. The energy is 1/2 u'K u.
  std::vector<Vector> stiffness_times(const std::vector<Vector> &u) const
  {
    const double        mu = E / (2. * (1. + nu)), lambda = 2. * mu * nu / (1. - 2. * nu);
    std::vector<Vector> r(u.size());
    for (const auto &nodes : elements)
      {
        const auto [gradients, volume] = barycentric(nodes);
        // The strains are linear, so a rule exact for degree 2 is exact.
        for (unsigned int q = 0; q <= dim; ++q)
          {
            std::array<double, dim + 1> at;
            at.fill(dim == 3 ? (5. - std::sqrt(5.)) / 20. : 1. / 6.);
            at[q]                     = 1. - dim * at[(q + 1) % (dim + 1)];
            const auto             dN = function_gradients(gradients, at);
            dealii::Tensor<2, dim> grad, stress;
            for (unsigned int a = 0; a < nodes.size(); ++a)
              grad += dealii::outer_product(u[nodes[a]], dN[a]);
            stress = mu * (grad + dealii::transpose(grad));
            for (unsigned int d = 0; d < dim; ++d)
              stress[d][d] += lambda * dealii::trace(grad);
            for (unsigned int a = 0; a < nodes.size(); ++a)
              r[nodes[a]] += volume / (dim + 1) * (stress * dN[a]);
          }
      }
    return r;
  }

  /// Return the force of a body force @p b and of the pressure on the faces of a group.
  std::vector<Vector> loads(const Vector &b, const std::string &group) const
  {
    std::vector<Vector> f(positions.size());
    for (const auto &nodes : elements)
      add_uniform(nodes, dim, barycentric(nodes).second * b, f);
    for (const auto &nodes : faces.at(group))
      {
        Vector normal; // times the area, along the last axis
        if constexpr (dim == 3)
          normal = 0.5 * dealii::cross_product_3d(positions[nodes[1]] - positions[nodes[0]],
                                                  positions[nodes[2]] - positions[nodes[0]]);
        else
          normal = dealii::cross_product_2d(positions[nodes[1]] - positions[nodes[0]]);
        if (normal[dim - 1] < 0.)
          normal *= -1.;
        add_uniform(nodes, dim - 1, -pressure * normal, f);
      }
    return f;
  }

private:
  using Nodes = std::vector<unsigned int>;

  std::vector<Nodes>                                            elements;
  std::map<std::string, std::vector<Nodes>>                     faces;
  std::map<std::pair<unsigned int, unsigned int>, unsigned int> numbers;

  /// Return whether the face belongs to an element.
  bool is_known(const Nodes &corners) const
  {
    return numbers.count(std::minmax(corners.front(), corners.back())) > 0 &&
           numbers.count(std::minmax(corners[0], corners[1])) > 0;
  }

  /// Return the corners, then the middles of the pairs of corners.
  Nodes numbered(const mesh_file::MeshFile &file, const Nodes &corners)
  {
    Nodes result, middles;
    for (unsigned int i = 0; i < corners.size(); ++i)
      for (unsigned int j = i; j < corners.size(); ++j)
        {
          const auto key   = std::minmax(corners[i], corners[j]);
          const auto entry = numbers.emplace(key, positions.size());
          if (entry.second)
            {
              positions.emplace_back();
              for (unsigned int d = 0; d < dim; ++d)
                positions.back()[d] =
                  (file.points[corners[i]][d] + file.points[corners[j]][d]) / 2.;
            }
          (i == j ? result : middles).push_back(entry.first->second);
        }
    result.insert(result.end(), middles.begin(), middles.end());
    return result;
  }

  std::pair<std::array<Vector, dim + 1>, double> barycentric(const Nodes &nodes) const
  {
    dealii::Tensor<2, dim> edges;
    for (unsigned int i = 0; i < dim; ++i)
      edges[i] = positions[nodes[i + 1]] - positions[nodes[0]];
    const auto                  inverse = dealii::invert(edges);
    std::array<Vector, dim + 1> gradients;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          gradients[i + 1][d] = inverse[d][i];
          gradients[0][d] -= inverse[d][i];
        }
    return {gradients, std::abs(dealii::determinant(edges)) / (dim == 3 ? 6. : 2.)};
  }

  static std::vector<Vector> function_gradients(const std::array<Vector, dim + 1> &gradients,
                                                const std::array<double, dim + 1> &at)
  {
    std::vector<Vector> result, middles;
    for (unsigned int i = 0; i <= dim; ++i)
      for (unsigned int j = i; j <= dim; ++j)
        if (i == j)
          result.push_back((4. * at[i] - 1.) * gradients[i]);
        else
          middles.push_back(4. * (at[i] * gradients[j] + at[j] * gradients[i]));
    result.insert(result.end(), middles.begin(), middles.end());
    return result;
  }

  /// Add the force @p total, spread evenly over a simplex of dimension n. The integrals of the
  /// functions of corners are (2 - n) n! / (n + 2)! of its size, those of middles 4 n! / (n + 2)!.
  static void
  add_uniform(const Nodes &nodes, const unsigned int n, const Vector &total, std::vector<Vector> &f)
  {
    const double part = 1. / ((n + 1.) * (n + 2.));
    for (unsigned int a = 0; a < nodes.size(); ++a)
      f[nodes[a]] += part * (a <= n ? (2. - n) : 4.) * total;
  }
};

template <int dim>
void expect_solution_of_simplices(const std::string &name,
                                  const std::string &region,
                                  const unsigned int subdomains)
{
  const std::string file = SNUG_MESHES + name;
  SolvedScene<dim>  solved("set Dimension = " + std::to_string(dim) +
                             "\nset Bodies = block\nset Gravity = " + (dim == 3 ? "0.5, " : "") +
                             "1, -3\nsubsection Body block\nset Mesh = file\nset File = " + file +
                             "\nset Mesh regions = " + region +
                             "\nset Young's modulus = 1000\nset Poisson's ratio = 0.3\n"
                              "set Density = 5\nset Pressure = top: 2\nset Supports = bottom: " +
                             (dim == 3 ? "xyz" : "xy") +
                             "\n"
                              "end\nsubsection Decomposition\nset Subdomains = " +
                             std::to_string(subdomains) + "\nend\n",
                           exact);
  ASSERT_EQ(solved.scene.degree, 2u);
  std::ifstream      in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  const Simplices<dim> simplices(mesh_file::read_mesh_file(text.str()), region);
  const auto          &x = simplices.positions;
  ASSERT_EQ(solved.mesh.n_global_free_nodes(), x.size());
  // Find the nodes by their positions.
  std::vector<dealii::Tensor<1, dim>> u(x.size());
  for (unsigned int a = 0; a < x.size(); ++a)
    {
      unsigned int nearest = 0;
      for (unsigned int node = 0; node < solved.mesh.n_local_nodes(); ++node)
        if (!solved.mesh.is_hanging(node) &&
            (solved.positions[node] - x[a]).norm() < (solved.positions[nearest] - x[a]).norm())
          nearest = node;
      ASSERT_LT((solved.positions[nearest] - x[a]).norm(), 1e-12);
      u[a] = solved.state.displacement[nearest];
    }
  dealii::Tensor<1, dim> gravity;
  gravity[0] = dim == 3 ? 0.5 : 1.;
  gravity[1] = dim == 3 ? 1. : -3.;
  if (dim == 3)
    gravity[dim - 1] = -3.;
  const auto r = simplices.stiffness_times(u), f = simplices.loads(density * gravity, "top");
  double     energy = 0., largest = 0., size = 0.;
  for (unsigned int a = 0; a < x.size(); ++a)
    {
      energy += 0.5 * r[a] * u[a];
      size = std::max(size, f[a].norm());
      if (x[a][dim - 1] > 1e-12) // not held at the bottom
        largest = std::max(largest, (r[a] - f[a]).norm());
    }
  // The state is solved to 1e-10 of the norms of forces.
  EXPECT_LT(largest, 1e-8 * size);
  EXPECT_NEAR(solved.state.strain_energy, energy, 1e-10 * energy);
}
} // namespace

TEST(QuadraticElements, SolutionIsThatOfTenNodeTetrahedra)
{
  for (const unsigned int subdomains : {1, 3})
    expect_solution_of_simplices<3>("tets-4-binary.msh", "", subdomains);
}

TEST(QuadraticElements, SolutionIsThatOfSixNodeTriangles)
{
  for (const unsigned int subdomains : {1, 3})
    expect_solution_of_simplices<2>("square.msh", "tris", subdomains);
}
